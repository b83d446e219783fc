"""Rollers that orbit kinematically: what the tiers without roller dynamics share.

Each row is written in its own ring frame, as in the full tier: radial at azimuth 0, tangential, outward.
"""

from __future__ import annotations

import math

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import (
    ContactOutput,
    output_contact,
    store_vector,
    watch_largest,
)
from beardyn_core.physics.bodies.power import SMALLEST_LOAD
from beardyn_core.physics.bodies.rigid_bodies import X, Y, Z, lane_total
from beardyn_core.physics.drag import drag_torque
from beardyn_core.physics.film import film_output, log2_entrainment
from beardyn_core.physics.seal import seal_torque

# Sums of the cup forces along the cup's normal, in the cages' frame; axial force and moments times the side.
LOAD_COSINE, LOAD_SINE, LOAD_AXIAL, MOMENT_COSINE, MOMENT_SINE, RIB_SUM = range(
    layout.REACTION, layout.REACTION + 6
)
TORQUE_ROLLING, TORQUE_RIB = layout.REACTION + 6, layout.REACTION + 7
# Sums of what accelerates rollers: radially times cosine and sine of the pocket angle, axially, and moments.
KEPT_COSINE, KEPT_SINE, KEPT_AXIAL, KEPT_ABOUT_COSINE, KEPT_ABOUT_SINE = range(
    layout.REACTION + 18, layout.REACTION + 23
)
TORQUE_POCKET = layout.REACTION + 23  # part of TORQUE_ROLLING


@inline
def relative_motion(bodies, i, place, speed):
    """Take the motion of the cone against the cup on one world axis: displacement and velocity."""
    return (
        bodies[layout.CONE_BODY, place + i] - bodies[layout.CUP_BODY, place + i],
        bodies[layout.CONE_BODY, speed + i] - bodies[layout.CUP_BODY, speed + i],
    )


@inline
def relative_cone(bodies):
    """Take displacement, velocity, tilt and tilt rate of the cone against the cup; tilts to first order."""
    return (
        relative_motion(bodies, X, layout.POSITION, layout.LINEAR),
        relative_motion(bodies, Y, layout.POSITION, layout.LINEAR),
        relative_motion(bodies, Z, layout.POSITION, layout.LINEAR),
        relative_motion(bodies, X, layout.TILT, layout.ANGULAR),
        relative_motion(bodies, Z, layout.TILT, layout.ANGULAR),
    )


@inline
def rotate(direction, angle):
    """Turn a direction (cosine, sine) by an angle of a few hundredths; the error is below 1e-15 there."""
    square = angle * angle
    cosine = 1.0 - square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)))
    sine = angle * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)))
    return direction[0] * cosine - direction[1] * sine, direction[1] * cosine + direction[0] * sine


@inline
def cup_wrench(totals, direction, cosine, sine):
    """Work out world force and moment of the rollers on the cup; no moment about the axis.

    ``totals`` (5 numbers): sums of the rollers' loads along the cup's normal in the cages' frame: load times
    cosine and sine, load times side, moment times side, cosine and sine; ``cosine``, ``sine``: of the cup
    angle.
    """
    load_c, load_s, load_a, moment_c, moment_s = totals
    return (
        cosine * (load_s * direction[0] + load_c * direction[1]),
        -sine * load_a,
        cosine * (load_c * direction[0] - load_s * direction[1]),
        moment_c * direction[0] - moment_s * direction[1],
        0.0,
        -(moment_s * direction[0] + moment_c * direction[1]),
    )


@inline
def kept_wrench(sums, direction):
    """Work out world force and moment that accelerate the rollers, from the sums at ``KEPT_COSINE``."""
    totals = (
        lane_total(sums, KEPT_COSINE),
        lane_total(sums, KEPT_SINE),
        lane_total(sums, KEPT_AXIAL),
        lane_total(sums, KEPT_ABOUT_COSINE),
        lane_total(sums, KEPT_ABOUT_SINE),
    )
    return cup_wrench(totals, direction, 1.0, -1.0)


@inline
def show_roller(lanes, rollers, block, place, axis, motion, turn, angle, p):
    """Write a block of rollers as the full tier keeps them.

    ``motion`` (3 numbers): radial and axial velocity and tilt rate [m/s], [rad/s]; ``turn`` (2 numbers):
    angle and speed of the cages [rad], [rad/s].
    """
    zero = lanes.constant(0.0)
    k, roller = p.kinematic, p.base.roller
    rate = turn[1]
    spin = k.spin_ratio * rate
    about = roller.axial_inertia * (spin + rate * axis[1])
    across = roller.transverse_inertia * rate
    lanes.store(rollers, block, layout.RADIUS, place[0] + zero)
    lanes.store(rollers, block, layout.ANGLE, angle + turn[0])
    lanes.store(rollers, block, layout.AXIAL, place[1] + zero)
    store_vector(lanes, rollers, block, layout.VELOCITY, (motion[0], rate * place[0] + zero, motion[1]))
    store_vector(lanes, rollers, block, layout.AXIS, (axis[0] + zero, zero, axis[1] + zero))
    momentum = (
        about * axis[0] - across * axis[1] * axis[0] + zero,
        roller.transverse_inertia * motion[2],
        about * axis[1] + across * axis[0] * axis[0] + zero,
    )
    store_vector(lanes, rollers, block, layout.MOMENTUM, momentum)
    lanes.store(rollers, block, layout.SPIN, k.spin_ratio * turn[0] + zero)


