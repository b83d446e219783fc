"""What holds the box or both rings: parameters, forces and energy; the box may hang next to the centre.

The springs act at seats that give way when the box bends: as much as the bearing centre would have to move
for the same stretch, which `structure` and `kinematic_bending` write into the work space.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.rigid_bodies import LOAD_BOGIE, fall, kick_cup
from beardyn_core.physics.journal import JournalParams
from beardyn_core.scene.mounting import Mounting
from beardyn_core.structure.modes import Modes


class BoxCoupling(NamedTuple):
    """Box whose centre of mass or whose springs are not at the bearing centre: full matrices about it."""

    mass: Any  # [6, 6]
    inverse_mass: Any  # [6, 6]
    stiffness: Any  # [6, 6]
    damping: Any  # [6, 6]
    weight: Any  # [6], force and moment at 1 m/s^2 of gravity


class MountingParams(NamedTuple):
    """Rings and suspension, world axes."""

    cup_moves: float
    journal_tilts: float
    box_mass: float  # with the cup [kg]
    box_inertia: Any  # [3]
    journal_mass: float  # with the cones [kg]
    journal_inertia: float
    stiffness: Any  # [6], force then moment
    damping: Any  # [6]
    preload: Any  # [6], suspension force at rest
    coupling: BoxCoupling | None
    prop_stiffness: float  # axial, of journal against ground [N/m]
    prop_damping: float  # [N s/m]
    journal: JournalParams | None  # bending of the axle


def cross_matrix(arm: ArrayLike) -> Float:
    """Make the matrix that turns a vector v into arm x v, shape [3, 3]."""
    x, y, z = np.asarray(arm, dtype=float)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def spatial_mass(mass: float, inertia: ArrayLike, centre: ArrayLike) -> Float:
    """Make the mass matrix about a point from the inertia and the centre of mass seen from it, [6, 6]."""
    arm = mass * cross_matrix(centre)
    return np.block([[mass * np.eye(3), -arm], [arm, np.diag(np.asarray(inertia, dtype=float))]])


def move_stiffness(diagonal: ArrayLike, centre: ArrayLike) -> Float:
    """Move stiffness or damping of springs at another point to this one, shape [6, 6]."""
    motion = np.eye(6)
    motion[:3, 3:] = -cross_matrix(centre)
    return np.asarray(motion.T @ np.diag(np.asarray(diagonal, dtype=float)) @ motion)


def box_coupling(
    bearing: RollerBearing, mounting: Mounting, modes: Modes | None = None
) -> BoxCoupling | None:
    """Make full matrices of the box with the cup; ``None`` with everything at the bearing centre.

    ``modes``: those of the box, whose seats may give way; its inertia is taken from there.
    """
    if modes is None and not any(mounting.box_centre) and not any(mounting.suspension_centre):
        return None
    mass = spatial_mass(mounting.box_mass, mounting.box_inertia, mounting.box_centre)
    mass += spatial_mass(bearing.cup_mass, bearing.cup_inertia, np.zeros(3))
    if modes is not None:
        xy, xz, yz = modes.products
        mass[3:, 3:] += [[0.0, xy, xz], [xy, 0.0, yz], [xz, yz, 0.0]]
    return BoxCoupling(
        mass=mass,
        inverse_mass=np.ascontiguousarray(np.linalg.inv(mass)),
        stiffness=move_stiffness(
            [*mounting.stiffness, *mounting.rotational_stiffness], mounting.suspension_centre
        ),
        damping=move_stiffness([*mounting.damping, *mounting.rotational_damping], mounting.suspension_centre),
        weight=np.ascontiguousarray(mass[:, 2] * -1.0),
    )


def mounting_params(
    bearing: RollerBearing,
    mounting: Mounting,
    preload: Float,
    modes: Modes | None = None,
    journal: JournalParams | None = None,
) -> MountingParams:
    """Collect rings and suspension, with the cup and cone masses added; ``modes`` as of `box_coupling`."""
    return MountingParams(
        cup_moves=float(mounting.cup == "suspended"),
        journal_tilts=float(mounting.journal_tilt == "free"),
        box_mass=mounting.box_mass + bearing.cup_mass,
        box_inertia=np.array(mounting.box_inertia) + np.array(bearing.cup_inertia),
        journal_mass=mounting.journal_mass + bearing.cone_mass,
        journal_inertia=mounting.journal_inertia,
        stiffness=np.array([*mounting.stiffness, *mounting.rotational_stiffness], dtype=float),
        damping=np.array([*mounting.damping, *mounting.rotational_damping], dtype=float),
        preload=np.array(preload, dtype=float),
        coupling=box_coupling(bearing, mounting, modes),
        prop_stiffness=mounting.axial_prop_stiffness,
        prop_damping=mounting.axial_prop_damping,
        journal=journal,
    )


def tilt_restraint(mounting: Mounting, parameters: MountingParams) -> Float:
    """Work out the stiffness of the suspension against the tilt of the bearing about x and z, [N m/rad].

    A journal free to tilt leans the whole moment on the box, whatever holds that.
    """
    if mounting.cup == "held" or mounting.journal_tilt == "free":
        return np.zeros(2)
    stiffness = parameters.stiffness
    if parameters.coupling is not None:
        # the bearing centre stays where it is, so its springs next to it restrain the tilt too
        stiffness = np.diag(parameters.coupling.stiffness)
    return np.asarray(stiffness)[[3, 5]]


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
            speed = _body_speed(bodies, j) + box[SEAT_SPEED + j]
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
        middle = _body_speed(bodies, i) + 0.5 * step * box[i]
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
            total += 0.5 * _body_speed(bodies, i) * coupling.mass[i, j] * _body_speed(bodies, j)
    return total


@inline
def _stretch(bodies, load, i):
    if i < 3:
        return bodies[layout.CUP_BODY, layout.POSITION + i] - load[LOAD_BOGIE + i]
    return bodies[layout.CUP_BODY, layout.TILT + i - 3]


@inline
def _body_speed(bodies, i):
    if i < 3:
        return bodies[layout.CUP_BODY, layout.LINEAR + i]
    return bodies[layout.CUP_BODY, layout.ANGULAR + i - 3]


@inline
def _bogie_speed(load, load_before, step, i):
    if i < 3:
        return (load[LOAD_BOGIE + i] - load_before[LOAD_BOGIE + i]) / step
    return 0.0
