"""Loads on an axlebox besides those of the vertical rail profile: curves, sway, traction and braking."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.rail.course import Course, course, load_transfer
from beardyn_core.rail.irregularity import rail_profile
from beardyn_core.rail.lateral import FRAME, LateralMotion, lateral_motion, lateral_vehicle
from beardyn_core.rail.longitudinal import LongitudinalForces, longitudinal_forces
from beardyn_core.rail.suspension import equivalent_displacement
from beardyn_core.rail.vehicle import BOGIE, WHEEL
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.speed import distance_at, speed_at

Float = NDArray[np.float64]


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

    Parameters
    ----------
    operation : QuarterVehicleOperation
    mounting : Mounting
    time : float64 array, shape [step]
        Uniform, from 0, [s].
    fade : float64 array, shape [step]
        With which irregularities come in, 0 to 1.
    seed : int

    Returns
    -------
    Running or None
    """
    speeds = {speed for _, speed in operation.speed_profile}
    if len(speeds) == 1 and not operation.moves_sideways:
        return None
    position, speed = distance_at(operation.speed_profile, time), speed_at(operation.speed_profile, time)
    plan = course(operation.curves, position, speed)
    push = load_transfer(operation, mounting, plan)
    pulled = longitudinal_forces(operation, mounting, time)
    push[:, WHEEL] += pulled.brake[:, 1]
    push[:, BOGIE] -= pulled.brake[:, 1]
    swayed = None
    if operation.moves_sideways:
        profile = rail_profile(operation.irregularity, float(np.ptp(position)), seed, "lateral")
        alignment = profile.height_at(position)
        step = float(time[1] - time[0])
        swayed = lateral_motion(
            lateral_vehicle(operation, mounting), speed, plan, (alignment - alignment[0]) * fade, step
        )
    return Running(plan, pulled, swayed, push)


def journal_force(run: Running, operation: QuarterVehicleOperation, mounting: Mounting) -> Float:
    """Compute the load on the journal besides the vertical wheel-rail force.

    Parameters
    ----------
    run : Running
    operation : QuarterVehicleOperation
    mounting : Mounting

    Returns
    -------
    float64 array, shape [step, 3]
        [N].

    Notes
    -----
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
    return force


def suspension_shift(run: Running, mounting: Mounting, step: float) -> Float:
    """Compute how far the bogie end of the suspension moves in the track's axes, besides vertically.

    Parameters
    ----------
    run : Running
    mounting : Mounting
    step : float
        [s].

    Returns
    -------
    float64 array, shape [step, 3]
        With what stands for the inertia of the axlebox in the moving axes, [m].
    """
    shift = np.zeros((len(run.push), 3))
    shift[:, 0] = equivalent_displacement(-mounting.box_mass * run.pull.acceleration, mounting, 0, step)
    shift[:, 2] = equivalent_displacement(-mounting.box_mass * run.plan.press, mounting, 2, step)
    if run.sway is not None:
        shift[:, 1] = run.sway.motion[:, FRAME]
        shift[:, 1] += equivalent_displacement(mounting.box_mass * run.plan.lean, mounting, 1, step)
    return shift
