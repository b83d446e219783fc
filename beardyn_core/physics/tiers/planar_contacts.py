"""Contacts of a roller without skew in the quasistatic tier: springs in its meridian plane.

The roller moves radially, axially and in tilt, which is positive when the large end moves outwards.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.lanes.lane_math import at_least, at_most, sqrt
from beardyn_core.physics.lanes.vectors import add, add_scaled, cross, dot, scale, subtract


@inline
def cup_line(place, axis, radius, cup, roller):
    """Work out the contact line on the cup of a roller without skew: exact and affine in the abscissa.

    ``radius``: of the roller at its centre of mass [m]. Returns ``approach`` (2 numbers): affine in the
    abscissa [m]; ``by_tilt`` (2 numbers): change of the approach with tilt, affine in the abscissa [m/rad];
    ``lever`` (2 numbers): arm of the contact normal about the bearing centre, affine in the abscissa [m].
    """
    sine, cosine = axis[0], axis[1]
    radial, axial = place[0] + radius * cosine, place[1] - radius * sine
    along_r, along_a = sine + roller.taper * cosine, cosine - roller.taper * sine
    approach = (
        cup.cosine * radial - cup.sine * (axial - roller.apex) - cup.gap,
        cup.cosine * along_r - cup.sine * along_a,
    )
    across = cup.cosine * cosine + cup.sine * sine
    along = cup.cosine * sine - cup.sine * cosine
    by_tilt = (-radius * along, across - roller.taper * along)
    lever = (axial * cup.cosine + radial * cup.sine, along_a * cup.cosine + along_r * cup.sine)
    return approach, by_tilt, lever


@inline
def short_direction(across):
    """Work out the unit vector of a vector that is nearly radial, and one over its length.

    A series in the squared lean q from the radial direction; the error is 0.3 q^3, below 1e-12 for
    displacements of a hundredth of the radius.
    """
    inverse = 1.0 / across[0]
    lean = (across[1] * across[1] + across[2] * across[2]) * (inverse * inverse)
    inverse = inverse * (1.0 - lean * (0.5 - lean * 0.375))
    return scale(inverse, across), inverse


@inline
def cone_line(centre, axis, ring_axis, radius, raceway, roller):
    """Work out the contact line on the cone: see `generator_line`, for a roller without skew of its own.

    One pass of the closed form, and series in place of roots: the direction of the force is good to first
    order in the displacement of the cone, the gap to second order, 0.1 nm at 0.1 mm.

    Returns ``arm``, ``arm_slope``, ``normal``; ``approach`` (4 numbers): as from `generator_line`.
    """
    from_apex = add_scaled(centre, -roller.apex, ring_axis)
    outward, inverse = short_direction(add_scaled(from_apex, -dot(from_apex, ring_axis), ring_axis))
    normal = scale(raceway.side, add_scaled(scale(raceway.cosine, outward), -raceway.sine, ring_axis))
    lean = dot(normal, axis)
    square = lean * lean
    edge = scale(1.0 + square * (0.5 + square * (0.375 + square * 0.3125)), add_scaled(normal, -lean, axis))
    arm = scale(radius, edge)
    point = add(from_apex, arm)
    along = dot(point, ring_axis)
    across = add_scaled(point, -along, ring_axis)
    outward = short_direction(across)[0]
    around = cross(ring_axis, outward)
    skew = dot(axis, around)
    walk = skew * inverse
    arm_slope = add_scaled(add_scaled(axis, roller.taper, edge), raceway.side * radius * walk, around)
    side_cosine, side_sine = raceway.side * raceway.cosine, raceway.side * raceway.sine
    curve = 0.5 * side_cosine * walk * skew
    approach = (
        side_cosine * dot(across, outward) - side_sine * along - raceway.gap,
        side_cosine * dot(arm_slope, outward) - side_sine * dot(arm_slope, ring_axis),
        curve,
        -curve * dot(axis, outward) * inverse,
    )
    return arm, arm_slope, add_scaled(scale(side_cosine, outward), -side_sine, ring_axis), approach


@inline
def add_damping(springs, rate, damping):
    """Add to the force sums what the damper adds at an affine approach rate."""
    if damping is None:
        return springs[0]
    force, stiffness = springs
    return (
        force[0] + damping.time_constant * (stiffness[0] * rate[0] + stiffness[1] * rate[1]),
        force[1] + damping.time_constant * (stiffness[1] * rate[0] + stiffness[2] * rate[1]),
    )


@inline
def cone_rate(line, centre, motion):
    """Take the affine approach rate of a raceway or rib that moves, the roller at rest in its orbit frame."""
    arm, slope, normal = line[0], line[1], line[2]
    velocity, omega = motion
    at_middle = add(velocity, cross(omega, add(centre, arm)))
    return -dot(at_middle, normal), -dot(cross(omega, slope), normal)


@inline
def tilt_arm(arm, normal):
    """Change of approach with tilt of a contact at `arm` from the centre of mass, [m/rad]."""
    return normal[0] * arm[2] - normal[2] * arm[0]


@inline
def rib_spring(centre, axis, ring_axis, motion, rib):
    """Work out the rib contact: force, tangent stiffness, change with place and tilt, approach rate.

    References
    ----------
    Sphere on cone; see `physics.rib.rib_contact`.
    """
    if rib is None:
        nothing = 0.0 * centre[0]
        return nothing, nothing, (nothing, nothing, nothing), nothing
    sphere = scale(rib.sphere_place, axis)
    place = add(centre, sphere)
    along = dot(place, ring_axis)
    across = subtract(place, scale(along, ring_axis))
    outward = short_direction(across)[0]
    normal = add(scale(rib.normal_axial, ring_axis), scale(rib.normal_radial, outward))
    depth = dot(place, normal) + rib.sphere_radius - rib.distance
    touching = at_least(depth, 0.0)
    tangent = 1.5 * rib.stiffness * sqrt(touching)
    rate = -dot(add(motion[0], cross(motion[1], place)), normal)
    return tangent * touching * (1.0 / 1.5), tangent, (normal[0], normal[2], tilt_arm(sphere, normal)), rate


@inline
def add_raceway(system, force, stiffness, normal, by_tilt, factor):
    """Add a raceway's contact to matrix (upper triangle by rows) and right side."""
    m, r = system
    tilt_0 = by_tilt[0] * stiffness[0] + by_tilt[1] * stiffness[1]
    tilt_1 = by_tilt[0] * stiffness[1] + by_tilt[1] * stiffness[2]
    s, t = factor * stiffness[0], factor * tilt_0
    turning = factor * (by_tilt[0] * tilt_0 + by_tilt[1] * tilt_1)
    matrix = (
        m[0] + s * normal[0] * normal[0],
        m[1] + s * normal[0] * normal[1],
        m[2] + t * normal[0],
        m[3] + s * normal[1] * normal[1],
        m[4] + t * normal[1],
        m[5] + turning,
    )
    right = (
        r[0] - force[0] * normal[0],
        r[1] - force[0] * normal[1],
        r[2] - force[0] * by_tilt[0] - force[1] * by_tilt[1],
    )
    return matrix, right


