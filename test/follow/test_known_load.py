"""A load that is stated: how it is read, what contradicts it, and how sources agree."""

from __future__ import annotations

from math import sqrt

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.config import load_bearing
from beardyn_core.follow.conditioning import condition_estimates, known_load_of
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.known_load import NORMAL_90, KnownLoad, combine_loads, load_of_channel, read_load
from beardyn_core.follow.load_checks import Evidence, doubts_of, read_axle_loads
from beardyn_core.follow.load_sensors import AirSpring, PrimarySpring, WeighingSite, read_sensor
from beardyn_core.follow.quantities import BY_NAME

BEARING = load_bearing("HS130x230")


def told(name: str, low: float, value: float, high: float) -> Estimate:
    return Estimate(BY_NAME[name], value, ((low, high),) * 2)


def found(*quantities: Estimate) -> Estimates:
    return Estimates(None, quantities, 0.3, 2, 20.0)


@pytest.mark.parametrize(
    ("text", "value", "half"),
    [
        ("80", 80e3, 8e3),
        ("80:3", 80e3, 3e3),
        ("80:5%", 80e3, 4e3),
        ("80000N:3000N", 80e3, 3e3),
        ("80kN:3", 80e3, 3e3),
        ("8t:0.4", 8e3 * STANDARD_GRAVITY, 0.4e3 * STANDARD_GRAVITY),
        (" 80 : 3 ", 80e3, 3e3),
    ],
)
def test_a_load_is_read_with_its_unit_and_uncertainty(text: str, value: float, half: float) -> None:
    load = read_load(text)
    assert load.value == pytest.approx(value)
    assert load.half_width == pytest.approx(half)
    assert bool(load.assumed) == (":" not in text)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("80000", "newtons meant"),
        ("0.5", "allowed are 1 to 400 kN"),
        ("-80", "write VALUE"),
        ("80:0", "must be above 0"),
        ("80:60%", "at most 50 %"),
        ("80 lbf", "write VALUE"),
        ("nan", "write VALUE"),
    ],
)
def test_what_is_no_load_of_a_journal_is_refused_with_what_to_write(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_load(text)


def test_a_tonne_that_is_taken_for_kilonewtons_is_doubted() -> None:
    doubts = doubts_of(read_load("7:0.3"), BEARING, Evidence())
    assert any("check the unit" in each for each in doubts)
    assert not doubts_of(read_load("70:3"), BEARING, Evidence())


def test_a_load_of_an_axle_in_place_of_a_journal_is_doubted() -> None:
    axles = read_axle_loads("12:17")
    assert not doubts_of(read_load("70:3"), BEARING, Evidence(axle_loads=axles))
    (doubt,) = doubts_of(read_load("150:5"), BEARING, Evidence(axle_loads=axles))
    assert "is it the load of the whole axle?" in doubt
    assert "12 to 17 t" in doubt
    (doubt,) = doubts_of(read_load("150:5"), None, Evidence(speed=70.0))
    assert "252 km/h" in doubt


@pytest.mark.parametrize("text", ["17:12", "12", "12:a", "0:17", "12:170"])
def test_axle_loads_that_make_no_sense_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="EMPTY:FULL"):
        read_axle_loads(text)


def test_a_lateral_load_that_no_such_axle_can_bring_speaks_against_the_load() -> None:
    limit = 10e3 + (2 * 20e3 + 1500 * STANDARD_GRAVITY) / 3  # Prud'homme
    load = KnownLoad(20e3, 1.0)
    assert not doubts_of(load, None, Evidence(lateral=(0.95 * limit, 2 * limit)))
    (doubt,) = doubts_of(load, None, Evidence(lateral=(-2 * limit, -1.05 * limit)))
    assert "too small for the estimated lateral load" in doubt
    assert not doubts_of(load, None, Evidence(lateral=(-2 * limit, 2 * limit)))


def test_a_load_that_the_bearing_cannot_carry_is_refused() -> None:
    small = load_bearing("HS130x230")
    with pytest.raises(InputError, match="static load rating"):
        doubts_of(KnownLoad(1e7, 1e5), small, Evidence())


def test_sources_that_agree_are_averaged_by_their_precision() -> None:
    one, other = KnownLoad(70e3, 3e3, "a"), KnownLoad(73e3, 6e3, "b")
    both = combine_loads([one, other])
    assert both is not None
    weights = np.array([each.deviation**-2 for each in (one, other)])
    middle = np.exp(np.log([70e3, 73e3]) @ weights / weights.sum())
    assert both.value == pytest.approx(middle)
    assert both.deviation == pytest.approx(1.0 / sqrt(weights.sum()))
    assert not both.doubts


def test_sources_that_contradict_are_spanned_and_named() -> None:
    both = combine_loads([read_load("80:3"), KnownLoad(60e3, 2e3, "air spring at 4 bar")])
    assert both is not None
    low, high = both.interval
    assert low < 59e3
    assert high > 82e3
    assert "contradict: stated 80 ± 3 kN, air spring at 4 bar 60 ± 2 kN" in both.doubts[0]


def test_a_vibration_that_contradicts_the_load_is_said_and_widens_it() -> None:
    seen = found(told("vertical_load", 58e3, 60e3, 62e3), told("lateral_load", -2e3, 1e3, 4e3))
    after = condition_estimates(seen, read_load("80:3"), BEARING, 0.92)
    assert after.known_load is not None
    assert any("vibration 60" in each for each in after.known_load.doubts)
    low, high = after["vertical_load"].intervals[-1]
    assert low < 60e3 < 80e3 < high
    assert any(each.startswith("doubt: ") for each in after.sentences)


