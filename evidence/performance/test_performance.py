"""The page of the speeds says which goals were reached."""

from __future__ import annotations

from typing import Any

from benchmarks.runs import Table
from evidence.performance.page import goal_rows, page, report

MACHINE = {"processor": "P", "numba": "1", "python": "3", "load_average_before": 0.1, "python_loop_s": 0.5}


def test_the_page_says_what_was_reached() -> None:
    columns = ("run", "laminae", "RTF", "kernel us/step", "time against full standard")
    rows: list[tuple[str | float | int, ...]] = [
        ("full standard", 6, 1.5, 6.0, 1.0),
        ("full standard, chosen step", 6, 2.1, 6.0, 0.75),
        ("full standard, 20 laminae, chosen step", 20, 0.5, 18.0, 3.0),
        ("lumped standard", 6, 1200.0, 0.1, 0.01),
    ]
    start = Table("cold_start", "Start", ("part", "s"), [("to the first block", 2.0)])
    tables = [Table("real_time_factor", "RTF", columns, rows, "Of one run."), start]
    result: dict[str, Any] = {"machine": MACHINE, "tables": {table.name: table.to_json() for table in tables}}
    reached = [row[-1] for row in goal_rows(result["tables"])]
    assert reached == ["goal", "short of the floor", "floor", "goal", "goal"]
    assert "| cold start to the first block, s |" in page(result)
    assert "## Real time" not in page(result)  # what was not measured is not shown
    text = report(result)
    assert "| full standard, 20 laminae, chosen step | 20 | 0.5 | 18 | 3 |" in text
    assert "Of one run." in text
    assert "## Laminae" not in text
    assert "busy" not in text
    result["machine"] = {**MACHINE, "load_average_before": 3.0}
    assert "The machine was busy" in report(result)
