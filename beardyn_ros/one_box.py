"""A scene with several axleboxes, where a node is of one: what to start instead."""

from __future__ import annotations

from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


def check_one_box(scene: Scene, scene_name: str, node: str, instead: str) -> None:
    """Refuse a scene that has ``axleboxes``.

    Parameters
    ----------
    scene : Scene
    scene_name : str
        Name or path, as the node was given it.
    node : str
        What is of one axlebox.
    instead : str
        Which node is of all.

    Raises
    ------
    InputError
    """
    if scene.axleboxes is None:
        return
    boxes = scene.axleboxes.boxes
    raise InputError(
        f"scene {scene.name}: has {len(boxes)} axleboxes, {boxes[0].name} to {boxes[-1].name}, and a {node} "
        f"is of one: `ros2 launch beardyn car.launch.py scene:={scene_name}` runs them all; {instead}"
    )
