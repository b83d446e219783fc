"""Barrels in the quasistatic tier: one implicit step between the sphere of the cup and a groove of the cone.

As `planar_roller`, but that the normals of the contacts turn along the roller: `physics.barrel_line` has
them, and force and moment follow from its gradients. Nothing but the arcs of the raceways holds a barrel
along its axis and against tilt; each raceway resists sliding along it in proportion to the slip, by the law
of `sliding`.

What drives a barrel along its raceways and turns it, part of its centrifugal force and the gyroscopic moment,
the cage and the guide ring take, as in statics. Neglected: skew, and the friction at those.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.barrel_line import barrel_line
from beardyn_core.physics.bodies.power import SMALLEST_LOAD
from beardyn_core.physics.contact_damping import damper_time
from beardyn_core.physics.generator_line import normal_change
from beardyn_core.physics.lamina_springs import lamina_springs
from beardyn_core.physics.laminae import deepest_approach
from beardyn_core.physics.lanes.lane_math import at_least, at_most, exp2, log2, magnitude, where_greater
from beardyn_core.physics.lanes.vectors import Twist, cross, scale, subtract
from beardyn_core.physics.tiers.planar_contacts import add_damping, solve_three
from beardyn_core.physics.tiers.planar_flanges import FlangeLoads, raceway_grip
from beardyn_core.physics.waviness import crown_bend, wave_gap

# A roller moves at most this far in a step [m]: forces are linearised, and surfaces are not known beyond.
_LONGEST_MOVE = 2.0e-5
_PI = 3.141592653589793


@inline
def balance_barrels(lanes, block, place, axis, flight, beside, views, azimuths, opening, level, p):
    """Take one implicit step of a block of barrels; arguments and results as of `planar_roller.balance`."""
    base, effects = p.base, p.base.effects
    roller, faults, zero = base.roller, effects.faults, lanes.constant(0.0)
    factor = 1.0 + damper_time(effects.damping) / p.step
    still, upright = (zero, zero, zero), (zero, zero, zero + 1.0)
    full_axis = (axis[0], zero, axis[1])
    at_cup = (place[0], zero, place[1])
    at_cone = subtract(at_cup, views[0])
    cup = barrel_line(at_cup, full_axis, upright, azimuths[3], 1.0, base.cup.barrel)
    cone = barrel_line(at_cone, full_axis, views[1], azimuths[3], -1.0, base.cone.barrel)
    crown = crown_bend(lanes, block, faults.crowns)
    on_cup = (azimuths[0], -azimuths[2])
    on_cone = (azimuths[1], _PI - azimuths[2])
    waves = wave_gap(lanes, block, on_cup[0], faults.cup_waves)[0]
    cup_gap = waves + wave_gap(lanes, block, on_cup[1], faults.roller_waves)[0] - opening[0]
    waves = wave_gap(lanes, block, on_cone[0], faults.cone_waves)[0]
    cone_gap = waves + wave_gap(lanes, block, on_cone[1], faults.roller_waves)[0]
    reach = roller.half_length
    cup_sums = lamina_springs(
        lanes, block, (cup.approach[0] - cup_gap, cup.approach[1]), (cup.approach[2] + crown, zero), on_cup,
        base.laminae, reach, (faults.cup, faults.roller, faults.cup_damage), None, base.cup.barrel.ellipse,
    )  # fmt: skip
    cone_sums = lamina_springs(
        lanes, block, (cone.approach[0] - cone_gap, cone.approach[1]), (cone.approach[2] + crown, zero),
        on_cone, base.laminae, reach, (faults.cone, faults.roller, faults.cone_damage), None,
        base.cone.barrel.ellipse,
    )  # fmt: skip

    by_cup, by_cone = _motions(cup), _motions(cone)
    flown = _rate(by_cup, flight)
    cup_force = add_damping(cup_sums, (flown[0] + opening[1], flown[1]), effects.damping)
    rings = _ring_rate(cone, at_cone, (views[2], views[3]), base.cone.barrel)
    flown = _rate(by_cone, flight)
    cone_force = add_damping(cone_sums, (flown[0] + rings[0], flown[1] + rings[1]), effects.damping)
    heavy = roller.mass / (p.step * p.step) + zero
    system = (
        (heavy, zero, zero, heavy, zero, roller.transverse_inertia / (p.step * p.step) + zero),
        (beside[0] + zero, beside[1] + zero, beside[2] + zero),
    )
    system = _add_arc(system, cup_force, cup_sums[1], by_cup, factor)
    system = _add_arc(system, cone_force, cone_sums[1], by_cone, factor)
    cup_slide = _slide(cup, at_cup, still, still)
    cone_slide = _slide(cone, at_cone, views[2], views[3])
    rate = p.motion.rate
    cup_grip = raceway_grip(cup_force[0], level, p.grip)
    cone_grip = raceway_grip(cone_force[0], level, p.grip)
    system = _add_grip(system, cup_slide, flight, cup_grip, rate)
    system = _add_grip(system, cone_slide, flight, cone_grip, rate)
    step = solve_three(system)
    longest = at_least(
        magnitude(step[0]), at_least(magnitude(step[1]), roller.half_length * magnitude(step[2]))
    )
    shorter = _LONGEST_MOVE / at_least(longest, _LONGEST_MOVE)
    move = (shorter * step[0], shorter * step[1], shorter * step[2])
    cup_load = _settle(cup_force, cup_sums[1], by_cup, factor, move, reach)
    cone_load = _settle(cone_force, cone_sums[1], by_cone, factor, move, reach)
    dragged = cup_grip * (_along(cup_slide, flight) + rate * _along(cup_slide, move))
    deepest = deepest_approach(cup.approach, reach, base.cup.barrel.ellipse)[0] - cup_gap
    loads = _on_cup(cup, at_cup, cup_load, dragged, base.cup.cosine)
    return move, cup_load, cone_load, zero, (zero, zero), deepest, loads


@inline
def guided_inertia(inertia, cup):
    """Take what is left of centrifugal force and gyroscopic moment of barrels that are guided, radially."""
    return inertia[0] * cup.cosine * cup.cosine, 0.0 * inertia[1]


@inline
def pressed_outwards(beside, inertia, cup):
    """Add the axial part of what presses a guided barrel on the sphere to `planar_roller.free_flight`'s."""
    return beside[0], beside[1] - inertia[0] * cup.sine / cup.cosine, beside[2]


