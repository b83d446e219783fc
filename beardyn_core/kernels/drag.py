"""Drag on the orbit and churning on the spin of a roller, in a medium that rests on the cup."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import account, account_loss, react
from beardyn_core.kernels.lane_math import exp2, log2, magnitude, sqrt
from beardyn_core.kernels.solve import add_couple
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract
from beardyn_core.model.layout import CUP, LOSS_DRAG

_SMALLEST_SPIN = 1e-6


@inline
def drag_before(body: Any, view: Any, drag: Any) -> Any:
    """Drag over orbit speed, orbit speed; churning couple over spin, spin; axis; centre from the cup.

    The orbit speed is the tangential one against the cup's motion at the roller's centre, the spin that
    about the roller axis against the cup. Neglects wakes, the cage and the stirring of the medium, and
    takes the Reynolds numbers of the lubricant. Without the effect zeros of the same type, which nothing
    uses.

    References
    ----------
    Gupta (1984), Advanced Dynamics of Rolling Elements: F = rho C L D v^2 / 2; discs M = rho w^2 r^5 c / 2.
    Theodorsen and Regier (1944), NACA Report 793: cylinders M = f rho u^2 A r / 2.
    """
    place, axis, velocity, omega, _rate = body
    centre = subtract(place, view[0])
    if drag is None:
        nothing = 0.0 * place[0]
        return nothing, nothing, nothing, nothing, axis, centre
    flow = subtract(velocity, add(view[2], cross(view[3], centre)))
    spin = dot(subtract(omega, view[3]), axis)
    return drag.orbit * magnitude(flow[1]), flow[1], churning_rate(spin, drag), spin, axis, centre


@inline
def churning_rate(spin: Any, drag: Any) -> Any:
    """Couple of the medium on a roller's ends and mantle over its spin, [N m s/rad]."""
    fast = magnitude(spin) + _SMALLEST_SPIN
    return drag.disc * sqrt(fast) + drag.cylinder * exp2(drag.cylinder_exponent * log2(fast))


@inline
def drag_matrix(matrix: Any, contact: Any, step: Any, drag: Any) -> Any:
    """Add the implicit part of drag and churning."""
    if drag is None:
        return matrix
    m = add_couple(matrix, contact[4], step * contact[2])
    return (
        m[0], m[1], m[2] + step * contact[0], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12],
        m[13], m[14], m[15], m[16], m[17], m[18], m[19], m[20],
    )  # fmt: skip


@inline
def add_drag(force: Any, moment: Any, contact: Any, drag: Any) -> Any:
    """Add drag and churning at the beginning of the step to a sum."""
    if drag is None:
        return force, moment
    rate, speed, churning, spin, axis, _centre = contact
    return (force[0], force[1] - rate * speed, force[2]), add_scaled(moment, -churning * spin, axis)


@inline
def finish_drag(
    lanes: Any,
    sums: Any,
    contact: Any,
    change: Any,
    force: Any,
    moment: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    drag: Any,
    p: Any,
) -> Any:
    """Settle drag and churning after the solve: on roller and cup alike, with their loss."""
    if drag is None:
        return force, moment
    rate, speed, churning, spin, axis, centre = contact
    sped, spun = change[0][1], dot(change[1], axis)
    still = 0.0 * rate
    push = (still, -rate * (speed + sped), still)
    turn = scale(-churning * (spin + spun), axis)
    react(lanes, sums, CUP, mask, centre, push, turn, cosine, sine)
    flow, turning = speed + 0.5 * sped, spin + 0.5 * spun
    lost = rate * flow * flow + churning * turning * turning
    numerical = 0.5 * (rate * sped * flow + churning * spun * turning)
    account_loss(lanes, sums, mask, LOSS_DRAG, p.step * lost, p.effects.audit)
    account(lanes, sums, mask, p.step * numerical, still, p.effects.audit)
    return add(force, push), add(moment, turn)
