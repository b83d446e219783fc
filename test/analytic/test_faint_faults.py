"""Faults that hardly strike, and rolling elements that strike as the cage brings them into the load."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.monitor.chain import REFERENCE, MonitorResult, Stretch
from beardyn_core.monitor.streaming import Monitor
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS

SPEED = 15.0
TURNED = np.arange(round(60.0 / SPEED * RATE)) * SPEED / RATE
ANGLE = np.asarray(2.0 * np.pi * TURNED, np.float64)


def _heard(loudness: Float, seed: int) -> MonitorResult:
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
    modulated = _heard(_strikes(order, 0.2, by), seed)
    alike = _heard(_strikes(order, 0.25), seed)
    assert modulated.verdict == part, modulated.reason
    assert "faint" in modulated.reason
    assert alike.score > alike.threshold
    assert alike.verdict == "healthy", alike.reason


@pytest.mark.parametrize("seed", range(4))
def test_faint_lines_beside_a_comb_that_is_as_sure_are_no_fault(seed: int) -> None:
    own = _strikes(ORDERS.bpfi, 0.15, 1.0)
    assert _heard(own, seed).verdict == "cone"
    assert _heard(own + _strikes(5.37, 0.3) - 1.0, seed).verdict not in ("cup", "cone", "roller")


def test_as_faint_as_rollers_that_pass_is_no_fault_of_the_cup() -> None:
    found = _heard(_strikes(ORDERS.bpfo, 0.2), 3)
    assert found.score > found.threshold
    assert found.verdict == "healthy", found.reason


def _ball(depth: float) -> Float:
    """Give the loudness of a ball that spins about any axis: it is in the load once in a turn of the cage."""
    loaded = np.maximum(0.0, np.cos(2.0 * np.pi * ORDERS.ftf * TURNED)) ** 4
    return np.asarray(1.0 + depth * loaded, np.float64)


@pytest.mark.parametrize("seed", range(4))
def test_strikes_that_come_and_go_with_the_cage_are_those_of_a_rolling_element_or_of_the_cage(
    seed: int,
) -> None:
    found = _heard(_ball(2.0), seed)
    assert found.verdict == "roller", found.reason
    assert found.also_fits == ("cage",)
    assert "come and go with the cage" in found.reason
    assert "a damaged cage would have these lines, too" in found.reason
    assert _heard(_ball(0.15), seed).verdict == "healthy"  # of rollers that differ


@pytest.mark.parametrize("seed", range(4))
def test_a_cup_whose_strikes_come_and_go_with_the_cage_is_a_cup(seed: int) -> None:
    found = _heard(_ball(2.0) * _strikes(ORDERS.bpfo, 2.0), seed)
    assert found.verdict == "cup", found.reason
    assert found.also_fits == ()


def test_what_the_cage_shows_has_no_width() -> None:
    plate = NamePlate(
        roller_count=ROLLERS, roller_diameter=26.7e-3, pitch_diameter=185e-3, contact_angle=np.deg2rad(10.5)
    )
    monitor = Monitor(ORDERS, ROLLERS, RATE, SETTINGS, bearing=plate)
    time_ns = np.round(np.arange(len(TURNED)) * 1e9 / RATE).astype(np.int64)
    noise = np.random.default_rng(1).normal(size=len(TURNED))
    monitor.push_vibration(time_ns, _ball(2.0) * noise)
    monitor.push_shaft(time_ns, ANGLE)
    found = monitor.result()
    assert found.verdict == "roller"
    assert found.severity is not None
    assert np.isnan(found.severity.width)
    assert "with the cage" in found.severity.reason
