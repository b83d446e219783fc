"""Mass and suspension of an axlebox whose centre of mass or springs stand beside the bearing centre."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.model.parameters import BoxCoupling
from beardyn_core.scene.mounting import Mounting

Float = NDArray[np.float64]


def cross_matrix(arm: ArrayLike) -> Float:
    """Matrix that turns a vector v into arm x v, shape [3, 3]."""
    x, y, z = np.asarray(arm, dtype=float)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])


def spatial_mass(mass: float, inertia: ArrayLike, centre: ArrayLike) -> Float:
    """Mass matrix about a point from the inertia about it and the centre of mass seen from it, [6, 6]."""
    arm = mass * cross_matrix(centre)
    return np.block([[mass * np.eye(3), -arm], [arm, np.diag(np.asarray(inertia, dtype=float))]])


def moved(diagonal: ArrayLike, centre: ArrayLike) -> Float:
    """Stiffness or damping about a point of springs that stand at another one, shape [6, 6]."""
    motion = np.eye(6)
    motion[:3, 3:] = -cross_matrix(centre)
    return np.asarray(motion.T @ np.diag(np.asarray(diagonal, dtype=float)) @ motion)


def box_coupling(bearing: Bearing, mounting: Mounting) -> BoxCoupling | None:
    """Full matrices of the box with the cup; ``None`` when everything stands at the bearing centre."""
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
