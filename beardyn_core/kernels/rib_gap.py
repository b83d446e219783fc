"""Where the large roller end meets the rib: sphere, rib face with its edges, rim of the roller end.

The rib face is a cone between two circles: the undercut below and the rib's outer corner above. The nearest
point of that face from the sphere's centre has its coordinate along the generator clamped to the face, so the
distance is exact and its gradient continuous from the face over the edge: the force is conservative. The
roller end is a sphere only inside its rim; beyond it the deepest point of the rim circle carries.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, magnitude, sqrt, where_greater
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract

_LARGEST_TURN = 0.4
# Keeps the direction of a sphere centred on the ring axis finite; far below any distance that occurs.
_AXIS_FLOOR = 1e-30


@inline
def rib_gap(centre: Any, axis: Any, ring_axis: Any, rib: Any, window: Any, end: Any) -> Any:
    """Penetration, normal and place of the rib contact.

    Parameters
    ----------
    centre : vector
        Centre of mass of the roller from the cone's origin, [m].
    axis, ring_axis : vector
    rib : RibParams
    window : RibWindowParams or None
        Edges of the rib face; without it the face is an unlimited cone.
    end : RibEndParams or None
        Rim of the roller end; without it the end is a whole sphere.

    Returns
    -------
    depth : lane value
        [m].
    normal, arm : vector
        Unit normal into the rib; contact from the roller's centre of mass, [m].
    """
    sphere = scale(rib.sphere_place, axis)
    place = add(centre, sphere)
    along = dot(place, ring_axis)
    across = add_scaled(place, -along, ring_axis)
    distance = sqrt(dot(across, across) + _AXIS_FLOOR)
    outward = scale(1.0 / distance, across)
    depth = along * rib.normal_axial + distance * rib.normal_radial + rib.sphere_radius - rib.distance
    depth, normal_axial, normal_radial = _on_the_face(depth, along, distance, rib, window)
    normal = add_scaled(scale(normal_axial, ring_axis), normal_radial, outward)
    arm = add_scaled(sphere, rib.sphere_radius, normal)
    return _within_the_rim(depth, normal, arm, centre, axis, ring_axis, rib, end)


@inline
def _on_the_face(depth: Any, along: Any, distance: Any, rib: Any, window: Any) -> Any:
    """Depth and normal with the nearest point kept on the face; a rounded edge is a torus."""
    if window is None:
        return depth, rib.normal_axial, rib.normal_radial
    height = distance * rib.normal_axial - along * rib.normal_radial
    beyond = height - at_most(at_least(height, window.low), window.high)
    if not any_positive(magnitude(beyond)):
        still = 0.0 * depth  # a NaN stays one
        return depth, rib.normal_axial + still, rib.normal_radial + still
    ahead = rib.sphere_radius + window.rounding - depth
    reach = sqrt(ahead * ahead + beyond * beyond)
    # reach - ahead, without the difference of two nearly equal lengths
    depth = depth - beyond * beyond / (reach + ahead)
    cosine, sine = ahead / reach, beyond / reach
    normal_axial = cosine * rib.normal_axial + sine * rib.normal_radial
    normal_radial = cosine * rib.normal_radial - sine * rib.normal_axial
    return depth, normal_axial, normal_radial


@inline
def _within_the_rim(
    depth: Any, normal: Any, arm: Any, centre: Any, axis: Any, ring_axis: Any, rib: Any, end: Any
) -> Any:
    """The contact, or where it lies beyond the rim of the roller end that of the rim circle."""
    if end is None:
        return depth, normal, arm
    along = dot(normal, axis)
    if not any_positive(end.cosine - along):
        return depth, normal, arm
    radial = add_scaled(normal, -along, axis)
    radial = scale(1.0 / sqrt(dot(radial, radial) + _AXIS_FLOOR), radial)
    middle = add_scaled(centre, end.place, axis)
    for _ in range(3):
        radial = _deeper(radial, middle, axis, ring_axis, rib, end)
    rim = scale(end.radius, radial)
    point = add(middle, rim)
    height = dot(point, ring_axis)
    across = add_scaled(point, -height, ring_axis)
    distance = sqrt(dot(across, across))
    rim_depth = height * rib.normal_axial + distance * rib.normal_radial - rib.distance
    rim_normal = add_scaled(scale(rib.normal_axial, ring_axis), rib.normal_radial / distance, across)
    rim_arm = subtract(point, centre)
    return (
        where_greater(end.cosine, along, rim_depth, depth),
        _choose(end.cosine, along, rim_normal, normal),
        _choose(end.cosine, along, rim_arm, arm),
    )


@inline
def _deeper(radial: Any, middle: Any, axis: Any, ring_axis: Any, rib: Any, end: Any) -> Any:
    """One safeguarded Newton step along the rim towards its deepest point behind the cone."""
    ahead = cross(axis, radial)
    point = add_scaled(middle, end.radius, radial)
    across = add_scaled(point, -dot(point, ring_axis), ring_axis)
    curvature = 1.0 / sqrt(dot(across, across))
    outward = scale(curvature, across)
    slope = rib.normal_axial * dot(ahead, ring_axis) + rib.normal_radial * dot(ahead, outward)
    lean = rib.normal_axial * dot(radial, ring_axis) + rib.normal_radial * dot(radial, outward)
    sideways = 1.0 - dot(ahead, ring_axis) * dot(ahead, ring_axis) - dot(ahead, outward) * dot(ahead, outward)
    bend = lean - rib.normal_radial * end.radius * curvature * sideways
    turn = at_most(at_least(slope / at_least(bend, end.smallest_bend), -_LARGEST_TURN), _LARGEST_TURN)
    return scale(1.0 / sqrt(1.0 + turn * turn), add_scaled(radial, turn, ahead))


@inline
def _choose(a: Any, b: Any, first: Any, second: Any) -> Any:
    """Vector ``first`` where ``a > b``, else ``second``."""
    return (
        where_greater(a, b, first[0], second[0]),
        where_greater(a, b, first[1], second[1]),
        where_greater(a, b, first[2], second[2]),
    )
