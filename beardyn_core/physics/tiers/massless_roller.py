"""Rollers of the lumped tier: one massless spring each, along the cup's contact normal."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.contact_output import load_vector, store_vector
from beardyn_core.physics.bodies.layout import (
    COUNTED,
    OVERSIZE,
    PENETRATION,
    POCKET_ANGLE,
    POCKET_COSINE,
    POCKET_SINE,
    REACTION,
    TRENDS_PER_SNAPSHOT,
)
from beardyn_core.physics.bodies.rigid_bodies import lane_total, row_totals
from beardyn_core.physics.cage.rubbing import pocket_torque
from beardyn_core.physics.contact_damping import damper_time
from beardyn_core.physics.defect import find_damage, gap_moments
from beardyn_core.physics.lanes.lane_math import (
    at_least,
    at_most,
    exp2,
    log2,
    magnitude,
    quick_ninth_root,
    sqrt,
    where_greater,
)
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import add_scaled
from beardyn_core.physics.rib_friction import sliding_torque
from beardyn_core.physics.rolling_resistance import rolling_torque
from beardyn_core.physics.rolling_waves import fetch_waves, subtract_waviness, wave_places
from beardyn_core.physics.tiers.kinematic_bending import (
    PLACE,
    SPEED,
    add_reaction,
    clear_reaction,
    keep_tangent,
    less_opening,
)
from beardyn_core.physics.tiers.kinematic_rings import add_stiffness, store_stiffness
from beardyn_core.physics.tiers.kinematic_rollers import (
    LOAD_COSINE,
    LOAD_SINE,
    RIB_SUM,
    TORQUE_POCKET,
    TORQUE_RIB,
    TORQUE_ROLLING,
    show_contacts,
    show_roller,
    watch_loads,
)
from beardyn_core.physics.tiers.massless_barrel import over_barrel_patches
from beardyn_core.physics.tiers.massless_flanges import (
    add_thrust,
    outward_waves,
    show_thrust,
    store_thrust,
    thrust_torque,
    with_thrust,
)
from beardyn_core.physics.tiers.sliding import creep_of, rolling_level, store_creep

# After the loads: angle of the cages [rad], speed of shaft and cages [rad/s]; then the largest loads [N].
TREND_EXTRAS = 3
_SMALLEST_APPROACH = 1e-12
_LEAST_FIRM = 1e-6
_FETCHED_AHEAD = 4  # steps
# Sums of the stiffness against tilt over the rollers, times cosine and sine of the pocket angle; tier
# quasistatic, which has none, keeps its cages here.
_LENGTH_CC, _LENGTH_SS, _LENGTH_CS = range(REACTION + 14, REACTION + 17)
_PI = 3.141592653589793


@inline
def spring_load(approach, rate, spring, damping):
    """Work out the cup load of a roller that is pressed by cup and cone, never pulling, [N].

    ``approach``, ``rate``: of cone and cup along the cup's normal [m], [m/s].

    Both contacts and the rib have the same time constant, so the spring of all three has it too; its
    tangent stiffness is taken as 10/9 of load over approach.

    References
    ----------
    Palmgren's line contact in the frictionless force triangle of cup, cone and rib; see
    `physics.statics.roller_equilibrium`.
    """
    pressed = at_least(approach, _SMALLEST_APPROACH)
    root = quick_ninth_root(pressed)
    load = root * _series(root, spring.series) * _push(pressed, rate, damping)
    return at_least(where_greater(approach, 0.0, load, 0.0 * approach), 0.0)


@inline
def _series(root, series):
    square = root * root
    low = series[0] + root * series[1]
    middle = series[2] + root * series[3]
    high = series[4] + root * series[5]
    highest = series[6] + root * series[7]
    return low + square * middle + square * square * (high + square * highest)


@inline
def _push(pressed, rate, damping):
    """Take the approach that stands for spring and damper of a 10/9 law, [m]."""
    if damping is None:
        return pressed
    return pressed + (10.0 / 9.0 * damping.time_constant) * rate


@inline
def faulted_load(lanes, block, approach, rate, angle, turns, faults, p):
    """Work out the cup load with the gaps of patches; without patches as `spring_load`.

    See `over_patches` and `massless_barrel`. Neglects the tilt of the roller that follows.
    """
    if faults is None:
        return spring_load(approach, rate, p.spring, p.base.effects.damping)
    count, damping = p.base.laminae.shape[1], p.base.effects.damping
    azimuth, spin = angle + turns[0], turns[2]
    on_cup = (azimuth, lanes.constant(-spin))
    on_cone = (azimuth - turns[1], lanes.constant(_PI - spin))
    cup_near = find_damage(lanes, block, on_cup, count, (faults.cup, faults.roller), faults.cup_damage)
    cone_near = find_damage(lanes, block, on_cone, count, (faults.cone, faults.roller), faults.cone_damage)
    near = cup_near, cone_near
    approach, part = _damaged_approach(lanes, approach, near, faults, p, p.base.cup.barrel)
    return spring_load(approach, part * rate, p.spring, damping)


@inline
def _damaged_approach(lanes, approach, near, faults, p, barrel):
    if barrel is not None:
        return over_barrel_patches(
            lanes, approach, near, faults, p.base.laminae, (barrel, p.base.cone.barrel)
        )
    count, zero = p.base.laminae.shape[1], lanes.constant(0.0)
    covered, lost, gap = zero, zero, zero
    for k in range(count):
        cup = gap_moments(lanes, near[0], k, count, faults.cup_damage)
        cone = gap_moments(lanes, near[1], k, count, faults.cone_damage)
        covered = covered + (cup[0] + cone[0])
        lost = lost + (cup[1] + cone[1])
        gap = gap + (cup[2] + p.spring.cone_share * cone[2])
    return over_patches(approach, (covered / count, lost / count, gap / count))


@inline
def over_patches(approach, moments):
    """Work out the approach at which an intact roller has the load of one over patches, and its slope.

    ``approach``: of cone and cup [m]; ``moments`` (3 numbers): means over the laminae of `gap_moments`.

    The roller is rigid: what the laminae over a patch give up those next to it take over, and the contact
    with the other ring remains whole. With the share f under the patch, of firmness s and with a gap g,
    balance at the depth e is ``(1 - f) e + f s (e - g) = D - e`` for contacts that are linear in e, and the
    intact roller has ``2 (D - e)``. Laminae that have let go altogether leave ``(1 - f)^0.9`` of the firmness
    of a 10/9 law. The load is right to 3.5 % of that of an intact roller.
    """
    free = exp2(0.9 * log2(at_least(1.0 - moments[0], _LEAST_FIRM)))
    left = at_most(2.0 * free / (1.0 + free), 1.0)
    part = 1.0 / (2.0 - moments[1])
    touching = approach - (moments[1] * at_least(approach, 0.0) + 2.0 * moments[2]) * part
    parted = left * approach
    slope = where_greater(touching, parted, 2.0 * (1.0 - moments[1]) * part, left)
    return at_least(touching, parted), slope


@inline
def approach_waves(lanes, motion, direction, p):
    """Write approach and rate of the rows as affine functions of cosine and sine of the pocket angle.

    Returns ``approach``, ``rate`` (3 numbers): factors of cosine, sine and one [m], [m/s].
    """
    side = lanes.load(p.sides, 0, 0)
    approach = _wave(side, motion[0][0], motion[1][0], motion[2][0], motion[3][0], motion[4][0], direction, p)
    rate = _wave(side, motion[0][1], motion[1][1], motion[2][1], motion[3][1], motion[4][1], direction, p)
    return (approach[0], approach[1], approach[2] - p.base.cup.gap), rate


@inline
def _wave(side, x, y, z, about_x, about_z, direction, p):
    cosine, lever = p.base.cup.cosine, p.spring.lever
    along_z = side * (lever * about_x) + cosine * z
    along_x = side * (-lever * about_z) + cosine * x
    return (
        along_z * direction[0] + along_x * direction[1],
        along_x * direction[0] - along_z * direction[1],
        side * (-p.base.cup.sine * y),
    )


@inline
def load_rollers(lanes, rollers, sums, motion, direction, turns, speeds, trend, p):
    """Load all rollers and sum their loads by row.

    Written are the largest approach of the ``rollers``, ``LOAD_COSINE``, ``LOAD_SINE`` and ``RIB_SUM`` of the
    ``sums``, and the cup loads of the ``trend`` (`lumped.trend_shape`) with the largest ones.

    Half of the centrifugal load of the cup comes off the cone: the two contacts are as stiff as each other.
    What is not worked out at every step has functions of its own: with it in here the compiler counts the
    references to all parameter arrays up and down in every step of a faulty bearing, 0.7 us.
    """
    approach_wave, rate_wave = approach_waves(lanes, motion, direction, p)
    idle, places = idle_load(speeds[1], p), wave_places(turns, p.waves)
    later = wave_places(_later(turns, speeds, p), p.waves)
    zero = lanes.constant(0.0)
    loads = (zero, zero, zero)  # sums: plain, times cosine, times sine
    along = (zero, zero, zero, zero)
    outward = outward_waves(lanes.load(p.sides, 0, 0), motion, direction, p.thrust)
    time = damper_time(p.base.effects.damping)
    clear_reaction(lanes, sums, p.bending)
    for block in range(rollers.shape[0]):
        cosine, sine = lanes.load(p.pockets, block, POCKET_COSINE), lanes.load(p.pockets, block, POCKET_SINE)
        approach = approach_wave[0] * cosine + (approach_wave[1] * sine + approach_wave[2])
        # a thicker roller is pressed on both sides
        approach = approach + 2.0 * lanes.load(p.base.rollers, block, OVERSIZE)
        approach = less_opening(lanes, block, PLACE, approach, p.bending, None)
        angle = lanes.load(p.base.rollers, block, POCKET_ANGLE)
        load = lanes.constant(idle)
        # most rollers outside the load zone cost no more than this look
        if any_positive(approach + p.highest):
            fetch_waves(lanes, block, later, p.waves)
            rate = rate_wave[0] * cosine + (rate_wave[1] * sine + rate_wave[2])
            rate = less_opening(lanes, block, SPEED, rate, p.bending, None)
            closed = subtract_waviness(lanes, block, approach, places, p.waves)
            pressed = faulted_load(lanes, block, closed, rate, angle, turns, p.faults, p)
            load = at_least(pressed + 0.5 * idle, idle)
            deepest = at_least(lanes.load(rollers, block, PENETRATION), 0.5 * approach)
            lanes.store(rollers, block, PENETRATION, deepest)
        waves = load_vector(lanes, p.pockets, block, COUNTED)
        thrust = 2 * rollers.shape[0] + TREND_EXTRAS + block
        load, along = add_thrust(
            lanes, along, load, outward, cosine, sine, waves[0], approach, p.thrust, time, trend, thrust
        )
        loads = add_scaled(loads, load, waves)
        add_reaction(lanes, sums, block, waves[0] * load, p.bending, None)
        lanes.store(trend, block, 0, load)
        largest = rollers.shape[0] + TREND_EXTRAS + block
        lanes.store(trend, largest, 0, at_least(lanes.load(trend, largest, 0), load))
    lanes.store(sums, 0, LOAD_COSINE, loads[1])
    lanes.store(sums, 0, LOAD_SINE, loads[2])
    lanes.store(sums, 0, RIB_SUM, loads[0])
    store_thrust(lanes, sums, along, p.thrust)


@inline
def begin_largest(trends, index, blocks):
    """Start the largest loads of an instant of the trends, or go on with those of the one before.

    ``trends`` [trend, row, 1, lane], see `lumped.trend_shape`: changed at `index`.
    """
    first = blocks + TREND_EXTRAS
    for row in range(first, first + blocks):
        for lane in range(trends.shape[3]):
            before = 0.0
            if index % TRENDS_PER_SNAPSHOT != 0:
                before = trends[index - 1, row, 0, lane]
            trends[index, row, 0, lane] = before


@inline
def _later(turns, speeds, p):
    """Work out the angles of cages, cone and rollers in some steps."""
    time = _FETCHED_AHEAD * p.step
    cages = time * speeds[1]
    return turns[0] + cages, turns[1] + time * speeds[0], turns[2] + p.kinematic.spin_ratio * cages


@inline
def torque_and_stiffness(lanes, blocks, sums, motion, direction, speeds, trend, p):
    """Sum by row what is held for a while, torques and stiffness; call it after `load_rollers`."""
    effects, k = p.base.effects, p.kinematic
    wave = approach_waves(lanes, motion, direction, p)[0]
    idle, zero = idle_load(speeds[1], p), lanes.constant(0.0)
    rolling, pocket, sliding = zero, zero, zero
    stiff, lengths = (zero, zero, zero, zero, zero, zero), (zero, zero, zero)
    creep, level = stiff, rolling_level(speeds[1] * k.cup_radius, p.slide)
    tilt = _in_cages_frame(motion[3][0], motion[4][0], direction)
    outward = outward_waves(lanes.load(p.sides, 0, 0), motion, direction, p.thrust)
    for block in range(blocks):
        cosine, sine = lanes.load(p.pockets, block, POCKET_COSINE), lanes.load(p.pockets, block, POCKET_SINE)
        load, counted = lanes.load(trend, block, 0), lanes.load(p.pockets, block, COUNTED)
        loads = cup_cone_rib(load, speeds, p)
        rolling = rolling + counted * rolling_torque(loads, speeds, p.kinematic, effects.rolling)
        idling = counted * pocket_torque(loads[1], speeds, k, effects.drag, k.pocket)
        rolling, pocket = rolling + idling, pocket + idling
        ribs = sliding_torque(loads[2], speeds, p.kinematic, p.base.cone, effects.rib)
        approach = wave[0] * cosine + (wave[1] * sine + wave[2])
        approach = approach + 2.0 * lanes.load(p.base.rollers, block, OVERSIZE)
        approach = less_opening(lanes, block, PLACE, approach, p.bending, None)
        ribs = thrust_torque(ribs, outward, cosine, sine, approach, speeds[0], p.thrust, effects.flanges)
        sliding = sliding + counted * ribs
        # a depth that goes with the load: gaps of faults are not in the approach
        approach = at_least(approach, p.spring.give * (load - 0.5 * idle))
        tangent = 10.0 / 9.0 * (load - 0.5 * idle) / at_least(approach, _SMALLEST_APPROACH)
        tangent = counted * where_greater(load, idle, tangent, zero)
        stiff = add_stiffness(stiff, tangent, cosine, sine)
        creep = add_stiffness(creep, counted * creep_of(load, level, p.slide), cosine, sine)
        keep_tangent(lanes, block, tangent, p.bending)
        pressed, tilted = at_least(load - idle, 0.0), tilt[0] * cosine + tilt[1] * sine
        lengths = add_length(lengths, counted * pressed, approach, tilted, cosine, sine, p.spring.reach)
    lanes.store(sums, 0, TORQUE_ROLLING, rolling)
    lanes.store(sums, 0, TORQUE_POCKET, pocket)
    lanes.store(sums, 0, TORQUE_RIB, sliding)
    store_stiffness(lanes, sums, stiff)
    store_creep(lanes, sums, creep, p.slide)
    store_vector(lanes, sums, 0, _LENGTH_CC, lengths)


@inline
def add_length(lengths, load, approach, tilt, cosine, sine, reach):
    """Add what a block of rollers holds of the tilt of cone against cup by its length, [N m/rad].

    ``lengths`` (3 numbers): sums so far; ``load``: of the cone on the rollers [N]; ``approach`` [m];
    ``tilt``: of the rings against each other in the rollers' meridian planes [rad]; ``reach``: half of a
    roller's length [m].

    A roller stands halfway between its rings, so that each contact, a row of springs of a 10/9 law, turns it
    back with its stiffness times ``reach^2/3``, and the two are in series as along the normal: with ``x =
    tilt reach / approach`` the moment is ``10/27 load reach x``, until at 1 an end lifts off, and ``load
    reach (1 - 17/27 / sqrt(x))`` from there on, within 2 % of such a row. Where the cone lets go of a roller,
    which its centrifugal force presses to the cup alone, nothing is held. The moment of a patch that is not
    in the middle is left out.
    """
    depth = at_least(approach, _SMALLEST_APPROACH)
    lifted = at_least(magnitude(tilt) * reach / depth, 1.0)
    held = (1.0 - 17.0 / 27.0 / sqrt(lifted)) / lifted
    stiffness = reach * reach * held * load / depth
    with_c = stiffness * cosine
    return lengths[0] + with_c * cosine, lengths[1] + stiffness * sine * sine, lengths[2] + with_c * sine


@inline
def _in_cages_frame(about_x, about_z, direction):
    """Turn a tilt into what rollers at the pocket angles 0 and 90 degrees feel of it."""
    return (
        about_x * direction[0] - about_z * direction[1],
        -about_x * direction[1] - about_z * direction[0],
    )


@inline
def tilt_stiffness(sums, direction):
    """Turn what `torque_and_stiffness` kept of `add_length` to world axes, [N m/rad].

    Returns the stiffness of the rollers' lengths about x, between x and z, and about z.
    """
    cc, ss = lane_total(sums, _LENGTH_CC), lane_total(sums, _LENGTH_SS)
    cs, c, s = lane_total(sums, _LENGTH_CS), direction[0], direction[1]
    about_x = cc * c * c - 2.0 * cs * c * s + ss * s * s
    across = (ss - cc) * c * s - cs * (c * c - s * s)
    about_z = cc * s * s + 2.0 * cs * c * s + ss * c * c
    return about_x, across, about_z


@inline
def add_tilt(wrench, stiffness, motion, damping):
    """Add to the wrench on the cup what a tilt of the cone and its rate push by `tilt_stiffness`."""
    about_x, about_z = _tilt_push(motion[3], damping), _tilt_push(motion[4], damping)
    return (
        wrench[0],
        wrench[1],
        wrench[2],
        wrench[3] + (stiffness[0] * about_x + stiffness[1] * about_z),
        wrench[4],
        wrench[5] + (stiffness[1] * about_x + stiffness[2] * about_z),
    )


@inline
def _tilt_push(tilt, damping):
    if damping is None:
        return tilt[0]
    return tilt[0] + damping.time_constant * tilt[1]


@inline
def cup_cone_rib(load, speeds, p):
    """Work out cup, cone and rib load of rollers from the cup load, [N]."""
    spring = p.spring
    cone = spring.cone_share * (load - idle_load(speeds[1], p))
    rib = spring.rib_share * load + spring.rib_centrifugal * centrifugal_force(speeds[1], p)
    return load, cone, rib


@inline
def centrifugal_force(cage_speed, p):
    """Work out the centrifugal force of a roller, [N]."""
    return p.kinematic.centrifugal * cage_speed * cage_speed


@inline
def idle_load(cage_speed, p):
    """Work out the cup load of a roller that the cone does not press, [N]."""
    return p.spring.idle * centrifugal_force(cage_speed, p)


@inline
def sum_rollers(sums, speeds, p):
    """Sum the loads as `cup_wrench` takes them, and the rib loads, from what `load_rollers` stored."""
    spring = p.spring
    cosine, sine = row_totals(sums, LOAD_COSINE), row_totals(sums, LOAD_SINE)
    load = row_totals(sums, RIB_SUM)
    inner, outer = p.sides[0, 0, 0], p.sides[0, 0, p.sides.shape[2] - 1]
    totals = (
        cosine[0] + cosine[1],
        sine[0] + sine[1],
        inner * load[0] + outer * load[1],
        spring.lever * (inner * cosine[0] + outer * cosine[1]),
        spring.lever * (inner * sine[0] + outer * sine[1]),
    )
    centrifugal = p.kinematic.rolling_count * centrifugal_force(speeds[1], p)
    rib = spring.rib_share * (load[0] + load[1]) + spring.rib_centrifugal * centrifugal
    return with_thrust(totals, rib, sums, p.sides, p.thrust)


@inline
def show_springs(lanes, rollers, trend, p):
    """Write all rollers and their contacts, but for the largest approach, as the full tier keeps them.

    The ``trend`` has the cup loads from `load_rollers`, the instant, the largest loads. See `show_roller`.
    """
    blocks, zero, k = rollers.shape[0], lanes.constant(0.0), p.kinematic
    turn = trend[blocks, 0, 0]
    speeds = (trend[blocks + 1, 0, 0], trend[blocks + 2, 0, 0])
    axis = (k.axis_radial + zero, k.axis_axial + zero)
    for block in range(blocks):
        loads = cup_cone_rib(lanes.load(trend, block, 0), speeds, p)
        angle = lanes.load(p.base.rollers, block, POCKET_ANGLE)
        place = (k.radius + zero, k.axial + zero)
        show_roller(lanes, rollers, block, place, axis, (zero, zero, zero), (turn, speeds[1]), angle, p)
        show_contacts(lanes, rollers, block, axis, loads, (zero, zero), speeds, p)
        largest = lanes.load(trend, blocks + TREND_EXTRAS + block, 0)
        watch_loads(lanes, rollers, block, cup_cone_rib(largest, speeds, p))
        thrust = 2 * blocks + TREND_EXTRAS + block
        show_thrust(lanes, rollers, block, axis, trend, thrust, speeds[0], p.thrust, p.base.effects.flanges)
