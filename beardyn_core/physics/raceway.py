"""Contact of a laminated roller with a conical raceway within a time step: prepare, stiffen, push, settle."""

from __future__ import annotations

from typing import Any, NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.barrel_line import barrel_line
from beardyn_core.physics.bodies.contact_output import (
    ContactOutput,
    account,
    account_loss,
    output_contact,
    react,
    watch_chatter,
    watch_largest,
)
from beardyn_core.physics.bodies.friction_substeps import hold_contact
from beardyn_core.physics.bodies.layout import LOSS_DAMPING, LOSS_SLIDING, PENETRATION
from beardyn_core.physics.bodies.orbit import Body, entrainment_speed
from beardyn_core.physics.contact_damping import damper_time, implicit_time
from beardyn_core.physics.defect import find_damage
from beardyn_core.physics.film import film_output, log2_entrainment
from beardyn_core.physics.generator_line import (
    Line,
    add_change,
    affine_change,
    generator_line,
    line_slip,
    line_wrench,
    normal_change,
    power,
    power_around,
    sag_change,
    weigh_affine,
    weigh_around,
)
from beardyn_core.physics.laminae import LaminaSums, Raceway, deepest_approach, lamina_sums, released_power
from beardyn_core.physics.lanes.lane_math import at_least, at_most, sqrt
from beardyn_core.physics.lanes.solve import add_line, add_line_everywhere, add_twists
from beardyn_core.physics.lanes.vectors import Vector, Wrench, add_scaled, cross, dot, scale, subtract
from beardyn_core.physics.traction import traction_capacity
from beardyn_core.physics.waviness import (
    add_leaning,
    add_leaning_change,
    bend_line,
    crown_bend,
    lean_wrench,
    shift_line,
    wave_gap,
)


class RingFaults(NamedTuple):
    """Faults of one ring and of the rollers that meet it; ``None`` is absent."""

    surface: Any
    roller_surface: Any
    damage: Any
    waves: Any
    roller_waves: Any


class Ring(NamedTuple):
    """A ring that a roller meets."""

    number: int  # CUP or CONE
    raceway: Any  # RacewayParams
    faults: RingFaults
    ring_view: Any  # View, as the roller sees it


class RacewayContact(NamedTuple):
    """One raceway contact before the solve."""

    line: Line
    slip: Any  # from `line_slip`
    sums: LaminaSums
    lean: Wrench  # of sloping gaps
    log2_speed: Any  # from `log2_entrainment`
    centre: Vector  # of mass of the roller from the origin about which reactions are summed [m]
    body: Body
    damage: Any  # DamageParams, None on a surface without patches
    held: Any  # Held
    barrel: Any  # BarrelParams, None for other rollers


class Settled(NamedTuple):
    """One raceway contact after the solve, with its energy terms over the step."""

    wrench: Wrench
    normal: Any  # sums of the normal force with x^0, x^1, x^2 [N m^k]
    friction: Any  # around the ring [N]
    slid: Any  # dissipated by sliding [J]
    damped: Any  # by contact damping
    numerical: Any  # by the time step


@inline
def prepare_raceway(lanes, block, ring, body, oversize, azimuths, fresh, p):
    """Work out everything that one raceway contact needs before the solve: a `RacewayContact`."""
    faults, view = ring.faults, ring.ring_view
    centre = subtract(body.place, view.origin)
    ring_wave, ring_climb = wave_gap(lanes, block, azimuths[0], faults.waves)
    roller_wave, roller_climb = wave_gap(lanes, block, azimuths[1], faults.roller_waves)
    barrel = ring.raceway.barrel
    line = contact_line(centre, body.axis, view.axis, oversize, ring.raceway, p.roller, barrel)
    line = shift_line(line, ring_wave + roller_wave)
    crowns = p.effects.faults.crowns
    line = bend_line(line, crown_bend(lanes, block, crowns), crowns)
    slip = line_slip(line, centre, body, view, barrel)
    surfaces = (faults.surface, faults.roller_surface)
    near = find_damage(lanes, block, azimuths, p.laminae.shape[1], surfaces, faults.damage)
    ellipse, reach = ellipse_of(barrel), p.roller.half_length + abs(p.roller.mass_offset)
    middle = deepest_approach(line.approach, reach, ellipse)[0]
    held = hold_contact(lanes, block, ring.number, fresh or near, middle, p.held)
    log2_speed = _log2_speed(lanes, entrainment_speed(line, centre, body, view), held, p.effects.film)
    turning = contact_turning(body, view, faults.damage)
    times = (p.step, p.spring_time)
    shared = Raceway(
        lanes, ring.number, p.laminae, p.lamina_loads, reach, p.effects, turning, times, held, ellipse
    )
    sums = lamina_sums(shared, line, slip, log2_speed, near, faults.damage)
    lean = lean_wrench(
        lanes, body, sums, (ring_climb, roller_climb), faults.damage, faults.waves, faults.roller_waves
    )
    return RacewayContact(line, slip, sums, lean, log2_speed, centre, body, faults.damage, held, barrel)


