"""The config room: YAML files in edge units become frozen nouns in SI, or every mistake at once.

============ ==================================================================
module       responsibility, in the order of the data
============ ==================================================================
folders      how a name becomes a file
yaml_text    YAML text to a mapping, and a scene back to YAML
file_model   base of the models: unknown keys explained, all mistakes kept
content      files that a scene is computed from, put into the scene
keys         from an annotated noun to the model of its file
derivation   what a bearing file of five numbers leaves to be derived
part_files   what the files of parts say otherwise than their nouns
scene_file   what a scene file says otherwise than its nouns; presets of effects
problems     refusals to sentences with file, key, value, what is allowed
automatic    what `auto` leaves open
missing      rows and rollers that are not there
boxes        the scene of one axlebox of several; a scene mirrored
nouns        files of one noun: bearings, lubricants, boxes, effects, trials
load         scenes: references resolved, every mistake found
catalogue    the catalogue of bearings: by designation, by dimensions
plates       bearing data by name
schema       JSON schema for editors
============ ==================================================================

`beardyn_core.choice` closes what a scene leaves open: `load_scene` is there.

Importing this room brings neither pydantic nor numpy along: a function does that when it is asked for.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from beardyn_core.config.folders import config_folder, shipped_names
    from beardyn_core.config.load import OpenScene, read_scene, read_scene_mapping, read_scene_text
    from beardyn_core.config.nouns import (
        load_any_bearing,
        load_background,
        load_bearing,
        load_box,
        load_effects,
        load_lubricant,
        load_sensor,
        load_vehicle,
        read_sweep,
        read_trial,
    )
    from beardyn_core.config.plates import load_plate
    from beardyn_core.config.schema import SCHEMA_KINDS, json_schema
    from beardyn_core.config.yaml_text import scene_text

__all__ = ["SCHEMA_KINDS", "OpenScene", "config_folder", "json_schema", "load_any_bearing"]
__all__ += ["load_background", "load_bearing"]
__all__ += ["load_box", "load_effects", "load_lubricant", "load_plate", "load_sensor", "load_vehicle"]
__all__ += [
    "read_scene",
    "read_scene_mapping",
    "read_scene_text",
    "read_sweep",
    "read_trial",
    "scene_text",
    "shipped_names",
]

_MODULES = {
    "SCHEMA_KINDS": "schema",
    "config_folder": "folders",
    "json_schema": "schema",
    "load_plate": "plates",
    "scene_text": "yaml_text",
    "shipped_names": "folders",
    **dict.fromkeys(("OpenScene", "read_scene", "read_scene_mapping", "read_scene_text"), "load"),
}


def __getattr__(name: str) -> Any:
    """Import what is asked for from the module that has it, most of it from `nouns`."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(f"{__name__}.{_MODULES.get(name, 'nouns')}"), name)
