"""How wide spalls of known width are found to be, on the twin.

``python -m evidence.measured.spall_width`` runs `service_high_speed_cup` and writes docs/spall_width.md.
"""

from __future__ import annotations

import argparse
from dataclasses import replace
from math import isnan

import numpy as np

import beardyn_core as bd
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.severity import Severity, severity_of
from beardyn_core.scene.defect import Patch
from evidence.pages import DOCS

PAGE = DOCS / "spall_width.md"
WIDTHS_MM = (0.0, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0)
PARTS = ("cup", "cone")
SECONDS = 1.2


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
    lines = [
        "# Widths of spalls",
        "",
        "Written by `python -m evidence.measured.spall_width`: `service_high_speed_cup` (200 "
        "km/h, a box that rings, "
        f"background of a driven axle, sensor by data sheet), tier `{tier}`, {SECONDS:g} s each, "
        "a seed a column; the "
        "spall 25 mm long on cup or cone. *-*: not measurable, which is the answer where no second event is "
        "clear. The line of the fault is taken as known, and 0 mm is a sound bearing.",
        "",
    ]
    seeds = max(len(each) for each in found.values())
    lines += [
        "| part | width mm | " + " | ".join(f"found, interval {k + 1}" for k in range(seeds)) + " |",
        "|---|--:|" + "---|" * seeds,
    ]
    right = counted = asked = false = 0
    errors = []
    for (on, width), several in found.items():
        cells = []
        for each in several:
            asked += width >= 3.0
            if isnan(each.width):
                cells.append("-")
                continue
            cells.append(f"{1e3 * each.width:.1f} ({1e3 * each.low:.1f} to {1e3 * each.high:.1f})")
            if width:
                counted += 1
                right += each.low <= 1e-3 * width <= each.high
                errors.append(abs(1e3 * each.width - width))
            else:
                false += 1
        lines.append(f"| {on} | {width:g} | " + " | ".join(cells) + " |")
    lines += [
        "",
        f"Of {counted} measured widths {right} lie within their interval, which says 95 %; the error is "
        f"{np.median(errors):.2f} mm in the median and {max(errors):.2f} mm at most. Of {asked} "
        "spalls from 3 mm on "
        f"{asked - sum(not isnan(e.width) for (_, w), s in found.items() if w >= 3.0 for e in s)} "
        "were not measurable; "
        f"of sound bearings {false} were given a width.",
        "",
        "The relation of way and width comes from runs of the same twin in the tier `full` "
        "([impact.md](impact.md)), "
        "so this shows what the signal processing loses, and not what a train does.",
        "",
    ]  # fmt: skip
    return "\n".join(lines)


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
