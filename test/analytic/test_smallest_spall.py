"""The smallest spall that a record would have shown: the search, and how a spall is laid on a record."""

from dataclasses import replace
from math import isnan, pi

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import MonitorResult, Stretch
from beardyn_core.study import smallest_spall
from beardyn_core.study.smallest_spall import WIDTHS, SmallestSpall, smallest_spalls_in

RATE, SPEED = 12_800.0, 20.0
ORDERS = FaultFrequencies(7.29, 9.71, 3.2, 0.43)


def _stretch(revolutions=60.0, axes=3, turning=1.0):
    samples = round(revolutions / SPEED * RATE)
    angle = turning * 2.0 * pi * SPEED * np.arange(samples) / RATE + 0.7
    noise = np.random.default_rng(3).normal(size=(samples, axes))
    return Stretch(RATE, noise, angle, np.nan, 0)


def _twin_that_adds(level, monkeypatch):
    """A twin whose spall adds a constant of its width times a level to the axes, times 1, 2 and 3."""

    def vibration(scene, defects, sensor):
        count = round(scene.duration * RATE)
        angle = 2.0 * pi * SPEED * np.arange(count) / RATE
        added = sum(level[each.on] * each.width for each in defects)
        return angle, np.tile(added * np.array([1.0, 2.0, 3.0]), (count, 1))

    monkeypatch.setattr(smallest_spall, "_vibration", vibration)


def _loud(axis, bound):
    """A monitor that names the part whose level is on an axis, from a bound on."""

    def algorithm(stretch, orders, count, settings):
        part = "cup" if np.mean(stretch.acceleration[1000:-1000, axis]) > bound else "healthy"
        return MonitorResult(part, "", 0)

    return algorithm


@pytest.mark.parametrize("bound_mm", [0.5, 1.5, 3.5, 5.0, 11.0, 20.0, 22.0])
def test_the_search_finds_the_first_width_that_is_named(bound_mm, monkeypatch):
    _twin_that_adds({"cup": 1e3, "cone": 0.0, "roller": 0.0}, monkeypatch)
    scene = bd.scene(tier="quasistatic")
    found = list(smallest_spalls_in(_stretch(), (0, 1, 2), ORDERS, 17, scene, algorithm=_loud(0, bound_mm)))
    widths = 1e3 * np.array(WIDTHS)
    cup = found[0]
    if bound_mm > widths[-1]:
        assert isnan(cup.named)
        assert cup.missed == WIDTHS[-1]
        assert "a spall of 21 mm, the widest tried, would have been missed" in cup.sentence
    else:
        assert 1e3 * cup.named == pytest.approx(widths[widths > bound_mm][0])
        below = widths[widths <= bound_mm]
        assert 1e3 * cup.missed == pytest.approx(below[-1] if len(below) else 0.0)
    assert [each.part for each in found] == ["cup", "cone", "roller"]
    assert isnan(found[1].named)
    assert isnan(found[2].named)


def test_a_width_that_is_missed_between_named_ones_ends_the_search(monkeypatch):
    _twin_that_adds({"cup": 1e3, "cone": 0.0, "roller": 0.0}, monkeypatch)

    def but_for_12_mm(stretch, orders, count, settings):
        level = np.mean(stretch.acceleration[1000:-1000, 0])
        return MonitorResult("healthy" if abs(level - 12.0) < 0.5 else "cup", "", 0)

    scene = bd.scene(tier="quasistatic")
    (cup, *_) = smallest_spalls_in(_stretch(), (0, 1, 2), ORDERS, 17, scene, algorithm=but_for_12_mm)
    assert (cup.named, cup.missed) == (16e-3, 12e-3)


def test_only_the_axes_of_the_record_are_added(monkeypatch):
    _twin_that_adds({"cup": 1e3, "cone": 0.0, "roller": 0.0}, monkeypatch)
    scene, stretch = bd.scene(tier="quasistatic"), _stretch(axes=1)
    # the vertical axis alone: three times the first
    (cup, *_) = smallest_spalls_in(stretch, (2,), ORDERS, 17, scene, algorithm=_loud(0, 7.0))
    assert cup.named == 3e-3


@pytest.mark.parametrize("turning", [1.0, -1.0, 1.1])
def test_a_spall_is_laid_on_the_record_by_the_angle_of_the_shaft(turning):
    order, count = 7.3, round(80.0 / SPEED * RATE)
    angle = np.asarray(2.0 * pi * SPEED * np.arange(count) / RATE, np.float64)
    stretch = _stretch(turning=turning)
    laid = smallest_spall._over_angle(np.cos(order * angle)[:, None], angle, stretch.shaft_angle)
    turned = abs(turning) * 2.0 * pi * SPEED * np.arange(len(stretch.shaft_angle)) / RATE
    expected = np.cos(order * (turned + 2.0 * pi * smallest_spall._SETTLED))
    inner = slice(100, -100)
    assert laid[inner, 0] == pytest.approx(expected[inner], abs=0.01)


def test_a_short_record_and_a_twin_of_another_bearing_are_refused():
    run = bd.simulate(bd.scene(tier="quasistatic", effects="frictionless", duration=0.2))
    with pytest.raises(InputError, match="shorter than an analysis"):
        bd.smallest_spalls(run)
    with pytest.raises(InputError, match="a twin must have the bearing of the record"):
        bd.smallest_spalls(run, bd.scene(bearing="FR130x230x150"))


def test_what_a_record_of_a_lower_rate_cannot_hold_is_left_out():
    time = np.arange(25_600) / 25_600.0
    low, high = np.sin(2.0 * pi * 500.0 * time), np.sin(2.0 * pi * 6000.0 * time)
    kept = smallest_spall._in_band((low + high)[:, None], 25_600.0, 8533.0)
    inner = slice(2000, -2000)
    assert kept[inner, 0] == pytest.approx(low[inner], abs=0.01)
    same = smallest_spall._in_band((low + high)[:, None], 25_600.0, 25_600.0)
    assert np.array_equal(same[:, 0], low + high)


def test_sentences():
    found = SmallestSpall("cone", 4e-3, 3e-3, 21e-3)
    named = "inner ring (cone): a spall of 4 mm or more would have been named"
    assert found.sentence == f"{named}, one of 3 mm would have been missed"
    assert replace(found, missed=0.0).sentence == named
