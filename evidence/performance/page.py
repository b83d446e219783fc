"""Write docs/performance.md and docs/evidence/speed.md from the numbers of `make bench`.

``python -m evidence.performance.page bench.json``
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

from evidence.pages import DOCS, REPORTS, render
from evidence.runner import read_json
from evidence.tables import markdown

PAGE, REPORT = DOCS / "performance.md", REPORTS / "speed.md"
FOR_USERS = ("right_answers", "paced", "train", "cold_start", "compiling")

# More than this and something else was running.
IDLE = 0.7

MISSED = ("short of the floor", "short of the goal")


def goal_rows(tables: dict[str, Any]) -> list[tuple[str, str, str, str, str]]:
    """List what is asked for: floor, goal, measured, and how far it came."""

    def of(table: str, key: str, name: str, column: str) -> float | None:
        rows = tables.get(table, {"rows": []})["rows"]
        return next((float(row[column]) for row in rows if row[key] == name and column in row), None)

    rows = []
    turns, node, desk = "RTF", "RTF alone", "RTF alone, desk"
    for what, name, column, floor, goal in (
        (
            "`full`, preset `standard`, 6 laminae, converged step: RTF",
            "full standard, chosen step",
            turns,
            1.2,
            2.0,
        ),
        ("the same with 20 laminae: RTF", "full standard, 20 laminae, chosen step", turns, 0.6, 1.0),
        ("the same with the usual step: RTF", "full standard", turns, 1.2, 2.0),
        *(
            (f"{tier}, {how}: RTF", f"{tier} standard", column, floor, goal)
            for tier, floor, goal in (("quasistatic", 20.0, 50.0), ("lumped", 300.0, 1000.0))
            for how, column in (
                ("a run on the desk", desk),
                ("a run in blocks of 20 ms", node),
                ("all runs in turn", turns),
            )
        ),
    ):
        found = of("real_time_factor", "run", name, column)
        if found is not None:
            came = "goal" if found >= goal else "floor" if found >= floor else MISSED[False]
            rows.append((what, f"{floor:g}", f"{goal:g}", f"{found:.3g}", came))
    for what, found, least, most in (
        ("cold start to the first block, s", of("cold_start", "part", "to the first block", "s"), 0.0, 3.0),
        ("compiling `standard`, s", of("compiling", "effects", "standard", "wall s"), 15.0, 8.0),
        ("compiling `full`, s", of("compiling", "effects", "full", "wall s"), 15.0, 8.0),
    ):
        if found is not None:
            came = "goal" if found < most else "floor" if found < least else MISSED[not least]
            rows.append((what, f"< {least:g}" if least else "", f"< {most:g}", f"{found:.3g}", came))
    fit = of("laminae", "effects", "standard", "R^2")
    if fit is not None:
        rows.append(
            ("cost linear in laminae, R^2", "", "0.99", f"{fit:.4f}", "goal" if fit > 0.99 else MISSED[True])
        )
    return rows


def shown(cell: Any) -> str:
    """Write a number with three significant digits."""
    if isinstance(cell, float):
        return f"{cell:.0f}" if abs(cell) >= 1000.0 else f"{cell:.3g}"
    return str(cell)


def page(result: dict[str, Any]) -> str:
    """Put the page for users together."""
    tables = result["tables"]
    values = {
        "machine": result["machine"],
        "goals": markdown(("", "floor", "goal", "measured", "reached"), goal_rows(tables)),
        "tables": {name: _table(table) for name, table in tables.items() if name in FOR_USERS},
    }
    return render(Path(__file__).parent / "users.md", values)


def report(result: dict[str, Any]) -> str:
    """Put the report together: every other table."""
    values = {
        "machine": result["machine"],
        "busy": result["machine"]["load_average_before"] > IDLE,
        "tables": {name: _table(table) for name, table in result["tables"].items() if name not in FOR_USERS},
    }
    return render(__file__, values)


def _table(table: dict[str, Any]) -> str:
    rows = [[shown(row[column]) for column in table["columns"]] for row in table["rows"]]
    note = f"\n\n{table['note']}" if table["note"] else ""
    return markdown(table["columns"], rows) + note


def main() -> None:
    """Read and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("numbers", type=Path, help="JSON file of make bench")
    found = read_json(parser.parse_args().numbers)
    PAGE.write_text(page(found), encoding="utf-8")
    REPORT.write_text(report(found), encoding="utf-8")


if __name__ == "__main__":
    main()
