"""The catalogue: every effect that a scene can switch on, with its description."""

from __future__ import annotations

from dataclasses import dataclass, fields
from types import NoneType
from typing import Annotated as A
from typing import get_args, get_type_hints

from beardyn_core.effects.about import About
from beardyn_core.effects.effect_set import EffectSet


@dataclass(frozen=True)
class Entry:
    """One choice of the catalogue."""

    member: A[str, "name of the effect in an `EffectSet` and in a scene"]
    options: A[type, "its options; several choices of one effect have the same member"]
    about: About


def catalogue() -> tuple[Entry, ...]:
    """List all effects in the order of `EffectSet`."""
    hints = get_type_hints(EffectSet)
    return tuple(
        Entry(field.name, options, options.about)
        for field in fields(EffectSet)
        for options in get_args(hints[field.name])
        if options is not NoneType
    )
