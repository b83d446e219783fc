"""One scenario as the loads of several axleboxes of a car: see `beardyn_core.rail.train`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from beardyn_core.config import read_scene
from beardyn_core.rail.measured import read_measurement
from beardyn_core.rail.train import TrainLoads
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_core.scene.operation import MeasuredOperation
from beardyn_ros.scenario import Scenario, scenario_events


class CarScenario:
    """Loads of all boxes of a car out of one scene or CSV.

    Parameters
    ----------
    boxes : tuple of Box
    car : Axleboxes
    scene : str
    csv : str
        '' for the scene's operation.
    duration : float
        Of the streams, 0 for the scene's own, or the whole CSV, [s].

    Raises
    ------
    InputError
        The train does not get far enough, or turns back.
    """

    def __init__(self, boxes: tuple[Box, ...], car: Axleboxes, scene: str, csv: str, duration: float) -> None:
        found = read_scene(scene).scene  # of which only the load matters
        if csv:
            found = replace(found, operation=MeasuredOperation(Path(csv)))
        length = duration or found.duration
        if csv and not duration:
            time_s = read_measurement(Path(csv)).time
            length = float(time_s[-1] - time_s[0])
        self._loads = TrainLoads(found, car, boxes, length)

    def of(self, box: Box) -> Scenario:
        """Make the load of one box, with the truth about it."""
        load = self._loads.of(box)
        events: Mapping[str, Any] = {
            **scenario_events(replace(load.scene, duration=self._loads.length)),
            "box": {
                "name": box.name,
                "behind_first_wheel_m": load.behind,
                "begins_in_scene_s": load.begins,
                "events_are_of": "the first wheel, in the time of the scene",
            },
        }
        return Scenario(load.history, events)
