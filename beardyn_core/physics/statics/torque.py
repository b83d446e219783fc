"""Torque of a bearing that rolls under static loads: rolling resistance of the raceways, and the ribs.

No motion is simulated: the static solution gives the load of every contact, pure rolling its speeds.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.jit import plain
from beardyn_core.bearing.film_thickness import thermal_loading
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.rolling_resistance import (
    RollingContact,
    hertz_half_width,
    hysteresis_line,
    thermal_reduction,
)
from beardyn_core.bearing.starved_rolling import FLOODED, FORMS, OilSupply, rolling_couple
from beardyn_core.effects import Rib
from beardyn_core.physics.lamina_table import equivalent_radius, surface_radius
from beardyn_core.physics.pure_rolling import pure_rolling
from beardyn_core.physics.rib import RibParams, rib_params, sliding_torque
from beardyn_core.physics.statics.static import StaticSolution


@dataclass(frozen=True)
class RunningTorque:
    """Running torque of a bearing, by where it arises."""

    cup_couple: Float  # [row, roller], on each roller against its rolling on the raceway [N m]
    cone_couple: Float
    rolling: float  # on the shaft [N m]
    rib: float

    @property
    def total(self) -> float:
        """Add up the torque on the shaft, [N m]."""
        return self.rolling + self.rib


def entrainment_speeds(bearing: Bearing, speed: float) -> tuple[float, float]:
    """Work out entrainment speeds on cup and cone in pure rolling, contact-fixed frame, [m/s]."""
    orbit = cage_speed(bearing, abs(speed))
    return orbit * surface_radius(bearing, "cup"), (abs(speed) - orbit) * surface_radius(bearing, "cone")


def running_torque(
    bearing: Bearing,
    lubricant: Lubricant,
    temperature: float,
    static: StaticSolution,
    speed: float,
    *,
    form: str = "aihara",
    supply: OilSupply = FLOODED,
    thermal: bool = True,
    hysteresis: float = 0.0,
    rib: Rib | None = None,
) -> RunningTorque:
    """Work out the running torque in pure rolling under the loads of a static equilibrium.

    Parameters
    ----------
    temperature : float
        Of the lubricant at the inlets, [K].
    speed : float
        Of the shaft, [rad/s].
    form : str
        ``aihara``, ``zhou_hoeprich`` or ``biboulet_houpert``.
    supply : OilSupply
        How much oil the contacts find.
    thermal : bool
        Reduce the couple by heating of the inlet.
    hysteresis : float
        Loss factor of the elastic hysteresis, 0 for none.
    rib : Rib, optional
        Options of the friction on the rib; none by default.

    Raises
    ------
    InputError
        Unknown form.

    References
    ----------
    Zhao et al. (2026), J. Braz. Soc. Mech. Sci. Eng. 48:241: T = sum (1/Dm)(R_o T_i + R_i T_o), and on the
    rib mu Q_f h sqrt(1 + 0.18 (a/h)^2) R_o/Dm. The equivalent radius and the entrainment speed are not
    those printed there: the cup is concave, and surface speeds are taken against the contact.
    """
    if form not in FORMS:
        raise InputError([f"form is {form!r}; allowed are {', '.join(FORMS)}."])
    viscosity = lubricant.dynamic_viscosity(temperature)
    pressure_viscosity = lubricant.pressure_viscosity_at(temperature)
    modulus, length = bearing.material.contact_modulus, bearing.effective_length
    couples = []
    speeds = entrainment_speeds(bearing, speed)
    for ring, loads, entrainment in zip(
        ("cup", "cone"), (static.cup_load, static.cone_load), speeds, strict=True
    ):
        radius = float(equivalent_radius(bearing, np.zeros(1), ring)[0])
        reduction = 1.0
        if thermal:
            oil = lubricant.temperature_coefficient, lubricant.thermal_conductivity
            reduction = thermal_reduction(thermal_loading(viscosity, oil[0], entrainment, oil[1]))
        couple = np.zeros_like(loads)
        for index in zip(*np.nonzero(loads > 0.0), strict=True):
            load = float(loads[index])
            unit = RollingContact(load, entrainment, radius, length, modulus, viscosity, pressure_viscosity)
            width = hertz_half_width(load / length, radius, modulus)
            couple[index] = reduction * rolling_couple(form, unit, supply)
            couple[index] += hysteresis_line(load, width, hysteresis)
        couples.append(couple)
    cup_radius, cone_radius = surface_radius(bearing, "cup"), surface_radius(bearing, "cone")
    rolling = float(cup_radius * couples[1].sum() + cone_radius * couples[0].sum()) / bearing.roller_diameter
    sliding = rib_torque(bearing, static, speed, rib_params(bearing, rib, lubricant, temperature))
    return RunningTorque(couples[0], couples[1], rolling, sliding)


def rib_torque(bearing: Bearing, static: StaticSolution, speed: float, rib: RibParams | None) -> float:
    """Work out the torque on the shaft of all large ends that slide on their ribs in pure rolling, [N m].

    Parameters
    ----------
    speed : float
        Of the shaft, [rad/s].
    rib : RibParams, optional
        As the steps have it, with its film; ``None`` for ribs without friction.
    """
    motion, cone = pure_rolling(bearing), _Cone(math.sin(bearing.cone_angle), math.cos(bearing.cone_angle))
    speeds = abs(speed), motion.cage_ratio * abs(speed)
    loads = static.rib_load[static.rib_load > 0.0]
    return float(np.sum(plain(sliding_torque)(loads, speeds, motion, cone, rib)))


class _Cone(NamedTuple):
    """What `sliding_torque` reads of the cone."""

    sine: float
    cosine: float
