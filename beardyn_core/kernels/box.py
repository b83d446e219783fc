"""The axlebox, with its centre of mass and its springs at the bearing centre or beside it.

The springs act at seats that give way when the box bends: as much as the bearing centre would have to move
for the same stretch, which `structure` and `kinematic_bending` write into the work space.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.kernels.bodies import LOAD_BOGIE, fall, kick_cup
from beardyn_core.model import layout

# in the work space, after the acceleration: all forces, those of the suspension and of its dampers alone,
# then how far and how fast its seats give way
FORCE, SUSPENSION, DAMPERS, SEAT_PLACE, SEAT_SPEED = range(6, 36, 6)
BOX_FIELDS = 36


@inline
def kick_box(bodies, wrench, load, load_before, energy, box, step, mounting, gravity, coupling):
    """Accelerate the axlebox; arguments and result as `kick_cup`, with full matrices when coupled.

    ``box`` [BOX_FIELDS]: read: motion of the seats; written: acceleration of the bearing centre and forces.

    Small tilts and rates: centrifugal and gyroscopic terms of the box are neglected.
    """
    if coupling is None:
        return kick_cup(bodies, wrench, load, load_before, energy, box, step, mounting, gravity)
    stored = 0.0
    if mounting.cup_moves == 0.0:
        box[:] = 0.0
        return stored
    for i in range(6):
        spring, damper = 0.0, 0.0
        for j in range(6):
            spring += coupling.stiffness[i, j] * (_stretch(bodies, load, j) + box[SEAT_PLACE + j])
            speed = _speed(bodies, j) + box[SEAT_SPEED + j]
            damper += coupling.damping[i, j] * (speed - _bogie_speed(load, load_before, step, j))
        box[DAMPERS + i] = damper
        box[SUSPENSION + i] = mounting.preload[i] - spring - damper
        pull = coupling.weight[i] * fall(gravity)
        box[FORCE + i] = wrench[i] + mounting.preload[i] - spring - damper + pull
        stretch = _stretch(bodies, load, i) + box[SEAT_PLACE + i]
        stored += 0.5 * spring * stretch - mounting.preload[i] * stretch
    for i in range(6):
        acceleration = 0.0
        for j in range(6):
            acceleration += coupling.inverse_mass[i, j] * box[FORCE + j]
        box[i] = acceleration
    for i in range(6):
        middle = _speed(bodies, i) + 0.5 * step * box[i]
        bogie_speed = _bogie_speed(load, load_before, step, i)
        pull = coupling.weight[i] * fall(gravity)
        energy[layout.ENERGY_EXTERNAL] += step * (box[SUSPENSION + i] * bogie_speed + pull * middle)
        lost = step * box[DAMPERS + i] * (middle - bogie_speed)
        energy[layout.ENERGY_LOST + layout.LOSS_SUSPENSION] += lost
    for i in range(6):
        bodies[layout.CUP_BODY, layout.LINEAR + i] += step * box[i]  # angular ones stand behind
        bodies[layout.CUP_BODY, layout.CHANGE + i] = step * box[i]
    return stored


@inline
def box_energy(bodies, mounting, coupling):
    """Sum the kinetic energy of the axlebox with the cup, [J]."""
    total = 0.0
    if coupling is None:
        for i in range(3):
            total += 0.5 * mounting.box_mass * bodies[layout.CUP_BODY, layout.LINEAR + i] ** 2
            total += 0.5 * mounting.box_inertia[i] * bodies[layout.CUP_BODY, layout.ANGULAR + i] ** 2
        return total
    for i in range(6):
        for j in range(6):
            total += 0.5 * _speed(bodies, i) * coupling.mass[i, j] * _speed(bodies, j)
    return total


@inline
def _stretch(bodies, load, i):
    if i < 3:
        return bodies[layout.CUP_BODY, layout.POSITION + i] - load[LOAD_BOGIE + i]
    return bodies[layout.CUP_BODY, layout.TILT + i - 3]


@inline
def _speed(bodies, i):
    if i < 3:
        return bodies[layout.CUP_BODY, layout.LINEAR + i]
    return bodies[layout.CUP_BODY, layout.ANGULAR + i - 3]


@inline
def _bogie_speed(load, load_before, step, i):
    if i < 3:
        return (load[LOAD_BOGIE + i] - load_before[LOAD_BOGIE + i]) / step
    return 0.0
