"""The twin of one axlebox with the description of its run: of a scene, of one box of several, of a car.

A scene says with ``axleboxes`` which there are; where it does not, they are those of a car of two bogies.
Axle 1 leads; a box is called ``axle_<n>_<side>``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.record.description import RunDescription
from beardyn_core.scene.axleboxes import AXLES_OF_A_CAR, Axleboxes, Box

if TYPE_CHECKING:
    from beardyn_core.config.load import OpenScene
    from beardyn_core.scene.scene import Scene

SCENE_OWN = "scene"
CAR = Axleboxes(axles=AXLES_OF_A_CAR)
MOST_TOLD = 8
HALF_AXLE_M, AXLE_HEIGHT_M = 1.0, 0.46


def axleboxes_of(scene: str) -> Axleboxes | None:
    """Read which axleboxes a scene has, given by name or path; ``None`` for one that is of one box."""
    from beardyn_core.config import read_scene

    return read_scene(scene).scene.axleboxes


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


@dataclass(frozen=True)
class Rig:
    """A twin and the description of its run.

    Parameters
    ----------
    twin : beardyn_core.twin.Twin
        Or anything that keeps its contract.
    description : RunDescription
    background : str
        Name of a background with forces on the journal, which come with the load; empty without one.
    pictures : bool
        Whether bodies and contacts are published.
    tier_note : str
        Why the tier is not the best one, see `real_time.Kept`.
    """

    twin: Any
    description: RunDescription
    background: str = ""
    pictures: bool = True
    tier_note: str = ""


def scene_rig(
    scene_name: str,
    tier: str = SCENE_OWN,
    effects: str = SCENE_OWN,
    of_box: Callable[[Scene], Scene] | None = None,
    pace: float = 0.0,
) -> Callable[[], Rig]:
    """Make the builder of rigs for a scene by name or path; the scene is read and checked at once.

    What it leaves open is chosen when the first rig is built, also the tier where a pace is asked for.

    Parameters
    ----------
    scene_name : str
    tier : str
        `SCENE_OWN` for the scene's own.
    effects : str
        Preset, file or ``auto``; `SCENE_OWN` for the scene's own.
    of_box : callable, optional
        Makes the scene of one axlebox of several.
    pace : float
        Simulated seconds per wall second that are asked for; 0 for none.

    Raises
    ------
    InputError
        With every mistake in the scene, or it has several axleboxes and ``of_box`` is not given.
    """
    from beardyn_core.choice.load import complete_scene
    from beardyn_core.config import read_scene
    from beardyn_core.twin import Twin
    from beardyn_ros.real_time import Kept, keep_pace

    def read(tier: str) -> OpenScene:
        given = {("tier",): tier, ("effects",): effects}
        return read_scene(scene_name, {place: each for place, each in given.items() if each != SCENE_OWN})

    found = read(tier)
    if of_box is None:
        instead = "the parameter box of the twin names one of them, node car_twin has the twins of all"
        check_one_box(found.scene, scene_name, "twin", instead)
    background = found.scene.background
    forces = background.name if background is not None and background.forces else ""

    @cache
    def chosen() -> Kept:
        tier_is_open = found.free.tier or (found.free.effects and "tier" not in found.keys)
        if pace > 0.0 and tier_is_open:
            return keep_pace(found, read, pace, of_box=of_box)
        whole = complete_scene(found, outside_load=True)
        return Kept(whole if of_box is None else of_box(whole), whole.tier, "")

    def build() -> Rig:
        kept = chosen()
        twin = Twin(kept.scene)
        description = RunDescription.of(kept.scene, twin.truth(), twin.body_names)
        if kept.note:
            description = replace(description, truth={**description.truth, "tier_note": kept.note})
        return Rig(twin, description, forces, tier_note=kept.note)

    return build


def box_rig(train: Axleboxes, box: Box, pace: float = 0.0) -> Callable[[str, str, str], Callable[[], Rig]]:
    """Make the loader of the rig of one box, see `TwinNode` and, for ``pace``, `scene_rig`."""
    from beardyn_core.config.boxes import scene_of_box

    place = {
        "name": box.name,
        "axle": box.axle,
        "side": box.side,
        "behind_first_wheel_m": train.behind(box),
    }

    def load(scene: str, tier: str, effects: str) -> Callable[[], Rig]:
        build = scene_rig(
            scene, tier, effects, lambda whole: scene_of_box(replace(whole, axleboxes=train), box), pace
        )

        def build_box() -> Rig:
            rig = build()
            truth = {**rig.description.truth, "box": place}
            description = replace(rig.description, truth=truth)
            return replace(rig, description=description, pictures=train.pictures)

        return build_box

    return load


def lone_box_rig(name: str, pace: float = 0.0) -> Callable[[str, str, str], Callable[[], Rig]]:
    """Make the loader of the rig of a box whose twin has a process of its own; ``pace`` as of `scene_rig`.

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
        return box_rig(train, boxes[0], pace)(scene, tier, effects)

    return load
