"""Where the large roller end is nearest to its rib: a sphere and its rim before the face of the rib."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import Rib
from beardyn_core.physics.lanes.lane_math import at_least, at_most, magnitude, sqrt, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import (
    Vector,
    add,
    add_scaled,
    choose_vector,
    cross,
    dot,
    scale,
    subtract,
)


class RibWindowParams(NamedTuple):
    """Edges of the rib face."""

    low: float  # coordinate along the generator of the face [m]
    high: float
    rounding: float  # radius of the edges [m]


class RibEndParams(NamedTuple):
    """Rim of the spherical roller end."""

    radius: float  # [m]
    place: float  # on the axis from the centre of mass [m]
    cosine: float  # of the angle under which the sphere's centre sees it
    smallest_bend: float  # floor of the second derivative in the search along the rim
    both: float | None  # whether both sides of the rim bear: the sphere is too flat for its apex distance


# Floor of the second derivative in the search along the rim, as part of the sine of the rib's polar angle.
_SMALLEST_BEND = 0.01
_LARGEST_TURN = 0.4
_RIM_STEPS = 5
# Cosine of the least turn from the meridian plane at which the search along the rim begins.
_STEEPEST_START = 0.95
# Two points of the rim are the same one up to 1 - cosine = 1/50 between them (11 degrees), and two from twice
# that on; between, the second is taken out of the rib by a part of 0.1 mm.
_BOTH_APART, _FADE = 50.0, 1e-4
# Keeps the direction of a sphere centred on the ring axis finite; far below any distance that occurs.
_AXIS_FLOOR = 1e-30


def rib_window(bearing: Bearing, nominal: float, rib: Rib) -> RibWindowParams | None:
    """Lay the edges of the face on its generator; rounding takes at most the whole face."""
    if not rib.window:
        return None
    low, high = (nominal + edge for edge in bearing.rib_face)
    rounding = min(rib.edge_radius, 0.5 * (high - low))
    return RibWindowParams(low + rounding, high - rounding, rounding)


def roller_end(bearing: Bearing) -> RibEndParams:
    """Work out the rim where the spherical face of the roller end meets the chamfer."""
    radius = bearing.large_end_radius - bearing.roller_chamfer
    ahead = math.sqrt(bearing.sphere_radius**2 - radius**2)
    return RibEndParams(
        radius=radius,
        place=bearing.sphere_centre - bearing.roller_mass_offset + ahead,
        cosine=ahead / bearing.sphere_radius,
        smallest_bend=smallest_bend(bearing.rib_polar_angle),
        both=1.0 if bearing.sphere_ratio >= 1.0 else None,
    )


def smallest_bend(polar_angle: float) -> float:
    """Work out the floor of the second derivative in the search along a rim, from the rib's polar angle."""
    return _SMALLEST_BEND * math.sin(polar_angle)


class RibPoint(NamedTuple):
    """Where the large end is nearest to the rib."""

    depth: Any  # penetration [m]
    normal: Vector  # unit, into the rib
    arm: Vector  # from the roller's centre of mass [m]


@inline
def rib_gap(centre, axis, ring_axis, rib, window, end):
    """Work out where the large end is nearest to the rib, a `RibPoint`; of two points of the rim the deeper.

    The rib face is a cone between two circles: the undercut below and the rib's outer corner above. The
    nearest point of that face from the sphere's centre has its coordinate along the generator clamped to the
    face, so the distance is exact and its gradient continuous from the face over the edge: the force is
    conservative. The roller end is a sphere only inside its rim; beyond it the rim circle carries, on the
    cone of the face without its edges.

    Parameters
    ----------
    window : RibWindowParams or None
        Edges of the rib face; without it the face is an unlimited cone.
    end : RibEndParams or None
        Rim of the roller end; without it the end is a whole sphere.
    """
    sphere = sphere_point(centre, axis, ring_axis, rib, window)
    if end is None:
        return sphere
    if not any_positive(end.cosine - dot(sphere.normal, axis)):
        return sphere
    return rim_points(sphere, centre, axis, ring_axis, rib, end)[0]


