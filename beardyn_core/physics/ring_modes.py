"""Bending of the axlebox within a step: a modal body that the rollers bend, and that moves their raceway.

The modes have unit modal mass; ``flex`` [2, mode] holds their places [m sqrt(kg)] and speeds (positions at
whole steps, velocities half a step later, like all bodies). Once a step they give the displacement around
each raceway as a Fourier series of the azimuth; each roller walks through its waves.

Seen from one roller, a bent raceway is to first order the round one moved by w outwards and by dw/dt along
the orbit: that gives its gap, the slope of its normal and the shifted contact point in one go. On a cone of
the angle alpha an axial displacement u counts in the gap as -u tan(alpha) outwards, so w is the radial
displacement less that. The slope is what makes the normal force conservative, so the energy audit closes.

Series and their waves: see `modal_body`.
"""

from __future__ import annotations

from functools import partial
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import FASTMATH, entry, inline
from beardyn_core.physics.bodies.arrangement import Arrangement, aligned_zeros
from beardyn_core.physics.bodies.contact_output import accumulate
from beardyn_core.physics.bodies.layout import (
    ENERGY_LOST,
    LOSS_STRUCTURE,
    LOSS_SUSPENSION,
    SIGNAL_CHANNELS,
    SUM_FIELDS,
)
from beardyn_core.physics.bodies.orbit import View
from beardyn_core.physics.lanes.vectors import add
from beardyn_core.physics.modal_body import ModalBody, first_waves
from beardyn_core.physics.oscillators import exact_oscillators
from beardyn_core.physics.raceway import RacewayContact
from beardyn_core.physics.suspension import DAMPERS, SEAT_PLACE, SEAT_SPEED, SUSPENSION
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import seat_of

WAVES_OF_SLIP = 2  # around and along the cone, where only friction works: a third wave brings no more


class StructureParams(NamedTuple):
    """Modes with unit modal mass, whose free motion is exact from step to step."""

    # [mode, read], of each row the series of the opening, around and along the cone, axial outwards, then
    # motion of the bearing centre that stretches the springs alike [1/sqrt(kg)]; zeros fill up to multiples
    # of 4 and 8
    shapes: Any
    rows: int
    series: int  # terms of the opening
    slips: int  # terms around, and as many along
    taper: float  # tangent of the cup's cone angle
    stiffness: Any  # [mode], square of the rate [1/s^2]
    damping: Any  # [mode], [1/s]
    inertia: Any  # [mode], of the step, with the damper's half step [-]
    mass: Any  # [mode], inertia without the damper [-]
    seats: Any  # [6 + 3 x sensor, mode], those of the suspension as above, then of the sensors [1/sqrt(kg)]
    sides: Any  # [group, 2, lane], 1 in lanes of row 0, and 1 in lanes of the other row


