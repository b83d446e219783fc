"""Slow warming of bearing, grease and axlebox."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Thermal:
    """Temperatures of cup, cone, rollers, cages, grease and axlebox, fed by what friction loses."""

    about: ClassVar[About] = About(
        loss="",
        adds="Temperatures of the parts; they change the lubricant's viscosity and the end play.",
        states="6 temperatures, advanced every 0.2 s",
        cost="medium",
        validity="Needs the audit, which keeps what each source loses in tier full; one temperature for both "
        "rows; the film has the mean temperature of rollers and raceways.",
        source="Lumped network; axlebox as a cylinder across the air, Churchill and Bernstein (1977); end "
        "play as in Timken's indirect mounting; conductances and shelter assumed",
    )

    ambient: A[float, At("C", ge=-60.0, le=80.0), "of the air"] = 293.15
    time_scale: A[float, At(gt=0.0, le=1e5), "heating goes on this many times as fast, 1 is real"] = 1.0
    wheel_diameter: A[float, At("mm", gt=0.0, le=2000.0), "for the speed of the air along the axlebox"] = 0.92
    air_speed: A[
        float, SHARE, "of the air at the axlebox over that of the train: bogie and wheel shelter it"
    ] = 0.3
    box_area: A[float, At("m2", gt=0.0), "surface of the axlebox in the air"] = 0.6
    still_air: A[float, At("W_per_m2_K", ge=0.0), "axlebox at standstill: free convection and radiation"] = (
        6.0
    )
    axle_heat_transfer: A[
        float, At("W_per_m2_K", ge=0.0), "of the axle that carries heat away from the cones"
    ] = 25.0
    contact_conductance: A[float, At("W_per_K", gt=0.0), "of one roller to each raceway"] = 5.0
    grease_heat_transfer: A[
        float, At("W_per_m2_K", gt=0.0), "of the surfaces inside the bearing to the grease"
    ] = 100.0
    grease_mass: A[float, At("kg", gt=0.0), "of the grease in the bearing"] = 0.5
    seat_gap: A[float, At("um", gt=0.0), "air gap that stands for the cup's seat"] = 2.0e-5
    expansion: A[float, At("um_per_m_K", ge=0.0), "of rings and rollers"] = 12.0e-6
