"""Rollers of the quasistatic tier: between cup, cone and rib, one implicit step of Euler per time step.

A roller moves in its own meridian plane: radially, axially and in tilt, which is positive when the large
end moves outwards. Where it stands and how it moves is state. Its contacts are far stiffer than a step can
follow, 15 kHz under load: one Newton step of the implicit method damps that and gives the balance, while a
roller that nothing presses flies, and strikes with its own mass. The contacts are linearised where it flies
to, and a little nearer to the cup: from there, pressed too much, the step comes back to balance, while from a
gap it would not see the contact at all. Forces are those at the end of the step.

References
----------
Hairer and Wanner (1996), Solving Ordinary Differential Equations II, IV.3, for stiff components; a single
Newton step is their linearly implicit method, IV.7.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.contact_damping import damper_time
from beardyn_core.physics.lamina_springs import cup_springs, lamina_springs, most_bend
from beardyn_core.physics.lanes.lane_math import at_least, at_most, magnitude, sqrt, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import add, add_scaled, cross, dot, scale, subtract, turn_in
from beardyn_core.physics.waviness import crown_bend, wave_gap

# A roller moves at most this far in a step [m]: forces are linearised, and surfaces are not known beyond.
_LONGEST_MOVE = 2.0e-5
# Contacts are linearised this much nearer to the cup than a roller flies by itself [m]: as far as a cup that
# bends draws back from an idle roller in a step, and little against the depth of a loaded contact.
_OVERSHOOT = 5.0e-8
_PI = 3.141592653589793


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
def balance(lanes, block, place, axis, flight, beside, views, azimuths, opening, p):
    """Take one implicit step of a block of rollers.

    ``place`` (2 vectors), ``axis`` (2 vectors): radial and axial, after a flight of a step; ``flight``,
    ``beside`` (3 numbers): of `free_flight`;
    ``views`` (4 vectors): origin and axis of the cone, velocity of its origin and angular velocity, in the
    orbit frame and against it; ``azimuths`` (3 numbers): on cup and cone, and of the roller in its pocket
    [rad]; ``opening`` (2 numbers): how far and how fast the bent cup closes in along its normal [m], [m/s].
    Returns ``move`` (3 numbers): beyond the flight, radially, axially, in tilt [m], [m], [rad]; ``cup``,
    ``cone`` (2 numbers): load and its first moment along the roller [N], [N m]; ``rib``: [N];
    ``lever`` (2 numbers): arm of the cup's load about the bearing centre, affine in the abscissa [m];
    ``deepest``: approach on the cup at the centre of mass [m].
    """
    base, effects = p.base, p.base.effects
    roller, faults, zero = base.roller, effects.faults, lanes.constant(0.0)
    factor = 1.0 + damper_time(effects.damping) / p.step
    radius = roller.radius + azimuths[3]
    cup_approach, cup_tilt, lever = cup_line(place, axis, radius, base.cup, roller)
    cup_wave = wave_gap(lanes, block, azimuths[0], faults.cup_waves)[0]
    cup_wave = cup_wave + wave_gap(lanes, block, -azimuths[2], faults.roller_waves)[0]
    cup_approach = (_close_gap(cup_approach[0] - cup_wave, opening[0], p.bending), cup_approach[1])
    crown = crown_bend(lanes, block, faults.crowns)
    azimuths_on_cup = (azimuths[0], -azimuths[2])
    cup = cup_springs(
        lanes,
        block,
        cup_approach,
        crown,
        azimuths_on_cup,
        base.laminae,
        roller.half_length,
        faults,
        effects.coupling,
    )
    motion = (views[2], views[3])
    centre = subtract((place[0], zero, place[1]), views[0])
    full_axis = (axis[0], zero, axis[1])
    line = cone_line(centre, full_axis, views[1], radius, base.cone, roller)
    nearest = line[3][0] + roller.half_length * magnitude(line[3][1])
    nearest = nearest + most_bend((line[3][2] + crown, line[3][3]), roller.half_length)
    cone_wave = cone_waves(lanes, block, nearest, azimuths, faults, p.highest_wave, faults.cone_damage)
    cone = lamina_springs(
        lanes, block, (line[3][0] - cone_wave, line[3][1]), (line[3][2] + crown, line[3][3]),
        (azimuths[1], _PI - azimuths[2]), base.laminae, roller.half_length,
        (faults.cone, faults.roller, faults.cone_damage), effects.coupling,
    )  # fmt: skip
    cone_normal = (line[2][0], line[2][2])
    cone_tilt = (tilt_arm(line[0], line[2]), tilt_arm(line[1], line[2]))
    cup_normal = (base.cup.cosine, -base.cup.sine)
    flown = approach_rate(flight, cone_normal, cone_tilt)
    rate = cone_rate(line, centre, motion)
    cone_force = add_damping(cone, (rate[0] + flown[0], rate[1] + flown[1]), effects.damping)
    rib_force, rib_stiffness, rib_way, rib_rate = rib_spring(centre, full_axis, views[1], motion, effects.rib)
    rib_rate = rib_rate + rib_way[0] * flight[0] + rib_way[1] * flight[1] + rib_way[2] * flight[2]
    rib_force = rib_force + damper_force(rib_stiffness, rib_rate, effects.damping)

    heavy = roller.mass / (p.step * p.step) + zero
    system = (
        (heavy, zero, zero, heavy, zero, roller.transverse_inertia / (p.step * p.step) + zero),
        (beside[0] + zero, beside[1] + zero, beside[2] + zero),
    )
    flown = approach_rate(flight, cup_normal, cup_tilt)
    cup_force = add_damping(cup, (_close_gap(flown[0], opening[1], p.bending), flown[1]), effects.damping)
    system = add_raceway(system, cup_force, cup[1], cup_normal, cup_tilt, factor)
    system = add_raceway(system, cone_force, cone[1], cone_normal, cone_tilt, factor)
    rib_only = (rib_stiffness, zero, zero)
    system = add_raceway(system, (rib_force, zero), rib_only, rib_way, (rib_way[2], zero), factor)
    step = solve_three(system)
    # shortened as a whole: parts of a move do not balance
    longest = at_least(
        magnitude(step[0]), at_least(magnitude(step[1]), roller.half_length * magnitude(step[2]))
    )
    shorter = _LONGEST_MOVE / at_least(longest, _LONGEST_MOVE)
    move = (shorter * step[0], shorter * step[1], shorter * step[2])
    reach = roller.half_length
    cup_load = settle_forces(cup_force, cup[1], cup_normal, cup_tilt, factor, move, reach)
    cone_load = settle_forces(cone_force, cone[1], cone_normal, cone_tilt, factor, move, reach)
    rib_deeper = rib_way[0] * move[0] + rib_way[1] * move[1] + rib_way[2] * move[2]
    rib_load = at_least(rib_force + factor * rib_stiffness * rib_deeper, 0.0)
    return move, cup_load, cone_load, rib_load, lever, cup_approach[0]


@inline
def cone_waves(lanes, block, nearest, azimuths, faults, highest, damage):
    """Look up the gap of waviness on the cone; 0 for a block of rollers that are all beyond its reach, [m].

    ``nearest``: largest approach of the rollers without it [m]; ``highest``: bound of the gap [m];
    ``damage``: patches, whose rims may reach further.
    """
    gap = lanes.constant(0.0)
    if damage is not None:
        nearest = gap + 1.0
    if any_positive(nearest + highest):
        gap = gap + wave_gap(lanes, block, azimuths[1], faults.cone_waves)[0]
        gap = gap + wave_gap(lanes, block, _PI - azimuths[2], faults.roller_waves)[0]
    return gap


@inline
def free_flight(motion, cup, steady, p):
    """Work out where contacts of a step are linearised, as velocities, and what presses besides them.

    ``motion`` (3 numbers): radial and axial velocity against the cup and tilt rate before the step [m/s],
    [rad/s]; ``cup`` (2 numbers): radial and axial acceleration of the cup [m/s^2]; ``steady`` (2 numbers):
    centrifugal force and gyroscopic moment [N], [N m]. Returns ``flight`` (3 numbers): velocities over the
    step, on towards the cup by at most `_OVERSHOOT`; ``beside`` (3 numbers): radially, axially, in tilt.
    """
    roller, step, rate = p.base.roller, p.step, p.motion.rate
    towards = at_most(step * steady[0] / roller.mass + 0.0 * motion[0], _OVERSHOOT * rate)
    beside = (
        steady[0] - roller.mass * (cup[0] + rate * towards),
        -roller.mass * cup[1],
        steady[1] + 0.0 * motion[2],
    )
    return (motion[0] + towards, motion[1], motion[2]), beside


@inline
def damp_reversal(before, after):
    """Take half of a velocity that has turned round within a step; ``before``: that before the step.

    A roller that meets a contact in every other step alone, on a rib that it just leaves, would go to and fro
    for ever: one Newton step a time step never sees both sides of it. Slow motion turns round when it is
    hardly there.
    """
    return where_greater(0.0 * after, before * after, 0.5 * after, after)


@inline
def _close_gap(approach, closing, bending):
    if bending is None:
        return approach
    return approach + closing


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


@inline
def turned_axis(axis, tilt):
    """Turn the roller axis (radial, axial) by a small tilt."""
    square = tilt * tilt
    cosine, sine = 1.0 - 0.5 * square, tilt * (1.0 - square * (1.0 / 6.0))
    radial = axis[0] * cosine + axis[1] * sine
    axial = axis[1] * cosine - axis[0] * sine
    shrink = 1.5 - 0.5 * (radial * radial + axial * axial)
    return radial * shrink, axial * shrink


@inline
def cone_view(lanes, motion, cosine, sine, orbit_rate, side):
    """Turn the cone into the orbit frames: origin, axis, and how both move against these turning frames."""
    zero = lanes.constant(0.0)
    about_x, about_z = motion[3][0], motion[4][0]
    length = 1.0 / sqrt(
        about_x * about_x + about_z * about_z + (1.0 - 0.5 * (about_x * about_x + about_z * about_z)) ** 2
    )
    upright = (1.0 - 0.5 * (about_x * about_x + about_z * about_z)) * length
    origin = turn_in((motion[2][0] + zero, motion[0][0] + zero, side * motion[1][0]), cosine, sine)
    axis = turn_in((side * (about_x * length), side * (-about_z * length), upright + zero), cosine, sine)
    velocity = turn_in((motion[2][1] + zero, motion[0][1] + zero, side * motion[1][1]), cosine, sine)
    omega = turn_in((side * motion[4][1], side * motion[3][1], zero), cosine, sine)
    tilt = turn_in((side * about_z, side * about_x, zero), cosine, sine)
    velocity = (velocity[0] + orbit_rate * origin[1], velocity[1] - orbit_rate * origin[0], velocity[2])
    omega = (omega[0] + orbit_rate * tilt[1], omega[1] - orbit_rate * tilt[0], omega[2])
    return origin, axis, velocity, omega
