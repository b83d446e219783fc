"""Which bearing fits a vibration: synthetic strikes of known order, noise, and orders of no bearing."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.config.catalogue import catalogue, search_catalogue
from beardyn_core.monitor.bearing_search import (
    CANNOT_TELL,
    NONE,
    ONE,
    SEARCH_SETTINGS,
    SEVERAL,
    BearingSearch,
    BearingSearchResult,
)
from beardyn_core.monitor.chain import Stretch
from test.fault_signals import ORDERS, RATE, ROLLERS, fault_signal

ALL = {each.name: each.plate.frequencies for each in catalogue()}
SAME_SIZE = {each.name: ALL[each.name] for each in search_catalogue(bore=0.025, outer_diameter=0.052)}
SHAFT = 25.0  # [Hz]


@cache
def stretch_of(order: float, seed: int = 0, modulated: bool = False, seconds: float = 2.6) -> Stretch:
    """Strikes that slip by 1 % from one to the next, in noise."""
    random = np.random.default_rng(seed)
    rate = 25_600.0
    count = int(rate * seconds)
    time = np.arange(count) / rate
    signal = random.standard_normal(count)
    at = 0.0
    while order and at < seconds - 0.02:
        first = int(at * rate)
        after = np.arange(200) / rate
        loud = 8.0 * (1.0 + 0.9 * np.cos(2.0 * np.pi * SHAFT * at)) if modulated else 8.0
        signal[first : first + 200] += loud * np.exp(-1500.0 * after) * np.sin(8e3 * np.pi * after)
        at += (1.0 + 0.01 * random.standard_normal()) / (order * SHAFT)
    return Stretch(rate, signal[:, None], 2.0 * np.pi * SHAFT * time, np.nan, 0)


def searched(
    bearings: Mapping[str, FaultFrequencies], *stretches: Stretch, uncertainty: float = 0.0
) -> BearingSearchResult:
    search = BearingSearch(bearings)
    settings = replace(SEARCH_SETTINGS, speed_uncertainty=uncertainty)
    for each in stretches:
        search(each, ORDERS, ROLLERS, settings)
    return search.conclude()


def test_of_bearings_of_one_size_the_right_one_alone_fits() -> None:
    different = {name: orders for name, orders in SAME_SIZE.items() if name not in ("NSK 6205",)}
    found = searched(different, stretch_of(different["6205"].bpfo))
    assert found.answer == ONE
    assert [(each.name, each.parts[0].part) for each in found.fits] == [("6205", "cup")]
    assert found.fits[0].deviation < 2e-3
    assert found.comb_order == pytest.approx(3.585, rel=2e-3)


def test_of_all_bearings_several_fit_equally_and_the_right_one_is_near_the_first() -> None:
    found = searched(ALL, stretch_of(ALL["6205"].bpfo))
    assert found.answer == SEVERAL
    assert "6205" in [each.name for each in found.fits[:4]]
    assert all(each.deviation <= 0.01 for each in found.fits)
    assert f"{len(found.fits)} of {len(ALL)} bearings" in found.reason
    deviations = [each.deviation for each in found.fits]
    assert deviations == sorted(deviations)


def test_sidebands_tell_an_inner_ring() -> None:
    found = searched(SAME_SIZE, stretch_of(SAME_SIZE["6205"].bpfi, modulated=True))
    assert {(each.name, each.parts[0].part) for each in found.fits} == {
        ("6205", "cone"),
        ("NSK 6205", "cone"),
    }


def test_noise_and_a_healthy_bearing_cannot_tell() -> None:
    _, angle, acceleration = fault_signal(None, 71)
    for healthy in (stretch_of(0.0), Stretch(RATE, acceleration, angle, np.nan, 0)):
        found = searched(ALL, healthy)
        assert found.answer == CANNOT_TELL
        assert found.fits == ()
        assert "a healthy bearing has none" in found.reason
    assert searched(ALL).answer == CANNOT_TELL


def test_a_comb_in_fewer_than_half_of_the_analyses_cannot_tell() -> None:
    quiet = [stretch_of(0.0, seed) for seed in range(2)]
    assert searched(SAME_SIZE, stretch_of(3.585), *quiet).answer == CANNOT_TELL


def test_an_order_of_no_bearing_fits_none_and_the_nearest_is_named() -> None:
    found = searched(SAME_SIZE, stretch_of(3.66))
    assert found.answer == NONE
    assert "nearest is the outer ring (cup) of 6205" in found.reason
    assert searched(SAME_SIZE, stretch_of(4.3)).answer == NONE


def test_where_none_fits_the_speeds_are_named_at_which_one_would() -> None:
    right = ALL["6205"].bpfo
    found = searched({"6205": ALL["6205"]}, stretch_of(right / 0.93))  # the stated speed is 7 % too low
    nearest = found.speeds[0]
    assert found.answer == NONE
    assert (nearest.bearing, nearest.part) == ("6205", "cup")
    assert nearest.shaft_frequency == pytest.approx(SHAFT / 0.93, rel=3e-3)
    assert nearest.change == pytest.approx(1.0 / 0.93 - 1.0, abs=3e-3)
    assert [abs(each.change) for each in found.speeds] == sorted(abs(each.change) for each in found.speeds)
    assert searched({"6205": ALL["6205"]}, stretch_of(right)).speeds == ()


def test_a_stated_speed_lets_more_bearings_fit() -> None:
    certain = searched(ALL, stretch_of(3.585))
    stated = searched(ALL, stretch_of(3.585), uncertainty=0.03)
    assert {each.name for each in certain.fits} < {each.name for each in stated.fits}


def test_a_comb_of_twice_the_order_is_not_taken_for_the_bearing_of_half_of_it() -> None:
    found = searched({"half": ALL["6205"]}, stretch_of(2.0 * ALL["6205"].bpfo))
    assert found.answer == NONE


@pytest.mark.parametrize("fault", ["cup", "cone"])
def test_the_twin_s_own_bearing_fits_its_faults(fault: str) -> None:
    _, angle, acceleration = fault_signal(fault, 71)
    units = {"own": ORDERS, **{name: ALL[name] for name in ("HM133444", "HM127446", "AARK_6.5x9")}}
    found = searched(units, Stretch(RATE, acceleration, angle, np.nan, 0))
    assert (found.answer, found.fits[0].name, found.fits[0].parts[0].part) == (ONE, "own", fault)
