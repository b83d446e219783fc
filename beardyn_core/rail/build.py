"""From any operation to the load history that the twin consumes."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.low_pass import decimate, thinning_kernel
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.rail.background import background_force
from beardyn_core.rail.excitation import rail_height, wheel_height
from beardyn_core.rail.irregularity import irregular_height
from beardyn_core.rail.measured import replay_load
from beardyn_core.rail.patch import patch_length
from beardyn_core.rail.roughness import roughness_height, select_roughness
from beardyn_core.rail.running import Running, journal_force, running, suspension_shift, tilting_moment
from beardyn_core.rail.vehicle import Ride, equivalent_displacement, quarter_vehicle, ride
from beardyn_core.scene.background import BACKGROUND_SAMPLE_NS, Background
from beardyn_core.scene.load import LOOK_AHEAD, LoadHistory, sampled_load
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import (
    STEP_SAMPLE_NS,
    ConstantOperation,
    Operation,
    QuarterVehicleOperation,
    SteppedOperation,
)
from beardyn_core.scene.running import distance_at, speed_at
from beardyn_core.scene.scene import Scene

SAMPLE_NS = STEP_SAMPLE_NS
# a strike of the wheel lasts about half a millisecond
STRIKE_SAMPLE_NS = 100_000
# a flat of 35 mm at 400 km/h passes in a third of a millisecond
RIDE_RATE = 40_000.0
# the journal's tilt passes whole up to 270 Hz and not above 400: there boxes rock on their bearings
_TILT_FACTOR = 60
FADE_IN = 0.2


def load_history(
    operation: Operation,
    mounting: Mounting,
    duration: float,
    seed: int,
    background: Background | None = None,
    bearing: RollerBearing | None = None,
) -> LoadHistory:
    """Compute load on the journal and shaft speed, from time 0 to the first sample at or after the end.

    At 2 kHz; at 10 kHz when the wheel or the rail has defects or short waves; at 20 kHz with a background.

    Parameters
    ----------
    mounting : Mounting
        Wheelset, axlebox and primary suspension of the rail model.
    duration : float
        [s].
    seed : int
        Of the irregularity and the background.
    background : Background, optional
        What acts on the journal besides.
    bearing : RollerBearing, optional
        Of which a coupled wheelset has the masses, and a background the faults; only these need it.

    Raises
    ------
    InputError
        When a measured file is bad or shorter than the run.
    """
    if bearing is None and isinstance(operation, QuarterVehicleOperation) and operation.bends_in_the_twin:
        raise ValueError("a coupled wheelset needs the bearing")
    if not 0.0 < duration < 86_400.0:
        raise InputError(f"duration is {duration:g} s; allowed is more than 0 and less than 86 400 s")
    # shorter where wheel or rail strikes
    strikes = isinstance(operation, QuarterVehicleOperation) and (
        operation.wheel_defects or operation.rail_defects or operation.irregularity.roughness != "none"
    )
    if background is not None and not background.forces:
        background = None
    sample_ns = BACKGROUND_SAMPLE_NS if background else STRIKE_SAMPLE_NS if strikes else SAMPLE_NS
    rate = 1e9 / sample_ns
    count = int(np.ceil(round(duration * rate, 6))) + 1
    if isinstance(operation, ConstantOperation):
        wrench = np.tile(np.array([*operation.force, *operation.moment], dtype=np.float64), (count, 1))
        speed = np.full(count, float(operation.speed))
        history = sampled_load(wrench, speed, np.zeros((count, 3)), sample_ns)
    elif isinstance(operation, SteppedOperation):
        history = _stepped_load(operation, count, rate)
    elif isinstance(operation, QuarterVehicleOperation):
        history = _quarter_vehicle(operation, mounting, count, rate, seed, background, bearing)
    else:
        history = replay_load(operation, count, rate)
    if background is not None:
        if bearing is None:
            raise ValueError("a background needs the bearing")
        time = np.arange(count) / rate
        history.wrench[:, 2] += background_force(background, bearing, time, history.shaft_speed, seed)
    return history


def load_of_scene(scene: Scene, duration: float) -> LoadHistory:
    """Compute the load of a scene with its background; see `load_history`."""
    return load_history(
        scene.operation, scene.mounting, duration, scene.seed, scene.background, scene.bearing
    )


def load_of_run(scene: Scene, duration: float) -> LoadHistory:
    """Compute the load of a run [s], and what its last samples are interpolated from.

    A computed load goes on for `LOOK_AHEAD` samples, so that a run does not depend on where it ends; a
    measured one has nothing to go on with.
    """
    return load_of_scene(scene, length_of_load(scene, duration))


def length_of_load(scene: Scene, duration: float) -> float:
    """Compute how long the load of a run has to be, [s]; see `load_of_run`."""
    computed = isinstance(scene.operation, ConstantOperation | SteppedOperation | QuarterVehicleOperation)
    return duration + computed * LOOK_AHEAD * SAMPLE_NS * 1e-9


def _stepped_load(operation: SteppedOperation, count: int, rate: float) -> LoadHistory:
    time = np.arange(count) / rate
    levels = np.array([[*step.force, *step.moment, step.speed] for step in operation.steps])
    signals = np.tile(levels[0], (count, 1))
    for step, change in zip(operation.steps[1:], np.diff(levels, axis=0), strict=True):
        signals += _rise(time - step.time, operation.ramp)[:, None] * change
    return sampled_load(signals[:, :6], signals[:, 6], np.zeros((count, 3)), round(1e9 / rate))


def _rise(time: Float, ramp: float) -> Float:
    """Evaluate half a cosine that rises from 0 to 1 over the ramp that begins at time 0."""
    if ramp == 0.0:
        return (time >= 0.0).astype(np.float64)
    return 0.5 - 0.5 * np.cos(np.pi * np.clip(time / ramp, 0.0, 1.0))


def ride_steps(
    operation: QuarterVehicleOperation,
    mounting: Mounting,
    steps: int,
    seed: int,
    background: Background | None = None,
    bearing: RollerBearing | None = None,
) -> tuple[Ride, Running | None]:
    """Compute the motion of the rail model's bodies, and what acts besides the profile, at `RIDE_RATE`."""
    time = np.arange(steps) / RIDE_RATE
    position = distance_at(operation.speed_profile, time)
    radius = 0.5 * operation.wheel_diameter
    vehicle = quarter_vehicle(operation, mounting, bearing)
    patch = operation.contact_patch
    if patch is None:
        patch = patch_length(radius, vehicle.static_force)
    irregularity = operation.irregularity
    height = irregular_height(irregularity, position, seed, patch)
    if operation.wheel_defects or operation.rail_defects:
        height = height + wheel_height(operation.wheel_defects, radius, position, patch)
        height += rail_height(operation.rail_defects, position, patch)
    roughness, factor = select_roughness(irregularity, background)
    rough = roughness_height(roughness, irregularity, 2.0 * np.pi * radius, position, seed, patch)
    height = height + factor * rough
    fade = _rise(time, FADE_IN)
    height = (height - height[0]) * fade
    besides = running(operation, mounting, time, fade, seed)
    push = None if besides is None else besides.push
    return ride(vehicle, height, 1.0 / RIDE_RATE, push), besides


