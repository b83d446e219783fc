"""Friction that is worked out once in two samples is that of every step."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.physics.tiers.build import HELD_SAMPLES
from benchmarks.held_friction import Run

BLOCKS = 8
STEPS = 3.0  # a sample
HELD_STEPS = HELD_SAMPLES * STEPS


@cache
def run(steps: float) -> Run:
    """80 kN with every effect: 0.16 s, the last 0.06 of them looked at."""
    scene = load_scene("static_80kN", effects="all")
    scene = replace(scene, numerics=replace(scene.numerics, steps_per_sample=STEPS))
    found = Run.of(scene, steps, 0, BLOCKS + 1)
    for _ in range(BLOCKS):
        found.advance()
    return found


@pytest.mark.parametrize("name", range(4))
def test_torque_force_deflection_and_largest_load_are_within_a_thousandth(name: int) -> None:
    held, every = run(HELD_STEPS).means(), run(1.0).means()
    assert held[name] == pytest.approx(every[name], rel=1e-3)


def test_vibration_is_the_same_within_a_tenth_of_a_decibel() -> None:
    assert np.abs(run(HELD_STEPS).levels() - run(1.0).levels()).max() < 0.1


def test_holding_friction_makes_no_chatter() -> None:
    assert run(HELD_STEPS).chatter < 0.01
