"""Write docs/evidence/hard.md from `make hard`: ``python -m evidence.hard.page hard.json``, or several."""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path
from typing import Any

from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, LARGEST_PENETRATION
from evidence.hard.case import RUN_AS
from evidence.hard.catalogue import CASES
from evidence.hard.report import cells, outcome_from
from evidence.hard.run import STARTS, WITHOUT_STARTS
from evidence.hard.verdict import FAILED, GOOD, KNOWN, SKIPPED
from evidence.pages import REPORTS, render
from evidence.runner import read_json

PAGE = REPORTS / "hard.md"


def main() -> None:
    """Read and write."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "numbers", type=Path, nargs="+", metavar="JSON", help="one run, or parts of it; of a case the last"
    )
    parts = [read_json(path) for path in parser.parse_args().numbers]
    PAGE.write_text(page(joined(parts)), encoding="utf-8")


def joined(parts: list[dict[str, Any]]) -> dict[str, Any]:
    """Join parts of the battery that were run apart, in the order of the catalogue."""
    found = {case["name"]: case for part in parts for case in part["cases"]}
    kernels = max(part["kernels"] for part in parts)
    return {
        **parts[-1],
        "kernels": kernels,
        "cases": [found[case.name] for case in CASES if case.name in found],
    }


def page(data: dict[str, Any]) -> str:
    """Put the whole page together."""
    cases = data["cases"]
    names = {case["name"] for case in cases}
    values = {
        "count": len(cases),
        "kernels": data["kernels"],
        "fast": sum(case["fast"] for case in cases),
        "summary": counted(cases),
        "run_as": list(RUN_AS.items()),
        "penetration": LARGEST_PENETRATION * 1e6,
        "chatter": LARGEST_CHATTER_INDEX,
        "left": ", ".join(f"`{case.name}`" for case in CASES if case.name not in names),
        "failing": failing(cases),
        "fewer": fewer_starts(cases),
        "chatter_rows": [chatter_row(row) for row in data["hidden_chatter"]],
        "topics": [
            section(topic, [case for case in cases if case["topic"] == topic])
            for topic in dict.fromkeys(case["topic"] for case in cases)
        ],
    }
    return render(__file__, values)


def counted(cases: list[dict[str, Any]]) -> str:
    """Count the verdicts of each kind."""
    counts = Counter(case["outcome"]["verdict"] for case in cases)
    found = [f"{counts[v]} {v}" for v in (*GOOD, KNOWN, SKIPPED, FAILED) if counts[v]]
    return f"{len(cases)} cases: {', '.join(found)}"


def failing(cases: list[dict[str, Any]]) -> list[str]:
    """List what fails or was skipped, and why."""
    return [
        f"- `{case['name']}`, {case['outcome']['verdict']}: {'; '.join(case['outcome']['reasons'])}."
        f"{' ' if case['known_failure'] else ''}{case['known_failure']}"
        for case in cases
        if case["outcome"]["verdict"] in (KNOWN, SKIPPED, FAILED)
    ]


def fewer_starts(cases: list[dict[str, Any]]) -> list[str]:
    """List what has fewer starts."""
    return [
        f"- `{case['name']}`: {case['outcome']['starts']} of {STARTS} starts was run."
        for case in cases
        if case["outcome"]["starts"] < STARTS and case["run_as"] not in WITHOUT_STARTS
    ]


def chatter_row(row: dict[str, Any]) -> tuple[str, ...]:
    """List the cells of a row of hidden chatter."""
    return (
        row["method"],
        f"{row['step'] * 1e6:g}",
        f"{row['mean']:.3f}",
        f"{row['scatter']:.1f}",
        f"{row['scatter_every_second']:.1f}",
        f"{row['index']:.2f}",
        "chatter" if row["status"] & 4 else "silent",
    )


def section(topic: str, cases: list[dict[str, Any]]) -> dict[str, Any]:
    """Give the numbers of the cases of a topic: what would break, and what was measured."""
    rows, sentences = [], []
    for case in cases:
        outcome = outcome_from(case["outcome"])
        name, *numbers, _wall = cells(outcome)
        rows.append((f"`{name}`", *numbers))
        if outcome.sentence and outcome.verdict in GOOD:
            sentences.append(f"- `{name}`: {outcome.sentence}")
    why = [(f"`{case['name']}`", case["breaks"], case["guard"], case["run_as"]) for case in cases]
    return {"title": topic.capitalize(), "why": why, "rows": rows, "sentences": sentences}


if __name__ == "__main__":
    main()
