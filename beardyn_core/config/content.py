"""Files that a scene is computed from, put into the scene: a recording needs none of them."""

from __future__ import annotations

import operator
from dataclasses import replace
from pathlib import Path
from typing import Any

from beardyn_core.base.packed import pack_file
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.rail.transfer_path import content_of, read_transfer_path
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer, MeasuredPath
from beardyn_core.structure.mounted_box import is_path, table_path
from beardyn_core.structure.table import table_text_of


def located_table(effects: Any, folder: Path) -> Any:
    """Make the path of a table in the mapping of effects absolute, from the folder of their file."""
    structure = effects.get("structure") if isinstance(effects, dict) else None
    table = structure.get("table") if isinstance(structure, dict) else None
    if not isinstance(structure, dict) or not isinstance(table, str) or not is_path(table):
        return effects
    if structure.get("content"):  # names the file of another machine
        return effects
    return {**effects, "structure": {**structure, "table": str((folder / table).resolve())}}


def with_table(effects: EffectSet) -> EffectSet:
    """Put the table of a path into the effects; a shipped one stays a name.

    Raises
    ------
    InputError
        When it cannot be read.
    """
    structure = effects.structure
    if not isinstance(structure, ModalStructure) or structure.content or not is_path(structure.table):
        return effects
    path = Path(structure.table).resolve()
    content = pack_file(table_text_of(path), path)
    return replace(effects, structure=replace(structure, table=str(path), content=content))


def self_contained(scene: Scene) -> Scene:
    """Put the table of modes and the measured paths that a scene names into it.

    Raises
    ------
    InputError
        With what is wrong with a file.
    """
    effects, sensors = with_table(scene.effects), tuple(map(_with_paths, scene.sensors))
    if effects is scene.effects and all(map(operator.is_, sensors, scene.sensors)):
        return scene
    return replace(scene, effects=effects, sensors=sensors)


def files_of(scene: Scene) -> list[Path]:
    """List the files that a run of a scene reads: loads, irregularity, modes of a box, measured paths."""
    operation, structure = scene.operation, scene.effects.structure
    named = [getattr(each, "path", None) for each in (operation, getattr(operation, "irregularity", None))]
    if isinstance(structure, ModalStructure) and not structure.content:
        named.append(table_path(structure.table))
    named += [each.path for sensor in scene.sensors for each in sensor.measured_paths if not each.content]
    return [Path(each) for each in named if each is not None]


def _with_paths(sensor: Accelerometer) -> Accelerometer:
    if all(each.content for each in sensor.measured_paths):
        return sensor
    return replace(sensor, measured_paths=tuple(map(_with_content, sensor.measured_paths)))


def _with_content(measured: MeasuredPath) -> MeasuredPath:
    if measured.content:
        return measured
    path = measured.path.resolve()
    return replace(measured, path=path, content=content_of(read_transfer_path(path), path))
