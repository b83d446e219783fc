"""Slow warming of bearing, grease and axlebox."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Thermal:
    """Temperatures of cup, cone, rollers, cages, grease and axlebox, fed by what friction loses.

    Parameters
    ----------
    ambient : float
        Temperature of the air, [K].
    time_scale : float
        Heating goes on this many times as fast: a scaling of the heat capacities, 1 is real. It leaves
        steady temperatures as they are.
    wheel_diameter : float
        Turns the shaft speed into the speed of the air along the axlebox, [m].
    box_area : float
        Surface of the axlebox in the air, [m^2].
    still_air : float
        Heat transfer of the axlebox at standstill, free convection and radiation, [W/(m^2 K)].
    axle_heat_transfer : float
        Of the axle that carries heat away from the cones, [W/(m^2 K)].
    contact_conductance : float
        Of one roller to each of its raceways, [W/K].
    grease_heat_transfer : float
        Of the surfaces inside the bearing to the grease, [W/(m^2 K)].
    grease_mass : float
        [kg].
    seat_gap : float
        Air gap that stands for the seat of the cup in the axlebox, [m].
    expansion : float
        Of rings and rollers, for the end play, [1/K].
    """

    about: ClassVar[About] = About(
        adds="Temperatures of the parts; they change the lubricant's viscosity and the end play.",
        states="6 temperatures, advanced once per block",
        cost="medium",
        validity="Needs the audit, which tells what each source loses; one temperature for both rows; the "
        "film has the mean temperature of rollers and raceways.",
        source="Lumped network; axlebox in moving air h = 0.03 (k/D)(uD/nu)^0.57, Harris, Rolling bearing "
        "analysis; end play as in Timken's indirect mounting; conductances assumed",
    )

    ambient: float = 293.15
    time_scale: float = 1.0
    wheel_diameter: float = 0.92
    box_area: float = 0.6
    still_air: float = 6.0
    axle_heat_transfer: float = 25.0
    contact_conductance: float = 5.0
    grease_heat_transfer: float = 100.0
    grease_mass: float = 0.5
    seat_gap: float = 2.0e-5
    expansion: float = 12.0e-6
