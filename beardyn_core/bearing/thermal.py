"""What temperature does to the end play, and temperatures of the parts as a network of lumped nodes.

Rings and rollers grow about the bearing centre. The bearing is in O arrangement, so a hot cone with hot
rollers closes the end play and a hot cup opens it.

The network: C dT/dt = q - G (T - T_ambient), with one heat capacity per node and conductances between nodes
and to the air. The step is exact for heat that is constant over it, so it may be as long as one likes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At
from beardyn_core.base.units import UNITS
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.roller_bearing import RollerBearing

STEEL_EXPANSION = 12.0e-6  # [1/K], bearing steel, catalogue value


@dataclass(frozen=True)
class PartTemperatures:
    """Temperatures of the parts that carry the load."""

    cup: A[float, "[K]"]
    cone: A[float, "[K]"]
    rollers: A[float, "[K]"]


@dataclass(frozen=True)
class Temperatures:
    """Temperatures of the parts, for the end play, which is stated as mounted at assembly temperature."""

    cup: A[float, At("C", ge=-60.0, le=250.0), "of the cup"]
    cone: A[float, At("C", ge=-60.0, le=250.0), "of both cones"]
    rollers: A[float, At("C", ge=-60.0, le=250.0), "of the rollers"]
    assembly: A[float, At("C", ge=-60.0, le=80.0), "at which the end play was measured"] = 293.15
    expansion: A[float, At("um_per_m_K", ge=0.0), "of rings and rollers"] = STEEL_EXPANSION

    def closure(self, bearing: RollerBearing) -> float:
        """Compute what the temperatures add to the play of a bearing, see `play_per_kelvin`, [m]."""
        # differences of the numbers as they are written, so that zeros of the scales cost no digit
        cup, cone, rollers, assembly = (
            UNITS["C"].to_edge(value) for value in (self.cup, self.cone, self.rollers, self.assembly)
        )
        change = PartTemperatures(cup - assembly, cone - assembly, rollers - assembly)
        return play_change(bearing, change, self.expansion)


def end_play_per_kelvin(bearing: Bearing, expansion: float = STEEL_EXPANSION) -> PartTemperatures:
    """Change of the end play with the temperature of each part, [m/K].

    Notes
    -----
    The cup grows about the bearing centre, which moves its raceway at the rollers along the normal by the
    growth times a sin(alpha_o), with the apex of the row at the distance a on the other side of the centre.
    Cone and rollers together do the same with the opposite sign. A roller by itself grows from its large
    end, which the rib holds: across both flanks by the growth times the diameter there (times the cosine
    of its half angle). End play is the normal gap of both rows over sin(alpha_o).

    References
    ----------
    The Timken Company, Engineering manual, thermal effect on the setting of an indirect mounting:
    -alpha dT [(D_1 cot(alpha_o1) + D_2 cot(alpha_o2)) / 2 - L], D mean cup raceway diameters and L their
    distance; it is the sum of cone and rollers here.
    """
    apex = -bearing.apex_place
    sine = math.sin(bearing.cup_angle)
    large_end = bearing.apex_distance + 0.5 * bearing.roller_length
    rollers = 2.0 * large_end * math.sin(bearing.half_angle)
    unit = 2.0 * expansion / sine
    return PartTemperatures(
        cup=unit * apex * sine, cone=-unit * (apex * sine - rollers), rollers=-unit * rollers
    )


def clearance_per_kelvin(bearing: RadialBearing, expansion: float = STEEL_EXPANSION) -> PartTemperatures:
    """Change of the radial clearance of cylinders and barrels with the temperature of each part, [m/K].

    Everything grows in proportion to itself; the gap of barrels, along their contact lines.
    """
    cosine = math.cos(bearing.cup_angle)
    return PartTemperatures(
        cup=2.0 * expansion * bearing.cup_radius / cosine**2,
        cone=-2.0 * expansion * bearing.cone_radius / cosine**2,
        rollers=-2.0 * expansion * bearing.roller_diameter / cosine,
    )


def play_per_kelvin(bearing: RollerBearing, expansion: float = STEEL_EXPANSION) -> PartTemperatures:
    """Change of the end play of tapered rollers, or of the radial clearance of others, [m/K]."""
    if isinstance(bearing, RadialBearing):
        return clearance_per_kelvin(bearing, expansion)
    assert isinstance(bearing, Bearing)
    return end_play_per_kelvin(bearing, expansion)


def play_change(
    bearing: RollerBearing, change: PartTemperatures, expansion: float = STEEL_EXPANSION
) -> float:
    """Compute the change of the play by temperatures against where it was measured [K], [m]."""
    rate = play_per_kelvin(bearing, expansion)
    return rate.cup * change.cup + rate.cone * change.cone + rate.rollers * change.rollers


@dataclass(frozen=True)
class ThermalNetwork:
    """Nodes with capacities, conductances between them and to the ambient."""

    capacity: A[Float, "shape [node], [J/K]"]
    conductance: A[Float, "shape [node, node], symmetric, between two nodes; the diagonal is not used, [W/K]"]
    to_ambient: A[Float, "shape [node], [W/K]"]

    @property
    def matrix(self) -> Float:
        """G: heat that leaves each node per kelvin of every node above the ambient, [W/K]."""
        between = self.conductance - np.diag(np.diag(self.conductance))
        return np.diag(between.sum(axis=1) + self.to_ambient) - between

    def steady(self, heat: Float, ambient: float) -> Float:
        """Compute the steady temperatures, at which as much heat leaves as comes in, [K]."""
        return ambient + np.asarray(np.linalg.solve(self.matrix, heat))

    def after(self, temperature: Float, heat: Float, ambient: float, duration: float) -> Float:
        """Compute the temperatures after a duration [s] with constant heat into each node [W], [K]."""
        root = np.sqrt(self.capacity)
        rates, modes = np.linalg.eigh(self.matrix / np.outer(root, root))
        final = self.steady(heat, ambient)
        away = modes.T @ (root * (temperature - final))
        return final + (modes @ (np.exp(-rates * duration) * away)) / root
