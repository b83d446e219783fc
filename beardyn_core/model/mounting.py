"""Rings and suspension as kernel parameters; the axlebox may hang beside the bearing centre."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.scene.mounting import Mounting


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


Float = NDArray[np.float64]


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


def box_coupling(bearing: Bearing, mounting: Mounting) -> BoxCoupling | None:
    """Make full matrices of the box with the cup; ``None`` with everything at the bearing centre."""
    if not any(mounting.box_centre) and not any(mounting.suspension_centre):
        return None
    mass = spatial_mass(mounting.box_mass, mounting.box_inertia, mounting.box_centre)
    mass += spatial_mass(bearing.cup_mass, bearing.cup_inertia, np.zeros(3))
    return BoxCoupling(
        mass=mass,
        inverse_mass=np.ascontiguousarray(np.linalg.inv(mass)),
        stiffness=moved([*mounting.stiffness, *mounting.rotational_stiffness], mounting.suspension_centre),
        damping=moved([*mounting.damping, *mounting.rotational_damping], mounting.suspension_centre),
        weight=np.ascontiguousarray(mass[:, 2] * -1.0),
    )


def mounting_params(bearing: Bearing, mounting: Mounting, preload: NDArray[np.float64]) -> MountingParams:
    """Collect rings and suspension, with the cup and cone masses added."""
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
        coupling=box_coupling(bearing, mounting),
        prop_stiffness=mounting.axial_prop_stiffness,
        prop_damping=mounting.axial_prop_damping,
    )
