"""The config room: YAML files in edge units become frozen nouns in SI, or every mistake at once.

=============== ==================================================="""

from beardyn_core.config.folders import config_folder, shipped_names
from beardyn_core.config.load import (
    explain_scene,
    load_bearing,
    load_effects,
    load_lubricant,
    load_scene,
    load_vehicle,
    scene_from_text,
)
from beardyn_core.config.schema import SCHEMA_KINDS, json_schema
from beardyn_core.config.trial_file import load_trial, trial_scene

__all__ = [
    "SCHEMA_KINDS",
    "config_folder",
    "explain_scene",
    "json_schema",
    "load_bearing",
    "load_effects",
    "load_lubricant",
    "load_scene",
    "load_trial",
    "load_vehicle",
    "scene_from_text",
    "shipped_names",
    "trial_scene",
]
