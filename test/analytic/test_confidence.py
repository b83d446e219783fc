"""The confidence of a verdict: more evidence makes a fault surer; what cannot tell has none; runs average."""

from math import isnan, nan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.monitor.chain import FAULTS, REFERENCE, MonitorSettings, Stretch
from beardyn_core.monitor.chain.confidence import PART, WEIGHTS, Grounds, confidence_of
from beardyn_core.study.monitored_recording import Finding, conclude
from test.measured.files import RATE, frequencies, struck

_GROUNDS = st.builds(
    Grounds,
    comb=st.floats(-30.0, 40.0),
    strikes=st.floats(0.0, 20.0),
    steady=st.floats(-np.inf, 500.0, allow_nan=False),
    deviation=st.floats(0.0, 0.1),
    otherwise=st.floats(-np.inf, 3.0, allow_nan=False),
)


@settings(deadline=None, derandomize=True)
@given(_GROUNDS, _GROUNDS, st.sampled_from(FAULTS))
def test_more_evidence_never_makes_a_fault_less_probable(one, other, fault):
    more = Grounds(
        max(one.comb, other.comb), max(one.strikes, other.strikes), max(one.steady, other.steady),
        min(one.deviation, other.deviation), min(one.otherwise, other.otherwise),
    )  # fmt: skip
    assert 0.0 < confidence_of(fault, one) <= confidence_of(fault, more) < 1.0


@settings(deadline=None, derandomize=True)
@given(_GROUNDS, st.floats(0.0, 20.0))
def test_more_strikes_never_make_a_healthy_bearing_surer(grounds, strikes):
    more = grounds._replace(strikes=max(grounds.strikes, strikes))
    assert confidence_of("healthy", more) <= confidence_of("healthy", grounds)


def test_a_verdict_that_cannot_tell_has_no_confidence():
    grounds = Grounds(5.0, 2.0, 10.0, 0.0, 0.0)
    for verdict in ("waiting", "not_diagnosable", "hot_box"):
        assert isnan(confidence_of(verdict, grounds))
    assert isnan(confidence_of("cup", None))


def test_the_confidence_is_the_logistic_function_of_the_terms():
    grounds = Grounds(comb=5.0, strikes=2.0, steady=100.0, deviation=0.01, otherwise=0.5)
    total = np.dot(WEIGHTS[PART], (1.0, 0.5, np.log(2.0), 2.0, 1.0, 0.5))
    assert confidence_of("cone", grounds) == pytest.approx(1.0 / (1.0 + np.exp(-total)))


def _analysed(values, uncertainty=0.0, bearing="6205", error=0.0, revolutions=60.0):
    speed, orders = 30.0, frequencies(bearing)
    samples = min(len(values), round(revolutions / speed * RATE))
    angle = 2.0 * np.pi * speed * (1.0 + error) * np.arange(samples) / RATE
    stretch = Stretch(RATE, values[:samples, :1], angle, np.nan, 0)
    return REFERENCE(stretch, orders, 9, MonitorSettings(speed_uncertainty=uncertainty))


def test_a_clear_fault_is_surer_than_one_in_noise_and_than_one_of_a_wrong_speed():
    clear = _analysed(struck(frequencies("6205").bpfo))
    assert clear.verdict == "cup"
    assert clear.confidence > 0.9
    assert clear.grounds.deviation < 0.002
    noise = np.random.default_rng(4).normal(size=struck(0.0).shape)
    noisy = _analysed(struck(frequencies("6205").bpfo) + 5.0 * noise)
    assert noisy.verdict == "cup"
    assert 0.8 < noisy.confidence < clear.confidence
    off = _analysed(struck(frequencies("6205").bpfo), uncertainty=0.03, error=0.04)
    assert off.verdict == "cup"
    assert off.grounds.deviation == pytest.approx(0.04, abs=0.004)
    assert 1.0 - off.confidence > 1.5 * (1.0 - clear.confidence)


def test_noise_is_healthy_and_no_signal_has_no_confidence():
    noise = np.random.default_rng(5).normal(size=(48_000, 1))
    found = _analysed(noise)
    assert found.verdict == "healthy"
    assert 0.5 < found.confidence < 0.95
    dead = _analysed(np.zeros((48_000, 1)))
    assert dead.verdict == "not_diagnosable"
    assert isnan(dead.confidence)
    assert dead.grounds is None


def test_what_is_there_once_has_no_evidence_in_the_other_half():
    strikes = struck(frequencies("6205").bpfo)
    noise = np.random.default_rng(6).normal(0.0, 2.0, strikes.shape)
    once = np.where(np.arange(len(strikes))[:, None] < 12_000, strikes, 0.0) + noise
    always, found = _analysed(strikes + noise), _analysed(once)
    assert always.grounds.steady > 20.0
    assert found.verdict == "cup"
    assert found.grounds.steady < 3.0
    assert 1.0 - found.confidence > 1.5 * (1.0 - always.confidence)


def test_the_confidence_of_a_run_is_the_mean_over_all_analyses_and_others_count_as_none():
    def of(verdict, confidence, time=0.0):
        return Finding(verdict, "", time, confidence=confidence)

    def run_of(*several):
        finding = conclude(several).finding
        assert finding is not None
        return finding.confidence

    several = (of("cup", 0.9), of("cup", 0.7), of("not_diagnosable", nan), of("waiting", nan))
    assert run_of(*several) == pytest.approx((0.9 + 0.7) / 3)
    assert isnan(run_of(of("not_diagnosable", nan)))
    assert isnan(run_of(of("cup", nan)))  # of an algorithm that states none


def test_analyses_without_a_confidence_count_as_none_and_take_it_from_no_run() -> None:
    sure = [Finding("cone", "", float(at), confidence=0.9) for at in range(9)]
    faint = [Finding("cone", "", 9.0)]
    found = conclude([*sure, *faint]).finding
    assert found is not None
    assert found.confidence == pytest.approx(0.81)
    alone = conclude(faint).finding
    assert alone is not None
    assert np.isnan(alone.confidence)
