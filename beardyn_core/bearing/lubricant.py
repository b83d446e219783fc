"""Lubricant: viscosity and pressure-viscosity coefficient with temperature."""

from __future__ import annotations

import math
from dataclasses import dataclass

_KELVIN_40 = 313.15
_KELVIN_100 = 373.15
_MM2_PER_S = 1.0e-6
# Gold's coefficient [1/GPa] and exponent
_GOLD = {"mineral": (9.90, 0.139), "pao": (7.38, 0.1335)}
BASE_OILS = tuple(_GOLD)


def walther_viscosity(at_40: float, at_100: float, temperature: float) -> float:
    """Kinematic viscosity at `temperature` [K] from those at 40 and 100 deg C, [m^2/s].

    References
    ----------
    Walther equation, ASTM D341: log10 log10(nu + 0.7) = A - B log10 T, nu in mm^2/s.
    """
    high, low = _walther(at_40), _walther(at_100)
    slope = (high - low) / math.log10(_KELVIN_100 / _KELVIN_40)
    ordinate = high - slope * math.log10(temperature / _KELVIN_40)
    return (10.0 ** (10.0**ordinate) - 0.7) * _MM2_PER_S


def gold_pressure_viscosity(kinematic_viscosity: float, base_oil: str) -> float:
    """Pressure-viscosity coefficient of an oil of which only the viscosity is known, [1/Pa].

    Parameters
    ----------
    kinematic_viscosity : float
        At the temperature wanted, [m^2/s].
    base_oil : str
        ``mineral`` or ``pao``.

    References
    ----------
    Gold, P. W. et al. (2001), Viscosity-pressure-temperature behaviour of mineral and synthetic oils, J.
    Synth. Lubr. 18, 51: 9.90 nu^0.139 1/GPa for mineral oils, 7.38 nu^0.1335 1/GPa for PAO, nu in mm^2/s.
    """
    coefficient, exponent = _GOLD[base_oil]
    return 1e-9 * coefficient * (kinematic_viscosity / _MM2_PER_S) ** exponent


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
    base_oil : str
        ``mineral`` or ``pao``: how the Barus coefficient changes with temperature.
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
    base_oil: str = "mineral"
    sources: tuple[tuple[str, str], ...] = ()

    def kinematic_viscosity(self, temperature: float) -> float:
        """Kinematic viscosity at `temperature` [K], [m^2/s]; `walther_viscosity`."""
        return walther_viscosity(self.kinematic_viscosity_40, self.kinematic_viscosity_100, temperature)

    def dynamic_viscosity(self, temperature: float) -> float:
        """Dynamic viscosity at `temperature` [K] and ambient pressure, [Pa s]."""
        return self.density * self.kinematic_viscosity(temperature)

    def pressure_viscosity_at(self, temperature: float) -> float:
        """Barus coefficient at `temperature` [K], scaled from the given value, [1/Pa].

        References
        ----------
        Gold et al. (2001), as in `gold_pressure_viscosity`; only its exponent is used.
        """
        ratio = self.kinematic_viscosity(temperature) / self.kinematic_viscosity(
            self.pressure_viscosity_temperature
        )
        return self.pressure_viscosity * ratio ** _GOLD[self.base_oil][1]

    def roelands_constants(self, temperature: float) -> tuple[float, float]:
        """Level ln eta_0 + 9.67 and exponent Z of Roelands' law at `temperature` [K].

        The slope at ambient pressure is that of Barus: Z = alpha / [5.1e-9 (ln eta_0 + 9.67)].
        """
        level = math.log(self.dynamic_viscosity(temperature)) + 9.67
        return level, self.pressure_viscosity_at(temperature) / (5.1e-9 * level)

    def roelands_viscosity(self, temperature: float, pressure: float) -> float:
        """Dynamic viscosity at `pressure` [Pa] and `temperature` [K], [Pa s].

        References
        ----------
        Roelands, C. J. A. (1966): eta = eta0 exp{(ln eta0 + 9.67)[-1 + (1 + 5.1e-9 p)^Z]}; eta0 and alpha are
        taken at `temperature`, which stands for his temperature factor.
        """
        level, exponent = self.roelands_constants(temperature)
        thickening = level * ((1.0 + 5.1e-9 * pressure) ** exponent - 1.0)
        return self.dynamic_viscosity(temperature) * math.exp(thickening)


def _walther(kinematic_viscosity: float) -> float:
    """log10 log10(nu + 0.7) of a viscosity in m^2/s."""
    return math.log10(math.log10(kinematic_viscosity / _MM2_PER_S + 0.7))
