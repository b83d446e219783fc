"""Spalls that can be wide are told from narrow ones by the chances of runs that were not learnt from."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.regression import Regression
from beardyn_core.follow.wide_spall import WideRule, half_distance

PLATE = NamePlate(name="axlebox", roller_count=17, roller_diameter=26.7e-3, pitch_diameter=185e-3)
HALF = half_distance(PLATE)


def rule() -> WideRule:
    nothing: Float = np.zeros(1)
    regression = Regression(np.zeros((1, 1)), np.zeros((1, 1)), nothing, nothing, 1.0, 0.0, 0.0)
    return WideRule(regression, HALF)


@given(seed=st.integers(0, 1000), apart=st.floats(-0.5, 3.0))
def test_hardly_a_wide_spall_is_taken_for_a_narrow_one(seed: int, apart: float) -> None:
    random = np.random.default_rng(seed)
    widths = np.concatenate([random.uniform(2e-3, 11e-3, 100), random.uniform(20e-3, 34e-3, 100)])
    chances = random.normal(0.0, 0.3, 200) + apart * (widths > HALF)
    found = rule().decided(chances, widths)
    assert np.mean(chances[100:] <= found.narrow) <= 0.06
    assert np.mean(chances[:100] > found.wide) <= 0.06
    assert found.narrow <= found.wide


def test_least_width_of_a_wide_spall_is_12_mm_for_the_shipped_bearing() -> None:
    assert rule().least == pytest.approx(12.0e-3, abs=0.1e-3)
