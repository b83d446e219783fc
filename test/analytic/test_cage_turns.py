"""Rolling elements that strike as the cage brings them into the load, and what else comes back as often."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain import REFERENCE, MonitorResult, MonitorSettings, Stretch
from beardyn_core.monitor.chain.cage_turns import score_with_turns
from beardyn_core.monitor.chain.fault_lines import comb_score
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS

SPEED = 15.0
TURNED = np.arange(round(60.0 / SPEED * RATE)) * SPEED / RATE
ANGLE = np.asarray(2.0 * np.pi * TURNED, np.float64)
SEEDS = pytest.mark.parametrize("seed", range(4))
PARTS = ("cup", "cone", "roller")


def _received(loudness: Float, seed: int, settings: MonitorSettings = SETTINGS) -> MonitorResult:
    noise = np.random.default_rng(seed).normal(size=len(TURNED))
    return REFERENCE(Stretch(RATE, loudness * noise, ANGLE, np.nan, 0), ORDERS, ROLLERS, settings)


def _ball(depth: float, order: float = ORDERS.ftf) -> Float:
    """Give the loudness of a ball that spins about any axis: it is in the load once in a turn of the cage."""
    loaded = np.maximum(0.0, np.cos(2.0 * np.pi * order * TURNED)) ** 4
    return np.asarray(1.0 + depth * loaded, np.float64)


def _pulses(order: float, depth: float, width: float) -> Float:
    """Give the loudness of what is louder for a share of each period."""
    return np.asarray(1.0 + depth * (np.mod(order * TURNED, 1.0) < width), np.float64)


@SEEDS
def test_a_ball_is_named_and_the_cage_may_be_meant(seed: int) -> None:
    found = _received(_ball(2.0), seed)
    assert found.verdict == "roller", found.reason
    assert found.also_fits == ("cage",)
    assert found.fault_order == pytest.approx(ORDERS.ftf, rel=0.01)
    assert found.expected_order == ORDERS.ftf
    assert "fault of the rolling elements: FTF found at" in found.reason
    assert "a damaged cage would have these lines, too" in found.reason
    assert _received(_ball(0.15), seed).verdict == "healthy"  # rollers that differ


@SEEDS
def test_with_harmonics_of_its_own_it_is_no_cage(seed: int) -> None:
    found = _received(_ball(2.0) * _pulses(2.0 * ORDERS.bsf, 2.0, 1.0 / 12.0), seed)
    assert found.verdict == "roller", found.reason
    assert found.also_fits == ()
    assert found.expected_order == pytest.approx(2.0 * ORDERS.bsf)


@SEEDS
def test_harmonics_on_multiples_of_the_cage_are_none_of_their_own(seed: int) -> None:
    """2 BSF lies near 16 FTF in many bearings, within the tolerance, and BPFO at that of all rollers."""
    assert 2.0 * ORDERS.bsf == pytest.approx(16.0 * ORDERS.ftf, rel=0.02)
    found = _received(_pulses(ORDERS.ftf, 6.0, 1.0 / 12.0), seed)
    said = (found.verdict, found.also_fits)
    assert said in (("roller", ("cage",)), ("unexplained", ())), found.reason


@SEEDS
@pytest.mark.parametrize("width", [0.02, 0.05, 0.2])
@pytest.mark.parametrize(
    "order",
    [
        ORDERS.ftf / 3.0,
        0.1445,
        ORDERS.ftf / 2.0,
        ORDERS.ftf / 5.0,
        ORDERS.ftf / 7.0,
        1.012 * ORDERS.ftf / 7.0,
    ],
)
def test_rail_joints_whose_multiples_are_those_of_the_cage_are_no_fault(
    order: float, width: float, seed: int
) -> None:
    found = _received(_pulses(order, 2.0, width), seed)
    assert found.verdict not in PARTS, found.reason


@SEEDS
@pytest.mark.parametrize("multiple", [2, 3, 4])
def test_a_comb_of_a_multiple_of_the_cage_is_no_rolling_element(multiple: int, seed: int) -> None:
    for off in (0.99, 1.0, 1.004):
        found = _received(_pulses(multiple * off * ORDERS.ftf, 2.0, 1.0 / 12.0), seed)
        assert found.verdict not in PARTS, found.reason


@SEEDS
def test_a_cup_whose_strikes_come_and_go_with_the_cage_is_a_cup(seed: int) -> None:
    found = _received(_ball(4.0) * _pulses(ORDERS.bpfo, 0.6, 1.0 / 12.0), seed)
    assert found.verdict == "cup", found.reason


@SEEDS
def test_at_a_speed_that_is_not_well_known_or_beside_a_cage_as_fast_it_may_be_another_cage(seed: int) -> None:
    assert _received(_ball(2.0), seed, replace(SETTINGS, speed_uncertainty=0.01)).verdict == "roller"
    uncertain = replace(SETTINGS, speed_uncertainty=0.03)
    found = _received(_ball(2.0), seed, uncertain)
    assert found.verdict == "not_diagnosable"
    assert "the speed is uncertain by 3%; give a tachometer, or the speed within 1%" in found.reason
    assert np.isnan(found.confidence)
    assert _received(_ball(0.15), seed, uncertain).verdict == "healthy"
    for ftf in (1.003 * ORDERS.ftf, np.nan):
        beside = replace(ORDERS, ftf=ftf, bpfo=6.1, bpfi=8.2, bsf=2.9)
        found = _received(_ball(2.0), seed, replace(SETTINGS, neighbours=(beside,)))
        assert found.verdict == "not_diagnosable"
        assert "or of its neighbour, whose cages turn as fast" in found.reason


def test_bearings_whose_cage_is_not_known_are_scored_as_without_it() -> None:
    tracked = np.random.default_rng(1).normal(size=60 * 1024)
    for ftf in (np.nan, 0.0):
        orders = replace(ORDERS, ftf=ftf)
        with np.errstate(all="raise"):
            found = score_with_turns(tracked, orders, ROLLERS, SPEED, SETTINGS)
        assert found.candidates == comb_score(tracked, orders, ROLLERS, SPEED, SETTINGS).candidates


@pytest.mark.slow
def test_noise_has_such_turns_as_seldom_as_stated() -> None:
    random = np.random.default_rng(7)
    called = 0
    for _ in range(300):
        tracked = random.exponential(size=30 * 1024)
        found = score_with_turns(tracked, ORDERS, ROLLERS, SPEED, replace(SETTINGS, false_alarm_rate=0.02))
        called += any(each.pattern.cage > 0.0 for each in found.candidates)
    assert called <= 6  # 0.02 / 3 / 2 of 300 is 1
