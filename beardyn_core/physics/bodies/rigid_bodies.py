"""Cup with axlebox, cones on the journal, and the two cages: scalar rigid bodies, world axes.

They are slow and heavy against the rollers and advanced explicitly, positions at whole steps and
velocities half a step later. Tilts are small rotation vectors; the spin about +y is kept apart.
"""

from __future__ import annotations

import math

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.lanes.vectors import add, add_scaled, subtract

X, Y, Z = 0, 1, 2
LOAD_SPEED, LOAD_BOGIE = 6, 7  # after the six components of the load


@inline
def row_of(group, lane, width, rows):
    """Find which row's rollers a lane of a group holds."""
    if width == 1:
        return group
    return rows * lane // width


@inline
def lane_total(sums, field):
    """Sum of a field over the lanes."""
    inner, outer = row_totals(sums, field)
    return inner + outer


@inline
def row_totals(sums, field):
    """Sum of a field over the lanes of each row."""
    half = sums.shape[3] // 2
    if half == 4:  # without a loop
        low = sums[0, 0, field, 0] + sums[0, 0, field, 1] + (sums[0, 0, field, 2] + sums[0, 0, field, 3])
        high = sums[0, 0, field, 4] + sums[0, 0, field, 5] + (sums[0, 0, field, 6] + sums[0, 0, field, 7])
        return low, high
    inner, outer = 0.0, 0.0
    for lane in range(half):
        inner += sums[0, 0, field, lane]
        outer += sums[0, 0, field, half + lane]
    return inner, outer


@inline
def drift_bodies(bodies, step):
    """Move all bodies along their velocities."""
    for body in range(bodies.shape[0]):
        for i in range(3):
            bodies[body, layout.POSITION + i] += step * bodies[body, layout.LINEAR + i]
            bodies[body, layout.TILT + i] += step * bodies[body, layout.ANGULAR + i]
        bodies[body, layout.TURN] += step * bodies[body, layout.RATE]


@inline
def ring_direction(bodies, body):
    """Work out the unit axis of a body that stands along +y without tilt, to second order in the tilt."""
    a, b, c = bodies[body, layout.TILT + X], bodies[body, layout.TILT + Y], bodies[body, layout.TILT + Z]
    x = -c + 0.5 * a * b
    y = 1.0 - 0.5 * (a * a + c * c)
    z = a + 0.5 * b * c
    length = math.sqrt(x * x + y * y + z * z)
    return x / length, y / length, z / length


@inline
def body_vector(bodies, body, field):
    """Take three numbers of a body that stand one after the other."""
    return bodies[body, field], bodies[body, field + 1], bodies[body, field + 2]


@inline
def full_rotation(bodies, body, axis):
    """Work out the angular velocity of a body with its spin about its axis, [rad/s]."""
    return add_scaled(body_vector(bodies, body, layout.ANGULAR), bodies[body, layout.RATE], axis)


@inline
def _set_polar(rings, ring, field, lane, side, vector):
    rings[ring, field, lane] = vector[2]
    rings[ring, field + 1, lane] = vector[0]
    rings[ring, field + 2, lane] = side * vector[1]


@inline
def _set_axial(rings, ring, field, lane, side, vector):
    rings[ring, field, lane] = side * vector[2]
    rings[ring, field + 1, lane] = side * vector[0]
    rings[ring, field + 2, lane] = vector[1]


@inline
def show_rings(bodies, rings, cage_place):
    """Write cup, cone and cages in the row frames of every lane.

    Cup and cone show the velocity that they will have at the end of the step if they go on accelerating.
    Friction that hardly slips holds a roller at the ring's velocity. With that of the step before, all that
    the roller is pressed with would follow the ring a step late: such a spring feeds a mode of the rate w by
    up to w^2 h / 2, which at rest is more than the contacts damp.

    ``rings`` [group, ring, RING_FIELDS, lane]: written, origins relative to the cup's; ``cage_place``:
    axial place of a cage's centre of mass from the middle plane [m].
    """
    width, rows = rings.shape[3], bodies.shape[0] - layout.CAGE_BODY
    for group in range(rings.shape[0]):
        for lane in range(width):
            row = row_of(group, lane, width, rows)
            side = 2.0 * row - 1.0
            for ring in range(3):
                body = ring + row if ring == layout.CAGE_BODY else ring
                axis, view = ring_direction(bodies, body), rings[group]
                lift = side * cage_place if ring == layout.CAGE_BODY else 0.0
                place = subtract(
                    body_vector(bodies, body, layout.POSITION),
                    body_vector(bodies, layout.CUP_BODY, layout.POSITION),
                )
                place = (place[0], place[1] + lift, place[2])
                _set_polar(view, ring, layout.RING_ORIGIN, lane, side, place)
                if ring == layout.CAGE_BODY:
                    _set_axial(
                        view, ring, layout.RING_AXIS, lane, side, body_vector(bodies, body, layout.TILT)
                    )
                    view[ring, layout.RING_TURN, lane] = bodies[body, layout.TURN]
                else:
                    _set_axial(view, ring, layout.RING_AXIS, lane, side, axis)
                    view[ring, layout.RING_TURN, lane] = (
                        bodies[body, layout.TURN] + bodies[body, layout.TILT + Y]
                    )
                velocity, omega = body_vector(bodies, body, layout.LINEAR), full_rotation(bodies, body, axis)
                _set_polar(view, ring, layout.RING_DRIFT, lane, side, velocity)
                if ring != layout.CAGE_BODY:
                    velocity = add(velocity, body_vector(bodies, body, layout.CHANGE))
                    omega = add(omega, body_vector(bodies, body, layout.CHANGE + 3))
                _set_polar(view, ring, layout.RING_VELOCITY, lane, side, velocity)
                _set_axial(view, ring, layout.RING_OMEGA, lane, side, omega)


