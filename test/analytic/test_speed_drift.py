"""A speed that is stated as constant and is not: no bearing is healthy then, and no steady one is doubted."""

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.monitor.chain import REFERENCE, Stretch
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