@inline
def contact_line(centre, axis, ring_axis, oversize, raceway, roller, barrel):
    """Work out the contact line of a roller on a raceway, of a cone or of a barrel: a `Line`."""
    if barrel is None:
        return generator_line(centre, axis, ring_axis, oversize, raceway, roller)
    return barrel_line(centre, axis, ring_axis, oversize, raceway.side, barrel)


@inline
def ellipse_of(barrel):
    """Take how the slices of a barrel press; ``None`` for other rollers."""
    if barrel is None:
        return None
    return barrel.ellipse


@inline
def _log2_speed(lanes, speed, held, film):
    """Work out what friction needs of the entrainment speed; zeros where the memory has the friction."""
    zero = lanes.constant(0.0)
    if held.recalled:
        return zero, zero
    part, rolling = log2_entrainment(speed, film)
    return part + zero, rolling + zero


@inline
def contact_turning(body, view, damage):
    """Work out how fast the azimuths of a contact in its ring and in the roller grow, [rad/s].

    Zeros that nothing uses where no patch can be.
    """
    if damage is None:
        return 0.0 * body.orbit_rate, 0.0 * body.orbit_rate
    spin = dot(body.omega, body.axis) - body.orbit_rate * body.axis[2]
    return body.orbit_rate - dot(view.omega, view.axis), -spin


@inline
def stiffen_raceway(matrix, contact, p):
    """Add the implicit part of one raceway contact to the roller's matrix."""
    if not contact.sums.touches:
        return matrix
    line, stiffness, friction, step = contact.line, contact.sums.stiffness, contact.sums.friction, p.step
    time = step * implicit_time(p.spring_time, p.effects.damping)
    rough = scale(step, friction)
    matrix = add_line_everywhere(matrix, line.arm, line.arm_slope, rough)
    return _stiffen_normal(matrix, line, scale(time, stiffness), rough, contact.barrel)


@inline
def _stiffen_normal(matrix, line, stiff, rough, barrel):
    """Add what the springs resist; friction resists in every direction less along the normal."""
    if barrel is None:
        return add_line(matrix, line.normal, line.arm, line.arm_slope, subtract(stiff, rough))
    curve, normal = line.curve, cross(line.around, line.along)
    matrix = add_line(matrix, normal, line.arm, line.arm_slope, scale(-1.0, rough))
    return add_twists(matrix, (line.normal, curve.moment), (curve.turn, curve.moment_slope), stiff)


@inline
def push_raceway(contact, damping):
    """Work out the wrench on the roller from the velocities at the beginning of the step."""
    slip, sums = contact.slip, contact.sums
    normal = _normal_sums(sums.force, sums.stiffness, slip.rate, (sums.gap, contact.damage), damping)
    around = weigh_around(sums.friction, slip.around, slip.sag, contact.barrel)
    along = weigh_affine(sums.friction, slip.along)
    return add_leaning(line_wrench(contact.line, normal, around, along, contact.barrel), contact.lean)


@inline
def _normal_sums(elastic, stiffness, rate, gap, damping):
    """Add the damping to the elastic normal force with x^0, x^1, x^2, [N m^k].

    ``gap``: `GapSums`, and the damage or ``None``.
    """
    if damping is None:
        return elastic
    damped = _less_gap(weigh_affine(stiffness, rate), gap[0], gap[1])
    return (
        elastic[0] + damping.time_constant * damped[0],
        elastic[1] + damping.time_constant * damped[1],
        elastic[2],
    )


@inline
def _less_gap(damped, gap, damage):
    """Take what moving gaps give way off the rates of approach, weighted by the stiffness, [N/s m^k]."""
    if damage is None:
        return damped
    return damped[0] - gap.rate[0], damped[1] - gap.rate[1]


@inline
def settle_raceway(ring, contact, change, here, p):
    """Settle one raceway contact after the solve: reaction, output and audit.

    Returns the `Wrench` on the roller that the step ends with.
    """
    lanes = here.lanes
    wrench, normal, friction = _react(ring, contact, change, here, p)
    _output(ring, contact, wrench, normal, here, p)
    capacity = traction_capacity(normal[0], p.effects.coulomb, p.effects.mixed, p.effects.load_sharing)
    watch_chatter(here, ring, friction, capacity)
    deepest = at_least(lanes.load(here.rollers, here.block, PENETRATION), contact.sums.deepest)
    lanes.store(here.rollers, here.block, PENETRATION, deepest)
    watch_largest(lanes, here.rollers, here.block, ring, dot(wrench.force, wrench.force))
    return wrench


