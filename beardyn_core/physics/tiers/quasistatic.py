"""Steps of the quasistatic tier: rings on suspension and journal, every roller in its meridian plane."""

from __future__ import annotations

from beardyn_core.base.jit import entry, inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import clear_largest, load_vector, store_vector
from beardyn_core.physics.bodies.power import SMALLEST_LOAD
from beardyn_core.physics.bodies.rigid_bodies import body_vector, lane_total
from beardyn_core.physics.cage.play import (
    ahead_of,
    begin_block,
    cage_rates,
    clear_cages,
    drift,
    keep_loose,
    kick_cages_across,
    move_loose,
    pass_traction,
    push_loose,
    rubbing_torque,
    see_cages,
    with_cages,
)
from beardyn_core.physics.cage.rubbing import pocket_torque
from beardyn_core.physics.lanes.lane_math import at_least, exp2, log2, where_greater
from beardyn_core.physics.lanes.vectors import add_scaled
from beardyn_core.physics.rib_friction import sliding_torque
from beardyn_core.physics.rolling_resistance import rolling_torque
from beardyn_core.physics.tiers.kinematic_bending import (
    PLACE,
    SPEED,
    add_reaction,
    clear_reaction,
    keep_tangent,
    less_opening,
    show_openings,
    turn_reaction,
)
from beardyn_core.physics.tiers.kinematic_rings import (
    add_stiffness,
    hold_stiffness,
    store_stiffness,
)
from beardyn_core.physics.tiers.kinematic_rollers import (
    KEPT_ABOUT_COSINE,
    KEPT_ABOUT_SINE,
    KEPT_COSINE,
    LOAD_AXIAL,
    LOAD_COSINE,
    LOAD_SINE,
    MOMENT_COSINE,
    MOMENT_SINE,
    RIB_SUM,
    TORQUE_POCKET,
    TORQUE_RIB,
    TORQUE_ROLLING,
    cup_wrench,
    held_losses,
    keep_losses,
    kept_wrench,
    relative_cone,
    show_contacts,
    show_roller,
    watch_loads,
)
from beardyn_core.physics.tiers.kinematic_step import (
    TRENDS_PER_BLOCK,
    Drive,
    begin_advance,
    begin_step,
    cage_direction,
    copy_table,
    finish_step,
)
from beardyn_core.physics.tiers.planar_barrel import (
    balance_barrels,
    barrel_tangent,
    guided_inertia,
    pressed_outwards,
)
from beardyn_core.physics.tiers.planar_flanges import (
    add_axial,
    all_flanges,
    axial_sine,
    axial_sum,
    flanges_torque,
    moment_on_cup,
    radial_on_cup,
    show_flanges,
)
from beardyn_core.physics.tiers.planar_roller import (
    balance,
    cone_view,
    damp_reversal,
    free_flight,
    turned_axis,
)
from beardyn_core.physics.tiers.sliding import add_sliding, creep_of, hold_sliding, rolling_level, store_creep


@inline
def pressed_tangent(load, tangent):
    """Work out the stiffness of rollers that press on the cone with a load; 0 where they do not, [N/m]."""
    stiffness = tangent * exp2(0.1 * log2(at_least(load, SMALLEST_LOAD)))
    return where_greater(load, SMALLEST_LOAD, stiffness, 0.0 * load)


@inline
def steady_pocket(cone_load, speeds, k, drag, loose):
    """Work out the torque of the pockets where the rollers stay in their middle, [N m]."""
    if loose is None:
        return pocket_torque(cone_load, speeds, k, drag, k.pocket)
    return 0.0 * cone_load


@inline
def orbit_angles(lanes, rollers, block, angle, turns, k, loose):
    """Take azimuths and spin angles of a block of rollers, [rad]; ``angle``: of their pockets in the cage."""
    if loose is None:
        return angle + turns[0], lanes.constant(turns[2])
    azimuth = lanes.load(rollers, block, layout.ANGLE)
    return azimuth, k.spin_ratio * (azimuth - angle)


@inline
def counted_waves(lanes, block, pockets, direction, loose):
    """Take the mask of the rollers, alone and times cosine and sine of their azimuths."""
    if loose is None:
        return load_vector(lanes, pockets, block, layout.COUNTED)
    counted = lanes.load(pockets, block, layout.COUNTED)
    return counted, counted * direction[0], counted * direction[1]