def test_a_vibration_that_agrees_narrows_the_load_and_leaves_the_other_numbers() -> None:
    seen = found(told("vertical_load", 70e3, 78e3, 87e3), told("lateral_load", -2e3, 1e3, 4e3))
    load = read_load("80:5")
    after = condition_estimates(seen, load, BEARING, 0.92)
    assert np.ptp(after["vertical_load"].intervals[-1]) < np.ptp(load.interval)
    assert after["lateral_load"] == seen["lateral_load"]
    assert "known, stated" in after["vertical_load"].sentence


def test_what_is_stated_and_a_channel_and_sensors_are_one_load() -> None:
    channel = load_of_channel({"channel": "Fz", "mean_N": 71e3, "uncertainty_N": 4e3})
    load = known_load_of(70, ["spring deflection_mm=10 stiffness_kN_per_mm=1.5 tare_kN=55"], [channel])
    assert load is not None
    assert 69e3 < load.value < 72e3
    assert not load.doubts
    assert known_load_of(None) is None
    assert known_load_of("") is None


AIR = AirSpring(4.1e5, 0.15, 900.0)
SPRING = PrimarySpring(12e-3, 1.1e6, 55e3)
SITE = WeighingSite(15e3, 1.6e3, "2026-05-01")


def test_the_uncertainty_of_an_air_spring_is_that_of_draws() -> None:
    random, count = np.random.default_rng(3), 200_000
    unit = lambda: random.normal(size=count) / NORMAL_90  # noqa: E731
    drawn = (AIR.pressure + AIR.pressure_error * unit()) * AIR.area * (1 + AIR.area_error * unit())
    drawn = drawn / 2 * (1 + AIR.sharing_error * unit())
    drawn = drawn + AIR.dead_mass * STANDARD_GRAVITY * (1 + AIR.dead_mass_error * unit())
    load = AIR.load()
    assert load.value == pytest.approx(np.median(drawn), rel=5e-3)
    assert load.half_width == pytest.approx(np.ptp(np.quantile(drawn, (0.05, 0.95))) / 2, rel=0.02)


def test_the_uncertainty_of_a_spring_is_that_of_draws_and_least_near_tare() -> None:
    random, count = np.random.default_rng(4), 200_000
    unit = lambda: random.normal(size=count) / NORMAL_90  # noqa: E731
    moved = SPRING.deflection + SPRING.deflection_error * unit()
    drawn = SPRING.tare * (1 + SPRING.tare_error * unit())
    drawn = drawn + SPRING.stiffness * (1 + SPRING.stiffness_error * unit()) * moved
    load = SPRING.load()
    assert load.value == pytest.approx(np.median(drawn), rel=5e-3)
    assert load.half_width == pytest.approx(np.ptp(np.quantile(drawn, (0.05, 0.95))) / 2, rel=0.02)
    assert PrimarySpring(0.0, 1.1e6, 55e3).load().half_width < load.half_width


def test_the_uncertainty_of_a_weighing_is_that_of_draws() -> None:
    random, count = np.random.default_rng(5), 200_000
    unit = lambda: random.normal(size=count) / NORMAL_90  # noqa: E731
    axle = SITE.axle_load * (1 + SITE.error * unit()) - SITE.wheelset_mass
    drawn = 0.5 * axle * STANDARD_GRAVITY * (1 + SITE.side_error * unit()) * (1 + SITE.changed * unit())
    load = SITE.load()
    assert load.value == pytest.approx(np.median(drawn), rel=5e-3)
    assert load.half_width == pytest.approx(np.ptp(np.quantile(drawn, (0.05, 0.95))) / 2, rel=0.03)


def test_a_sensor_is_read_in_the_units_of_its_keys() -> None:
    load = read_sensor("air_spring pressure_bar=4.1 area_m2=0.15 dead_mass_kg=900")
    assert load.value == pytest.approx(AIR.load().value)
    assert load.half_width == pytest.approx(AIR.load().half_width)
    assert "area_error_percent" in load.assumed
    stated = read_sensor(
        "weighing axle_load_t=15 wheelset_mass_t=1.6 day=2026-05-01 error_percent=1 side_error_percent=2 "
        "changed_percent=0"
    )
    assert stated.half_width < SITE.load().half_width
    assert not stated.assumed


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("strain x=1", "allowed are air_spring, spring, weighing"),
        ("air_spring pressure_bar=4.1", "area_m2"),
        ("air_spring pressure_bar=41 area_m2=0.15 dead_mass_kg=900", "pressure_bar"),
        ("air_spring pressure=4.1 area_m2=0.15 dead_mass_kg=900", "KEY=NUMBER"),
        ("spring deflection_mm=twelve stiffness_kN_per_mm=1.1 tare_kN=55", "must be a number"),
        ("spring deflection_mm=-150 stiffness_kN_per_mm=1.1 tare_kN=55", "check the units"),
        ("weighing axle_load_t=15 wheelset_mass_t=1.6 day=2026-13-01", "calendar"),
        ("weighing axle_load_t=1.5 wheelset_mass_t=1.6 day=2026-05-01", "not more than"),
        ("", "no sensor"),
    ],
)
def test_mistakes_of_a_sensor_are_named(text: str, words: str) -> None:
    with pytest.raises(InputError, match=words):
        read_sensor(text)
