"""The validation page shows every anchor and every trend as they stand in its modules."""

from __future__ import annotations

from pathlib import Path
from types import FunctionType
from typing import Any

import pytest

from evidence.validation.anchor import HOLDS_FROM, Anchor, Trend, falls, rises, turns
from evidence.validation.every import ANCHORS, TRENDS, UNREACHED
from evidence.validation.page import OTHERS, reference_cells, trends_anew, unreached_line

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "evidence" / "validation.md").read_text(encoding="utf-8")
LINES = PAGE.splitlines()
LARGEST_PICTURE = 60_000
BESIDE = {f"evidence.validation.{name}" for name in ("ball_contact", "load_zone", "zhang")}


@pytest.mark.parametrize("anchor", ANCHORS, ids=lambda anchor: f"{anchor.topic}-{anchor.quantity}")
def test_page_lists_the_anchor_once_with_its_reference_and_verdict(anchor: Anchor) -> None:
    start = "| " + " | ".join(reference_cells(anchor)) + " | "
    found = [line for line in LINES if line.startswith(start)]
    assert len(found) == 1, "run make validation"
    assert found[0].endswith(f" | {anchor.source} |")
    assert (f"**misses**: {anchor.misses} |" if anchor.misses else "| agrees |") in found[0]


@pytest.mark.parametrize("trend", TRENDS, ids=lambda trend: f"{trend.topic}-{trend.claim}")
def test_page_has_a_paragraph_for_the_trend_with_its_verdict_and_picture(trend: Trend) -> None:
    start = LINES.index(f"### {trend.topic}: {trend.claim}")
    verdict, source = LINES[start + 2], LINES[start + 4]
    ending = f"Verdict: **does not hold**: {trend.misses}." if trend.misses else "Verdict: holds."
    assert verdict.endswith(ending)
    assert source == f"Source: {trend.source}."
    if trend.picture:
        assert f"(../pictures/{trend.picture})" in LINES[start + 6]
        assert (ROOT / "docs" / "pictures" / trend.picture).stat().st_size < LARGEST_PICTURE


def test_page_lists_nothing_else() -> None:
    rows = [line for line in LINES if line.startswith("| ")]
    assert len(rows) == len(ANCHORS) + 2
    beside = LINES.index("## Formulas that the simulator does not use")
    assert sum(line.startswith("| ") for line in LINES[beside:]) == 1 + sum(each.beside for each in ANCHORS)
    assert sum(line.startswith("### ") for line in LINES) == len(TRENDS)
    shown = LINES[LINES.index("## Not compared") + 2 :]
    assert shown == [unreached_line(label, why) for label, why in UNREACHED]


@pytest.mark.parametrize("anchor", ANCHORS, ids=lambda anchor: f"{anchor.topic}-{anchor.quantity}")
def test_a_row_counts_only_where_the_simulator_makes_the_number(anchor: Anchor) -> None:
    in_the_rail_model_alone = anchor.topic == "axlebox vibration" and anchor.quantity.startswith("lateral")
    assert anchor.beside == (in_the_rail_model_alone or reaches_beside(anchor.ours, set()))


def reaches_beside(function: Any, seen: set[Any]) -> bool:
    """Whether a function calls, itself or through others, a model that stands beside the simulator."""
    function = getattr(function, "__wrapped__", getattr(function, "func", function))
    if not isinstance(function, FunctionType) or function in seen:
        return False
    seen.add(function)
    if function.__module__ in BESIDE:
        return True
    names = set(function.__code__.co_names) | set(function.__code__.co_freevars)
    called = [function.__globals__[name] for name in names if name in function.__globals__]
    called += [cell.cell_contents for cell in function.__closure__ or ()]
    return any(reaches_beside(each, seen) for each in called)


@pytest.mark.parametrize(
    ("values", "rising", "falling"),
    [
        ((1.0, 1.02, 1.029), False, False),
        ((1.0, 1.02, 1.04), True, False),
        ((1.04, 1.02, 1.0), False, True),
        ((1.0, 0.98, 1.04), True, False),
        ((1.0, 0.96, 1.1), False, False),
    ],
)
def test_a_change_below_the_threshold_is_none(values: tuple[float, ...], rising: bool, falling: bool) -> None:
    assert HOLDS_FROM == 0.03
    assert rises(values) is rising
    assert falls(values) is falling


@pytest.mark.parametrize(
    ("values", "turning"),
    [
        ((1.0, 1.02, 1.04, 1.06), False),
        ((1.0, 1.05, 1.0), True),
        ((1.0, 0.95, 1.0), True),
        ((1.0, 1.02, 1.04, 1.02, 1.0), True),
        ((1.0, 1.02, 1.0), False),
        ((1.1, 1.0, 0.9, 0.92), False),
    ],
)
def test_what_goes_up_and_down_turns(values: tuple[float, ...], turning: bool) -> None:
    assert turns(values) is turning
    assert turns(values[::-1]) is turning


def test_writing_no_topic_anew_leaves_the_trends_as_they_are() -> None:
    section = LINES[LINES.index("## Trends") : LINES.index(OTHERS)]
    section = section[next(at for at, line in enumerate(section) if line.startswith("### ")) :]
    written, held = trends_anew(section, [])
    assert "\n".join(written) == "\n".join(section)
    assert f"{held} of {len(TRENDS)} published trends are reproduced." in PAGE
