"""Contact of a roller with a ring at one point, which all ribs share."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.contact_output import account, account_loss, react
from beardyn_core.physics.bodies.layout import LOSS_DAMPING
from beardyn_core.physics.contact_damping import implicit_time
from beardyn_core.physics.lanes.lane_math import where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.solve import add_couple, add_point, add_point_everywhere
from beardyn_core.physics.lanes.vectors import (
    Vector,
    Wrench,
    add,
    add_scaled,
    cross,
    dot,
    scale,
)

_NOTHING = 1e-300


class PointContact(NamedTuple):
    """A point contact before the solve.

    The elastic force belongs to the stored energy, also where the contact opens faster than the spring
    follows and nothing presses.
    """

    centre: Vector  # of mass of the roller from the ring's origin [m]
    normal: Vector  # into the ring
    arm: Vector  # from the centre of mass [m]
    load: Any  # [N]
    tangent: Any  # stiffness [N/m]
    friction: Any  # over slip [N s/m]
    elastic: Any  # force [N]
    energy: Any  # [J]
    slip: Vector  # of the roller against the ring [m/s]
    drilling: Any  # friction moment over spin about the normal [N m s]
    spin: Any  # about the normal [rad/s]
    film: Any  # thickness [m]


@inline
def absent_point(zero):
    """Make a `PointContact` of zeros, for a rib that is absent and that nothing uses."""
    nothing = (zero, zero, zero)
    return PointContact(nothing, nothing, nothing, zero, zero, zero, zero, zero, nothing, zero, zero, zero)


@inline
def is_pressed(contact):
    """Check whether a point contact of any roller of the block is pressed; a NaN is, too."""
    return any_positive(where_greater(_NOTHING, contact.elastic, 0.0, 1.0))


@inline
def stiffen_point(matrix, contact, damping, drilling, p):
    """Add the implicit part of a pressed point contact to the roller's matrix."""
    rough = p.step * contact.friction
    matrix = add_point_everywhere(matrix, contact.arm, rough)
    stiff = p.step * implicit_time(p.spring_time, damping) * contact.tangent
    matrix = add_point(matrix, contact.normal, contact.arm, stiff - rough)
    return _resist_spin(matrix, contact, p.step, drilling)


@inline
def _resist_spin(matrix, contact, step, drilling):
    if drilling is None:
        return matrix
    return add_couple(matrix, contact.normal, step * contact.drilling)


@inline
def push_point(contact, drilling):
    """Work out the wrench on the roller from the velocities at the beginning of the step."""
    normal, slip = contact.normal, contact.slip
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    force = add_scaled(scale(-contact.load, normal), -contact.friction, tangential)
    return Wrench(force, _add_drilling_moment(cross(contact.arm, force), contact, contact.spin, drilling))


@inline
def _add_drilling_moment(moment, contact, spin, drilling):
    """Add the moment of the friction against the spin about the normal."""
    if drilling is None:
        return moment
    return add_scaled(moment, -contact.drilling * spin, contact.normal)


@inline
def _drilling_loss(contact, d_spin, drilling):
    """Work out the power of the friction against the spin, and of its implicit step, [W]."""
    if drilling is None:
        return 0.0, 0.0
    middle = contact.spin + 0.5 * d_spin
    return contact.drilling * middle * middle, 0.5 * contact.drilling * d_spin * middle


@inline
def settle_point(contact, change, here, ring, source, time_constant, drilling, p):
    """Settle a point contact with a ring after the solve: reaction and audit.

    ``ring``: ``CUP`` or ``CONE``; ``source``: which loss the friction counts as; ``time_constant``: damping
    over stiffness [s]; ``drilling``: whether the contact resists the spin about its normal. Returns the
    `Wrench` on the roller that the step ends with.
    """
    if not is_pressed(contact):
        still = 0.0 * contact.elastic
        return Wrench((still, still, still), (still, still, still))
    normal, arm, tangent, friction = contact.normal, contact.arm, contact.tangent, contact.friction
    elastic = where_greater(tangent, 0.0, contact.elastic, 0.0 * contact.elastic)
    d_spin = dot(change.omega, normal)
    d_slip = add(change.velocity, cross(change.omega, arm))
    d_rate = dot(d_slip, normal)
    rate = dot(contact.slip, normal)
    middle_rate = rate + 0.5 * d_rate
    load = elastic + p.spring_time * tangent * d_rate + time_constant * tangent * middle_rate
    before = add_scaled(contact.slip, -rate, normal)
    d_sliding = add_scaled(d_slip, -d_rate, normal)
    sliding_after = add(before, d_sliding)
    middle = add_scaled(before, 0.5, d_sliding)
    force = add_scaled(scale(-load, normal), -friction, sliding_after)
    wrench = Wrench(force, _add_drilling_moment(cross(arm, force), contact, contact.spin + d_spin, drilling))
    react(ring, contact.centre, wrench, here)
    damping = time_constant * tangent
    drilled, extra = _drilling_loss(contact, d_spin, drilling)
    numerical = 0.5 * friction * dot(d_sliding, middle) + extra
    lost = friction * dot(middle, middle) + drilled
    audit = p.effects.audit
    account_loss(here, source, p.step * lost, audit)
    # a spring that may not pull expands against its own damper
    damped = damping * middle_rate * middle_rate - (contact.elastic - elastic) * middle_rate
    account_loss(here, LOSS_DAMPING, p.step * damped, audit)
    account(here, p.step * numerical, contact.energy, audit)
    return wrench
