"""Bending of the axlebox with the cup: how the rollers see it, what they do to it, and its own motion.

The modes have unit modal mass; ``flex`` [2, mode] holds their places [m sqrt(kg)] and speeds (positions at
whole steps, velocities half a step later, like all bodies). Once a step they give the displacement around
each raceway as a Fourier series of the azimuth; each roller walks through its waves.

Seen from one roller, a bent raceway is to first order the round one moved by w outwards and by dw/dt along
the orbit: that gives its gap, the slope of its normal and the shifted contact point in one go. On a cone of
the angle alpha an axial displacement u counts in the gap as -u tan(alpha) outwards, so w is the radial
displacement less that. The slope is what makes the normal force conservative, so the energy audit closes.

Series stand as in a table of modes: mean, cosines, sines; of each row the radial, the tangential and the
axial one, towards the outer side of the row.
"""

from __future__ import annotations

from functools import partial

from beardyn_core.jit import FASTMATH, entry, inline
from beardyn_core.kernels.bodies import row_of
from beardyn_core.kernels.box import DAMPERS, SEAT_PLACE, SEAT_SPEED, SUSPENSION
from beardyn_core.kernels.exchange import accumulate
from beardyn_core.kernels.orbit import View
from beardyn_core.kernels.raceway import RacewayContact
from beardyn_core.kernels.vectors import add
from beardyn_core.model.layout import (
    ENERGY_LOST,
    LOSS_STRUCTURE,
    LOSS_SUSPENSION,
    SIGNAL_CHANNELS,
    SUM_FIELDS,
)

PLACE, SPEED = 0, 1
RADIAL, TANGENTIAL, AXIAL = range(3)
SHOWN = 4  # series of each lane: the gap's place, then the three speeds

# sums may be taken in any order here, so that they go into vectors
_sums_in_any_order = partial(entry, flags=(*FASTMATH, "reassoc"))


@_sums_in_any_order
def _add_shapes(shapes, amounts, total):
    """Add up shapes [mode, read] times two amounts [2, mode] each into ``total`` [2, read]."""
    for i in range(2):
        for k in range(shapes.shape[1]):
            total[i, k] = 0.0
    for m in range(shapes.shape[0]):
        place, speed = amounts[0, m], amounts[1, m]
        for k in range(shapes.shape[1]):
            total[0, k] += place * shapes[m, k]
            total[1, k] += speed * shapes[m, k]


@_sums_in_any_order
def _push_on_modes(shapes, forces, push):
    """Work out what forces [read] push each mode with, ``push`` [mode]."""
    for m in range(shapes.shape[0]):
        total = 0.0
        for k in range(shapes.shape[1]):
            total += shapes[m, k] * forces[k]
        push[m] = total


@inline
def drift_flex(flex, step, structure):
    """Move all modes along their velocities."""
    if structure is None:
        return
    for m in range(flex.shape[1]):
        flex[PLACE, m] += step * flex[SPEED, m]


@inline
def show_raceways(flex, bend, structure):
    """Write the series of both raceways for every lane; ``bend``: a `BendSpace`."""
    if structure is None:
        return
    _add_shapes(structure.raceway, flex, bend.raceway)
    series, width = bend.lanes.shape[2] // SHOWN, bend.lanes.shape[3]
    rows = bend.raceway.shape[1] // (3 * series)
    for group in range(bend.lanes.shape[0]):
        for k in range(series):
            for lane in range(width):
                first = 3 * series * row_of(group, lane, width, rows) + k
                place = bend.raceway[PLACE, first] - structure.taper * bend.raceway[PLACE, first + 2 * series]
                bend.lanes[group, 0, k, lane] = place
                for field in range(3):
                    speed = bend.raceway[SPEED, first + field * series]
                    bend.lanes[group, 0, (1 + field) * series + k, lane] = speed


@inline
def show_seats(flex, box, structure):
    """Write how far and how fast the suspension's seats give way, as motion of the bearing centre."""
    if structure is None:
        return
    _show_seats(flex, box, structure.suspension)


@inline
def _show_seats(flex, box, suspension):
    if suspension is None:
        return
    for i in range(6):
        place, speed = 0.0, 0.0
        for m in range(flex.shape[1]):
            place += suspension[i, m] * flex[PLACE, m]
            speed += suspension[i, m] * flex[SPEED, m]
        box[SEAT_PLACE + i] = place
        box[SEAT_SPEED + i] = speed


@inline
def bent_cup(lanes, bends, view, cosine, sine, structure):
    """Bend the cup as each roller sees it; ``bends``: the series of its lanes [1, SHOWN x series, lane].

    Returns ``view``: with the origin and the velocity of the piece of raceway at the roller;
    ``shift``: by how much the origin moved [m].

    Neglects the turn of the piece of raceway about the axle and its tilt.
    """
    zero = lanes.constant(0.0)
    if structure is None:
        return view, (zero, zero, zero)
    series = bends.shape[1] // SHOWN
    waves = series // 2
    deflection, slope = lanes.load(bends, 0, 0), zero
    speed, around = lanes.load(bends, 0, series), lanes.load(bends, 0, 2 * series)
    along = lanes.load(bends, 0, 3 * series)
    cosine_before, sine_before = lanes.constant(1.0), zero
    cosine_n, sine_n = cosine, sine
    for n in range(1, waves + 1):
        a, b = lanes.load(bends, 0, n), lanes.load(bends, 0, waves + n)
        deflection = deflection + (a * cosine_n + b * sine_n)
        slope = slope + float(n) * (b * cosine_n - a * sine_n)
        a, b = lanes.load(bends, 0, series + n), lanes.load(bends, 0, series + waves + n)
        speed = speed + (a * cosine_n + b * sine_n)
        a, b = lanes.load(bends, 0, 2 * series + n), lanes.load(bends, 0, 2 * series + waves + n)
        around = around + (a * cosine_n + b * sine_n)
        a, b = lanes.load(bends, 0, 3 * series + n), lanes.load(bends, 0, 3 * series + waves + n)
        along = along + (a * cosine_n + b * sine_n)
        cosine_next = 2.0 * cosine * cosine_n - cosine_before
        sine_next = 2.0 * cosine * sine_n - sine_before
        cosine_before, sine_before = cosine_n, sine_n
        cosine_n, sine_n = cosine_next, sine_next
    shift = (deflection, slope, zero)
    moving = add(view.velocity, (speed, around, along))
    return View(add(view.origin, shift), view.axis, moving, view.omega), shift


