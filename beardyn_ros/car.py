"""The axleboxes of a scene, or the eight of a car: names, where they sit, one process for the nodes of all.

A scene says with ``axleboxes`` which there are; where it does not, they are those of a car of two bogies.
Axle 1 leads; a box is called ``axle_<n>_<side>``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from beardyn_core.base.errors import InputError
from beardyn_core.scene.axleboxes import AXLES_OF_A_CAR, Axleboxes, Box
from beardyn_ros.parameters import NodeParameter, ParameterValues
from beardyn_ros.run_state import Rig, scene_rig
from beardyn_ros.runtime import EXIT_DONE, EXIT_INCOMPLETE

CAR = Axleboxes(axles=AXLES_OF_A_CAR)
EIGHT_BOXES = tuple(box.name for box in CAR.boxes)
NAMESPACE = "car"
MOST_TOLD = 8
HALF_AXLE_M, AXLE_HEIGHT_M = 1.0, 0.46

BOXES = NodeParameter(
    "boxes",
    "",
    "some of the axleboxes, each a namespace below that of this node: axle_<number>_<left or right>, axle 1 "
    "leads; '': all that the axleboxes of the scene say, or all eight of a car",
)


def axleboxes_of(scene: str) -> Axleboxes | None:
    """Read which axleboxes a scene has, given by name or path; ``None`` for one that is of one box."""
    from beardyn_core.config import read_scene

    return read_scene(scene).scene.axleboxes


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
    if train is not None and (given := [name for name in said if values.given(name)]):
        raise InputError(
            [
                f"parameter '{name}': scene '{values.scene}' says it, axleboxes.{said[name]}; leave the "
                "parameter out, or change the scene"
                for name in given
            ]
        )
    return train


def boxes_named(text: str, train: Axleboxes = CAR, parameter: str = "boxes") -> tuple[Box, ...]:
    """Read a parameter of boxes: names with blanks or commas in between; all boxes where it has none.

    Raises
    ------
    InputError
        With every name that is none, or comes twice.
    """
    known = {box.name: box for box in train.boxes}
    names = text.replace(",", " ").split()
    allowed = list(known) if len(known) <= MOST_TOLD else [f"{next(iter(known))} to {list(known)[-1]}"]
    problems = [
        f"parameter '{parameter}': '{name}' is none of the axleboxes; allowed are {', '.join(allowed)}"
        for name in names
        if name not in known
    ]
    twice = [name for name in dict.fromkeys(names) if names.count(name) > 1 and name in known]
    problems += [f"parameter '{parameter}': '{name}' comes twice" for name in twice]
    if problems:
        raise InputError(problems)
    return tuple(known[name] for name in names or known)


def place_of(train: Axleboxes, box: Box) -> str:
    """Write where a box is, for the parameter ``pose_in_parent``, [m].

    x goes forwards from the middle of the first car, y left, z up from the top of the rail.
    """
    last = max((each for each in train.boxes if each.axle <= AXLES_OF_A_CAR), key=train.behind)
    x = 0.5 * train.behind(last) - train.behind(box)
    return f"{x:g} {HALF_AXLE_M if box.side == 'left' else -HALF_AXLE_M:g} {AXLE_HEIGHT_M:g} 0 0 0"


def box_rig(train: Axleboxes, box: Box) -> Callable[[str, str, str], Callable[[], Rig]]:
    """Make the loader of the rig of one box, see `TwinNode`."""
    from beardyn_core.config.boxes import scene_of_box

    place = {
        "name": box.name,
        "axle": box.axle,
        "side": box.side,
        "behind_first_wheel_m": train.behind(box),
    }

    def load(scene: str, tier: str, effects: str) -> Callable[[], Rig]:
        build = scene_rig(
            scene, tier, effects, lambda whole: scene_of_box(replace(whole, axleboxes=train), box)
        )

        def build_box() -> Rig:
            rig = build()
            truth = {**rig.description.truth, "box": place}
            description = replace(rig.description, truth=truth)
            return replace(rig, description=description, pictures=train.pictures)

        return build_box

    return load


def lone_box_rig(name: str) -> Callable[[str, str, str], Callable[[], Rig]]:
    """Make the loader of the rig of a box whose twin has a process of its own.

    It is as the scene's axleboxes say; where the scene has none, a box of a car with the scene's defects.
    """

    def load(scene: str, tier: str, effects: str) -> Callable[[], Rig]:
        train = axleboxes_of(scene)
        boxes = boxes_named(name, train or CAR, "box")
        if len(boxes) > 1:
            raise InputError(
                f"parameter 'box': '{name}' is not one box; node car_twin has the twins of several"
            )
        train = train or replace(CAR, faulty=(boxes[0].name,))
        return box_rig(train, boxes[0])(scene, tier, effects)

    return load


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
