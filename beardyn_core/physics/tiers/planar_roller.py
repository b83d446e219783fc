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
from beardyn_core.physics.lanes.vectors import subtract, turn_in
from beardyn_core.physics.tiers.planar_contacts import (
    add_damping,
    add_raceway,
    approach_rate,
    cone_line,
    cone_rate,
    cup_line,
    damper_force,
    rib_spring,
    settle_forces,
    solve_three,
    tilt_arm,
)
from beardyn_core.physics.tiers.planar_flanges import (
    add_flanges,
    flange_springs,
    settle_flange_loads,
    shown_load,
)
from beardyn_core.physics.waviness import crown_bend, wave_gap

# A roller moves at most this far in a step [m]: forces are linearised, and surfaces are not known beyond.
_LONGEST_MOVE = 2.0e-5
# Contacts are linearised this much nearer to the cup than a roller flies by itself [m]: as far as a cup that
# bends draws back from an idle roller in a step, and little against the depth of a loaded contact.
_OVERSHOOT = 5.0e-8
_PI = 3.141592653589793


@inline
def balance(lanes, block, place, axis, flight, beside, views, azimuths, opening, level, p):
    """Take one implicit step of a block of rollers.

    ``place`` (2 vectors), ``axis`` (2 vectors): radial and axial, after a flight of a step; ``flight``,
    ``beside`` (3 numbers): of `free_flight`;
    ``views`` (4 vectors): origin and axis of the cone, velocity of its origin and angular velocity, in the
    orbit frame and against it; ``level``: of `sliding.rolling_level`; ``azimuths`` (3 numbers): on cup and
    cone, and of the roller in its pocket [rad]; ``opening`` (2 numbers): how far and how fast
    the bent cup closes in along its normal [m], [m/s].
    Returns ``move`` (3 numbers): beyond the flight, radially, axially, in tilt [m], [m], [rad]; ``cup``,
    ``cone`` (2 numbers): load and its first moment along the roller [N], [N m]; ``rib``: [N];
    ``lever`` (2 numbers): arm of the cup's load about the bearing centre, affine in the abscissa [m];
    ``deepest``: approach on the cup at the centre of mass [m]; ``flanges``: `FlangeLoads`, or ``None`` where
    the rollers are no cylinders.
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
    raceways = (cup_force[0], cone_force[0])
    flanges = flange_springs(
        place, centre, full_axis, views[1], motion, flight, raceways, level, effects.flanges, p
    )
    system = add_flanges(system, flanges, factor, p.motion.rate)
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
    loads = settle_flange_loads(flanges, place, move, factor, p.motion.rate, p.kinematic.cup_radius)
    rib_load = shown_load(rib_load, loads, p.base.effects.flanges)
    return move, cup_load, cone_load, rib_load, lever, cup_approach[0], loads


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
    """Work out where contacts of a step are linearised, as velocities, and what else presses.

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
