"""Bending of a thin ring in its plane: stiffness and mass of the modes with n waves around it.

A mode is the radial deflection w = a cos(n t) + b sin(n t) with the tangential one v that keeps the ring's
length, w + dv/dt = 0. The modes with n >= 2 carry no net force and no net moment: they add to the motion of
the rigid ring and do not change it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.bearing.roller_bearing import RollerBearing


@dataclass(frozen=True)
class ThinRing:
    """A circular ring of constant section."""

    radius: A[float, "of the middle of the wall, [m]"]
    rigidity: A[float, "Young's modulus times second moment of area for bending in the ring's plane, [N m^2]"]
    mass: A[float, "[kg]"]

    def modal_stiffness(self, waves: int) -> float:
        """Compute the second derivative of the bending energy with the amplitude of a mode, [N/m].

        References
        ----------
        Rayleigh (1894), The theory of sound, art. 233: V = (EI / 2 R^3) integral of (w + w'')^2 dt.
        """
        return math.pi * self.rigidity * (waves**2 - 1) ** 2 / self.radius**3

    def modal_mass(self, waves: int) -> float:
        """Compute the second derivative of the kinetic energy with the speed of the amplitude, [kg]."""
        return 0.5 * self.mass * (1.0 + 1.0 / waves**2)


def rectangular_ring(inner: float, wall: float, width: float, modulus: float, mass: float) -> ThinRing:
    """Make a ring of rectangular section from inner radius, wall thickness and axial width, [m]."""
    return ThinRing(inner + 0.5 * wall, modulus * width * wall**3 / 12.0, mass)


def cup_ring(bearing: RollerBearing) -> ThinRing:
    """Make the ring that stands for the cup, its wall taken at the mid-length of the rollers."""
    raceway = bearing.cup_radius
    wall = 0.5 * bearing.outer_diameter - raceway
    return rectangular_ring(raceway, wall, bearing.width, bearing.material.youngs_modulus, bearing.cup_mass)


def housing_ring(bearing: RollerBearing, wall: float, modulus: float, density: float) -> ThinRing:
    """Make the ring that stands for the housing wall around the cup, as wide as the bearing."""
    inner = 0.5 * bearing.outer_diameter
    mass = density * bearing.width * math.pi * ((inner + wall) ** 2 - inner**2)
    return rectangular_ring(inner, wall, bearing.width, modulus, mass)