@inline
def barrel_tangent(load, tangent):
    """Work out the stiffness of barrels that press on the cone with a load; 0 where they do not, [N/m].

    ``tangent``: of `roller_spring.roller_tangent`.
    """
    stiffness = tangent * exp2((1.0 / 3.0) * log2(at_least(load, SMALLEST_LOAD)))
    return where_greater(load, SMALLEST_LOAD, stiffness, 0.0 * load)


@inline
def _motions(line):
    """Take the changes of the approach with radial and axial place and tilt, at x = 0 and per abscissa."""
    curve, normal = line.curve, line.normal
    return (
        (normal[0], normal[2], curve.moment[1]),
        (curve.turn[0], curve.turn[2], curve.moment_slope[1]),
    )


@inline
def _product(one, other):
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


@inline
def _rate(by, motion):
    return _product(by[0], motion), _product(by[1], motion)


@inline
def _ring_rate(line, centre, motion, barrel):
    """Take the affine approach rate of a ring that moves, the roller at rest in its orbit frame."""
    velocity, omega = motion
    past = cross(omega, centre)
    against = (-velocity[0] - past[0], -velocity[1] - past[1], -velocity[2] - past[2])
    return normal_change(line, Twist(against, scale(-1.0, omega)), barrel)


@inline
def _add_arc(system, force, stiffness, by, factor):
    """Add a raceway's contact to matrix (upper triangle by rows) and right side."""
    m, r = system
    level, slope = by
    a = _weigh(stiffness[0], stiffness[1], level, slope, factor)
    b = _weigh(stiffness[1], stiffness[2], level, slope, factor)
    matrix = (
        m[0] + (level[0] * a[0] + slope[0] * b[0]),
        m[1] + (level[0] * a[1] + slope[0] * b[1]),
        m[2] + (level[0] * a[2] + slope[0] * b[2]),
        m[3] + (level[1] * a[1] + slope[1] * b[1]),
        m[4] + (level[1] * a[2] + slope[1] * b[2]),
        m[5] + (level[2] * a[2] + slope[2] * b[2]),
    )
    right = (
        r[0] - (force[0] * level[0] + force[1] * slope[0]),
        r[1] - (force[0] * level[1] + force[1] * slope[1]),
        r[2] - (force[0] * level[2] + force[1] * slope[2]),
    )
    return matrix, right


@inline
def _weigh(first, second, level, slope, factor):
    a, b = factor * first, factor * second
    return a * level[0] + b * slope[0], a * level[1] + b * slope[1], a * level[2] + b * slope[2]


@inline
def _settle(force, stiffness, by, factor, move, reach):
    """Work out the force sums of a raceway with x^0 and x^1 after a move, pressing and within the roller."""
    deeper, steeper = _rate(by, move)
    load = at_least(force[0] + factor * (stiffness[0] * deeper + stiffness[1] * steeper), 0.0)
    moment = force[1] + factor * (stiffness[1] * deeper + stiffness[2] * steeper)
    return load, at_most(at_least(moment, -reach * load), reach * load)


@inline
def _slide(line, centre, velocity, omega):
    """Take how a roller slides along a ring with its motions, and as the ring moves by itself, [m/s]."""
    along, arm = line.along, line.arm
    at_contact = cross(omega, (centre[0] + arm[0], centre[1] + arm[1], centre[2] + arm[2]))
    ring = along[0] * (velocity[0] + at_contact[0]) + along[2] * (velocity[2] + at_contact[2])
    return along[0], along[2], arm[2] * along[0] - arm[0] * along[2], ring


@inline
def _along(slide, motion):
    return slide[0] * motion[0] + slide[1] * motion[1] + slide[2] * motion[2]


@inline
def _add_grip(system, slide, flight, grip, rate):
    """Add the resistance of one raceway against sliding along it, implicit."""
    m, r = system
    pushed = grip * (_along(slide, flight) - slide[3])
    a = (rate * grip * slide[0], rate * grip * slide[1], rate * grip * slide[2])
    matrix = (
        m[0] + a[0] * slide[0], m[1] + a[0] * slide[1], m[2] + a[0] * slide[2],
        m[3] + a[1] * slide[1], m[4] + a[1] * slide[2], m[5] + a[2] * slide[2],
    )  # fmt: skip
    return matrix, (r[0] - pushed * slide[0], r[1] - pushed * slide[1], r[2] - pushed * slide[2])


@inline
def _on_cup(line, centre, load, dragged, cosine):
    """Turn the load of the cup into its radial force less what `cup_wrench` has, axial force and moment.

    Pressing has no moment about the middle of the sphere, friction along it has.
    """
    turn, along, arm = line.curve.turn, line.along, line.arm
    radial = load[0] * line.normal[0] + load[1] * turn[0] + dragged * along[0]
    axial = load[0] * line.normal[2] + load[1] * turn[2] + dragged * along[2]
    lever = (centre[2] + arm[2]) * along[0] - (centre[0] + arm[0]) * along[2]
    zero = 0.0 * radial
    return FlangeLoads((zero, zero, zero, zero), zero, (radial / cosine - load[0], axial, dragged * lever))
