"""Every published number on the validation page, with its source and tolerance."""

from __future__ import annotations

import pytest

from evidence.validation.anchor import Anchor
from evidence.validation.every import ANCHORS


def cases() -> list[object]:
    return [
        pytest.param(
            anchor,
            id=f"{anchor.topic}-{anchor.quantity}",
            marks=[pytest.mark.slow] if anchor.slow else [],
        )
        for anchor in ANCHORS
    ]


@pytest.mark.parametrize("anchor", cases())
def test_ours_agrees_with_the_published_number_or_misses_as_the_page_says(anchor: Anchor) -> None:
    ours = anchor.ours()
    as_told = anchor.agrees(ours) is (anchor.misses == "")
    assert as_told or not anchor.is_certain(ours), f"{ours} {anchor.unit} against {anchor.reference}"


@pytest.mark.parametrize(("ours", "certain"), [(4.1, True), (4.19, False), (4.25, False), (4.3, True)])
def test_only_a_verdict_that_another_draw_could_turn_is_left_open(ours: float, certain: bool) -> None:
    anchor = Anchor("a", "b", 4.9, "", "c", lambda: ours, absolute=0.7, by_chance=0.08)
    assert anchor.is_certain(ours) is certain
    assert all(each.by_chance <= 0.2 * each.allowed for each in ANCHORS)


def test_anchors_are_told_apart() -> None:
    rows = [(anchor.topic, anchor.quantity) for anchor in ANCHORS]
    assert len(rows) == len(set(rows))
