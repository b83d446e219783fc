"""A box that bends in any tier: scenes, and steps of a twin under its first load."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from beardyn_core.effects import ModalStructure, RingStructure
from beardyn_core.physics.bodies.layout import CAGE_BODY, RATE
from beardyn_core.physics.tiers.state import Output
from beardyn_core.physics.tiers.tier_bending import step_body
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of
from beardyn_core.twin import Twin
from test.tiers.runs import scene_of

Float = NDArray[np.float64]
KINDS: dict[str, RingStructure | ModalStructure] = {
    "rings": RingStructure(),
    "modes": ModalStructure("high_speed"),
}


@cache
def bent_scene(tier: str, kind: str, name: str = "static_80kN") -> Scene:
    """A shipped scene with a box that bends, one step a sample in the fast tiers."""
    scene = scene_of(name, tier)
    effects = replace(scene.effects, structure=KINDS[kind])
    modes, mounting = modes_of_effects(effects), scene.mounting
    if modes is not None:
        mounting = mounting_of(modes, mounting, scene.bearing)
    steps = 4 if tier == "full" else 1
    numerics = replace(scene.numerics, steps_per_sample=steps)
    return replace(scene, effects=effects, mounting=mounting, numerics=numerics)


def suspended(tier: str, kind: str) -> Scene:
    """The same with the box on its springs."""
    scene = bent_scene(tier, kind)
    return replace(scene, mounting=replace(scene.mounting, cup="suspended"))


def started(scene: Scene) -> Twin:
    """A twin at rest under the first load."""
    return start(scene, 0.1).twin


def stepped(twin: Twin, steps: int, speed: float | None = None) -> tuple[Float, Float]:
    """Signals and rollers of some steps under the first load, the shaft at another speed [rad/s].

    What a run holds for a while is worked out anew in every one of them.
    """
    state = twin._state
    assert state is not None
    loads = np.repeat(twin._loads(0, 20_000_000, 512)[:1], steps + 1, axis=0)
    if speed is not None:
        loads[:, 6] = speed
        state.bodies[CAGE_BODY:, RATE] *= speed
    signals = np.zeros((steps, twin._channels))
    rollers = np.zeros((steps, *twin._tier.trend_shape(state.rollers.shape, twin._kernel_parameters)))
    output = Output(signals, rollers, np.zeros((steps, *state.bodies.shape)), twin._audit)
    twin._tier.advance(twin._lanes, state, twin._work, loads, output, twin._kernel_parameters)
    return signals, rollers


def shapes_at(twin: Twin, azimuth: Float) -> Float:
    """Opening of the raceways by each mode of the step, by plain sums, shape [row, place, mode]."""
    fitted = step_body(twin.scene, twin._parameters.step)
    assert fitted is not None
    return math.cos(twin.scene.bearing.cup_angle) * fitted.body.openings(azimuth)
