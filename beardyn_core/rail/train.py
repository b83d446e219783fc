"""One operation as the loads of several axleboxes, each wheel over the same track a moment later.

Left and right boxes have axes of their own kind: x forwards, y to the left, z up, on both sides.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache
from typing import Annotated as A

import numpy as np
from scipy.interpolate import CubicSpline

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.rail.build import load_history, load_of_scene
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.operation import MeasuredOperation, Operation, QuarterVehicleOperation
from beardyn_core.scene.running import distance_at
from beardyn_core.scene.scene import Scene

USUAL_WHEEL_DIAMETER = 0.92
# y of a force and of a displacement, x and z of a moment turn round in a mirror at the middle of the track
MIRRORED = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
LONGEST_LEAD_S = 3600.0


@dataclass(frozen=True)
class BoxLoad:
    """Load of one box."""

    history: LoadHistory
    scene: A[Scene, "with the operation that it was computed from: that of the mirrored run on the right"]
    begins: A[float, "time of the scene at which the load begins, [s]"]
    behind: A[float, "how far the wheel runs behind the first, [m]"]


class TrainLoads:
    """Loads of several axleboxes out of one scene.

    Parameters
    ----------
    scene : Scene
        Of which only the load matters.
    train : Axleboxes
    boxes : tuple of Box
        Those of the train that are wanted.
    duration : float
        Of the loads, [s].

    Notes
    -----
    The scene is the run of the first wheel. The others come over the same place of the track later: at a
    time t the force on a wheel that runs d behind is the one of the time at which the first wheel was d
    further back, ``s(t') = s(t) - d``; the speed of all shafts is that of now. All loads begin when the
    last wheel stands where the scene begins, so the scene is computed longer by that; a measured run gives
    less by that. While the train stands the delayed force rests at the last value, whatever it was.

    Right boxes get the rail model of the mirrored run, curves turned round, over another rail of the same
    kind (the next seed). Defects of the wheel are left to the faulty boxes. Loads that are given (constant,
    stepped, measured) are the same left and right.

    Raises
    ------
    InputError
        The train does not get far enough, or turns back.
    """

    def __init__(self, scene: Scene, train: Axleboxes, boxes: tuple[Box, ...], duration: float) -> None:
        self._scene, self._train = scene, train
        self._reach = max(map(train.behind, boxes))
        can_go_on = not isinstance(scene.operation, MeasuredOperation)
        self.length = duration + (self._lead() if can_go_on else 0.0)
        self._variant = cache(self._compute_load)

    def of(self, box: Box) -> BoxLoad:
        """Make the load of one box."""
        scene, history = self._variant(box.side, box.name in self._train.faulty)
        behind = self._train.behind(box)
        load, begins = passed_later(history, 0.5 * _wheel_diameter(scene.operation), behind, self._reach)
        return BoxLoad(load, scene, begins, behind)

    def _compute_load(self, side: str, with_wheel_defects: bool) -> tuple[Scene, LoadHistory]:
        scene = self._scene
        if isinstance(scene.operation, QuarterVehicleOperation):
            operation = scene.operation if with_wheel_defects else replace(scene.operation, wheel_defects=())
            scene = replace(scene, operation=operation)
            if side == "right":
                scene = replace(scene, operation=_mirror_operation(operation), seed=scene.seed + 1)
        history = load_of_scene(scene, self.length)
        if side == "right" and isinstance(scene.operation, QuarterVehicleOperation):
            history = LoadHistory(
                history.time_ns, history.wrench * MIRRORED, history.shaft_speed, history.bogie * MIRRORED[:3]
            )
        return scene, history

    def _lead(self) -> float:
        """Compute how long the first wheel needs for the way of the last, [s]."""
        operation = self._scene.operation
        if self._reach == 0.0:
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
        return _time_at(self._reach, time, way)


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
            f"{way[-1]:.1f} m: give a longer or faster run, or distances of 0 for one load on all boxes"
        )
    return float(np.interp(reach, way + 1e-9 * time, time))


def _wheel_diameter(operation: Operation) -> float:
    return float(getattr(operation, "wheel_diameter", USUAL_WHEEL_DIAMETER) or USUAL_WHEEL_DIAMETER)


def _mirror_operation(operation: QuarterVehicleOperation) -> QuarterVehicleOperation:
    """Turn a run round at the middle of the track: what the left box gets there, the right one gets here."""
    other = {"left": "right", "right": "left"}
    curves = tuple(replace(curve, hand=other[curve.hand]) for curve in operation.curves)
    return replace(operation, curves=curves, lateral_force=-operation.lateral_force)
