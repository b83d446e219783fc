"""Rollers in the pockets of their cages in the quasistatic tier: along the pitch circle, one freedom each.

A roller that the cone presses rolls: a slip drives it towards the speed of rolling, and up to the limit of
traction nothing that its pocket does to it changes that. An idle one coasts: its weight, the medium and the
bars of its pocket move it. A cage turns and moves across as a body; what presses it are the rollers, at the
front bar those that are faster than it, behind those that it has to push. So rollers leave the load zone
ahead of their pockets, fall back on the way round, and the cage comes out slower than rolling by about the
play of the pockets on the way through the zone.

Places are azimuths. Tables at the pockets (`POCKET_COSINE` and following, series of the bending) are made
anew for the places of the rollers at the beginning of each block of 20 ms; in between a roller is ahead of
its table by a small angle.

The bars lean. That is what centres the cage: upright ones leave it to whirl with its rollers, and to slip
twice as much.

Neglected: skew, pocket ends, lands that guide cages, what the cup's film takes an idle roller along with,
and the whirl of cages out of their plane.

References
----------
Harris and Kotzalas (2006), Advanced Concepts of Bearing Technology, ch. 2 and 3: forces on a cage, and skid;
Johnson and Tevaarwerk (1977): traction in proportion to small slip, up to a limit.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.effects import (
    Cage,
    CoulombTraction,
    EffectSet,
    KinematicCage,
    LoadSharingTraction,
    ShearedFilmTraction,
)
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.rigid_bodies import row_totals
from beardyn_core.physics.cage.pocket_film import (
    PocketFilmParams,
    along_bar,
    pocket_film_params,
    pocket_loads,
)
from beardyn_core.physics.cage.pocket_wear import pocket_wear
from beardyn_core.physics.cage.rubbing import surface_speed
from beardyn_core.physics.cage.walls import partial_contact_mean
from beardyn_core.physics.drag import drag_push
from beardyn_core.physics.lanes.lane_math import at_least, at_most, magnitude, where_greater
from beardyn_core.scene.scene import Scene

# Sums over the rollers of a row: force on the cage up and forward [N], moment about its axis [N m], and
# friction of the bars on the rollers that spin there [N].
CAGE_UP, CAGE_FORWARD, CAGE_ABOUT, CAGE_RUBBED = range(layout.REACTION + 14, layout.REACTION + 18)
# Fields of the rollers' state that the full tier has for its chatter index: azimuth of the tables, and in the
# state of a cage: friction of its bars, summed since torques were worked out.
TABLE = layout.CHATTER
RUBBED = layout.CHANGE
_X, _Z = 0, 2

_LIMITING_SHEAR = 0.045  # of an oil film over the pressure, [-]
_SLIDE = 0.01  # slip over rolling speed at which the film reaches it
_SLOWEST = 0.05  # [m/s]
# Surface speed of the rollers [m/s] below which pockets are dry, and from which on they have their film: the
# explicit cage sways with a film that is slower, by 4 % of its speed at 20 rpm (docs/evidence/light.md).
_DRY_BELOW, _FILM_FROM = 0.4, 0.6
_LONGEST_LOOSE_STEP = 1.001 / 25_600.0  # [s]


class LooseParams(NamedTuple):
    """Rollers that move in the pockets of their cages, with their cages."""

    stiffness: float  # of both touches of a bar [N/m]
    damping: float  # [N s/m]
    half_clearance: float  # along the pitch circle [m]
    bar_cosine: float  # of the lean of the bars against the radius
    bar_sine: float
    friction: float  # of the bars
    regularisation: float  # [m/s]
    traction: float  # limit of both raceways' traction over the load on the cone
    slide: float  # slip over rolling speed at which it is reached
    slowest: float  # rolling speed below which the slip at the limit stays the same [m/s]
    mass: float  # of a cage [kg]
    polar_inertia: float  # [kg m^2]
    fall: float  # [m/s^2]
    rubbing: float  # torque on the shaft over the friction of the bars [m]
    film: PocketFilmParams | None  # of a whole bar


def loose_params(scene: Scene, step: float) -> LooseParams | None:
    """Work out the pockets in which rollers move; none without a cage, or with a prescribed one.

    Cages are explicit: against all pockets of a row they follow steps up to a waveform sample. In longer
    ones, which are for loads and deflections of a held cup, rollers stay in the middle of their pockets.

    Traction is in proportion to the slip up to a limit, see `_limiting_traction`.

    References
    ----------
    Johnson and Tevaarwerk (1977), Fig. 4: a film reaches its limit at slips of some percent.
    """
    cage, bearing = scene.effects.cage, scene.bearing
    if cage is None or isinstance(cage, KinematicCage):
        return None
    if step > _LONGEST_LOOSE_STEP:
        return None
    lean = cage.bar_inclination if isinstance(cage, Cage) else 0.0
    return LooseParams(
        stiffness=2.0 * bearing.cage.stiffness,
        damping=2.0 * bearing.cage.damping,
        half_clearance=0.5 * (bearing.cage.circumferential_clearance + cage.pocket_wear),
        bar_cosine=math.cos(lean),
        bar_sine=math.sin(lean),
        friction=cage.friction,
        regularisation=cage.regularisation_speed,
        traction=2.0 * _limiting_traction(scene.effects),
        slide=_SLIDE,
        slowest=_SLOWEST,
        mass=bearing.cage.mass,
        polar_inertia=bearing.cage.polar_inertia,
        fall=scene.effects.gravity.acceleration if scene.effects.gravity else 0.0,
        rubbing=surface_speed(bearing),
        film=along_bar(pocket_film_params(scene, step)),
    )


def _limiting_traction(effects: EffectSet) -> float:
    """Take the largest friction of a raceway over its load from the law of friction, if it has such a number.

    The coefficient of dry friction where there is no film, the limiting shear stress over the pressure of a
    film that shears. The other laws, and rollers that only roll, have the usual limiting shear stress: the
    limit of a blend depends on the film, and that of fits on speed and load.

    References
    ----------
    Bair and Winer (1979) for the limiting shear stress.
    """
    law = effects.traction
    if isinstance(law, CoulombTraction):
        return law.friction
    if law is not None and effects.film is None:
        return law.boundary_friction
    if isinstance(law, ShearedFilmTraction):
        return law.limiting_shear
    if isinstance(law, LoadSharingTraction) and law.film_traction == "bair_winer":
        return law.limiting_shear
    return _LIMITING_SHEAR


@inline
def begin_block(lanes, rollers, bodies, pockets, basis, loose):
    """Make the tables for the places of the rollers at the beginning of a block."""
    if loose is None:
        return
    turn, width = bodies[layout.CAGE_BODY, layout.TURN], rollers.shape[2]
    for block in range(rollers.shape[0]):
        for lane in range(width):
            place = rollers[block, layout.ANGLE, lane] - turn
            cosine, sine = math.cos(place), math.sin(place)
            counted = pockets[block, layout.COUNTED, lane]
            rollers[block, TABLE, lane] = place
            pockets[block, layout.POCKET_COSINE, lane] = cosine
            pockets[block, layout.POCKET_SINE, lane] = sine
            pockets[block, layout.COUNTED_COSINE, lane] = counted * cosine
            pockets[block, layout.COUNTED_SINE, lane] = counted * sine
            _begin_waves(basis, block, lane, cosine, sine)


@inline
def _begin_waves(basis, block, lane, cosine, sine):
    """Write the series of the bending at a roller."""
    if basis is None:
        return
    waves = basis.shape[1] // 2
    c, s = cosine, sine
    for n in range(1, waves + 1):
        basis[block, n, lane], basis[block, waves + n, lane] = c, s
        c, s = c * cosine - s * sine, s * cosine + c * sine


@inline
def move_loose(rollers, bodies, step, k, loose):
    """Move the rollers along the pitch circle and the cages across."""
    if loose is None:
        return
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        for i in range(3):
            bodies[body, layout.POSITION + i] += step * bodies[body, layout.LINEAR + i]
    ahead = step / k.radius
    for block in range(rollers.shape[0]):
        for lane in range(rollers.shape[2]):
            rollers[block, layout.ANGLE, lane] += ahead * rollers[block, layout.VELOCITY + 1, lane]


@inline
def drift(lanes, rollers, block, turn, loose):
    """Take how far the rollers are ahead of their tables, [rad]; ``None`` where they never are."""
    if loose is None:
        return None
    return lanes.load(rollers, block, layout.ANGLE) - lanes.load(rollers, block, TABLE) - lanes.constant(turn)


@inline
def ahead_of(cosine, sine, angle):
    """Turn a direction by a small angle, of a few hundredths at most; none for ``None``."""
    if angle is None:
        return cosine, sine
    square = angle * angle
    turned, aside = 1.0 - 0.5 * square, angle * (1.0 - square * (1.0 / 6.0))
    return cosine * turned - sine * aside, sine * turned + cosine * aside


@inline
def clear_cages(lanes, sums, loose):
    """Start the sums of the forces on the cages."""
    if loose is None:
        return
    for field in (CAGE_UP, CAGE_FORWARD, CAGE_ABOUT, CAGE_RUBBED):
        lanes.store(sums, 0, field, lanes.constant(0.0))


@inline
def of_rows(lanes, bodies, field, side):
    """Take a number of each row's cage for the lanes of the rows."""
    first, last = bodies[layout.CAGE_BODY, field], bodies[bodies.shape[0] - 1, field]
    return lanes.constant(0.5 * (first + last)) + (0.5 * (last - first)) * side


