"""States of missing rollers and rows, so that the observer always has two complete rows.

Blocks always have two rows of all rollers, so that whatever reads them works with every bearing. The place of
a missing roller shows the motion of the roller that stands in for it (`bodies.arrangement`), turned into its
own pocket; a missing row shows the motion of the other as in a mirror. Neither touches anything: their
contacts are zero.
"""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.physics.bodies.arrangement import BOTH_ROWS, Arrangement
from beardyn_core.physics.bodies.layout import (
    ANGLE,
    ANGULAR,
    CAGE_BODY,
    CONTACT_OUTPUT,
    LINEAR,
    POSITION,
    TILT,
)


class Absence:
    """Completes states of a bearing in which something is missing, from the arrangement of what is there."""

    def __init__(self, arrangement: Arrangement) -> None:
        self.complete = Arrangement(arrangement.roller_count, arrangement.width)
        self._arrangement = arrangement
        there = np.zeros((BOTH_ROWS, arrangement.roller_count), dtype=bool)
        there[: arrangement.rows] = arrangement.present
        stand_in = np.stack([arrangement.stand_in[row % arrangement.rows] for row in range(BOTH_ROWS)])
        ahead = (np.arange(arrangement.roller_count) - stand_in) * 2.0 * math.pi / arrangement.roller_count
        self._ahead = self.complete.to_lanes(ahead)
        self._there = self.complete.to_lanes(there.astype(float))

    def complete_rows(self, rollers: Float, bodies: Float) -> tuple[Float, Float]:
        """Fill up the states of all rollers and bodies to two complete rows.

        Parameters
        ----------
        rollers : float64 array, shape [..., block, ROLLER_FIELDS, lane]
        bodies : float64 array, shape [..., 2 + row, BODY_STATES]

        Returns
        -------
        rollers, bodies : float64 arrays
        """
        fields = self._arrangement.to_rollers(np.moveaxis(rollers, -2, 0))
        if self._arrangement.rows < BOTH_ROWS:
            fields = np.concatenate([fields, fields], axis=-2)
            bodies = np.concatenate([bodies, _mirror_cage(bodies[..., CAGE_BODY:, :])], axis=-2)
        lanes = fields[..., self.complete.row, self.complete.roller]
        whole = np.ascontiguousarray(np.moveaxis(lanes, 0, -2))
        whole[..., ANGLE, :] += self._ahead
        whole[..., CONTACT_OUTPUT:, :] *= self._there[:, None, :]
        return whole, bodies


def _mirror_cage(cage: Float) -> Float:
    """Mirror a cage at the plane between the rows; both turn the same way."""
    image = cage.copy()
    for field in (POSITION + 1, LINEAR + 1, TILT, TILT + 2, ANGULAR, ANGULAR + 2):
        image[..., field] *= -1.0
    return image


def absence_of(arrangement: Arrangement) -> Absence | None:
    """Find the `Absence` of an arrangement; ``None`` when no roller is missing."""
    whole = arrangement.rows == BOTH_ROWS and not arrangement.missing
    return None if whole else Absence(arrangement)