@inline
def collect_reactions(sums, wrenches):
    """Sum the lane reactions into world wrenches [body, 6] about each body's origin."""
    width, rows = sums.shape[3], wrenches.shape[0] - layout.CAGE_BODY
    wrenches[:, :] = 0.0
    for group in range(sums.shape[0]):
        for lane in range(width):
            row = row_of(group, lane, width, rows)
            side = 2.0 * row - 1.0
            for ring in range(3):
                body = ring + row if ring == layout.CAGE_BODY else ring
                first = layout.REACTION + 6 * ring
                wrenches[body, Z] += sums[group, 0, first, lane]
                wrenches[body, X] += sums[group, 0, first + 1, lane]
                wrenches[body, Y] += side * sums[group, 0, first + 2, lane]
                wrenches[body, 3 + Z] += side * sums[group, 0, first + 3, lane]
                wrenches[body, 3 + X] += side * sums[group, 0, first + 4, lane]
                wrenches[body, 3 + Y] += sums[group, 0, first + 5, lane]


@inline
def fall(gravity):
    """Work out the acceleration of free fall, 0 without gravity, [m/s^2]."""
    if gravity is None:
        return 0.0
    return gravity.acceleration


@inline
def kick_cup(bodies, wrench, load, load_before, energy, box, step, mounting, gravity):
    """Accelerate the axlebox under rollers, suspension and weight; returns the suspension's energy, [J].

    ``wrench`` [6]: of the rollers on the cup [N, N m]; ``load``, ``load_before``: load row at the end and at
    the beginning of the step; bogie displacement from `LOAD_BOGIE`; ``box``: written in front: acceleration
    of the box, linear and angular.
    """
    stored = 0.0
    if mounting.cup_moves == 0.0:
        box[:] = 0.0
        return stored
    for i in range(6):
        if i < 3:
            inertia = mounting.box_mass
            bogie = load[LOAD_BOGIE + i]
            bogie_speed = (bogie - load_before[LOAD_BOGIE + i]) / step
        else:
            inertia = mounting.box_inertia[i - 3]
            bogie, bogie_speed = 0.0, 0.0
        # tilts stand behind places, angular behind linear velocities
        place = bodies[layout.CUP_BODY, layout.POSITION + i]
        speed = bodies[layout.CUP_BODY, layout.LINEAR + i]
        stretch = place - bogie
        damper = mounting.damping[i] * (speed - bogie_speed)
        suspension = mounting.preload[i] - mounting.stiffness[i] * stretch - damper
        pull = -mounting.box_mass * fall(gravity) if i == Z else 0.0
        acceleration = (wrench[i] + suspension + pull) / inertia
        box[i] = acceleration
        middle = speed + 0.5 * step * acceleration
        energy[layout.ENERGY_EXTERNAL] += step * (suspension * bogie_speed + pull * middle)
        energy[layout.ENERGY_LOST + layout.LOSS_SUSPENSION] += step * damper * (middle - bogie_speed)
        stored += 0.5 * mounting.stiffness[i] * stretch * stretch - mounting.preload[i] * stretch
        bodies[layout.CUP_BODY, layout.LINEAR + i] = speed + step * acceleration
        bodies[layout.CUP_BODY, layout.CHANGE + i] = step * acceleration
    return stored


