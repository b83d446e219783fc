"""What a contact hands over: reactions to the rings, energy terms, outputs, chatter sums."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least
from beardyn_core.kernels.vectors import add, cross, scale, turn_out
from beardyn_core.model.layout import (
    CHATTER,
    CHATTER_BEFORE,
    CHATTER_FIELDS,
    CHATTER_LAST,
    CHATTER_LOAD,
    CHATTER_SQUARES,
    CONTACT_OUTPUT,
    ELASTIC,
    OUTPUT_ARM,
    OUTPUT_FIELDS,
    OUTPUT_FILM,
    OUTPUT_FORCE,
    OUTPUT_SLIP,
    REACTION,
    WORK_GRAVITY,
    WORK_LOST,
    WORK_NUMERICAL,
)


@inline
def load_vector(lanes: Any, array: Any, block: Any, field: Any) -> Any:
    """Three lane values stored one after the other."""
    return (
        lanes.load(array, block, field),
        lanes.load(array, block, field + 1),
        lanes.load(array, block, field + 2),
    )


@inline
def store_vector(lanes: Any, array: Any, block: Any, field: Any, vector: Any) -> None:
    """Store three lane values one after the other."""
    lanes.store(array, block, field, vector[0])
    lanes.store(array, block, field + 1, vector[1])
    lanes.store(array, block, field + 2, vector[2])


@inline
def accumulate(lanes: Any, sums: Any, field: Any, value: Any) -> None:
    """Add a lane value to a sum over the blocks."""
    lanes.store(sums, 0, field, lanes.load(sums, 0, field) + value)


@inline
def accumulate_vector(lanes: Any, sums: Any, field: Any, vector: Any) -> None:
    """Add three lane values to sums stored one after the other."""
    accumulate(lanes, sums, field, vector[0])
    accumulate(lanes, sums, field + 1, vector[1])
    accumulate(lanes, sums, field + 2, vector[2])


@inline
def react(
    lanes: Any, sums: Any, ring: Any, mask: Any, centre: Any, force: Any, moment: Any, cosine: Any, sine: Any
) -> None:
    """Add the reaction of one contact to its ring: force and moment about the ring's origin."""
    about_origin = add(moment, cross(centre, force))
    push = turn_out(scale(-mask, force), cosine, sine)
    turn = turn_out(scale(-mask, about_origin), cosine, sine)
    first = REACTION + 6 * ring
    accumulate_vector(lanes, sums, first, push)
    accumulate_vector(lanes, sums, first + 3, turn)


@inline
def account(lanes: Any, sums: Any, mask: Any, numerical: Any, elastic: Any, audit: Any) -> None:
    """Add what a contact lost to the time step and what it stores to the audit."""
    if audit is None:
        return
    accumulate(lanes, sums, WORK_NUMERICAL, mask * numerical)
    accumulate(lanes, sums, ELASTIC, mask * elastic)


@inline
def account_loss(lanes: Any, sums: Any, mask: Any, source: Any, lost: Any, audit: Any) -> None:
    """Add what a contact dissipated over the step to the audit, under its source (``LOSS_...``)."""
    if audit is None:
        return
    accumulate(lanes, sums, WORK_LOST + source, mask * lost)


@inline
def account_gravity(lanes: Any, sums: Any, mask: Any, work: Any, audit: Any) -> None:
    """Add the work of gravity to the audit."""
    if audit is None:
        return
    accumulate(lanes, sums, WORK_GRAVITY, mask * work)


@inline
def output_contact(
    lanes: Any, rollers: Any, block: Any, kind: Any, force: Any, arm: Any, slip: Any, film: Any
) -> None:
    """Keep what the last step says of one contact."""
    first = CONTACT_OUTPUT + kind * OUTPUT_FIELDS
    store_vector(lanes, rollers, block, first + OUTPUT_FORCE, force)
    store_vector(lanes, rollers, block, first + OUTPUT_ARM, arm)
    lanes.store(rollers, block, first + OUTPUT_SLIP, slip)
    lanes.store(rollers, block, first + OUTPUT_FILM, film)


@inline
def watch_chatter(lanes: Any, rollers: Any, block: Any, ring: Any, friction: Any, capacity: Any) -> None:
    """Sum the squares of what flips in the friction force, and of its capacity.

    What flips is its second difference, less half of what it has moved over both steps: a strike that the
    steps resolve moves more than it bends.
    """
    first = CHATTER + ring * CHATTER_FIELDS
    last = lanes.load(rollers, block, first + CHATTER_LAST)
    before = lanes.load(rollers, block, first + CHATTER_BEFORE)
    bend = last - 0.5 * (friction + before)
    move = 0.5 * (friction - before)
    lanes.store(rollers, block, first + CHATTER_BEFORE, last)
    lanes.store(rollers, block, first + CHATTER_LAST, friction)
    squares = lanes.load(rollers, block, first + CHATTER_SQUARES)
    lanes.store(
        rollers, block, first + CHATTER_SQUARES, squares + at_least(bend * bend - 0.5 * move * move, 0.0)
    )
    loads = lanes.load(rollers, block, first + CHATTER_LOAD)
    lanes.store(rollers, block, first + CHATTER_LOAD, loads + capacity * capacity)


@inline
def implicit_time(spring_time: Any, damping: Any) -> Any:
    """Time that makes tangent stiffness an implicit resistance: the damper acts in mid-step, [s]."""
    return spring_time + 0.5 * damper_time(damping)


@inline
def damper_time(damping: Any) -> Any:
    """Damping of a contact over its tangent stiffness, [s]."""
    if damping is None:
        return 0.0
    return damping.time_constant
