"""Axial load of cylinders in the lumped tier: each roller passes it from a rib of the cone to one of the cup.

A roller that is pushed at one end by the inner ring and held at the other by the outer one is a spring of two
point contacts and of what it leans over: the ribs push with the lever of their distance from each other, the
raceways hold with the length of the roller. One that nothing presses leans over until its ends touch both
raceways, and carries what is then left to it.

The spring softens as the raceways part, so it drives them apart: the force along the axle and what a leaning
roller adds to its raceways are derivatives of one energy. A roller that leans over its clearance presses them
with the couple of its ribs over its length, and in between the two limits blend.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline, plain
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.rib_face import RibFace, faces_of_ring
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.bodies.contact_output import store_vector, watch_largest
from beardyn_core.physics.bodies.layout import RIB
from beardyn_core.physics.bodies.rigid_bodies import row_totals
from beardyn_core.physics.flanges import flange_torque
from beardyn_core.physics.lanes.lane_math import at_least, at_most, exp2, log2, sqrt, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.statics.roller_equilibrium import lean_stiffness
from beardyn_core.physics.tiers.kinematic_rollers import KEPT_COSINE, LOAD_AXIAL
from beardyn_core.physics.tiers.planar_flanges import FlangeLoads, show_flanges

_TINY = 1e-18
_NEWTON_STEPS = 3
_DEEPEST = 1.2e-4  # approach of the heaviest rollers of usual loads and spalls [m]


class ThrustPathParams(NamedTuple):
    """Ribs at opposite ends of the rollers, between which the rings press them."""

    gap: float  # of both together, with all parts in the middle [m]
    softness: float  # way of both contacts over the load to the power 2/3 [m/N^(2/3)]


class ThrustParams(NamedTuple):
    """How cylinders carry axial load; ``None`` where the ribs for a direction are absent."""

    inwards: ThrustPathParams | None  # the cone pushes the rollers towards the bearing centre
    outwards: ThrustPathParams | None
    level: float  # binary logarithm of the way of a leaning roller over its load [log2 m/N]
    by_depth: float  # ... over that of the approach of its raceways [log2 m]
    depth_squared: float
    tip: float  # way until a free roller has leaned over its clearance, over that clearance [-]
    least_depth: float  # below which the approach counts as this [m]
    most_depth: float
    radius: float  # of the rollers' axes [m]


def thrust_params(bearing: RollerBearing, laminae: int) -> ThrustParams | None:
    """Work out the axial springs of cylinders mounted with their end play; ``None`` for other rollers.

    A leaning roller is as stiff as statics have it, fitted over the approach of its raceways: a profile that
    takes its ends out of contact leaves the less of it the less it is pressed.
    """
    if not isinstance(bearing, CylindricalBearing):
        return None
    lever = bearing.roller_diameter - 2.0 * bearing.rib_contact_height
    depth, stiffness = lean_stiffness(bearing.clamped, laminae)
    depth, stiffness = depth[depth < _DEEPEST], stiffness[depth < _DEEPEST]
    x = np.log2(depth)
    square, slope, level = np.polyfit(x, np.log2(lever**2 / stiffness), 2).tolist()
    return ThrustParams(
        inwards=_path(bearing, 1.0),
        outwards=_path(bearing, -1.0),
        level=level,
        by_depth=slope,
        depth_squared=square,
        tip=lever / bearing.effective_length,
        least_depth=float(depth[0]),
        most_depth=float(depth[-1]),
        radius=0.5 * bearing.pitch_diameter,
    )


def _path(bearing: CylindricalBearing, cone_side: float) -> ThrustPathParams | None:
    cone, cup = _face(bearing, "cone", cone_side), _face(bearing, "cup", -cone_side)
    if cone is None or cup is None:
        return None
    softness = cone.factor ** (-2.0 / 3.0) + cup.factor ** (-2.0 / 3.0)
    return ThrustPathParams((cone.gap + cup.gap) / math.cos(cone.lean), softness)


def _face(bearing: CylindricalBearing, ring: str, side: float) -> RibFace | None:
    return next((face for face in faces_of_ring(bearing, ring) if face.side == side), None)


@inline
def _share(way, approach, path, thrust):
    """Work out force [N] and tangent [N/m] of rollers that are pressed along by a way [m], and what they add.

    With the root x of the force to the power 1/3 the way is ``softness x^2 + lean x^3``: Newton's steps from
    above come down to it. Added to the load of both raceways [N] is the change of the energy with the
    approach at a held way, ``-lean' force^2 / 2`` of a roller that is pressed all along; one that touches
    with its ends alone has ``tip force``, and no roller more.
    """
    left = at_least(way - thrust.tip * at_least(-approach, 0.0), 0.0) + _TINY
    x = log2(at_most(at_least(approach, thrust.least_depth), thrust.most_depth))
    slope = thrust.by_depth + 2.0 * x * thrust.depth_squared
    lean = exp2(thrust.level + x * (thrust.by_depth + x * thrust.depth_squared))
    root = at_most(sqrt(left / path.softness), exp2((1.0 / 3.0) * log2(left / lean)))
    for _ in range(_NEWTON_STEPS):
        square = root * root
        found = square * (path.softness + lean * root) - left
        root = root - found / (root * (2.0 * path.softness + 3.0 * lean * root))
    force = where_greater(left, 2.0 * _TINY, root * root * root, 0.0 * root)
    leant = at_least(-0.5 * slope * lean * force, 0.0)
    pressing = thrust.tip * force * leant / (leant + thrust.tip * at_least(approach, 0.0) + _TINY)
    return force, 3.0 * root / (2.0 * path.softness + 3.0 * lean * root), pressing


@inline
def _press(way, rate, approach, path, thrust, time):
    """Work out what a path carries with its damper, and what raceways get of it, [N].

    ``way``, ``rate``: of cone against cup along it.
    """
    zero = 0.0 * way
    if path is None:
        return zero, zero
    way = way - path.gap
    if not any_positive(way):
        return zero, zero
    force, tangent, pressing = _share(way, approach, path, thrust)
    damped = at_least(force + time * tangent * rate, 0.0)
    return where_greater(force, 0.0, damped, zero), pressing


@inline
def push_along(outward, rate, approach, thrust, time):
    """Work out the axial force of a block of rollers on the cup, outwards, and the sum of both ways, [N].

    With what it adds to the load of each raceway [N].

    ``outward``, ``rate``: of the cone against the cup at the rollers' axes [m], [m/s];
    ``approach``: of cup and cone on the rollers [m]; ``time``: of the dampers [s].
    """
    inwards, one = _press(-outward, -rate, approach, thrust.inwards, thrust, time)
    outwards, other = _press(outward, rate, approach, thrust.outwards, thrust, time)
    return outwards - inwards, outwards + inwards, one + other


@inline
def outward_waves(side, motion, direction, thrust):
    """Write outward way and rate of the cone as affine functions of cosine and sine of the pocket angle.

    Zeros that nothing uses for tapered rollers.
    """
    if thrust is None:
        nothing = (0.0 * side, 0.0 * side, 0.0 * side)
        return nothing, nothing
    return _outward(side, motion, 0, direction, thrust), _outward(side, motion, 1, direction, thrust)


@inline
def _outward(side, motion, i, direction, thrust):
    y, about_x, about_z = motion[1][i], motion[3][i], motion[4][i]
    along_z, along_x = -thrust.radius * about_x, thrust.radius * about_z
    return (
        side * (along_z * direction[0] + along_x * direction[1]),
        side * (along_x * direction[0] - along_z * direction[1]),
        side * y,
    )


@inline
def add_thrust(lanes, sums, load, waves, cosine, sine, counted, approach, thrust, time, trend, row):
    """Add a block of rollers to the sums of axial forces: plain, times cosine and sine, of both ways.

    Each roller's force on the cup, outwards, goes to a ``row`` of the ``trend``. Returns the ``load`` of the
    raceways with what leaning rollers add, and the sums.
    """
    if thrust is None:
        return load, sums
    way = waves[0][0] * cosine + (waves[0][1] * sine + waves[0][2])
    rate = waves[1][0] * cosine + (waves[1][1] * sine + waves[1][2])
    push, both, pressing = push_along(way, rate, approach, thrust, time)
    push = counted * push
    lanes.store(trend, row, 0, push)
    summed = (sums[0] + push, sums[1] + push * cosine, sums[2] + push * sine, sums[3] + counted * both)
    return load + pressing, summed


@inline
def store_thrust(lanes, sums, thrust_sums, thrust):
    """Keep the sums of `add_thrust`."""
    if thrust is None:
        return
    store_vector(lanes, sums, 0, LOAD_AXIAL, (thrust_sums[0], thrust_sums[1], thrust_sums[2]))
    lanes.store(sums, 0, KEPT_COSINE, thrust_sums[3])


@inline
def with_thrust(totals, rib, sums, sides, thrust):
    """Add the axial forces to the totals that `kinematic_rollers.cup_wrench` takes, and to the rib loads.

    The sum of axial forces goes with a sine of -1, see `planar_flanges.axial_sine`.
    """
    if thrust is None:
        return totals, rib
    push, both = row_totals(sums, LOAD_AXIAL), row_totals(sums, KEPT_COSINE)
    cosine, sine = row_totals(sums, LOAD_AXIAL + 1), row_totals(sums, LOAD_AXIAL + 2)
    inner, outer = sides[0, 0, 0], sides[0, 0, sides.shape[2] - 1]
    radius = thrust.radius
    return (
        totals[0],
        totals[1],
        inner * push[0] + outer * push[1],
        totals[3] - radius * (inner * cosine[0] + outer * cosine[1]),
        totals[4] - radius * (inner * sine[0] + outer * sine[1]),
    ), rib + 2.0 * (both[0] + both[1])


@inline
def show_thrust(lanes, rollers, block, axis, trend, row, speed, thrust, flanges):
    """Write the rib contacts of a block of rollers from what `add_thrust` kept; nothing of tapered ones."""
    if thrust is None:
        return
    push = lanes.load(trend, row, 0)
    inwards, outwards, zero = at_least(-push, 0.0), at_least(push, 0.0), 0.0 * push
    both = inwards + outwards
    loads = FlangeLoads((inwards, outwards, outwards, inwards), 2.0 * both, (zero, zero, zero))
    show_flanges(lanes, rollers, block, axis, loads, speed, flanges)
    watch_largest(lanes, rollers, block, RIB, both * both)


@inline
def thrust_torque(torque, waves, cosine, sine, approach, speed, thrust, flanges):
    """Work out the torque of the ribs of a block of rollers, [N m]; ``torque``: that of tapered ones."""
    if thrust is None:
        return torque
    way = waves[0][0] * cosine + (waves[0][1] * sine + waves[0][2])
    zero = 0.0 * way
    inwards = _press(-way, zero, approach, thrust.inwards, thrust, 0.0)[0]
    outwards = _press(way, zero, approach, thrust.outwards, thrust, 0.0)[0]
    total = _rib_torque(zero, inwards, speed, flanges.cone_outer)
    total = _rib_torque(total, outwards, speed, flanges.cone_inner)
    total = _rib_torque(total, outwards, speed, flanges.cup_outer)
    return _rib_torque(total, inwards, speed, flanges.cup_inner)


@inline
def _rib_torque(total, load, speed, flange):
    if flange is None:
        return total
    return total + where_greater(load, 0.0, flange_torque(load, speed, flange), 0.0 * load)


class Thrust(NamedTuple):
    """What the ribs carry of a pose of the cone, and how that changes."""

    force: Float  # of each roller on the cup along +y [N]
    pressing: Float  # added to the load of its raceways [N]
    by_pose: Float  # [roller, 5], direction in the pose: force times that is the wrench on the cup
    tangent: Float  # [roller, 2, 2], change of both with the way along y and the approach [N/m]


def thrust_at(pose: Float, azimuth: Float, sides: Float, approach: Float, thrust: ThrustParams) -> Thrust:
    """Work out what the ribs carry in a pose.

    Parameters
    ----------
    pose : float64 array, shape [5]
        Displacement of the cone [m] and tilt about x and z [rad].
    azimuth, sides, approach : float64 arrays, shape [roller]
        Places [rad], sides of the rows, and approaches of the raceways [m].
    """
    direction = np.zeros((len(azimuth), 5))
    direction[:, 1] = 1.0
    direction[:, 3] = -thrust.radius * np.cos(azimuth)
    direction[:, 4] = thrust.radius * np.sin(azimuth)
    way = direction @ pose
    step = 1.0e-9
    moved = (_both(way + i * step, approach + k * step, sides, thrust) for i, k in _NEIGHBOURS)
    here, after, before, deeper, shallower = moved
    along, across = (after - before) / (2.0 * step), (deeper - shallower) / (2.0 * step)
    return Thrust(here[0], here[1], direction, np.moveaxis(np.stack([along, across], axis=1), 2, 0))


_NEIGHBOURS = ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))


def _both(way: Float, approach: Float, sides: Float, thrust: ThrustParams) -> Float:
    """Compute force along y and what raceways get, shape [2, roller], [N]."""
    push, pressing = np.zeros_like(way), np.zeros_like(way)
    for sign, path in ((-1.0, thrust.inwards), (1.0, thrust.outwards)):
        if path is not None:
            outward = sign * sides * way - path.gap
            force, _, more = plain(_share)(outward, approach, path, thrust)
            push += np.where(outward > 0.0, sign * force, 0.0)
            pressing += np.where(outward > 0.0, more, 0.0)
    return np.stack([sides * push, pressing])
