"""One scenario as the loads of several axleboxes of a car, each wheel over the same track a moment later.

Left and right boxes have axes of their own kind: x forwards, y to the left, z up, on both sides.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from beardyn_core.config import read_scene
from beardyn_core.errors import InputError
from beardyn_core.rail.build import load_history, load_of_scene
from beardyn_core.rail.measured import read_measurement
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.operation import MeasuredOperation, Operation, QuarterVehicleOperation
from beardyn_core.scene.running import distance_at
from beardyn_core.scene.scene import Scene
from beardyn_ros.car import Box
from beardyn_ros.scenario import Scenario, scenario_events

Float = NDArray[np.float64]

USUAL_WHEEL_DIAMETER = 0.92
# y of a force and of a displacement, x and z of a moment turn round in a mirror at the middle of the track
MIRRORED = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
LONGEST_LEAD_S = 3600.0


@dataclass(frozen=True)
class CarGeometry:
    """Where the axles of a car are, [m], and whose wheel has the defects of the scene.

    Parameters
    ----------
    axle_distance : float
        Between the axles of a bogie.
    bogie_distance : float
        Between the centres of the bogies.
    wheel_defects_on : str
        Name of a box.
    """

    axle_distance: float
    bogie_distance: float
    wheel_defects_on: str


class CarScenario:
    """Loads of all boxes of a car out of one scene or CSV.

    Parameters
    ----------
    boxes : tuple of Box
    geometry : CarGeometry
    scene : str
    csv : str
        '' for the scene's operation.
    duration : float
        Of the streams, 0 for the scene's own, or the whole CSV, [s].

    Notes
    -----
    The scene is the run of the first wheel. The others come over the same place of the track later: at a
    time t the force on a wheel that runs d behind is the one of the time at which the first wheel was d
    further back, ``s(t') = s(t) - d``; the speed of all shafts is that of now. All streams begin when the
    last wheel stands where the scene begins, so the scene is computed longer by that; a CSV gives less by
    that. While the train stands the delayed force rests at the last value, whatever it was.

    Right boxes get the rail model of the mirrored run, curves turned round, over another rail of the same
    kind (the next seed). Defects of the wheel are left to one box. Loads that are given (constant, stepped,
    measured) are the same left and right.

    Raises
    ------
    InputError
        The train does not get far enough, or turns back.
    """

    def __init__(
        self, boxes: tuple[Box, ...], geometry: CarGeometry, scene: str, csv: str, duration: float
    ) -> None:
        self._geometry = geometry
        self._scene = read_scene(scene).scene  # of which only the load matters
        if csv:
            self._scene = replace(self._scene, operation=MeasuredOperation(Path(csv)))
        length = duration or self._scene.duration
        if csv and not duration:
            time_s = read_measurement(Path(csv)).time
            length = float(time_s[-1] - time_s[0])
        reach = max(self._behind(box) for box in boxes)
        can_go_on = not isinstance(self._scene.operation, MeasuredOperation)
        self._length = length + (self._lead(reach) if can_go_on else 0.0)
        self._reach = reach
        self._variant = cache(self._computed)

    def _behind(self, box: Box) -> float:
        return box.behind(self._geometry.axle_distance, self._geometry.bogie_distance)

    def of(self, box: Box) -> Scenario:
        """Make the load of one box, with the truth about it."""
        scene, history = self._variant(box.side, box.name == self._geometry.wheel_defects_on)
        radius = 0.5 * _wheel_diameter(scene.operation)
        behind = self._behind(box)
        load, begin = passed_later(history, radius, behind, self._reach)
        events: Mapping[str, Any] = {
            **scenario_events(replace(scene, duration=self._length)),
            "box": {
                "name": box.name,
                "behind_first_wheel_m": behind,
                "begins_in_scene_s": begin,
                "events_are_of": "the first wheel, in the time of the scene",
            },
        }
        return Scenario(load, events)

    def _computed(self, side: str, with_wheel_defects: bool) -> tuple[Scene, LoadHistory]:
        scene = self._scene
        if isinstance(scene.operation, QuarterVehicleOperation):
            operation = scene.operation if with_wheel_defects else replace(scene.operation, wheel_defects=())
            scene = replace(scene, operation=operation)
            if side == "right":
                scene = replace(scene, operation=_mirrored(operation), seed=scene.seed + 1)
        history = load_of_scene(scene, self._length)
        if side == "right" and isinstance(scene.operation, QuarterVehicleOperation):
            history = LoadHistory(
                history.time_ns, history.wrench * MIRRORED, history.shaft_speed, history.bogie * MIRRORED[:3]
            )
        return scene, history

    def _lead(self, reach: float) -> float:
        """Compute how long the first wheel needs for a way, [s]."""
        operation = self._scene.operation
        if reach == 0.0:
            return 0.0
        if isinstance(operation, QuarterVehicleOperation):
            time = np.arange(0.0, LONGEST_LEAD_S, 0.01)
            way = distance_at(operation.speed_profile, time)
        else:
            load = load_history(
                operation,
                self._scene.mounting,
                self._scene.duration,
                self._scene.seed,
                bearing=self._scene.bearing,
            )
            time, way = load.time_ns * 1e-9, _way(load, 0.5 * USUAL_WHEEL_DIAMETER)
        return _time_at(reach, time, way)


def passed_later(
    history: LoadHistory, radius: float, behind: float, reach: float
) -> tuple[LoadHistory, float]:
    """Take the load of a wheel that comes over the same track later.

    Parameters
    ----------
    history : LoadHistory
        Of the first wheel, evenly spaced.
    radius : float
        Of the wheels, [m].
    behind : float
        How far the wheel runs behind the first one, [m].
    reach : float
        The same of the last wheel: the stream begins when that one is where the history begins, [m].

    Returns
    -------
    LoadHistory
        From time 0; force, moment and bogie of the wheel, speed of the train.
    float
        Time in the history at which it begins, [s].

    Raises
    ------
    InputError
        The train does not get as far as `reach`, or turns back.
    """
    if reach == 0.0:
        return history, 0.0
    time = (history.time_ns - history.time_ns[0]) * 1e-9
    way = _way(history, radius)
    first = int(np.searchsorted(time, _time_at(reach, time, way)))
    if len(history) - first < 2:
        raise InputError(f"the train is {reach:g} m long and gets no further than that: nothing is left")
    begin = float(time[first])
    stamps = history.time_ns[first:] - history.time_ns[first]
    if behind == 0.0:
        rest = history.part(first, len(history))
        return LoadHistory(stamps, rest.wrench, rest.shaft_speed, rest.bogie), begin
    # a standing train makes the way flat: the least of slopes keeps one time for each place
    then = np.interp(way[first:] - behind, way + 1e-9 * time, time)
    speed = np.ascontiguousarray(history.shaft_speed[first:])
    wrench, bogie = _at(then, time, history.wrench), _at(then, time, history.bogie)
    return LoadHistory(stamps, wrench, speed, bogie), begin


def _at(then: Float, time: Float, columns: Float) -> Float:
    """Interpolate columns, those that do not change left alone."""
    found = np.tile(columns[0], (len(then), 1))
    changing = np.ptp(columns, axis=0) > 0.0
    if changing.any():
        found[:, changing] = CubicSpline(time, columns[:, changing])(then)
    return found


def _way(history: LoadHistory, radius: float) -> Float:
    """Compute the distance run since the first sample, [m]."""
    speed = history.shaft_speed * radius
    step = np.diff(history.time_ns) * 1e-9
    return np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * step)])


def _time_at(reach: float, time: Float, way: Float) -> float:
    """Find the time at which a distance is run, [s]."""
    if np.any(np.diff(way) < -1e-9):
        raise InputError(
            "the train of the scenario turns back; the boxes of a car need a run forwards (axle 1 leads)"
        )
    if way[-1] < reach:
        raise InputError(
            f"the last axle is {reach:g} m behind the first, and the train of the scenario runs "
            f"{way[-1]:.1f} m: give a longer or faster run, or axle_distance and bogie_distance 0 for one "
            "load on all boxes"
        )
    return float(np.interp(reach, way + 1e-9 * time, time))


def _wheel_diameter(operation: Operation) -> float:
    return float(getattr(operation, "wheel_diameter", USUAL_WHEEL_DIAMETER) or USUAL_WHEEL_DIAMETER)


def _mirrored(operation: QuarterVehicleOperation) -> QuarterVehicleOperation:
    """Turn a run round at the middle of the track: what the left box gets there, the right one gets here."""
    other = {"left": "right", "right": "left"}
    curves = tuple(replace(curve, hand=other[curve.hand]) for curve in operation.curves)
    return replace(operation, curves=curves, lateral_force=-operation.lateral_force)
