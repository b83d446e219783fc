"""What the chatter monitor sums: friction that flips, and not friction that moves."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from beardyn_core.base.jit import entry
from beardyn_core.physics.bodies.contact_output import Here, watch_chatter
from beardyn_core.physics.bodies.layout import BODY_STATES, ROLLER_FIELDS
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.tiers.state import State
from beardyn_core.physics.tiers.status import chatter_index

STEPS, CAPACITY = 400, 50.0
TIME = np.arange(STEPS)


@entry
def watched(lanes: Any, friction: Any, rollers: Any, capacity: Any) -> None:
    """Feed the monitor of the cup contact of one block; friction [step, 1, lane], capacity alike."""
    one = lanes.constant(1.0)
    here = Here(lanes, 0, rollers, rollers, one, one, one, True)
    for step in range(friction.shape[0]):
        watch_chatter(here, 0, lanes.load(friction, step, 0), lanes.load(capacity, step, 0))


def index(lanes: Any, friction: Any, capacity: Any = CAPACITY) -> float:
    """Chatter index of a course of the friction force."""
    rollers = np.zeros((1, ROLLER_FIELDS, lanes.width))
    course = np.repeat(np.asarray(friction, dtype=float)[:, None, None], lanes.width, axis=2)
    limit = np.repeat(np.broadcast_to(capacity, STEPS).astype(float)[:, None, None], lanes.width, axis=2)
    watched(lanes, course, rollers, limit)
    state = State(
        rollers, np.zeros((4, BODY_STATES)), np.zeros(ENERGY_TERMS), np.zeros((0, 2, 2)), np.zeros((2, 2, 0))
    )
    found = chatter_index(state, STEPS)
    assert found[1].max() == 0.0
    return float(found[0].max())


def test_full_friction_that_flips_at_every_step_has_two(lanes: Any) -> None:
    assert index(lanes, CAPACITY * (-1.0) ** TIME) == pytest.approx(2.0, rel=0.01)


def test_full_friction_that_flips_at_every_second_step_is_far_above_the_limit(lanes: Any) -> None:
    assert index(lanes, CAPACITY * (-1.0) ** (TIME // 2)) == pytest.approx(np.sqrt(0.5), rel=0.02)


def test_friction_that_moves_smoothly_has_none(lanes: Any) -> None:
    assert index(lanes, CAPACITY * np.sin(2 * np.pi * TIME / 50)) < 0.01


def test_a_strike_that_the_steps_resolve_is_no_chatter(lanes: Any) -> None:
    """Ten steps up and down to twenty times the usual load, the friction with it."""
    strike = 1.0 + 19.0 * np.maximum(1.0 - np.abs(TIME - 200) / 10.0, 0.0)
    assert index(lanes, CAPACITY * strike, CAPACITY * strike) < 0.1
