"""How many examples hypothesis draws, and which cases of a table the fast suite takes.

The fast suite draws the same ones every time, so a few say what they can; the slow suite draws new ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from hypothesis import settings


def examples(count: int) -> int:
    """Give the count of the slow suite, a third of it in the fast one."""
    return max(count // 3, 5) if settings().derandomize else count


def fast_ones(cases: Sequence[Any], *fast: int) -> list[Any]:
    """Mark every case of a table as slow but those at some places: they differ most, or take least."""
    return [
        case if place in fast else pytest.param(*_values(case), marks=pytest.mark.slow)
        for place, case in enumerate(cases)
    ]


def _values(case: Any) -> tuple[Any, ...]:
    return case if isinstance(case, tuple) else (case,)
