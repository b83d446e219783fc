"""Laws of growth: there and back, fitted to widths, and told apart where the widths are good enough."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from beardyn_core.base.arrays import Float
from beardyn_core.fleet.growth_fit import Widths, fit_growth
from beardyn_core.follow.growth import ASSUMED_LAW, GrowthLaw, PowerLaw, other_laws

LAW = GrowthLaw()
LAWS: dict[str, GrowthLaw | PowerLaw] = {ASSUMED_LAW: LAW, **other_laws(LAW)}
ACROSS, FIRST = 20e-3, 3e-3  # [m]


def grown(law: GrowthLaw | PowerLaw, at: Float, rate: float = 1e-10) -> Float:
    """Widths of a spall that grows by a law."""
    begin, drawn = np.array([ACROSS * FIRST]), np.array([rate])
    return np.array([float(law.grow_areas(begin, drawn, float(each))[0]) / ACROSS for each in at])


def until(law: GrowthLaw | PowerLaw, width: float, count: int) -> Float:
    """Mileages at even distances until a spall has a width, [m]."""
    ends = np.array([FIRST, width]) * ACROSS
    whole = float(law.distance(ends[:1], ends[1:], np.array([1e-10]))[0])
    return np.asarray(np.linspace(0.0, whole, count), np.float64)


@given(
    st.sampled_from([*LAWS.values(), PowerLaw(0.25), PowerLaw(1.6)]),
    st.floats(1e-6, 5e-4),
    st.floats(1e-12, 1e-9),
    st.floats(0.0, 0.999),
)
def test_an_area_grows_to_the_one_that_its_distance_is_to(
    law: GrowthLaw | PowerLaw, begin: float, rate: float, share: float
) -> None:
    end = begin + share * (8e-4 - begin)
    first, last, rates = np.array([begin]), np.array([end]), np.array([rate])
    way = float(law.distance(first, last, rates)[0])
    assert law.grow_areas(first, rates, way)[0] == pytest.approx(end, rel=1e-6)


def test_a_power_above_one_grows_beyond_all_numbers() -> None:
    law = PowerLaw(1.5)
    assert law.grow_areas(np.array([2e-4]), np.array([1e-9]), 1e9)[0] == np.inf


@pytest.mark.parametrize("count", [3, 30, 300])
def test_many_exact_widths_leave_draws_that_count(count: int) -> None:
    at = until(LAW, 16e-3, count)
    width = grown(LAW, at)
    fit = fit_growth(LAW, LAW, Widths(at, width, np.maximum(0.03 * width, 2e-4)))
    assert fit.is_usable
    low, middle, high = fit.quantiles(fit.begin / fit.across, (0.05, 0.5, 0.95))
    assert low < FIRST < high
    assert middle == pytest.approx(FIRST, rel=0.1)


@pytest.mark.parametrize("name", LAWS)
def test_the_law_that_a_spall_grows_by_explains_its_widths(name: str) -> None:
    law, random = LAWS[name], np.random.default_rng(7)
    at = until(law, 19e-3, 60)
    true = grown(law, at)
    deviation = 0.02 * true
    widths = Widths(at, true + random.normal(0.0, deviation), deviation)
    fits = {each: fit_growth(LAWS[each], LAW, widths) for each in LAWS}
    assert fits[name].is_usable
    best = max(fits.values(), key=lambda each: each.likelihood)
    assert fits[name].likelihood >= best.likelihood + np.log(0.05)
    far = {"linear": "exponential", "exponential": "linear"}.get(name)
    if far is not None:
        assert fits[far].likelihood < best.likelihood + np.log(0.05)
