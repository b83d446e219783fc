"""The config room: YAML files in edge units become frozen nouns in SI, or every mistake at once.

=============== ============================================================
module          responsibility, in the order of the data
=============== ============================================================
folders         where configuration lies; a name becomes a file
yaml_text       YAML text to a mapping and back
units           units in key names, factors to SI
file_model      base of the models: strict numbers, unknown keys explained
bearing_file    keys of a bearing
lubricant_file  keys of a lubricant
vehicle_file    keys of a vehicle
effects_file    keys of an effects preset
effect_keys     keys of each effect
excitation_file keys of irregularity and of defects of wheel and rail
running_file    keys of curves, braking, starting and timetables
measured_file   keys of load and speed from a file
defect_file     keys of defects, waviness and roughness
operation_file  keys of an operation
scene_file      keys of a scene
problems        refusals to sentences with file, key, value, what is allowed
missing         what of a scene speaks of rollers that are not there
automatic       `auto` to what has been chosen
load            references resolved, nouns made
trial_file      keys of a trial; the scene of one of its runs
schema          JSON schema for editors
=============== ============================================================
"""

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