def _quarter_vehicle(
    operation: QuarterVehicleOperation,
    mounting: Mounting,
    count: int,
    rate: float,
    seed: int,
    background: Background | None,
    bearing: RollerBearing | None,
) -> LoadHistory:
    """Compute the wheel-rail force, less the weight of the half wheelset, and the motion of the bogie.

    The moments of the wheel-rail forces about the axle are carried by the other axlebox, as the load that
    shifts from one to the other in a curve: the wrench has no moment but that which tilts a free journal as
    the wheelset bends, and that of eccentricity comes from the mounting (`Mounting.load_offset`,
    ``suspension_centre``). Above 0.4 of its rate the signal is
    filtered away; the ringing of the filter around a loss of contact may take the force below that of
    an open contact.
    """
    factor = round(RIDE_RATE / rate)
    kernel = thinning_kernel(factor)
    # run past the end by what the filter looks ahead
    steps = (count - 1) * factor + 1 + len(kernel) // 2
    response, besides = ride_steps(operation, mounting, steps, seed, background, bearing)
    vehicle = quarter_vehicle(operation, mounting, bearing)
    force, bogie = np.zeros((count, 3)), np.zeros((count, 3))
    if besides is not None:
        force = _columns(journal_force(besides, operation, mounting, 1.0 / RIDE_RATE), factor, kernel, count)
        bogie = _columns(suspension_shift(besides, mounting, 1.0 / RIDE_RATE), factor, kernel, count)
    force[:, 1] += operation.lateral_force
    imposed = operation.wheelset == "elastic"  # where it is coupled, the twin bends by itself
    pressed = response.contact_force + response.flexing if imposed else response.contact_force
    force[:, 2] += decimate(pressed, factor, kernel)[:count] - vehicle.journal_weight
    frame = response.bogie
    if vehicle.primary.size:
        frame = frame + equivalent_displacement(-response.excess, mounting, 2, 1.0 / RIDE_RATE)
    bogie[:, 2] += decimate(frame, factor, kernel)[:count]
    speed = speed_at(operation.speed_profile, np.arange(count) / rate)
    wrench = np.concatenate([force, np.zeros((count, 3))], axis=1)
    if imposed and vehicle.bending is not None and mounting.journal_tilt == "free":
        tilt = response.tilt
        if besides is not None and besides.sway is not None and besides.sway.flexing is not None:
            tilt = tilt + besides.sway.flexing.tilt
        slow = decimate(tilt, 1, thinning_kernel(_TILT_FACTOR))
        moment = tilting_moment(slow, mounting, 1.0 / RIDE_RATE)
        wrench[:, 3] = (-1.0 if mounting.side == "right" else 1.0) * moment[::factor][:count]
    return sampled_load(wrench, speed / (0.5 * operation.wheel_diameter), bogie, round(1e9 / rate))


def _columns(signals: Float, factor: int, kernel: Float, count: int) -> Float:
    """Take every factor-th sample of filtered columns; a column that stays zero is left alone."""
    thinned = np.zeros((count, signals.shape[1]))
    for axis, column in enumerate(signals.T):
        if column.any():
            thinned[:, axis] = decimate(column, factor, kernel)[:count]
    return thinned
