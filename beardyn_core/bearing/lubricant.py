"""Lubricant: viscosity and pressure-viscosity coefficient with temperature."""

from __future__ import annotations

import math
from dataclasses import dataclass

_KELVIN_40 = 313.15
_KELVIN_100 = 373.15
_MM2_PER_S = 1.0e-6


@dataclass(frozen=True)
class Lubricant:
    """Base oil of a grease, or an oil.

    Parameters
    ----------
    name, description : str
    kinematic_viscosity_40, kinematic_viscosity_100 : float
        At 40 and 100 deg C, [m^2/s].
    density : float
        [kg/m^3].
    pressure_viscosity : float
        Barus coefficient at `pressure_viscosity_temperature`, [1/Pa].
    thermal_conductivity : float
        [W/(m K)].
    temperature_coefficient : float
        -d(ln viscosity)/dT at film temperature, for thermal reduction factors, [1/K].
    pressure_viscosity_temperature : float
        [K].
    sources : tuple of (field, source) pairs
        Where each number comes from, or ``assumed``.
    """

    name: str
    description: str
    kinematic_viscosity_40: float
    kinematic_viscosity_100: float
    density: float
    pressure_viscosity: float
    thermal_conductivity: float
    temperature_coefficient: float
    pressure_viscosity_temperature: float = _KELVIN_40
    sources: tuple[tuple[str, str], ...] = ()

    def kinematic_viscosity(self, temperature: float) -> float:
        """Kinematic viscosity at `temperature` [K], [m^2/s].

        References
        ----------
        Walther equation, ASTM D341: log10 log10(nu + 0.7) = A - B log10 T, nu in mm^2/s.
        """
        at_40 = _walther(self.kinematic_viscosity_40)
        at_100 = _walther(self.kinematic_viscosity_100)
        slope = (at_40 - at_100) / math.log10(_KELVIN_100 / _KELVIN_40)
        ordinate = at_40 - slope * math.log10(temperature / _KELVIN_40)
        return (10.0 ** (10.0**ordinate) - 0.7) * _MM2_PER_S

    def dynamic_viscosity(self, temperature: float) -> float:
        """Dynamic viscosity at `temperature` [K] and ambient pressure, [Pa s]."""
        return self.density * self.kinematic_viscosity(temperature)

    def pressure_viscosity_at(self, temperature: float) -> float:
        """Barus coefficient at `temperature` [K], scaled from the given value, [1/Pa].

        References
        ----------
        Gold, P. W. et al. (2001), Viscosity-pressure-temperature behaviour of mineral and synthetic oils:
        alpha grows with nu^0.139 for mineral oils (nu^0.1335 for PAO); only that exponent is used.
        """
        ratio = self.kinematic_viscosity(temperature) / self.kinematic_viscosity(
            self.pressure_viscosity_temperature
        )
        return self.pressure_viscosity * ratio**0.139

    def roelands_viscosity(self, temperature: float, pressure: float) -> float:
        """Dynamic viscosity at `pressure` [Pa] and `temperature` [K], [Pa s].

        References
        ----------
        Roelands, C. J. A. (1966): eta = eta0 exp{(ln eta0 + 9.67)[-1 + (1 + 5.1e-9 p)^Z]} with
        Z = alpha / [5.1e-9 (ln eta0 + 9.67)]; eta0 and alpha are taken at `temperature`.
        """
        ambient = self.dynamic_viscosity(temperature)
        level = math.log(ambient) + 9.67
        exponent = self.pressure_viscosity_at(temperature) / (5.1e-9 * level)
        return ambient * math.exp(level * ((1.0 + 5.1e-9 * pressure) ** exponent - 1.0))


def _walther(kinematic_viscosity: float) -> float:
    """log10 log10(nu + 0.7) of a viscosity in m^2/s."""
    return math.log10(math.log10(kinematic_viscosity / _MM2_PER_S + 0.7))
