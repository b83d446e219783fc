"""Coin and roller in the trough: energy, height, period, step."""

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.laboratory.rerun_rolling import contact_points, save_rolling
from beardyn_core.laboratory.rolling import COIN, GRAVITY, ROLLER, RollingBody, Trough, run_rolling

HALF = 0.75  # to the turning point and a little beyond, [s]


@pytest.mark.parametrize("body", [COIN, ROLLER], ids=lambda body: body.name)
class TestEnergy:
    def test_balance_closes_and_no_search_fails(self, body: RollingBody) -> None:
        run = run_rolling(body, duration=HALF)
        assert run.failed_searches == 0
        assert np.abs(run.residual).max() < 1e-6 * run.energies["potential"][0]

    def test_height_lost_is_what_friction_and_damping_took(self, body: RollingBody) -> None:
        run = run_rolling(body, duration=HALF)
        k, energies = run.turning_sample, run.energies
        lost = energies["potential"][0] - energies["potential"][k]
        taken = sum(energies[name][k] for name in ("friction", "damping", "kinetic", "elastic"))
        assert 0.0 < lost == pytest.approx(taken, rel=1e-4)
        assert run.height[k] > 0.97 * run.height[0]

    def test_losses_only_grow(self, body: RollingBody) -> None:
        run = run_rolling(body, duration=HALF)
        for name in ("friction", "damping"):
            assert np.diff(run.energies[name]).min() >= 0.0

    def test_it_stays_upright_and_in_its_plane(self, body: RollingBody) -> None:
        run = run_rolling(body, duration=HALF)
        assert run.lean.max() < 1e-9
        assert np.abs(run.history[:, 2]).max() < 1e-9


def test_less_creep_comes_back_higher() -> None:
    runs = [run_rolling(COIN, Trough(transition_speed=v), duration=HALF) for v in (5e-3, 2e-3, 2e-4)]
    reached = [run.height[run.turning_sample] for run in runs]
    assert reached[0] < reached[1] < reached[2]
    assert reached[2] > 0.995 * runs[2].height[0]


def test_without_friction_it_slides_back_to_its_height_and_does_not_turn() -> None:
    run = run_rolling(COIN, Trough(friction=0.0), duration=HALF)
    assert np.abs(run.history[:, 12]).max() < 1e-12  # of 100 rad/s when rolling
    assert run.height[run.turning_sample] == pytest.approx(run.height[0], rel=1e-3)


def test_small_swing_has_the_period_of_a_rolling_cylinder() -> None:
    """2 pi sqrt(3/2 (R - r) / g), Lagrange; the amplitude of 5 deg makes it 0.05 % longer."""
    trough = Trough(transition_speed=2e-4)
    run = run_rolling(COIN, trough, duration=0.7, start_angle=math.radians(5.0), interval=1e-4)
    expected = math.pi * math.sqrt(1.5 * (trough.radius - COIN.radius) / GRAVITY)
    assert run.time[run.turning_sample] == pytest.approx(expected, rel=5e-3)


def test_half_the_step_gives_the_same_motion() -> None:
    coarse = run_rolling(ROLLER, duration=0.4)
    fine = run_rolling(ROLLER, duration=0.4, step=5e-6)
    np.testing.assert_allclose(coarse.height, fine.height, atol=1e-9)


def test_a_stiffer_floor_is_dented_less() -> None:
    soft = run_rolling(COIN, duration=0.2)
    stiff = run_rolling(COIN, replace(Trough(), stiffness=1e7), duration=0.2)
    # the same weight: a fifth of the penetration
    assert stiff.history[-1, 16] == pytest.approx(0.2 * soft.history[-1, 16], rel=0.05)


def test_contact_points_lie_on_the_floor_under_the_body() -> None:
    run = run_rolling(ROLLER, duration=0.1)
    points = contact_points(run)
    np.testing.assert_allclose(np.hypot(points[..., 0], points[..., 1]), run.trough.radius, rtol=1e-12)
    away = np.linalg.norm(points[..., :2] - run.history[:, None, :2], axis=-1)
    np.testing.assert_allclose(away, ROLLER.radius, atol=5e-6)


def test_animation_is_written(tmp_path) -> None:
    target = save_rolling(
        [run_rolling(COIN, duration=0.02), run_rolling(ROLLER, duration=0.02)], tmp_path / "a.rrd"
    )
    assert target.stat().st_size > 10_000
