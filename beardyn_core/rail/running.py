"""Loads on an axlebox besides those of the vertical rail profile: curves, sway, braking and starting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.rail.course import Course, course, load_transfer
from beardyn_core.rail.flexible import flexible_motion, flexible_vehicle
from beardyn_core.rail.irregularity import rail_profile
from beardyn_core.rail.lateral import FRAME, Flexing, LateralMotion, lateral_motion, lateral_vehicle
from beardyn_core.rail.vehicle import BOGIE, WHEEL, equivalent_displacement
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.running import Profile, distance_at, speed_at

# brakes and drives build up within this time, [s]
_BUILD_UP = 1.0


@dataclass(frozen=True)
class LongitudinalForces:
    """Forces of one axlebox's share along the track, and those of the brake across it."""

    acceleration: A[Float, "shape [step], of the vehicle, forwards, [m/s^2]"]
    rail: A[Float, "shape [step], of the rail on the wheel, forwards, [N]"]
    brake: A[
        Float,
        "shape [step, 2], of a brake on the half wheelset, forwards and upwards; the opposite on the bogie, "
        "[N]",
    ]


@dataclass(frozen=True)
class Running:
    """Forces and motions on a uniform time grid."""

    plan: Course
    pull: LongitudinalForces
    sway: A[LateralMotion | None, "``None``: no lateral motion asked for"]
    push: A[Float, "shape [step, 4], upward forces on body, bogie, half wheelset and axlebox, [N]"]


def running(
    operation: QuarterVehicleOperation, mounting: Mounting, time: Float, fade: Float, seed: int
) -> Running | None:
    """Compute forces besides those of the vertical profile; ``None`` on straight track at constant speed.

    `time` [s] is uniform from 0; with `fade`, 0 to 1, irregularities come in; both of shape [step].
    """
    speeds = {speed for _, speed in operation.speed_profile}
    if len(speeds) == 1 and not operation.moves_sideways:
        return None
    position, speed = distance_at(operation.speed_profile, time), speed_at(operation.speed_profile, time)
    plan = course(operation.curves, position, speed)
    push = load_transfer(operation, mounting, plan)
    pulled = _longitudinal_forces(operation, mounting, time)
    push[:, WHEEL] += pulled.brake[:, 1]
    push[:, BOGIE] -= pulled.brake[:, 1]
    swayed = None
    if operation.moves_sideways:
        profile = rail_profile(operation.irregularity, float(np.ptp(position)), seed, "lateral")
        alignment = profile.height_at(position)
        step = float(time[1] - time[0])
        profiled = (alignment - alignment[0]) * fade
        flexible = flexible_vehicle(operation, mounting)
        if flexible is None:
            swayed = lateral_motion(lateral_vehicle(operation, mounting), speed, plan, profiled, step)
        else:
            swayed = flexible_motion(flexible, speed, plan, profiled, step)
    return Running(plan, pulled, swayed, push)


def journal_force(run: Running, operation: QuarterVehicleOperation, mounting: Mounting, step: float) -> Float:
    """Compute the load on the journal besides the vertical wheel-rail force, shape [step, 3], [N].

    What acts on the half wheelset beyond its own inertia in the twin, which knows no curve and no
    acceleration of the train: the rails' forces and those of inertia in the moving axes. Yaw of the
    wheelset pulls one axlebox forwards, the other back: reduced to the journal so that its mass there moves
    as the yaw does.
    """
    force = np.zeros((len(run.push), 3))
    force[:, 0] = run.pull.rail + run.pull.brake[:, 0] - mounting.journal_mass * run.pull.acceleration
    force[:, 2] = run.push[:, WHEEL]
    if run.sway is not None:
        arm = 0.5 * operation.vehicle.guidance.axlebox_spacing
        force[:, 1] = run.sway.rail_force + mounting.journal_mass * run.plan.lean
        force[:, 0] -= run.sway.yaw_moment / arm
        if run.sway.flexing is not None:
            force += _by_bending(run.sway.flexing, mounting, step)
    return force


