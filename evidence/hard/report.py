"""The battery's table and its JSON."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from beardyn_core.base.plain_json import strict_text
from evidence.hard.case import RUN_AS, HardCase
from evidence.hard.refinement import Change
from evidence.hard.verdict import FAILED, GOOD, KNOWN, SKIPPED, Outcome
from evidence.hard.watch import Measures

COLUMNS = (
    "case", "verdict", "energy residual", "penetration um", "chatter index", "frame error",
    "momentum residual", "status", "starts", "half the step", "wall s",
)  # fmt: skip


def cells(outcome: Outcome) -> tuple[str, ...]:
    """Write the cells of a row, in the order of `COLUMNS`."""
    m = outcome.measures
    frame = None if m.axis_error is None else max(m.axis_error, m.quaternion_error or 0.0)
    depth = None if m.penetration is None else f"{m.penetration * 1e6:.1f}"
    return (
        outcome.name,
        outcome.verdict,
        _number(m.energy_residual),
        depth or "-",
        _number(m.chatter_index),
        _number(frame),
        _number(m.momentum_residual),
        str(m.status),
        f"{outcome.held} of {outcome.starts}",
        worst_change(outcome.changes),
        f"{outcome.wall:.1f}",
    )


def _number(value: float | None) -> str:
    if value is None:
        return "-"
    return "NaN" if math.isnan(value) else f"{value:.1e}"


def worst_change(changes: Sequence[Change]) -> str:
    """Name the change that fills most of its band."""
    if not changes:
        return "-"
    worst = max(changes, key=lambda change: abs(change.change) / change.band)
    runs = "" if worst.runs == 1 else f", {worst.runs} runs each"
    name = worst.statistic.replace("_", " ")
    return f"{name} {100 * worst.change:+.2f} % of ±{100 * worst.band:.2f} %{runs}"


def line(outcome: Outcome) -> str:
    """Write a row for the terminal."""
    name, verdict, *numbers = cells(outcome)
    energy, depth, chatter, frame, momentum, status, starts, change, wall = numbers
    return (
        f"{name:28} {verdict:13} {energy:>8} {depth:>7} {chatter:>8} {frame:>8} {momentum:>8} {status:>3} "
        f"{starts:>6} {wall:>7}  {change}"
    )


HEAD = (
    f"{'case':28} {'verdict':13} {'energy':>8} {'um':>7} {'chatter':>8} {'frame':>8} {'momentum':>8} "
    f"{'st':>3} {'starts':>6} {'wall s':>7}  half the step (worst of {5} statistics)"
)


def details(case: HardCase, outcome: Outcome) -> list[str]:
    """List what a case says beyond its numbers."""
    lines = [f"    {reason}" for reason in outcome.reasons]
    if outcome.verdict == KNOWN:
        lines.append(f"    known: {case.known_failure}")
    if outcome.sentence and not outcome.reasons:
        lines.append(f'    says: "{outcome.sentence}"')
    return lines


def summary(outcomes: Sequence[Outcome]) -> str:
    """Count the verdicts of each kind."""
    counts = Counter(outcome.verdict for outcome in outcomes)
    order = (*GOOD, KNOWN, SKIPPED, FAILED)
    parts = [f"{counts[verdict]} {verdict}" for verdict in order if counts[verdict]]
    return f"{len(outcomes)} cases: {', '.join(parts)}"


def write_json(path: Path, cases: Sequence[HardCase], outcomes: Sequence[Outcome], **about: Any) -> None:
    """Write everything of cases and outcomes; numbers that are none become null."""
    found = [
        {
            "name": case.name,
            "topic": case.topic,
            "breaks": case.breaks,
            "guard": case.guard,
            "run_as": case.run_as,
            "how": RUN_AS[case.run_as],
            "fast": case.fast,
            "simulated_s": case.duration,
            "known_failure": case.known_failure,
            "limits": [asdict(limit) for limit in case.all_limits],
            "outcome": asdict(outcome),
        }
        for case, outcome in zip(cases, outcomes, strict=True)
    ]
    text = strict_text({**about, "cases": found}, indent=1)
    path.write_text(text + "\n", encoding="utf-8")


def outcome_from(stored: Mapping[str, Any]) -> Outcome:
    """Read an outcome that `write_json` wrote; null becomes NaN where a measure needs a number."""
    measures: dict[str, Any] = {
        name: math.nan if value is None and name in _NUMBERS else value
        for name, value in stored["measures"].items()
    }
    return Outcome(
        stored["name"], stored["verdict"], tuple(stored["reasons"]), Measures(**measures),
        tuple(Change(**change) for change in stored["changes"]), stored["sentence"], stored["wall"],
        stored["starts"], stored["held"],
    )  # fmt: skip


_NUMBERS = {name for name, value in asdict(Measures()).items() if isinstance(value, float)}
