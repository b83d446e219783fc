"""One recorder process for all boxes of a car: a crash-safe file for each box."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from beardyn_core.errors import InputError
from beardyn_ros.car import BOXES, NodeGroup, boxes_named
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.recorder_node import PARAMETERS as RECORDER_PARAMETERS
from beardyn_ros.recorder_node import RecorderNode
from beardyn_ros.runtime import run_node

PARAMETERS = (BOXES, *RECORDER_PARAMETERS)


def file_of(output: str, box: str) -> str:
    """Name the file of a box: ``run.mcap`` becomes ``run_axle_1_left.mcap``; '' takes ``car_<date>.mcap``."""
    path = Path(output or f"car_{time.strftime('%Y%m%d_%H%M%S')}.mcap")
    return str(path.with_name(f"{path.stem}_{box}{path.suffix or '.mcap'}"))


class CarRecorderNode(NodeGroup):
    """Records every box of a car, each into a file of its own."""

    def __init__(self) -> None:
        super().__init__("recorder")
        values = ParameterValues(self, PARAMETERS)
        given = {parameter.name: getattr(values, parameter.name) for parameter in RECORDER_PARAMETERS}
        members, problems = [], []
        for box in boxes_named(values.boxes):
            own = {**given, "output": file_of(values.output, box.name)}
            try:
                members.append(RecorderNode(**self.of_member(box, own)))
            except InputError as error:
                problems += error.problems
        if problems:
            raise InputError(problems)
        self.members = members


def main(argv: Sequence[str]) -> int:
    """Run the node until every twin has ended."""
    return run_node(CarRecorderNode, argv)
