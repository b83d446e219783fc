"""The twin next to the recordings: levels at values of the unknowns; each seed has its track and bearing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.calibration.spectra import Reception, Ride, levels_of
from beardyn_core.calibration.unknowns import BY_NAME, NOISE
from beardyn_core.choice import scene_from_mapping
from beardyn_core.follow.descriptors import AXES
from beardyn_core.population.batch import simulated
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation
from beardyn_core.scene.scene import Scene

_SETTLING = 0.3  # [s], until load and box have come to their places
_SPARE = 0.05  # [s], what filters of the accelerometer keep at the end
_SPEEDS = ("timetable", "measured_speed")  # what else may say the speed
Values = Mapping[str, float]


@dataclass
class Beside:
    """A scene that runs at the speeds of rides, with changed values.

    Notes
    -----
    The noise of the accelerometer is not simulated: it is white and independent of all else and added behind
    the anti-alias filter, so that its power adds to that of each band.
    """

    scene: A[Scene, "resolved, in the tier of the twin, healthy"]
    reception: Reception
    sensor: A[int, "number of the accelerometer in the scene"]
    rides: tuple[Ride, ...]
    runs: A[int, "of twins so far"] = 0
    _keys: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        self._keys = NOISE.write_into(write_noun(self.scene), self.sensor, 0.0, Path())

    def power(self, values: Values, seed: int) -> Float:
        """Simulate a twin at each speed without noise of the accelerometer.

        Parameters
        ----------
        values : mapping of str to float
            Of unknowns, at the edge; that of the noise is left out.
        seed : int
            0 for track, background and bearing of the scene, others for others.

        Returns
        -------
        float64 array, shape [ride, axis, band]
            [m^2/s^4].
        """
        return np.stack([self._ride_track(values, seed, ride.shaft_frequency) for ride in self.rides])

    def levels(self, power: Float, noise: float) -> Float:
        """Add noise of a density to powers, shape [..., band], and give levels, [dB re 1 m/s^2]."""
        return np.asarray(10.0 * np.log10(power + noise**2 * self.reception.widths), np.float64)

    def _ride_track(self, values: Values, seed: int, shaft_frequency: float) -> Float:
        data = self._keys
        for name, value in values.items():
            if name != NOISE.name:
                data = BY_NAME[name].write_into(data, self.sensor, value, Path())
        duration = _SETTLING + self.reception.stretch + _SPARE
        data = {**data, "operation": operation_at(self.scene, shaft_frequency), "duration_s": duration}
        data["seed"] = self.scene.seed + seed
        if self.scene.scattered is not None:
            data["scatter"] = {**data["scatter"], "seed": self.scene.scattered.seed + seed}
        run = simulated(scene_from_mapping(data, f"scene {self.scene.name}", Path()))
        self.runs += 1
        signal = run.sensors[self.scene.sensors[self.sensor].name]
        count = round(self.reception.stretch * self.reception.rate)
        late = signal.values[signal.time_ns >= round(1e9 * _SETTLING)]
        if len(late) < count:
            raise ValidityError(f"scene {self.scene.name}: the twin ended early: {run.status}")
        received = np.asarray(late[:count, [AXES.index(axis) for axis in self.reception.axes]], np.float64)
        return np.asarray(10.0 ** (0.1 * levels_of(received, self.reception)), np.float64)


def operation_at(scene: Scene, shaft_frequency: float) -> dict[str, Any]:
    """Write the operation of a scene at a constant speed of the shaft [Hz].

    Raises
    ------
    InputError
        It is neither on a track nor constant.
    """
    course = scene.operation
    keys: dict[str, Any] = write_noun(course)
    if isinstance(course, QuarterVehicleOperation):
        speed_kmh = 3.6 * shaft_frequency * pi * course.wheel_diameter
        rest = {key: value for key, value in keys.items() if key not in _SPEEDS}
        return {**rest, "speed_profile": [{"time_s": 0.0, "speed_kmh": speed_kmh}]}
    if isinstance(course, ConstantOperation):
        return {**keys, "speed_rpm": 60.0 * shaft_frequency}
    raise InputError(
        f"scene {scene.name}: a twin compared with recordings runs on a track (kind: quarter_vehicle) or "
        "under a constant load (kind: constant)"
    )