@inline
def solve_three(system):
    """Solve a symmetric positive definite system of three."""
    m, r = system
    d0 = 1.0 / m[0]
    l1, l2 = m[1] * d0, m[2] * d0
    d1 = 1.0 / (m[3] - l1 * m[1])
    e = m[4] - l1 * m[2]
    l3 = e * d1
    d2 = 1.0 / (m[5] - l2 * m[2] - l3 * e)
    y1 = r[1] - l1 * r[0]
    y2 = r[2] - l2 * r[0] - l3 * y1
    x2 = y2 * d2
    x1 = y1 * d1 - l3 * x2
    return r[0] * d0 - l1 * x1 - l2 * x2, x1, x2


@inline
def settle_forces(force, stiffness, normal, by_tilt, factor, move, reach):
    """Work out the force sums of a raceway with x^0 and x^1 after a move, pressing and within the roller."""
    deeper = normal[0] * move[0] + normal[1] * move[1] + by_tilt[0] * move[2]
    steeper = by_tilt[1] * move[2]
    load = at_least(force[0] + factor * (stiffness[0] * deeper + stiffness[1] * steeper), 0.0)
    moment = force[1] + factor * (stiffness[1] * deeper + stiffness[2] * steeper)
    return load, at_most(at_least(moment, -reach * load), reach * load)


@inline
def approach_rate(motion, normal, by_tilt):
    """Take the affine approach rate on a raceway of a roller that moves."""
    return (
        normal[0] * motion[0] + normal[1] * motion[1] + by_tilt[0] * motion[2],
        by_tilt[1] * motion[2],
    )


@inline
def damper_force(stiffness, rate, damping):
    """Work out the force of a point contact's damper, [N]."""
    if damping is None:
        return 0.0
    return damping.time_constant * stiffness * rate