@inline
def balance_rollers(
    lanes, rollers, sums, motion, shake, direction, cages, turns, speeds, due, shown, p, barrel
):
    """Move all rollers over a step and sum their loads by row.

    ``rollers`` [block, ROLLER_FIELDS, lane]: places, axes, radial and axial velocity and tangential angular
    momentum changed in place; everything else written when `shown`; ``shake`` (3 numbers): acceleration of
    the cup as its ring sees it: up, forward, outward [m/s^2]; ``cages``: of `see_cages`; ``sums`` [1,
    SUM_FIELDS, lane]: written: ``LOAD_COSINE`` and following; ``due``: whether to work out the torque of the
    contacts; ``shown``: whether to write what a block of channels shows; ``barrel``: of the
    cup, ``None`` for other rollers.
    """
    k, rate, turning = p.kinematic, p.motion.rate, p.base.roller.transverse_inertia
    orbit_squared = speeds[1] * speeds[1]
    inertia = (k.centrifugal * orbit_squared, k.gyroscopic * orbit_squared)
    if barrel is not None:
        inertia = guided_inertia(inertia, p.base.cup)
    side = lanes.load(p.sides, 0, 0)
    zero = lanes.constant(0.0)
    # sums over the rollers: plain, times cosine, times sine
    loads, moments = (zero, zero, zero), (zero, zero, zero)
    kept, bent = (zero, zero, zero), (zero, zero)
    axial, rib_sum, rolling, pocket, sliding = zero, zero, zero, zero, zero
    stiff = (zero, zero, zero, zero, zero, zero)
    creep, level = stiff, rolling_level(speeds[1] * k.cup_radius, p.slide)
    grip = rolling_level(speeds[1] * k.cup_radius, p.grip)
    clear_reaction(lanes, sums, p.bending)
    clear_cages(lanes, sums, p.loose)
    for block in range(rollers.shape[0]):
        ahead = drift(lanes, rollers, block, turns[0], p.loose)
        pocket_cosine, pocket_sine = ahead_of(
            lanes.load(p.pockets, block, layout.POCKET_COSINE),
            lanes.load(p.pockets, block, layout.POCKET_SINE),
            ahead,
        )
        cosine = pocket_cosine * direction[0] - pocket_sine * direction[1]
        sine = pocket_sine * direction[0] + pocket_cosine * direction[1]
        angle = lanes.load(p.base.rollers, block, layout.POCKET_ANGLE)
        place = (lanes.load(rollers, block, layout.RADIUS), lanes.load(rollers, block, layout.AXIAL))
        axis = (lanes.load(rollers, block, layout.AXIS), lanes.load(rollers, block, layout.AXIS + 2))
        azimuth, spin = orbit_angles(lanes, rollers, block, angle, turns, p.kinematic, p.loose)
        oversize = lanes.load(p.base.rollers, block, layout.OVERSIZE)
        azimuths = (azimuth, azimuth - turns[1], spin, oversize)
        view = cone_view(lanes, motion, cosine, sine, speeds[1], side)
        opening = (
            less_opening(lanes, block, PLACE, zero, p.bending, ahead),
            less_opening(lanes, block, SPEED, zero, p.bending, ahead),
        )
        moved = (
            lanes.load(rollers, block, layout.VELOCITY),
            lanes.load(rollers, block, layout.VELOCITY + 2),
            lanes.load(rollers, block, layout.MOMENTUM + 1) * (1.0 / turning),
        )
        shaken = (shake[0] * cosine + shake[1] * sine, side * shake[2])
        before = moved
        flight, beside = free_flight(moved, shaken, inertia, p)
        if barrel is not None:
            beside = pressed_outwards(beside, inertia, p.base.cup)
        place = (place[0] + p.step * flight[0], place[1] + p.step * flight[1])
        axis = turned_axis(axis, p.step * flight[2])
        if barrel is None:
            move, cup, cone, rib, lever, deepest, ends = balance(
                lanes, block, place, axis, flight, beside, view, azimuths, opening, grip, p
            )
        else:
            move, cup, cone, rib, lever, deepest, ends = balance_barrels(
                lanes, block, place, axis, flight, beside, view, azimuths, opening, grip, p
            )
        moved = (
            damp_reversal(before[0], flight[0] + move[0] * rate),
            damp_reversal(before[1], flight[1] + move[1] * rate),
            damp_reversal(before[2], flight[2] + move[2] * rate),
        )
        place = (place[0] + move[0], place[1] + move[1])
        axis = turned_axis(axis, move[2])
        lanes.store(rollers, block, layout.RADIUS, place[0])
        lanes.store(rollers, block, layout.AXIAL, place[1])
        lanes.store(rollers, block, layout.AXIS, axis[0])
        lanes.store(rollers, block, layout.AXIS + 2, axis[1])
        lanes.store(rollers, block, layout.VELOCITY, moved[0])
        lanes.store(rollers, block, layout.VELOCITY + 2, moved[1])
        lanes.store(rollers, block, layout.MOMENTUM + 1, turning * moved[2])
        deepest = at_least(lanes.load(rollers, block, layout.PENETRATION), deepest)
        lanes.store(rollers, block, layout.PENETRATION, deepest)
        waves = counted_waves(lanes, block, p.pockets, (pocket_cosine, pocket_sine), p.loose)
        counted = waves[0]
        loads = add_scaled(loads, radial_on_cup(ends, cup[0]), waves)
        axial = add_axial(axial, counted, ends)
        drive, onward = push_loose(
            lanes, rollers, sums, block, (cosine, sine), cages, motion, shake, speeds, cone[0], counted, p,
            p.loose,
        )  # fmt: skip
        mass = counted * p.base.roller.mass
        outward = mass * ((moved[0] - before[0]) * rate + shaken[0])
        along = mass * ((moved[1] - before[1]) * rate + shaken[1])
        about = k.axial * outward - k.radius * along
        kept = (
            kept[0] + (outward * pocket_cosine - onward * pocket_sine),
            kept[1] + (outward * pocket_sine + onward * pocket_cosine),
            kept[2] + along,
        )
        bent = (bent[0] + about * pocket_cosine, bent[1] + about * pocket_sine)
        loads = pass_traction(loads, (pocket_cosine, pocket_sine), drive, p.base.cup.cosine, p.loose)
        moment = moment_on_cup(ends, lever[0] * cup[0] + lever[1] * cup[1])
        moments = add_scaled(moments, moment, waves)
        rib_sum = rib_sum + counted * all_flanges(rib, ends)
        add_reaction(lanes, sums, block, counted * cup[0], p.bending, ahead)
        forces = (cup[0], cone[0], rib)
        watch_loads(lanes, rollers, block, forces)
        if due:
            rolling = rolling + counted * rolling_torque(forces, speeds, k, p.base.effects.rolling)
            idling = counted * steady_pocket(cone[0], speeds, k, p.base.effects.drag, p.loose)
            rolling, pocket = rolling + idling, pocket + idling
            one_rib = sliding_torque(rib, speeds, p.kinematic, p.base.cone, p.base.effects.rib)
            sliding = sliding + counted * flanges_torque(one_rib, ends, speeds[0], p.base.effects.flanges)
            tangent = counted * pressed_tangent(cone[0], p.tangent)
            if barrel is not None:
                tangent = counted * barrel_tangent(cone[0], p.tangent)
            stiff = add_stiffness(stiff, tangent, pocket_cosine, pocket_sine)
            slowed = counted * creep_of(cup[0], level, p.slide)
            creep = add_stiffness(creep, slowed, pocket_cosine, pocket_sine)
            keep_tangent(lanes, block, tangent, p.bending)
        if shown:
            orbit = lanes.load(rollers, block, layout.ANGLE)
            where = orbit, lanes.load(rollers, block, layout.VELOCITY + 1)
            centres = (cup[1] / at_least(cup[0], SMALLEST_LOAD), cone[1] / at_least(cone[0], SMALLEST_LOAD))
            show_roller(lanes, rollers, block, place, axis, moved, (turns[0], speeds[1]), angle, p)
            keep_loose(lanes, rollers, block, where, p.loose)
            show_contacts(lanes, rollers, block, axis, forces, centres, speeds, p)
            show_flanges(lanes, rollers, block, axis, ends, speeds[0], p.base.effects.flanges)
    store_vector(
        lanes,
        sums,
        0,
        LOAD_COSINE,
        (loads[1], loads[2], side * axial_sum(loads[0], axial, p.direct)),
    )
    store_vector(lanes, sums, 0, MOMENT_COSINE, (side * moments[1], side * moments[2], rib_sum))
    store_vector(lanes, sums, 0, KEPT_COSINE, (kept[0], kept[1], side * kept[2]))
    lanes.store(sums, 0, KEPT_ABOUT_COSINE, side * bent[0])
    lanes.store(sums, 0, KEPT_ABOUT_SINE, side * bent[1])
    lanes.store(sums, 0, TORQUE_ROLLING, rolling)
    lanes.store(sums, 0, TORQUE_POCKET, pocket)
    lanes.store(sums, 0, TORQUE_RIB, sliding)
    if due:
        store_stiffness(lanes, sums, stiff)
        store_creep(lanes, sums, creep, p.slide)


