"""Contact of the spherical large roller end with the conical cone rib."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, sqrt, where_greater
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.rib_friction import (
    rib_entrainment,
    rib_film_output,
    rib_friction,
    rib_log2_film,
    spin_reach,
    with_spin,
)
from beardyn_core.kernels.rib_gap import rib_gap
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, subtract


@inline
def rib_contact(
    centre: Any,
    axis: Any,
    velocity: Any,
    omega: Any,
    ring_axis: Any,
    ring_velocity: Any,
    ring_omega: Any,
    orbit_rate: Any,
    rib: Any,
    damping: Any,
) -> Any:
    """Force of the rib on the roller: sphere on cone, closed form.

    Adds the axial guidance of the rollers. The stiffness is that of the face, also on an edge of the rib or
    on the rim of the roller end, where a Hertz contact is up to a third softer.

    Parameters
    ----------
    centre : vector
        Centre of mass of the roller from the cone's origin, [m].
    axis, velocity, omega : vector
        Of the roller.
    ring_axis, ring_velocity, ring_omega : vector
        Of the cone at its origin.
    orbit_rate : lane value
        Of the roller about the bearing axis, [rad/s].
    rib : RibParams
    damping : DampingParams or None

    Returns
    -------
    normal, arm : vector
        Unit normal into the rib; contact from the roller's centre of mass, [m].
    load, tangent, friction : lane value
        Normal force [N], tangent stiffness [N/m], friction over slip speed [N s/m].
    elastic, energy : lane value
        Elastic force that belongs to the stored energy, also where the contact opens faster than the spring
        follows and nothing presses [N]; elastic energy [J].
    slip : vector
        Velocity of the roller against the rib, [m/s].
    drilling, spin : lane value
        Friction moment over spin about the normal [N m s], and that spin [rad/s].
    film : lane value
        Film thickness, [m].

    References
    ----------
    Hertz (1881) with the stiffness of Hamrock and Brewe (1983); the gap is exact (a sphere's distance
    to a cone is its centre's).
    """
    depth, normal, arm = rib_gap(centre, axis, ring_axis, rib, rib.window, rib.end)
    slip = subtract(
        subtract(add(velocity, cross(omega, arm)), ring_velocity), cross(ring_omega, add(centre, arm))
    )
    touching = at_least(depth, 0.0)
    root = sqrt(touching)
    tangent = 1.5 * rib.stiffness * root
    push = _push(touching, dot(slip, normal), damping)
    energy = 0.4 / 1.5 * tangent * touching * touching
    elastic = tangent * touching * (1.0 / 1.5)
    tangent = where_greater(push, 0.0, tangent, 0.0 * depth)
    load = tangent * push
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    spin = dot(subtract(omega, ring_omega), normal)
    reach = spin_reach(touching, rib.drilling)
    sliding = with_spin(dot(tangential, tangential), reach, spin, rib.drilling)
    rolling = (centre, arm, normal, velocity, omega, ring_axis, ring_velocity, ring_omega, orbit_rate)
    friction, film = _rubbing(load, root, sliding, rolling, rib)
    return normal, arm, load, tangent, friction, elastic, energy, slip, reach * friction, spin, film


@inline
def _rubbing(load: Any, root: Any, sliding: Any, rolling: Any, rib: Any) -> Any:
    """Friction over slip speed and film thickness; nothing where no roller of the block is pressed."""
    if not any_positive(load):
        return 0.0 * load, 0.0 * load  # a NaN stays one
    centre, arm, normal, velocity, omega, ring_axis, ring_velocity, ring_omega, orbit_rate = rolling
    entrainment = rib_entrainment(
        centre, arm, normal, velocity, omega, ring_axis, ring_velocity, ring_omega, orbit_rate, rib.film
    )
    log2_film = rib_log2_film(load, entrainment, rib.film)
    friction = rib_friction(load, root, sliding, log2_film, rib, rib.film)
    return friction, rib_film_output(load, log2_film, rib.film)


@inline
def _push(depth: Any, rate: Any, damping: Any) -> Any:
    if damping is None:
        return depth * (1.0 / 1.5)
    return depth * (1.0 / 1.5) + damping.time_constant * rate
