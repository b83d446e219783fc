"""The thermal network of an axlebox bearing, and where the losses of each source go as heat."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.thermal import ThermalNetwork
from beardyn_core.effects import Thermal
from beardyn_core.effects.catalogue import heat_by_loss
from beardyn_core.physics.bodies.losses import LOSS_NAMES

NODES = ("cup", "cone", "rollers", "cages", "grease", "axlebox")
CUP_NODE, CONE_NODE, ROLLER_NODE, CAGE_NODE, GREASE_NODE, BOX_NODE = range(6)

_STEEL_HEAT = 460.0  # [J/(kg K)]
_POLYAMIDE_HEAT = 1700.0
_GREASE_HEAT = 1900.0
_STEEL_CONDUCTIVITY = 46.0  # [W/(m K)]
_AIR_CONDUCTIVITY = 0.026
_AIR_VISCOSITY = 1.5e-5  # kinematic, [m^2/s]
_AIR_PRANDTL = 0.71


def heat_shares() -> Float:
    """Compute the share of each source of loss that warms each node, shape [source, node]."""
    shares, warmed = np.zeros((len(LOSS_NAMES), len(NODES))), heat_by_loss()
    for source, name in enumerate(LOSS_NAMES):
        for node, share in warmed.get(name, {}).items():  # the suspension warms nothing of the bearing
            shares[source, NODES.index(node)] = share
    return shares


def moving_air(speed: float, diameter: float) -> float:
    """Work out the heat transfer of an axlebox in the air stream, a cylinder across it, [W/(m^2 K)].

    References
    ----------
    Churchill, S. W. and Bernstein, M. (1977), ASME J. Heat Transfer 99, 300.
    """
    reynolds = abs(speed) * diameter / _AIR_VISCOSITY
    laminar = 0.62 * math.sqrt(reynolds) * _AIR_PRANDTL ** (1.0 / 3.0)
    laminar /= (1.0 + (0.4 / _AIR_PRANDTL) ** (2.0 / 3.0)) ** 0.25
    nusselt = laminar * (1.0 + (reynolds / 282000.0) ** 0.625) ** 0.8
    return nusselt * _AIR_CONDUCTIVITY / diameter


def axle_fin(bearing: RollerBearing, heat_transfer: float) -> float:
    """Work out the conductance from the cones along a long axle into the air: a fin, sqrt(h P k A), [W/K]."""
    around, section = math.pi * bearing.bore, 0.25 * math.pi * bearing.bore**2
    return math.sqrt(heat_transfer * around * _STEEL_CONDUCTIVITY * section)


def thermal_network(
    bearing: RollerBearing,
    thermal: Thermal,
    box_mass: float,
    shaft_speed: float,
    rollers: int | None = None,
    rows: int = 2,
) -> ThermalNetwork:
    """Build the network of the bearing in its axlebox at one speed.

    Parameters
    ----------
    box_mass : float
        Axlebox without the cup, [kg].
    shaft_speed : float
        [rad/s].
    rollers : int, optional
        Of all rows, where some are missing.
    rows : int
        Rows of rollers, each with its cage.
    """
    count = rows * bearing.roller_count if rollers is None else rollers
    capacity = np.array(
        [
            _STEEL_HEAT * bearing.cup_mass,
            _STEEL_HEAT * bearing.cone_mass,
            _STEEL_HEAT * count * bearing.roller_mass,
            _POLYAMIDE_HEAT * float(rows) * bearing.cage.mass,
            _GREASE_HEAT * thermal.grease_mass,
            _STEEL_HEAT * box_mass,
        ]
    )
    pitch = 0.5 * bearing.pitch_diameter
    inside = {
        CUP_NODE: 2.0 * math.pi * (pitch + 0.5 * bearing.roller_diameter) * bearing.width,
        CONE_NODE: 2.0 * math.pi * (pitch - 0.5 * bearing.roller_diameter) * bearing.width,
        ROLLER_NODE: count * math.pi * bearing.roller_diameter * bearing.roller_length,
        CAGE_NODE: rows * 4.0 * math.pi * pitch * bearing.roller_length,  # both sides of each
    }
    conductance = np.zeros((6, 6))
    conductance[ROLLER_NODE, CUP_NODE] = conductance[ROLLER_NODE, CONE_NODE] = (
        count * thermal.contact_conductance
    )
    for node, area in inside.items():
        conductance[GREASE_NODE, node] = thermal.grease_heat_transfer * area
    seat = math.pi * bearing.outer_diameter * bearing.width
    conductance[CUP_NODE, BOX_NODE] = _AIR_CONDUCTIVITY / thermal.seat_gap * seat
    to_ambient = np.zeros(6)
    to_ambient[CONE_NODE] = axle_fin(bearing, thermal.axle_heat_transfer)
    # a box of one and a half bearing diameters
    air = moving_air(
        0.5 * thermal.air_speed * shaft_speed * thermal.wheel_diameter, 1.5 * bearing.outer_diameter
    )
    to_ambient[BOX_NODE] = thermal.box_area * (thermal.still_air + air)
    return ThermalNetwork(capacity / thermal.time_scale, conductance + conductance.T, to_ambient)
