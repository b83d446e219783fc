"""What a contact hands over: reactions to the rings, energy terms, outputs, chatter sums."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.lanes.lane_math import at_least
from beardyn_core.physics.lanes.vectors import Vector, add, cross, scale, turn_out


class Here(NamedTuple):
    """The block of rollers that a step is working on, and where its results go."""

    lanes: Any
    block: int
    rollers: Any  # [block, ROLLER_FIELDS, lane], state and outputs
    sums: Any  # [1, SUM_FIELDS + series + 2 x slips, lane], added to
    mask: Any  # 1 for a roller, 0 for a lane that shadows one
    cosine: Any  # of the orbit azimuth
    sine: Any
    shown: bool  # whether the outputs of this step are used


class ContactOutput(NamedTuple):
    """What an output reports of one contact of a roller, in its orbit frame."""

    force: Vector  # on the roller [N]
    arm: Vector  # from the centre of mass to the contact [m]
    slip: Any  # [m/s]
    film: Any  # thickness [m]


@inline
def load_vector(lanes, array, block, field):
    """Load three lane values stored one after the other."""
    return (
        lanes.load(array, block, field),
        lanes.load(array, block, field + 1),
        lanes.load(array, block, field + 2),
    )


@inline
def store_vector(lanes, array, block, field, vector):
    """Store three lane values one after the other."""
    lanes.store(array, block, field, vector[0])
    lanes.store(array, block, field + 1, vector[1])
    lanes.store(array, block, field + 2, vector[2])


@inline
def accumulate(here, field, value):
    """Add a lane value to a sum over the blocks."""
    here.lanes.store(here.sums, 0, field, here.lanes.load(here.sums, 0, field) + value)


@inline
def accumulate_vector(here, field, vector):
    """Add three lane values to sums stored one after the other."""
    accumulate(here, field, vector[0])
    accumulate(here, field + 1, vector[1])
    accumulate(here, field + 2, vector[2])


@inline
def react(ring, centre, wrench, here):
    """Add the reaction of one contact to its ring: force and moment about the ring's origin.

    ``ring``: ``CUP``, ``CONE`` or, for the cage, ``CAGE_BODY``; ``wrench``: on the roller, about its centre
    of mass.

    The compiler ranks what it adds by the order of the arguments, and by that decides which product of a sum
    is fused with it: another order gives other last bits. So `here` comes after the wrench, here and in the
    functions that settle a contact.
    """
    about_origin = add(wrench.moment, cross(centre, wrench.force))
    push = turn_out(scale(-here.mask, wrench.force), here.cosine, here.sine)
    turn = turn_out(scale(-here.mask, about_origin), here.cosine, here.sine)
    first = layout.REACTION + 6 * ring
    accumulate_vector(here, first, push)
    accumulate_vector(here, first + 3, turn)


@inline
def account(here, numerical, elastic, audit):
    """Add what a contact lost to the time step and what it stores to the audit, [J]."""
    if audit is None:
        return
    accumulate(here, layout.WORK_NUMERICAL, here.mask * numerical)
    accumulate(here, layout.ELASTIC, here.mask * elastic)


@inline
def account_loss(here, source, lost, audit):
    """Add what a contact dissipated over the step to the audit, under its source (``LOSS_...``), [J]."""
    if audit is None:
        return
    accumulate(here, layout.WORK_LOST + source, here.mask * lost)


@inline
def account_gravity(here, work, audit):
    """Add the work of gravity to the audit, [J]."""
    if audit is None:
        return
    accumulate(here, layout.WORK_GRAVITY, here.mask * work)


@inline
def output_contact(lanes, rollers, block, kind, output):
    """Write what the last step gives of one contact of a block of rollers.

    ``kind``: ``CUP``, ``CONE``, ``RIB`` or ``POCKET``.
    """
    first = layout.CONTACT_OUTPUT + kind * layout.OUTPUT_FIELDS
    store_vector(lanes, rollers, block, first + layout.OUTPUT_FORCE, output.force)
    store_vector(lanes, rollers, block, first + layout.OUTPUT_ARM, output.arm)
    lanes.store(rollers, block, first + layout.OUTPUT_SLIP, output.slip)
    lanes.store(rollers, block, first + layout.OUTPUT_FILM, output.film)


@inline
def watch_largest(lanes, rollers, block, kind, square):
    """Keep the square of the largest load of a contact since the last snapshot, [N^2].

    ``kind``: ``CUP``, ``CONE`` or ``RIB``; ``square``: of the load of the step.
    """
    place = layout.LARGEST + kind
    lanes.store(rollers, block, place, at_least(lanes.load(rollers, block, place), square))


@inline
def clear_largest(rollers):
    """Start the largest loads of an interval between snapshots."""
    for block in range(rollers.shape[0]):
        for kind in range(layout.LARGEST_FIELDS):
            for lane in range(rollers.shape[2]):
                rollers[block, layout.LARGEST + kind, lane] = 0.0


@inline
def watch_chatter(here, ring, friction, capacity):
    """Sum the squares of what flips in the friction force, and of its capacity.

    What flips is its second difference, less half of what it has moved over both steps: a strike that the
    steps resolve moves more than it bends.

    ``friction``, ``capacity``: of the step, and at full slip in the dry limit [N].
    """
    lanes, rollers, block = here.lanes, here.rollers, here.block
    first = layout.CHATTER + ring * layout.CHATTER_FIELDS
    last = lanes.load(rollers, block, first + layout.CHATTER_LAST)
    before = lanes.load(rollers, block, first + layout.CHATTER_BEFORE)
    bend = last - 0.5 * (friction + before)
    move = 0.5 * (friction - before)
    lanes.store(rollers, block, first + layout.CHATTER_BEFORE, last)
    lanes.store(rollers, block, first + layout.CHATTER_LAST, friction)
    squares = lanes.load(rollers, block, first + layout.CHATTER_SQUARES)
    lanes.store(
        rollers,
        block,
        first + layout.CHATTER_SQUARES,
        squares + at_least(bend * bend - 0.5 * move * move, 0.0),
    )
    loads = lanes.load(rollers, block, first + layout.CHATTER_LOAD)
    lanes.store(rollers, block, first + layout.CHATTER_LOAD, loads + capacity * capacity)
