"""Newmark's beta of the time step: stable at any step, fourth order where the step resolves the bounce."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.config import load_bearing
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.tiers.build import highest_bounce, implicit_spring_share
from beardyn_core.physics.tiers.step_choice import bounce_frequency
from test.bearings import TAPERED
from test.kernels.rig import Float


def growth(turn: float, share: float, damping: float = 0.0) -> Float:
    """Eigenvalues of one step of an oscillator as the rollers take it: w h, beta, damper over spring x w.

    x' = x + u with u the velocity times the step; u' - u = -(w h)^2 (x' + beta (u' - u)) - c (u + u') / 2.
    """
    square, drag = turn**2, damping * turn
    kept = (1.0 + square * share - 0.5 * drag) / (1.0 + square * share + 0.5 * drag)
    pull = square / (1.0 + square * share + 0.5 * drag)
    return np.asarray(np.linalg.eigvals(np.array([[1.0, 1.0], [-pull, kept - pull]])))


def frequency_error(turn: float, share: float) -> float:
    return abs(float(np.angle(growth(turn, share)).max()) / turn - 1.0)


@given(st.floats(1e-3, 30.0), st.floats(0.0, 5.0))
def test_every_step_is_stable(turn: float, damping: float) -> None:
    share = implicit_spring_share(turn, 1.0)
    assert 1.0 / 12.0 <= share <= 0.25
    assert np.abs(growth(turn, share, damping)).max() <= 1.0 + 1e-9


def test_the_least_share_is_fourth_order_and_a_quarter_second() -> None:
    turns = np.array([0.1, 0.2, 0.4])
    orders = {
        share: np.polyfit(np.log(turns), np.log([frequency_error(turn, share) for turn in turns]), 1)[0]
        for share in (1.0 / 12.0, 0.25)
    }
    assert orders[1.0 / 12.0] == pytest.approx(4.0, abs=0.1)
    assert orders[0.25] == pytest.approx(2.0, abs=0.1)


def test_usual_step_resolves_the_bounce() -> None:
    """3 steps per sample take the least share, 2 do not."""
    bearing = load_bearing("HS130x230")
    bounce = highest_bounce(bearing, line_contact_factor(bearing.material, bearing.effective_length))
    shares = [implicit_spring_share(bounce, 1.0 / (count * WAVEFORM_RATE)) for count in (1, 2, 3)]
    assert shares[2] == 1.0 / 12.0
    assert 0.25 > shares[0] > shares[1] > 1.0 / 12.0


@pytest.mark.parametrize("name", TAPERED)
def test_highest_bounce_is_above_that_of_heavy_loads(name: str) -> None:
    bearing = load_bearing(name)
    static = solve(bearing, (0.0, 0.0, 1.5e5), end_play=0.0, laminae=6, speed=60.0)
    highest = highest_bounce(bearing, line_contact_factor(bearing.material, bearing.effective_length))
    found = 2.0 * math.pi * bounce_frequency(bearing, static, 6)
    assert found < highest < 1.3 * found
