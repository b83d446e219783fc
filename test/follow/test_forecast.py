"""Mileage of spalls and rating life that is used, against draws and closed forms."""

from __future__ import annotations

from dataclasses import replace
from math import isnan, log, pi

import numpy as np
import pytest

from beardyn_core.config import load_bearing, load_lubricant
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.fault_location import PartEstimate
from beardyn_core.follow.forecast import SOON, Forecast, forecast
from beardyn_core.follow.growth import NORMAL_90, GrowthLaw, PowerLaw, drawn_between
from beardyn_core.follow.quantities import BY_NAME
from beardyn_core.follow.service import Service
from beardyn_core.physics.statics.rating_life import LoadClass, rating_life

BEARING, GREASE = load_bearing("HS130x230"), load_lubricant("L055")
LENGTH = (24e-3, 26e-3)
SERVICE = Service(mileage=4e8, widest=30e-3)
LOAD = (6e4, 7e4, 8e4)


def known(name: str, low: float, value: float, high: float, reason: str = "") -> Estimate:
    """An estimate with its interval of 90 %, that of 50 % the same."""
    return Estimate(BY_NAME[name], float("nan") if reason else value, ((low, high),) * 2, reason)


def found(width: float = 8e-3, factor: float = 1.2, condition: str = "cup") -> Estimates:
    """Estimates of a spall that is so wide, whose 90 % interval is a factor to both sides."""
    return Estimates(
        PartEstimate(condition, 0.9, ((condition,),) * 2),
        (
            known("vertical_load", *LOAD),
            known("end_play", 5e-5, 1e-4, 1.5e-4),
            known("width", width / factor, width, width * factor, "" if condition == "cup" else "healthy"),
            known("length", LENGTH[0], 25e-3, LENGTH[1], "not identifiable"),
        ),
        0.3, 2, 20.0,
    )  # fmt: skip


def made(*arguments: object, **options: object) -> Forecast:
    law = options.pop("law", None)
    return forecast(found(*arguments, **options), BEARING, GREASE, SERVICE, law)  # type: ignore[arg-type]


def test_area_grows_slowly_up_to_the_critical_one_and_linearly_beyond() -> None:
    law = GrowthLaw(critical_area=250e-6, rate=1e-10, slow_share=0.25)
    begin, end = np.array([100e-6, 300e-6, 500e-6]), np.full(3, 450e-6)
    np.testing.assert_allclose(
        law.distance(begin, end, np.full(3, 1e-10)), [150e-6 / 0.25e-10 + 200e-6 / 1e-10, 150e-6 / 1e-10, 0.0]
    )


@pytest.mark.parametrize("exponent", [0.0, 0.3, 1.0, 1.7])
def test_power_laws_cover_the_distance_in_which_small_steps_add_up(exponent: float) -> None:
    law = PowerLaw(exponent, 250e-6, 1e-10)
    area, steps = np.linspace(80e-6, 600e-6, 20_001), 1e-10
    middles = 0.5 * (area[1:] + area[:-1])
    naive = np.sum(np.diff(area) / (steps * (middles / 250e-6) ** exponent))
    (found,) = law.distance(np.array([80e-6]), np.array([600e-6]), np.array([steps]))
    assert found == pytest.approx(naive, rel=1e-6)
    assert law.distance(np.array([3e-4]), np.array([2e-4]), np.array([steps])) == 0.0


def test_other_laws_are_told_beside_the_one_that_is_assumed() -> None:
    told = made()
    assert list(told.other_laws) == ["linear", "root of the area", "exponential"]
    middles = [each[1] for each in told.other_laws.values()]
    # of 200 to 750 mm2: the larger it is, the faster it grows
    assert middles == sorted(middles, reverse=True)
    assert all(low < middle < high for low, middle, high in told.other_laws.values())
    assert f"exponential {middles[-1] / 1e3:,.0f} km" in told.sentences[1]
    assert made(condition="healthy").other_laws == made(40e-3).other_laws == {}


def test_a_wider_spall_or_a_faster_growth_leaves_less() -> None:
    usual = made().remaining
    assert made(14e-3).remaining[1] < 0.8 * usual[1]
    np.testing.assert_allclose(made(law=GrowthLaw(rate=2e-10)).remaining, np.array(usual) / 2.0)
    assert "take it out now" in made(40e-3).sentences[0]
    assert isnan(made(condition="healthy").remaining[1])


