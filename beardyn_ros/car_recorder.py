"""One recorder process for all axleboxes: one crash-safe file for those of a scene, one a box for a car."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_ros.car import BOXES, CAR, NodeGroup, axleboxes_of, boxes_named
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.recorder_node import PARAMETERS as RECORDER_PARAMETERS
from beardyn_ros.recorder_node import RecorderNode
from beardyn_ros.run_file import SharedFiles
from beardyn_ros.runtime import run_node

PARAMETERS = (
    BOXES,
    NodeParameter(
        "scene",
        "",
        "scene of the boxes: one with axleboxes is recorded into one file, each box under its namespace, or, "
        "with max_file_size or max_file_duration, a folder each; '' or another scene: a file each",
    ),
    *RECORDER_PARAMETERS,
)


def file_of(output: str, box: str) -> str:
    """Name the file of a box: ``run.mcap`` becomes ``run_axle_1_left.mcap``; '' takes ``car_<date>.mcap``."""
    path = Path(output or f"car_{time.strftime('%Y%m%d_%H%M%S')}.mcap")
    return str(path.with_name(f"{path.stem}_{box}{path.suffix or '.mcap'}"))


class CarRecorderNode(NodeGroup):
    """Records every box."""

    def __init__(self) -> None:
        super().__init__("recorder")
        values = ParameterValues(self, PARAMETERS)
        given = {parameter.name: getattr(values, parameter.name) for parameter in RECORDER_PARAMETERS}
        train = axleboxes_of(values.scene) if values.scene else None
        boxes = boxes_named(values.boxes, train or CAR)
        self._shared: SharedFiles | None = None
        if train is not None and not (values.max_file_size or values.max_file_duration):
            spaces = [str(self.of_member(box, {})["namespace"]) for box in boxes]
            self._shared = SharedFiles(spaces, replace=values.replace)
        members, problems = [], []
        for box in boxes:
            own = given if self._shared else {**given, "output": file_of(values.output, box.name)}
            try:
                members.append(RecorderNode(self._shared, **self.of_member(box, own)))
            except InputError as error:
                problems += error.problems
        if problems:
            raise InputError(list(dict.fromkeys(problems)))
        self.members = members

    def close(self) -> bool:
        """Close every member, then the file that they share."""
        alive = super().close()
        if self._shared is not None:
            self._shared.close()
        return alive


def main(argv: Sequence[str]) -> int:
    """Run the node until every twin has ended."""
    return run_node(CarRecorderNode, argv)
