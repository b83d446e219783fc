"""Write what the data cards of the shipped estimators say into docs/estimate.md.

``python -m evidence.follow.bearings``; each card has what runs say that the estimator has not learnt from.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.quantities import BY_NAME
from beardyn_core.follow.shipped import list_shipped
from beardyn_core.population.training_sweep import LEARNT, MOST, TRUER
from evidence.pages import DOCS, write_section

PAGE = DOCS / "estimate.md"
TITLE, NEXT = "## Any bearing, any axes\n", "## An estimator of your own\n"
SHOWN = ("vertical_load", "lateral_load", "end_play", "width", "length")
COLUMNS = ("shipped estimator", "axes", "condition: right, held", *(name.replace("_", " ") for name in SHOWN))
HEAD = f"""{TITLE}
```bash
beardyn train --bearing METRO120x220              # shipped, FILE.yaml, or a recording of it
beardyn train --bearing my.yaml --sensor mems_50g --axes xz   # another sensor, other axes
beardyn estimate run.mcap                         # takes the new estimator
```

One command simulates {MOST[LEARNT]} runs of `quasistatic` and {MOST[TRUER]} of `full` in the service of the
class (below; `--like` names another sweep) and trains one estimator for three axes and one for z alone, in
30 to 90 min of one core, longest for a cylindrical pair. For a bearing of other size the loads go with the
rating, the spalls with the distance of two rollers, and the box is fitted to the cup
(`pip install '.[structure]'`). The same command goes on after an interruption. Estimators lie in
`$BEARDYN_DATA_DIR/estimators` or `~/.local/share/beardyn/estimators`, their runs next to them. An estimate
without a fitting estimator names this command.

| class | kind of bearing | runs differ in |
|---|---|---|
| `freight_axlebox`, `high_speed_axlebox`, `metro_axlebox` | tapered | end play, a quantity of the estimator |
| `freight_cylindrical_axlebox`, `locomotive_axlebox` | cylindrical pair | radial clearance, not estimated |
| `freight_spherical_axlebox` | spherical | radial clearance, not estimated |

Radial clearances are those of classes CN to C5, less the fits. No other play of these kinds is varied.

An estimator is for one kind of bearing: a bearing of another kind with the same rollers is refused. Bearing
data typed by hand have no kind; they are compared by number and diameters of the rollers alone.

Chosen is the estimator of most axes among those whose axes are all measured, of equals your own, and of these
the newest: by commands, Python, the fleet and the node `follower`. The node chooses with the first vibration,
and anew where further axes come before the first stretch is whole; from then on an axis that stays away is a
doubt in its diagnostics.

The shipped estimators, judged crosswise by runs of `full` of bearings that were not learnt from: runs with a
number, their median error, and how many of them the 90 % interval holds. By `python -m
evidence.follow.bearings`:

| {" | ".join(COLUMNS)} |
|---|---{"|--:" * (len(COLUMNS) - 2)}|
"""


def row_of(name: str, estimator: Estimator) -> str:
    """Write the row of an estimator."""
    card = estimator.card
    judge = card["condition"]
    right = f"{100 * judge['named']:.0f} %, {100 * judge['coverage'][-1]:.0f} % of {judge['runs']}"
    cells = (
        f"`{name}`",
        ", ".join(estimator.axes),
        right,
        *(_cell(card["quantities"], each) for each in SHOWN),
    )
    return f"| {' | '.join(cells)} |\n"


def _cell(quantities: Mapping[str, Any], name: str) -> str:
    test = quantities.get(name, {}).get("test")
    if test is None:
        return "-"
    quantity = BY_NAME[name]
    error = f"{100 * test['error']:.0f} %" if quantity.relative else quantity.width_text(test["error"])
    return f"{test['runs']}: {error}, {100 * test['coverage'][-1]:.0f} %"


def section() -> str:
    """Write the section."""
    return HEAD + "".join(row_of(path.stem, read_estimator(path)) for path in list_shipped()) + "\n"


if __name__ == "__main__":
    write_section(PAGE, TITLE, section(), NEXT)
