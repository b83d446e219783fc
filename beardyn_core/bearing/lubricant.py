"""Lubricant: viscosity and pressure-viscosity coefficient with temperature."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import At

_KELVIN_40 = 313.15
_KELVIN_100 = 373.15
_MM2_PER_S = 1.0e-6
# Gold's coefficient [1/GPa] and exponent
_GOLD = {"mineral": (9.90, 0.139), "pao": (7.38, 0.1335)}
BASE_OILS = tuple(_GOLD)


def walther_viscosity(at_40: float, at_100: float, temperature: float) -> float:
    """Compute the kinematic viscosity at `temperature` [K] from those at 40 and 100 deg C, [m^2/s].

    References
    ----------
    Walther equation, ASTM D341: log10 log10(nu + 0.7) = A - B log10 T, nu in mm^2/s.
    """
    high, low = _walther(at_40), _walther(at_100)
    slope = (high - low) / math.log10(_KELVIN_100 / _KELVIN_40)
    ordinate = high - slope * math.log10(temperature / _KELVIN_40)
    return (10.0 ** (10.0**ordinate) - 0.7) * _MM2_PER_S


def gold_pressure_viscosity(kinematic_viscosity: float, base_oil: str) -> float:
    """Compute the pressure-viscosity coefficient of an oil of which only the viscosity is known, [1/Pa].

    The viscosity is that at the given temperature, [m^2/s]; the oil one of `BASE_OILS`.

    References
    ----------
    Gold, P. W. et al. (2001), Viscosity-pressure-temperature behaviour of mineral and synthetic oils, J.
    Synth. Lubr. 18, 51: 9.90 nu^0.139 1/GPa for mineral oils, 7.38 nu^0.1335 1/GPa for PAO, nu in mm^2/s.
    """
    coefficient, exponent = _GOLD[base_oil]
    return 1e-9 * coefficient * (kinematic_viscosity / _MM2_PER_S) ** exponent


@dataclass(frozen=True)
class Lubricant:
    """An oil, or the base oil of a grease.

    `sources` has the source of each number, or ``assumed``.
    """

    name: A[str, At(longest=80), "of the lubricant"]
    description: A[str, At(usual=""), "what it is, in a few words"]
    kinematic_viscosity_40: A[
        float, At("mm2_per_s", gt=0.0, ge=1.0, le=5000.0, key="kinematic_viscosity_40C"), "at 40 deg C"
    ]
    kinematic_viscosity_100: A[
        float, At("mm2_per_s", gt=0.0, ge=0.5, le=500.0, key="kinematic_viscosity_100C"), "at 100 deg C"
    ]
    density: A[float, At("kg_per_m3", gt=0.0, ge=500.0, le=2500.0), "of the oil"]
    pressure_viscosity: A[
        float,
        At("per_GPa", gt=0.0, ge=1.0, le=100.0, optional=True),
        "Barus coefficient at pressure_viscosity_temperature_C; without it that of "
        "Gold et al. (2001) for the base oil",
    ]
    thermal_conductivity: A[float, At("W_per_m_K", gt=0.0), "of the oil"]
    temperature_coefficient: A[float, At("per_K", ge=0.0), "-d(ln viscosity)/dT at film temperature"]
    pressure_viscosity_temperature: A[float, At("C", ge=-50.0, le=200.0), "of the pressure viscosity"] = (
        _KELVIN_40
    )
    base_oil: A[str, At(one_of=BASE_OILS), "how the Barus coefficient changes with temperature"] = "mineral"
    sources: tuple[tuple[str, str], ...] = ()

    def __repr__(self) -> str:
        """Give the name, what it is and the viscosities, in one line."""
        at_40, at_100 = self.kinematic_viscosity_40 / _MM2_PER_S, self.kinematic_viscosity_100 / _MM2_PER_S
        about = f" ({self.description})" if self.description else ""
        return (
            f"Lubricant {self.name}{about}: {self.base_oil} oil, {at_40:.4g} mm2/s at 40 C, "
            f"{at_100:.4g} mm2/s at 100 C"
        )

    def as_written(self, keys: dict[str, Any]) -> dict[str, Any]:
        """Omit the Barus coefficient when it was derived from the viscosity."""
        viscosity = self.kinematic_viscosity(self.pressure_viscosity_temperature)
        if self.pressure_viscosity == gold_pressure_viscosity(viscosity, self.base_oil):
            keys.pop("pressure_viscosity_per_GPa")
        return keys

    def rules(self) -> Iterator[str]:
        """Check that the two viscosities can belong to one oil."""
        at_40, at_100 = self.kinematic_viscosity_40 / _MM2_PER_S, self.kinematic_viscosity_100 / _MM2_PER_S
        if at_100 >= at_40:
            yield (
                f"kinematic_viscosity_100C_mm2_per_s is {at_100:g}; it must be less than the "
                f"{at_40:g} mm2/s at 40 degrees"
            )

    def kinematic_viscosity(self, temperature: float) -> float:
        """Compute the kinematic viscosity at `temperature` [K], [m^2/s]; `walther_viscosity`."""
        return walther_viscosity(self.kinematic_viscosity_40, self.kinematic_viscosity_100, temperature)

    def dynamic_viscosity(self, temperature: float) -> float:
        """Compute the dynamic viscosity at `temperature` [K] and ambient pressure, [Pa s]."""
        return self.density * self.kinematic_viscosity(temperature)

    def pressure_viscosity_at(self, temperature: float) -> float:
        """Compute the Barus coefficient at `temperature` [K], scaled from the stated value, [1/Pa].

        References
        ----------
        Gold et al. (2001), as in `gold_pressure_viscosity`; only its exponent is used.
        """
        ratio = self.kinematic_viscosity(temperature) / self.kinematic_viscosity(
            self.pressure_viscosity_temperature
        )
        return self.pressure_viscosity * ratio ** _GOLD[self.base_oil][1]

    def roelands_constants(self, temperature: float) -> tuple[float, float]:
        """Compute the level ln eta_0 + 9.67 and exponent Z of Roelands' law at `temperature` [K].

        The slope at ambient pressure is that of Barus: Z = alpha / [5.1e-9 (ln eta_0 + 9.67)].

        References
        ----------
        Roelands, C. J. A. (1966): eta = eta0 exp{(ln eta0 + 9.67)[-1 + (1 + 5.1e-9 p)^Z]}; eta0 and alpha are
        taken at `temperature`, which stands for his temperature factor.
        """
        level = math.log(self.dynamic_viscosity(temperature)) + 9.67
        return level, self.pressure_viscosity_at(temperature) / (5.1e-9 * level)


def _walther(kinematic_viscosity: float) -> float:
    """Compute log10 log10(nu + 0.7) of a viscosity in m^2/s."""
    return math.log10(math.log10(kinematic_viscosity / _MM2_PER_S + 0.7))
