"""The scene that most tests are about, and how it is changed."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import yaml

from beardyn_core.bearing.any_bearing import require_tapered
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.choice import load_scene, scene_from_mapping, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.effects import EffectSet
from beardyn_core.scene.defect import Defect
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness

SPEED = 122.0
LOAD_80_KN = (0.0, 0.0, 8.0e4)

# effects that are chosen, without the box of the scene, which rings
RIGID: dict[str, Any] = {"preset": "auto"}


@cache
def standard_scene() -> Scene:
    """The shipped 80 kN scene: cup held, no play, the effects of `EffectSet()`."""
    return replace(load_scene("static_80kN"), effects=EffectSet())


def tapered(scene: Scene) -> Bearing:
    """The bearing of a scene that has a tapered one."""
    return require_tapered(scene.bearing, "tests of tapered rollers")


def scene_with(
    effects: EffectSet | None = None,
    *,
    end_play: float | None = None,
    defects: tuple[Defect, ...] = (),
    waviness: tuple[Waviness, ...] = (),
    laminae: int = 6,
    steps_per_sample: int = 4,
    roller_count: int | None = None,
    **mounting: Any,
) -> Scene:
    """The standard scene with a few things changed."""
    scene = standard_scene()
    bearing = scene.bearing
    if roller_count is not None:
        bearing = replace(bearing, roller_count=roller_count)
    return replace(
        scene,
        bearing=bearing,
        effects=scene.effects if effects is None else effects,
        end_play=scene.end_play if end_play is None else end_play,
        defects=defects,
        waviness=waviness,
        mounting=replace(scene.mounting, **mounting),
        numerics=replace(scene.numerics, laminae=laminae, steps_per_sample=steps_per_sample),
    )


def scene_with_keys(**changes: Any) -> Scene:
    """The shipped 80 kN scene with other keys of its file."""
    data = yaml.safe_load(scene_text(load_scene("static_80kN")))
    return scene_from_text(yaml.safe_dump({**data, **changes}))


def rigid_scene(name: str, **given: Any) -> Scene:
    """A shipped scene without its effects, so in a rigid box; ``given`` are keys of its file."""
    keys = {**read_file(find("scenes", name)), **given}
    keys.pop("effects", None)
    return scene_from_mapping(keys, name, find("scenes", name).parent)
