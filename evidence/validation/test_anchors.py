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
    assert anchor.agrees(ours) is (anchor.misses == ""), f"{ours} {anchor.unit} against {anchor.reference}"


def test_anchors_are_told_apart() -> None:
    rows = [(anchor.topic, anchor.quantity) for anchor in ANCHORS]
    assert len(rows) == len(set(rows))
