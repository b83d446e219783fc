"""Rolling resistance, drag and seals as kernel parameters."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing import rolling_resistance as laws
from beardyn_core.bearing.film_thickness import LINE_FORMULAS, thermal_loading
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.oil_layer import CoupleShares
from beardyn_core.bearing.starvation import couple_shares
from beardyn_core.bearing.starved_rolling import FLOODED, OilSupply, flooded_film, rigid_film
from beardyn_core.effects import LineFilm
from beardyn_core.physics.film import layer_params
from beardyn_core.physics.lamina_table import equivalent_radius
from beardyn_core.scene.scene import Scene


class PowerLawRollingParams(NamedTuple):
    """Rolling couple as powers of speed and load."""

    log2_couple: Any  # [ring], at 1 N and 1 m/s [log2 N m]
    speed_exponent: float
    load_exponent: float
    log2_rigid: Any  # [ring], of rigid surfaces at 1 N and 1 m/s, the upper limit [log2 N m]


class BibouletHoupertParams(NamedTuple):
    """Rolling couple between the rigid and the elastic regime."""

    log2_rigid: Any  # [ring], at 1 N and 1 m/s [log2 N m]
    log2_elastic: Any  # [ring], at 1 m/s [log2 N m]


class ThermalRollingParams(NamedTuple):
    """Heating of the inlet."""

    log2_loading: float  # thermal loading parameter at 1 m/s


class HysteresisParams(NamedTuple):
    """Elastic hysteresis."""

    couple: Any  # [ring], at 1 N [N m]


class StarvedRollingParams(NamedTuple):
    """Flooded film of a whole contact over the layer of oil, which decides how much of the couple is left."""

    log2_elastic: Any  # [ring], at 1 N and 1 m/s
    elastic_speed: float
    elastic_load: float
    log2_rigid: Any  # [ring], at 1 N and 1 m/s
    rigid_speed: float


class RollingParams(NamedTuple):
    """Couple of the raceway contacts against rolling."""

    power_law: PowerLawRollingParams | None
    biboulet_houpert: BibouletHoupertParams | None
    thermal: ThermalRollingParams | None
    hysteresis: HysteresisParams | None
    starved: StarvedRollingParams | None
    supply: float
    smallest_speed: float  # of entrainment, below which the couple falls to zero [m/s]
    regularisation: Any  # [ring], the same as a rotation against the ring, for rollers that only roll [rad/s]
    force: Any  # [ring], around the ring on the roller, over the couple [1/m]
    sense: Any  # [ring], of the couple on the roller about the generator, +1 or -1


class DragParams(NamedTuple):
    """Medium around the rollers."""

    orbit: float  # force at 1 m/s [N]
    cylinder: float  # couple at 1 rad/s [N m]
    cylinder_exponent: float  # of the speed in couple over speed
    disc: float  # couple at 1 rad/s, both ends [N m]


class SealParams(NamedTuple):
    """Both seals on the shaft."""

    torque: float  # [N m]
    speed_coefficient: float  # [N m s/rad]
    regularisation: float  # [rad/s]


AIR_DENSITY = 1.2
RINGS = ("cup", "cone")
SEALS = 2.0
# Turbulent skin friction of a cylinder that turns in a wide medium, f = 0.105 Re^-0.274: within 10 % of
# Theodorsen and Regier's 1/sqrt(f) = -0.6 + 4.07 log10(Re sqrt(f)) for Re from 1e3 to 1e5.
CYLINDER_FRICTION, CYLINDER_EXPONENT = 0.105, 0.274
# Laminar disc, both sides: c = 3.87 / sqrt(Re).
DISC_FRICTION, DISC_EXPONENT = 3.87, 0.5
# Couple of a contact, and its exponents of speed and load.
POWER_LAWS: dict[str, Any] = {
    "aihara": (laws.aihara_line, laws.AIHARA_SPEED, laws.AIHARA_LOAD),
    "zhou_hoeprich": (laws.zhou_hoeprich_line, laws.ZHOU_HOEPRICH_SPEED, laws.ZHOU_HOEPRICH_LOAD),
}


def rolling_params(scene: Scene) -> RollingParams | None:
    """Work out the couples of cup and cone contacts at 1 N and 1 m/s, at the mid-length of the roller."""
    effect = scene.effects.rolling_resistance
    if effect is None:
        return None
    bearing, lubricant = scene.bearing, scene.lubricant
    radii = np.array([equivalent_radius(bearing, np.zeros(1), ring)[0] for ring in RINGS])
    viscosity = lubricant.dynamic_viscosity(scene.temperature)
    pressure_viscosity = lubricant.pressure_viscosity_at(scene.temperature)
    length, modulus = bearing.effective_length, bearing.material.contact_modulus
    units = [
        laws.RollingContact(1.0, 1.0, float(radius), length, modulus, viscosity, pressure_viscosity)
        for radius in radii
    ]
    power_law, biboulet_houpert, thermal, hysteresis = None, None, None, None
    supply = oil_supply(scene.effects.film)
    left = CoupleShares(1.0, 1.0) if supply.layer is not None else couple_shares(supply.film_share)
    rigid, elastic = (
        _log2(part) + math.log2(share)
        for part, share in zip(_biboulet_houpert_limits(units), left, strict=True)
    )
    if effect.kind in POWER_LAWS:
        line, speed_exponent, load_exponent = POWER_LAWS[effect.kind]
        couple = _log2([line(unit) for unit in units]) + math.log2(left.elastic)
        power_law = PowerLawRollingParams(couple, speed_exponent, load_exponent, rigid)
    if effect.kind == "biboulet_houpert":
        biboulet_houpert = BibouletHoupertParams(rigid, elastic)
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
        starved=_starved(supply, units),
        supply=effect.supply,
        smallest_speed=effect.regularisation_speed,
        regularisation=effect.regularisation_speed / radii,
        force=2.0 * math.cos(bearing.half_angle) / bearing.roller_diameter - 0.5 / radii,
        sense=np.array([-1.0, 1.0]),
    )


def oil_supply(film: LineFilm | None) -> OilSupply:
    """Say how much oil the contacts find; enough where no film is modelled."""
    if film is None:
        return FLOODED
    return OilSupply(film.formula, film.oil_layer, film.constant_share)


def _starved(supply: OilSupply, units: list[laws.RollingContact]) -> StarvedRollingParams | None:
    layer = layer_params(supply.layer, units[0].viscosity)
    if layer is None:
        return None
    law = LINE_FORMULAS[supply.formula]
    return StarvedRollingParams(
        log2_elastic=_log2([flooded_film(unit, supply.formula) for unit in units]) - layer.log2_thickness,
        elastic_speed=law.speed_exponent - layer.speed_exponent,
        elastic_load=law.load_exponent,
        log2_rigid=_log2([rigid_film(unit) for unit in units]) - layer.log2_thickness,
        rigid_speed=1.0 - layer.speed_exponent,
    )


def _log2(values: Any) -> NDArray[np.float64]:
    return np.log2(np.array(values, dtype=float))


def _biboulet_houpert_limits(units: list[laws.RollingContact]) -> tuple[list[float], list[float]]:
    """Work out couples at 1 N and 1 m/s in both regimes; M^-10 = M_r^-10 + M_e^-10."""
    rigid, elastic = [], []
    for unit in units:
        speed, load = 2.0 * unit.speed_parameter, unit.line_load_parameter
        scale = 2.0 * unit.contact_modulus * unit.radius**2 * unit.length * laws.BIBOULET_HOUPERT_FACTOR
        rigid.append(scale * math.sqrt(speed * load))
        elastic.append(scale / laws.BIBOULET_HOUPERT_REGIME * speed**0.75)
    return rigid, elastic


def drag_params(scene: Scene) -> DragParams | None:
    """Work out drag of a roller at 1 m/s, and churning couples at 1 rad/s."""
    effect = scene.effects.drag
    if effect is None:
        return None
    bearing, lubricant = scene.bearing, scene.lubricant
    fill = effect.present_fill
    density = fill * lubricant.density + (1.0 - fill) * AIR_DENSITY
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


def seal_params(scene: Scene) -> SealParams | None:
    """Add up both seals."""
    seal = scene.effects.seal
    if seal is None:
        return None
    both = SEALS * seal.stiffening(scene.lubricant.kinematic_viscosity(scene.temperature))
    return SealParams(
        torque=both * seal.torque,
        speed_coefficient=both * seal.speed_coefficient,
        regularisation=seal.regularisation_speed,
    )