@inline
def _output(ring, contact, wrench, normal, here, p):
    """Write what the last step of a stretch gives of the contact; other steps are not read."""
    if not here.shown:
        return
    lanes, line, slip = here.lanes, contact.line, contact.slip
    # a grazing contact has hardly any force to divide by
    pressure_centre = normal[1] / at_least(normal[0], 1e-3)
    pressure_centre = at_most(at_least(pressure_centre, -p.roller.half_length), p.roller.half_length)
    arm = add_scaled(line.arm, pressure_centre, line.arm_slope)
    speed = sqrt(slip.around[0] * slip.around[0] + slip.along[0] * slip.along[0])
    film = film_output(normal[0], contact.log2_speed, ring, p.laminae, p.effects.film) + lanes.constant(0.0)
    output_contact(lanes, here.rollers, here.block, ring, ContactOutput(wrench.force, arm, speed, film))


@inline
def _react(ring, contact, change, here, p):
    """Add reaction and audit; wrench, normal force and friction after the solve, zeros without touch."""
    if not contact.sums.touches:
        zero = here.lanes.constant(0.0)
        nothing = (zero, zero, zero)
        return Wrench(nothing, nothing), nothing, zero
    settled = settled_contact(contact, change, p.step, p.spring_time, p.effects.damping)
    react(ring, contact.centre, settled.wrench, here)
    account_loss(here, LOSS_SLIDING, settled.slid, p.effects.audit)
    account_loss(here, LOSS_DAMPING, settled.damped, p.effects.audit)
    account(here, settled.numerical, contact.sums.energy, p.effects.audit)
    return settled.wrench, settled.normal, settled.friction


@inline
def settled_contact(contact, change, step, spring_time, damping):
    """Work out the wrench on the roller that the step ends with, and its energy terms: a `Settled`.

    Friction is that of the end of the step, contact damping that of its middle, and the spring takes in a
    share of what it changes by.
    """
    line, slip, sums, barrel = contact.line, contact.slip, contact.sums, contact.barrel
    d_rate = normal_change(line, change, barrel)
    d_around = affine_change(line, line.around, change)
    d_along = affine_change(line, line.along, change)
    middle_rate = add_change(slip.rate, d_rate, 0.5)
    spring = weigh_affine(sums.stiffness, d_rate)
    elastic = (
        sums.force[0] + spring_time * spring[0],
        sums.force[1] + spring_time * spring[1],
        sums.force[2],
    )
    normal = _normal_sums(elastic, sums.stiffness, middle_rate, (sums.gap, contact.damage), damping)
    around, along = add_change(slip.around, d_around, 1.0), add_change(slip.along, d_along, 1.0)
    d_sag = sag_change(line, change.omega, barrel)
    friction_around = weigh_around(sums.friction, around, slip.sag + d_sag, barrel)
    wrench = line_wrench(line, normal, friction_around, weigh_affine(sums.friction, along), barrel)
    wrench = add_leaning(wrench, contact.lean)
    further = spring_time + 0.5 * damper_time(damping)
    wrench = add_leaning_change(wrench, sums.gap, d_rate, further, contact.body, contact.damage)
    around, along = add_change(slip.around, d_around, 0.5), add_change(slip.along, d_along, 0.5)
    sag = slip.sag + 0.5 * d_sag
    slid = power_around(sums.friction, around, around, (sag, sag), barrel)
    slid = slid + power(sums.friction, along, along)
    numerical = power_around(sums.friction, d_around, around, (d_sag, sag), barrel)
    numerical = 0.5 * (numerical + power(sums.friction, d_along, along))
    damped = _damping_loss(sums, middle_rate, damping, contact.damage)
    damped = damped + released_power(sums.released, middle_rate)
    return Settled(wrench, normal, friction_around[0], step * slid, step * damped, step * numerical)


@inline
def _damping_loss(sums, rate, damping, damage):
    """Work out the power of the contact damping at a rate of approach, [W]."""
    if damping is None:
        return 0.0
    return damping.time_constant * _gap_power(power(sums.stiffness, rate, rate), rate, sums.gap, damage)


@inline
def _gap_power(weighted_squares, rate, gap, damage):
    """Turn the weighted squares of rates of approach into those of the rates against a moving gap."""
    if damage is None:
        return weighted_squares
    return weighted_squares - 2.0 * (gap.rate[0] * rate[0] + gap.rate[1] * rate[1]) + gap.squares


@inline
def faults_of_cup(faults):
    """Take the faults that a contact with the cup meets: `RingFaults`."""
    return RingFaults(faults.cup, faults.roller, faults.cup_damage, faults.cup_waves, faults.roller_waves)


@inline
def faults_of_cone(faults):
    """Take the faults that a contact with the cone meets: `RingFaults`."""
    return RingFaults(faults.cone, faults.roller, faults.cone_damage, faults.cone_waves, faults.roller_waves)
