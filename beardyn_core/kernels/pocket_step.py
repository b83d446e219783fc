"""The pocket contact within a time step; it is soft and explicit."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.defect import pocket_wear
from beardyn_core.kernels.exchange import account, account_loss, output_contact, react
from beardyn_core.kernels.lane_math import sqrt
from beardyn_core.kernels.orbit import ring_view
from beardyn_core.kernels.pocket import pocket_contact, pocket_loss, pocket_sum
from beardyn_core.kernels.vectors import add, dot, subtract
from beardyn_core.model.layout import CAGE_BODY, LOSS_POCKET, POCKET, POCKET_ANGLE, RING_TURN


@inline
def cage_before(
    lanes: Any,
    rings: Any,
    constants: Any,
    block: Any,
    body: Any,
    azimuth: Any,
    cosine: Any,
    sine: Any,
    roller: Any,
    worn: Any,
    cage: Any,
) -> Any:
    """Pocket contact of one block; without a cage zeros of the same type, which nothing uses."""
    if cage is None:
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        touch = (nothing, nothing, nothing, nothing, zero)
        return nothing, ((touch, touch, touch, touch, touch), nothing)
    place, axis, velocity, omega, _rate = body
    origin, tilt, ring_velocity, ring_omega = ring_view(lanes, rings, CAGE_BODY, cosine, sine)
    pocket = lanes.load(rings, CAGE_BODY, RING_TURN) + lanes.load(constants, block, POCKET_ANGLE)
    centre = subtract(place, origin)
    wear = pocket_wear(lanes, block, worn)
    return centre, pocket_contact(
        centre, axis, velocity, omega, azimuth - pocket, tilt, ring_velocity, ring_omega, wear, roller, cage
    )


@inline
def add_cage(force: Any, moment: Any, contact: Any, cage: Any) -> Any:
    """Add the pocket's wrench to a sum."""
    if cage is None:
        return force, moment
    pocket_force, pocket_moment, _energy = pocket_sum(contact[1][0])
    return add(force, pocket_force), add(moment, pocket_moment)


@inline
def finish_cage(
    lanes: Any,
    rollers: Any,
    sums: Any,
    block: Any,
    contact: Any,
    change: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    cage: Any,
    p: Any,
) -> None:
    """Reaction, output and audit of the pocket contact, which is explicit."""
    if cage is None:
        return
    centre = contact[0]
    touches, bar = contact[1]
    force, moment, energy = pocket_sum(touches)
    react(lanes, sums, CAGE_BODY, mask, centre, force, moment, cosine, sine)
    slip = touches[0][3]
    output_contact(lanes, rollers, block, POCKET, force, bar, sqrt(dot(slip, slip)), lanes.constant(0.0))
    lost = p.step * pocket_loss(touches, change)
    account_loss(lanes, sums, mask, LOSS_POCKET, lost, p.effects.audit)
    account(lanes, sums, mask, lanes.constant(0.0), energy, p.effects.audit)
