"""Rolling resistance of a raceway contact: shear of the inlet against the entrainment, and its pressure.

The oil drawn into a contact holds back the surfaces of roller and ring alike, with a force F_R each against
the entrainment speed, and the pressure of the inlet balances both. On the roller that is the couple
M = 2 F_R R about the generator and the force (2 R / R_1 - 1) F_R, on the ring their opposites. Both follow
the entrainment and lose the power F_R (u_1 + u_2): however much a light roller slips, they slow it down and
never drive it.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.oil_layer import ELASTIC_FIT, RIGID_FIT
from beardyn_core.physics.bodies.exchange import account_loss, react
from beardyn_core.physics.bodies.held import held_couple, keep_couple
from beardyn_core.physics.bodies.layout import LOSS_ROLLING
from beardyn_core.physics.bodies.orbit import entrainment_speed
from beardyn_core.physics.lanes.lane_math import at_least, at_most, exp2, log2, magnitude, sqrt
from beardyn_core.physics.lanes.vectors import Vector, Wrench, add, add_scaled, cross, dot, scale, subtract

_THERMAL_FACTOR, _THERMAL_EXPONENT = 0.29, 0.78
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
def _couple(load, speed, ring, held, rolling):
    """Work out the couple against the entrainment, or take the one that is held, [N m]."""
    if held.recalled:
        return held_couple(held, load, held.params)
    floor = rolling.smallest_speed
    couple = rolling_couple(load, speed, ring, rolling) * speed / sqrt(speed * speed + floor * floor)
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
