"""Traction of a lamina: friction force over slip speed."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.film_traction import (
    aihara_rate,
    bair_winer_rate,
    eyring_rate,
    inlet_rate,
    limited_newton_rate,
)
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, sqrt
from beardyn_core.kernels.saturation import arctangent_with
from beardyn_core.kernels.slip_laws import slip_rate

_LOG2_E = 1.4426950408889634
_TWO_OVER_PI = 0.6366197723675814


@inline
def coulomb_rate(load: Any, slip_squared: Any, coulomb: Any) -> Any:
    """Dry friction over slip speed, mu N / u with its corner at zero slip rounded, [N s/m].

    Adds friction of constant coefficient; neglects stiction and any lubricant.
    """
    if coulomb is None:
        return 0.0
    return slip_rate(coulomb.friction * load, slip_squared, coulomb.regularisation, coulomb.law)


@inline
def mixed_rate(
    load: Any, slip_squared: Any, log2_film: Any, lamina: Any, ring: Any, laminae: Any, film: Any, mixed: Any
) -> Any:
    """Blend of boundary and full-film friction over slip speed, [N s/m].

    The blend weight is the sixth-power law of the mixed regime over the film parameter. Neglects heating
    of the film.

    References
    ----------
    Santos (2017), Eq. 8, after Harada and Sakaguchi (2005).
    """
    dry = slip_rate(load, slip_squared, mixed.regularisation, mixed.law)
    wet = film_rate(
        load, slip_squared, dry, log2_film, lamina, ring, laminae, film, mixed, mixed.sheared_film
    )
    share = boundary_share(exp2(log2_film) / film.roughness, mixed)
    return wet + (mixed.friction * dry - wet) * share


@inline
def boundary_share(film_parameter: Any, mixed: Any) -> Any:
    """Weight of the boundary friction: 1 below the boundary film parameter, 0 above the full-film one."""
    share = (mixed.full_film - film_parameter) / (mixed.full_film - mixed.boundary_film)
    share = at_most(at_least(share, 0.0), 1.0)
    share2 = share * share
    return share2 * share2 * share2


@inline
def film_rate(
    load: Any,
    slip_squared: Any,
    dry: Any,
    log2_film: Any,
    lamina: Any,
    ring: Any,
    laminae: Any,
    film: Any,
    mixed: Any,
    sheared_film: Any,
) -> Any:
    """Friction of the full film over slip speed, [N s/m]: a constant coefficient, or a film that shears."""
    if sheared_film is None:
        return mixed.film_friction * dry
    return limited_newton_rate(load, slip_squared, log2_film, lamina, ring, laminae, film, sheared_film)


@inline
def load_sharing_rate(
    load: Any,
    log2_force: Any,
    slip_squared: Any,
    log2_film: Any,
    log2_rolling: Any,
    lamina: Any,
    ring: Any,
    laminae: Any,
    film: Any,
    sharing: Any,
) -> Any:
    """Asperities and film share the load, each with its own friction, over slip speed, [N s/m].

    The film carries 1 - exp(-1.8 Lambda^1.2); asperities have mu_0 2/pi atan(slope s), s slip over
    entrainment speed. The film never has more friction than dry asperities: the fits extrapolate to that
    for cold oil. Without a film all load is on asperities.

    References
    ----------
    Load share and asperity law as in the published source of D-BRAIN (NSK).
    """
    slip = sqrt(slip_squared)
    inverse_slip = 1.0 / at_least(slip, 1e-12)  # one division for all laws
    per_slip = sharing.slope * exp2(-log2_rolling)
    saturated = per_slip * arctangent_with(per_slip * slip, inverse_slip * (1.0 / per_slip))
    asperities = sharing.friction * _TWO_OVER_PI * load * saturated
    return _shared_rate(
        load, log2_force, slip, inverse_slip, asperities, log2_film, log2_rolling, lamina, ring, laminae,
        film, sharing,
    )  # fmt: skip


@inline
def _shared_rate(
    load: Any,
    log2_force: Any,
    slip: Any,
    inverse_slip: Any,
    asperities: Any,
    log2_film: Any,
    log2_rolling: Any,
    lamina: Any,
    ring: Any,
    laminae: Any,
    film: Any,
    sharing: Any,
) -> Any:
    if film is None:
        return asperities
    wet = (
        aihara_rate(load, log2_force, slip, inverse_slip, log2_rolling, lamina, ring, sharing.aihara)
        + eyring_rate(load, slip, log2_film, lamina, ring, laminae, film, sharing.eyring)
        + bair_winer_rate(load, slip, log2_film, lamina, ring, laminae, film, sharing.bair_winer)
        + inlet_rate(log2_film, lamina, ring, laminae, sharing.inlet)
    )
    wet = at_most(wet, sharing.friction * load * inverse_slip)
    share = exp2(-1.8 * _LOG2_E * exp2(1.2 * (log2_film - sharing.log2_roughness)))
    return wet + (asperities - wet) * share


@inline
def friction_rate(
    load: Any,
    log2_force: Any,
    slip_squared: Any,
    log2_film: Any,
    log2_speed: Any,
    lamina: Any,
    ring: Any,
    laminae: Any,
    effects: Any,
) -> Any:
    """Friction of one lamina over its slip speed, [N s/m]; 0 without traction."""
    return _rate(
        load, log2_force, slip_squared, log2_film, log2_speed, lamina, ring, laminae,
        effects.film, effects.coulomb, effects.mixed, effects.load_sharing,
    )  # fmt: skip


@inline
def _rate(
    load: Any,
    log2_force: Any,
    slip_squared: Any,
    log2_film: Any,
    log2_speed: Any,
    lamina: Any,
    ring: Any,
    laminae: Any,
    film: Any,
    coulomb: Any,
    mixed: Any,
    load_sharing: Any,
) -> Any:
    if load_sharing is None:
        return _blended_rate(load, slip_squared, log2_film, lamina, ring, laminae, film, coulomb, mixed)
    return load_sharing_rate(
        load, log2_force, slip_squared, log2_film, log2_speed[1], lamina, ring, laminae, film, load_sharing
    )


@inline
def _blended_rate(
    load: Any,
    slip_squared: Any,
    log2_film: Any,
    lamina: Any,
    ring: Any,
    laminae: Any,
    film: Any,
    coulomb: Any,
    mixed: Any,
) -> Any:
    if mixed is None:
        return coulomb_rate(load, slip_squared, coulomb)
    return mixed_rate(load, slip_squared, log2_film, lamina, ring, laminae, film, mixed)


@inline
def traction_capacity(load: Any, coulomb: Any, mixed: Any, load_sharing: Any) -> Any:
    """Friction at full slip in the dry limit, scale of the chatter index, [N]."""
    if load_sharing is None:
        return _blended_capacity(load, coulomb, mixed)
    return load_sharing.friction * load


@inline
def _blended_capacity(load: Any, coulomb: Any, mixed: Any) -> Any:
    if mixed is None:
        return _dry_capacity(load, coulomb)
    return mixed.friction * load


@inline
def _dry_capacity(load: Any, coulomb: Any) -> Any:
    if coulomb is None:
        return load
    return coulomb.friction * load