@inline
def series_of(bending):
    """Take the series of the bending at the pockets; ``None`` where nothing bends."""
    if bending is None:
        return None
    return bending.basis


@inline
def cup_velocity(bodies):
    """Take the velocity of the cup, 3 floats."""
    return body_vector(bodies, layout.CUP_BODY, layout.LINEAR)


@inline
def keep_change(bodies, before):
    """Keep what the cup's velocity has changed by since `before`."""
    for i in range(3):
        bodies[layout.CUP_BODY, layout.CHANGE + i] = bodies[layout.CUP_BODY, layout.LINEAR + i] - before[i]


@inline
def cup_acceleration(bodies, rate):
    """Work out the acceleration of the cup over the step before: up, forward, along the axle, [m/s^2]."""
    x, y, z = body_vector(bodies, layout.CUP_BODY, layout.CHANGE)
    return rate * z, rate * x, rate * y


@entry
def advance_quasistatic(lanes, state, work, loads, output, p):
    """Advance the quasistatic tier over whole blocks of steps; arguments as of the full tier's `advance`.

    The energy balance is not kept, but what each source loses.
    """
    rollers, bodies, energy, flex, axle = state.rollers, state.bodies, state.energy, state.flex, state.axle
    bending = p.bending
    sums, wrenches, box, signals = work.sums, work.wrenches, work.box, output.signals
    roller_trend, body_trend = output.rollers, output.bodies
    steps = signals.shape[0]
    stride = steps // roller_trend.shape[0]
    begin_advance(rollers)
    direction = cage_direction(bodies)
    losses = (0.0, 0.0)
    response, loose = work.response, p.loose
    for step in range(steps):
        if step % (TRENDS_PER_BLOCK * stride) == 0:
            direction = cage_direction(bodies)  # several blocks at once have the bits of one at a time
            begin_block(lanes, rollers, bodies, p.pockets, series_of(bending), loose)
        direction, turns, speeds = begin_step(bodies, direction, p)
        due, shown = step % stride == 0, (step + 1) % stride == 0
        show_openings(lanes, flex, direction, box, p.step, due, bending)
        move_loose(rollers, bodies, p.step, p.kinematic, loose)
        shake = cup_acceleration(bodies, p.motion.rate)
        motion = relative_cone(bodies)
        cages = see_cages(lanes, bodies, lanes.load(p.sides, 0, 0), loose)
        balance_rollers(
            lanes, rollers, sums[0], motion, shake, direction, cages, turns, speeds, due,
            shown, p, p.base.cup.barrel,
        )  # fmt: skip
        turn_reaction(sums, direction, bending)
        totals = (
            lane_total(sums, LOAD_COSINE),
            lane_total(sums, LOAD_SINE),
            lane_total(sums, LOAD_AXIAL),
            lane_total(sums, MOMENT_COSINE),
            lane_total(sums, MOMENT_SINE),
        )
        sine = axial_sine(p.base.cup.sine, p.direct)
        wrench = cup_wrench(totals, direction, p.base.cup.cosine, sine)
        kept = with_cages(kept_wrench(sums, direction), sums, bodies, loose)
        rib = lane_total(sums, RIB_SUM)
        if due:
            losses = held_losses(sums, speeds, rib, p)
            rubbing = rubbing_torque(bodies, stride, loose)
            losses = (losses[0] + rubbing, losses[1])
            keep_losses(energy, sums, speeds, rubbing, stride * p.step, p)
            hold_stiffness(lanes, sums, direction, response, p, bending)
            hold_sliding(sums, direction, response, p, p.slide)
        wrench = add_sliding(wrench, motion, response, p.slide)
        before, rates = cup_velocity(bodies), cage_rates(bodies, loose)
        finish_step(
            lanes, bodies, flex, axle, Drive(wrench, rib, losses, kept), wrenches, box, loads[step],
            loads[step + 1], signals[step], energy, response, p,
        )  # fmt: skip
        keep_change(bodies, before)
        kick_cages_across(bodies, sums, p.step, rates, loose)
        if shown:
            trends = (step + 1) // stride
            for block in range(rollers.shape[0]):
                copy_table(rollers[block], roller_trend[trends - 1, block])
            copy_table(bodies, body_trend[trends - 1])
            if trends % layout.TRENDS_PER_SNAPSHOT == 0:
                clear_largest(rollers)
