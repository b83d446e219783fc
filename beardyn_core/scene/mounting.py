"""How the bearing is held: axlebox, suspension, journal."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Mounting:
    """Axlebox on its suspension, and the journal in it.

    Parameters
    ----------
    cup : str
        ``held`` (fixed in space) or ``suspended`` (moves with the axlebox).
    journal_tilt : str
        ``locked`` or ``free``: tilt of the journal in space.
    box_mass : float
        Axlebox without the cup, [kg].
    box_inertia : tuple of 3 floats
        About x, y, z through the bearing centre, without the cup, [kg m^2].
    journal_mass : float
        Half wheelset, carried with the cones, [kg].
    journal_inertia : float
        Tilt inertia about x and z, [kg m^2].
    stiffness, damping : tuple of 3 floats
        Suspension between axlebox and bogie in x, y, z, [N/m], [N s/m].
    rotational_stiffness, rotational_damping : tuple of 3 floats
        The same about x, y, z: the restraint of the axlebox against tilting, [N m/rad], [N m s/rad].
    box_centre : tuple of 3 floats
        Centre of mass of the axlebox without the cup, from the bearing centre, [m].
    suspension_centre : tuple of 3 floats
        Where the suspension springs act on the axlebox, from the bearing centre, [m].
    load_offset : tuple of 3 floats
        Where the load acts on the journal, from the bearing centre: its force also turns the journal
        with the moment offset x force, [m]. A journal that is locked holds all but its first value.
    axial_prop_stiffness, axial_prop_damping : float
        Between journal and ground along y, [N/m], [N s/m]; zeros for none. A single row, which thrusts the
        journal out, needs it.
    """

    cup: str = "suspended"
    journal_tilt: str = "locked"
    box_mass: float = 100.0
    box_inertia: tuple[float, float, float] = (2.0, 2.0, 2.0)
    journal_mass: float = 900.0
    journal_inertia: float = 50.0
    stiffness: tuple[float, float, float] = (1.0e7, 5.0e6, 1.2e6)
    damping: tuple[float, float, float] = (2.0e4, 2.0e4, 1.0e4)
    rotational_stiffness: tuple[float, float, float] = (1.0e5, 2.0e5, 1.0e5)
    rotational_damping: tuple[float, float, float] = (5.0e2, 1.0e3, 5.0e2)
    box_centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    suspension_centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    load_offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    axial_prop_stiffness: float = 0.0
    axial_prop_damping: float = 0.0

    def about_bearing_centre(self, wrench: NDArray[np.float64]) -> NDArray[np.float64]:
        """Loads where they act on the journal, reduced to the bearing centre.

        Parameters
        ----------
        wrench : float64 array, shape [..., 6]
            Force and moment, [N, N m].

        Returns
        -------
        float64 array, shape [..., 6]
        """
        if not any(self.load_offset):
            return wrench
        force, moment = wrench[..., :3], wrench[..., 3:]
        return np.concatenate([force, moment + np.cross(self.load_offset, force)], axis=-1)
