"""Laminae of a raceway contact: what each presses and rubs with, and the sums over all of them.

An intact lamina is one spring, near a patch it is two: its intact and its damaged part. Laminae that are
coupled are prepared all at once. What leaves the loop are sums weighted by powers of the abscissa.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.friction_substeps import forget, held_friction, keep_friction, remember
from beardyn_core.physics.bodies.layout import LAMINA_DROP, LAMINA_PLACE
from beardyn_core.physics.bodies.stage_timer import mark_result
from beardyn_core.physics.bodies.step_stages import CONTACT, FILM, TRACTION
from beardyn_core.physics.defect import soften_by_edges, spring_damage, spring_slopes, springs_of
from beardyn_core.physics.film import log2_film_thickness, log2_load
from beardyn_core.physics.lamina_coupling import (
    DEPTH,
    FORCE,
    SURFACE,
    couple_laminae,
    joint_depth,
    joint_share,
    joint_slopes,
)
from beardyn_core.physics.lanes.lane_math import at_least, at_most, magnitude, where_greater
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.slice_law import force_share, slice_tangent, stored_share
from beardyn_core.physics.traction import LaminaContact, friction_rate, load_sharing_coefficient

SMALLEST_APPROACH = 1e-15
# A spring of less of its lamina is rounding of one that is not there.
SMALLEST_SHARE = 1e-6
_LOADS = 0  # the work space has one page


class GapSums(NamedTuple):
    """What gaps that move under the springs of a contact add to its sums; twos are with x^0, x^1."""

    ring: Any  # 2, tangent stiffness times slope of the gap over the azimuth in the ring [N/rad m^k]
    roller: Any  # 2, over the azimuth in the roller
    rate: Any  # 2, tangent stiffness times rate of the gap [N/s m^k]
    squares: Any  # tangent stiffness times the squared rate of the gap [N m/s^2]


class LaminaSums(NamedTuple):
    """Sums over the laminae of one raceway contact; threes are with x^0, x^1, x^2."""

    force: Any  # 3, elastic [N m^k]
    stiffness: Any  # 3, tangent [N/m m^k]
    friction: Any  # 5, force over slip, of which only barrels use the last two [N s/m m^k]
    energy: Any  # elastic [J]
    lean: Any  # 2, force times slope of the gap over the azimuth in ring and roller [N m/rad]
    touches: bool  # whether any roller of the block may touch; else all sums are exactly zero
    released: Any  # 3, what dampers take where a contact opens faster than its springs follow, see `_release`
    deepest: Any  # largest penetration [m]
    gap: Any  # GapSums, zeros where no spring is near a patch


class Raceway(NamedTuple):
    """What the laminae of one raceway contact share."""

    lanes: Any
    ring: int
    laminae: Any  # lamina table [row of the table, lamina]
    work: Any  # [1, 2 x lamina, lane], for the loads of the springs [N]
    reach: float  # no lamina is farther from the centre of mass [m]
    effects: Any
    turning: Any  # 2, rates of the contact's azimuth in ring and roller [rad/s], used near a patch
    times: Any  # 2, the step, and the time over which springs are implicit [s]
    held: Any  # Held
    ellipse: Any  # EllipseParams of barrels, None for other rollers


@inline
def lamina_sums(raceway, line, slip, log2_speed, near, damage):
    """Sum the laminae of one raceway contact to `LaminaSums`; far from every patch a damaged one is intact.

    ``log2_speed`` (2 numbers): from `film.log2_entrainment`; ``near``: whether any roller of the block is
    near a patch, from `defect.find_damage`.

    References
    ----------
    Palmgren's line contact, Q = 0.356 E' L^(8/9) delta^(10/9) for one contact, shared evenly by laminae.
    """
    if damage is None:
        return _sound_sums(raceway, line, slip, log2_speed)
    if near:
        forget(raceway.held, raceway.held.params)
        return _spring_sums(raceway, line, slip, log2_speed, damage)
    return _sound_sums(raceway, line, slip, log2_speed)


@inline
def _sound_sums(raceway, line, slip, log2_speed):
    """Sum an intact contact: a block of rollers of which none touches costs one bound."""
    deepest = deepest_approach(line.approach, raceway.reach, raceway.ellipse)
    if may_touch(raceway.lanes, deepest, raceway.reach):
        return _spring_sums(raceway, line, slip, log2_speed, None)
    zero = raceway.lanes.constant(0.0)
    forget(raceway.held, raceway.held.params)
    nothing = (zero, zero, zero)
    level = (zero, zero)
    gap = GapSums(level, level, level, zero)
    return LaminaSums(
        nothing, nothing, (zero, zero, zero, zero, zero), zero, level, False, nothing, deepest[0], gap
    )


@inline
def deepest_approach(approach, reach, ellipse):
    """Take factors of an approach that bounds what slices within a reach sink: of a barrel its deepest."""
    if ellipse is None:
        return approach
    zero = 0.0 * approach[0]
    place = at_most(at_least(-0.5 * approach[1] / approach[2], -reach), reach)
    return approach[0] + place * (approach[1] + place * approach[2]), zero, zero, zero


@inline
def may_touch(lanes, approach, reach):
    """Check whether any lane may penetrate within a reach of the middle; a NaN may, too."""
    slope = magnitude(approach[1]) + reach * (magnitude(approach[2]) + reach * magnitude(approach[3]))
    zero = lanes.constant(0.0)
    return any_positive(where_greater(zero, approach[0] + reach * slope, zero, 1.0))


@inline
def _spring_sums(raceway, line, slip, log2_speed, damage):
    """Sum over the springs in two passes, as short loops keep several laminae in flight."""
    lanes, work, effects = raceway.lanes, raceway.work, raceway.effects
    laminae, approach = raceway.laminae, line.approach
    zero = lanes.constant(0.0)
    force, stiffness = (zero, zero, zero), (zero, zero, zero)
    energy = zero
    lean = (zero, zero)
    released = (zero, zero, zero)
    gap = GapSums(lean, lean, lean, zero)
    deepest = deepest_approach(approach, raceway.reach, raceway.ellipse)[0] if damage is None else zero
    count = laminae.shape[1]
    prepare_coupling(lanes, approach, laminae, damage, effects.coupling)
    laminae, springs = springs_of(laminae, damage, effects.coupling)
    for k in range(springs):
        x = laminae[LAMINA_PLACE, k]
        share, depth, tangent, stored = contact_spring(
            lanes, approach, k, laminae, damage, effects.coupling, raceway.ellipse
        )
        touching = at_least(depth, SMALLEST_APPROACH)
        energy = energy + stored
        slopes = _slopes_of(lanes, k, touching, count, damage, effects.coupling)
        gap_rate = _gap_rate(slopes, raceway.turning, damage)
        rate = _less_gap_rate(slip.rate[0] + x * slip.rate[1], gap_rate, damage)
        pressing = _partial_contact_mean(touching, depth, rate, raceway.times)
        part = force_share(raceway.ellipse)
        push = _spring_push(part, pressing, rate, effects.damping)
        whole = share * (part * tangent * touching)
        tangent = where_greater(push, 0.0, tangent, 0.0 * depth)
        lost = whole - share * (part * tangent * touching)
        elastic = part * tangent * pressing
        load = tangent * push
        lanes.store(work, _LOADS, k, load)
        lean = _add_lean(lean, share * load, slopes, damage)
        elastic, tangent = share * elastic, share * tangent
        gap = _add_gap(gap, tangent, x, slopes, gap_rate, damage)
        released = _release(released, lost, x, effects.damping, effects.audit)
        released = _release_gap(released, lost * gap_rate, damage)
        deepest = _deepest_so_far(deepest, share, depth, damage)
        force, stiffness = add_moments(force, elastic, x), add_moments(stiffness, tangent, x)
    friction = _friction_sums(raceway, slip, log2_speed, (laminae, springs), damage, raceway.ellipse)
    return LaminaSums(force, stiffness, friction, energy, lean, True, released, deepest, gap)


@inline
def _friction_sums(raceway, slip, log2_speed, table, damage, ellipse):
    """Sum the friction over slip of the springs with x^0, x^1, x^2, [N s/m m^k].

    ``table``: of the laminae of the springs, and how many there are.
    """
    lanes, ring, work, effects, held = (
        raceway.lanes, raceway.ring, raceway.work, raceway.effects, raceway.held,
    )  # fmt: skip
    laminae, springs = table
    zero = lanes.constant(0.0)
    friction = (zero, zero, zero, zero, zero)
    if held.recalled:
        for k in range(springs):
            rate = held_friction(held, k, lanes.load(work, _LOADS, k), held.params)
            friction = _add_friction(friction, rate, laminae[LAMINA_PLACE, k], ellipse)
        return friction
    for k in range(springs):
        x = laminae[LAMINA_PLACE, k]
        load = lanes.load(work, _LOADS, k)
        around = slip.around[0] + x * slip.around[1]
        if ellipse is not None:
            around = around + x * (x * slip.sag)
        along = slip.along[0] + x * slip.along[1]
        square = around * around + along * along
        mark_result(effects.timers, CONTACT, square)
        log2_force = log2_load(load)
        log2_film = log2_film_thickness(log2_force, log2_speed, k, ring, laminae, effects.film)
        mark_result(effects.timers, FILM, log2_film)
        contact = LaminaContact(load, log2_force, square, log2_film, log2_speed[1], k, ring, laminae)
        rate = _friction_rate(contact, held, effects, held.params, damage)
        mark_result(effects.timers, TRACTION, rate)
        share = _share_of(lanes, k, damage, effects.coupling)
        friction = _add_friction(friction, share * rate, x, ellipse)
    _remember(held, lanes.load(work, _LOADS, springs // 2), damage)
    return friction


@inline
def _add_friction(sums, value, x, ellipse):
    """Add a value at an abscissa to its sums with x^0 to x^2, along a barrel to x^4."""
    if ellipse is None:
        return sums[0] + value, sums[1] + value * x, sums[2] + value * (x * x), sums[3], sums[4]
    square, first = x * x, value * x
    return (
        sums[0] + value,
        sums[1] + first,
        sums[2] + value * square,
        sums[3] + first * square,
        sums[4] + value * (square * square),
    )


@inline
def _friction_rate(contact, held, effects, params, damage):
    """Work out the friction of a lamina over slip speed, [N s/m], and keep it far from every patch."""
    if params is None:
        return friction_rate(contact, effects)
    coefficient = load_sharing_coefficient(contact, effects.film, effects.load_sharing)
    _keep(held, contact.lamina, coefficient, damage)
    return contact.load * coefficient


@inline
def _keep(held, lamina, coefficient, damage):
    if damage is None:
        keep_friction(held, lamina, coefficient, held.params)


@inline
def _remember(held, load, damage):
    """Take note of the load of the middle, [N], where friction was kept: far from every patch."""
    if damage is None:
        remember(held, load, held.params)


@inline
def add_moments(sums, value, x):
    """Add a value at an abscissa to its sums with x^0, x^1, x^2."""
    return sums[0] + value, sums[1] + value * x, sums[2] + value * (x * x)


@inline
def _spring_push(part, approach, rate, damping):
    """Add the part of the approach that presses and the damping: tangent stiffness times this is force, [m].

    ``part``: of `slice_law.force_share`.
    """
    if damping is None:
        return part * approach
    return part * approach + damping.time_constant * rate


@inline
def _release(released, lost, x, damping, audit):
    """Add what the damper of one spring takes where the contact opens faster than the spring follows.

    A contact does not pull: the spring then expands against its own damper, and its energy ends there. What
    is lost of its force belongs to the stored energy and presses no more, [N]: summed with x^0 and x^1.
    """
    if damping is None:
        return released
    if audit is None:
        return released
    return released[0] + lost, released[1] + lost * x, released[2]


@inline
def _release_gap(released, power, damage):
    """Add what a gap that moves takes from a spring that presses no more, [W]."""
    if damage is None:
        return released
    return released[0], released[1], released[2] + power


@inline
def released_power(released, rate):
    """Work out the power that dampers take where a contact opens faster than its springs follow, [W].

    ``released`` (3 numbers): of `LaminaSums`; ``rate`` (2 numbers): of approach, affine in the abscissa
    [m/s].
    """
    return released[2] - (released[0] * rate[0] + released[1] * rate[1])


@inline
def _deepest_so_far(deepest, share, depth, damage):
    """Take the larger penetration of springs near a patch; of an intact contact that at its middle, [m]."""
    if damage is None:
        return deepest
    return at_least(deepest, where_greater(share + 0.0 * depth, SMALLEST_SHARE, depth, 0.0 * depth))


@inline
def _geometric_depth(approach, gap, k, laminae):
    """Work out the penetration of one lamina or spring, negative when apart, [m]."""
    x = laminae[LAMINA_PLACE, k]
    return (
        approach[0] + x * (approach[1] + x * (approach[2] + x * approach[3])) - laminae[LAMINA_DROP, k] - gap
    )


@inline
def prepare_coupling(lanes, approach, laminae, damage, coupling):
    """Load the springs of coupled laminae all at once; one over the edge of a patch joins as one."""
    if coupling is None:
        return
    for k in range(laminae.shape[1]):
        depth = _geometric_depth(approach, 0.0, k, laminae)
        depth = joint_depth(lanes, depth, k, laminae.shape[1], damage, coupling.part_exponent)
        lanes.store(coupling.work, DEPTH, k, depth)
    couple_laminae(lanes, laminae, coupling)


@inline
def contact_spring(lanes, approach, k, laminae, damage, coupling, ellipse):
    """Load one spring of a raceway contact.

    ``approach`` (4 numbers): as in `Line` [m]; ``k``: the spring; ``laminae``: of its springs;
    ``ellipse``: `EllipseParams` of barrels or ``None``. Returns
    ``share``, ``depth``, ``tangent``, ``energy``: share of its lamina [-], by which force, stiffness and
    damping of the contact are multiplied, penetration [m], tangent stiffness [N/m], energy [J].
    """
    if coupling is None:
        share, gap = spring_damage(lanes, k, damage)
        depth = _geometric_depth(approach, gap, k, laminae)
        touching = at_least(depth, SMALLEST_APPROACH)
        tangent = slice_tangent(touching, k, laminae, ellipse)
        tangent = soften_by_edges(lanes, where_greater(depth, 0.0, tangent, 0.0 * depth), k, damage)
        return share, depth, tangent, share * tangent * touching * touching * stored_share(ellipse)
    work = coupling.work
    share, energy = joint_share(lanes, k, damage), lanes.load(work, FORCE, k)
    return share, lanes.load(work, DEPTH, k) / share, lanes.load(work, SURFACE, k) * share, energy


@inline
def _share_of(lanes, k, damage, coupling):
    """Take the share of its lamina of a spring, [-]."""
    if coupling is None:
        return spring_damage(lanes, k, damage)[0]
    return joint_share(lanes, k, damage)


@inline
def _add_lean(lean, load, slopes, damage):
    """Add the force of a spring times the slope of its gap over the azimuth in ring and roller, [N m/rad]."""
    if damage is None:
        return lean
    return lean[0] + load * slopes[0], lean[1] + load * slopes[1]


@inline
def _partial_contact_mean(touching, depth, rate, times):
    """Take what a spring presses with where its contact begins or ends within a step, [m].

    A roller that its pocket throws, or that falls through a patch, strikes with up to 1 m/s and moves
    several micrometres in a step. With all of the force at its first instant of contact the spring takes in
    k u^2 h^2 / 12 more than it stores, u being the speed and h the step, and gives that much more at the
    last one: what is missing is that of the speed that the strike has cost. The implicit part of the spring,
    b h, gives back k u^2 b h^2 / 2 of it; the rest comes off the force of these instants. That is exact in
    the mean over their places in the step; for a linear spring it is so at each place with b = 0. With b
    beyond 1/6 nothing is left to come off. More force there would even the mean, too, but what single strikes
    give would differ by 1.4 times as much, and with 6 times the usual step rollers fly apart by it.
    """
    step, spring_time = times
    way = at_least(magnitude(rate) * step, SMALLEST_APPROACH)
    part = max(0.5 - 3.0 * spring_time / step, 0.0) * at_least(1.0 - depth / way, 0.0)
    return touching * (1.0 - part)


@inline
def _gap_rate(slopes, turning, damage):
    """Work out the rate at which the gap under a spring grows, [m/s]."""
    if damage is None:
        return 0.0
    return slopes[0] * turning[0] + slopes[1] * turning[1]


@inline
def _less_gap_rate(rate, gap_rate, damage):
    """Take the rate at which the gap under a spring grows off the rate of approach, [m/s]."""
    if damage is None:
        return rate
    return rate - gap_rate


@inline
def _add_gap(gap, tangent, x, slopes, gap_rate, damage):
    """Add one spring to the sums of moving gaps."""
    if damage is None:
        return gap
    ring, roller = tangent * slopes[0], tangent * slopes[1]
    moving = tangent * gap_rate
    return GapSums(
        (gap.ring[0] + ring, gap.ring[1] + ring * x),
        (gap.roller[0] + roller, gap.roller[1] + roller * x),
        (gap.rate[0] + moving, gap.rate[1] + moving * x),
        gap.squares + moving * gap_rate,
    )


@inline
def _slopes_of(lanes, k, depth, count, damage, coupling):
    """Take by how much a spring gives way with the azimuth in ring and in roller at a depth [m], [m/rad]."""
    if damage is None:
        return 0.0, 0.0
    if coupling is None:
        return spring_slopes(lanes, k, depth, damage)
    return joint_slopes(lanes, k, count, damage)
