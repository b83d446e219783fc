"""Bending of the cup: how the rollers see it, what they do to it, and its own motion.

The modes are one array ``flex`` of shape [mode, 2, 2]: mode k has n = k + 2 waves, then cosine and sine
amplitude, then displacement [m] and velocity [m/s] (positions at whole steps, velocities half a step later,
like all bodies). The radial deflection at azimuth t is w = sum a cos(n t) + b sin(n t), the tangential one
v = sum (b cos(n t) - a sin(n t)) / n keeps the length of the ring.

Seen from one roller, a bent raceway is to first order the round one moved by w outwards and by dw/dt along
the orbit: that gives its gap, the slope of its normal and the shifted contact point in one go. The slope is
what makes the normal force conservative, so the energy audit closes.
"""

from __future__ import annotations

from beardyn_core.jit import inline
from beardyn_core.kernels.bodies import sum_lanes
from beardyn_core.kernels.exchange import accumulate
from beardyn_core.kernels.orbit import View
from beardyn_core.kernels.raceway import RacewayContact
from beardyn_core.kernels.vectors import add
from beardyn_core.model.layout import ENERGY_LOST, LOSS_RING_BENDING, SUM_FIELDS

PLACE, SPEED = 0, 1


@inline
def bent_cup(lanes, flex, view, cosine, sine, flexibility):
    """Bend the cup as each roller sees it.

    Returns ``view``: with the origin and the velocity of the piece of raceway at the roller;
    ``shift``: by how much the origin moved [m].

    Neglects the turn of the piece of raceway about the axle.
    """
    zero = lanes.constant(0.0)
    if flexibility is None:
        return view, (zero, zero, zero)
    deflection, slope, speed, speed_around = zero, zero, zero, zero
    cosine_before, sine_before = cosine, sine
    cosine_n = 2.0 * cosine * cosine - 1.0
    sine_n = 2.0 * cosine * sine
    for k in range(flex.shape[0]):
        n = k + 2.0
        deflection = deflection + (flex[k, 0, PLACE] * cosine_n + flex[k, 1, PLACE] * sine_n)
        slope = slope + n * (flex[k, 1, PLACE] * cosine_n - flex[k, 0, PLACE] * sine_n)
        speed = speed + (flex[k, 0, SPEED] * cosine_n + flex[k, 1, SPEED] * sine_n)
        speed_around = speed_around + (1.0 / n) * (flex[k, 1, SPEED] * cosine_n - flex[k, 0, SPEED] * sine_n)
        cosine_next = 2.0 * cosine * cosine_n - cosine_before
        sine_next = 2.0 * cosine * sine_n - sine_before
        cosine_before, sine_before = cosine_n, sine_n
        cosine_n, sine_n = cosine_next, sine_next
    shift = (deflection, slope, zero)
    moving = add(view.velocity, (speed, speed_around, zero))
    return View(add(view.origin, shift), view.axis, moving, view.omega), shift


@inline
def about_rigid_cup(contact, shift, flexibility):
    """Place a contact from the origin of the rigid cup, about which reactions are summed."""
    if flexibility is None:
        return contact
    c, centre = contact, add(contact.centre, shift)
    return RacewayContact(c.line, c.slip, c.sums, c.lean, c.log2_speed, centre, c.body, c.damage)


@inline
def bend_cup(force, here, modes, flexibility):
    """Add the work that the rollers' reaction does on a unit of each amplitude to the sums.

    ``force``: of the cup on the roller [N].
    """
    if flexibility is None:
        return
    mask, cosine, sine = here.mask, here.cosine, here.sine
    cosine_before, sine_before = cosine, sine
    cosine_n = 2.0 * cosine * cosine - 1.0
    sine_n = 2.0 * cosine * sine
    for k in range(modes):
        along = (1.0 / (k + 2.0)) * force[1]
        accumulate(here, SUM_FIELDS + 2 * k, mask * (along * sine_n - force[0] * cosine_n))
        accumulate(here, SUM_FIELDS + 2 * k + 1, mask * (0.0 - force[0] * sine_n - along * cosine_n))
        cosine_next = 2.0 * cosine * cosine_n - cosine_before
        sine_next = 2.0 * cosine * sine_n - sine_before
        cosine_before, sine_before = cosine_n, sine_n
        cosine_n, sine_n = cosine_next, sine_next


@inline
def drift_flex(flex, step, flexibility):
    """Move all amplitudes of the bending along their velocities."""
    if flexibility is None:
        return
    for k in range(flex.shape[0]):
        for i in range(2):
            flex[k, i, PLACE] += step * flex[k, i, SPEED]


@inline
def kick_flex(flex, sums, energy, step, flexibility):
    """Accelerate the amplitudes under the rollers and return the bending energy, [J].

    Spring and damper are implicit like those of the contacts, so a mode may be as stiff as one likes.
    """
    if flexibility is None:
        return 0.0
    stored = 0.0
    for k in range(flex.shape[0]):
        stiffness, damping = flexibility.stiffness[k], flexibility.damping[k]
        inertia = flexibility.mass[k] + step * (0.5 * damping + 0.25 * step * stiffness)
        for i in range(2):
            place, speed = flex[k, i, PLACE], flex[k, i, SPEED]
            push = sum_lanes(sums, SUM_FIELDS + 2 * k + i) - stiffness * place - damping * speed
            change = step * push / inertia
            middle = speed + 0.5 * change
            energy[ENERGY_LOST + LOSS_RING_BENDING] += step * damping * middle * middle
            stored += 0.5 * stiffness * place * place
            flex[k, i, SPEED] = speed + change
    return stored


@inline
def flex_energy(flex, flexibility):
    """Sum the kinetic energy of the modes, [J]."""
    if flexibility is None:
        return 0.0
    total = 0.0
    for k in range(flex.shape[0]):
        for i in range(2):
            total += 0.5 * flexibility.mass[k] * flex[k, i, SPEED] ** 2
    return total
