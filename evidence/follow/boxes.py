"""Judge the shipped estimator in its own box, a stiffer one, another place: docs/evidence/estimator.md.

``python -m evidence.follow.boxes FOLDER``, a set that ``beardyn sweep high_speed_boxes -o FOLDER`` has made.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.config_folder import config_folder
from beardyn_core.follow.estimate_json import Estimates
from beardyn_core.follow.estimator import read_estimator
from beardyn_core.follow.labelled import Described, describe_runs
from beardyn_core.population.labelled_set import LabelledSet
from evidence.pages import REPORTS, with_section

PAGE = REPORTS / "estimator.md"
TITLE, NEXT = "## In other boxes\n", "## By size, speed, noise and box\n"
SHIPPED = config_folder() / "estimators" / "high_speed_axlebox.npz"
STIFFNESS, PLACE = "effects.structure.stiffness_factor", "sensors[0].position_mm"
NARROW, WIDE = 12e-3, 20e-3  # widths: wider than the second may not be reported as narrower than the first
COLUMNS = (
    *("box", "runs", "unlike", "condition named", "lateral load: given, median error, held"),
    *("end play: given, median error, held", "width: given, median error, held", "least: given, true"),
    "spalls below 12 mm, with a number",
)
HEAD = f"""{TITLE}
Written by `python -m evidence.follow.boxes FOLDER`: the shipped estimator on {{count}} runs of `quasistatic`
of the sweep `high_speed_boxes`. *Unlike*: the box or the sensor place is not one that was learnt from, so
that no numbers are given. *Given*: runs for which a number is reported; *held*: those whose interval of 90 %
holds the truth; *least*: "at least X mm", and how often that is true.

| {" | ".join(COLUMNS)} |
|---{"|--:" * (len(COLUMNS) - 1)}|
"""


def row_of(box: str, runs: Described, found: Sequence[Estimates], chosen: NDArray[np.bool_]) -> str:
    """Write the row of a box; `chosen`: which runs are in it."""
    mine = [each for each, inside in zip(found, chosen, strict=True) if inside]
    parts = [None if each.part is None else each.part.condition for each in mine]
    named = sum(part == truth for part, truth in zip(parts, runs.conditions[chosen], strict=True))
    true = runs.truth["width"][chosen]
    value = np.array([each["width"].value for each in mine])
    least = np.array([each["width"].at_least for each in mine])
    spalled, narrow = np.isfinite(true), true < NARROW
    cells = (
        box,
        len(mine),
        sum(each.strangeness > 1.0 for each in mine),
        named,
        _numbers("lateral_load", mine, runs.truth["lateral_load"][chosen], lambda off, _: off / 1e3, " kN"),
        _numbers("end_play", mine, runs.truth["end_play"][chosen], lambda off, _: off * 1e3, " mm"),
        _numbers("width", mine, true, lambda off, truth: 100.0 * off / truth, " %"),
        f"{np.isfinite(least).sum()} of {spalled.sum()}, {(least <= true).sum()}",
        f"{(narrow & np.isfinite(value)).sum()} of {narrow.sum()}",
    )
    return f"| {' | '.join(map(str, cells))} |\n"


def _numbers(
    name: str, found: Sequence[Estimates], truth: Float, error: Callable[[Float, Float], Float], unit: str
) -> str:
    value = np.array([each[name].value for each in found])
    given = np.isfinite(value) & np.isfinite(truth)
    ends = [each[name].intervals[-1] for each, inside in zip(found, given, strict=True) if inside]
    held = sum(low <= one <= high for (low, high), one in zip(ends, truth[given], strict=True))
    count = f"{given.sum()} of {np.isfinite(truth).sum()}"
    if not given.any():
        return count
    median = float(np.median(error(np.abs(value - truth)[given], truth[given])))
    return f"{count}, {median:.2g}{unit}, {held}"


def section(folder: Path) -> str:
    """Judge a set and write the section."""
    runs = LabelledSet(folder)
    known, estimator = describe_runs(runs, None), read_estimator(SHIPPED)
    found = [estimator.estimates(row[None]) for row in known.descriptors]
    labels = runs.labels_of(runs.runs_of(None), [STIFFNESS, PLACE])
    stiff = np.asarray(labels[STIFFNESS], np.float64) != 1.0
    moved = np.array([str(place) for place in labels[PLACE]])
    usual = "[0, 0, 170]"
    boxes = {
        "as learnt from": ~stiff & (moved == usual),
        "1.5 times as stiff": stiff & (moved == usual),
        "sensor on the cover": ~stiff & (moved != usual),
        "both": stiff & (moved != usual),
    }
    text = HEAD.format(count=len(found))
    text += "".join(row_of(box, known, found, chosen) for box, chosen in boxes.items() if chosen.any())
    true, value = known.truth["width"], np.array([each["width"].value for each in found])
    wide = true > WIDE
    wrong = (wide & (value < NARROW)).sum()
    sentence = f"Of {wide.sum()} spalls over 20 mm among them {wrong} are reported as a number below 12 mm."
    return f"{text}\n{sentence}\n\n"


def main(words: Sequence[str] | None = None) -> int:
    """Write the section of the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.boxes", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="set of the sweep high_speed_boxes")
    args = parser.parse_args(words)
    text = with_section(PAGE.read_text(encoding="utf-8"), TITLE, section(args.folder), NEXT)
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
