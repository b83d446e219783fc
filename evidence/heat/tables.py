"""The tables of the page as text."""

from __future__ import annotations

from collections.abc import Iterable

from beardyn_core.choice.steady_heat import SteadyHeat
from evidence.heat.cases import (
    MOUNTED_PLAY,
    NTN_LIGHT,
    NTN_STATE,
    SPEEDS_KMH,
    SPEEDS_RPM,
    SUPPLIED,
    VARIED,
    State,
    TorquePoint,
    of_car,
    of_class_k,
    on_the_rig,
    steady,
    torque_point,
)
from evidence.heat.published import (
    EMPTY,
    LIP_SEAL,
    LOW_TORQUE,
    MANIFEST,
    MODERN_TORQUE,
    NTN_LARGEST_RISE,
    NTN_RISE,
    RUSSIAN_CARS,
    STANDARD,
)
from evidence.tables import markdown

PARTS = ("axlebox", "cup", "cone", "grease")


def torques(points: Iterable[TorquePoint]) -> str:
    """Write torque against temperature and speed: SKF's, and ours by supply."""
    head = ["°C", "rpm", "SKF", "SKF with induced thrust", *(f"{name} (all)" for name in SUPPLIED)]
    rows = [
        [
            f"{each.temperature_c:g}",
            f"{each.speed_rpm:g}",
            f"{each.catalogue:.1f}",
            f"{each.catalogue_induced:.1f}",
            *(f"{each.contacts[name]:.1f} ({each.whole[name]:.1f})" for name in SUPPLIED),
        ]
        for each in points
    ]
    return markdown(head, rows)


def published_torques() -> str:
    """Write published torques of axlebox bearings beside ours at steady temperature."""
    rows = []
    for car in RUSSIAN_CARS:
        ours = of_car(car)
        torque = ours.power / ours.speed
        rows.append(
            [
                f"Russian freight car, {car.axle_load:g} t axle load, {car.speed_kmh:g} km/h",
                f"{car.torque:.2f} N m",
                f"{torque:.2f} N m",
                f"{torque / car.torque - 1.0:+.0%}",
            ]
        )
    modern = steady(VARIED[0], 80.0)
    torque = modern.power / modern.speed
    rows.append(
        [
            "10 % of the resistance of a wheelset, 2 to 2.5 N/kN, 80 kN",
            f"{MODERN_TORQUE:.1f} N m",
            f"{torque:.2f} N m (80 km/h)",
            f"{torque / MODERN_TORQUE - 1.0:+.0%}",
        ]
    )
    cases = [(axle, axle.seal_torque) for axle in (LOW_TORQUE, MANIFEST, STANDARD)]
    for axle, seal in [*cases, (STANDARD, LIP_SEAL), (EMPTY, EMPTY.seal_torque)]:
        ours = of_class_k(axle, seal)
        torque = ours.power / ours.speed
        rows.append(
            [
                f"North American freight car, class K, {axle.name}, {axle.speed_kmh:g} km/h",
                f"{axle.torque:.1f} N m",
                f"{torque:.1f} N m, {ours.power:.0f} W, box {ours.rise('axlebox'):.0f} K above the air; "
                f"seals of {seal:.1f} N m",
                f"{torque / axle.torque - 1.0:+.0%}",
            ]
        )
    for state in (NTN_STATE, NTN_LIGHT):
        rise = on_the_rig(state).rise("cup")
        words = "" if state is NTN_STATE else ": channelled, 0.5 % fill, seals of 0.05 N m"
        rows.append(
            [
                f"NTN rig, 120 x 220, 2216 rpm, outer ring above the air{words}",
                f"{NTN_RISE:.1f} K (largest {NTN_LARGEST_RISE:.1f})",
                f"{rise:.1f} K, {on_the_rig(state).power:.0f} W",
                f"{rise / NTN_RISE - 1.0:+.0%}",
            ]
        )
    return markdown(("published", "reference", "ours", "deviation"), rows)


def temperatures(states: Iterable[tuple[State, float, SteadyHeat]]) -> str:
    """Write steady temperatures above the air by state and speed."""
    head = ["state", "km/h", *(f"{part} [K]" for part in PARTS), "end play [um]", "torque [N m]", "power [W]"]
    rows = []
    for state, speed, found in states:
        cells = [f"{found.rise(part):.0f}" for part in PARTS]
        if not found.settles:
            cells = [f"> {cell}" for cell in cells]
        rows.append(
            [
                state.name if speed == SPEEDS_KMH[0] else "",
                f"{speed:g}",
                *cells,
                f"{1e6 * found.end_play:.0f}",
                f"{found.power / found.speed:.1f}",
                f"{found.power:.0f}" + ("" if found.settles else ", runs away"),
            ]
        )
    return markdown(head, rows)


def variations() -> str:
    """Write what every assumed input changes at every speed."""
    rows = []
    for state in VARIED:
        cells = [state.name]
        for speed in SPEEDS_KMH:
            found = steady(state, speed)
            more = "" if found.settles else "> "
            cells += [f"{more}{found.rise(part):.0f}" for part in ("axlebox", "cone")]
            cells.append(f"{found.power:.0f}")
        rows.append(cells)
    columns = ("box [K]", "cone [K]", "power [W]")
    head = [f"healthy ({1e3 * MOUNTED_PLAY:g} mm, settled), but"]
    head += [f"{speed:g} km/h: {column}" for speed in SPEEDS_KMH for column in columns]
    return markdown(head, rows)


def settled_range(temperature_c: float) -> tuple[float, float]:
    """Find the least and largest torque of all sources with settled grease at a temperature, [N m]."""
    whole = [torque_point(temperature_c, speed).whole["settled"] for speed in SPEEDS_RPM]
    return min(whole), max(whole)


def fresh_over_catalogue() -> tuple[float, float]:
    """Find the smallest and largest ratio of ours with fresh grease to SKF's from 40 °C and 600 rpm on."""
    ratios = [
        point.contacts["fresh"] / point.catalogue
        for point in (torque_point(t, n) for t in (40.0, 70.0, 100.0) for n in (600.0, 1165.0, 2000.0))
    ]
    return min(ratios), max(ratios)
