"""The couple of raceway contacts against rolling: parameters, held over some steps, torque on the shaft.

The oil drawn into a contact holds back the surfaces of roller and ring alike, with a force F_R each against
the entrainment speed, and the pressure of the inlet balances both. On the roller that is the couple
M = 2 F_R R about the generator and the force (2 R / R_1 - 1) F_R, on the ring their opposites. Both follow
the entrainment and lose the power F_R (u_1 + u_2): however much a light roller slips, they slow it down and
never drive it.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.jit import inline
from beardyn_core.bearing import rolling_resistance as laws
from beardyn_core.bearing.film_thickness import LINE_FORMULAS, thermal_loading
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.oil_layer import ELASTIC_FIT, RIGID_FIT, CoupleShares
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.starvation import couple_shares
from beardyn_core.bearing.starved_rolling import FLOODED, OilSupply, flooded_film, rigid_film
from beardyn_core.effects import LineFilm, RollingResistance
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import account_loss, react
from beardyn_core.physics.bodies.friction_substeps import held_couple, keep_couple
from beardyn_core.physics.bodies.layout import LOSS_ROLLING
from beardyn_core.physics.bodies.orbit import entrainment_speed
from beardyn_core.physics.bodies.power import smooth_lever
from beardyn_core.physics.film import layer_params
from beardyn_core.physics.lamina_table import equivalent_radius
from beardyn_core.physics.lanes.lane_math import at_least, at_most, exp2, log2, magnitude, sqrt
from beardyn_core.physics.lanes.vectors import Vector, Wrench, add, add_scaled, cross, dot, scale, subtract


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


RINGS = ("cup", "cone")
# Couple of a contact, and its exponents of speed and load.
POWER_LAWS: dict[str, Any] = {
    "aihara": (laws.aihara_line, laws.AIHARA_SPEED, laws.AIHARA_LOAD),
    "zhou_hoeprich": (laws.zhou_hoeprich_line, laws.ZHOU_HOEPRICH_SPEED, laws.ZHOU_HOEPRICH_LOAD),
}


def rolling_params(
    bearing: RollerBearing,
    effect: RollingResistance | None,
    lubricant: Lubricant,
    temperature: float,
    supply: OilSupply,
) -> RollingParams | None:
    """Work out the couples of cup and cone contacts at 1 N and 1 m/s, at the mid-length of the roller.

    Parameters
    ----------
    temperature : float
        Of the lubricant at the inlets, [K].
    supply : OilSupply
        How much oil the contacts find.
    """
    if effect is None:
        return None
    radii = np.array([equivalent_radius(bearing, np.zeros(1), ring)[0] for ring in RINGS])
    viscosity = lubricant.dynamic_viscosity(temperature)
    pressure_viscosity = lubricant.pressure_viscosity_at(temperature)
    length, modulus = bearing.effective_length, bearing.material.contact_modulus
    units = [
        laws.RollingContact(1.0, 1.0, float(radius), length, modulus, viscosity, pressure_viscosity)
        for radius in radii
    ]
    power_law, biboulet_houpert, thermal, hysteresis = None, None, None, None
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
        starved=_starved_parameters(supply, units),
        supply=effect.supply,
        smallest_speed=effect.regularisation_speed,
        regularisation=effect.regularisation_speed / radii,
        force=2.0 * math.cos(bearing.half_angle) / bearing.roller_diameter - 0.5 / radii,
        sense=np.array([-1.0, 1.0]),
    )


def oil_supply(film: LineFilm | None) -> OilSupply:
    """State how much oil the contacts find; enough where no film is modelled."""
    if film is None:
        return FLOODED
    return OilSupply(film.formula, film.oil_layer, film.constant_share)


def _starved_parameters(supply: OilSupply, units: list[laws.RollingContact]) -> StarvedRollingParams | None:
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


_THERMAL_FACTOR, _THERMAL_EXPONENT = laws.THERMAL_FACTOR, laws.THERMAL_EXPONENT
_SMALLEST_SPEED = 1e-3
_RIGID_BEGIN, _RIGID_STEEPNESS, _RIGID_POWER = (
    math.log2(RIGID_FIT[0]),
    RIGID_FIT[1],
    -RIGID_FIT[2] / RIGID_FIT[1],
)
_ELASTIC_BEGIN, _ELASTIC_STEEPNESS = math.log2(ELASTIC_FIT[0]), ELASTIC_FIT[1]
_ELASTIC_POWER = -ELASTIC_FIT[2] / ELASTIC_FIT[1]
_LIGHT_LOAD = 1.0


class RollingContact(NamedTuple):
    """Rolling resistance of one raceway contact, that of the beginning of the step."""

    force: Any  # on the roller, around the ring [N]
    couple: Any  # on the roller, about the generator [N m]
    slip: Any  # of the roller against the ring [m/s]
    relative: Any  # rotation of the roller against the ring about the generator [rad/s]
    arm: Vector  # contact from the centre of mass of the roller [m]
    centre: Vector  # of mass of the roller from the ring's origin [m]
    around: Vector
    along: Vector


@inline
def rolling_couple(load, speed, ring, rolling):
    """Work out the couple of one raceway contact against rolling, [N m].

    Hydrodynamic couple of the inlet, reduced by its heating and by lack of oil, plus elastic hysteresis. The
    load is spread evenly along the roller. The fits for elastic contacts exceed the couple of rigid surfaces
    where loads are light; that of rigid surfaces holds there. Speeds below 1 mm/s are treated as 1 mm/s;
    below 1 N the hydrodynamic couple falls linearly to zero.

    ``load``: elastic load of the contact [N]; ``speed``: entrainment speed [m/s].

    References
    ----------
    Aihara (1987); Zhou and Hoeprich (1991); Biboulet and Houpert (2010); see `bearing.rolling_resistance`.
    """
    log2_speed = log2(magnitude(speed) + _SMALLEST_SPEED)
    log2_load = log2(at_least(load, _LIGHT_LOAD))
    left = _shares_left(log2_load, log2_speed, ring, rolling.starved)
    film = _power_law(log2_load, log2_speed, left, ring, rolling.power_law) + _biboulet_houpert(
        log2_load, log2_speed, left, ring, rolling.biboulet_houpert
    )
    carried = at_most(load * (1.0 / _LIGHT_LOAD), 1.0)
    cooled = rolling.supply * carried * _thermal_reduction(log2_speed, rolling.thermal)
    return film * cooled + _hysteresis(load, ring, rolling.hysteresis)


@inline
def _shares_left(log2_load, log2_speed, ring, starved):
    """Work out what lack of oil leaves of the couple of rigid and of elastic surfaces, log2 of both shares.

    References
    ----------
    `bearing.starvation`, for the film at the mean load along the roller.
    """
    if starved is None:
        return 0.0, 0.0
    elastic = (
        starved.log2_elastic[ring] + starved.elastic_speed * log2_speed + starved.elastic_load * log2_load
    )
    rigid = starved.log2_rigid[ring] + starved.rigid_speed * log2_speed - log2_load
    ratio = at_least(elastic, rigid)
    return (
        _RIGID_POWER * log2(1.0 + exp2(_RIGID_STEEPNESS * (ratio + _RIGID_BEGIN))),
        _ELASTIC_POWER * log2(1.0 + exp2(_ELASTIC_STEEPNESS * (ratio + _ELASTIC_BEGIN))),
    )


@inline
def _power_law(log2_load, log2_speed, left, ring, law):
    if law is None:
        return 0.0
    elastic = (
        law.log2_couple[ring] + law.speed_exponent * log2_speed + law.load_exponent * log2_load + left[1]
    )
    return exp2(at_most(elastic, law.log2_rigid[ring] + 0.5 * (log2_speed + log2_load) + left[0]))


@inline
def _biboulet_houpert(log2_load, log2_speed, left, ring, law):
    if law is None:
        return 0.0
    rigid = law.log2_rigid[ring] + 0.5 * (log2_speed + log2_load) + left[0]
    elastic = law.log2_elastic[ring] + 0.75 * log2_speed + left[1]
    return exp2(rigid - 0.1 * log2(1.0 + exp2(10.0 * (rigid - elastic))))


@inline
def _thermal_reduction(log2_speed, thermal):
    if thermal is None:
        return 1.0
    loading = thermal.log2_loading + 2.0 * log2_speed
    return 1.0 / (1.0 + _THERMAL_FACTOR * exp2(_THERMAL_EXPONENT * loading))


@inline
def _hysteresis(load, ring, hysteresis):
    if hysteresis is None:
        return 0.0
    return hysteresis.couple[ring] * load * sqrt(load)


@inline
def prepare_rolling(contact, ring, view, body, rolling):
    """Work out the `RollingContact` of one raceway; without the effect zeros, which nothing uses."""
    line, load = contact.line, contact.sums.force[0]
    zero = 0.0 * load
    slip = contact.slip.around[0]
    if rolling is None:
        return RollingContact(zero, zero, zero, zero, line.arm, contact.centre, line.around, line.along)
    if not contact.sums.touches:
        return RollingContact(zero, zero, zero, zero, line.arm, contact.centre, line.around, line.along)
    speed = entrainment_speed(line, contact.centre, body, view)
    couple = _couple(load, speed, ring, contact.held, rolling)
    relative = dot(subtract(body.omega, view.omega), line.along)
    return RollingContact(
        rolling.force[ring] * couple,
        rolling.sense[ring] * couple,
        slip,
        relative,
        line.arm,
        contact.centre,
        line.around,
        line.along,
    )


@inline
def moving_couple(load, speed, ring, rolling):
    """Work out the couple of one raceway contact against rolling, which falls to none at rest, [N m]."""
    floor = rolling.smallest_speed
    return rolling_couple(load, speed, ring, rolling) * speed / sqrt(speed * speed + floor * floor)


@inline
def _couple(load, speed, ring, held, rolling):
    """Work out the couple against the entrainment, or take the one that is held, [N m]."""
    if held.recalled:
        return held_couple(held, load, held.params)
    couple = moving_couple(load, speed, ring, rolling)
    keep_couple(held, couple, held.params)
    return couple


@inline
def _wrench(contact):
    """Work out force and moment on the roller about its centre of mass."""
    force = scale(contact.force, contact.around)
    return Wrench(force, add_scaled(cross(contact.arm, force), contact.couple, contact.along))


@inline
def push_rolling(total, contact, rolling):
    """Add force and couple to the wrench on the roller."""
    if rolling is None:
        return total
    wrench = _wrench(contact)
    return Wrench(add(total.force, wrench.force), add(total.moment, wrench.moment))


@inline
def settle_rolling(ring, contact, change, total, here, rolling, p):
    """Settle force and couple after the solve: on roller and ring alike, with their loss."""
    if rolling is None:
        return total
    wrench = _wrench(contact)
    react(ring, contact.centre, wrench, here)
    moved = dot(add(change.velocity, cross(change.omega, contact.arm)), contact.around)
    slid = contact.force * (contact.slip + 0.5 * moved)
    rolled = contact.couple * (contact.relative + 0.5 * dot(change.omega, contact.along))
    account_loss(here, LOSS_ROLLING, -p.step * (slid + rolled), p.effects.audit)
    return Wrench(add(total.force, wrench.force), add(total.moment, wrench.moment))


@inline
def rolling_torque(loads, speeds, k, rolling):
    """Work out the rolling resistance's torque of a block of rollers, along the shaft's rotation, [N m].

    References
    ----------
    Zhao et al. (2026), see `physics.statics.torque`: T = sum (R_o M_i + R_i M_o) / D.
    """
    if rolling is None:
        return 0.0 * loads[0]
    cup = rolling_couple(loads[0], speeds[1] * k.cup_radius, layout.CUP, rolling)
    cone = rolling_couple(loads[1], (speeds[0] - speeds[1]) * k.cone_radius, layout.CONE, rolling)
    on_cup = smooth_lever(k.rolling_on_cup, speeds[0], rolling.regularisation[layout.CUP])
    return (
        on_cup * cup + smooth_lever(k.rolling_on_cone, speeds[0], rolling.regularisation[layout.CONE]) * cone
    )
