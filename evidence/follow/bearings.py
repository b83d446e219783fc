"""Judge the shipped estimators of every bearing by runs that none has learnt from, in docs/estimate.md.

``python -m evidence.follow.bearings DIR...``, sets of runs drawn from seeds of their own, such as
``beardyn sweep full.yaml --seed 3 --runs 60 -o DIR`` of the files that ``beardyn train --bearing`` writes.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.inference import doubt_of
from beardyn_core.follow.labelled import describe_runs, plate_of
from beardyn_core.follow.shipped import list_shipped
from beardyn_core.population.labelled_set import LabelledSet
from beardyn_core.population.training_sweep import LEARNT, MOST, TRUER
from evidence.follow.boxes import COLUMNS, row_of
from evidence.pages import DOCS, with_section

PAGE = DOCS / "estimate.md"
TITLE, NEXT = "## Any bearing, any axes\n", "## In other boxes\n"
HEAD = f"""{TITLE}
```bash
beardyn train --bearing METRO120x220              # shipped, FILE.yaml, or a recording with the bearing in it
beardyn train --bearing mine.yaml --sensor mems_50g --axes xz   # another sensor, other axes
beardyn estimate run.mcap                         # finds what was made so, before what is shipped
```

One command simulates {MOST[LEARNT]} runs of `quasistatic` and {MOST[TRUER]} of `full` of the bearing in the
service of its class (`freight_axlebox`, `high_speed_axlebox`, `metro_axlebox`; `--like` names another sweep)
and trains two estimators on them, for three axes and for z alone. Where the bearing is not that of the sweep,
loads go with the rating, spalls with the distance of two rollers, and the box is fitted to the cup
(`pip install '.[structure]'`). Called again, the command goes on where it was. The files lie in
`$BEARDYN_DATA_DIR/estimators` or `~/.local/share/beardyn/estimators`, their runs next to them. An estimate
without a fitting estimator names this command.

Written by `python -m evidence.follow.bearings DIR...`: the shipped estimators on runs of bearings that none
of them has learnt from or was calibrated with. Columns as [below](#in-other-boxes).

| {" | ".join(("estimator", *COLUMNS[1:]))} |
|---{"|--:" * (len(COLUMNS) - 1)}|
"""


def rows(folder: Path, known: Sequence[tuple[str, Estimator]]) -> Iterator[str]:
    """Judge the estimators of the bearing of a set by all of its runs, a row of the table each."""
    runs = LabelledSet(folder)
    for name, estimator in known:
        if doubt_of(estimator, plate_of(runs)):
            continue
        described = describe_runs(runs, None, estimator.axes)
        found = [estimator.estimates(row[None]) for row in described.descriptors]
        tier = runs.about["identity"]["base"]["tier"]
        words = f"`{name}`: {estimator.plate.name}, {', '.join(estimator.axes)}; runs of `{tier}`"
        yield row_of(words, described, found, np.ones(len(found), bool))


def section(folders: Sequence[Path]) -> str:
    """Judge sets and write the section."""
    known = [(path.stem, read_estimator(path)) for path in list_shipped()]
    return HEAD + "".join(row for folder in folders for row in rows(folder, known)) + "\n"


def main(words: Sequence[str] | None = None) -> int:
    """Write the section of the page."""
    parser = argparse.ArgumentParser(prog="python -m evidence.follow.bearings", description=__doc__)
    parser.add_argument("folder", type=Path, metavar="DIR", nargs="+", help="set of runs of one bearing")
    args = parser.parse_args(words)
    text = with_section(PAGE.read_text(encoding="utf-8"), TITLE, section(args.folder), NEXT)
    PAGE.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