@inline
def see_cages(lanes, bodies, side, loose):
    """Show the cages to the lanes: place and velocity across against the cup, and turn and rate, 6 values."""
    if loose is None:
        return None
    return (
        of_rows(lanes, bodies, layout.POSITION + _Z, side) - bodies[layout.CUP_BODY, layout.POSITION + _Z],
        of_rows(lanes, bodies, layout.POSITION + _X, side) - bodies[layout.CUP_BODY, layout.POSITION + _X],
        of_rows(lanes, bodies, layout.LINEAR + _Z, side) - bodies[layout.CUP_BODY, layout.LINEAR + _Z],
        of_rows(lanes, bodies, layout.LINEAR + _X, side) - bodies[layout.CUP_BODY, layout.LINEAR + _X],
        of_rows(lanes, bodies, layout.TURN, side),
        of_rows(lanes, bodies, layout.RATE, side),
    )


@inline
def bar_loads(depth, closing, spin, radius, step, loose):
    """Work out what the nearer bar presses a roller with, and its friction against the spin, [N].

    Spring, damper, film and friction are those of both touches of a bar in the full cage, see `walls`.
    ``depth``: approach beyond touching, negative for a gap [m]; ``closing``: its speed; ``spin``: speed of
    the roller's surface along the bar [m/s].
    """
    inside = at_least(depth, 0.0)
    spring = loose.stiffness * partial_contact_mean(inside, closing, step)
    damper = where_greater(depth, 0.0, loose.damping * closing, 0.0 * closing)
    bare = at_least(spring + damper, 0.0)
    load, solid, shear = pocket_loads(depth, spring + damper, closing, magnitude(spin), radius, loose.film)
    film = at_most(at_least((magnitude(spin) - _DRY_BELOW) / (_FILM_FROM - _DRY_BELOW), 0.0), 1.0)
    load, solid = bare + film * (load - bare), bare + film * (solid - bare)
    dry = loose.friction / math.sqrt(spin * spin + loose.regularisation * loose.regularisation)
    return load, -spin * (dry * solid + film * shear)


