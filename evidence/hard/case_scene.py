"""The scene and the load of a hard case."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from beardyn_core.choice import scene_from_text
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file, write_mapping
from beardyn_core.rail.build import load_of_scene
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from evidence.hard.case import HardCase, Point
from evidence.hard.refinement import APART

_BLOCK_S = 0.02


def scene_of(case: HardCase) -> Scene:
    """Build the scene of a case; raises `InputError` with every mistake."""
    data = {"effects": "standard", **read_file(find("scenes", case.scene))}
    if "bearing" in case.changes:
        data["bearing"] = read_file(find("bearings", str(data["bearing"])))
    scene = scene_from_text(write_mapping(merged(data, case.changes)), case.name)
    scene = replace(scene, end_play=scene.end_play + case.start * APART)
    return replace(scene, name=case.name, duration=case.duration) if not case.forced else _forced(scene, case)


def merged(base: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """Put `changes` into `base`: mappings are merged, all else is replaced."""
    result = dict(base)
    for key, value in changes.items():
        below = result.get(key)
        both = isinstance(below, Mapping) and isinstance(value, Mapping)
        # another kind of operation or effect has other keys
        same = both and ("kind" not in value or value["kind"] == below.get("kind"))  # type: ignore[union-attr]
        result[key] = merged(below, value) if same else value  # type: ignore[arg-type]
    return result


def _forced(scene: Scene, case: HardCase) -> Scene:
    of_cage = {k.removeprefix("cage."): v for k, v in case.forced.items() if k.startswith("cage.")}
    of_bearing = {k: v for k, v in case.forced.items() if not k.startswith("cage.")}
    cage = replace(scene.bearing.cage, **of_cage)
    bearing = replace(scene.bearing, forced=True, cage=cage, **of_bearing)
    return replace(scene, name=case.name, duration=case.duration, bearing=bearing)


def load_of(case: HardCase, scene: Scene) -> LoadHistory:
    """Return the load of the whole run and a little more."""
    if case.load:
        return history(case.load)
    return load_of_scene(scene, case.duration + 2.0 * _BLOCK_S)


def history(points: tuple[Point, ...]) -> LoadHistory:
    """Sample points of load and speed."""
    return LoadHistory(
        np.array([round(point.time * 1e9) for point in points], dtype=np.int64),
        np.array([[*point.force, *point.moment] for point in points], dtype=float),
        np.array([point.speed for point in points], dtype=float),
        np.zeros((len(points), 3)),
    )