@pytest.mark.parametrize("width", [18e-3, 20e-3, 24e-3, 30e-3])
@pytest.mark.parametrize("widest", [None, 30e-3, 39e-3, 60e-3])
def test_a_spall_that_can_be_20_mm_wide_has_no_mileage_left(width: float, widest: float | None) -> None:
    told = forecast(found(width), BEARING, GREASE, Service(widest=widest))
    assert told.remaining == (0.0, 0.0, 0.0)
    assert "take it out now" in told.sentences[0]
    assert " km" not in told.sentences[0]


def test_a_narrower_limit_of_ones_own_is_the_one_that_counts() -> None:
    told = forecast(found(6e-3), BEARING, GREASE, Service(widest=5e-3))
    assert told.remaining == (0.0, 0.0, 0.0)
    assert "can be wider than 5 mm already: take it out now" in told.sentences[0]
    least = replace(known("width", 6e-3, 8e-3, 40e-3, "at least 6 mm"), at_least=6e-3)
    others = tuple(each for each in found().quantities if each.quantity.name != "width")
    told = forecast(replace(found(), quantities=(*others, least)), BEARING, GREASE, Service(widest=5e-3))
    assert told.remaining == (0.0, 0.0, 0.0)


def test_a_width_that_is_known_from_below_alone_has_no_mileage_left() -> None:
    least = replace(known("width", 6e-3, 8e-3, 40e-3, "at least 11 mm"), at_least=11e-3)
    others = tuple(each for each in found().quantities if each.quantity.name != "width")
    told = forecast(replace(found(), quantities=(*others, least)), BEARING, GREASE, SERVICE)
    assert told.remaining[0] < SOON
    assert "take it out now" in told.sentences[0]


def test_a_spall_that_is_narrow_or_wide_has_no_mileage_and_is_not_called_out() -> None:
    least = replace(known("width", 5e-3, 6e-3, 40e-3, "at least 5 mm"), at_least=5e-3)
    others = tuple(each for each in found().quantities if each.quantity.name != "width")
    told = forecast(replace(found(), quantities=(*others, least)), BEARING, GREASE, SERVICE)
    assert isnan(told.remaining[0])
    assert "no mileage is given" in told.sentences[0]


def test_a_spall_of_unknown_width_is_said_to_have_no_forecast() -> None:
    blurred = known("width", 2e-3, 8e-3, 30e-3, "not identifiable")
    others = tuple(each for each in found().quantities if each.quantity.name != "width")
    told = forecast(replace(found(), quantities=(*others, blurred)), BEARING, GREASE, SERVICE)
    assert isnan(told.remaining[1])
    assert "how wide it can be is not known" in told.sentences[0]


def test_nine_of_ten_spalls_that_grow_by_the_law_come_to_the_width_within_the_interval() -> None:
    random, count, law = np.random.default_rng(3), 300, GrowthLaw()
    width = 8e-3 * np.exp(random.normal(0.0, log(1.2) / NORMAL_90, count))  # around what is measured
    across = drawn_between(LENGTH, count, random)
    true = law.distance(width * across, 30e-3 * across, law.rates(count, random))
    low, _, high = made().remaining
    inside = float(np.mean((low <= true) & (true <= high)))
    assert abs(inside - 0.9) < 4.0 * np.sqrt(0.09 / count)


def test_rating_life_is_that_of_the_load_and_its_interval_that_of_the_load() -> None:
    told = made()
    likely = rating_life(
        BEARING, (LoadClass(1.0, (0.0, 0.0, LOAD[1]), (0.0, 0.0, 0.0), 40.0 * pi),), GREASE, 333.15,
        end_play=1e-4, tilt="locked",
    )  # fmt: skip
    assert likely is not None
    assert told.equivalent_load == pytest.approx(LOAD[1])
    assert told.life == pytest.approx(pi * 0.92 * likely.basic)
    assert told.used[1] == pytest.approx(4e8 / (pi * 0.92) / likely.reference_basic)
    assert told.used[2] / told.used[0] == pytest.approx(
        (LOAD[2] / LOAD[0]) ** 4.0, rel=0.4
    )  # near 10/3 to 9/2


def test_without_a_load_nothing_is_said_of_the_rating_life() -> None:
    unknown = replace(found(), quantities=found().quantities[1:])
    told = forecast(unknown, BEARING, GREASE, SERVICE)
    assert isnan(told.used[1])
    assert "rating life: the load is not known" in told.sentences
