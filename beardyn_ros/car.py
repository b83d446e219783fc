"""The eight axleboxes of a car: their names, where they sit, and one process for the nodes of all.

A car has two bogies of two axles. Axle 1 leads; a box is called ``axle_<n>_<side>``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from re import fullmatch
from typing import Any

from rclpy.node import Node
from rclpy.parameter import Parameter

from beardyn_core.errors import InputError
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_ros.parameters import NodeParameter
from beardyn_ros.run_state import Rig, scene_rig
from beardyn_ros.runtime import EXIT_DONE, EXIT_INCOMPLETE

EIGHT_BOXES = tuple(box.name for box in Axleboxes(axles=4).boxes)
NAMESPACE = "car"

BOXES = NodeParameter(
    "boxes",
    " ".join(EIGHT_BOXES),
    "axleboxes, each a namespace below that of this node: axle_<1 to 4>_<left or right>, axle 1 leads",
)


def boxes_named(text: str) -> tuple[Box, ...]:
    """Read the parameter ``boxes``: names with blanks or commas in between.

    Raises
    ------
    InputError
        With every name that is none, or comes twice.
    """
    names = text.replace(",", " ").split()
    problems = [] if names else ["parameter 'boxes' is empty; name one box at least, such as axle_1_left"]
    boxes: list[Box] = []
    for name in names:
        found = fullmatch(r"axle_([1-4])_(left|right)", name)
        if found is None:
            problems.append(
                f"parameter 'boxes': '{name}' is no axlebox of a car; allowed are {', '.join(EIGHT_BOXES)}"
            )
        elif names.count(name) > 1 and name in [box.name for box in boxes]:
            problems.append(f"parameter 'boxes': '{name}' comes twice")
        else:
            boxes.append(Box(name, int(found[1]), found[2]))
    if problems:
        raise InputError(problems)
    return tuple(boxes)


def box_rig(car: Axleboxes, box: Box) -> Callable[[str, str, str], Callable[[], Rig]]:
    """Make the loader of the rig of one box, see `TwinNode`."""
    from beardyn_core.config.boxes import scene_of_box

    def load(scene: str, tier: str, effects: str) -> Callable[[], Rig]:
        return scene_rig(scene, tier, effects, lambda whole: scene_of_box(replace(whole, axleboxes=car), box))

    return load


def lone_box_rig(name: str) -> Callable[[str, str, str], Callable[[], Rig]]:
    """Make the loader of the rig of a box whose twin has a process of its own: with the scene's defects."""
    (box,) = boxes_named(name)
    return box_rig(Axleboxes(axles=4, faulty=(name,)), box)


class NodeGroup(Node):
    """A node with a member of its own kind for every box of a car, all in one process.

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