@inline
def show_contacts(lanes, rollers, block, axis, loads, centres, speeds, p):
    """Write force, place, slip and film of the contacts of a block of rollers.

    ``centres`` (2 numbers): pressure centres on cup and cone, from the centre of mass along the axis [m].
    """
    zero = lanes.constant(0.0)
    k, roller, film, laminae = p.kinematic, p.base.roller, p.base.effects.film, p.base.laminae
    cup, cone = p.base.cup, p.base.cone
    cup_speed = log2_entrainment(speeds[1] * k.cup_radius, film)
    cone_speed = log2_entrainment((speeds[0] - speeds[1]) * k.cone_radius, film)
    for_cup = roller.radius + roller.taper * centres[0]
    for_cone = -(roller.radius + roller.taper * centres[1])
    on_cup = ContactOutput(
        force=(-cup.cosine * loads[0], zero, cup.sine * loads[0]),
        arm=(centres[0] * axis[0] + for_cup * axis[1], zero, centres[0] * axis[1] - for_cup * axis[0]),
        slip=zero,
        film=film_output(loads[0], cup_speed, layout.CUP, laminae, film) + zero,
    )
    on_cone = ContactOutput(
        force=(cone.cosine * loads[1], zero, -cone.sine * loads[1]),
        arm=(centres[1] * axis[0] + for_cone * axis[1], zero, centres[1] * axis[1] - for_cone * axis[0]),
        slip=zero,
        film=film_output(loads[1], cone_speed, layout.CONE, laminae, film) + zero,
    )
    output_contact(lanes, rollers, block, layout.CUP, on_cup)
    output_contact(lanes, rollers, block, layout.CONE, on_cone)
    show_rib(lanes, rollers, block, axis, loads[2], k.rib_slip * speeds[0], p.base.effects.rib)


@inline
def watch_loads(lanes, rollers, block, loads):
    """Keep the largest loads of a block of rollers since the last snapshot; 3 numbers: cup, cone, rib."""
    for kind in (layout.CUP, layout.CONE, layout.RIB):
        watch_largest(lanes, rollers, block, kind, loads[kind] * loads[kind])


@inline
def show_rib(lanes, rollers, block, axis, load, slip, rib):
    """Write force, place and slip of the rib contacts."""
    if rib is None:
        return
    zero = lanes.constant(0.0)
    arm = (
        rib.sphere_place * axis[0] + rib.sphere_radius * rib.normal_radial + zero,
        zero,
        rib.sphere_place * axis[1] + rib.sphere_radius * rib.normal_axial + zero,
    )
    force = (-rib.normal_radial * load, zero, -rib.normal_axial * load)
    output_contact(lanes, rollers, block, layout.RIB, ContactOutput(force, arm, math.fabs(slip) + zero, zero))


# --- torque on the shaft of rollers in pure rolling: every loss as lost power over shaft speed, by the laws
# --- of the full tier; evaluated 400 times a second and held in between: loads of single rollers change
# --- slowly, and the rib's share follows the sum of the rib loads at every step


@inline
def held_losses(sums, speeds, rib_load, p):
    """Work out the torque of all but the ribs [N m], and that of the ribs over the sum of their loads [m]."""
    effects, k = p.base.effects, p.kinematic
    steady = drag_torque(speeds, k, effects.drag) + seal_torque(speeds[0], effects.seal)
    rib = lane_total(sums, TORQUE_RIB) / max(rib_load, SMALLEST_LOAD)
    return steady + lane_total(sums, TORQUE_ROLLING), rib


@inline
def keep_losses(energy, sums, speeds, rubbing, held, p):
    """Add what each source loses while its torque is held, for those who warm by it.

    ``energy`` [ENERGY_TERMS]: losses by source are added to [J]; ``rubbing``: torque of the pockets that
    rollers move in [N m]; ``held`` [s].
    """
    turned, effects = held * speeds[0], p.base.effects
    pocket = lane_total(sums, TORQUE_POCKET)
    energy[layout.ENERGY_LOST + layout.LOSS_ROLLING] += turned * (lane_total(sums, TORQUE_ROLLING) - pocket)
    energy[layout.ENERGY_LOST + layout.LOSS_POCKET] += turned * (pocket + rubbing)
    energy[layout.ENERGY_LOST + layout.LOSS_RIB] += turned * lane_total(sums, TORQUE_RIB)
    energy[layout.ENERGY_LOST + layout.LOSS_DRAG] += turned * drag_torque(speeds, p.kinematic, effects.drag)
    energy[layout.ENERGY_LOST + layout.LOSS_SEAL] += turned * seal_torque(speeds[0], effects.seal)