def _by_bending(flexing: Flexing, mounting: Mounting, step: float) -> Float:
    """Compute what moves journal and axlebox of the twin as roll and bending of the wheelset do, [N]."""
    mass = mounting.journal_mass + mounting.box_mass
    speed = np.gradient(flexing.back, step)
    force = np.zeros((len(speed), 3))
    force[:, 0] = -mass * np.gradient(speed, step)
    force[:, 0] -= mounting.stiffness[0] * flexing.back + mounting.damping[0] * speed
    force[:, 2] = mass * np.gradient(np.gradient(flexing.rise, step), step)
    return force


def tilting_moment(tilt: Float, mounting: Mounting, step: float) -> Float:
    """Compute the moment about x that tilts the journal of the twin, with its axlebox, as given [rad], [N m].

    The twin's journal is held by the axlebox alone. Steps in [s].
    """
    speed = np.gradient(tilt, step)
    inertia = mounting.journal_inertia + mounting.box_inertia[0]
    held = mounting.rotational_stiffness[0] * tilt + mounting.rotational_damping[0] * speed
    return np.asarray(inertia * np.gradient(speed, step) + held)


def suspension_shift(run: Running, mounting: Mounting, step: float) -> Float:
    """Compute how far the bogie end of the suspension moves in the track's axes, besides vertically.

    With what stands for the inertia of the axlebox in the moving axes, at steps [s], shape [step, 3], [m].
    """
    shift = np.zeros((len(run.push), 3))
    shift[:, 0] = equivalent_displacement(-mounting.box_mass * run.pull.acceleration, mounting, 0, step)
    shift[:, 2] = equivalent_displacement(-mounting.box_mass * run.plan.press, mounting, 2, step)
    if run.sway is not None:
        shift[:, 1] = run.sway.motion[:, FRAME]
        shift[:, 1] += equivalent_displacement(mounting.box_mass * run.plan.lean, mounting, 1, step)
    return shift


def _acceleration(profile: Profile, time: Float) -> tuple[Float, Float]:
    """Compute the running mean of the acceleration [m/s^2] and the mean speed [m/s] there, at times [s]."""
    before, after = (speed_at(profile, time + side * 0.5 * _BUILD_UP) for side in (-1.0, 1.0))
    return (after - before) / _BUILD_UP, 0.5 * (before + after)


def _longitudinal_forces(
    operation: QuarterVehicleOperation, mounting: Mounting, time: Float
) -> LongitudinalForces:
    """Compute the forces that act at times [s] while the speed changes.

    The axle brakes or drives its ``share`` of its own part of the vehicle's mass; an axle that does neither
    only rolls along. Quasi-static: the load that shifts between the bogies and axles of a car while
    braking, the inertia of the turning wheelset (some 5 %), running resistance, the reaction of a gear
    box and slip are neglected.
    """
    acceleration, speed = _acceleration(operation.speed_profile, time)
    vehicle = operation.vehicle
    mass = operation.body_mass / 8.0 + vehicle.bogie_mass / 4.0 + mounting.journal_mass + mounting.box_mass
    slowing = acceleration * speed < 0.0
    braking, starting = operation.braking, operation.starting
    braked = np.where(slowing, mass * acceleration, 0.0) * (braking.share if braking else 0.0)
    driven = np.where(slowing, 0.0, mass * acceleration) * (starting.share if starting else 0.0)
    brake = np.zeros((len(time), 2))
    if braking is not None and braking.brake != "clasp":
        side = 1.0 if braking.ahead else -1.0
        # ahead of the axle the wheel goes down while it rolls forwards: the brake holds it up
        if braking.brake == "disc":
            brake[:, 1] = -side * braked * 0.5 * operation.wheel_diameter / braking.disc_radius
        else:
            brake[:, 0] = -side * np.abs(braked) / braking.friction
            brake[:, 1] = -side * braked
    return LongitudinalForces(acceleration, braked + driven, brake)
