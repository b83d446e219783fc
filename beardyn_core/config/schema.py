"""JSON schema of the configuration files, for editors."""

from __future__ import annotations

from typing import Any

from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config.keys import in_order, keys_of
from beardyn_core.config.scene_file import EffectSet, Scene
from beardyn_core.scene.background import Background
from beardyn_core.scene.operation import Vehicle
from beardyn_core.scene.sensor import SensorType
from beardyn_core.scene.sweep import Sweep
from beardyn_core.scene.trial import Trial
from beardyn_core.structure.box import Box
from beardyn_core.structure.fitting import FittedBox
from beardyn_core.structure.imported import ModeFile

_NOUNS: dict[str, type] = {
    "scene": Scene,
    "bearing": Bearing,
    "cylindrical_bearing": CylindricalBearing,
    "spherical_bearing": SphericalBearing,
    "lubricant": Lubricant,
    "vehicle": Vehicle,
    "effects": EffectSet,
    "trial": Trial,
    "sweep": Sweep,
    "structure": Box,
    "fitted": FittedBox,
    "modes": ModeFile,
    "sensor": SensorType,
    "background": Background,
    "bearing_data": NamePlate,
}
SCHEMA_KINDS = tuple(_NOUNS)


def json_schema(kind: str = "scene") -> dict[str, Any]:
    """Make the JSON schema (2020-12) of one kind of file.

    Parameters
    ----------
    kind : str
        One of `SCHEMA_KINDS`.
    """
    model = keys_of(_NOUNS[kind])
    schema = model.model_json_schema()
    for name, part in {model.__name__: schema, **schema.get("$defs", {})}.items():
        if "properties" in part:
            part["properties"] = {key: part["properties"][key] for key in in_order(name, part["properties"])}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema, "title": f"beardyn {kind}"}
