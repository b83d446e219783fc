"""Damping of every Hertz contact: the time constant of its spring."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


class DampingParams(NamedTuple):
    """Contact damping."""

    time_constant: float  # [s]


def damping_params(scene: Scene) -> DampingParams | None:
    """Take the time constant from the scene; ``None`` without the effect."""
    effect = scene.effects.contact_damping
    return DampingParams(effect.time_constant) if effect else None
