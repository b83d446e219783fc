"""Rides of the rail model for a time, without the twin."""

from __future__ import annotations

from beardyn_core.rail.build import RIDE_RATE, ride_steps
from beardyn_core.rail.vehicle import Ride
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation


def ride_of(
    operation: QuarterVehicleOperation, mounting: Mounting, duration: float, seed: int
) -> tuple[Ride, float]:
    """Motion of the rail model's own bodies over a duration [s], and its time step [s]."""
    response, _ = ride_steps(operation, mounting, round(duration * RIDE_RATE) + 1, seed)
    return response, 1.0 / RIDE_RATE
