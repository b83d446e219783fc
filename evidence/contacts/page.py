"""Write docs/evidence/contacts.md and its pictures from a run of the contact laboratory.

``beardyn contacts -o DIR``, on an idle machine, for the page holds processor times; then
``python -m evidence.contacts.page DIR [--to FOLDER]``. The text between the two marks of the runs of
Santos (2017) on the page stays as it is.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from beardyn_core.laboratory.contacts_report import TWIN_EVALUATIONS
from beardyn_core.study.table import Table, digits, duration_text
from evidence.pages import DOCS, render, save_small
from evidence.runner import read_json

PICTURES = ("contacts_nine.png", "contacts_sphere.png", "contacts_rolling.png", "contacts_barrel.png")
COLOURS = 64
BEGIN, END = "<!-- the runs of Santos (2017) -->", "<!-- end of the runs of Santos (2017) -->"
NO_RUNS = "Not yet on this page."


def table_of(entry: dict[str, Any]) -> Table:
    """Read a table of the JSON."""
    return Table(
        entry["title"],
        tuple(entry["head"]),
        tuple(tuple(row) for row in entry["rows"]),
        tuple(entry["remarks"]),
    )


def kept_runs(page: Path) -> str:
    """Read what the page says of the runs of Santos (2017)."""
    if not page.exists():
        return NO_RUNS
    text = page.read_text(encoding="utf-8")
    if BEGIN not in text or END not in text:
        return NO_RUNS
    return text.split(BEGIN, 1)[1].split(END, 1)[0].strip()


def page_text(found: dict[str, Any], runs: str) -> str:
    """Put the whole page together."""
    names = ("located", "methods", "contacts", "run", "forms", "shapes", "spheres", "rolling", "barrel")
    time = {entry["method"]: entry["time_s"] for entry in found["whole_bearing"]}
    analytic = time["analytic Newton, compiled"]
    values = {
        "machine": found["machine"],
        "evaluations": found["evaluations"],
        "searches": found["searches_per_evaluation"],
        "compiled": digits(time["analytic Newton, plain"] / analytic, 2),
        "closed": digits(analytic / time["closed form, compiled"], 2),
        "twin": TWIN_EVALUATIONS,
        "fastest": duration_text(found["whole_bearing"][-1]["run_s"] / 3600.0),
        "runs": runs,
        **dict(zip(names, map(table_of, found["tables"]), strict=True)),
    }
    return render(__file__, values)


def main() -> None:
    """Write the page."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, help="that `beardyn contacts -o` wrote")
    parser.add_argument("--to", type=Path, default=DOCS, metavar="FOLDER")
    arguments = parser.parse_args()
    source = arguments.folder / "contacts.json"
    if not source.exists():
        sys.exit(f"{source} does not exist: run `beardyn contacts -o {arguments.folder}` first")
    found = read_json(source)
    pictures = arguments.to / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    for name in PICTURES:
        save_small(arguments.folder / name, pictures / name, COLOURS)
    page = arguments.to / "evidence" / "contacts.md"
    page.parent.mkdir(exist_ok=True)
    page.write_text(page_text(found, kept_runs(page)), encoding="utf-8")


if __name__ == "__main__":
    main()
