"""The pocket contact within a time step; it is soft and explicit."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.defect import pocket_wear
from beardyn_core.kernels.exchange import account, account_loss, output_contact, react
from beardyn_core.kernels.lane_math import sqrt
from beardyn_core.kernels.orbit import ring_view
from beardyn_core.kernels.pocket import pocket_contact, touch_loss
from beardyn_core.kernels.pocket_simple import kinematic_pocket, rotating_pocket
from beardyn_core.kernels.vectors import add, subtract
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
    """Pocket contact of one block: centre, sums over the walls, slip with bar; zeros without a cage."""
    if cage is None:
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        return nothing, (nothing, nothing, zero, zero, nothing, nothing), (zero, nothing)
    place, axis, velocity, omega, _rate = body
    origin, tilt, ring_velocity, ring_omega = ring_view(lanes, rings, CAGE_BODY, cosine, sine)
    pocket = lanes.load(rings, CAGE_BODY, RING_TURN) + lanes.load(constants, block, POCKET_ANGLE)
    centre = subtract(place, origin)
    motion = (velocity, omega, ring_velocity, ring_omega)
    wear = pocket_wear(lanes, block, worn)
    touches, slip_squared, bar = _touches(
        centre, axis, motion, azimuth - pocket, tilt, wear, roller, cage, cage.rotating, cage.kinematic
    )
    return centre, touches, (slip_squared, bar)


@inline
def _touches(
    centre: Any,
    axis: Any,
    motion: Any,
    advance: Any,
    tilt: Any,
    wear: Any,
    roller: Any,
    cage: Any,
    rotating: Any,
    kinematic: Any,
) -> Any:
    if kinematic is not None:
        return kinematic_pocket(centre, axis, motion, advance, tilt, cage, kinematic)
    if rotating is not None:
        return rotating_pocket(centre, axis, motion, advance, tilt, wear, roller, cage)
    velocity, omega, ring_velocity, ring_omega = motion
    return pocket_contact(
        centre, axis, velocity, omega, advance, tilt, ring_velocity, ring_omega, wear, roller, cage
    )


@inline
def add_cage(force: Any, moment: Any, contact: Any, cage: Any) -> Any:
    """Add the pocket's wrench to a sum."""
    if cage is None:
        return force, moment
    return add(force, contact[1][0]), add(moment, contact[1][1])


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
    centre, touches = contact[0], contact[1]
    force, moment, energy = touches[0], touches[1], touches[2]
    slip_squared, bar = contact[2]
    react(lanes, sums, CAGE_BODY, mask, centre, force, moment, cosine, sine)
    output_contact(lanes, rollers, block, POCKET, force, bar, sqrt(slip_squared), lanes.constant(0.0))
    lost = p.step * touch_loss(touches, change)
    account_loss(lanes, sums, mask, LOSS_POCKET, lost, p.effects.audit)
    account(lanes, sums, mask, lanes.constant(0.0), energy, p.effects.audit)
