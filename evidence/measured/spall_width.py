"""How wide spalls of known width are found to be, on the twin.

Runs `service_high_speed_cup`.
``python -m evidence.measured.spall_width`` writes docs/evidence/spall_width.md.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from math import isnan

import numpy as np

import beardyn_core as bd
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.severity import Severity, severity_of
from beardyn_core.scene.patch import Patch
from evidence.pages import REPORTS, render
from evidence.tables import markdown

PAGE = REPORTS / "spall_width.md"
WIDTHS_MM = (0.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0)
PARTS = ("cup", "cone")
SECONDS = 1.2
ASKED_FROM = 3e-3  # widths that should be measurable, [m]


def measured(width_mm: float, on: str, tier: str, seed: int) -> Severity:
    """Simulate a spall of a width, none for 0, and measure it."""
    scene = bd.scene("service_high_speed_cup", tier=tier)
    spall = scene.defects[0]
    assert isinstance(spall, Patch)
    defects = (replace(spall, on=on, width=1e-3 * width_mm),) if width_mm else ()
    run = bd.simulate(replace(scene, defects=defects, seed=seed), duration=SECONDS)
    plate = NamePlate.of(scene.bearing)
    angle = np.interp(run.vibration.time_ns, run.shaft.time_ns, run.shaft.angle)
    order = plate.frequencies.bpfo if on == "cup" else plate.frequencies.bpfi
    return severity_of(run.vibration.values, run.vibration.rate, angle, on, order, plate)


def page(found: dict[tuple[str, float], list[Severity]], tier: str) -> str:
    """Write the page of what was measured, by part and width in mm, a measurement a seed."""
    seeds = max(len(each) for each in found.values())
    head = ("part", "width mm", *(f"found, interval {k + 1}" for k in range(seeds)))
    rows = [(on, f"{width:g}", *map(_cell, several)) for (on, width), several in found.items()]
    every = [(1e-3 * width, each) for (_, width), several in found.items() for each in several]
    spalls = [(width, each) for width, each in every if width and not isnan(each.width)]
    errors = [1e3 * abs(each.width - width) for width, each in spalls]
    asked = [each for width, each in every if width >= ASKED_FROM]
    values = {
        "tier": tier,
        "seconds": SECONDS,
        "found": markdown(head, rows, f"lr{'l' * seeds}"),
        "counted": len(spalls),
        "right": sum(each.low <= width <= each.high for width, each in spalls),
        "median": np.median(errors),
        "largest": max(errors),
        "asked": len(asked),
        "missed": sum(isnan(each.width) for each in asked),
        "false_widths": sum(not width and not isnan(each.width) for width, each in every),
    }
    return render(__file__, values)


def _cell(found: Severity) -> str:
    if isnan(found.width):
        return "-"
    return f"{1e3 * found.width:.1f} ({1e3 * found.low:.1f} to {1e3 * found.high:.1f})"


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tier", default="quasistatic")
    parser.add_argument("--seeds", type=int, default=2)
    args = parser.parse_args()
    found: dict[tuple[str, float], list[Severity]] = {}
    for on in PARTS:
        for width in WIDTHS_MM:
            found[on, width] = [measured(width, on, args.tier, seed) for seed in range(1, args.seeds + 1)]
            print(on, width, *(each.reason for each in found[on, width]), sep="\n  ", flush=True)
    PAGE.write_text(page(found, args.tier), encoding="utf-8")


if __name__ == "__main__":
    main()
