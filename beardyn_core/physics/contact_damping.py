"""Damping of every Hertz contact: the time constant of its spring, and what a step takes of it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from beardyn_core.base.jit import inline

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


class DampingParams(NamedTuple):
    """Contact damping."""

    time_constant: float  # [s]


def damping_params(scene: Scene) -> DampingParams | None:
    """Take the time constant from the scene; ``None`` without the effect."""
    effect = scene.effects.contact_damping
    return DampingParams(effect.time_constant) if effect else None


@inline
def implicit_time(spring_time, damping):
    """Work out the time that makes tangent stiffness an implicit resistance: dampers act in mid-step, [s]."""
    return spring_time + 0.5 * damper_time(damping)


@inline
def damper_time(damping):
    """Take the damping of a contact over its tangent stiffness, 0 without damping, [s]."""
    if damping is None:
        return 0.0
    return damping.time_constant
