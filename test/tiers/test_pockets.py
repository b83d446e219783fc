"""Friction of the pockets in the torque of the tiers without roller inertia."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import cage_speed, roller_spin
from beardyn_core.choice import load_scene
from beardyn_core.effects import Cage
from beardyn_core.run import blocks
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.study.measures import SignalCollector


def torque_of(scene: Scene) -> tuple[float, float]:
    """Measure the mean torque and the mean number of rollers that the cones do not press."""
    collected, idle = SignalCollector(), []
    for block in blocks(scene, 0.3):
        collected.add(block)
        idle.append((np.linalg.norm(block.contacts[..., 1, 3:6], axis=-1) == 0.0).sum(axis=(1, 2)))
    signals = collected.signals()
    return float(signals.torque.mean()), float(np.concatenate(idle).mean())


def test_idle_rollers_rub_in_their_pockets() -> None:
    """Against the sum by hand: weight and drag of each idle roller, at two bars, over the shaft's speed."""
    scene = load_scene("static_80kN", tier="lumped", effects="standard", duration=0.3)
    effects, bearing, operation = scene.effects, scene.bearing, scene.operation
    assert isinstance(effects.cage, Cage)
    assert isinstance(operation, ConstantOperation)
    assert effects.gravity is not None
    rough = replace(effects.cage, friction=0.5)
    smooth = replace(effects.cage, friction=0.0)
    one, idle = torque_of(replace(scene, effects=replace(effects, cage=rough)))
    other, _ = torque_of(replace(scene, effects=replace(effects, cage=smooth)))
    assert 8 < idle < 30
    speed = operation.speed
    weight = 2.0 / np.pi * effects.gravity.acceleration * bearing.roller_mass
    drag = 0.0
    if effects.drag is not None:
        from beardyn_core.physics.drag import drag_params

        law = drag_params(scene)
        assert law is not None
        drag = law.orbit * (cage_speed(bearing, speed) * 0.5 * bearing.pitch_diameter) ** 2
    slide = roller_spin(bearing, speed) * 0.5 * bearing.roller_diameter
    power = 2.0 * 0.5 * idle * (weight + drag) * slide
    # drag acts at the mass centre, 0.2 % further out than the pitch circle; loads are those at 200 Hz
    assert other - one == pytest.approx(power / speed, rel=0.02)


def test_a_kinematic_cage_rubs_nothing() -> None:
    from beardyn_core.effects import KinematicCage
    from beardyn_core.physics.pure_rolling import kinematic_params

    scene = load_scene("static_80kN", tier="lumped", effects="standard")
    assert kinematic_params(scene).pocket is not None
    still = replace(scene.effects, cage=KinematicCage())
    assert kinematic_params(replace(scene, effects=still)).pocket is None
