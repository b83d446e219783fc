"""Contact of the spherical large roller end with the conical cone rib."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, sqrt, where_greater
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract


@inline
def rib_contact(
    centre: Any,
    axis: Any,
    velocity: Any,
    omega: Any,
    ring_axis: Any,
    ring_velocity: Any,
    ring_omega: Any,
    rib: Any,
    damping: Any,
) -> Any:
    """Force of the rib on the roller: sphere on cone, closed form.

    Adds the axial guidance of the rollers. Neglects the rib's edges (no window), lubrication, and the
    drilling friction inside the contact ellipse; valid while the contact lies on the rib.

    Parameters
    ----------
    centre : vector
        Centre of mass of the roller from the cone's origin, [m].
    axis, velocity, omega : vector
        Of the roller.
    ring_axis, ring_velocity, ring_omega : vector
        Of the cone at its origin.
    rib : RibParams
    damping : DampingParams or None

    Returns
    -------
    normal, arm : vector
        Unit normal into the rib; contact from the roller's centre of mass, [m].
    load, tangent, friction : lane value
        Normal force [N], tangent stiffness [N/m], friction over slip speed [N s/m].
    elastic, energy : lane value
        Elastic part of the force [N] and elastic energy [J].
    slip : vector
        Velocity of the roller against the rib, [m/s].

    References
    ----------
    Hertz (1881) with the stiffness of Hamrock and Brewe (1983); the gap is exact (a sphere's distance
    to a cone is its centre's).
    """
    sphere = scale(rib.sphere_place, axis)
    place = add(centre, sphere)
    along = dot(place, ring_axis)
    across = add_scaled(place, -along, ring_axis)
    distance = sqrt(dot(across, across))
    outward = scale(1.0 / distance, across)
    normal = add_scaled(scale(rib.normal_axial, ring_axis), rib.normal_radial, outward)
    depth = along * rib.normal_axial + distance * rib.normal_radial + rib.sphere_radius - rib.distance
    arm = add_scaled(sphere, rib.sphere_radius, normal)
    slip = subtract(
        subtract(add(velocity, cross(omega, arm)), ring_velocity), cross(ring_omega, add(centre, arm))
    )
    touching = at_least(depth, 0.0)
    tangent = 1.5 * rib.stiffness * sqrt(touching)
    push = _push(touching, dot(slip, normal), damping)
    energy = 0.4 / 1.5 * tangent * touching * touching
    tangent = where_greater(push, 0.0, tangent, 0.0 * depth)
    load = tangent * push
    elastic = tangent * touching * (1.0 / 1.5)
    tangential = add_scaled(slip, -dot(slip, normal), normal)
    speed = sqrt(dot(tangential, tangential) + rib.regularisation * rib.regularisation)
    return normal, arm, load, tangent, rib.friction * load / speed, elastic, energy, slip


@inline
def _push(depth: Any, rate: Any, damping: Any) -> Any:
    if damping is None:
        return depth * (1.0 / 1.5)
    return depth * (1.0 / 1.5) + damping.time_constant * rate
