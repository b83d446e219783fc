"""Friction of raceway contacts at the rate of its change: worked out in every few steps, held in between.

Film and traction of a lamina change with its load, the slip and the speed that draws the oil in, all slower
than a contact's springs bounce. In between a lamina rubs with the coefficient of the last time, friction over
slip speed and load: the friction still follows its load and the slip of each step, and the step stays
implicit in it. Rolling resistance is held whole. Where a roller of a block has just begun to press, or is
near a patch, friction is worked out.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.layout import HELD_COEFFICIENT, HELD_COUPLE, HELD_FROM
from beardyn_core.physics.lanes.lane_math import where_greater
from beardyn_core.physics.lanes.lanes import any_positive


class Held(NamedTuple):
    """What is held of one raceway contact."""

    lanes: Any
    params: Any  # HeldParams, None where friction is worked out in every step
    page: int  # of the contact in its memory
    recalled: bool  # friction is that of the memory


@inline
def is_fresh(step, held):
    """Check whether friction is worked out in a step of a block, however the contacts are."""
    if held is None:
        return False
    return step % int(held.steps) == 0


@inline
def hold_contact(lanes, block, ring, anew, approach, held):
    """Decide whether friction is that of the memory, at an approach of the middle [m]: a `Held`."""
    return Held(lanes, held, 2 * block + ring, _is_recalled(lanes, 2 * block + ring, anew, approach, held))


@inline
def _is_recalled(lanes, page, anew, approach, held):
    if held is None:
        return False
    if anew:
        return False
    pressed = lanes.load(held.memory, page, HELD_FROM)
    begun = where_greater(approach, 0.0, 1.0 - pressed, 0.0 * pressed)
    return any_positive(pressed) and not any_positive(begun)


@inline
def forget(held, params):
    """Have the friction of a contact worked out in the next step, whatever step that is."""
    if params is None:
        return
    held.lanes.store(params.memory, held.page, HELD_FROM, held.lanes.constant(0.0))


@inline
def remember(held, load, params):
    """Take note that the memory of a contact is filled, and which lanes press on their middle, [N]."""
    if params is None:
        return
    held.lanes.store(params.memory, held.page, HELD_FROM, where_greater(load, 0.0, 1.0, 0.0 * load))


@inline
def keep_friction(held, lamina, coefficient, params):
    """Keep the friction of a lamina over slip speed and load, [s/m]."""
    if params is None:
        return
    held.lanes.store(params.memory, held.page, HELD_COEFFICIENT + lamina, coefficient)


@inline
def held_friction(held, lamina, load, params):
    """Work out the friction of a lamina over slip speed from its coefficient, [N s/m]."""
    if params is None:
        return 0.0 * load
    return load * held.lanes.load(params.memory, held.page, HELD_COEFFICIENT + lamina)


@inline
def keep_couple(held, couple, params):
    """Keep the couple against rolling, [N m]."""
    if params is None:
        return
    held.lanes.store(params.memory, held.page, HELD_COUPLE, couple)


@inline
def held_couple(held, other, params):
    """Take the couple against rolling that was kept, [N m]; without a memory the other one."""
    if params is None:
        return other
    return held.lanes.load(params.memory, held.page, HELD_COUPLE)
