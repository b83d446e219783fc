"""Text of ``beardyn bearing``: geometry, fault frequencies, load distribution, stiffness, ribs."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any

from beardyn_core.cli.bearing_report import Case, most_loaded_roller

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.kinematics import FaultFrequencies
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.physics.statics.static import StaticSolution

_RINGS = {
    "elastic": "elastic rings: the cup bends in a housing with a wall of 25 mm",
    "rigid": "rigid rings: only the contacts yield",
}
_BAR_WIDTH = 22
_ENDS = ("from its inner to its outer end", "from its small to its large end")
_RPM = 2.0 * math.pi / 60.0


def bearing_table(case: Case, solution: StaticSolution) -> str:
    """Write the answer as text."""
    from beardyn_core.bearing.kinematics import fault_frequencies

    bearing, args = case.bearing, case.args
    rpm = round(case.speed / _RPM, 9)
    force = ", ".join(f"{value / 1e3:g}" for value in case.load)
    chosen = " (default)" if args.load is None else ""
    return "\n".join(
        [
            f"{bearing.name}   {bearing.description}".rstrip(),
            "",
            *_geometry_lines(bearing),
            "",
            "Frequencies per shaft revolution",
            *_frequency_lines(fault_frequencies(bearing), rpm),
            "",
            f"Static equilibrium under ({force}) kN on the cone{chosen}",
            f"  {_play_words(case)}, tilt {args.tilt}, {rpm:g} rpm, laminae {case.laminae}",
            f"  {_RINGS[args.rings]}",
            *_static_lines(solution),
            *_rib_lines(bearing, solution, rpm),
            *(
                _line_lines(most_loaded_roller(bearing, solution), _ENDS[bearing.kind == "tapered"])
                if case.laminae > 1
                else []
            ),
        ]
    )


def _play_words(case: Case) -> str:
    plays = (("radial clearance", case.radial_clearance), ("end play", case.end_play))
    return ", ".join(f"{name} {play * 1e3:g} mm" for name, play in plays if play is not None)


def _geometry_lines(bearing: RollerBearing) -> list[str]:
    from beardyn_core.bearing.cylindrical import CylindricalBearing
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.life import dynamic_rating, static_rating
    from beardyn_core.bearing.spherical import SphericalBearing

    rating = dynamic_rating(bearing)
    entries = [
        (
            "envelope",
            f"{bearing.bore * 1e3:g} x {bearing.outer_diameter * 1e3:g} x {bearing.width * 1e3:g} mm",
        ),
        ("rollers", f"2 x {bearing.roller_count}, row spacing {bearing.row_spacing * 1e3:.4g} mm"),
        (
            "roller",
            f"{bearing.roller_diameter * 1e3:g} mm mean diameter on {bearing.pitch_diameter * 1e3:g} mm, "
            f"contact length {bearing.effective_length * 1e3:g} mm, {bearing.roller_mass * 1e3:.1f} g",
        ),
    ]
    title, ratings = f"Geometry ({bearing.words})", f"C_r {rating.radial / 1e3:.0f} kN"
    if isinstance(bearing, Bearing):
        title = "Geometry (closed on a common apex)"
        entries += _tapered_entries(bearing)
    else:
        ratings += f", C_0r {static_rating(bearing) / 1e3:.0f} kN"
    if isinstance(bearing, CylindricalBearing):
        entries += [
            (
                "ribs",
                f"outer ring {bearing.cup_ribs}, inner ring {bearing.cone_ribs}, loose rib "
                f"{bearing.loose_rib}; contact {bearing.rib_contact_height * 1e3:g} mm above the raceways",
            ),
            ("play", f"roller {bearing.roller_play * 1e3:g} mm between its ribs"),
        ]
    if isinstance(bearing, SphericalBearing):
        entries.append(
            (
                "raceways",
                f"contact angle {math.degrees(bearing.contact_angle):.2f} deg, sphere "
                f"{bearing.sphere_radius * 1e3:.2f} mm, osculation {bearing.cup_osculation:g} and "
                f"{bearing.cone_osculation:g}",
            )
        )
    if math.isfinite(rating.thrust_limit):
        ratings += f", e {rating.thrust_limit:.3f}"
    entries.append(("rating", f"{ratings} (ISO 281)"))
    return [title, *(f"  {name:<10} {text}" for name, text in entries)]


def _tapered_entries(bearing: Bearing) -> list[tuple[str, str]]:
    """Describe angles, apex and large end."""
    return [
        (
            "angles",
            f"cup {math.degrees(bearing.cup_angle):.3f}, cone {math.degrees(bearing.cone_angle):.3f}, "
            f"roller half-angle {math.degrees(bearing.half_angle):.4f}, "
            f"rib {math.degrees(bearing.rib_angle):.2f} deg",
        ),
        (
            "apex",
            f"{bearing.apex_distance * 1e3:.2f} mm from mid-length; pressure centres "
            f"{bearing.pressure_centre_spread * 1e3:.1f} mm apart",
        ),
        (
            "large end",
            f"radius {bearing.large_end_radius * 1e3:.3f} mm, sphere {bearing.sphere_radius * 1e3:.1f} mm, "
            f"rib contact {bearing.rib_contact_height * 1e3:g} mm above the raceway",
        ),
    ]


def _rib_lines(bearing: RollerBearing, solution: StaticSolution, speed: float) -> list[str]:
    """Describe the contact of the heaviest rib: ellipse, pressure, sliding speed, and its limits."""
    from beardyn_core.bearing.contact_law import rib_ellipse, rib_truncation
    from beardyn_core.bearing.cylindrical import CylindricalBearing
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.kinematics import roller_cone_spin
    from beardyn_core.bearing.rib_face import flat_rib_truncation

    load = float(solution.rib_load.max())
    if load <= 0.0:
        return []
    if not isinstance(bearing, Bearing):
        pressed = (solution.rib_load > 0.0).sum(axis=1)
        found = flat_rib_truncation(bearing, load) if isinstance(bearing, CylindricalBearing) else []
        return [
            "",
            f"  ribs of the inner ring carry {solution.rib_load.sum():,.1f} N along the axle on "
            f"{pressed[0]} rollers inboard, {pressed[1]} outboard; heaviest rib {load:,.1f} N",
            *_warnings(found),
        ]
    ellipse = rib_ellipse(bearing, load)
    sliding = abs(roller_cone_spin(bearing, speed * math.pi / 30.0)) * bearing.rib_contact_height
    product = 2.0 / 3.0 * ellipse.largest_pressure * sliding
    lines = [
        "",
        f"  heaviest rib {load:,.1f} N on an ellipse of {2e3 * ellipse.around:.2f} x "
        f"{2e3 * ellipse.along:.2f} mm, {ellipse.largest_pressure * 1e-6:.1f} MPa",
        f"  it slides with {sliding:.3f} m/s, p v {product * 1e-6:.1f} MPa m/s",
    ]
    return lines + _warnings(rib_truncation(bearing, load))


def _warnings(sentences: list[str]) -> list[str]:
    return [
        line
        for sentence in sentences
        for line in textwrap.wrap(f"warning: {sentence}", 96, initial_indent="  ", subsequent_indent="    ")
    ]


def _frequency_lines(frequencies: FaultFrequencies, speed: float) -> list[str]:
    entries = [
        ("FTF", frequencies.ftf, "cage"),
        ("BPFO", frequencies.bpfo, "outer ring (cup), one row"),
        ("BPFI", frequencies.bpfi, "inner ring (cone), one row"),
        ("BSF", frequencies.bsf, "roller spin; a roller fault strikes twice as often"),
    ]
    lines = []
    for name, value, meaning in entries:
        hertz = f"{value * abs(speed) / 60.0:9.3f} Hz" if speed else ""
        lines.append(f"  {name:<5} {value:9.5f} {hertz}  {meaning}")
    return lines


def _static_lines(solution: StaticSolution) -> list[str]:
    move = ", ".join(f"{each:.2f}" for each in (solution.displacement * 1e6).round(2) + 0.0)  # no minus zero
    tilt = ", ".join(f"{each:.1f}" for each in (solution.tilt * 1e6).round(1) + 0.0)
    loaded = solution.loaded_roller_count
    lines = [
        f"  cone moves ({move}) µm and tilts ({tilt}) µrad about x, z",
        f"  {loaded[0]} rollers loaded inboard, {loaded[1]} outboard; "
        f"largest roller load {solution.largest_roller_load:,.1f} N",
        f"  largest Hertz pressure {solution.cup_pressure.max() * 1e-6:,.0f} MPa on the outer ring (cup), "
        f"{solution.cone_pressure.max() * 1e-6:,.0f} MPa on the inner ring (cone)",
        "",
        "  azimuth from +z (up) towards +x (forward); load on the cup, pressure in MPa",
        f"              row 0, inboard {'':<{_BAR_WIDTH + 2}} row 1, outboard",
    ]
    largest = max(solution.largest_roller_load, 1.0e-9)
    count = solution.cup_load.shape[1]
    for roller in range(count):
        cells = []
        for row in range(2):
            value = float(solution.cup_load[row, roller])
            bar = "#" * round(_BAR_WIDTH * value / largest)
            pressure = 1e-6 * float(solution.cup_pressure[row, roller])
            cells.append(f"{value:11,.1f} N {pressure:5,.0f} {bar:<{_BAR_WIDTH}}")
        lines.append(f"  {360.0 * roller / count:6.1f} deg {cells[0]} {cells[1]}".rstrip())
    for title, matrix in (
        ("tilt held", solution.stiffness_tilt_held),
        ("tilt free", solution.stiffness_tilt_free),
    ):
        lines += ["", f"  stiffness with {title}, MN/m (rows and columns x, y, z)"]
        lines += [
            "   " + " ".join(f"{value / 1e6 + 0.0:11.2f}" for value in line) for line in matrix.round(1)
        ]
    return lines


def _line_lines(roller: dict[str, Any], ends: str) -> list[str]:
    lines = [
        "",
        f"  along roller {roller['roller']} of row {roller['row']}, {ends}",
        "  place mm    cup N/mm    cup MPa   cone N/mm   cone MPa",
    ]
    columns = [
        values
        for ring in ("cup", "cone")
        for values in (roller[f"{ring}_load_per_length_N_per_m"] / 1e3, roller[f"{ring}_pressure_Pa"] / 1e6)
    ]
    for place, *cells in zip(roller["place_m"], *columns, strict=True):
        lines.append(f"  {place * 1e3:8.2f} " + " ".join(f"{value:11.1f}" for value in cells))
    return lines
