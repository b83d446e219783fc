"""The twins of all boxes of a car in one process.

A member is a twin node in the namespace of its box, with all its topics, services and parameters. Each has
the scene of its box as `beardyn simulate` makes it of a scene with ``axleboxes``: another bearing of the lot,
the right ones mirrored, the scene's defects in the faulty ones alone.
"""

from __future__ import annotations

from collections.abc import Sequence

from beardyn_core.errors import InputError
from beardyn_core.scene.axleboxes import Axleboxes
from beardyn_ros.car import BOXES, NodeGroup, box_rig, boxes_named
from beardyn_ros.frames import FRAME_ID
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.runtime import run_node
from beardyn_ros.twin_node import TwinNode
from beardyn_ros.twin_parameters import BOX
from beardyn_ros.twin_parameters import PARAMETERS as TWIN_PARAMETERS

CLOCK = "publish_clock"
# every box has the frame of its own namespace; the first one publishes the clock for all
BOX_PARAMETERS = tuple(each for each in TWIN_PARAMETERS if each.name not in (FRAME_ID.name, BOX.name, CLOCK))
PARAMETERS = (
    BOXES,
    NodeParameter(
        "faulty", "", "boxes that have the defects of the scene, blanks or commas in between; '' for none"
    ),
    *BOX_PARAMETERS,
)


class CarTwinNode(NodeGroup):
    """Simulates all boxes of a car."""

    def __init__(self) -> None:
        super().__init__("twin")
        values = ParameterValues(self, PARAMETERS)
        boxes = boxes_named(values.boxes)
        faulty = tuple(box.name for box in boxes_named(values.faulty)) if values.faulty.strip() else ()
        if strangers := [name for name in faulty if name not in [box.name for box in boxes]]:
            raise InputError(
                f"node twin: faulty has {', '.join(strangers)}; the boxes are "
                f"{', '.join(box.name for box in boxes)}"
            )
        given = {each.name: getattr(values, each.name) for each in BOX_PARAMETERS}
        car = Axleboxes(axles=4, faulty=faulty)
        self.members = [
            TwinNode(box_rig(car, box), **self.of_member(box, {**given, CLOCK: box is boxes[0]}))
            for box in boxes
        ]


def main(argv: Sequence[str]) -> int:
    """Run the nodes until every run is over."""
    return run_node(CarTwinNode, argv)
