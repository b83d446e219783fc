"""`beardyn bearing`: geometry, fault frequencies, load distribution, stiffness and life of one bearing."""

from __future__ import annotations

import argparse
import math
import sys
import textwrap
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

from beardyn_core.api.statics import equilibrium, life
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.cli.bearing_options import operation_of
from beardyn_core.cli.generated_parser import add_parameter, parameters_of
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json
from beardyn_core.cli.quantities import NEGATIVE_QUANTITY

if TYPE_CHECKING:
    from beardyn_core.bearing.geometry import Bearing
    from beardyn_core.bearing.kinematics import FaultFrequencies
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.physics.statics.rating_life import RatingLife
    from beardyn_core.physics.statics.static import StaticSolution

_RINGS = {
    "elastic": "elastic rings: the cup bends in a housing with a wall of 25 mm",
    "rigid": "rigid rings: only the contacts yield",
}
_TEMPERATURE = parameters_of(life)["temperature_C"].default  # of the lubricant, [degrees Celsius]
_BAR_WIDTH = 22
_ENDS = ("from its inner to its outer end", "from its small to its large end")
_RPM = 2.0 * math.pi / 60.0


def add_parser(subparsers: Any) -> None:
    """Add the command to the subparsers of the command line."""
    parser = subparsers.add_parser(
        "bearing",
        help="compute geometry, fault frequencies, load distribution, stiffness, life",
        description="Geometry, fault frequencies, static load distribution, stiffness and life of a bearing. "
        "Numbers are in the units of scene files (kN, mm, rpm, degrees Celsius); another unit is written "
        "behind a number: 80000N, 0.1mm, 50Hz.",
    )
    # Before Python 3.14 argparse takes -1e-5 for an option.
    parser._negative_number_matcher = NEGATIVE_QUANTITY
    add_parameter(parser, equilibrium, "bearing", "bearing", metavar="BEARING")
    force = ("FX_KN", "FY_KN", "FZ_KN")
    add_parameter(parser, equilibrium, "load_kN", "--load", metavar=force, nargs=3, type=str, default=None)
    add_parameter(parser, equilibrium, "end_play_mm", "--end-play", metavar="MM", type=str)
    add_parameter(parser, equilibrium, "radial_clearance_mm", "--radial-clearance", metavar="MM", type=str)
    add_parameter(parser, equilibrium, "tilt")
    add_parameter(parser, equilibrium, "speed_rpm", "--speed", metavar="RPM", type=str, default="0")
    add_parameter(parser, equilibrium, "laminae", metavar="N")
    add_parameter(parser, equilibrium, "rings")
    without = "none, no film and no life"
    add_parameter(parser, life, "lubricant", metavar="NAME", default=None, usual=without)
    add_parameter(
        parser,
        life,
        "temperature_C",
        "--temperature",
        metavar="CELSIUS",
        default=None,
        usual=f"{_TEMPERATURE:g}",
    )
    add_parameter(parser, life, "contamination", metavar="EC")
    parser.add_argument(
        "--coupled-laminae",
        action="store_true",
        help="slices (laminae) sink with each other: edge load; default independent",
    )
    add_json(parser)
    parser.set_defaults(run=run)


@dataclass(frozen=True)
class _Case:
    """A bearing and what it is solved for, from the options."""

    args: argparse.Namespace
    bearing: A[RollerBearing, "with the radial clearance of the options"]
    load: A[tuple[float, float, float], "on the cone, [N]"]
    end_play: A[float | None, "``None`` where the bearing has none, [m]"]
    speed: A[float, "of the shaft, [rad/s]"]
    laminae: int

    @property
    def radial_clearance(self) -> float | None:
        """``None`` where the bearing has none, [m]."""
        clearance: float | None = getattr(self.bearing, "radial_clearance", None)
        return clearance


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.bearing.any_bearing import change_play
    from beardyn_core.bearing.life import load_doubts
    from beardyn_core.config import load_any_bearing
    from beardyn_core.effects import LaminaCoupling
    from beardyn_core.physics.modal_body import bending_rings
    from beardyn_core.physics.statics.rating_life import life_lines, life_object
    from beardyn_core.physics.statics.static import solve

    load, end_play, clearance, speed = operation_of(args)
    bearing, end_play = change_play(load_any_bearing(args.bearing), end_play, clearance)
    problem, doubt = load_doubts(bearing, load)
    if problem:
        raise InputError(f"--load: {problem}")
    if doubt:
        print(f"beardyn: warning: --load: {doubt}", file=sys.stderr)
    end_play = getattr(bearing, "end_play", None) if end_play is None else end_play
    laminae = bearing.usual_laminae if args.laminae is None else args.laminae
    case = _Case(args, bearing, load, end_play, speed, laminae)
    solution = solve(
        bearing,
        load,
        end_play=case.end_play,
        tilt=args.tilt,
        laminae=laminae,
        speed=speed,
        coupling=LaminaCoupling() if args.coupled_laminae else None,
        body=bending_rings(bearing, args.rings),
    )
    rated = _life(case)
    if args.json:
        report = _report(case, solution)
        print(json_text("bearing", {**report, "life": None if rated is None else life_object(rated)}))
    else:
        print(_table(case, solution))
        if rated is not None:
            print("\n".join(["", *life_lines(rated)]))
    return 0


