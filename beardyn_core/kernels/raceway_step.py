"""A raceway contact within a time step: before the solve, in the matrix, and settled after it."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.exchange import (
    account,
    account_loss,
    implicit_time,
    output_contact,
    react,
    watch_chatter,
)
from beardyn_core.kernels.film import film_output, log2_entrainment
from beardyn_core.kernels.lane_math import at_least, at_most, sqrt
from beardyn_core.kernels.orbit import entrainment_speed
from beardyn_core.kernels.raceway import generator_line, lamina_sums, line_wrench, power, sliding, weighted
from beardyn_core.kernels.solve import add_line, add_line_everywhere
from beardyn_core.kernels.traction import traction_capacity
from beardyn_core.kernels.vectors import add, add_scaled, cross, dot, subtract
from beardyn_core.kernels.waviness import add_leaning, leaning_wrench, wave_gap, wavy_line
from beardyn_core.model.layout import LOSS_DAMPING, LOSS_SLIDING, PENETRATION


@inline
def raceway_contact(
    lanes: Any,
    block: Any,
    ring: Any,
    view: Any,
    body: Any,
    oversize: Any,
    azimuths: Any,
    raceway: Any,
    faults: Any,
    p: Any,
) -> Any:
    """Everything one raceway contact needs before the solve.

    Returns
    -------
    tuple
        Line, slip, sums, speed part of the film, centre, whether any roller of the block may touch, and the
        largest penetration.
    """
    place, axis, velocity, omega, orbit_rate = body
    centre = subtract(place, view[0])
    surface, roller_surface, damage, waves, roller_waves = faults
    ring_wave, ring_climb = wave_gap(lanes, block, azimuths[0], waves)
    roller_wave, roller_climb = wave_gap(lanes, block, azimuths[1], roller_waves)
    line = generator_line(centre, axis, view[1], oversize, raceway, p.roller)
    line = wavy_line(line, ring_wave + roller_wave)
    slip = sliding(line, centre, velocity, omega, view[2], view[3])
    speed = entrainment_speed(line, centre, velocity, omega, view[2], view[3], orbit_rate)
    log2_speed = log2_entrainment(speed, p.effects.film)
    patches = (surface, roller_surface, damage)
    reach = p.roller.half_length + abs(p.roller.mass_offset)
    sums = lamina_sums(
        lanes, block, line, slip, log2_speed, azimuths, ring, p.laminae, patches, p.lamina_loads, reach,
        p.effects,
    )  # fmt: skip
    leaning = leaning_wrench(
        lanes, place, axis, sums[4], sums[0][0], (ring_climb, roller_climb), damage, waves, roller_waves
    )
    sums_and_lean = (sums[0], sums[1], sums[2], sums[3], leaning, sums[6])
    return line, slip, sums_and_lean, log2_speed, centre, sums[5], sums[7]


@inline
def normal_sums(sums: Any, rate: Any, damping: Any) -> Any:
    """Normal force with x^0, x^1, x^2: elastic and damping part."""
    if damping is None:
        return sums[0]
    damped = weighted(sums[1], rate)
    elastic = sums[0]
    return (
        elastic[0] + damping.time_constant * damped[0],
        elastic[1] + damping.time_constant * damped[1],
        elastic[2],
    )


@inline
def raceway_matrix(matrix: Any, contact: Any, p: Any) -> Any:
    """Add the implicit part of one raceway contact to the roller's matrix."""
    if not contact[5]:
        return matrix
    line, sums, step = contact[0], contact[2], p.step
    time = step * implicit_time(p.spring_time, p.effects.damping)
    rough = (step * sums[2][0], step * sums[2][1], step * sums[2][2])
    # friction resists in the tangent plane: in every direction less along the normal
    stiff = (time * sums[1][0] - rough[0], time * sums[1][1] - rough[1], time * sums[1][2] - rough[2])
    matrix = add_line_everywhere(matrix, line[0], line[1], rough)
    return add_line(matrix, line[2], line[0], line[1], stiff)


@inline
def raceway_wrench(contact: Any, damping: Any) -> Any:
    """Force and moment on the roller from the velocities at the beginning of the step."""
    line, slip, sums = contact[0], contact[1], contact[2]
    force, moment = line_wrench(
        line, normal_sums(sums, slip[0], damping), weighted(sums[2], slip[1]), weighted(sums[2], slip[2])
    )
    return add_leaning(force, moment, sums[4])


@inline
def affine_change(line: Any, direction: Any, change: Any) -> Any:
    """Change of the velocity along a direction on the generator line, affine in the abscissa."""
    at_middle = add(change[0], cross(change[1], line[0]))
    return dot(at_middle, direction), dot(cross(change[1], line[1]), direction)


