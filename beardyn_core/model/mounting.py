"""Rings and the suspension as kernel parameters; the box may hang beside the centre."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.model.journal import JournalParams
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


def moved(diagonal: ArrayLike, centre: ArrayLike) -> Float:
    """Move stiffness or damping of springs at another point to this one, shape [6, 6]."""
    motion = np.eye(6)
    motion[:3, 3:] = -cross_matrix(centre)
    return np.asarray(motion.T @ np.diag(np.asarray(diagonal, dtype=float)) @ motion)


def box_coupling(bearing: Bearing, mounting: Mounting, modes: Modes | None = None) -> BoxCoupling | None:
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
        stiffness=moved([*mounting.stiffness, *mounting.rotational_stiffness], mounting.suspension_centre),
        damping=moved([*mounting.damping, *mounting.rotational_damping], mounting.suspension_centre),
        weight=np.ascontiguousarray(mass[:, 2] * -1.0),
    )


def mounting_params(
    bearing: Bearing,
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
        # the bearing centre stays where it is, so its springs beside it restrain the tilt too
        stiffness = np.diag(parameters.coupling.stiffness)
    return np.asarray(stiffness)[[3, 5]]