@inline
def kick_cone(bodies, wrench, load, energy, step, mounting):
    """Accelerate the journal under rollers, load and axial prop at prescribed spin.

    The prop is a spring with a damper between journal and ground along the axle: the other bearing of the
    wheelset, or the guide of a test rig. The gyroscopic moment of the wheelset is neglected.

    Returns ``torque``: on the shaft [N m]; ``stored``: elastic energy of the prop [J].
    """
    place, along = bodies[layout.CONE_BODY, layout.POSITION + Y], bodies[layout.CONE_BODY, layout.LINEAR + Y]
    damper = mounting.prop_damping * along
    prop = -mounting.prop_stiffness * place - damper
    ax, ay, az = ring_direction(bodies, layout.CONE_BODY)
    torque = wrench[3] * ax + wrench[4] * ay + wrench[5] * az
    energy[layout.ENERGY_EXTERNAL] -= step * torque * bodies[layout.CONE_BODY, layout.RATE]
    for i in range(3):
        push = wrench[i] + load[i]
        if i == Y:
            push += prop
        acceleration = push / mounting.journal_mass
        middle = bodies[layout.CONE_BODY, layout.LINEAR + i] + 0.5 * step * acceleration
        energy[layout.ENERGY_EXTERNAL] += step * load[i] * middle
        if i == Y:
            energy[layout.ENERGY_LOST + layout.LOSS_SUSPENSION] += step * damper * middle
        bodies[layout.CONE_BODY, layout.LINEAR + i] += step * acceleration
        bodies[layout.CONE_BODY, layout.CHANGE + i] = step * acceleration
    if mounting.journal_tilts != 0.0:
        for i in range(0, 3, 2):
            acceleration = (wrench[3 + i] + load[3 + i]) / mounting.journal_inertia
            middle = bodies[layout.CONE_BODY, layout.ANGULAR + i] + 0.5 * step * acceleration
            energy[layout.ENERGY_EXTERNAL] += step * load[3 + i] * middle
            bodies[layout.CONE_BODY, layout.ANGULAR + i] += step * acceleration
            bodies[layout.CONE_BODY, layout.CHANGE + 3 + i] = step * acceleration
    bodies[layout.CONE_BODY, layout.RATE] = load[LOAD_SPEED]
    return torque, 0.5 * mounting.prop_stiffness * place * place


@inline
def kick_cages(bodies, wrenches, energy, step, cage, gravity):
    """Accelerate both cages under pocket forces and weight, gyroscopic moment included."""
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        for i in range(3):
            pull = -cage.mass * fall(gravity) if i == Z else 0.0
            acceleration = (wrenches[body, i] + pull) / cage.mass
            middle = bodies[body, layout.LINEAR + i] + 0.5 * step * acceleration
            energy[layout.ENERGY_EXTERNAL] += step * pull * middle
            bodies[body, layout.LINEAR + i] += step * acceleration
        ax, ay, az = ring_direction(bodies, body)
        spinning = cage.polar_inertia * bodies[body, layout.RATE]
        about_axis = wrenches[body, 3] * ax + wrenches[body, 4] * ay + wrenches[body, 5] * az
        # transverse Euler equations of a spinning ring, I_t w' + w x (I_p rate y) = M, one axis after the
        # other: that keeps free nutation from growing
        bodies[body, layout.ANGULAR + X] += (
            step
            * (wrenches[body, 3] - about_axis * ax + spinning * bodies[body, layout.ANGULAR + Z])
            / cage.transverse_inertia
        )
        bodies[body, layout.ANGULAR + Z] += (
            step
            * (wrenches[body, 5] - about_axis * az - spinning * bodies[body, layout.ANGULAR + X])
            / cage.transverse_inertia
        )
        bodies[body, layout.RATE] += step * about_axis / cage.polar_inertia


@inline
def collect_energy(sums, energy, effects, audit):
    """Add to the audit what the rollers lost in this step and what weight gave them.

    Sources of effects that are absent are not summed: 16 lanes one after the other take time.
    """
    if audit is None:
        return
    energy[layout.ENERGY_EXTERNAL] += sum_lanes(sums, layout.WORK_GRAVITY)
    energy[layout.ENERGY_NUMERICAL] += sum_lanes(sums, layout.WORK_NUMERICAL)
    _collect_loss(sums, energy, layout.LOSS_SLIDING, audit)
    _collect_loss(sums, energy, layout.LOSS_DAMPING, audit)
    _collect_loss(sums, energy, layout.LOSS_ROLLING, effects.rolling)
    _collect_loss(sums, energy, layout.LOSS_RIB, effects.rib)
    _collect_loss(sums, energy, layout.LOSS_RIB, effects.flanges)
    _collect_loss(sums, energy, layout.LOSS_SMALL_RIB, effects.small_rib)
    _collect_loss(sums, energy, layout.LOSS_POCKET, effects.cage)
    _collect_loss(sums, energy, layout.LOSS_DRAG, effects.drag)


@inline
def _collect_loss(sums, energy, source, effect):
    if effect is None:
        return
    energy[layout.ENERGY_LOST + source] += sum_lanes(sums, layout.WORK_LOST + source)


@inline
def sum_lanes(sums, field):
    """Sum of one field over groups and lanes."""
    total = 0.0
    for group in range(sums.shape[0]):
        for lane in range(sums.shape[3]):
            total += sums[group, 0, field, lane]
    return total
