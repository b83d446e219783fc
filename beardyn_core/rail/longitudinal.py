"""Braking and starting: forces on one axle while the speed changes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.speed import Profile, speed_at

Float = NDArray[np.float64]

# brakes and drives build up within this time, [s]
BUILD_UP = 1.0


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


def acceleration_at(profile: Profile, time: Float) -> tuple[Float, Float]:
    """Compute the acceleration with the build-up of brakes and drives, and the mean speed it belongs to.

    Parameters
    ----------
    profile : tuple of (time, speed) pairs, [s], [m/s]
    time : float64 array, [s]

    Returns
    -------
    acceleration : float64 array
        That of the profile as a running mean, [m/s^2].
    speed : float64 array
        [m/s].
    """
    before, after = (speed_at(profile, time + side * 0.5 * BUILD_UP) for side in (-1.0, 1.0))
    return (after - before) / BUILD_UP, 0.5 * (before + after)


def longitudinal_forces(
    operation: QuarterVehicleOperation, mounting: Mounting, time: Float
) -> LongitudinalForces:
    """Compute the forces that act while the speed changes.

    Parameters
    ----------
    operation : QuarterVehicleOperation
    mounting : Mounting
    time : float64 array, shape [step]
        [s].

    Returns
    -------
    LongitudinalForces

    Notes
    -----
    The axle brakes or drives its ``share`` of its own part of the vehicle's mass; an axle that does neither
    only rolls along. Quasi-static: the load that shifts between the bogies and axles of a car while
    braking, the inertia of the turning wheelset (some 5 %), running resistance, the reaction of a gear
    box and slip are neglected.
    """
    acceleration, speed = acceleration_at(operation.speed_profile, time)
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
