"""Contact of a laminated roller with a conical raceway.

The contact points of all laminae of a rigid tapered roller lie on one *generator line*. In the ring's
frame the approach is a cubic along it and the slip is affine, so geometry is worked out once per roller
and raceway, and a lamina costs only its force law. What leaves the lamina loop are sums weighted by powers
of the abscissa, from which force, moment and tangent matrix follow.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.defect import find_damage, spring_count, spring_table
from beardyn_core.kernels.film import log2_film_thickness, log2_load
from beardyn_core.kernels.lamina_spring import (
    SMALLEST_APPROACH,
    add_lean,
    contact_spring,
    deepest_so_far,
    let_go,
    prepare_coupling,
    share_of,
    spring_push,
)
from beardyn_core.kernels.lane_math import at_least, magnitude, sqrt, where_greater
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.stage_timer import mark_result
from beardyn_core.kernels.traction import friction_rate
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, scale, subtract
from beardyn_core.model.contact_parameters import LAMINA_PLACE
from beardyn_core.model.stages import CONTACT, FILM, TRACTION

_LOADS = 0  # the work space has one page


@inline
def generator_line(centre: Any, axis: Any, ring_axis: Any, oversize: Any, raceway: Any, roller: Any) -> Any:
    """Contact generator of a tapered roller on a conical raceway.

    Parameters
    ----------
    centre : vector
        Centre of mass of the roller from the ring's origin, [m].
    axis, ring_axis : vector
        Unit axes of roller and ring, towards the large end.
    oversize : lane value
        Radius error of the roller, [m].
    raceway : RacewayParams
    roller : RollerParams

    Returns
    -------
    arm, arm_slope : vector
        Contact point from the centre of mass at abscissa x: ``arm + x arm_slope``, [m].
    normal, around, along : vector
        Unit normal into the ring, circumferential and generator direction at x = 0.
    approach : tuple of 4 lane values
        Penetration at abscissa x: ``a0 + x (a1 + x (a2 + x a3))``, [m].
    bend : lane value
        Turn of the normal towards `around` per abscissa, [1/m].

    Notes
    -----
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
    return arm, arm_slope, normal, around, along, approach, bend


@inline
def _edge_towards(outward: Any, axis: Any, ring_axis: Any, raceway: Any) -> Any:
    """Radial direction of the roller that points along the raceway's normal at an azimuth."""
    normal = scale(raceway.side, add_scaled(scale(raceway.cosine, outward), -raceway.sine, ring_axis))
    lean = dot(normal, axis)
    return scale(1.0 / sqrt(1.0 - lean * lean), add_scaled(normal, -lean, axis))


@inline
def _radial_direction(point: Any, ring_axis: Any) -> Any:
    """Unit vector from the ring axis to a point, and the distance."""
    across = add_scaled(point, -dot(point, ring_axis), ring_axis)
    distance = sqrt(dot(across, across))
    return scale(1.0 / distance, across), distance


@inline
def sliding(line: Any, centre: Any, velocity: Any, omega: Any, ring_velocity: Any, ring_omega: Any) -> Any:
    """Velocity of the roller against the ring along the generator, affine in the abscissa.

    Returns
    -------
    approach_rate, slip_around, slip_along : tuples of 2 lane values
        Value at x = 0 and slope, [m/s] and [1/s].
    """
    arm, arm_slope, normal, around, along, _approach, bend = line
    relative_omega = subtract(omega, ring_omega)
    at_centre = subtract(subtract(velocity, ring_velocity), cross(ring_omega, centre))
    at_middle = add(at_centre, cross(relative_omega, arm))
    slope = cross(relative_omega, arm_slope)
    around_0 = dot(at_middle, around)
    return (
        (dot(at_middle, normal), dot(slope, normal) + bend * around_0),
        (around_0, dot(slope, around)),
        (dot(at_middle, along), dot(slope, along)),
    )


