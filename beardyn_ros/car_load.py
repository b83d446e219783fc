"""The load of every axlebox of a scene, or of a car, from one process, all in step.

A member is a load node in the namespace of its box, with all its topics, services and live parameters.
Nobody is sent load further ahead than the horizon of the slowest twin: eight twins stay together within it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from std_srvs.srv import SetBool

from beardyn_core.base.errors import InputError
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_ros.car import BOXES, CAR, NodeGroup, boxes_named, train_of
from beardyn_ros.car_scenario import CarScenario
from beardyn_ros.frames import FRAME_ID
from beardyn_ros.load_node import LoadNode
from beardyn_ros.load_parameters import PARAMETERS as LOAD_PARAMETERS
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.runtime import run_node

QUICK_S = 0.02

OF_A_CAR = (
    NodeParameter(
        "axle_distance",
        CAR.axle_distance,
        "between the axles of a bogie; of a scene with axleboxes it is theirs",
        "m",
        minimum=0.0,
        maximum=5.0,
    ),
    NodeParameter(
        "bogie_distance",
        CAR.bogie_distance,
        "between the centres of the bogies; of a scene with axleboxes it is theirs",
        "m",
        minimum=0.0,
        maximum=30.0,
    ),
    NodeParameter(
        "wheel_defects_on",
        "axle_1_left",
        "box whose wheel has the defects of the scene's wheel; '' for none; of a scene with axleboxes: the "
        "faulty ones",
    ),
)
SAID_BY_AXLEBOXES = {
    "axle_distance": "axle_distance_m",
    "bogie_distance": "bogie_distance_m",
    "wheel_defects_on": "faulty",
}
# every box has the frame of its own namespace
BOX_PARAMETERS = tuple(each for each in LOAD_PARAMETERS if each.name != FRAME_ID.name)
PARAMETERS = (BOXES, *OF_A_CAR, *BOX_PARAMETERS)


class BoxLoadNode(LoadNode):
    """Load node of one box, held back by the slowest of all."""

    car: Sequence[BoxLoadNode] = ()

    def __init__(self, scenario: CarScenario, box: Box, **of_node: Any) -> None:
        super().__init__(lambda _scene, _csv, _duration: scenario.of(box), **of_node)
        if not self._live:
            self._quick_s = QUICK_S

    def _latest_credit(self) -> int:
        return min((member._credit.time_ns for member in self.car), default=self._credit.time_ns)


class CarLoadNode(NodeGroup):
    """Feeds the twins of all boxes with one scenario."""

    def __init__(self) -> None:
        super().__init__("load")
        values = ParameterValues(self, PARAMETERS)
        train = train_of(values, SAID_BY_AXLEBOXES)
        boxes = boxes_named(values.boxes, train or CAR)
        scenario = CarScenario(boxes, train or _car(values, boxes), values.scene, values.csv, values.duration)
        given = {parameter.name: getattr(values, parameter.name) for parameter in BOX_PARAMETERS}
        self.members = [BoxLoadNode(scenario, box, **self.of_member(box, given)) for box in boxes]
        for member in self.members:
            member.car = self.members
        self.create_service(SetBool, "load/pause", self._on_pause)

    def _on_pause(self, request: Any, response: Any) -> Any:
        for member in self.members:
            response = member._on_pause(request, response)
        return response


def _car(values: ParameterValues, boxes: Sequence[Box]) -> Axleboxes:
    """Make the car that the parameters say, for a scene that has one axlebox."""
    names = [box.name for box in boxes]
    if values.wheel_defects_on and values.wheel_defects_on not in names:
        raise InputError(
            f"node load: wheel_defects_on '{values.wheel_defects_on}' is none of the boxes {', '.join(names)}"
        )
    return replace(
        CAR,
        axle_distance=values.axle_distance,
        bogie_distance=values.bogie_distance,
        faulty=(values.wheel_defects_on,) if values.wheel_defects_on else (),
    )


def main(argv: Sequence[str]) -> int:
    """Run the node until everything is replayed to every box."""
    return run_node(CarLoadNode, argv)
