"""JSON schema of the configuration files, for editors."""

from __future__ import annotations

from typing import Any

from beardyn_core.config.bearing_file import BearingKeys
from beardyn_core.config.effects_file import EffectsKeys
from beardyn_core.config.file_model import FileModel
from beardyn_core.config.lubricant_file import LubricantKeys
from beardyn_core.config.scene_file import SceneKeys
from beardyn_core.config.trial_file import TrialKeys
from beardyn_core.config.vehicle_file import VehicleKeys

_MODELS: dict[str, type[FileModel]] = {
    "scene": SceneKeys,
    "bearing": BearingKeys,
    "lubricant": LubricantKeys,
    "vehicle": VehicleKeys,
    "effects": EffectsKeys,
    "trial": TrialKeys,
}
SCHEMA_KINDS = tuple(_MODELS)


def json_schema(kind: str = "scene") -> dict[str, Any]:
    """JSON schema (2020-12) of one kind of file.

    Parameters
    ----------
    kind : str
        One of `SCHEMA_KINDS`.
    """
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        **_MODELS[kind].model_json_schema(),
        "title": f"beardyn {kind}",
    }
