"""The demonstration tells truth and estimate of every number, and the page has what it told."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from beardyn_core.follow.quantities import BY_NAME
from evidence.follow.demo import TRUTH, table
from evidence.follow.page import PAGE, with_table


def found(values: dict[str, float]) -> Any:
    """Make what following came to, each number within a tenth of its estimate."""
    told = {
        name: SimpleNamespace(
            quantity=BY_NAME[name],
            value=value,
            intervals=((0.95 * value, 1.05 * value), (0.9 * value, 1.1 * value)),
            reason="not identifiable",
        )
        for name, value in values.items()
    }
    estimates = type("Told", (dict,), {"part": SimpleNamespace(condition="cup")})(told)
    return SimpleNamespace(steps=[SimpleNamespace(estimates=estimates)])


def test_an_interval_without_the_truth_is_a_miss_and_what_is_not_told_has_its_reason() -> None:
    values = {**TRUTH, "width": 2.0 * TRUTH["width"], "depth": float("nan")}
    rows = table(found(values)).splitlines()
    assert rows[1].endswith("cup")
    assert [row.split()[0] for row in rows if row.endswith("missed")] == ["width"]
    assert rows[-1].endswith("not identifiable")


def test_the_page_has_a_place_for_the_table() -> None:
    page = with_table(PAGE.read_text(encoding="utf-8"), "nothing but this")
    assert "ended with\n\n```text\nnothing but this\n```" in page
