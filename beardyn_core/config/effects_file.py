"""Which effects a scene simulates, and their options."""

from __future__ import annotations

from dataclasses import fields
from typing import Any, Self

from pydantic import Field, model_validator

from beardyn_core.config.effect_keys.audit import AuditKeys
from beardyn_core.config.effect_keys.cage import CageSwitch
from beardyn_core.config.effect_keys.contact_damping import ContactDampingKeys
from beardyn_core.config.effect_keys.drag import DragKeys
from beardyn_core.config.effect_keys.film import LineFilmKeys
from beardyn_core.config.effect_keys.gravity import GravityKeys
from beardyn_core.config.effect_keys.lamina_coupling import LaminaCouplingKeys
from beardyn_core.config.effect_keys.rib import RibKeys
from beardyn_core.config.effect_keys.ring_flexibility import RingFlexibilityKeys
from beardyn_core.config.effect_keys.rolling_resistance import RollingResistanceKeys
from beardyn_core.config.effect_keys.seal import SealKeys
from beardyn_core.config.effect_keys.small_rib import SmallRibKeys
from beardyn_core.config.effect_keys.thermal import ThermalKeys
from beardyn_core.config.effect_keys.traction import Traction
from beardyn_core.config.file_model import FileModel, Name, Switch, Text, problem
from beardyn_core.effects import EffectSet

_EFFECTS = frozenset(field.name for field in fields(EffectSet))


class EffectsKeys(FileModel):
    """The effects of a scene: options, `true` for the usual ones, `false` or nothing for absent."""

    name: Name = "custom"
    purpose: Text = ""
    preset: Name | None = Field(None, description="set to start from; the keys given here change it")
    contact_damping: Switch[ContactDampingKeys] = False
    lamina_coupling: Switch[LaminaCouplingKeys] = None
    traction: Traction | None = None
    film: Switch[LineFilmKeys] = False
    rolling_resistance: Switch[RollingResistanceKeys] = None
    drag: Switch[DragKeys] = None
    rib: Switch[RibKeys] = False
    small_rib: Switch[SmallRibKeys] = None
    cage: CageSwitch = False
    seal: Switch[SealKeys] = None
    ring_flexibility: Switch[RingFlexibilityKeys] = None
    gravity: Switch[GravityKeys] = False
    thermal: Switch[ThermalKeys] = None
    audit: Switch[AuditKeys] = False

    @model_validator(mode="after")
    def _heat_is_known(self) -> Self:
        if self.thermal and self.audit in (None, False):
            raise problem("thermal needs the audit, which tells what each source loses: set audit to true")
        return self

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        # Written out, so that a recorded scene says every number; `false` as the key that is not there.
        return {key: cls._switched(key, value) for key, value in data.items()}

    @classmethod
    def _switched(cls, key: str, value: Any) -> Any:
        if value is True:
            return {}
        return cls.model_fields[key].default if value is False and key in _EFFECTS else value

    def noun(self) -> EffectSet:
        """The effect set, SI."""
        return EffectSet(
            **{name: None if given is None else given.noun() for name, given in self._members().items()}
        )

    def _members(self) -> dict[str, Any]:
        return {field.name: getattr(self, field.name) or None for field in fields(EffectSet)}


def overlay(preset: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Effects of a preset with some changed: named options replace those of the preset, the rest stays."""
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
