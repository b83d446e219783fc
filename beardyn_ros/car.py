"""The axleboxes of a scene, or the eight of a car: one process for their twins, loads or recorders.

A member is a node of one box in its namespace, with all its topics, services and parameters. What the members
are made of is imported when they are made: a process has one kind of them.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rclpy.node import Node
from rclpy.parameter import Parameter
from std_srvs.srv import SetBool

from beardyn_core.base.errors import InputError
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_ros.node_parameters import (
    CAR_LOAD,
    CAR_RECORDER,
    CAR_TWIN,
    LOAD_OF_A_BOX,
    PARENT,
    POSE,
    PUBLISH_CLOCK,
    RECORDER,
    TWIN_OF_A_BOX,
)
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.rig import CAR, axleboxes_of, box_rig, boxes_named, place_of
from beardyn_ros.runtime import EXIT_DONE, EXIT_INCOMPLETE, run_node

if TYPE_CHECKING:
    from beardyn_ros.run_file import SharedFiles

NAMESPACE = "car"
QUICK_S = 0.02  # shortest period of a load node among several
SAID_BY_AXLEBOXES = {
    "axle_distance": "axle_distance_m",
    "bogie_distance": "bogie_distance_m",
    "wheel_defects_on": "faulty",
}


def train_of(values: ParameterValues, said: Mapping[str, str]) -> Axleboxes | None:
    """Read which axleboxes the scene of a node has; ``None``: it has one, and parameters make it a car.

    Parameters
    ----------
    values : ParameterValues
        With ``scene``.
    said : mapping
        Parameters of a car, each with the key of ``axleboxes`` that says the same.

    Raises
    ------
    InputError
        With every one of these that is given although the scene says it.
    """
    train = axleboxes_of(values.scene)
    if train is not None and (given := [name for name in said if values.is_given(name)]):
        raise InputError(
            [
                f"parameter '{name}': scene '{values.scene}' gives it, axleboxes.{said[name]}; leave the "
                "parameter out, or change the scene"
                for name in given
            ]
        )
    return train


class NodeGroup(Node):
    """A node with a member of its own kind for every box, all in one process.

    Parameters
    ----------
    name : str
        Of the node, in the namespace of the car.
    """

    members: Sequence[Any] = ()

    def __init__(self, name: str) -> None:
        super().__init__(name, namespace=NAMESPACE)
        self.members = []

    def of_member(self, box: Box, values: dict[str, Any]) -> dict[str, Any]:
        """Gather what the node of a box is made with: its namespace, and parameters as the group has them."""
        return {
            "namespace": f"{self.get_namespace().rstrip('/')}/{box.name}",
            "parameter_overrides": [Parameter(name, value=value) for name, value in values.items()],
            "use_global_arguments": False,
        }

    @property
    def finished(self) -> bool:
        """Whether every member has finished, or one with an error; an incomplete file stops no other box."""
        return all(member.finished for member in self.members) or any(
            member.finished and member.exit_code not in (EXIT_DONE, EXIT_INCOMPLETE)
            for member in self.members
        )

    @property
    def exit_code(self) -> int:
        """Exit code of the first member that has failed."""
        return next((code for member in self.members if (code := int(member.exit_code))), 0)

    def close(self) -> bool:
        """Close every member; whether a thread is still alive."""
        alive = [member.close() for member in self.members]
        return any(alive)

    def destroy_node(self) -> None:
        """Destroy the members, then the node."""
        for member in self.members:
            member.destroy_node()
        super().destroy_node()


class CarTwinNode(NodeGroup):
    """Simulates all boxes.

    Each has the scene of its box as `beardyn simulate` makes it of a scene with ``axleboxes``: another
    bearing of the lot, the right ones mirrored, the scene's defects in the faulty ones alone.
    """

    def __init__(self) -> None:
        from beardyn_ros.twin_node import TwinNode

        super().__init__("twin")
        values = ParameterValues(self, CAR_TWIN)
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
        given = {each.name: getattr(values, each.name) for each in TWIN_OF_A_BOX}
        given[PARENT.name] = values.parent_frame or self.get_namespace().strip("/")
        self.members = [
            TwinNode(
                box_rig(train, box),
                **self.of_member(
                    box,
                    {
                        **given,
                        POSE.name: place_of(train, box),
                        PUBLISH_CLOCK: values.publish_clock if box is boxes[0] else "false",
                    },
                ),
            )
            for box in boxes
        ]


class CarLoadNode(NodeGroup):
    """Feeds the twins of all boxes with one scenario, all in step.

    Nobody is sent load further ahead than the horizon of the slowest twin: eight twins stay together within
    it.
    """

    def __init__(self) -> None:
        from beardyn_ros.load_node import LoadNode
        from beardyn_ros.scenario import CarScenario

        super().__init__("load")
        values = ParameterValues(self, CAR_LOAD)
        train = train_of(values, SAID_BY_AXLEBOXES)
        boxes = boxes_named(values.boxes, train or CAR)
        scenario = CarScenario(boxes, train or _car(values, boxes), values.scene, values.csv, values.duration)
        given = {each.name: getattr(values, each.name) for each in LOAD_OF_A_BOX}

        def member_of(box: Box) -> LoadNode:
            return LoadNode(lambda *_: scenario.of(box), QUICK_S, **self.of_member(box, given))

        self.members = [member_of(box) for box in boxes]
        for member in self.members:
            member.company = self.members
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


class CarRecorderNode(NodeGroup):
    """Records every box: one crash-safe file for those of a scene, one a box for a car."""

    def __init__(self) -> None:
        from beardyn_ros.recorder_node import RecorderNode
        from beardyn_ros.run_file import SharedFiles

        super().__init__("recorder")
        values = ParameterValues(self, CAR_RECORDER)
        given = {each.name: getattr(values, each.name) for each in RECORDER}
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


def file_of(output: str, box: str) -> str:
    """Name the file of a box: ``run.mcap`` becomes ``run_axle_1_left.mcap``; '' takes ``car_<date>.mcap``."""
    path = Path(output or f"car_{time.strftime('%Y%m%d_%H%M%S')}.mcap")
    return str(path.with_name(f"{path.stem}_{box}{path.suffix or '.mcap'}"))


def run_twins(argv: Sequence[str]) -> int:
    """Run the twins until every run is over."""
    return run_node(CarTwinNode, argv)


def run_loads(argv: Sequence[str]) -> int:
    """Run the loads until everything is replayed to every box."""
    return run_node(CarLoadNode, argv)


def run_recorders(argv: Sequence[str]) -> int:
    """Run the recorders until every twin has ended."""
    return run_node(CarRecorderNode, argv)
