"""Every railway scene runs through the twin inside the model's validity; strikes shake as strikes do."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.config import shipped_names
from beardyn_core.config.boxes import scene_of_box
from beardyn_core.rail.build import load_history
from beardyn_core.rail.events import events_of
from beardyn_core.run import blocks
from beardyn_core.scene.operation import ConstantOperation

RAILWAY = [
    name for name in shipped_names("scenes") if not isinstance(load_scene(name).operation, ConstantOperation)
]
GRAVITY = 9.80665


@pytest.mark.slow
@pytest.mark.parametrize("name", RAILWAY)
def test_a_scene_stays_inside_the_validity_of_the_model(name: str) -> None:
    scene = load_scene(name)
    if scene.axleboxes is not None:  # test/train has the whole train; here the worst of its boxes
        faulty = next(box for box in scene.axleboxes.boxes if box.name in scene.axleboxes.faulty)
        scene = scene_of_box(scene, faulty)
    # a scene that stands still or turns round does so later than the others
    turns = any(event["kind"] in ("standstill", "backwards") for event in events_of(scene)["events"])
    found = list(blocks(scene, scene.duration if turns else min(scene.duration, 2.0)))
    assert all(block.status == 0 for block in found)
    assert all(np.isfinite(block.acceleration).all() for block in found)


@pytest.mark.slow
@pytest.mark.parametrize(("box", "least"), [("rigid", 50.0), ("rings", 45.0)])
def test_a_flat_lifts_the_wheel_and_shakes_the_box_as_in_the_field(box: str, least: float) -> None:
    """50 to 200 g are field figures; the sensor of the box that rings has 48 g where a rigid one has 52 g."""
    scene = load_scene("freight_100", duration=1.5)
    if box == "rigid":
        scene = replace(scene, effects=replace(scene.effects, structure=None))
    load = load_history(scene.operation, scene.mounting, scene.duration, scene.seed)
    weight = scene.mounting.journal_mass * GRAVITY
    # in the air only the half wheelset hangs on the journal
    assert load.wrench[:, 2].min() < -0.9 * weight
    shaken = max(np.abs(block.acceleration[0, :, 2]).max() for block in blocks(scene))
    assert least * GRAVITY < shaken < 200 * GRAVITY