@inline
def shifted(affine: Any, change: Any, part: Any) -> Any:
    """``affine + part * change``."""
    return affine[0] + part * change[0], affine[1] + part * change[1]


@inline
def settled_wrench(contact: Any, change: Any, step: Any, spring_time: Any, damping: Any) -> Any:
    """Force and moment on the roller that the step ends with, with their energy terms.

    Friction is that of the end of the step, contact damping that of its middle, and the spring takes in a
    share of what it changes by.

    Returns
    -------
    force, moment : vector
    normal_force : tuple of 3 lane values
    around_force : lane value
    slid, damped, numerical : lane value
        Dissipated by sliding, by contact damping, and by the time step, over the step, [J].
    """
    line, slip, sums = contact[0], contact[1], contact[2]
    d_rate = affine_change(line, line[2], change)
    d_around = affine_change(line, line[3], change)
    d_along = affine_change(line, line[4], change)
    middle_rate = shifted(slip[0], d_rate, 0.5)
    spring = weighted(sums[1], d_rate)
    settled = (
        sums[0][0] + spring_time * spring[0],
        sums[0][1] + spring_time * spring[1],
        sums[0][2],
    )
    normal = normal_sums((settled, sums[1]), middle_rate, damping)
    around = shifted(slip[1], d_around, 1.0)
    along = shifted(slip[2], d_along, 1.0)
    friction_around = weighted(sums[2], around)
    force, moment = line_wrench(line, normal, friction_around, weighted(sums[2], along))
    force, moment = add_leaning(force, moment, sums[4])
    middle_around = shifted(slip[1], d_around, 0.5)
    middle_along = shifted(slip[2], d_along, 0.5)
    slid = power(sums[2], middle_around, middle_around) + power(sums[2], middle_along, middle_along)
    numerical = 0.5 * (power(sums[2], d_around, middle_around) + power(sums[2], d_along, middle_along))
    damped = damping_loss(sums, middle_rate, damping) + sums[5]
    return force, moment, normal, friction_around[0], step * slid, step * damped, step * numerical


@inline
def damping_loss(sums: Any, rate: Any, damping: Any) -> Any:
    """Power of the contact damping at a rate of approach, [W]."""
    if damping is None:
        return 0.0
    return damping.time_constant * power(sums[1], rate, rate)


@inline
def finish_raceway(
    lanes: Any,
    rollers: Any,
    sums: Any,
    block: Any,
    ring: Any,
    contact: Any,
    change: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    p: Any,
) -> Any:
    """Settle one raceway contact after the solve: reaction, output, audit; returns its wrench."""
    line, slip, log2_speed = contact[0], contact[1], contact[3]
    force, moment, normal, friction = _settle(lanes, sums, ring, contact, change, mask, cosine, sine, p)
    # a grazing contact has hardly any force to divide by
    pressure_centre = normal[1] / at_least(normal[0], 1e-3)
    pressure_centre = at_most(at_least(pressure_centre, -p.roller.half_length), p.roller.half_length)
    arm = add_scaled(line[0], pressure_centre, line[1])
    sliding_speed = sqrt(slip[1][0] * slip[1][0] + slip[2][0] * slip[2][0])
    film = film_output(normal[0], log2_speed, ring, p.laminae, p.effects.film) + lanes.constant(0.0)
    output_contact(lanes, rollers, block, ring, force, arm, sliding_speed, film)
    capacity = traction_capacity(normal[0], p.effects.coulomb, p.effects.mixed, p.effects.load_sharing)
    watch_chatter(lanes, rollers, block, ring, friction, capacity)
    deepest = at_least(lanes.load(rollers, block, PENETRATION), contact[6])
    lanes.store(rollers, block, PENETRATION, deepest)
    return force, moment


@inline
def _settle(
    lanes: Any,
    sums: Any,
    ring: Any,
    contact: Any,
    change: Any,
    mask: Any,
    cosine: Any,
    sine: Any,
    p: Any,
) -> Any:
    """Wrench, normal force and friction after the solve, with reaction and audit; zeros without touch."""
    if not contact[5]:
        zero = lanes.constant(0.0)
        nothing = (zero, zero, zero)
        return nothing, nothing, nothing, zero
    force, moment, normal, friction, slid, damped, numerical = settled_wrench(
        contact, change, p.step, p.spring_time, p.effects.damping
    )
    react(lanes, sums, ring, mask, contact[4], force, moment, cosine, sine)
    account_loss(lanes, sums, mask, LOSS_SLIDING, slid, p.effects.audit)
    account_loss(lanes, sums, mask, LOSS_DAMPING, damped, p.effects.audit)
    account(lanes, sums, mask, numerical, contact[2][3], p.effects.audit)
    return force, moment, normal, friction