def structure_params(
    body: ModalBody | None, scene: Scene, arrangement: Arrangement, step: float
) -> StructureParams | None:
    """Work out the parameters of a modal body for a time step [s]."""
    if body is None:
        return None
    slip = first_waves(body.raceway[:, :, 1:], WAVES_OF_SLIP)
    count, rows, _, slips = slip.shape
    parts = [np.concatenate([body.opening, slip.reshape(count, rows, -1)], axis=2).reshape(count, -1)]
    parts.append(np.zeros((count, 6)) if body.suspension is None else body.suspension.T)
    reads = np.concatenate(parts, axis=1)
    modes = -(-count // 4) * 4
    shapes = np.zeros((modes, -(-reads.shape[1] // 8) * 8))
    shapes[:count, : reads.shape[1]] = reads

    def filled(values: Float, rest: float = 0.0) -> Float:
        return np.concatenate([values, np.full(modes - count, rest)])

    mass, damping, inertia = exact_oscillators(body.rate, body.damping_ratio, step)
    seats = np.zeros((6, modes))
    seats[:, :count] = 0.0 if body.suspension is None else body.suspension
    if body.modes is not None:
        read = [body.modes.seats[seat_of(sensor, body.modes)] for sensor in scene.sensors]
        sensors = np.zeros((3 * len(read), modes))
        sensors[:, :count] = np.concatenate(read, axis=1).T
        seats = np.concatenate([seats, sensors])
    sides = aligned_zeros(arrangement.group_count, 2, arrangement.width)
    for group in range(arrangement.group_count):
        for lane in range(arrangement.width):
            row = group if arrangement.width == 1 else arrangement.rows * lane // arrangement.width
            sides[group, row, lane] = 1.0
    return StructureParams(
        shapes,
        rows,
        body.raceway.shape[-1],
        slips,
        body.taper,
        filled(body.stiffness),
        filled(damping),
        filled(inertia, 1.0),
        filled(mass, 1.0),
        seats,
        sides,
    )


PLACE, SPEED = 0, 1


# sums may be taken in any order here, so that they go into vectors
_sums_in_any_order = partial(entry, flags=(*FASTMATH, "reassoc"))


@_sums_in_any_order
def _bend(shapes, flex, step, bent):
    """Move the modes along their velocities and add their shapes, four at a time, into ``bent`` [2, read]."""
    for m in range(flex.shape[1]):
        flex[PLACE, m] += step * flex[SPEED, m]
    for k in range(shapes.shape[1]):
        bent[PLACE, k] = 0.0
        bent[SPEED, k] = 0.0
    for m in range(0, shapes.shape[0], 4):
        place, place1, place2, place3 = flex[PLACE, m : m + 4]
        speed, speed1, speed2, speed3 = flex[SPEED, m : m + 4]
        for k in range(shapes.shape[1]):
            one, two, three, four = shapes[m, k], shapes[m + 1, k], shapes[m + 2, k], shapes[m + 3, k]
            bent[PLACE, k] += place * one + place1 * two + place2 * three + place3 * four
            bent[SPEED, k] += speed * one + speed1 * two + speed2 * three + speed3 * four


@_sums_in_any_order
def _kick(structure, flex, forces, change, step):
    """Accelerate all modes under forces [read]; gives the bending energy and what is lost, [J]."""
    shapes = structure.shapes
    for m in range(0, shapes.shape[0], 4):
        one, two, three, four = 0.0, 0.0, 0.0, 0.0
        for k in range(shapes.shape[1]):
            force = forces[k]
            one += shapes[m, k] * force
            two += shapes[m + 1, k] * force
            three += shapes[m + 2, k] * force
            four += shapes[m + 3, k] * force
        change[m], change[m + 1], change[m + 2], change[m + 3] = one, two, three, four
    stored, lost = 0.0, 0.0
    for m in range(shapes.shape[0]):
        place, speed = flex[PLACE, m], flex[SPEED, m]
        spring = structure.stiffness[m] * place
        change[m] = step * (change[m] - spring - structure.damping[m] * speed) / structure.inertia[m]
        middle = speed + 0.5 * change[m]
        lost += structure.damping[m] * middle * middle
        stored += 0.5 * spring * place
        flex[SPEED, m] = speed + change[m]
    return stored, step * lost


@_sums_in_any_order
def _at_seats(seats, change, found):
    """Work out the change of speed of every seat, ``found`` [6 of the suspension, then 3 x sensor]."""
    for k in range(seats.shape[0]):
        total = 0.0
        for m in range(change.shape[0]):
            total += seats[k, m] * change[m]
        found[k] = total


@inline
def show_structure(lanes, flex, box, step, bend, structure):
    """Move all modes along their velocities, and write how raceways and seats of the suspension give way.

    ``bend``: a `BendSpace`; the seats stand in ``box``, as motion of the bearing centre.
    """
    if structure is None:
        return
    _bend(structure.shapes, flex, step, bend.bent)
    series, count = structure.series, structure.series + 2 * structure.slips
    other = count * (structure.rows - 1)
    for group in range(bend.lanes.shape[0]):
        target = bend.lanes[group]
        near, far = lanes.load(structure.sides, group, 0), lanes.load(structure.sides, group, 1)
        for k in range(series):
            lanes.store(target, 0, k, near * bend.bent[PLACE, k] + far * bend.bent[PLACE, other + k])
        for k in range(count):
            lanes.store(target, 0, series + k, near * bend.bent[SPEED, k] + far * bend.bent[SPEED, other + k])
    first = other + count
    for i in range(6):
        box[SEAT_PLACE + i] = bend.bent[PLACE, first + i]
        box[SEAT_SPEED + i] = bend.bent[SPEED, first + i]


@inline
def bent_cup(lanes, bends, view, radius, cosine, sine, structure):
    """Bend the cup as each roller at a ``radius`` [m] sees it; ``bends``: ``lanes`` of a `BendSpace`.

    Returns ``view``: with the origin and the velocity of the piece of raceway at the roller;
    ``shift``: by how much the origin moved [m].

    Neglects the turn of the piece of raceway about the axle and its tilt.
    """
    zero = lanes.constant(0.0)
    if structure is None:
        return view, (zero, zero, zero)
    series, slips = structure.series, structure.slips
    waves, few = series // 2, slips // 2
    first, second = 2 * series, 2 * series + slips
    deflection, slope = lanes.load(bends, 0, 0), zero
    speed, around = lanes.load(bends, 0, series), lanes.load(bends, 0, first)
    along = lanes.load(bends, 0, second)
    cosine_before, sine_before = lanes.constant(1.0), zero
    cosine_n, sine_n = cosine, sine
    for n in range(1, waves + 1):
        a, b = lanes.load(bends, 0, n), lanes.load(bends, 0, waves + n)
        deflection = deflection + (a * cosine_n + b * sine_n)
        slope = slope + float(n) * (b * cosine_n - a * sine_n)
        a, b = lanes.load(bends, 0, series + n), lanes.load(bends, 0, series + waves + n)
        speed = speed + (a * cosine_n + b * sine_n)
        if n <= few:
            a, b = lanes.load(bends, 0, first + n), lanes.load(bends, 0, first + few + n)
            around = around + (a * cosine_n + b * sine_n)
            a, b = lanes.load(bends, 0, second + n), lanes.load(bends, 0, second + few + n)
            along = along + (a * cosine_n + b * sine_n)
        cosine_next = 2.0 * cosine * cosine_n - cosine_before
        sine_next = 2.0 * cosine * sine_n - sine_before
        cosine_before, sine_before = cosine_n, sine_n
        cosine_n, sine_n = cosine_next, sine_next
    # the gap of the shifted circle is that of the bent one, and its push along the orbit the slope of its
    # energy, to second order: to the first alone a static bend of 0.1 mm feeds 1e-4 of the losses
    ahead = slope * (1.0 - deflection / radius)
    shift = (deflection + 0.5 * ahead * ahead / radius, ahead, zero)
    moving = add(view.velocity, (speed + structure.taper * along, around, along))
    return View(add(view.origin, shift), view.axis, moving, view.omega), shift


@inline
def about_rigid_cup(contact, shift, structure):
    """Place a contact from the origin of the rigid cup, about which reactions are summed."""
    if structure is None:
        return contact
    c, centre = contact, add(contact.centre, shift)
    return RacewayContact(
        c.line, c.slip, c.sums, c.lean, c.log2_speed, centre, c.body, c.damage, c.held, c.barrel
    )


@inline
def bend_cup(force, here, structure):
    """Add the work that the rollers' reaction does on a unit of each term of the series to the sums.

    ``force``: of the cup on the roller [N].
    """
    if structure is None:
        return
    waves, few = structure.series // 2, structure.slips // 2
    first = SUM_FIELDS + structure.series
    second = first + structure.slips
    against = 0.0 - here.mask
    opening, around = against * force[0], against * force[1]
    along = against * (force[2] + structure.taper * force[0])
    accumulate(here, SUM_FIELDS, opening)
    accumulate(here, first, around)
    accumulate(here, second, along)
    cosine_before, sine_before = here.lanes.constant(1.0), here.lanes.constant(0.0)
    cosine_n, sine_n = here.cosine, here.sine
    for n in range(1, waves + 1):
        accumulate(here, SUM_FIELDS + n, opening * cosine_n)
        accumulate(here, SUM_FIELDS + waves + n, opening * sine_n)
        if n <= few:
            accumulate(here, first + n, around * cosine_n)
            accumulate(here, first + few + n, around * sine_n)
            accumulate(here, second + n, along * cosine_n)
            accumulate(here, second + few + n, along * sine_n)
        cosine_next = 2.0 * here.cosine * cosine_n - cosine_before
        sine_next = 2.0 * here.cosine * sine_n - sine_before
        cosine_before, sine_before = cosine_n, sine_n
        cosine_n, sine_n = cosine_next, sine_next


@_sums_in_any_order
def _collect_forces(sums, forces, rows, count):
    """Sum the lanes' forces on the ``count`` terms around each raceway into ``forces`` [read]."""
    width = sums.shape[3]
    share = width // rows if width > 1 else 1
    for row in range(rows):
        group, lane = (0, row * share) if width > 1 else (row, 0)
        for k in range(count):
            field = SUM_FIELDS + k
            if share == 4:
                total = sums[group, 0, field, lane] + sums[group, 0, field, lane + 1]
                total += sums[group, 0, field, lane + 2] + sums[group, 0, field, lane + 3]
            else:
                total = 0.0
                for i in range(share):
                    total += sums[group, 0, field, lane + i]
            forces[count * row + k] = total


@inline
def kick_structure(flex, sums, box, signal, energy, step, bend, structure):
    """Accelerate the modes under rollers and suspension and return the bending energy, [J].

    The inertia of `StructureParams` makes this the exact free motion of a damped oscillator, so a mode may be
    as stiff as one likes. ``signal``: written behind `SIGNAL_CHANNELS`: acceleration of the sensors' seats.
    """
    if structure is None:
        return 0.0
    count = structure.series + 2 * structure.slips
    _collect_forces(sums, bend.forces, structure.rows, count)
    for i in range(6):
        bend.forces[count * structure.rows + i] = box[SUSPENSION + i]
    stored, lost = _kick(structure, flex, bend.forces, bend.change, step)
    energy[ENERGY_LOST + LOSS_STRUCTURE] += lost
    _at_seats(structure.seats, bend.change, bend.seats)
    for i in range(6):
        middle = box[SEAT_SPEED + i] + 0.5 * bend.seats[i]
        energy[ENERGY_LOST + LOSS_SUSPENSION] += step * box[DAMPERS + i] * middle
    for k in range(structure.seats.shape[0] - 6):
        signal[SIGNAL_CHANNELS + k] = bend.seats[6 + k] / step
    return stored


@inline
def structure_energy(flex, structure):
    """Sum the kinetic energy of the modes, [J]."""
    if structure is None:
        return 0.0
    total = 0.0
    for m in range(flex.shape[1]):
        total += 0.5 * structure.mass[m] * flex[SPEED, m] ** 2
    return total
