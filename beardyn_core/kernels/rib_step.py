"""The rib contact within a time step: before the solve, in the matrix, and settled after it."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import account, account_loss, implicit_time, output_contact, react
from beardyn_core.kernels.lane_math import sqrt
from beardyn_core.kernels.rib import rib_contact
from beardyn_core.kernels.solve import add_point
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract
from beardyn_core.model.layout import CONE, LOSS_DAMPING, LOSS_RIB, RIB


@inline
def rib_before(body: Any, view: Any, zero: Any, rib: Any, damping: Any) -> Any:
    """Rib contact before the solve; without a rib zeros of the same type, which nothing uses."""
    if rib is None:
        nothing = (zero, zero, zero)
        return nothing, (nothing, nothing, zero, zero, zero, zero, zero, nothing)
    place, axis, velocity, omega, _rate = body
    centre = subtract(place, view[0])
    return centre, rib_contact(centre, axis, velocity, omega, view[1], view[2], view[3], rib, damping)


@inline
def rib_matrix(matrix: Any, contact: Any, ring_axis: Any, step: Any, rib: Any, damping: Any) -> Any:
    """Add the implicit part of the rib contact."""
    if rib is None:
        return matrix
    normal, arm, _load, tangent, friction, _elastic, _energy, _slip = contact[1]
    across = cross(ring_axis, normal)
    across = scale(1.0 / sqrt(dot(across, across)), across)
    matrix = add_point(matrix, normal, arm, step * implicit_time(step, damping) * tangent)
    matrix = add_point(matrix, across, arm, step * friction)
    return add_point(matrix, cross(normal, across), arm, step * friction)


@inline
def rib_wrench(contact: Any) -> Any:
    """Force and moment of the rib from the velocities at the beginning of the step."""
    normal, arm, load, _tangent, friction, _elastic, _energy, slip = contact[1]
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    force = add_scaled(scale(-load, normal), -friction, tangential)
    return force, cross(arm, force)


@inline
def add_rib(force: Any, moment: Any, contact: Any, rib: Any) -> Any:
    """Add the rib's wrench to a sum."""
    if rib is None:
        return force, moment
    rib_force, rib_moment = rib_wrench(contact)
    return add(force, rib_force), add(moment, rib_moment)


@inline
def finish_rib(
    lanes: Any,
    rollers: Any,
    sums: Any,
    block: Any,
    contact: Any,
    change: Any,
    force: Any,
    moment: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    rib: Any,
    p: Any,
) -> Any:
    """Settle the rib contact after the solve and add its wrench to the roller's."""
    if rib is None:
        return force, moment
    centre = contact[0]
    normal, arm, _load, tangent, friction, elastic, energy, slip = contact[1]
    d_slip = add(change[0], cross(change[1], arm))
    d_rate = dot(d_slip, normal)
    rate = dot(slip, normal)
    time_constant = implicit_time(p.step, p.effects.damping) - 0.25 * p.step
    load = elastic + 0.25 * p.step * tangent * d_rate + time_constant * tangent * (rate + d_rate)
    before = add_scaled(slip, -rate, normal)
    d_sliding = add_scaled(d_slip, -d_rate, normal)
    sliding_after = add(before, d_sliding)
    middle = add_scaled(before, 0.5, d_sliding)
    middle_rate = rate + 0.5 * d_rate
    rib_force = add_scaled(scale(-load, normal), -friction, sliding_after)
    rib_moment = cross(arm, rib_force)
    react(lanes, sums, CONE, mask, centre, rib_force, rib_moment, cosine, sine)
    output_contact(lanes, rollers, block, RIB, rib_force, arm, sqrt(dot(before, before)), lanes.constant(0.0))
    damping = time_constant * tangent
    numerical = 0.5 * (friction * dot(d_sliding, middle) + damping * d_rate * middle_rate)
    audit = p.effects.audit
    account_loss(lanes, sums, mask, LOSS_RIB, p.step * friction * dot(middle, middle), audit)
    account_loss(lanes, sums, mask, LOSS_DAMPING, p.step * damping * middle_rate * middle_rate, audit)
    account(lanes, sums, mask, p.step * numerical, energy, audit)
    return add(force, rib_force), add(moment, rib_moment)