@inline
def sphere_point(centre, axis, ring_axis, rib, window):
    """Work out where the whole sphere is nearest to the face of the rib."""
    sphere = scale(rib.sphere_place, axis)
    place = add(centre, sphere)
    along = dot(place, ring_axis)
    across = add_scaled(place, -along, ring_axis)
    distance = sqrt(dot(across, across) + _AXIS_FLOOR)
    outward = scale(1.0 / distance, across)
    depth = along * rib.normal_axial + distance * rib.normal_radial + rib.sphere_radius - rib.distance
    depth, normal_axial, normal_radial = _on_the_face(depth, along, distance, rib, window)
    normal = add_scaled(scale(normal_axial, ring_axis), normal_radial, outward)
    return RibPoint(depth, normal, add_scaled(sphere, rib.sphere_radius, normal))


@inline
def _on_the_face(depth, along, distance, rib, window):
    """Keep the nearest point on the face: depth and normal; a rounded edge is a torus."""
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
def rim_points(sphere, centre, axis, ring_axis, rib, end):
    """Work out where the rim of the roller end is deepest behind the cone of the rib: two `RibPoint`.

    A sphere within the apex distance is the deeper the nearer to its one deepest point, also on the rim: only
    the deeper point bears. A larger one is flatter around the ring than the rib and bears on both sides.

    Over the turn t from the meridian plane the depth is g cos t + h sin t + q sin^2 t, q being half of what
    the cone recedes at the side of the rim: with the lean g of the rim small against it there is one deepest
    point on each side, with a large one a single point in the plane. The search begins on both sides. The
    deeper point comes first; the other is far outside the rib where it is the same one, and both where the
    sphere is inside its rim.

    Parameters
    ----------
    sphere : RibPoint
        Of the whole sphere, which stays where it is inside the rim.
    """
    middle = add_scaled(centre, end.place, axis)
    across = add_scaled(middle, -dot(middle, ring_axis), ring_axis)
    upright = add_scaled(across, -dot(across, axis), axis)
    upright = scale(1.0 / sqrt(dot(upright, upright)), upright)
    aside = cross(axis, upright)
    distance = sqrt(dot(across, across))
    lean = rib.normal_axial * dot(upright, ring_axis) + rib.normal_radial * dot(upright, across) / distance
    cosine = lean * distance / (magnitude(rib.normal_radial) * end.radius)
    cosine = at_most(at_least(cosine, -_STEEPEST_START), _STEEPEST_START)
    sine = sqrt(1.0 - cosine * cosine)
    ahead = add_scaled(scale(cosine, upright), sine, aside)
    behind = add_scaled(scale(cosine, upright), -1.0 * sine, aside)
    for _ in range(_RIM_STEPS):
        ahead = _deeper(ahead, middle, axis, ring_axis, rib, end)
        behind = _deeper(behind, middle, axis, ring_axis, rib, end)
    one = _rim_point(ahead, middle, centre, ring_axis, rib, end)
    two = _rim_point(behind, middle, centre, ring_axis, rib, end)
    deeper = _choose(two.depth, one.depth, two, one)
    other = _choose(two.depth, one.depth, one, two)
    apart = _BOTH_APART * (1.0 - dot(ahead, behind)) - 1.0
    fade = _FADE * at_most(at_least(1.0 - apart, 0.0), 1.0)
    along = dot(sphere.normal, axis)
    outside = where_greater(end.cosine, along, other.depth - fade, -_FADE + 0.0 * along)
    return _choose(end.cosine, along, deeper, sphere), RibPoint(outside, other.normal, other.arm)


@inline
def _choose(a, b, first, second):
    """Take the first point where ``a`` is greater than ``b``, else the second."""
    return RibPoint(
        where_greater(a, b, first.depth, second.depth),
        choose_vector(a, b, first.normal, second.normal),
        choose_vector(a, b, first.arm, second.arm),
    )


@inline
def _rim_point(radial, middle, centre, ring_axis, rib, end):
    """Work out the `RibPoint` of the rim in one direction from the roller's axis."""
    point = add_scaled(middle, end.radius, radial)
    height = dot(point, ring_axis)
    across = add_scaled(point, -height, ring_axis)
    distance = sqrt(dot(across, across))
    depth = height * rib.normal_axial + distance * rib.normal_radial - rib.distance
    normal = add_scaled(scale(rib.normal_axial, ring_axis), rib.normal_radial / distance, across)
    return RibPoint(depth, normal, subtract(point, centre))


@inline
def _deeper(radial, middle, axis, ring_axis, rib, end):
    """Take one safeguarded Newton step along the rim towards its deepest point behind the cone."""
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
