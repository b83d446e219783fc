"""Dry friction, and the laws by which its corner at zero slip is rounded."""

from __future__ import annotations

from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.effects import LoadSharingTraction, Traction
from beardyn_core.physics.lanes.lane_math import (
    arctangent_over,
    at_least,
    at_most,
    decay_over,
    sqrt,
    where_greater,
)

TWO_OVER_PI = 0.6366197723675814
_SLOWEST = 1e-12


class SlipLawParams(NamedTuple):
    """Which law rounds the corner of dry friction: the member that is not ``None``."""

    threlfall: float | None  # steepness, 3
    ambrosio_start: float | None  # [m/s]
    arctangent: float | None  # steepness, 1


class CoulombParams(NamedTuple):
    """Dry friction."""

    friction: float
    regularisation: float  # [m/s]
    law: SlipLawParams | None = None


def slip_law_params(traction: Traction) -> SlipLawParams | None:
    """Choose the regularisation of dry friction; ``None`` is the smooth one."""
    if isinstance(traction, LoadSharingTraction) or traction.regularisation == "smooth":
        return None
    return SlipLawParams(
        threlfall=3.0 if traction.regularisation == "threlfall" else None,
        ambrosio_start=traction.regularisation_start if traction.regularisation == "ambrosio" else None,
        arctangent=1.0 if traction.regularisation == "arctangent" else None,
    )


@inline
def coulomb_rate(contact, coulomb):
    """Work out dry friction over slip speed, mu N / u with its corner at zero slip rounded, [N s/m].

    Adds friction of constant coefficient; neglects stiction and any lubricant.
    """
    if coulomb is None:
        return 0.0
    force = coulomb.friction * contact.load
    return slip_rate(force, contact.slip_squared, coulomb.regularisation, coulomb.law)


@inline
def slip_rate(force, slip_squared, speed, law):
    """Divide friction of the size ``force`` at full slip by the slip speed, its corner rounded, [N s/m].

    Without a named law the friction is u / sqrt(u^2 + speed^2) of the force: 71 % at that slip speed.
    """
    if law is None:
        return force / sqrt(slip_squared + speed * speed)
    slip = sqrt(slip_squared)
    return (
        threlfall_rate(force, slip, speed, law.threlfall)
        + ambrosio_rate(force, slip, speed, law.ambrosio_start)
        + arctangent_rate(force, slip, speed, law.arctangent)
    )


@inline
def threlfall_rate(force, slip, speed, steepness):
    """Take 1 - exp(-3 u / speed) of the force below the speed, 0.95 of it beyond, for a steepness of 3.

    References
    ----------
    Threlfall, D. C. (1978), The inclusion of Coulomb friction in mechanisms programs with particular
    reference to DRAM, Mech. Mach. Theory 13, 475.
    """
    if steepness is None:
        return 0.0
    per_slip = steepness / speed
    below = force * per_slip * decay_over(slip * per_slip)
    return where_greater(slip, speed, 0.95 * force / at_least(slip, _SLOWEST), below)


@inline
def ambrosio_rate(force, slip, full, start):
    """Take none of the force up to the slip speed ``start``, all of it from ``full`` on, linear in between.

    References
    ----------
    Ambrosio, J. (2003), Impact of rigid and flexible multibody systems: deformation description and contact
    models, Virtual Nonlinear Multibody Systems, 57.
    """
    if start is None:
        return 0.0
    moving = at_least(slip, _SLOWEST)
    ramp = at_most(at_least((moving - start) / (full - start), 0.0), 1.0)
    return force * ramp / moving


@inline
def arctangent_rate(force, slip, speed, steepness):
    """Take 2/pi atan(u / speed) of the force: half of it at that slip speed for a steepness of 1."""
    if steepness is None:
        return 0.0
    per_slip = steepness / speed
    return TWO_OVER_PI * force * per_slip * arctangent_over(slip * per_slip)
