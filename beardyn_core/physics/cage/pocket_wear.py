"""What wear and scatter add to the clearance of each pocket."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.scene.defect import WornPocket
from beardyn_core.scene.scene import Scene


def added_clearance(scene: Scene) -> Float:
    """Work out what wear and scatter add to the clearance of each pocket, shape [row, roller], [m]."""
    added = np.zeros((2, scene.bearing.roller_count))
    for defect in scene.defects:
        if isinstance(defect, WornPocket):
            added[defect.row, defect.pocket] += defect.clearance
    if scene.scattered is not None:
        added = added + scene.scattered.deviations(scene.bearing).pocket_clearance
    return added


def pocket_wear_of(scene: Scene, arrangement: Arrangement) -> Float | None:
    """Take half of the clearance added to each pocket, [block, 2, lane], [m]; ``None`` without any.

    The first is along the pitch circle, from wear and scatter, the second at the ends, where a longer roller
    takes it.
    """
    if scene.scattered is None and not any(isinstance(defect, WornPocket) for defect in scene.defects):
        return None
    longer = np.zeros((2, arrangement.roller_count))
    if scene.scattered is not None:
        longer = scene.scattered.deviations(scene.bearing).roller_length
    halves = (0.5 * added_clearance(scene), -0.5 * longer)
    return np.stack([arrangement.to_lanes(half) for half in halves], axis=1)


@inline
def pocket_wear(lanes, block, pockets):
    """Work out the half of the clearance added to each roller's pocket along the pitch circle, [m]."""
    if pockets is None:
        return 0.0
    return lanes.load(pockets, block, 0)


@inline
def pocket_length(lanes, block, pockets):
    """Work out the half of the clearance added to each roller's pocket at its ends, [m]."""
    if pockets is None:
        return 0.0
    return lanes.load(pockets, block, 1)
