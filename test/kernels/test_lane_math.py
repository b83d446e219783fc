"""Elementary functions of lane values keep the errors their docstrings state, and let a NaN through."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.physics.lanes.lanes import Lanes
from test.kernels.casting import through
from test.kernels.entries import MATH_NAMES, lane_math

LANES = {width: Lanes(width) for width in (1, 8)}
POSITIVE = np.exp(np.random.default_rng(3).uniform(np.log(1e-300), np.log(1e300), 40_000))


def results(values: Any, lanes: Any, bound: float = 0.0) -> dict[str, Any]:
    out = through(lanes, lane_math, np.asarray(values, dtype=float)[:, None], len(MATH_NAMES), bound)
    return dict(zip(MATH_NAMES, out.T, strict=True))


def test_ninth_root_is_good_to_1e_14_over_the_approaches_a_contact_can_have(lanes: Any) -> None:
    """From the smallest approach of the kernel, 1e-15 m, to a metre; longdouble power as reference."""
    approach = np.exp(np.random.default_rng(1).uniform(np.log(1e-15), 0.0, 100_000))
    exact = (approach.astype(np.longdouble) ** (np.longdouble(1) / 9)).astype(float)
    assert np.abs(results(approach, lanes)["ninth_root"] / exact - 1.0).max() < 1e-14


def test_ninth_root_is_good_to_1e_14_over_all_magnitudes(lanes: Any) -> None:
    exact = (POSITIVE.astype(np.longdouble) ** (np.longdouble(1) / 9)).astype(float)
    assert np.abs(results(POSITIVE, lanes)["ninth_root"] / exact - 1.0).max() < 1e-14


def test_quick_ninth_root_is_good_to_2e_7_over_all_magnitudes(lanes: Any) -> None:
    exact = (POSITIVE.astype(np.longdouble) ** (np.longdouble(1) / 9)).astype(float)
    assert np.abs(results(POSITIVE, lanes)["quick_ninth_root"] / exact - 1.0).max() < 2e-7


def test_binary_logarithm_is_good_to_1e_11(lanes: Any) -> None:
    values = np.concatenate([POSITIVE, [1.0, 2.0, 0.5, np.nextafter(2.0, 0.0), np.nextafter(1.0, 0.0)]])
    assert np.abs(results(values, lanes)["log2"] - np.log2(values)).max() < 1e-11


def test_power_of_two_is_good_to_1e_10(lanes: Any) -> None:
    exponents = np.concatenate(
        [np.random.default_rng(2).uniform(-1000.0, 1000.0, 100_000), [0.0, 0.5, -0.5, 999.5]]
    )
    assert np.abs(results(exponents, lanes)["exp2"] / np.exp2(exponents) - 1.0).max() < 1e-10


def test_soft_positive_part_is_good_to_2e_4_and_smooth_at_zero(lanes: Any) -> None:
    values = np.concatenate([np.linspace(-60.0, 60.0, 24_001), [-900.0, 900.0]])
    found = results(values, lanes)["log2_one_plus_exp2"]
    assert np.abs(found - np.logaddexp2(0.0, values)).max() < 2e-4
    assert (np.diff(found[:-2]) >= 0.0).all()
    below, above = (results([sign * 1e-6], lanes)["log2_one_plus_exp2"][0] - 1.0 for sign in (-1.0, 1.0))
    assert below / -1e-6 == pytest.approx(above / 1e-6, rel=1e-5)


def test_cosine_and_sine_are_good_to_2e_15_within_a_few_turns(lanes: Any) -> None:
    angle = np.random.default_rng(4).uniform(-8.0 * np.pi, 8.0 * np.pi, 100_000)
    got = results(angle, lanes)
    # the reference itself and the reduction of the argument to one turn are rounded: 4 ulp of 25
    reduced = 25.0 * np.finfo(float).eps
    assert np.abs(got["cos"] - np.cos(angle)).max() < 2e-15 + reduced
    assert np.abs(got["sin"] - np.sin(angle)).max() < 2e-15 + reduced
    first = np.abs(angle) < np.pi
    assert np.abs(got["cos"] - np.cos(angle))[first].max() < 2e-15
    assert np.abs(got["sin"] - np.sin(angle))[first].max() < 2e-15


def test_cosine_and_sine_stay_good_after_an_hour_of_cage_revolutions(lanes: Any) -> None:
    """Angles are not wrapped in the state: 8 revolutions a second for an hour are 1.8e5 rad."""
    angle = 1.8e5 + np.linspace(0.0, 7.0, 1000)
    got = results(angle, lanes)
    assert np.abs(got["cos"] - np.cos(angle)).max() < 4.0 * 1.8e5 * np.finfo(float).eps
    assert np.abs(got["sin"] - np.sin(angle)).max() < 4.0 * 1.8e5 * np.finfo(float).eps


def test_wrapped_angle_lies_in_one_turn_and_is_the_same_angle(lanes: Any) -> None:
    angle = np.random.default_rng(5).uniform(-100.0, 100.0, 10_000)
    wrapped = results(angle, lanes)["wrap"]
    assert np.all((wrapped >= -np.pi - 1e-13) & (wrapped < np.pi + 1e-13))
    assert np.abs(np.exp(1j * wrapped) - np.exp(1j * angle)).max() < 1e-13


def test_plain_operations_are_exact(lanes: Any) -> None:
    values = np.concatenate([-POSITIVE[:5000], POSITIVE[:5000], [0.0, -0.0, 2.5, -2.5]])
    got = results(values, lanes, bound=1.0)
    np.testing.assert_array_equal(got["magnitude"], np.abs(values))
    np.testing.assert_array_equal(got["floor"], np.floor(values))
    np.testing.assert_array_equal(got["at_least"], np.maximum(values, 1.0))
    np.testing.assert_array_equal(got["at_most"], np.minimum(values, 1.0))
    np.testing.assert_array_equal(got["where_greater"], np.where(values > 1.0, 1.0, 0.0))
    np.testing.assert_array_equal(got["negated"], -values)


@pytest.mark.parametrize("name", MATH_NAMES)
def test_nan_survives(lanes: Any, name: str) -> None:
    """In its lane, and only there."""
    values = np.linspace(0.5, 1.2, 8)
    values[3] = np.nan
    result = results(values, lanes)[name]
    assert np.isnan(result[3])
    assert np.isfinite(np.delete(result, 3)).all()


@given(st.lists(st.floats(1e-12, 1e12), min_size=8, max_size=8))
@settings(max_examples=60, deadline=None)
def test_vector_and_scalar_functions_agree_to_rounding(values: list[float]) -> None:
    """One unit in the last place of each step of a polynomial may differ: the compiler fuses differently."""
    vector, scalar = results(values, LANES[8]), results(values, LANES[1])
    for name in MATH_NAMES:
        scale = np.maximum(np.abs(scalar[name]), 1.0 if name in ("wrap", "cos", "sin") else 0.0)
        if name in ("wrap", "cos", "sin"):
            scale = np.maximum(scale, np.abs(values))
        assert np.all(np.abs(vector[name] - scalar[name]) <= 16.0 * np.finfo(float).eps * scale), name
