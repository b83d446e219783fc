"""Film and friction of the rib contact."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, log2, magnitude, sqrt, where_greater
from beardyn_core.kernels.vectors import add, cross, dot, scale

_LOG2_E = 1.4426950408889634
_SHARE_FACTOR = -1.8 * _LOG2_E
_SHARE_EXPONENT = 1.2
_LARGEST_LOG2_THICKENING = 30.0


@inline
def rib_entrainment(
    centre: Any,
    arm: Any,
    normal: Any,
    velocity: Any,
    omega: Any,
    ring_axis: Any,
    ring_velocity: Any,
    ring_omega: Any,
    orbit_rate: Any,
    film: Any,
) -> Any:
    """Mean surface speed of roller end and rib against the contact, which orbits with the roller, [m/s]."""
    if film is None:
        return 0.0
    around = cross(ring_axis, normal)
    around = scale(1.0 / sqrt(dot(around, around)), around)
    point = add(centre, arm)
    cone = dot(add(ring_velocity, cross(ring_omega, point)), around)
    roller = dot(add(velocity, cross(omega, arm)), around)
    contact = dot(ring_velocity, around) + orbit_rate * dot(cross(ring_axis, point), around)
    return 0.5 * (cone + roller) - contact


@inline
def rib_log2_film(load: Any, speed: Any, film: Any) -> Any:
    """Binary logarithm of the central film thickness, [log2 m]; loads below 1 mN are treated as 1 mN.

    References
    ----------
    Hamrock and Dowson (1977), see `bearing.rib_film`.
    """
    if film is None:
        return 0.0
    return (
        film.log2_factor
        + film.speed_exponent * log2(magnitude(speed) + 1e-3)
        + film.load_exponent * log2(at_least(load, 1e-3))
    )


@inline
def rib_film_output(load: Any, log2_film: Any, film: Any) -> Any:
    """Film thickness of a loaded rib contact, [m]; 0 without a film or load."""
    if film is None:
        return 0.0 * load
    thickness = exp2(log2_film)
    return where_greater(load, 0.0, thickness, 0.0 * thickness)


@inline
def rib_friction(load: Any, root_depth: Any, speed_squared: Any, log2_film: Any, rib: Any, film: Any) -> Any:
    """Friction over slip speed, [N s/m]: dry, or shared by asperities and film.

    The film carries the share 1 - exp(-1.8 Lambda^1.2) of the load. Neglects heating of the film.

    References
    ----------
    Zhao et al. (2026) for the load sharing at the rib.
    """
    dry = load / sqrt(speed_squared + rib.regularisation * rib.regularisation)
    if film is None:
        return rib.friction * dry
    lambda_power = exp2(_SHARE_EXPONENT * (log2_film - film.log2_roughness))
    asperities = exp2(_SHARE_FACTOR * lambda_power)
    wet = _film_friction(load, root_depth, speed_squared, dry, log2_film, film, film.sheared)
    return wet + (film.boundary_friction * dry - wet) * asperities


@inline
def _film_friction(
    load: Any, root_depth: Any, speed_squared: Any, dry: Any, log2_film: Any, film: Any, sheared: Any
) -> Any:
    """Constant coefficient, or Newtonian at the mean Hertz pressure up to a limiting shear stress."""
    if sheared is None:
        return film.film_friction * dry
    pressure = sheared.pressure * root_depth
    thickening = at_most(pressure * (sheared.pressure_viscosity * _LOG2_E), _LARGEST_LOG2_THICKENING)
    shear = sheared.viscosity * exp2(thickening - log2_film)
    limit = sheared.limiting_shear * pressure
    # load / pressure is the area; 1e-30 keeps an unloaded contact at zero friction, not 0/0
    return load * sheared.limiting_shear * shear / sqrt(limit * limit + shear * shear * speed_squared + 1e-30)


@inline
def spin_reach(touching: Any, drilling: Any) -> Any:
    """Square of the radius at which spin about the normal counts as slip, 0.18 a^2, [m^2].

    A Hertz ellipse that slides with u and spins with w dissipates mu Q sqrt(u^2 + 0.18 a^2 w^2) to good
    approximation, a being its half axis along the slip's normal; a^2 grows with the approach.

    References
    ----------
    Zhao et al. (2026): T = mu Q h sqrt(1 + 0.18 (a/h)^2), there with u = w h.
    """
    if drilling is None:
        return 0.0 * touching
    return drilling.reach * touching


@inline
def with_spin(sliding: Any, reach: Any, spin: Any, drilling: Any) -> Any:
    """Square of the slip speed with that of the spin, [m^2/s^2]."""
    if drilling is None:
        return sliding
    return sliding + reach * spin * spin
