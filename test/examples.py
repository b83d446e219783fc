"""How many examples hypothesis draws.

The fast suite draws the same ones every time, so a few say what they can; the slow suite draws new ones.
"""

from __future__ import annotations

from hypothesis import settings


def examples(count: int) -> int:
    """Give the count of the slow suite, a third of it in the fast one."""
    return max(count // 3, 5) if settings().derandomize else count
