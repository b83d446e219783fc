"""The rib contact within a time step: before the solve, in the matrix, and settled after it."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import (
    account,
    account_loss,
    damper_time,
    implicit_time,
    output_contact,
    react,
)
from beardyn_core.kernels.lane_math import sqrt, where_greater
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.rib import rib_contact
from beardyn_core.kernels.solve import add_couple, add_point, add_point_everywhere
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract
from beardyn_core.model.layout import CONE, LOSS_DAMPING, LOSS_RIB, RIB

_NOTHING = 1e-300


@inline
def rib_before(body: Any, view: Any, zero: Any, rib: Any, damping: Any) -> Any:
    """Rib contact before the solve; without a rib zeros of the same type, which nothing uses."""
    if rib is None:
        nothing = (zero, zero, zero)
        return nothing, (nothing, nothing, zero, zero, zero, zero, zero, nothing, zero, zero, zero)
    place, axis, velocity, omega, rate = body
    centre = subtract(place, view[0])
    return centre, rib_contact(centre, axis, velocity, omega, view[1], view[2], view[3], rate, rib, damping)


@inline
def is_pressed(contact: Any) -> Any:
    """Whether a point contact of any roller of the block is pressed; a NaN is, too."""
    return any_positive(where_greater(_NOTHING, contact[1][5], 0.0, 1.0))


@inline
def rib_matrix(matrix: Any, contact: Any, rib: Any, p: Any) -> Any:
    """Add the implicit part of the rib contact."""
    if rib is None:
        return matrix
    if not is_pressed(contact):
        return matrix
    normal, arm, _load, tangent, friction, _elastic, _energy, _slip, drilling, _spin, _film = contact[1]
    rough = p.step * friction
    matrix = add_point_everywhere(matrix, arm, rough)
    stiff = p.step * implicit_time(p.spring_time, p.effects.damping) * tangent
    matrix = add_point(matrix, normal, arm, stiff - rough)
    return _resist_spin(matrix, normal, p.step * drilling, rib.drilling)


@inline
def _resist_spin(matrix: Any, normal: Any, weight: Any, drilling: Any) -> Any:
    if drilling is None:
        return matrix
    return add_couple(matrix, normal, weight)


@inline
def rib_wrench(contact: Any, drilling: Any) -> Any:
    """Force and moment of the rib from the velocities at the beginning of the step."""
    normal, arm, load, _tangent, friction, _elastic, _energy, slip, resistance, spin, _film = contact[1]
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    force = add_scaled(scale(-load, normal), -friction, tangential)
    return force, _drilled(cross(arm, force), resistance, spin, normal, drilling)


@inline
def _drilled(moment: Any, resistance: Any, spin: Any, normal: Any, drilling: Any) -> Any:
    """Moment with that of the friction against the spin about the normal."""
    if drilling is None:
        return moment
    return add_scaled(moment, -resistance * spin, normal)


@inline
def _drilling_loss(resistance: Any, spin: Any, d_spin: Any, drilling: Any) -> Any:
    """Power of the friction against the spin, and of its implicit step, [W]."""
    if drilling is None:
        return 0.0, 0.0
    middle = spin + 0.5 * d_spin
    return resistance * middle * middle, 0.5 * resistance * d_spin * middle


@inline
def add_rib(force: Any, moment: Any, contact: Any, rib: Any) -> Any:
    """Add the rib's wrench to a sum."""
    if rib is None:
        return force, moment
    if not is_pressed(contact):
        return force, moment
    rib_force, rib_moment = rib_wrench(contact, rib.drilling)
    return add(force, rib_force), add(moment, rib_moment)


@inline
def settle_point(
    lanes: Any,
    sums: Any,
    contact: Any,
    change: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    source: Any,
    time_constant: Any,
    drilling: Any,
    p: Any,
) -> Any:
    """Settle a point contact with the cone after the solve: reaction and audit.

    Parameters
    ----------
    contact : tuple
        Centre of mass from the cone's origin, and the contact as `kernels.rib.rib_contact` returns it.
    change : tuple of 2 vectors
    source : int
        Which loss the friction counts as.
    time_constant : float
        Damping over stiffness, [s].
    drilling : RibDrillingParams or None
        Whether the contact resists the spin about its normal.

    Returns
    -------
    force, moment : vector
        On the roller that the step ends with.
    """
    if not is_pressed(contact):
        still = 0.0 * contact[1][5]
        return (still, still, still), (still, still, still)
    centre = contact[0]
    normal, arm, _load, tangent, friction, whole, energy, slip, resistance, spin, _film = contact[1]
    elastic = where_greater(tangent, 0.0, whole, 0.0 * whole)
    d_spin = dot(change[1], normal)
    d_slip = add(change[0], cross(change[1], arm))
    d_rate = dot(d_slip, normal)
    rate = dot(slip, normal)
    middle_rate = rate + 0.5 * d_rate
    load = elastic + p.spring_time * tangent * d_rate + time_constant * tangent * middle_rate
    before = add_scaled(slip, -rate, normal)
    d_sliding = add_scaled(d_slip, -d_rate, normal)
    sliding_after = add(before, d_sliding)
    middle = add_scaled(before, 0.5, d_sliding)
    force = add_scaled(scale(-load, normal), -friction, sliding_after)
    moment = _drilled(cross(arm, force), resistance, spin + d_spin, normal, drilling)
    react(lanes, sums, CONE, mask, centre, force, moment, cosine, sine)
    damping = time_constant * tangent
    drilled, extra = _drilling_loss(resistance, spin, d_spin, drilling)
    numerical = 0.5 * friction * dot(d_sliding, middle) + extra
    lost = friction * dot(middle, middle) + drilled
    audit = p.effects.audit
    account_loss(lanes, sums, mask, source, p.step * lost, audit)
    # a spring that may not pull expands against its own damper
    damped = damping * middle_rate * middle_rate - (whole - elastic) * middle_rate
    account_loss(lanes, sums, mask, LOSS_DAMPING, p.step * damped, audit)
    account(lanes, sums, mask, p.step * numerical, energy, audit)
    return force, moment


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
    time_constant = damper_time(p.effects.damping)
    rib_force, rib_moment = settle_point(
        lanes, sums, contact, change, mask, cosine, sine, LOSS_RIB, time_constant, rib.drilling, p
    )
    normal, arm, slip, film = contact[1][0], contact[1][1], contact[1][7], contact[1][10]
    sliding = add_scaled(slip, -dot(slip, normal), normal)
    output_contact(lanes, rollers, block, RIB, rib_force, arm, sqrt(dot(sliding, sliding)), film)
    return add(force, rib_force), add(moment, rib_moment)
