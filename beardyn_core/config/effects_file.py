"""Which effects a scene simulates: a preset, and what changes it."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from beardyn_core.config.file_model import FileModel
from beardyn_core.config.keys import Name, Text, reads
from beardyn_core.effects import EffectSet


@reads(EffectSet)
class EffectsFile(FileModel):
    """The effects of a scene: options, `true` for the usual ones, `false` or nothing for absent."""

    name: Name = Field("custom", description="of the set")
    purpose: Text = Field("", description="one line: what the set is for")
    preset: Name | None = Field(None, description="set to start from; the keys given here change it")

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        return super()._prepare({**data, "traction": None} if data.get("traction") is False else data)


def overlay(preset: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Change the effects of a preset: named options replace those of the preset, the rest stays."""
    merged = dict(preset)
    for key, change in changes.items():
        base = preset.get(key)
        if (
            isinstance(change, dict)
            and isinstance(base, dict)
            and change.get("kind", base.get("kind")) == base.get("kind")
        ):
            merged[key] = {**base, **change}
        elif change is True and isinstance(base, dict):
            merged[key] = base
        else:
            merged[key] = change
    return merged
