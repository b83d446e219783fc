"""Contact line of a barrel on the spherical cup or on a groove of the cone.

The generator of a barrel is an arc about a point P that goes around the roller's axis. So is that of a ring:
about the middle of the sphere, or about a point G that goes around the cone's axis, in the meridian plane
where the barrel touches. Both arcs are nearest on the line through P and G. That gives the approach of the
ellipse's middle and its place on the roller; a slice at x from there is less deep by (x/A)^2, A being the
long semi-axis of Hertz's ellipse over the root of the approach. Whatever the cup turns about its middle, no
gap changes.

Forces are the gradient of the energy of the slices over the place of roller and ring, to first order in the
skew. Neglected is what a skewed barrel lifts off at its ends: at 10 mrad half a percent of the curvature
that is left between both arcs.
"""

from __future__ import annotations

from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.bearing.contact_law import barrel_ellipse
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.physics.generator_line import Curve, Line
from beardyn_core.physics.lanes.lane_math import at_least, sqrt
from beardyn_core.physics.lanes.vectors import add, add_scaled, cross, dot, scale
from beardyn_core.physics.slice_law import EllipseParams

# arcs whose centres are this close have no line through them; they are far out of contact there [m]
_CONCENTRIC = 1.0e-9


class GrooveParams(NamedTuple):
    """Circle on which the centre of a groove's arc goes around the cone, from the bearing centre."""

    radius: float  # [m]
    axial: float  # outwards [m]


class BarrelParams(NamedTuple):
    """Arcs of a barrel and of one ring."""

    profile: float  # radius of the barrel's arc [m]
    lever: float  # of its centre beyond the roller's axis [m]
    excess: float  # radius of the barrel's arc less that of the ring's [m]
    sharpness: float  # loss of depth per squared distance from the ellipse's middle, 1/A^2 [1/m]
    sag: float  # half the curvature of the contact line [1/m]
    groove: GrooveParams | None  # ``None``: the sphere of the cup
    ellipse: EllipseParams


def barrel_params(bearing: RollerBearing, ring: str, laminae: int) -> BarrelParams | None:
    """Describe the contact of barrels with ``cup`` or ``cone``; ``None`` for other rollers."""
    if not isinstance(bearing, SphericalBearing):
        return None
    law, profile, half = (
        barrel_ellipse(bearing, ring),
        bearing.roller_profile_radius,
        0.5 * bearing.roller_diameter,
    )
    on_cup = ring == "cup"
    raceway = bearing.sphere_radius if on_cup else bearing.cone_profile_radius
    radius, axial = bearing.cone_groove
    return BarrelParams(
        profile=profile,
        lever=profile - half,
        excess=profile - raceway,
        sharpness=law.reach**-2,
        sag=0.25 * (1.0 / profile + 1.0 / raceway),
        groove=None if on_cup else GrooveParams(radius, axial),
        ellipse=EllipseParams(law.stiffness * bearing.effective_length / laminae),
    )


@inline
def barrel_line(centre, axis, ring_axis, oversize, side, barrel):
    """Work out the contact line of a barrel: a `Line` with its `Curve`.

    ``centre``: of the barrel from the ring's origin [m]; ``oversize``: of its radius [m]; ``side``: +1 of the
    cup, -1 of the cone.
    """
    apart = _from_arc(centre, axis, ring_axis, barrel.lever, barrel.groove)
    place = dot(apart, axis)
    across = add_scaled(apart, -place, axis)
    height = sqrt(dot(across, across))
    facing = scale(1.0 / height, across)
    clear = height - barrel.lever
    distance = at_least(sqrt(place * place + clear * clear), _CONCENTRIC)
    inverse = 1.0 / distance
    lean, cosine = place * inverse, clear * inverse
    normal = add_scaled(scale(cosine, facing), lean, axis)
    middle = barrel.profile * lean
    level = cross(axis, facing)

    # changes of approach and of the middle's place with a motion of the roller: force, and moment along level
    follow = barrel.profile * inverse
    tangent = add_scaled(axis, -lean, normal)
    moment, middle_moment = barrel.lever * lean, follow * (height - lean * lean * barrel.lever)
    steep = 2.0 * barrel.sharpness
    turn = scale(steep * follow, tangent)
    moment_slope = steep * middle_moment
    depth = distance + barrel.excess + oversize
    sharp = barrel.sharpness + 0.0 * depth
    approach = (depth - sharp * middle * middle, 2.0 * sharp * middle, -sharp, 0.0 * depth)
    at_start = add_scaled(normal, -middle, turn)
    at_moment, slope_moment = scale(moment - middle * moment_slope, level), scale(moment_slope, level)
    at_start = _without_torque(at_start, at_moment, centre, ring_axis, barrel.groove)
    turn = _without_torque(turn, slope_moment, centre, ring_axis, barrel.groove)

    # contact points: an arc through the middle, whose abscissa counts along the axis
    sag = scale(-barrel.sag, normal)
    slope = scale(1.0 / (cosine * cosine), tangent)
    touch = add_scaled(scale(barrel.profile, normal), -barrel.lever, facing)
    arm = add_scaled(add_scaled(touch, -middle, slope), middle * middle, sag)
    arm_slope = add_scaled(slope, -2.0 * middle, sag)
    along = scale(1.0 / cosine, tangent)
    around = scale(side, cross(along, normal))
    curve = Curve(at_moment, turn, slope_moment, sag)
    return Line(arm, arm_slope, at_start, around, along, approach, 0.0 * depth, curve)


@inline
def _without_torque(force, moment, centre, ring_axis, groove):
    """Turn the normal of a skewed barrel so far that it has no torque about the axis of the cone.

    Along a skewed barrel the contact walks around the cone; without that walk the elastic force would do work
    on the spin. The sphere has no walk.
    """
    if groove is None:
        return force
    around = cross(ring_axis, centre)
    torque = dot(force, around) + dot(moment, ring_axis)
    return add_scaled(force, -torque / dot(around, around), around)


@inline
def _from_arc(centre, axis, ring_axis, lever, groove):
    """Take the barrel's centre from the centre of the ring's arc that it faces, [m].

    A skewed barrel touches where a point on its axis lies, as far from its centre as the middle of its
    ellipse less what its radius leans: from there the centres of both arcs lie in the same plane.
    """
    if groove is None:
        return centre
    first = _to_groove(centre, centre, ring_axis, groove)
    place = dot(first, axis)
    across = add_scaled(first, -place, axis)
    clear = sqrt(dot(across, across)) - lever
    lean = place / at_least(sqrt(place * place + clear * clear), _CONCENTRIC)
    return _to_groove(centre, add_scaled(centre, lever * lean, axis), ring_axis, groove)


@inline
def _to_groove(centre, towards, ring_axis, groove):
    out = add_scaled(towards, -dot(towards, ring_axis), ring_axis)
    middle = add(scale(groove.radius / sqrt(dot(out, out)), out), scale(groove.axial, ring_axis))
    return add_scaled(centre, -1.0, middle)