def _life(case: _Case) -> RatingLife | None:
    """Rate the life under the load of the command line; ``None`` without a lubricant."""
    args = case.args
    if args.lubricant is None:
        return None
    from beardyn_core.config import load_lubricant
    from beardyn_core.physics.statics.rating_life import USUAL_CONTAMINATION, LoadClass, rating_life

    return rating_life(
        case.bearing,
        (LoadClass(1.0, case.load, (0.0, 0.0, 0.0), abs(case.speed)),),
        load_lubricant(args.lubricant),
        (_TEMPERATURE if args.temperature is None else args.temperature) + ZERO_CELSIUS,
        end_play=case.end_play,
        tilt=args.tilt,
        contamination=USUAL_CONTAMINATION if args.contamination is None else args.contamination,
    )


def _report(case: _Case, solution: StaticSolution) -> dict[str, Any]:
    """Gather the content of the JSON object."""
    from beardyn_core.bearing.kinematics import fault_frequencies

    return {
        "bearing": case.bearing.name,
        "geometry": _geometry(case.bearing),
        "fault_frequencies_per_rev": fault_frequencies(case.bearing).by_name,
        "static": {
            "applied_force_N": case.load,
            "end_play_m": case.end_play,
            "radial_clearance_m": case.radial_clearance,
            "tilt": case.args.tilt,
            "shaft_speed_rad_per_s": case.speed,
            "laminae": case.laminae,
            "rings": case.args.rings,
            "coupled_laminae": case.args.coupled_laminae,
            "displacement_m": solution.displacement,
            "tilt_rad": solution.tilt,
            "roller_load_N": solution.cup_load,
            "loaded_roller_count": sum(solution.loaded_roller_count),
            "loaded_roller_count_per_row": list(solution.loaded_roller_count),
            "largest_roller_load_N": solution.largest_roller_load,
            "largest_pressure_Pa": solution.largest_pressure,
            "roller_pressure_Pa": {
                "cup": solution.cup_pressure,
                "cone": solution.cone_pressure,
                "rib": solution.rib_pressure,
            },
            "rib_load_N": solution.rib_load,
            "most_loaded_roller": _most_loaded_roller(case.bearing, solution),
            "stiffness_tilt_held_N_per_m": solution.stiffness_tilt_held,
            "stiffness_tilt_free_N_per_m": solution.stiffness_tilt_free,
        },
    }


def _most_loaded_roller(bearing: RollerBearing, solution: StaticSolution) -> dict[str, Any]:
    """Compute load and Hertz pressure along the most loaded roller, to its large or outer end."""
    from beardyn_core.physics.lamina_table import lamina_places, lamina_pressure

    row, roller = divmod(int(solution.cup_load.argmax()), solution.cup_load.shape[1])
    count = solution.cup_lamina_load.shape[-1]
    report: dict[str, Any] = {"row": row, "roller": roller, "place_m": lamina_places(bearing, count)}
    for ring, loads in (("cup", solution.cup_lamina_load), ("cone", solution.cone_lamina_load)):
        load = loads[row, roller]
        report[f"{ring}_load_per_length_N_per_m"] = load * count / bearing.effective_length
        report[f"{ring}_pressure_Pa"] = lamina_pressure(bearing, load, ring)
    return report


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


# properties of a bearing with their unit, in the order of the JSON object
_SHARED = (
    *(("m", name) for name in ("bore", "outer_diameter", "width", "row_spacing", "pitch_diameter")),
    *(("m", name) for name in ("roller_diameter", "effective_length", "roller_length")),
    *(("rad", "contact_angle"), ("m", "cup_radius"), ("m", "cone_radius"), ("m", "radial_clearance")),
)
_GEOMETRY_OF_OTHERS = {
    "cylindrical": (
        *_SHARED,
        *(("m", name) for name in ("end_play", "roller_play", "cup_rib_height", "cone_rib_height")),
        *(("m", "rib_contact_height"), ("rad", "rib_opening"), ("m", "end_radius")),
    ),
    "spherical": (
        *_SHARED,
        *(("m", name) for name in ("sphere_radius", "roller_profile_radius", "cone_profile_radius")),
    ),
}
_MASSES = (
    ("m", "roller_web"),
    *(("kg", "roller_mass"), ("kg_m2", "roller_axial_inertia"), ("kg_m2", "roller_transverse_inertia")),
)
_GEOMETRY = (
    *(("m", name) for name in ("bore", "outer_diameter", "width", "row_spacing", "pitch_diameter")),
    *(("m", name) for name in ("roller_diameter", "effective_length", "roller_length")),
    *(("rad", name) for name in ("contact_angle", "cup_angle", "cone_angle", "half_angle")),
    *(("m", name) for name in ("apex_distance", "large_end_radius", "small_end_radius", "sphere_radius")),
    *(
        ("m", "rib_contact_height"),
        ("rad", "rib_angle"),
        ("m", "pressure_centre_spread"),
        ("m", "roller_web"),
    ),
    *(("kg", "roller_mass"), ("kg_m2", "roller_axial_inertia"), ("kg_m2", "roller_transverse_inertia")),
    ("m", "roller_mass_offset"),
)


def _geometry(bearing: RollerBearing) -> dict[str, Any]:
    from beardyn_core.bearing.life import dynamic_rating

    others = _GEOMETRY_OF_OTHERS.get(bearing.kind)
    return {
        "kind": bearing.kind,
        "roller_count": bearing.roller_count,
        "row_count": 2,
        **{
            f"{name}_{unit}": getattr(bearing, name)
            for unit, name in (_GEOMETRY if others is None else (*others, *_MASSES))
        },
        "gamma": bearing.gamma,
        "dynamic_load_rating_N": dynamic_rating(bearing).radial,
    }


def _table(case: _Case, solution: StaticSolution) -> str:
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
                _line_lines(_most_loaded_roller(bearing, solution), _ENDS[bearing.kind == "tapered"])
                if case.laminae > 1
                else []
            ),
        ]
    )


def _play_words(case: _Case) -> str:
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
