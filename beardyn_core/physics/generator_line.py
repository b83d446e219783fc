"""Contact line of a tapered roller on a conical raceway, and what acts along it.

The contact points of all laminae of a rigid tapered roller lie on one *generator line*. In the ring's
frame the approach is a cubic along it and the slip is affine, so geometry is worked out once per roller
and raceway, and a lamina costs only its force law. Sums over the laminae are weighted by powers of the
abscissa; from them force, moment and tangent matrix follow.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.lanes.lane_math import sqrt
from beardyn_core.physics.lanes.vectors import (
    Twist,
    Vector,
    Wrench,
    add,
    add_scaled,
    cross,
    dot,
    scale,
    subtract,
)


class Line(NamedTuple):
    """Contact line; abscissa x from the centre of mass towards the large end, [m]."""

    arm: Vector  # contact point from the centre of mass at x = 0 [m]
    arm_slope: Vector  # its change per abscissa
    normal: Vector  # into the ring, at x = 0
    around: Vector  # circumferential
    along: Vector  # of the generator
    approach: Any  # 4 factors of the penetration a0 + x (a1 + x (a2 + x a3)) [m]
    bend: Any  # turn of the normal towards `around` per abscissa [1/m]
    curve: Any  # `Curve`, which only barrels use


class Curve(NamedTuple):
    """What the line of a barrel has besides: the normal turns along it, and it is an arc."""

    moment: Vector  # of a unit of the normal force at x = 0 about the centre of mass [m]
    turn: Vector  # change of the normal per abscissa [1/m]
    moment_slope: Vector  # of that moment [-]
    sag: Vector  # of the contact point per squared abscissa [1/m]


class Slip(NamedTuple):
    """Velocity of the roller against the ring along the line: value at x = 0 and slope, [m/s], [1/s]."""

    rate: Any  # of approach
    around: Any
    along: Any
    sag: Any  # of `around` per squared abscissa, which only barrels use [1/(m s)]


@inline
def generator_line(centre, axis, ring_axis, oversize, raceway, roller):
    """Work out the contact generator of a tapered roller on a conical raceway: a `Line`.

    Two passes of the closed form: the contact point of a disc on a cone is taken where the normal points,
    first at the disc centre, then at the point so found. At the centre of mass the gap is good to
    0.001 nm at 1 degree of skew; along the line to 0.05 nm at 2 mrad and 4 nm at 1 degree. The second pass
    is for the direction of the force, which must do no work on the spin.
    """
    from_apex = add_scaled(centre, -roller.apex, ring_axis)
    outward, centre_distance = _radial_direction(from_apex, ring_axis)
    radius = oversize + roller.radius
    edge = _edge_towards(outward, axis, ring_axis, raceway)
    outward = _radial_direction(add_scaled(from_apex, radius, edge), ring_axis)[0]
    edge = _edge_towards(outward, axis, ring_axis, raceway)
    arm = scale(radius, edge)
    point = add(from_apex, arm)
    outward, distance = _radial_direction(point, ring_axis)
    around = cross(ring_axis, outward)

    # Along a skewed axis the contact walks around the roller with the azimuth of the disc centre; without
    # that walk the elastic force would do work on the spin.
    skew = dot(axis, around)
    walk = skew / centre_distance
    arm_slope = add_scaled(add_scaled(axis, roller.taper, edge), raceway.side * radius * walk, around)
    slope_out = dot(arm_slope, outward)
    slope_along = dot(arm_slope, ring_axis)
    side_cosine = raceway.side * raceway.cosine
    side_sine = raceway.side * raceway.sine
    bend = side_cosine * dot(arm_slope, around) / distance
    approach = (
        side_cosine * distance - side_sine * dot(point, ring_axis) - raceway.gap,
        side_cosine * slope_out - side_sine * slope_along,
        0.5 * side_cosine * walk * skew,
        -0.5 * side_cosine * walk * skew * dot(axis, outward) / centre_distance,
    )
    normal = add_scaled(scale(side_cosine, outward), -side_sine, ring_axis)
    along = add_scaled(scale(raceway.sine, outward), raceway.cosine, ring_axis)
    return Line(arm, arm_slope, normal, around, along, approach, bend, no_curve(0.0 * distance))


@inline
def no_curve(zero):
    """Make the `Curve` of a straight line, which nothing uses."""
    nothing = (zero, zero, zero)
    return Curve(nothing, nothing, nothing, nothing)


@inline
def with_approach(line, approach):
    """Give a line with other factors of its approach."""
    arm, slope = line.arm, line.arm_slope
    return Line(arm, slope, line.normal, line.around, line.along, approach, line.bend, line.curve)


@inline
def _edge_towards(outward, axis, ring_axis, raceway):
    """Take the radial direction of the roller that points along the raceway's normal at an azimuth."""
    normal = scale(raceway.side, add_scaled(scale(raceway.cosine, outward), -raceway.sine, ring_axis))
    lean = dot(normal, axis)
    return scale(1.0 / sqrt(1.0 - lean * lean), add_scaled(normal, -lean, axis))


@inline
def _radial_direction(point, ring_axis):
    """Work out the unit vector from the ring axis to a point, and the distance."""
    across = add_scaled(point, -dot(point, ring_axis), ring_axis)
    distance = sqrt(dot(across, across))
    return scale(1.0 / distance, across), distance


