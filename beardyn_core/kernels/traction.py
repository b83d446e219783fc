"""Traction of a lamina: friction force over slip speed."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, sqrt
from beardyn_core.model.parameters import LAMINA_PRESSURE

_LOG2_E = 1.4426950408889634
_LARGEST_LOG2_THICKENING = 30.0


@inline
def coulomb_rate(load: Any, slip_squared: Any, coulomb: Any) -> Any:
    """Dry friction over slip speed, mu N / sqrt(u^2 + u_r^2), [N s/m].

    Adds friction of constant coefficient, smooth through zero slip; neglects stiction and any lubricant.
    """
    if coulomb is None:
        return 0.0
    floor = coulomb.regularisation * coulomb.regularisation
    return coulomb.friction * load / sqrt(slip_squared + floor)


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
    dry = load / sqrt(slip_squared + mixed.regularisation * mixed.regularisation)
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
    """Friction of the full film over slip speed, [N s/m].

    A constant coefficient, or a film that is Newtonian at the mean Hertz pressure up to a limiting shear
    stress.

    References
    ----------
    Bair and Winer (1979) for the limiting shear stress; Barus for the viscosity, capped at 2^30.
    """
    if sheared_film is None:
        return mixed.film_friction * dry
    pressure = sqrt(load * laminae[LAMINA_PRESSURE + ring, lamina])
    thickening = at_most(pressure * (film.pressure_viscosity * _LOG2_E), _LARGEST_LOG2_THICKENING)
    shear = film.viscosity * exp2(thickening - log2_film)
    limit = sheared_film.limiting_shear * pressure
    # load / pressure is the area; 1e-30 keeps an unloaded lamina at zero friction, not 0/0
    return (
        load
        * sheared_film.limiting_shear
        * shear
        / sqrt(limit * limit + shear * shear * slip_squared + 1e-30)
    )


@inline
def friction_rate(
    load: Any, slip_squared: Any, log2_film: Any, lamina: Any, ring: Any, laminae: Any, effects: Any
) -> Any:
    """Friction of one lamina over its slip speed, [N s/m]; 0 without traction."""
    return _rate(
        load, slip_squared, log2_film, lamina, ring, laminae, effects.film, effects.coulomb, effects.mixed
    )


@inline
def _rate(
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
def traction_capacity(load: Any, coulomb: Any, mixed: Any) -> Any:
    """Friction at full slip in the dry limit, scale of the chatter index, [N]."""
    if mixed is None:
        return _dry_capacity(load, coulomb)
    return mixed.friction * load


@inline
def _dry_capacity(load: Any, coulomb: Any) -> Any:
    if coulomb is None:
        return load
    return coulomb.friction * load
