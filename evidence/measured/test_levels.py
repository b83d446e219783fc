"""Sizes of contacts, and what is measured of a signal."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import ellipe, ellipk

from beardyn_core.config import load_bearing
from evidence.impact.cases import WHOLE
from evidence.impact.elastic import cup_radius
from evidence.measured.levels import (
    CONFORMITY,
    INCH,
    alike,
    contact_of_ball,
    contact_of_roller,
    level,
    power_of_load,
)

BALL, PITCH = 7.94e-3, 39.04e-3


def test_contact_of_a_ball_is_an_ellipse_of_hertz() -> None:
    """Johnson (1985), 4.28 with elliptic integrals, of the ratio of axes that the simple formulas give."""
    width, length = contact_of_ball(40.0, BALL, PITCH)
    modulus = 1.0 - (width / length) ** 2
    first, second = ellipk(modulus), ellipe(modulus)
    along = 2.0 / BALL - 2.0 / (PITCH + BALL)
    across = 2.0 / BALL - 1.0 / (CONFORMITY * BALL)
    found = ((length / width) ** 2 * second - first) / (first - second)
    assert found == pytest.approx(along / across, rel=0.1)
    heavier = contact_of_ball(320.0, BALL, PITCH)
    assert heavier == pytest.approx((2.0 * width, 2.0 * length), rel=1e-9)


def test_contact_of_a_roller_is_the_band_of_hertz() -> None:
    """Johnson (1985), 4.45 and 4.46: the largest pressure is 4 / pi of the mean one."""
    bearing, load = load_bearing("HS130x230"), 1e4
    width = contact_of_roller(load)
    modulus = 0.5 * bearing.material.contact_modulus
    highest = math.sqrt(load / WHOLE * modulus / (math.pi * cup_radius(bearing)))
    assert 4.0 / math.pi * load / (width * WHOLE) == pytest.approx(highest)
    assert contact_of_roller(4.0 * load) == pytest.approx(2.0 * width)


def test_a_spall_like_a_fault_has_its_size_beside_the_contact() -> None:
    width, length = contact_of_ball(40.0, BALL, PITCH)
    case = alike(7)
    assert case.width / contact_of_roller(1e4) == pytest.approx(7 * INCH / width)
    assert case.length / WHOLE == pytest.approx(7 * INCH / length)
    assert alike(100).length == pytest.approx(WHOLE)


def test_level_of_noise_and_power_of_a_load() -> None:
    noise = np.random.default_rng(3).standard_normal(1 << 18)
    found = level(noise, 51_200.0)
    assert found.kurtosis == pytest.approx(3.0, abs=0.05)
    assert found.ringing_kurtosis == pytest.approx(3.0, abs=0.1)
    # the band's edges are where the filter, run both ways, has a quarter of the power
    assert found.rms == pytest.approx(math.sqrt(5500.0 / 25_600.0), rel=0.07)
    assert math.isnan(level(noise, 12_000.0).ringing)
    assert power_of_load((1.0, 2.0, 4.0), (3.0, 3.0 * 2**0.4, 3.0 * 4**0.4)) == pytest.approx(0.4)
