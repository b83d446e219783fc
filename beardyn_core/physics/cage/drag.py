"""Torques that effects put on the cages against cup and cone, from the plain laws of the effects.

An effect whose options have a ``cage_law`` takes part without a word here, see `CageDrag`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, Protocol

from beardyn_core.base.jit import inline, part_of
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects.catalogue import catalogue
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.losses import LOSS_NAMES
from beardyn_core.physics.bodies.rigid_bodies import full_rotation, ring_direction
from beardyn_core.physics.lanes.vectors import dot, subtract
from beardyn_core.scene.scene import Scene


class CageDrag(Protocol):
    """Options of an effect that brakes the cages."""

    @staticmethod
    def cage_law(from_cup: float, from_cone: float, parameters: Any) -> tuple[float, float]:
        """Compute the torques of cup and cone against one cage that turns faster by so much, [N m], [rad/s].

        In plain Python with `math`, compiled with what it calls in its module. Positive where it brakes.
        """

    def parameters(self, bearing: RollerBearing, temperature: float) -> NamedTuple:
        """Work out what the law needs, for the kernels: nothing but floats in named tuples; [K]."""


class _Law(NamedTuple):
    member: str  # of the effect set
    loss: str  # of ``LOSS_NAMES``
    plain: Callable[..., tuple[float, float]]


_LAWS = tuple(
    _Law(entry.member, entry.about.loss, entry.options.cage_law)
    for entry in catalogue()
    if hasattr(entry.options, "cage_law")
)
CAGE_DRAGS = tuple(law.member for law in _LAWS)


def cage_drag_params(scene: Scene) -> tuple[Any, ...] | None:
    """Work out the parameters of every effect that brakes the cages, ``None`` where nothing does."""
    if scene.effects.cage is None or not any(getattr(scene.effects, name) for name in CAGE_DRAGS):
        return None
    return tuple(_parameters(scene, name) for name in CAGE_DRAGS)


def _parameters(scene: Scene, name: str) -> Any:
    options: CageDrag | None = getattr(scene.effects, name)
    return None if options is None else options.parameters(scene.bearing, scene.temperature)


def cage_drag_torque(scene: Scene, speed: float) -> dict[str, float]:
    """Work out the torque on the shaft of every effect that brakes the cages, rolling purely, [N m].

    By source of loss; ``speed``: of the shaft, [rad/s].
    """
    turning = cage_speed(scene.bearing, speed)
    found = {}
    for law in _LAWS:
        parameters = _parameters(scene, law.member)
        if parameters is not None and scene.effects.cage is not None and speed != 0.0:
            on_cup, on_cone = law.plain(turning, turning - speed, parameters)
            power = on_cup * turning + on_cone * (turning - speed)
            found[law.loss] = scene.rows * power / speed
    return found


@inline
def _nothing(bodies, wrenches, energy, step, drags):
    """Brake nothing."""


def _brakes_by(law: _Law) -> Any:
    compiled, loss = part_of(law.plain), layout.ENERGY_LOST + LOSS_NAMES.index(law.loss)

    @inline
    def brake(bodies, wrenches, energy, step, parameters):
        if parameters is None:
            return
        cup = full_rotation(bodies, layout.CUP_BODY, ring_direction(bodies, layout.CUP_BODY))
        cone = full_rotation(bodies, layout.CONE_BODY, ring_direction(bodies, layout.CONE_BODY))
        for body in range(layout.CAGE_BODY, bodies.shape[0]):
            axis = ring_direction(bodies, body)
            turning = full_rotation(bodies, body, axis)
            from_cup, from_cone = dot(subtract(turning, cup), axis), dot(subtract(turning, cone), axis)
            of_cup, of_cone = compiled(from_cup, from_cone, parameters)
            for i in range(3):
                wrenches[body, 3 + i] -= (of_cup + of_cone) * axis[i]
                wrenches[layout.CUP_BODY, 3 + i] += of_cup * axis[i]
                wrenches[layout.CONE_BODY, 3 + i] += of_cone * axis[i]
            energy[loss] += step * (of_cup * from_cup + of_cone * from_cone)

    return brake


def _after(first: Any, brake: Any, place: int) -> Any:
    @inline
    def both(bodies, wrenches, energy, step, drags):
        first(bodies, wrenches, energy, step, drags)
        brake(bodies, wrenches, energy, step, drags[place])

    return both


_brake_all = _nothing
for _place, _law in enumerate(_LAWS):
    _brake_all = _after(_brake_all, _brakes_by(_law), _place)


@inline
def brake_cages(bodies, wrenches, energy, step, drags):
    """Put the torques of all effects that brake the cages on these, and against them on cup and cone.

    About the axis of each cage, from the speeds at the beginning of the step; ``drags``: from
    `cage_drag_params`. Neglects the tilt between the rings, and forces.
    """
    if drags is None:
        return
    _brake_all(bodies, wrenches, energy, step, drags)
