"""Faults that hardly strike."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain import REFERENCE, MonitorResult, Stretch
from beardyn_core.monitor.chain.competing_orders import Rival
from beardyn_core.monitor.chain.fault_lines import Candidate, Pattern
from beardyn_core.monitor.chain.verdict import is_faint_fault
from test.fault_signals import ORDERS, RATE, ROLLERS
from test.fault_signals import SETTINGS as USUAL

# short stretches scatter by 0.1: a way that wide between what is faint and what strikes
SETTINGS = replace(USUAL, least_strikes=0.6, least_sharpest=(1.0, 0.8, 0.8))
SPEED = 15.0
TURNED = np.arange(round(60.0 / SPEED * RATE)) * SPEED / RATE
ANGLE = np.asarray(2.0 * np.pi * TURNED, np.float64)


def _received(loudness: Float, seed: int) -> MonitorResult:
    noise = np.random.default_rng(seed).normal(size=len(TURNED))
    return REFERENCE(Stretch(RATE, loudness * noise, ANGLE, np.nan, 0), ORDERS, ROLLERS, SETTINGS)


def _strikes(order: float, depth: float, loaded_by: float = 0.0) -> Float:
    """Give the loudness of noise that is louder for a twelfth of each period, in a load zone that turns."""
    passing = np.mod(order * TURNED, 1.0) < 1.0 / 12.0
    carried = 4.0 * np.maximum(0.0, np.cos(2.0 * np.pi * loaded_by * TURNED)) ** 2 if loaded_by else 1.0
    return np.asarray(1.0 + depth * carried * passing, np.float64)


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize(
    ("part", "order", "by"), [("cone", ORDERS.bpfi, 1.0), ("roller", 2.0 * ORDERS.bsf, ORDERS.ftf)]
)
def test_faint_lines_are_a_fault_where_they_come_and_go_as_those_of_the_part(
    part: str, order: float, by: float, seed: int
) -> None:
    modulated = _received(_strikes(order, 0.3, by), seed)
    alike = _received(_strikes(order, 0.25), seed)
    assert modulated.verdict == part, modulated.reason
    assert "faint" in modulated.reason
    assert np.isnan(modulated.confidence)  # no record tells how often it is right
    assert alike.score > alike.threshold
    assert alike.verdict == "healthy", alike.reason


def _candidate(**changed: object) -> Candidate:
    pattern = Pattern("cone", "BPFI", 9.7, 1.0, "shaft", 1, 4)
    given = {"alone": 20.0, "sharpest": 0.3, "strikes": 0.05, "rival": Rival(), **changed}
    return Candidate(pattern, 9.7, score=8.0, threshold=4.0, evidence=60.0, lines=(), **given)  # type: ignore[arg-type]


def test_each_condition_of_a_faint_fault_counts() -> None:
    assert is_faint_fault(_candidate(), SETTINGS)
    assert not is_faint_fault(replace(_candidate(), score=4.4), SETTINGS)
    assert not is_faint_fault(_candidate(rival=Rival(own=20.0)), SETTINGS)
    assert is_faint_fault(_candidate(rival=Rival(own=15.0)), SETTINGS)
    assert not is_faint_fault(_candidate(alone=50.0), SETTINGS)
    assert not is_faint_fault(_candidate(sharpest=0.2), SETTINGS)
    cup = Pattern("cup", "BPFO", 7.3, 1.0, "shaft", 0, 1)
    assert not is_faint_fault(replace(_candidate(), pattern=cup), SETTINGS)
    assert is_faint_fault(replace(_candidate(sharpest=0.5), pattern=cup), SETTINGS)


@pytest.mark.parametrize("seed", range(4))
def test_a_faint_pattern_that_something_contradicts_is_never_unexplained(seed: int) -> None:
    found = _received(_strikes(ORDERS.bpfi, 0.3, 1.0) + _strikes(9.46, 0.37) - 1.0, seed)
    assert found.verdict == "healthy", found.reason


@pytest.mark.parametrize("seed", range(4))
def test_tones_that_strike_like_clockwork_are_no_faint_fault(seed: int) -> None:
    """As measured a hum has lines that whitening takes away: there only what strikes hard counts."""
    noise = np.random.default_rng(seed).normal(size=len(TURNED))
    carrier = np.sin(2.0 * np.pi * 3000.0 * TURNED / SPEED)
    hum = sum(np.cos(2.0 * np.pi * h * ORDERS.bpfi * TURNED) for h in (1, 2, 3))
    stretch = Stretch(RATE, noise + (3.0 + 0.5 * np.asarray(hum)) * carrier, ANGLE, np.nan, 0)
    found = REFERENCE(stretch, ORDERS, ROLLERS, SETTINGS)
    assert found.verdict not in ("cup", "cone", "roller"), found.reason


@pytest.mark.parametrize("seed", range(4))
def test_faint_lines_beside_a_comb_that_is_as_sure_are_no_fault(seed: int) -> None:
    own = _strikes(ORDERS.bpfi, 0.3, 1.0)
    assert _received(own, seed).verdict == "cone"
    assert _received(own + _strikes(5.37, 0.5) - 1.0, seed).verdict not in ("cup", "cone", "roller")


def test_as_faint_as_rollers_that_pass_is_no_fault_of_the_cup() -> None:
    found = _received(_strikes(ORDERS.bpfo, 0.2), 3)
    assert found.score > found.threshold
    assert found.verdict == "healthy", found.reason
