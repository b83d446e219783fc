"""The twins of all axleboxes of a scene, or of a car, in one process.

A member is a twin node in the namespace of its box, with all its topics, services and parameters. Each has
the scene of its box as `beardyn simulate` makes it of a scene with ``axleboxes``: another bearing of the lot,
the right ones mirrored, the scene's defects in the faulty ones alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from beardyn_core.base.errors import InputError
from beardyn_ros.car import BOXES, CAR, NodeGroup, box_rig, boxes_named, place_of, train_of
from beardyn_ros.frames import FRAME_ID
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.robot_description import PARENT, POSE
from beardyn_ros.runtime import run_node
from beardyn_ros.twin_node import TwinNode
from beardyn_ros.twin_parameters import BOX
from beardyn_ros.twin_parameters import PARAMETERS as TWIN_PARAMETERS

CLOCK = "publish_clock"
# every box has frame and place of its own; the first one publishes the clock for all
OWN = (FRAME_ID.name, BOX.name, CLOCK, PARENT.name, POSE.name)
BOX_PARAMETERS = tuple(each for each in TWIN_PARAMETERS if each.name not in OWN)
CAR_PARENT = replace(
    PARENT, description="frame that the axleboxes stand in, each in its place; empty: the namespace"
)
PARAMETERS = (
    BOXES,
    NodeParameter(
        "faulty",
        "",
        "boxes that have the defects of the scene, blanks or commas in between; '': those of the scene's "
        "axleboxes, or none",
    ),
    CAR_PARENT,
    *BOX_PARAMETERS,
)


class CarTwinNode(NodeGroup):
    """Simulates all boxes."""

    def __init__(self) -> None:
        super().__init__("twin")
        values = ParameterValues(self, PARAMETERS)
        train = train_of(values, {"faulty": "faulty"})
        if train is None:
            named = boxes_named(values.faulty, CAR, "faulty") if values.faulty.strip() else ()
            train = replace(CAR, faulty=tuple(box.name for box in named))
            strangers = [box for box in named if box not in boxes_named(values.boxes)]
            if strangers:
                raise InputError(
                    f"node twin: faulty has {', '.join(box.name for box in strangers)}; the boxes are "
                    f"{', '.join(box.name for box in boxes_named(values.boxes))}"
                )
        boxes = boxes_named(values.boxes, train)
        given = {each.name: getattr(values, each.name) for each in BOX_PARAMETERS}
        given[PARENT.name] = values.parent_frame or self.get_namespace().strip("/")
        self.members = [
            TwinNode(
                box_rig(train, box),
                **self.of_member(box, {**given, POSE.name: place_of(train, box), CLOCK: box is boxes[0]}),
            )
            for box in boxes
        ]


def main(argv: Sequence[str]) -> int:
    """Run the nodes until every run is over."""
    return run_node(CarTwinNode, argv)