@inline
def lamina_sums(
    lanes: Any,
    block: Any,
    line: Any,
    slip: Any,
    log2_speed: Any,
    azimuths: Any,
    ring: Any,
    laminae: Any,
    patches: Any,
    work: Any,
    reach: Any,
    effects: Any,
) -> Any:
    """Sums over the laminae of one raceway contact.

    Parameters
    ----------
    work : float64 array, shape [1, 2 x lamina, lane]
        Work space for the loads of the springs, [N].
    reach : float
        No lamina is farther from the centre of mass, [m].

    Returns
    -------
    tuple of 14 lane values and a bool
        Elastic force with x^0, x^1, x^2; tangent stiffness likewise; friction over slip likewise;
        elastic energy; elastic force times the slope of the gap over the azimuth in ring and roller;
        whether any roller of the block may touch; power that the dampers take where the contact opens
        faster than its springs follow, [W]; largest penetration, [m]. Where no roller may touch, all sums
        are exactly zero.

    References
    ----------
    Palmgren's line contact, Q = 0.356 E' L^(8/9) delta^(10/9) for one contact, shared evenly by laminae.
    """
    surface, roller_surface, damage = patches
    near = find_damage(lanes, block, azimuths, laminae.shape[1], (surface, roller_surface), damage)
    return _sums_near_or_far(lanes, near, line, slip, log2_speed, ring, laminae, damage, work, reach, effects)


@inline
def _sums_near_or_far(
    lanes: Any,
    near: Any,
    line: Any,
    slip: Any,
    log2_speed: Any,
    ring: Any,
    laminae: Any,
    damage: Any,
    work: Any,
    reach: Any,
    effects: Any,
) -> Any:
    """Far from every patch a damaged contact is a sound one and costs no more."""
    if damage is None:
        return _sums_of_sound(lanes, line, slip, log2_speed, ring, laminae, work, reach, effects)
    if near:
        return spring_sums(lanes, line, slip, log2_speed, ring, laminae, damage, work, effects)
    return _sums_of_sound(lanes, line, slip, log2_speed, ring, laminae, work, reach, effects)


@inline
def _sums_of_sound(
    lanes: Any,
    line: Any,
    slip: Any,
    log2_speed: Any,
    ring: Any,
    laminae: Any,
    work: Any,
    reach: Any,
    effects: Any,
) -> Any:
    """Sums of a sound contact: a block of rollers of which none touches costs one bound."""
    if may_touch(lanes, line[5], reach):
        return spring_sums(lanes, line, slip, log2_speed, ring, laminae, None, work, effects)
    zero = lanes.constant(0.0)
    nothing = (zero, zero, zero)
    return nothing, nothing, nothing, zero, (zero, zero), False, zero, line[5][0]


@inline
def may_touch(lanes: Any, approach: Any, reach: Any) -> Any:
    """Whether the approach of any lane may be positive within a reach of the middle; a NaN may be, too."""
    slope = magnitude(approach[1]) + reach * (magnitude(approach[2]) + reach * magnitude(approach[3]))
    zero = lanes.constant(0.0)
    return any_positive(where_greater(zero, approach[0] + reach * slope, zero, 1.0))


