"""Judge the shipped estimators by spalls of 20 to 40 mm: docs/evidence/estimator.md.

``python -m evidence.follow.very_wide FOLDER`` simulates runs like those of the sweep `high_speed_hidden`, all
with such a spall, in tiers `quasistatic` and `full`, keeps them in FOLDER, and writes a section of the page.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import beardyn_core as bd
from beardyn_core.base.arrays import Float
from beardyn_core.base.config_folder import config_folder
from beardyn_core.config import load_plate
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.follow.estimator import Estimates, read_estimator
from beardyn_core.follow.labelled import describe_runs
from beardyn_core.follow.wide_spall import RACEWAYS
from beardyn_core.monitor.severity import spacing_of
from beardyn_core.population.labelled_set import LabelledSet
from evidence.follow.boxes import NARROW, PAGE, WIDE
from evidence.follow.boxes import TITLE as NEXT
from evidence.pages import with_section

TITLE = "## Spalls of 20 to 40 mm\n"
LIKE, BEARING, SEED = "high_speed_hidden", "HS130x230", 4600
LEARNT, WIDEST = 40e-3, 40e-3  # widest spall learnt from, and of these runs, [m]
RUNS = {"quasistatic": 48, "full": 24}
SHIPPED = {"x, y, z": "high_speed_axlebox.npz", "z": "high_speed_axlebox_z.npz"}
COLUMNS = (
    *("tier", "estimator", "runs", "part named", "number", "of these held, below 12 mm"),
    *("at least X mm", "of these true", "neither"),
)
HEAD = f"""{TITLE}
Written by `python -m evidence.follow.very_wide FOLDER`: the shipped estimators on runs like those of
`{LIKE}`, all with a spall of {1e3 * WIDE:.0f} to {1e3 * WIDEST:.0f} mm on cup or cone; they have
learnt from spalls up to {1e3 * LEARNT:.0f} mm. Two rollers are {{cup:.0f}} mm apart on the cup and
{{cone:.0f}} mm on the cone. *Number*: a width is reported; *held*: its interval of 90 % holds the truth;
*neither*: no width, with the reason.

| {" | ".join(COLUMNS)} |
|---|---{"|--:" * (len(COLUMNS) - 2)}|
"""


def keys_of(tier: str, runs: int) -> dict[str, Any]:
    """Give the keys of the sweep of a tier."""
    keys = read_file(find("sweeps", LIKE))
    spalls = next(each for each in keys["vary"] if each["key"] == "defects")
    width = next(each for each in keys["vary"] if each["key"] == "defects[0].width_mm")
    spalls["one_of"], spalls["weights"] = spalls["one_of"][1:], spalls["weights"][1:]
    width["low"], width["high"] = 1e3 * WIDE, 1e3 * WIDEST
    keys["set"]["tier"] = tier
    return {**keys, "sweep": f"{LIKE}, very wide, {tier}", "runs": runs, "seed": SEED}


def row_of(
    tier: str, axes: str, width: Float, conditions: NDArray[np.str_], found: Sequence[Estimates]
) -> str:
    """Write the row of an estimator in a tier."""
    value = np.array([each["width"].value for each in found])
    least = np.array([each["width"].at_least for each in found])
    given, bounded = np.isfinite(value), np.isfinite(least)
    ends = [each["width"].intervals[-1] for each, inside in zip(found, given, strict=True) if inside]
    held = sum(low <= true <= high for (low, high), true in zip(ends, width[given], strict=True))
    parts = ["" if each.part is None else each.part.condition for each in found]
    named = sum(part == truth for part, truth in zip(parts, conditions, strict=True))
    below = int((value[given] < NARROW).sum())
    cells = (
        *(tier, axes, len(found), named, given.sum(), f"{held}, {below}"),
        *(bounded.sum(), (least[bounded] <= width[bounded]).sum(), (~given & ~bounded).sum()),
    )
    return f"| {' | '.join(map(str, cells))} |\n"


def section(folder: Path, workers: int | None, runs: dict[str, int]) -> str:
    """Simulate, judge and write the section."""
    plate = load_plate(BEARING)
    cup, cone = (1e3 * spacing_of(part, plate) for part in RACEWAYS)
    text = HEAD.format(cup=cup, cone=cone)
    wrong: list[str] = []
    below = count = 0
    for tier, number in runs.items():
        bd.sweep(keys_of(tier, number), folder / tier, workers=workers, progress=True)
        for axes, name in SHIPPED.items():
            estimator = read_estimator(config_folder() / "estimators" / name)
            known = describe_runs(LabelledSet(folder / tier), None, estimator.axes)
            found = [estimator.estimates(row[None]) for row in known.descriptors]
            width = known.truth["width"]
            text += row_of(tier, axes, width, known.conditions, found)
            for each, true, part in zip(found, width, known.conditions, strict=True):
                size = each["width"]
                count += 1
                below += bool(size.value < NARROW)
                if size.value < NARROW or size.at_least > true:
                    wrong.append(f"{part} {1e3 * true:.1f} mm, {axes}: {size.sentence}")
    told = (
        f"A number below {1e3 * NARROW:.0f} mm is reported of {below} of these {count} spalls, each counted "
        "once for each estimator."
    )
    if not wrong:
        return f"{text}\n{told}\n\n"
    listed = "".join(f"- {each}\n" for each in wrong)
    return f"{text}\n{told} Wrong are:\n\n{listed}\n"


def main(words: Sequence[str] | None = None) -> int:
    """Write the section of the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.very_wide", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="keeps the runs")
    parser.add_argument("--workers", type=int, help="processes; default one for each core")
    parser.add_argument("--quasistatic", type=int, default=RUNS["quasistatic"], help="runs of that tier")
    parser.add_argument("--full", type=int, default=RUNS["full"], help="runs of that tier")
    args = parser.parse_args(words)
    args.folder.mkdir(parents=True, exist_ok=True)
    runs = {"quasistatic": args.quasistatic, "full": args.full}
    text = section(args.folder, args.workers, {tier: count for tier, count in runs.items() if count})
    print(text)
    PAGE.write_text(with_section(PAGE.read_text(encoding="utf-8"), TITLE, text, NEXT), encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
