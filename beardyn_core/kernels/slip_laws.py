"""Dry friction near zero slip: the laws by which its sharp corner is rounded, as force over slip speed.

Every law acts against the slip, so it dissipates; none sticks: below its slip speed a contact creeps. A law
that is not chosen is ``None`` and adds nothing.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, sqrt, where_greater
from beardyn_core.kernels.saturation import arctangent_over, decay_over

_TWO_OVER_PI = 0.6366197723675814
_SLOWEST = 1e-12


@inline
def slip_rate(force: Any, slip_squared: Any, speed: Any, law: Any) -> Any:
    """Friction of the size ``force`` at full slip, over slip speed, [N s/m].

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
def threlfall_rate(force: Any, slip: Any, speed: Any, steepness: Any) -> Any:
    """1 - exp(-3 u / speed) of the force below the speed, 0.95 of it beyond, for a steepness of 3.

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
def ambrosio_rate(force: Any, slip: Any, full: Any, start: Any) -> Any:
    """No friction up to the slip speed ``start``, the whole force from ``full`` on, linear in between.

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
def arctangent_rate(force: Any, slip: Any, speed: Any, steepness: Any) -> Any:
    """2/pi atan(u / speed) of the force: half of it at that slip speed for a steepness of 1."""
    if steepness is None:
        return 0.0
    per_slip = steepness / speed
    return _TWO_OVER_PI * force * per_slip * arctangent_over(slip * per_slip)
