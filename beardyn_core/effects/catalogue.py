"""The catalogue: every effect that a scene can switch on, with its description."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields, is_dataclass
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


def heat_by_loss() -> dict[str, Mapping[str, float]]:
    """List the sources of loss of all effects and their options, with the parts that each of them warms."""
    return {about.loss: about.heat for about in abouts() if about.loss}


def abouts() -> Iterator[About]:
    """List the descriptions of all effects, and of options that have their own."""
    for entry in catalogue():
        yield entry.about
        hints = get_type_hints(entry.options)
        for option in (each for field in fields(entry.options) for each in get_args(hints[field.name])):
            if is_dataclass(option) and hasattr(option, "about"):
                yield option.about
