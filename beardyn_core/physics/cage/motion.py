"""Motion of the cages as bodies: free, turning with the rings' mean place, or prescribed."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.rigid_bodies import (
    body_vector,
    fall,
    full_rotation,
    kick_cages,
    ring_direction,
    row_of,
)
from beardyn_core.physics.lanes.vectors import subtract

X, Y, Z = 0, 1, 2
_ON_CAGE = layout.REACTION + 6 * layout.CAGE_BODY


@inline
def cage_energy(bodies, cage):
    """Sum the kinetic energy of both cages, without a prescribed spin, [J]."""
    if cage is None:
        return 0.0
    return _energy(bodies, cage, cage.rotating, cage.kinematic)


@inline
def _energy(bodies, cage, rotating, kinematic):
    if kinematic is not None:
        return 0.0
    total = 0.0
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        total += 0.5 * cage.polar_inertia * bodies[body, layout.RATE] ** 2
        total += _tumbling_energy(bodies, body, cage, rotating)
    return total


@inline
def _tumbling_energy(bodies, body, cage, rotating):
    if rotating is not None:
        return 0.0
    total = 0.0
    for i in range(3):
        total += 0.5 * cage.mass * bodies[body, layout.LINEAR + i] ** 2
        total += 0.5 * cage.transverse_inertia * bodies[body, layout.ANGULAR + i] ** 2
    return total


@inline
def place_cages(bodies, cage):
    """Put cages that follow the rings at the mean of cup and cone; a free cage stays where it is."""
    if cage is None:
        return
    _place(bodies, cage, cage.rotating, cage.kinematic)


@inline
def _place(bodies, cage, rotating, kinematic):
    if rotating is None and kinematic is None:
        return
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        lift = cage.place if body > layout.CAGE_BODY else -cage.place
        for place, turn in ((layout.POSITION, layout.TILT), (layout.LINEAR, layout.ANGULAR)):
            for i in range(3):
                bodies[body, place + i] = 0.5 * (
                    bodies[layout.CUP_BODY, place + i] + bodies[layout.CONE_BODY, place + i]
                )
                bodies[body, turn + i] = 0.5 * (
                    bodies[layout.CUP_BODY, turn + i] + bodies[layout.CONE_BODY, turn + i]
                )
            # tilted rings carry the cages, which stand next to their centre
            bodies[body, place + X] -= lift * bodies[body, turn + Z]
            bodies[body, place + Z] += lift * bodies[body, turn + X]


@inline
def pass_on(bodies, wrenches, energy, step, cage, gravity):
    """Give what pushes cages that follow the rings, weight included, to cup and cone, half each.

    Only the moment about the cage's axis is left to the cage. That is exact: the cage moves with the mean of
    both, so the halves do the work of the whole.
    """
    if cage is None:
        return
    _pass_on(bodies, wrenches, energy, step, cage, gravity, cage.rotating, cage.kinematic)


@inline
def _pass_on(bodies, wrenches, energy, step, cage, gravity, rotating, kinematic):
    if rotating is None and kinematic is None:
        return
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        lift = cage.place if body > layout.CAGE_BODY else -cage.place
        pull = -cage.mass * fall(gravity)
        energy[layout.ENERGY_EXTERNAL] += step * pull * bodies[body, layout.LINEAR + Z]
        axis = ring_direction(bodies, body)
        fx, fy, fz = wrenches[body, X], wrenches[body, Y], wrenches[body, Z] + pull
        about = wrenches[body, 3] * axis[0] + wrenches[body, 4] * axis[1] + wrenches[body, 5] * axis[2]
        for ring in range(layout.CUP_BODY, layout.CONE_BODY + 1):
            x = bodies[body, layout.POSITION + X] - bodies[ring, layout.POSITION + X]
            y = bodies[body, layout.POSITION + Y] - bodies[ring, layout.POSITION + Y] + lift
            z = bodies[body, layout.POSITION + Z] - bodies[ring, layout.POSITION + Z]
            wrenches[ring, X] += 0.5 * fx
            wrenches[ring, Y] += 0.5 * fy
            wrenches[ring, Z] += 0.5 * fz
            wrenches[ring, 3] += 0.5 * (wrenches[body, 3] - about * axis[0] + y * fz - z * fy)
            wrenches[ring, 4] += 0.5 * (wrenches[body, 4] - about * axis[1] + z * fx - x * fz)
            wrenches[ring, 5] += 0.5 * (wrenches[body, 5] - about * axis[2] + x * fy - y * fx)
        for i in range(3):
            wrenches[body, i] = 0.0
            wrenches[body, 3 + i] = about * axis[i]


@inline
def move_cages(bodies, wrenches, energy, step, cage, gravity):
    """Accelerate both cages, or set their prescribed speed and book the work that takes."""
    if cage is None:
        return
    _move(bodies, wrenches, energy, step, cage, gravity, cage.rotating, cage.kinematic)


@inline
def _move(bodies, wrenches, energy, step, cage, gravity, rotating, kinematic):
    if rotating is None and kinematic is None:
        kick_cages(bodies, wrenches, energy, step, cage, gravity)
        return
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        axis = ring_direction(bodies, body)
        about = wrenches[body, 3] * axis[0] + wrenches[body, 4] * axis[1] + wrenches[body, 5] * axis[2]
        _turn(bodies, body, about, energy, step, cage, kinematic)


@inline
def _turn(bodies, body, about, energy, step, cage, kinematic):
    if kinematic is None:
        bodies[body, layout.RATE] += step * about / cage.polar_inertia
        return
    before = bodies[body, layout.RATE]
    bodies[body, layout.RATE] = kinematic.speed_ratio * bodies[layout.CONE_BODY, layout.RATE]
    energy[layout.ENERGY_EXTERNAL] -= step * about * 0.5 * (before + bodies[body, layout.RATE])


@inline
def cage_motions(bodies, cage, audit):
    """Take the velocity and angular velocity of both cages; zeros where nothing needs them."""
    if cage is None:
        return _at_rest(), _at_rest()
    if audit is None:
        return _at_rest(), _at_rest()
    return _motion(bodies, layout.CAGE_BODY), _motion(bodies, layout.CAGE_BODY + 1)


@inline
def _at_rest():
    return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


@inline
def _motion(bodies, body):
    if body >= bodies.shape[0]:  # the cage of a row that is not there
        return _at_rest()
    return body_vector(bodies, body, layout.LINEAR), full_rotation(bodies, body, ring_direction(bodies, body))


@inline
def settle_cages(bodies, before, sums, energy, step, cage, audit):
    """Take the pockets' loss at the middle of the step that has changed the motion of the cages.

    ``before``: from `cage_motions`, before the cages were moved. Returns what the springs of the pockets gave
    the cages in the step, a quarter of it, [J]: see `pocket.settle_pocket`.
    """
    if cage is None:
        return 0.0
    if audit is None:
        return 0.0
    return _settle(bodies, before, sums, energy, step)


@inline
def _settle(bodies, before, sums, energy, step):
    width, rows = sums.shape[3], bodies.shape[0] - layout.CAGE_BODY
    lost, whole = 0.0, 0.0
    for row in range(rows):
        after, side = _motion(bodies, layout.CAGE_BODY + row), 2.0 * row - 1.0
        faster, turning = subtract(after[0], before[row][0]), subtract(after[1], before[row][1])
        # in the frame of the row, see `bodies.show_rings`
        change = (faster[Z], faster[X], side * faster[Y], side * turning[Z], side * turning[X], turning[Y])
        for group in range(sums.shape[0]):
            for lane in range(width):
                if row_of(group, lane, width, rows) == row:
                    for i in range(6):
                        lost += sums[group, 0, layout.LOST_ON_CAGE + i, lane] * change[i]
                        whole += sums[group, 0, _ON_CAGE + i, lane] * change[i]
    energy[layout.ENERGY_LOST + layout.LOSS_POCKET] -= 0.5 * step * lost
    return 0.25 * step * (whole - lost)
