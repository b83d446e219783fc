"""Which roller sits in which lane of which block."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

BOTH_ROWS = 2


@dataclass(frozen=True)
class Arrangement:
    """Rollers in lanes: the first half of the lanes holds row 0, the second half row 1.

    With one lane each block is one roller, all of row 0 first; a bearing with one row has it in all lanes.
    Filler lanes at the end shadow the last roller of their row, and the lane of a missing roller shadows the
    roller before it: they go through the same numbers and are masked out of every sum.
    """

    roller_count: int  # rollers of each row when none is missing
    width: int  # lanes of a block: 1, or an even number
    rows: int = BOTH_ROWS  # rows that are there: 2, or 1 for row 0 alone
    missing: tuple[tuple[int, int], ...] = ()  # row and roller of those that are missing

    @property
    def group_count(self) -> int:
        """Count the groups of blocks that see the same rings: one, or one per row with a single lane."""
        return self.rows if self.width == 1 else 1

    @property
    def block_count(self) -> int:
        """Count the blocks of all groups."""
        if self.width == 1:
            return self.rows * self.roller_count
        return -(-self.roller_count // (self.width // self.rows))

    @property
    def row(self) -> NDArray[np.intp]:
        """Work out the row of each lane, shape [block, lane]."""
        rows = np.arange(self.rows)
        if self.width == 1:
            return np.repeat(rows, self.roller_count)[:, None]
        lane_row = np.repeat(rows, self.width // self.rows)
        return np.broadcast_to(lane_row, (self.block_count, self.width)).copy()

    @property
    def unbounded_roller(self) -> NDArray[np.intp]:
        """Number the rollers of the lanes, fillers counting on beyond the last roller, [block, lane]."""
        if self.width == 1:
            return np.tile(np.arange(self.roller_count), self.rows)[:, None]
        share = self.width // self.rows
        index = np.arange(self.block_count)[:, None] * share + np.arange(share)
        return np.tile(index, (1, self.rows))

    @property
    def present(self) -> NDArray[np.bool_]:
        """Check whether a roller is there, shape [row, roller]."""
        there = np.ones((self.rows, self.roller_count), dtype=bool)
        for row, roller in self.missing:
            there[row, roller] = False
        return there

    @property
    def stand_in(self) -> NDArray[np.intp]:
        """Find the roller that a place shows: its own, or the last before it that is there, [row, roller]."""
        before = np.where(self.present, np.arange(self.roller_count), -1)
        last = before.max(axis=1, keepdims=True)  # stands in for those before the first
        found = np.maximum.accumulate(before, axis=1)
        return np.where(found < 0, last, found)

    @property
    def roller(self) -> NDArray[np.intp]:
        """Work out the roller that each lane shows, shape [block, lane]."""
        return self.stand_in[self.row, np.minimum(self.unbounded_roller, self.roller_count - 1)]

    @property
    def mask(self) -> NDArray[np.float64]:
        """Mark each lane: 1 for a roller, 0 for one that shadows a roller, shape [block, lane]."""
        inside = self.unbounded_roller < self.roller_count
        there = self.present[self.row, np.minimum(self.unbounded_roller, self.roller_count - 1)]
        return (inside & there).astype(float)

    def to_lanes(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Spread values ``[row, roller]`` over ``[block, lane]``."""
        return np.ascontiguousarray(values[self.row, self.roller])

    def to_rollers(self, lanes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Collect values ``[..., block, lane]`` into ``[..., row, roller]``."""
        rollers = np.arange(self.roller_count)
        rows = range(self.rows)
        if self.width == 1:
            return np.stack([lanes[..., rollers + row * self.roller_count, 0] for row in rows], axis=-2)
        share = self.width // self.rows
        return np.stack(
            [lanes[..., rollers // share, rollers % share + row * share] for row in rows], axis=-2
        )


_LINE = 64  # bytes of a cache line


def aligned_zeros(*shape: int) -> NDArray[np.float64]:
    """Make zeros whose first number lies on a cache line's beginning; NumPy aligns to 16 bytes only."""
    size = math.prod(shape)
    room = np.zeros(size + _LINE // 8)
    first = -room.ctypes.data % _LINE // 8
    return room[first : first + size].reshape(shape)


def aligned_copy(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Copy an array so that it begins on a cache line."""
    copy = aligned_zeros(*values.shape)
    copy[...] = values
    return copy