@inline
def spring_sums(
    lanes: Any,
    line: Any,
    slip: Any,
    log2_speed: Any,
    ring: Any,
    laminae: Any,
    damage: Any,
    work: Any,
    effects: Any,
) -> Any:
    """Sums of `lamina_sums` over the springs; two passes, as short loops keep several laminae in flight."""
    approach = line[5]
    rate, slip_around, slip_along = slip
    zero = lanes.constant(0.0)
    force_0, force_1, force_2 = zero, zero, zero
    stiffness_0, stiffness_1, stiffness_2 = zero, zero, zero
    friction_0, friction_1, friction_2 = zero, zero, zero
    energy = zero
    lean = (zero, zero)
    released = zero
    deepest = approach[0] if damage is None else zero
    count = laminae.shape[1]
    prepare_coupling(lanes, approach, laminae, damage, effects.coupling)
    springs = spring_count(laminae, damage, effects.coupling)
    laminae = spring_table(laminae, damage)
    for k in range(springs):
        x = laminae[LAMINA_PLACE, k]
        share, depth, tangent, stored = contact_spring(lanes, approach, k, laminae, damage, effects.coupling)
        touching = at_least(depth, SMALLEST_APPROACH)
        energy = energy + stored
        opening = rate[0] + x * rate[1]
        push = spring_push(touching, opening, effects.damping)
        whole = share * (0.9 * tangent * touching)
        lean = add_lean(lanes, lean, whole, k, count, damage, effects.coupling)
        tangent = where_greater(push, 0.0, tangent, 0.0 * depth)
        elastic = 0.9 * tangent * touching
        lanes.store(work, _LOADS, k, tangent * push)
        elastic, tangent = share * elastic, share * tangent
        released = let_go(released, whole, elastic, opening, effects.damping, effects.audit)
        deepest = deepest_so_far(deepest, share, depth, damage)
        force_0 = force_0 + elastic
        force_1 = force_1 + elastic * x
        force_2 = force_2 + elastic * (x * x)
        stiffness_0 = stiffness_0 + tangent
        stiffness_1 = stiffness_1 + tangent * x
        stiffness_2 = stiffness_2 + tangent * (x * x)
    for k in range(springs):
        x = laminae[LAMINA_PLACE, k]
        load = lanes.load(work, _LOADS, k)
        around = slip_around[0] + x * slip_around[1]
        along = slip_along[0] + x * slip_along[1]
        square = around * around + along * along
        mark_result(effects.timers, CONTACT, square)
        log2_force = log2_load(load)
        log2_film = log2_film_thickness(log2_force, log2_speed, k, ring, laminae, effects.film)
        mark_result(effects.timers, FILM, log2_film)
        friction = friction_rate(load, log2_force, square, log2_film, log2_speed, k, ring, laminae, effects)
        mark_result(effects.timers, TRACTION, friction)
        friction = share_of(lanes, k, damage, effects.coupling) * friction
        friction_0 = friction_0 + friction
        friction_1 = friction_1 + friction * x
        friction_2 = friction_2 + friction * (x * x)
    return (
        (force_0, force_1, force_2),
        (stiffness_0, stiffness_1, stiffness_2),
        (friction_0, friction_1, friction_2),
        energy,
        lean,
        True,
        released,
        deepest,
    )


@inline
def weighted(weights: Any, affine: Any) -> Any:
    """Sums of ``w (a0 + a1 x)`` and of ``w (a0 + a1 x) x`` from the moments of w."""
    return (
        weights[0] * affine[0] + weights[1] * affine[1],
        weights[1] * affine[0] + weights[2] * affine[1],
    )


@inline
def power(weights: Any, a: Any, b: Any) -> Any:
    """Sum of ``w (a0 + a1 x)(b0 + b1 x)``."""
    sums = weighted(weights, a)
    return sums[0] * b[0] + sums[1] * b[1]


@inline
def line_wrench(line: Any, normal_force: Any, around_force: Any, along_force: Any) -> Any:
    """Force and moment about the centre of mass on the roller, [N, N m].

    Parameters
    ----------
    line : tuple
        From `generator_line`.
    normal_force : tuple of 3 lane values
        Sums of the normal force with x^0, x^1, x^2, pressing positive.
    around_force, along_force : tuple of 2 lane values
        Sums of the friction against the slip with x^0, x^1.
    """
    arm, arm_slope, bend = line[0], line[1], line[6]
    around_0 = around_force[0] + bend * normal_force[1]
    around_1 = around_force[1] + bend * normal_force[2]
    force = _combine(line, normal_force[0], around_0, along_force[0])
    leverage = _combine(line, normal_force[1], around_1, along_force[1])
    return force, add(cross(arm, force), cross(arm_slope, leverage))


@inline
def _combine(line: Any, normal_part: Any, around_part: Any, along_part: Any) -> Any:
    pressed = scale(-normal_part, line[2])
    return add_scaled(add_scaled(pressed, -around_part, line[3]), -along_part, line[4])
