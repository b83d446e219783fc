"""Drag on the orbit and churning on the spin of a roller, in a medium that rests on the cup."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.bodies.contact_output import account, account_loss, react
from beardyn_core.physics.bodies.layout import CUP, LOSS_DRAG
from beardyn_core.physics.bodies.power import squared_over
from beardyn_core.physics.lanes import vectors
from beardyn_core.physics.lanes.lane_math import exp2, log2, magnitude, sqrt
from beardyn_core.physics.lanes.solve import add_couple
from beardyn_core.scene.scene import Scene


class DragParams(NamedTuple):
    """Medium around the rollers."""

    orbit: float  # force at 1 m/s [N]
    cylinder: float  # couple at 1 rad/s [N m]
    cylinder_exponent: float  # of the speed in couple over speed
    disc: float  # couple at 1 rad/s, both ends [N m]


AIR_DENSITY = 1.2


# Turbulent skin friction of a cylinder that turns in a wide medium, f = 0.105 Re^-0.274: within 10 % of
# Theodorsen and Regier's 1/sqrt(f) = -0.6 + 4.07 log10(Re sqrt(f)) for Re from 1e3 to 1e5.
CYLINDER_FRICTION, CYLINDER_EXPONENT = 0.105, 0.274
# Laminar disc, both sides: c = 3.87 / sqrt(Re).
DISC_FRICTION, DISC_EXPONENT = 3.87, 0.5


def drag_params(scene: Scene) -> DragParams | None:
    """Work out drag of a roller at 1 m/s, and churning couples at 1 rad/s."""
    effect = scene.effects.drag
    if effect is None:
        return None
    bearing, lubricant = scene.bearing, scene.lubricant
    fill = effect.present_fill
    density = fill * lubricant.density + (1.0 - fill) * AIR_DENSITY
    reynolds = _radius(bearing) ** 2 / lubricant.kinematic_viscosity(scene.temperature)
    side = 2.0 * math.pi * _radius(bearing) * bearing.roller_length
    cylinder = 0.5 * density * side * _radius(bearing) ** 3
    disc = 0.5 * density * _radius(bearing) ** 5
    return DragParams(
        orbit=0.5 * density * effect.drag_coefficient * bearing.roller_length * bearing.roller_diameter,
        cylinder=effect.churning * cylinder * CYLINDER_FRICTION * reynolds**-CYLINDER_EXPONENT,
        cylinder_exponent=1.0 - CYLINDER_EXPONENT,
        disc=effect.churning * disc * DISC_FRICTION * reynolds**-DISC_EXPONENT,
    )


def _radius(bearing: RollerBearing) -> float:
    return 0.5 * bearing.roller_diameter


_SMALLEST_SPIN = 1e-6


class DragContact(NamedTuple):
    """A roller in the medium, before the solve."""

    rate: Any  # drag over orbit speed [N s/m]
    speed: Any  # of the orbit, against the cup [m/s]
    churning: Any  # couple over spin [N m s]
    spin: Any  # about the roller axis, against the cup [rad/s]
    axis: vectors.Vector
    centre: vectors.Vector  # of mass of the roller from the cup's origin [m]


@inline
def prepare_drag(body, view, drag):
    """Work out drag and churning, a `DragContact`; without the effect zeros, which nothing uses.

    The orbit speed is the tangential one against the cup's motion at the roller's centre, the spin that
    about the roller axis against the cup. Neglects wakes, the cage and the stirring of the medium, and
    takes the Reynolds numbers of the lubricant.

    References
    ----------
    Gupta (1984), Advanced Dynamics of Rolling Elements: F = rho C L D v^2 / 2; discs M = rho w^2 r^5 c / 2.
    Theodorsen and Regier (1944), NACA Report 793: cylinders M = f rho u^2 A r / 2.
    """
    centre = vectors.subtract(body.place, view.origin)
    if drag is None:
        nothing = 0.0 * body.place[0]
        return DragContact(nothing, nothing, nothing, nothing, body.axis, centre)
    flow = vectors.subtract(body.velocity, vectors.add(view.velocity, vectors.cross(view.omega, centre)))
    spin = vectors.dot(vectors.subtract(body.omega, view.omega), body.axis)
    rate = drag.orbit * magnitude(flow[1])
    return DragContact(rate, flow[1], churning_rate(spin, drag), spin, body.axis, centre)


@inline
def churning_rate(spin, drag):
    """Work out the couple of the medium on a roller's ends and mantle over its spin, [N m s/rad]."""
    fast = magnitude(spin) + _SMALLEST_SPIN
    return drag.disc * sqrt(fast) + drag.cylinder * exp2(drag.cylinder_exponent * log2(fast))


@inline
def stiffen_drag(matrix, contact, step, drag):
    """Add the implicit part of drag and churning to the roller's matrix."""
    if drag is None:
        return matrix
    m = add_couple(matrix, contact.axis, step * contact.churning)
    return (
        m[0], m[1], m[2] + step * contact.rate, m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11],
        m[12], m[13], m[14], m[15], m[16], m[17], m[18], m[19], m[20],
    )  # fmt: skip


@inline
def push_drag(total, contact, drag):
    """Add drag and churning at the beginning of the step to the wrench of the roller."""
    if drag is None:
        return total
    force = (total.force[0], total.force[1] - contact.rate * contact.speed, total.force[2])
    return vectors.Wrench(
        force, vectors.add_scaled(total.moment, -contact.churning * contact.spin, contact.axis)
    )


@inline
def settle_drag(contact, change, total, here, drag, p):
    """Settle drag and churning after the solve: on roller and cup alike, with their loss."""
    if drag is None:
        return total
    rate, speed, churning, spin = contact.rate, contact.speed, contact.churning, contact.spin
    sped, spun = change.velocity[1], vectors.dot(change.omega, contact.axis)
    still = 0.0 * rate
    push = (still, -rate * (speed + sped), still)
    wrench = vectors.Wrench(push, vectors.scale(-churning * (spin + spun), contact.axis))
    react(CUP, contact.centre, wrench, here)
    flow, turning = speed + 0.5 * sped, spin + 0.5 * spun
    lost = rate * flow * flow + churning * turning * turning
    numerical = 0.5 * (rate * sped * flow + churning * spun * turning)
    account_loss(here, LOSS_DRAG, p.step * lost, p.effects.audit)
    account(here, p.step * numerical, still, p.effects.audit)
    return vectors.add_wrenches(total, wrench)


@inline
def drag_push(speeds, k, drag):
    """Work out the force of the medium on the orbit of a roller, [N]."""
    if drag is None:
        return 0.0
    flow = speeds[1] * k.radius
    return drag.orbit * flow * flow


@inline
def drag_torque(speeds, k, drag):
    """Work out the torque of the drag on all rollers, along the shaft's rotation, [N m]."""
    if drag is None:
        return 0.0
    flow, spin = speeds[1] * k.radius, speeds[1] * (k.spin_ratio + k.axis_axial)
    power = drag.orbit * math.fabs(flow) * flow * flow + churning_rate(spin, drag) * spin * spin
    return squared_over(k.rolling_count * power, speeds[0])
