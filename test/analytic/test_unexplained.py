"""Strikes that fit no part at the stated speed: wrong speeds, wrong bearings, bearings next to this one."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.config import load_plate
from beardyn_core.monitor.chain import FAULTS, REFERENCE, MonitorResult, Stretch
from beardyn_core.monitor.chain.chain import squared_envelope
from beardyn_core.monitor.chain.explanations import explanations
from beardyn_core.monitor.chain.fault_lines import comb_score, fault_patterns
from beardyn_core.monitor.chain.impulsiveness import with_strikes
from beardyn_core.monitor.chain.tracking import logarithm_by_angle
from beardyn_core.monitor.chain.whitening import by_cepstrum, whole_band
from beardyn_core.study.monitored_recording import EXIT_CODES, Finding, conclude, worst
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS, fault_signal

UNSURE = replace(SETTINGS, speed_uncertainty=0.03)
NEIGHBOUR = load_plate("6203")  # no part of it has an order of ours


@cache
def struck(fault: str | None) -> Stretch:
    _, angle, acceleration = fault_signal(fault, 71)
    return Stretch(RATE, acceleration, angle, 8e4, 0)


def told(fault: str | None, error: float, uncertain: bool = False) -> MonitorResult:
    """What the monitor says where the stated speed is off by an error, [-]."""
    stretch = struck(fault)
    wrong = replace(stretch, shaft_angle=stretch.shaft_angle * (1.0 + error))
    return REFERENCE(wrong, ORDERS, ROLLERS, UNSURE if uncertain else SETTINGS)


@pytest.mark.parametrize("fault", ["cup", "cone"])
@pytest.mark.parametrize("error", [-0.08, -0.04, 0.04, 0.08])
def test_a_fault_at_a_wrong_speed_is_unexplained_and_the_right_speed_is_among_the_answers(
    fault: str, error: float
) -> None:
    found = told(fault, error)
    assert found.verdict == "unexplained"
    assert found.comb_order == pytest.approx(
        getattr(ORDERS, {"cup": "bpfo", "cone": "bpfi"}[fault]) / (1.0 + error), rel=3e-3
    )
    own = [each for each in found.fits if not each.bearing and each.part == fault]
    assert own[0].speed == pytest.approx(19.2, rel=5e-3)
    assert f"{60.0 * own[0].speed:.5g} rpm" in found.reason


@settings(max_examples=10, deadline=None, derandomize=True)
@given(fault=st.sampled_from(FAULTS), error=st.floats(-0.08, 0.08), uncertain=st.booleans())
def test_a_clear_fault_is_never_healthy_nor_another_part_whatever_the_stated_speed(
    fault: str, error: float, uncertain: bool
) -> None:
    assert told(fault, error, uncertain).verdict in (fault, "unexplained", "not_diagnosable")


@pytest.mark.parametrize(
    ("fault", "whole"), [("cup", 7), ("cone", 9), ("cone", 10), ("roller", 6), ("roller", 7)]
)
def test_a_fault_that_a_wrong_speed_puts_on_a_whole_order_is_not_taken_for_the_wheel(
    fault: str, whole: int
) -> None:
    order = {"cup": ORDERS.bpfo, "cone": ORDERS.bpfi, "roller": 2.0 * ORDERS.bsf}[fault]
    found = told(fault, order / whole - 1.0, uncertain=True)
    assert found.verdict in (fault, "unexplained", "not_diagnosable")
    if fault == "cup":  # it has no sidebands that would show it
        assert found.verdict == "not_diagnosable"
        assert "a comb of order 7.00" in found.reason
        assert "outer ring (cup) of this bearing at 115" in found.reason


@pytest.mark.parametrize("fault", FAULTS)
@pytest.mark.parametrize("error", [-0.03, 0.0, 0.03])
def test_an_uncertain_speed_is_searched_and_the_one_that_fits_is_stated(fault: str, error: float) -> None:
    found = told(fault, error, uncertain=True)
    assert found.verdict == fault
    assert found.fitting_shaft_frequency == pytest.approx(19.2, rel=5e-3)
    assert "without slip it fits" in found.reason


def test_a_healthy_bearing_is_healthy_at_every_speed() -> None:
    assert {told(None, error, True).verdict for error in (-0.08, -0.03, 0.0, 0.05)} == {"healthy"}


def test_another_bearing_is_named_where_a_shipped_one_has_the_order() -> None:
    stretch = struck("cup")
    other = FaultFrequencies(ftf=0.38, bpfo=5.7, bpfi=9.3, bsf=2.6)  # fifteen rollers
    found = REFERENCE(stretch, other, 15, SETTINGS)
    assert found.verdict == "unexplained"
    assert ("cup", "HS130x230") in {(each.part, each.bearing) for each in found.fits}
    assert "HS130x230" in found.reason


def test_strikes_of_a_bearing_on_the_same_shaft_are_those_of_the_neighbour() -> None:
    stretch = struck("cup")
    other = FaultFrequencies(ftf=0.38, bpfo=5.7, bpfi=9.3, bsf=2.6)
    found = REFERENCE(stretch, other, 15, replace(SETTINGS, neighbours=(ORDERS,)))
    assert found.verdict == "healthy"
    faulty = REFERENCE(stretch, ORDERS, ROLLERS, replace(SETTINGS, neighbours=(other,)))
    assert faulty.verdict == "cup"  # a neighbour explains nothing that is our own


def test_lines_of_a_surer_part_are_no_strikes_of_another() -> None:
    """Three times BPFI is four times BPFO: what strikes there strikes for the part with more evidence."""
    stretch = struck("cup")
    band = whole_band(stretch, SETTINGS)
    tracked = logarithm_by_angle(squared_envelope(by_cepstrum(stretch, SETTINGS), band), stretch, SETTINGS)
    found = comb_score(tracked, ORDERS, ROLLERS, stretch.shaft_frequency, SETTINGS)
    cup, cone, roller = found.candidates
    cone = replace(cone, order=4.0 / 3.0 * cup.order)

    def strikes_of_cone(evidence: float) -> float:
        both = replace(found, candidates=(cup, replace(cone, evidence=evidence), roller))
        return with_strikes(both, stretch, band, SETTINGS).candidates[1].strikes

    least = SETTINGS.least_strikes
    assert strikes_of_cone(cup.evidence - 1.0) < 0.3 * least  # noise on its other lines, 0.04
    assert strikes_of_cone(cup.evidence + 1.0) > least


def test_explanations_begin_with_the_likely_part_and_the_nearest_speed() -> None:
    order = ORDERS.bpfo / 1.04
    found = explanations(order, fault_patterns(ORDERS), 20.0, 0.08)
    own = [each for each in found if not each.bearing]
    assert [abs(each.speed - 20.0) for each in own] == sorted(abs(each.speed - 20.0) for each in own)
    cup = next(each for each in own if each.part == "cup")
    assert cup.speed == pytest.approx(20.0 / 1.04)
    first = explanations(order, fault_patterns(ORDERS), 20.0, 0.08, "cup")[0]
    assert first.part == "cup"


def test_healthy_is_the_conclusion_only_where_half_of_the_analyses_are() -> None:
    def concluded(*names: str) -> str:
        return conclude(Finding(name, "", float(at)) for at, name in enumerate(names)).verdict

    assert concluded("healthy", "healthy", "unexplained") == "healthy"
    assert concluded("healthy", "healthy", "unexplained", "cup", "unexplained") == "unexplained"


def test_the_worst_bearing_decides_and_every_verdict_has_its_exit_code() -> None:
    assert worst(["healthy", "unexplained", "not_diagnosable"]) == "unexplained"
    assert worst(["unexplained", "cup"]) == "cup"
    assert worst(["cup", "hot_box"]) == "hot_box"
    assert EXIT_CODES["healthy"] == 0
    assert len({EXIT_CODES[each] for each in ("healthy", "not_diagnosable", "unexplained", "cup")}) == 4


def test_strikes_that_turn_with_a_shaft_of_a_slightly_wrong_speed_are_no_bearing() -> None:
    stretch = struck(None)
    revolution = stretch.shaft_angle / (2.0 * np.pi)
    strikes = np.zeros(len(revolution))
    for order, size in ((1.0, 20.0), (2.0, 40.0)):
        strikes[np.searchsorted(revolution, np.arange(0.3, revolution[-1], 1.0 / order))] += size
    ringing = np.exp(-1500.0 * np.arange(300) / RATE) * np.sin(2.0 * np.pi * 4500.0 * np.arange(300) / RATE)
    added = np.convolve(strikes, ringing)[: len(strikes), None] * [0.3, 0.1, 1.0]
    shaken = replace(
        stretch, acceleration=stretch.acceleration + added, shaft_angle=stretch.shaft_angle * 1.008
    )
    assert REFERENCE(shaken, ORDERS, ROLLERS, UNSURE).verdict == "healthy"
