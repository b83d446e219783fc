"""Rolling resistance, drag and seals as kernel parameters."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing import rolling_resistance as laws
from beardyn_core.bearing.film_thickness import thermal_loading
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet
from beardyn_core.model.contact_parameters import (
    BibouletHoupertParams,
    DragParams,
    HysteresisParams,
    PowerLawRollingParams,
    RollingParams,
    ThermalRollingParams,
)
from beardyn_core.model.lamina_table import equivalent_radius
from beardyn_core.model.parameters import SealParams
from beardyn_core.scene.scene import Scene

AIR_DENSITY = 1.2
RINGS = ("cup", "cone")
SEALS = 2.0
# Turbulent skin friction of a cylinder that turns in a wide medium, f = 0.105 Re^-0.274: within 10 % of
# Theodorsen and Regier's 1/sqrt(f) = -0.6 + 4.07 log10(Re sqrt(f)) for Re from 1e3 to 1e5.
CYLINDER_FRICTION, CYLINDER_EXPONENT = 0.105, 0.274
# Laminar disc, both sides: c = 3.87 / sqrt(Re).
DISC_FRICTION, DISC_EXPONENT = 3.87, 0.5


def rolling_params(scene: Scene) -> RollingParams | None:
    """Couples of cup and cone contacts at 1 N and 1 m/s, at the mid-length of the roller."""
    effect = scene.effects.rolling_resistance
    if effect is None:
        return None
    bearing, lubricant = scene.bearing, scene.lubricant
    radii = np.array([equivalent_radius(bearing, np.zeros(1), ring)[0] for ring in RINGS])
    viscosity = lubricant.dynamic_viscosity(scene.temperature)
    units = [
        laws.RollingContact(
            1.0,
            1.0,
            float(radius),
            bearing.effective_length,
            bearing.material.contact_modulus,
            viscosity,
            lubricant.pressure_viscosity_at(scene.temperature),
        )
        for radius in radii
    ]
    power_law, biboulet_houpert, thermal, hysteresis = None, None, None, None
    if effect.kind == "aihara":
        power_law = PowerLawRollingParams(
            _log2([laws.aihara_line(unit) for unit in units]), laws.AIHARA_SPEED, laws.AIHARA_LOAD
        )
    if effect.kind == "zhou_hoeprich":
        power_law = PowerLawRollingParams(
            _log2([laws.zhou_hoeprich_line(unit) for unit in units]),
            laws.ZHOU_HOEPRICH_SPEED,
            laws.ZHOU_HOEPRICH_LOAD,
        )
    if effect.kind == "biboulet_houpert":
        biboulet_houpert = BibouletHoupertParams(*(_log2(part) for part in _biboulet_houpert_limits(units)))
    if effect.kind != "hysteresis" and effect.thermal:
        level = thermal_loading(
            viscosity, lubricant.temperature_coefficient, 1.0, lubricant.thermal_conductivity
        )
        thermal = ThermalRollingParams(math.log2(level))
    if effect.hysteresis > 0.0:
        widths = [
            laws.hertz_half_width(1.0 / unit.length, unit.radius, unit.contact_modulus) for unit in units
        ]
        hysteresis = HysteresisParams(
            np.array([laws.hysteresis_line(1.0, width, effect.hysteresis) for width in widths])
        )
    return RollingParams(
        power_law=power_law,
        biboulet_houpert=biboulet_houpert,
        thermal=thermal,
        hysteresis=hysteresis,
        supply=effect.supply,
        regularisation=effect.regularisation_speed / radii,
    )


def _log2(values: Any) -> NDArray[np.float64]:
    return np.log2(np.array(values, dtype=float))


def _biboulet_houpert_limits(units: list[laws.RollingContact]) -> tuple[list[float], list[float]]:
    """Couples at 1 N and 1 m/s in the rigid and in the elastic regime; M^-10 = M_r^-10 + M_e^-10."""
    rigid, elastic = [], []
    for unit in units:
        speed, load = 2.0 * unit.speed_parameter, unit.line_load_parameter
        scale = 2.0 * unit.contact_modulus * unit.radius**2 * unit.length * laws.BIBOULET_HOUPERT_FACTOR
        rigid.append(scale * math.sqrt(speed * load))
        elastic.append(scale / laws.BIBOULET_HOUPERT_REGIME * speed**0.75)
    return rigid, elastic


def drag_params(scene: Scene) -> DragParams | None:
    """Drag of a roller at 1 m/s, and churning couples at 1 rad/s."""
    effect = scene.effects.drag
    if effect is None:
        return None
    bearing, lubricant = scene.bearing, scene.lubricant
    density = effect.fill * lubricant.density + (1.0 - effect.fill) * AIR_DENSITY
    reynolds = _radius(bearing) ** 2 / lubricant.kinematic_viscosity(scene.temperature)
    side = 2.0 * math.pi * _radius(bearing) * bearing.roller_length
    cylinder = 0.5 * density * side * _radius(bearing) ** 3
    disc = 0.5 * density * _radius(bearing) ** 5
    return DragParams(
        orbit=0.5 * density * effect.drag_coefficient * bearing.roller_length * bearing.roller_diameter,
        cylinder=effect.churning * cylinder * CYLINDER_FRICTION * reynolds**-CYLINDER_EXPONENT,
        cylinder_exponent=1.0 - CYLINDER_EXPONENT,
        disc=effect.churning * disc * DISC_FRICTION * reynolds**-DISC_EXPONENT,
    )


def _radius(bearing: Bearing) -> float:
    return 0.5 * bearing.roller_diameter


def seal_params(effects: EffectSet) -> SealParams | None:
    """Both seals together."""
    if effects.seal is None:
        return None
    return SealParams(
        torque=SEALS * effects.seal.torque,
        speed_coefficient=SEALS * effects.seal.speed_coefficient,
        regularisation=effects.seal.regularisation_speed,
    )