@inline
def about_rigid_cup(contact, shift, structure):
    """Place a contact from the origin of the rigid cup, about which reactions are summed."""
    if structure is None:
        return contact
    c, centre = contact, add(contact.centre, shift)
    return RacewayContact(c.line, c.slip, c.sums, c.lean, c.log2_speed, centre, c.body, c.damage)


@inline
def bend_cup(force, here, series, structure):
    """Add the work that the rollers' reaction does on a unit of each term of the series to the sums.

    ``force``: of the cup on the roller [N]; ``series``: terms of each.
    """
    if structure is None:
        return
    waves = series // 2
    radial, around, along = here.mask * force[0], here.mask * force[1], here.mask * force[2]
    accumulate(here, SUM_FIELDS, 0.0 - radial)
    accumulate(here, SUM_FIELDS + series, 0.0 - around)
    accumulate(here, SUM_FIELDS + 2 * series, 0.0 - along)
    cosine_before, sine_before = here.lanes.constant(1.0), here.lanes.constant(0.0)
    cosine_n, sine_n = here.cosine, here.sine
    for n in range(1, waves + 1):
        first = SUM_FIELDS + n
        accumulate(here, first, 0.0 - radial * cosine_n)
        accumulate(here, first + waves, 0.0 - radial * sine_n)
        accumulate(here, first + series, 0.0 - around * cosine_n)
        accumulate(here, first + series + waves, 0.0 - around * sine_n)
        accumulate(here, first + 2 * series, 0.0 - along * cosine_n)
        accumulate(here, first + 2 * series + waves, 0.0 - along * sine_n)
        cosine_next = 2.0 * here.cosine * cosine_n - cosine_before
        sine_next = 2.0 * here.cosine * sine_n - sine_before
        cosine_before, sine_before = cosine_n, sine_n
        cosine_n, sine_n = cosine_next, sine_next


@inline
def _collect_forces(sums, forces, series):
    """Sum the lanes into ``forces`` [row x 3 x series]."""
    width, rows = sums.shape[3], forces.shape[0] // (3 * series)
    for k in range(forces.shape[0]):
        forces[k] = 0.0
    for group in range(sums.shape[0]):
        for k in range(3 * series):
            for lane in range(width):
                row = row_of(group, lane, width, rows)
                forces[3 * series * row + k] += sums[group, 0, SUM_FIELDS + k, lane]


@inline
def kick_flex(flex, sums, box, signal, energy, step, bend, structure):
    """Accelerate the modes under rollers and suspension and return the bending energy, [J].

    The inertia of `StructureParams` makes this the exact free motion of a damped oscillator, so a mode may be
    as stiff as one likes. ``signal``: written behind `SIGNAL_CHANNELS`: acceleration of the sensors' seats.
    """
    if structure is None:
        return 0.0
    _collect_forces(sums, bend.forces, bend.lanes.shape[2] // SHOWN)
    _push_on_modes(structure.raceway, bend.forces, bend.push)
    _push_at_seats(box, bend.push, structure.suspension)
    stored = 0.0
    for m in range(flex.shape[1]):
        place, speed = flex[PLACE, m], flex[SPEED, m]
        push = bend.push[m] - structure.stiffness[m] * place - structure.damping[m] * speed
        change = step * push / structure.inertia[m]
        middle = speed + 0.5 * change
        energy[ENERGY_LOST + LOSS_STRUCTURE] += step * structure.damping[m] * middle * middle
        stored += 0.5 * structure.stiffness[m] * place * place
        flex[SPEED, m] = speed + change
        bend.push[m] = change
    _lose_at_seats(flex, bend.push, box, energy, step, structure.suspension)
    _shake_sensors(bend.push, signal, step, structure.sensors)
    return stored


@inline
def _push_at_seats(box, push, suspension):
    if suspension is None:
        return
    for m in range(push.shape[0]):
        for i in range(6):
            push[m] += suspension[i, m] * box[SUSPENSION + i]


@inline
def _lose_at_seats(flex, change, box, energy, step, suspension):
    """Add what the suspension's dampers take from the modes to the audit."""
    if suspension is None:
        return
    for i in range(6):
        middle = 0.0
        for m in range(change.shape[0]):
            middle += suspension[i, m] * (flex[SPEED, m] - 0.5 * change[m])
        energy[ENERGY_LOST + LOSS_SUSPENSION] += step * box[DAMPERS + i] * middle


@inline
def _shake_sensors(change, signal, step, sensors):
    """Write the acceleration that the modes give each sensor along x, y, z."""
    if sensors is None:
        return
    for k in range(sensors.shape[0]):
        total = 0.0
        for m in range(change.shape[0]):
            total += sensors[k, m] * change[m]
        signal[SIGNAL_CHANNELS + k] = total / step


@inline
def flex_energy(flex, structure):
    """Sum the kinetic energy of the modes, [J]."""
    if structure is None:
        return 0.0
    total = 0.0
    for m in range(flex.shape[1]):
        total += 0.5 * structure.mass[m] * flex[SPEED, m] ** 2
    return total