@inline
def push_loose(lanes, rollers, sums, block, direction, cages, motion, shake, speeds, load, counted, p, loose):
    """Change the speed of a block of rollers, and sum what they do to their cages.

    ``direction`` (2 vectors): cosine and sine of their azimuths; ``cages``: of `see_cages`; ``motion``: of
    the cone against the cup, `kinematic_rollers.relative_cone`; ``shake``: acceleration of the cup up and
    forward [m/s^2]; ``load``: on the cone [N]. Returns what traction drives them with, [N], half of it from
    the cup, and what accelerates them, [N].
    """
    if loose is None:
        return 0.0 * load, 0.0 * load
    k, step, mass = p.kinematic, p.step, p.base.roller.mass
    cosine, sine = direction
    up, forward, rise, advance, turn, rate = cages
    speed = lanes.load(rollers, block, layout.VELOCITY + 1)
    pocket = turn + lanes.load(p.base.rollers, block, layout.POCKET_ANGLE)
    offset = k.radius * (lanes.load(rollers, block, layout.ANGLE) - pocket) - (cosine * forward - sine * up)
    going = speed - k.radius * rate - (cosine * advance - sine * rise)
    play = loose.half_clearance + pocket_wear(lanes, block, p.base.effects.faults.pockets)
    towards = where_greater(offset, 0.0, 1.0 + 0.0 * offset, -1.0 + 0.0 * offset)
    radial = lanes.load(rollers, block, layout.RADIUS) - k.radius - (cosine * up + sine * forward)
    outgoing = lanes.load(rollers, block, layout.VELOCITY) - (cosine * rise + sine * advance)
    depth = loose.bar_cosine * (magnitude(offset) - play) + loose.bar_sine * radial
    closing = loose.bar_cosine * (towards * going) + loose.bar_sine * outgoing
    spin = k.spin_ratio * speeds[1] * p.base.roller.radius
    pressed, rubbed = bar_loads(depth, closing, spin, p.base.roller.radius, step, loose)
    push = loose.bar_cosine * (towards * pressed)

    medium = drag_push(speeds, k, p.base.effects.drag)
    medium = medium * (speeds[1] / math.sqrt(speeds[1] * speeds[1] + 1e-12))
    aside = cosine * shake[1] - sine * shake[0]
    coasting = speed + step * ((loose.fall * sine - aside) - (push + medium) * (1.0 / mass))
    rolling = k.cage_ratio * k.radius * speeds[0] + 0.5 * (cosine * motion[0][1] - sine * motion[2][1])
    scale = at_least(magnitude(rolling), loose.slowest)
    grip = loose.traction * load / (loose.slide * scale)
    most = loose.traction * load
    drive = grip * (rolling - coasting) / (1.0 + (step / mass) * grip)
    drive = at_most(at_least(drive, -most), most)
    after = coasting + (step / mass) * drive
    lanes.store(rollers, block, layout.VELOCITY + 1, after)

    outward = loose.bar_cosine * (towards * rubbed)
    onward, lift = counted * push, counted * (outward + loose.bar_sine * pressed)
    _add(lanes, sums, CAGE_UP, lift * cosine - onward * sine)
    _add(lanes, sums, CAGE_FORWARD, lift * sine + onward * cosine)
    _add(lanes, sums, CAGE_ABOUT, k.radius * onward)
    _add(lanes, sums, CAGE_RUBBED, counted * rubbed)
    return counted * drive, (counted * mass) * ((after - speed) * p.motion.rate + aside)


