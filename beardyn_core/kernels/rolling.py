"""Rolling resistance of a raceway contact: a couple on roller and ring against their relative rotation."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import account, account_loss, react_couple
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, log2, magnitude, sqrt
from beardyn_core.kernels.orbit import entrainment_speed
from beardyn_core.kernels.solve import add_couple
from beardyn_core.kernels.vectors import Vector, Wrench, add, dot, scale, subtract
from beardyn_core.model.layout import LOSS_ROLLING

_THERMAL_FACTOR, _THERMAL_EXPONENT = 0.29, 0.78
_SMALLEST_SPEED = 1e-3
_LIGHT_LOAD = 1.0


class RollingContact(NamedTuple):
    """Rolling resistance of one raceway contact before the solve."""

    rate: Any  # couple over relative speed [N m s]
    relative: Any  # speed about the generator [rad/s]
    along: Vector  # direction of the generator


@inline
def rolling_couple(load, speed, ring, rolling):
    """Work out the couple of one raceway contact against rolling, [N m].

    Hydrodynamic couple of the inlet, reduced by its heating and by its supply, plus elastic hysteresis. The
    load is spread evenly along the roller. Speeds below 1 mm/s are treated as 1 mm/s; below 1 N the
    hydrodynamic couple falls linearly to zero.

    ``load``: elastic load of the contact [N]; ``speed``: entrainment speed [m/s].

    References
    ----------
    Aihara (1987); Zhou and Hoeprich (1991); Biboulet and Houpert (2010); see `bearing.rolling_resistance`.
    """
    log2_speed = log2(magnitude(speed) + _SMALLEST_SPEED)
    log2_load = log2(at_least(load, _LIGHT_LOAD))
    film = _power_law(log2_load, log2_speed, ring, rolling.power_law) + _biboulet_houpert(
        log2_load, log2_speed, ring, rolling.biboulet_houpert
    )
    carried = at_most(load * (1.0 / _LIGHT_LOAD), 1.0)
    cooled = rolling.supply * carried * _thermal_reduction(log2_speed, rolling.thermal)
    return film * cooled + _hysteresis(load, ring, rolling.hysteresis)


@inline
def _power_law(log2_load, log2_speed, ring, law):
    if law is None:
        return 0.0
    return exp2(law.log2_couple[ring] + law.speed_exponent * log2_speed + law.load_exponent * log2_load)


@inline
def _biboulet_houpert(log2_load, log2_speed, ring, law):
    if law is None:
        return 0.0
    rigid = law.log2_rigid[ring] + 0.5 * (log2_speed + log2_load)
    elastic = law.log2_elastic[ring] + 0.75 * log2_speed
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
    if rolling is None:
        return RollingContact(0.0 * load, 0.0 * load, line.along)
    if not contact.sums.touches:
        return RollingContact(0.0 * load, 0.0 * load, line.along)
    speed = entrainment_speed(line, contact.centre, body, view)
    relative = dot(subtract(body.omega, view.omega), line.along)
    floor = rolling.regularisation[ring]
    couple = rolling_couple(load, speed, ring, rolling)
    return RollingContact(couple / sqrt(relative * relative + floor * floor), relative, line.along)


@inline
def stiffen_rolling(matrix, contact, step, rolling):
    """Add the implicit part of the rolling resistance to the roller's matrix."""
    if rolling is None:
        return matrix
    return add_couple(matrix, contact.along, step * contact.rate)


@inline
def push_rolling(moment, contact, rolling):
    """Add the couple at the beginning of the step to a moment."""
    if rolling is None:
        return moment
    return add(moment, scale(-contact.rate * contact.relative, contact.along))


@inline
def settle_rolling(ring, contact, change, total, here, rolling, p):
    """Settle the couple after the solve: on roller and ring alike, with its loss."""
    if rolling is None:
        return total
    rate, relative, along = contact.rate, contact.relative, contact.along
    gained = dot(change.omega, along)
    middle = relative + 0.5 * gained
    couple = scale(-rate * (relative + gained), along)
    react_couple(ring, couple, here)
    audit = p.effects.audit
    account_loss(here, LOSS_ROLLING, p.step * rate * middle * middle, audit)
    account(here, 0.5 * p.step * rate * gained * middle, 0.0 * rate, audit)
    return Wrench(total.force, add(total.moment, couple))