@inline
def line_slip(line, centre, body, view, barrel):
    """Work out the velocity of the roller against the ring along the generator: a `Slip`.

    ``barrel``: `BarrelParams`, or ``None`` along a straight line.
    """
    relative_omega = subtract(body.omega, view.omega)
    at_centre = subtract(subtract(body.velocity, view.velocity), cross(view.omega, centre))
    at_middle = add(at_centre, cross(relative_omega, line.arm))
    slope = cross(relative_omega, line.arm_slope)
    around = dot(at_middle, line.around)
    if barrel is None:
        return Slip(
            (dot(at_middle, line.normal), dot(slope, line.normal) + line.bend * around),
            (around, dot(slope, line.around)),
            (dot(at_middle, line.along), dot(slope, line.along)),
            0.0 * around,
        )
    return Slip(
        normal_change(line, Twist(at_centre, relative_omega), barrel),
        (around, dot(slope, line.around)),
        (dot(at_middle, line.along), dot(slope, line.along)),
        sag_change(line, relative_omega, barrel),
    )


@inline
def affine_change(line, direction, change):
    """Work out how a twist changes the velocity along a direction on the line, affine in the abscissa."""
    at_middle = add(change.velocity, cross(change.omega, line.arm))
    return dot(at_middle, direction), dot(cross(change.omega, line.arm_slope), direction)


@inline
def normal_change(line, change, barrel):
    """Work out how a twist changes the rate of approach along the line, affine in the abscissa."""
    if barrel is None:
        return affine_change(line, line.normal, change)
    curve = line.curve
    return (
        dot(change.velocity, line.normal) + dot(change.omega, curve.moment),
        dot(change.velocity, curve.turn) + dot(change.omega, curve.moment_slope),
    )


@inline
def sag_change(line, omega, barrel):
    """Work out what an angular velocity adds to the slip along a barrel with x^2, [1/(m s)]."""
    if barrel is None:
        return 0.0 * omega[0]
    return dot(cross(omega, line.curve.sag), line.around)


@inline
def add_change(affine, change, part):
    """Add a part of a change to a function that is affine in the abscissa."""
    return affine[0] + part * change[0], affine[1] + part * change[1]


@inline
def weigh_affine(weights, affine):
    """Sum ``w (a0 + a1 x)`` and ``w (a0 + a1 x) x`` over the laminae from the moments of w."""
    return (weights[0] * affine[0] + weights[1] * affine[1], weights[1] * affine[0] + weights[2] * affine[1])


@inline
def power(weights, a, b):
    """Sum ``w (a0 + a1 x)(b0 + b1 x)`` over the laminae from the moments of w."""
    sums = weigh_affine(weights, a)
    return sums[0] * b[0] + sums[1] * b[1]


@inline
def weigh_around(weights, affine, sag, barrel):
    """Sum the friction around the ring with x^0 and x^1, along a barrel with x^2, too; see `weigh_affine`.

    ``weights``: the friction over slip with x^0 to x^4, of which straight lines use three.
    """
    if barrel is None:
        sums = weigh_affine(weights, affine)
        return sums[0], sums[1], 0.0 * sums[1]
    a, b = affine
    return (
        weights[0] * a + weights[1] * b + weights[2] * sag,
        weights[1] * a + weights[2] * b + weights[3] * sag,
        weights[2] * a + weights[3] * b + weights[4] * sag,
    )


@inline
def power_around(weights, first, other, sags, barrel):
    """Sum the products of two slips around the ring; ``sags`` (2 numbers): of both with x^2."""
    if barrel is None:
        return power(weights, first, other)
    sums = weigh_around(weights, first, sags[0], barrel)
    return sums[0] * other[0] + sums[1] * other[1] + sums[2] * sags[1]


@inline
def line_wrench(line, normal_force, around_force, along_force, barrel):
    """Add up the force on the roller and its moment about the centre of mass: a `Wrench`.

    ``normal_force`` (3 numbers): sums of the normal force with x^0, x^1, x^2, pressing positive [N m^k];
    ``around_force`` (3 numbers), ``along_force`` (2 numbers): sums of the friction against the slip with x^0,
    x^1 and x^2, the last of which only barrels use [N m^k].
    """
    if barrel is not None:
        return _barrel_wrench(line, normal_force, around_force, along_force)
    around_0 = around_force[0] + line.bend * normal_force[1]
    around_1 = around_force[1] + line.bend * normal_force[2]
    force = _combine(line, normal_force[0], around_0, along_force[0])
    leverage = _combine(line, normal_force[1], around_1, along_force[1])
    return Wrench(force, add(cross(line.arm, force), cross(line.arm_slope, leverage)))


@inline
def _barrel_wrench(line, normal_force, around_force, along_force):
    """Add up the `Wrench` of a barrel: its normal turns, and what is around acts on an arc."""
    curve = line.curve
    pressed = add_scaled(scale(-normal_force[0], line.normal), -normal_force[1], curve.turn)
    turned = add_scaled(scale(-normal_force[0], curve.moment), -normal_force[1], curve.moment_slope)
    rubbed = add_scaled(scale(-around_force[0], line.around), -along_force[0], line.along)
    slope = add_scaled(scale(-around_force[1], line.around), -along_force[1], line.along)
    moment = add(cross(line.arm, rubbed), cross(line.arm_slope, slope))
    moment = add(moment, cross(curve.sag, scale(-around_force[2], line.around)))
    return Wrench(add(pressed, rubbed), add(turned, moment))


@inline
def _combine(line, normal_part, around_part, along_part):
    pressed = scale(-normal_part, line.normal)
    return add_scaled(add_scaled(pressed, -around_part, line.around), -along_part, line.along)