@inline
def _add(lanes, sums, field, value):
    lanes.store(sums, 0, field, lanes.load(sums, 0, field) + value)


@inline
def pass_traction(loads, direction, drive, cosine, loose):
    """Add the cup's half of the traction to the sums of its loads, as loads along the cup's normal.

    ``direction`` (2 vectors): in the cages' frame; ``cosine``: of the cup angle.
    """
    if loose is None:
        return loads
    half = drive * (0.5 / cosine)
    return loads[0], loads[1] + half * direction[1], loads[2] - half * direction[0]


@inline
def with_cages(kept, sums, bodies, loose):
    """Add what accelerates the cages to the wrench that accelerates the rollers."""
    if loose is None:
        return kept
    up, forward = row_totals(sums, CAGE_UP), row_totals(sums, CAGE_FORWARD)
    weight = loose.fall * loose.mass * (bodies.shape[0] - layout.CAGE_BODY)
    return (
        kept[0] + (forward[0] + forward[1]),
        kept[1],
        kept[2] + (up[0] + up[1] - weight),
        kept[3],
        kept[4],
        kept[5],
    )


@inline
def kick_cages_across(bodies, sums, step, before, loose):
    """Accelerate the cages; ``before`` (2 floats): their speeds before the rings set those of rolling."""
    if loose is None:
        return
    up, forward = row_totals(sums, CAGE_UP), row_totals(sums, CAGE_FORWARD)
    about, rubbed = row_totals(sums, CAGE_ABOUT), row_totals(sums, CAGE_RUBBED)
    first = (up[0], forward[0], about[0], rubbed[0])
    last = (up[1], forward[1], about[1], rubbed[1])
    if bodies.shape[0] == layout.CAGE_BODY + 1:
        _kick_cage(bodies, layout.CAGE_BODY, add_four(first, last), before[0], step, loose)
        return
    _kick_cage(bodies, layout.CAGE_BODY, first, before[0], step, loose)
    _kick_cage(bodies, layout.CAGE_BODY + 1, last, before[1], step, loose)


@inline
def add_four(one, other):
    """Add two rows of four numbers."""
    return one[0] + other[0], one[1] + other[1], one[2] + other[2], one[3] + other[3]


@inline
def _kick_cage(bodies, body, push, rate, step, loose):
    bodies[body, layout.LINEAR + _Z] += step * (push[0] / loose.mass - loose.fall)
    bodies[body, layout.LINEAR + _X] += step * (push[1] / loose.mass)
    bodies[body, layout.RATE] = rate + step * push[2] / loose.polar_inertia
    bodies[body, RUBBED] += push[3]


@inline
def cage_rates(bodies, loose):
    """Take the speeds of the cages of both rows, [rad/s]."""
    if loose is None:
        return 0.0, 0.0
    return bodies[layout.CAGE_BODY, layout.RATE], bodies[bodies.shape[0] - 1, layout.RATE]


@inline
def rubbing_torque(bodies, steps, loose):
    """Work out the torque of the pockets since it was last asked for, along the shaft's rotation, [N m]."""
    if loose is None:
        return 0.0
    rubbed = 0.0
    for body in range(layout.CAGE_BODY, bodies.shape[0]):
        rubbed += bodies[body, RUBBED]
        bodies[body, RUBBED] = 0.0
    return loose.rubbing * (rubbed / steps)


@inline
def keep_loose(lanes, rollers, block, place, loose):
    """Write the azimuth and speed that `show_roller` has taken from the cages; ``place``: both, from
    before.
    """
    if loose is None:
        return
    lanes.store(rollers, block, layout.ANGLE, place[0])
    lanes.store(rollers, block, layout.VELOCITY + 1, place[1])
