"""The axlebox, with its centre of mass and its springs at the bearing centre or beside it."""

from __future__ import annotations

from beardyn_core.jit import inline
from beardyn_core.kernels.bodies import LOAD_BOGIE, fall, kick_cup
from beardyn_core.model import layout

FORCE = 6  # in the work space, after the acceleration


@inline
def kick_box(bodies, wrench, load, load_before, energy, box, step, mounting, gravity, coupling):
    """Accelerate the axlebox; arguments and result as `kick_cup`, with full matrices when coupled.

    ``box`` [12]: written: acceleration of the bearing centre, linear and angular; then force and moment.

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
            spring += coupling.stiffness[i, j] * _stretch(bodies, load, j)
            damper += coupling.damping[i, j] * (_speed(bodies, j) - _bogie_speed(load, load_before, step, j))
        pull = coupling.weight[i] * fall(gravity)
        box[FORCE + i] = wrench[i] + mounting.preload[i] - spring - damper + pull
        stretch = _stretch(bodies, load, i)
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
        damper = 0.0
        for j in range(6):
            damper += coupling.damping[i, j] * (_speed(bodies, j) - _bogie_speed(load, load_before, step, j))
        suspension = box[FORCE + i] - wrench[i] - pull
        energy[layout.ENERGY_EXTERNAL] += step * (suspension * bogie_speed + pull * middle)
        energy[layout.ENERGY_LOST + layout.LOSS_SUSPENSION] += step * damper * (middle - bogie_speed)
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
