"""Rollers of the lumped tier: one massless spring each, along the cup's contact normal."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.defect import patch_arc, patch_nearness
from beardyn_core.kernels.kinematic_rings import (
    STIFF_CC,
    STIFF_COSINE,
    STIFF_CS,
    STIFF_SINE,
    STIFF_SS,
    STIFF_SUM,
)
from beardyn_core.kernels.kinematic_rollers import (
    LOAD_COSINE,
    LOAD_SINE,
    RIB_SUM,
    TORQUE_RIB,
    TORQUE_ROLLING,
    row_totals,
    show_contacts,
    show_roller,
)
from beardyn_core.kernels.kinematic_torque import rolling_torque, sliding_torque
from beardyn_core.kernels.lane_math import at_least, magnitude, quick_ninth_root, where_greater
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.waviness import wave_gap
from beardyn_core.model.fault_parameters import PATCH_POINTS, PLACE_REACH, PLACE_SCALE
from beardyn_core.model.layout import OVERSIZE, PENETRATION, POCKET_ANGLE, REACTION
from beardyn_core.model.tier_parameters import (
    COUNTED,
    COUNTED_COSINE,
    COUNTED_SINE,
    POCKET_COSINE,
    POCKET_SINE,
)

TREND_EXTRAS = 3  # after the loads: angle of the cages [rad], speed of shaft and cages [rad/s]
_SMALLEST_APPROACH = 1e-12
_TINY_GAP, _TINY_GAP_SQUARED = 1e-30, 1e-24
GAP_MEAN, GAP_SQUARE = REACTION + 14, REACTION + 15  # in the sums, behind those of `kinematic_rings`
_LAST_CELL = PATCH_POINTS - 2.0
_PI = 3.141592653589793


@inline
def spring_load(approach: Any, rate: Any, spring: Any, damping: Any) -> Any:
    """Cup load of a roller that is pressed by cup and cone, never pulling, [N].

    Parameters
    ----------
    approach, rate : lane value
        Of cone and cup along the cup's normal, [m], [m/s].
    spring : SpringParams
    damping : DampingParams or None

    Notes
    -----
    Both contacts and the rib have the same time constant, so the spring of all three has it too; its
    tangent stiffness is taken as 10/9 of load over approach.

    References
    ----------
    Palmgren's line contact in the frictionless force triangle of cup, cone and rib; see
    `integrate.roller_spring`.
    """
    pressed = at_least(approach, _SMALLEST_APPROACH)
    root = quick_ninth_root(pressed)
    load = root * _series(root, spring.series) * _push(pressed, rate, damping)
    return at_least(where_greater(approach, 0.0, load, 0.0 * approach), 0.0)


@inline
def _series(root: Any, series: Any) -> Any:
    square = root * root
    low = series[0] + root * series[1]
    middle = series[2] + root * series[3]
    high = series[4] + root * series[5]
    highest = series[6] + root * series[7]
    return low + square * middle + square * square * (high + square * highest)


@inline
def _push(pressed: Any, rate: Any, damping: Any) -> Any:
    """Approach that stands for spring and damper of a 10/9 law, [m]."""
    if damping is None:
        return pressed
    return pressed + (10.0 / 9.0 * damping.time_constant) * rate


@inline
def faulted_load(
    lanes: Any,
    block: Any,
    approach: Any,
    rate: Any,
    constants: Any,
    turns: Any,
    work: Any,
    count: Any,
    faults: Any,
    spring: Any,
    damping: Any,
) -> Any:
    """Cup load with the gaps of faults; without faults `spring_load`.

    The laminae of a roller see different gaps. They are taken as two parts of it, one with the gap g and
    the share f, one without: f g and f g^2 are the means of gap and squared gap over the laminae. Exact
    for a patch of one depth over part of the length. Neglects the tilt of the roller that follows.

    Parameters
    ----------
    constants : float64 array, shape [block, ROLLER_CONSTANTS, lane]
        Of the rollers.
    turns : tuple of 3 floats
        Angle of cages and cone and of the rollers in their pockets, [rad].
    work : float64 array, shape [1, SUM_FIELDS, lane]
        ``GAP_MEAN`` and ``GAP_SQUARE`` are written near a patch.
    count : int
        Laminae.
    faults : FaultParams or None
    spring : SpringParams
    damping : DampingParams or None

    Notes
    -----
    Only what is needed is handed in: references to the arrays of all parameters would be counted up and
    down around every branch, which took longer than all the rest of the step.
    """
    if faults is None:
        return spring_load(approach, rate, spring, damping)
    azimuth, spin = lanes.load(constants, block, POCKET_ANGLE) + turns[0], turns[2]
    on_cup, on_cone = (azimuth, lanes.constant(-spin)), (azimuth - turns[1], lanes.constant(_PI - spin))
    cup_wave = wave_gap(lanes, block, on_cup[0], faults.cup_waves)[0]
    cup_wave = cup_wave + wave_gap(lanes, block, on_cup[1], faults.roller_waves)[0]
    cone_wave = wave_gap(lanes, block, on_cone[0], faults.cone_waves)[0]
    cone_wave = cone_wave + wave_gap(lanes, block, on_cone[1], faults.roller_waves)[0]
    approach = approach - (cup_wave + spring.cone_share * cone_wave)
    sound = spring_load(approach, rate, spring, damping)
    nearest = _nearest(lanes, block, on_cup[0], faults.cup, lanes.constant(0.0))
    nearest = _nearest(lanes, block, on_cone[0], faults.cone, nearest)
    nearest = _nearest(lanes, block, on_cup[1], faults.roller, nearest)
    nearest = _nearest(lanes, block, on_cone[1], faults.roller, nearest)
    load = sound
    if any_positive(nearest):
        for lane in range(lanes.width):
            place = constants[block, POCKET_ANGLE, lane] + turns[0]
            moments = _lane_gaps(block, lane, place, turns, count, faults, spring.cone_share)
            work[0, GAP_MEAN, lane], work[0, GAP_SQUARE, lane] = moments
        mean, square = lanes.load(work, 0, GAP_MEAN), lanes.load(work, 0, GAP_SQUARE)
        share = mean * mean / (square + _TINY_GAP_SQUARED)
        gap = square * mean / (mean * mean + _TINY_GAP_SQUARED)
        load = sound + share * (spring_load(approach - gap, rate, spring, damping) - sound)
    return load


@inline
def _nearest(lanes: Any, block: Any, azimuth: Any, surface: Any, nearest: Any) -> Any:
    """Larger of `nearest` and how far contacts are inside of the reach of patches of one surface, [m]."""
    if surface is None:
        return nearest
    for patch in range(surface.places.shape[0]):
        nearest = at_least(nearest, patch_nearness(lanes, block, azimuth, patch, surface))
    return nearest


@inline
def _lane_gaps(block: Any, lane: Any, azimuth: Any, turns: Any, count: Any, faults: Any, share: Any) -> Any:
    """Mean gap and mean squared gap of one roller: few are near a patch at a time.

    With the gaps of both raceways in series, that of the cone by its share.
    """
    mean, square = 0.0, 0.0
    on_cone = azimuth - turns[1]
    near = _lane_near(block, lane, azimuth, faults.cup) or _lane_near(block, lane, on_cone, faults.cone)
    if (
        near
        or _lane_near(block, lane, -turns[2], faults.roller)
        or _lane_near(block, lane, _PI - turns[2], faults.roller)
    ):
        for k in range(count):
            cup = _lamina_gap(block, lane, (azimuth, -turns[2]), k, count, (faults.cup, faults.roller))
            cone = _lamina_gap(block, lane, (on_cone, _PI - turns[2]), k, count, (faults.cone, faults.roller))
            mean += cup[0] + share * cone[0]
            square += cup[1] + share * (share * cone[1] + 2.0 * cup[0] * cone[0])
    return mean / count, square / count


@inline
def _lane_near(block: Any, lane: Any, azimuth: Any, surface: Any) -> Any:
    """Whether one contact is within the reach of a patch of one surface."""
    found = False
    if surface is not None:
        for patch in range(surface.places.shape[0]):
            inside = surface.places[patch, PLACE_REACH] - magnitude(patch_arc(azimuth, patch, surface))
            found = found or surface.present[block, patch, lane] * inside > 0.0
    return found


@inline
def _lamina_gap(block: Any, lane: Any, azimuths: Any, lamina: Any, count: Any, surfaces: Any) -> Any:
    """Mean gap [m] and mean squared gap [m^2] along one lamina of one contact, as of `gap_moments`."""
    ring = _gap_sums(block, lane, azimuths[0], lamina, count, surfaces[0])
    roller = _gap_sums(block, lane, azimuths[1], lamina, count, surfaces[1])
    mean, covered, whole = ring[0] + roller[0], ring[1] + roller[1], ring[2] + roller[2]
    # the gap of the covered share is the mean over the share
    return mean, mean * mean * whole / max(covered, _TINY_GAP)


@inline
def _gap_sums(block: Any, lane: Any, azimuth: Any, lamina: Any, count: Any, surface: Any) -> Any:
    """Sums over the patches near by: cover times gap, cover times its amount, and its amount, [m]."""
    mean, covered, whole = 0.0, 0.0, 0.0
    if surface is not None:
        for patch in range(surface.places.shape[0]):
            arc = magnitude(patch_arc(azimuth, patch, surface))
            present = surface.present[block, patch, lane]
            if present * (surface.places[patch, PLACE_REACH] - arc) > 0.0:
                position = min(arc * surface.places[patch, PLACE_SCALE], _LAST_CELL)
                cell = int(position)
                at = PATCH_POINTS * (patch * count + lamina) + cell
                low = surface.paths[at]
                gap = present * (low + (position - cell) * (surface.paths[at + 1] - low))
                cover = surface.cover[patch, lamina]
                mean += cover * gap
                covered += cover * magnitude(gap)
                whole += magnitude(gap)
    return mean, covered, whole


@inline
def approach_waves(lanes: Any, motion: Any, direction: Any, p: Any) -> Any:
    """Approach and approach rate of the rows as affine functions of cosine and sine of the pocket angle.

    Parameters
    ----------
    motion : tuple
        From `relative_cone`.
    direction : tuple of 2 floats
        Cosine and sine of the cage angle.

    Returns
    -------
    approach, rate : tuples of 3 lane values
        Factors of cosine, sine and one, [m], [m/s].
    """
    side = lanes.load(p.sides, 0, 0)
    approach = _wave(side, motion[0][0], motion[1][0], motion[2][0], motion[3][0], motion[4][0], direction, p)
    rate = _wave(side, motion[0][1], motion[1][1], motion[2][1], motion[3][1], motion[4][1], direction, p)
    return (approach[0], approach[1], approach[2] - p.base.cup.gap), rate


@inline
def _wave(side: Any, x: Any, y: Any, z: Any, about_x: Any, about_z: Any, direction: Any, p: Any) -> Any:
    cosine, lever = p.base.cup.cosine, p.spring.lever
    along_z = side * (lever * about_x) + cosine * z
    along_x = side * (-lever * about_z) + cosine * x
    return (
        along_z * direction[0] + along_x * direction[1],
        along_x * direction[0] - along_z * direction[1],
        side * (-p.base.cup.sine * y),
    )


@inline
def load_rollers(
    lanes: Any,
    rollers: Any,
    sums: Any,
    motion: Any,
    direction: Any,
    turns: Any,
    speeds: Any,
    due: Any,
    shown: Any,
    trend: Any,
    p: Any,
) -> None:
    """Loads of all rollers and their sums by row.

    Parameters
    ----------
    lanes : Lanes
    rollers : float64 array, shape [block, ROLLER_FIELDS, lane]
        Written: the largest approach.
    sums : float64 array, shape [1, SUM_FIELDS, lane]
        Written: ``LOAD_COSINE``, ``LOAD_SINE``, ``RIB_SUM``; when `due` the torques and the stiffness.
    motion : tuple
        From `relative_cone`.
    direction : tuple of 2 floats
        Cosine and sine of the cage angle.
    turns : tuple of 3 floats
        Angle of cages, cone, and rollers in their pockets, [rad].
    speeds : tuple of 2 floats
        Of shaft and cages, [rad/s].
    due : bool
        Whether to work out the torque of the contacts and their stiffness.
    shown : bool
        Whether to keep the loads in `trend`.
    trend : float64 array, shape [block + TREND_EXTRAS, 1, lane]
        Written when `shown`: cup loads, then what `show_springs` needs besides.
    p : LumpedParameters

    Notes
    -----
    Half of the centrifugal load of the cup comes off the cone: the two contacts are as stiff as each other.
    """
    effects = p.base.effects
    approach_wave, rate_wave = approach_waves(lanes, motion, direction, p)
    idle = idle_load(speeds[1], p)
    zero = lanes.constant(0.0)
    load_cosine, load_sine, load_sum = zero, zero, zero
    rolling, sliding = zero, zero
    stiff, stiff_c, stiff_s, stiff_cc, stiff_ss, stiff_cs = zero, zero, zero, zero, zero, zero
    for block in range(rollers.shape[0]):
        cosine, sine = lanes.load(p.pockets, block, POCKET_COSINE), lanes.load(p.pockets, block, POCKET_SINE)
        approach = approach_wave[0] * cosine + (approach_wave[1] * sine + approach_wave[2])
        # a thicker roller is pressed on both sides
        approach = approach + 2.0 * lanes.load(p.base.rollers, block, OVERSIZE)
        load = lanes.constant(idle)
        # most rollers outside the load zone cost no more than this look
        if any_positive(approach):
            rate = rate_wave[0] * cosine + (rate_wave[1] * sine + rate_wave[2])
            pressed = faulted_load(
                lanes, block, approach, rate, p.base.rollers, turns, sums, p.base.laminae.shape[1], p.faults,
                p.spring, effects.damping,
            )  # fmt: skip
            load = at_least(pressed + 0.5 * idle, idle)
            deepest = at_least(lanes.load(rollers, block, PENETRATION), 0.5 * approach)
            lanes.store(rollers, block, PENETRATION, deepest)
            if due:
                tangent = 10.0 / 9.0 * pressed / at_least(approach, _SMALLEST_APPROACH)
                tangent = tangent * lanes.load(p.pockets, block, COUNTED)
                stiff = stiff + tangent
                stiff_c, stiff_s = stiff_c + tangent * cosine, stiff_s + tangent * sine
                stiff_cc = stiff_cc + tangent * cosine * cosine
                stiff_ss = stiff_ss + tangent * sine * sine
                stiff_cs = stiff_cs + tangent * cosine * sine
        load_cosine = load_cosine + load * lanes.load(p.pockets, block, COUNTED_COSINE)
        load_sine = load_sine + load * lanes.load(p.pockets, block, COUNTED_SINE)
        load_sum = load_sum + load * lanes.load(p.pockets, block, COUNTED)
        if due:
            loads, counted = cup_cone_rib(load, speeds, p), lanes.load(p.pockets, block, COUNTED)
            rolling = rolling + counted * rolling_torque(loads, speeds, p.kinematic, effects.rolling)
            sliding = sliding + counted * sliding_torque(loads[2], speeds, p, effects.rib)
        if shown:
            lanes.store(trend, block, 0, load)
    lanes.store(sums, 0, LOAD_COSINE, load_cosine)
    lanes.store(sums, 0, LOAD_SINE, load_sine)
    lanes.store(sums, 0, RIB_SUM, load_sum)
    if due:
        lanes.store(sums, 0, TORQUE_ROLLING, rolling)
        lanes.store(sums, 0, TORQUE_RIB, sliding)
        lanes.store(sums, 0, STIFF_SUM, stiff)
        lanes.store(sums, 0, STIFF_COSINE, stiff_c)
        lanes.store(sums, 0, STIFF_SINE, stiff_s)
        lanes.store(sums, 0, STIFF_CC, stiff_cc)
        lanes.store(sums, 0, STIFF_SS, stiff_ss)
        lanes.store(sums, 0, STIFF_CS, stiff_cs)
    if shown:
        for i, value in enumerate((turns[0], speeds[0], speeds[1])):
            lanes.store(trend, rollers.shape[0] + i, 0, lanes.constant(value))


@inline
def cup_cone_rib(load: Any, speeds: Any, p: Any) -> Any:
    """Cup, cone and rib load of rollers from the cup load, [N]."""
    spring = p.spring
    cone = spring.cone_share * (load - idle_load(speeds[1], p))
    rib = spring.rib_share * load + spring.rib_centrifugal * centrifugal_force(speeds[1], p)
    return load, cone, rib


@inline
def centrifugal_force(cage_speed: Any, p: Any) -> Any:
    """Of a roller, [N]."""
    return p.kinematic.centrifugal * cage_speed * cage_speed


@inline
def idle_load(cage_speed: Any, p: Any) -> Any:
    """Cup load of a roller that the cone does not press, [N]."""
    return p.spring.idle * centrifugal_force(cage_speed, p)


@inline
def sum_rollers(sums: Any, speeds: Any, p: Any) -> Any:
    """Totals as `cup_wrench` takes them, and the sum of the rib loads, from what `load_rollers` stored."""
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
    return totals, spring.rib_share * (load[0] + load[1]) + spring.rib_centrifugal * centrifugal


@inline
def show_springs(lanes: Any, rollers: Any, trend: Any, p: Any) -> None:
    """Write all rollers and their contacts as the full tier keeps them; see `show_roller`.

    Parameters
    ----------
    rollers : float64 array, shape [block, ROLLER_FIELDS, lane]
        Written, but for the largest approach.
    trend : float64 array, shape [block + TREND_EXTRAS, 1, lane]
        From `load_rollers`.
    """
    blocks, zero, k = rollers.shape[0], lanes.constant(0.0), p.kinematic
    turn = trend[blocks, 0, 0]
    speeds = (trend[blocks + 1, 0, 0], trend[blocks + 2, 0, 0])
    axis = (k.axis_radial + zero, k.axis_axial + zero)
    for block in range(blocks):
        loads = cup_cone_rib(lanes.load(trend, block, 0), speeds, p)
        angle = lanes.load(p.base.rollers, block, POCKET_ANGLE)
        place = (k.radius + zero, k.axial + zero)
        show_roller(lanes, rollers, block, place, axis, (turn, speeds[1]), angle, p)
        show_contacts(lanes, rollers, block, axis, loads, (zero, zero), speeds, p)
