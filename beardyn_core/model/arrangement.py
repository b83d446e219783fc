"""Which roller sits in which lane of which block."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Arrangement:
    """Rollers in lanes: the first half of the lanes holds row 0, the second half row 1.

    With one lane each block is one roller, all of row 0 first. Filler lanes at the end shadow the last
    roller of their row and are masked out of every sum.

    Parameters
    ----------
    roller_count : int
        Rollers of each row.
    width : int
        Lanes of a block: 1, or an even number.
    """

    roller_count: int
    width: int

    @property
    def group_count(self) -> int:
        """Groups of blocks that see the same rings: one, or one per row with a single lane."""
        return 2 if self.width == 1 else 1

    @property
    def block_count(self) -> int:
        """Blocks of all groups."""
        if self.width == 1:
            return 2 * self.roller_count
        return -(-self.roller_count // (self.width // 2))

    @property
    def row(self) -> NDArray[np.intp]:
        """Row of each lane, shape [block, lane]."""
        if self.width == 1:
            return np.repeat([0, 1], self.roller_count)[:, None]
        lane_row = np.repeat([0, 1], self.width // 2)
        return np.broadcast_to(lane_row, (self.block_count, self.width)).copy()

    @property
    def unbounded_roller(self) -> NDArray[np.intp]:
        """Roller index of each lane, fillers counting on beyond the last roller, shape [block, lane]."""
        if self.width == 1:
            return np.tile(np.arange(self.roller_count), 2)[:, None]
        half = self.width // 2
        index = np.arange(self.block_count)[:, None] * half + np.arange(half)
        return np.tile(index, (1, 2))

    @property
    def roller(self) -> NDArray[np.intp]:
        """Roller of each lane, fillers shadowing the last one, shape [block, lane]."""
        return np.minimum(self.unbounded_roller, self.roller_count - 1)

    @property
    def mask(self) -> NDArray[np.float64]:
        """1 for a roller, 0 for a filler, shape [block, lane]."""
        return (self.unbounded_roller < self.roller_count).astype(float)

    def to_lanes(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Spread values ``[row, roller]`` over ``[block, lane]``."""
        return np.ascontiguousarray(values[self.row, self.roller])

    def to_rollers(self, lanes: NDArray[np.float64]) -> NDArray[np.float64]:
        """Collect values ``[..., block, lane]`` into ``[..., row, roller]``."""
        rollers = np.arange(self.roller_count)
        if self.width == 1:
            return np.stack([lanes[..., rollers + row * self.roller_count, 0] for row in (0, 1)], axis=-2)
        half = self.width // 2
        return np.stack([lanes[..., rollers // half, rollers % half + row * half] for row in (0, 1)], axis=-2)
