"""Write docs/evidence/heat.md and its picture: ``python -m evidence.heat.page`` (`make heat`)."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import matplotlib.pyplot as plt

from beardyn_core.config import load_lubricant
from evidence.heat.cases import (
    CLEARANCE,
    HEALTHY,
    OVERGREASED,
    PRELOADED,
    RUBBING,
    SPEED_OF_LIESER,
    SPEEDS_RPM,
    SUMMER,
    SUPPLIED,
    TEMPERATURES_C,
    VARIED,
    State,
    all_states,
    published_band,
    steady,
    torque_grid,
    torque_point,
    torque_without_stiffening,
)
from evidence.heat.intervals import at_speed, intervals, shares
from evidence.heat.published import (
    ALTRIOS,
    COEFFICIENTS,
    CONSTANT,
    FCALC,
    KESLER,
    LIESER,
    LIP_SEAL,
    NTN,
    RUSSIAN,
    SEALS,
    SHARE,
)
from evidence.heat.skf import BEARING_32216, OIL, row_moment
from evidence.heat.tables import (
    fresh_over_catalogue,
    published_torques,
    settled_range,
    temperatures,
    torques,
    variations,
)
from evidence.pages import PICTURES, REPORTS, save_small, write_page
from evidence.tables import markdown

PAGE = REPORTS / "heat.md"
PICTURE = PICTURES / "torque.png"
COLOURS = 32
SERVICE_RISE = 20.0  # of boxes in service, at least, [K]
MEASURED_32216 = ((500.0, 1.30), (2000.0, 2.95), (4000.0, 3.75))


def write() -> None:
    """Write page and picture."""
    draw(PICTURE)
    oil = 1e6 * load_lubricant("FVA3").kinematic_viscosity(323.15)
    over = [
        row_moment(BEARING_32216, 0.0, 6e3, speed, oil, OIL).total / measured
        for speed, measured in MEASURED_32216
    ]
    low, high = fresh_over_catalogue()
    band = published_band()
    ranges = {each: settled_range(each) for each in TEMPERATURES_C}
    reached = [
        (f"{each:g}", f"{least:.1f}", f"{most:.1f}", f"{least / band[0] - 1.0:+.0%}")
        for each, (least, most) in ranges.items()
    ]
    garter = next(state for state in VARIED if state.seal_torque == 1.2)
    values = {
        "published": published_torques(),
        "russian": RUSSIAN,
        "share": SHARE,
        "ntn": NTN,
        "fcalc": FCALC,
        "altrios": ALTRIOS,
        "lip": LIP_SEAL,
        "constant": CONSTANT,
        "least": 1e3 * min(COEFFICIENTS),
        "most": 1e3 * max(COEFFICIENTS),
        "band_low": band[0],
        "band_high": band[1],
        "settled": markdown(
            ("°C", "least [N m]", "largest [N m]", "least over the band's lower end"), reached
        ),
        "picture": f"../pictures/{PICTURE.name}",
        "torques": torques(torque_grid()),
        "low": low,
        "high": high,
        "ratio_low": min(over),
        "ratio_high": max(over),
        "temperatures": temperatures(all_states()),
        "bare_cold": _without_stiffening(-20.0),
        "bare_cool": _without_stiffening(0.0),
        "power_80": steady(HEALTHY, 80.0).power,
        "into_80": ", ".join(
            state.name for state in VARIED if round(steady(state, 80.0).rise("axlebox")) >= SERVICE_RISE
        ),
        "healthy_80": steady(HEALTHY, 80.0).rise("axlebox"),
        "healthy_200": steady(HEALTHY, 200.0).rise("axlebox"),
        "healthy_300": steady(HEALTHY, 300.0).rise("axlebox"),
        "summer": _in_summer(HEALTHY),
        "preloaded": _in_summer(PRELOADED),
        "kesler": KESLER,
        "lieser": LIESER,
        "lieser_speed": SPEED_OF_LIESER,
        "rubbing": steady(RUBBING, SPEED_OF_LIESER).rise("axlebox"),
        "clearance": steady(CLEARANCE, SPEED_OF_LIESER).rise("axlebox"),
        "overgreased": steady(OVERGREASED, SPEED_OF_LIESER).rise("axlebox"),
        "variations": variations(),
        "intervals": intervals(),
        "shares": shares(200.0),
        "warm_200": at_speed(200.0).warm_from(SUMMER) - 273.15,
        "warm_80": at_speed(80.0).warm_from(SUMMER) - 273.15,
        "seals": SEALS,
        "seal_200": steady(garter, 200.0).rise("cone") - steady(HEALTHY, 200.0).rise("cone"),
        "seal_300": steady(garter, 300.0).rise("cone") - steady(HEALTHY, 300.0).rise("cone"),
    }
    write_page(__file__, PAGE, values)


def _without_stiffening(temperature_c: float) -> float:
    """Find the least torque of settled grease with seals as at service temperature, [N m]."""
    return min(torque_without_stiffening(temperature_c, speed) for speed in SPEEDS_RPM)


def _in_summer(state: State) -> float:
    """Find the temperature of the box at 300 km/h in air of 40 °C, [°C]."""
    return steady(replace(state, thermal=(("ambient", SUMMER),)), 300.0).box - 273.15


def draw(target: Path) -> None:
    """Draw the torque of raceways and ribs against the speed, beside SKF's."""
    figure, axes = plt.subplots(1, 3, figsize=(11.0, 3.6), sharey=True, layout="constrained")
    for axis, temperature in zip(axes, (40.0, 70.0, 100.0), strict=True):
        points = [torque_point(temperature, speed) for speed in SPEEDS_RPM]
        for supply in SUPPLIED:
            axis.plot(SPEEDS_RPM, [each.contacts[supply] for each in points], "o-", ms=3, label=supply)
        axis.plot(SPEEDS_RPM, [each.catalogue for each in points], "k--", label="SKF")
        axis.set(title=f"{temperature:g} °C", xlabel="speed [rpm]", yscale="log")
        axis.set_yticks((2.0, 5.0, 10.0, 20.0, 40.0), ("2", "5", "10", "20", "40"))
        axis.set_yticks((), minor=True)
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("torque of raceways and ribs [N m]")
    axes[0].legend(fontsize=8)
    figure.savefig(target, dpi=110)
    plt.close(figure)
    save_small(target, target, COLOURS)


def main() -> int:
    """Write the page."""
    write()
    return 0


if __name__ == "__main__":
    sys.exit(main())
