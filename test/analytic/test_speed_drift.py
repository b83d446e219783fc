"""A speed that is stated as constant and is not: no bearing is healthy then, and no steady one is doubted."""

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.monitor.chain import REFERENCE, MonitorResult, Stretch
from beardyn_core.monitor.chain.levels import Levels
from beardyn_core.monitor.streaming import Monitor
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS, fault_signal

STATED = replace(SETTINGS, speed_uncertainty=0.03)


def _analysed(fault, speed, settings=STATED, seed=5, known=False):
    """Analyse 3 s whose speed changes evenly from one value to another, stated as their mean."""
    time, angle, acceleration = fault_signal(fault, seed, speed=speed)
    constant = np.asarray(2.0 * np.pi * 0.5 * (speed[0] + speed[1]) * time, np.float64)
    return REFERENCE(
        Stretch(RATE, acceleration, angle if known else constant, 8e4, 0), ORDERS, ROLLERS, settings
    )


@pytest.mark.parametrize("fault", ["cup", "cone", "roller"])
@pytest.mark.parametrize("speed", [(17.0, 22.0), (22.0, 17.0)])
def test_a_fault_at_a_speed_that_changes_is_never_healthy(fault, speed):
    found = _analysed(fault, speed)
    assert found.verdict != "healthy"
    if found.verdict == "not_diagnosable":
        sign = "+" if speed[1] > speed[0] else "-"
        assert f"the speed is not constant: it changes by {sign}" in found.reason
        assert "give a tachometer or a speed channel" in found.reason
        assert np.isnan(found.confidence)
    assert _analysed(fault, speed, known=True).verdict == fault


@pytest.mark.parametrize("seed", range(8))
def test_noise_and_a_steady_speed_are_not_doubted(seed):
    assert _analysed(None, (19.2, 19.2), seed=seed).verdict == "healthy"
    assert _analysed(None, (17.0, 22.0), seed=seed).verdict == "healthy"  # nothing strikes: nothing is known
    assert _analysed("cup", (19.2, 19.2), seed=seed).verdict == "cup"


def test_a_speed_that_is_counted_is_not_doubted():
    # what a tachometer counts is the speed, whatever else strikes at a rate that changes
    assert "not constant" not in _analysed("cup", (17.0, 22.0), settings=SETTINGS).reason


@pytest.mark.parametrize("seed", range(4))
def test_a_train_that_stops_is_not_healthy_at_a_constant_speed(seed):
    """The noise of a train that stops falls by 30 dB; strikes are too few to show the change of speed."""
    time, angle, acceleration = fault_signal(None, seed, speed=(19.2, 19.2))
    stopping = acceleration * np.maximum(0.03, 1.0 - time / time[-1])[:, None] ** 1.5
    constant = REFERENCE(Stretch(RATE, stopping, angle, 8e4, 0), ORDERS, ROLLERS, STATED)
    assert constant.verdict == "not_diagnosable"
    assert "dB within the stretch, as where a train stops or starts" in constant.reason
    counted = REFERENCE(Stretch(RATE, stopping, angle, 8e4, 0), ORDERS, ROLLERS, SETTINGS)
    assert counted.verdict == "healthy"


def test_a_train_that_stands_is_not_healthy_at_a_constant_speed():
    """Once it stands the level is steady again, far below that of the stretches before."""
    _, angle, acceleration = fault_signal(None, 3, speed=(19.2, 19.2))
    moving = REFERENCE(Stretch(RATE, acceleration, angle, 8e4, 0), ORDERS, ROLLERS, STATED)
    assert moving.verdict == "healthy"
    known = Levels(moving.rms, moving.kurtosis, moving.crest, moving.shaft_frequency)
    loud, quiet = (known,) * 4, replace(known, rms=0.01 * known.rms)

    def verdict_of(share, earlier):
        return REFERENCE(
            Stretch(RATE, share * acceleration, angle, 8e4, 0, earlier=earlier), ORDERS, ROLLERS, STATED
        )

    stands = verdict_of(0.01, (*loud, *(quiet,) * 16))
    assert stands.verdict == "not_diagnosable"
    assert "40 dB below that of earlier stretches" in stands.reason
    assert verdict_of(1.0, (*loud, *(quiet,) * 16)).verdict == "healthy"  # it goes on
    assert verdict_of(0.5, loud).verdict == "healthy"


def test_a_constant_speed_once_disproved_is_no_longer_believed():
    """Where the speed changes otherwise, or the train stands, lines are smeared and nothing says so."""
    changes = [np.nan, 0.1, np.nan, np.nan]
    said = ["healthy", "not_diagnosable", "healthy", "cup"]

    def algorithm(stretch, orders, roller_count, settings):
        return MonitorResult(said.pop(0), "as told", stretch.end_ns, 0.6, speed_change=changes.pop(0))

    def push_second(monitor, second):
        time_ns = np.arange(second * 1_000_000_000, (second + 1) * 1_000_000_000, 100_000)
        monitor.push_vibration(time_ns, np.random.default_rng(second).normal(size=(len(time_ns), 1)))
        monitor.push_shaft(time_ns, np.asarray(2.0 * np.pi * 20.0 * 1e-9 * time_ns, np.float64))
        return monitor.result()

    monitor = Monitor(ORDERS, ROLLERS, settings=STATED, algorithm=algorithm)
    found = [push_second(monitor, second) for second in range(4)]
    assert [each.verdict for each in found] == ["healthy", "not_diagnosable", "not_diagnosable", "cup"]
    assert found[2].reason.startswith("the speed, stated as constant, was found to change 1 s before")
    assert np.isnan(found[2].confidence)
    assert found[3].confidence == 0.6
