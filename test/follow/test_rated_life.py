"""Rating life under a known load: the existing functions, intervals by draws, Miner's sum by hand."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from math import exp, isnan, log, pi

import numpy as np
import pytest

from beardyn_core.api.statics import life
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.bearing.life import reference_viscosity
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.config import load_any_bearing, load_bearing, load_lubricant
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.known_load import NORMAL_90, KnownLoad
from beardyn_core.follow.life_assumptions import LifeAssumptions
from beardyn_core.follow.life_surface import LifeSurface
from beardyn_core.follow.quantities import BY_NAME
from beardyn_core.follow.rated_life import LifeCounter, _play, usual_play

BEARING, GREASE = load_bearing("HS130x230"), load_lubricant("L055")
WHEEL, TURN = 0.92, 0.92 * pi
SPEED = 2.0 * pi * 20.0
LOAD = KnownLoad(70e3, 3e3)
WARM = (60.0 + ZERO_CELSIUS - 1e-6, 60.0 + ZERO_CELSIUS + 1e-6)
SURE = LifeAssumptions(WARM, (0.6, 0.6), (1.0, 1.0), (0.0, 0.0), 0.0)
"""Nothing is assumed to vary."""


def found(
    lateral: tuple[float, float] = (3999.0, 4001.0), play: tuple[float, float] = (99e-6, 101e-6)
) -> Estimates:
    each = [
        Estimate(BY_NAME[name], 0.5 * (low + high), ((low, high),) * 2)
        for name, (low, high) in (("lateral_load", lateral), ("end_play", (99e-6, 101e-6)))
    ]
    return Estimates(None, tuple(each), 0.3, 2, 20.0)


@pytest.fixture(scope="module")
def surface() -> LifeSurface:
    return LifeSurface(BEARING, 70e3, 1e-4, SPEED)


def counter(surface: LifeSurface, assumptions: LifeAssumptions = SURE) -> LifeCounter:
    """A counter that need not solve its own surface."""
    made = LifeCounter(BEARING, GREASE, WHEEL, assumptions)
    made._surface = surface
    return made


@pytest.mark.slow
@pytest.mark.parametrize(
    ("vertical", "lateral", "celsius", "clean", "play_mm"),
    [
        (70.0, 4.0, 60.0, 0.6, 0.1),
        (50.0, 10.0, 95.0, 0.45, 0.06),
        (95.0, -12.0, 45.0, 0.75, 0.14),
        (60.0, 0.0, 80.0, 0.5, 0.1),
    ],
)
def test_lives_between_the_points_of_the_grid_are_those_of_the_existing_function(
    surface: LifeSurface, vertical: float, lateral: float, celsius: float, clean: float, play_mm: float
) -> None:
    kappa = GREASE.kinematic_viscosity(celsius + ZERO_CELSIUS) / reference_viscosity(BEARING, SPEED)
    numbers = (1e3 * vertical, 1e3 * lateral, 1e-3 * play_mm, kappa, clean)
    got = surface.lives(*(np.array([each]) for each in numbers))
    exact = life(
        BEARING, [0.0, lateral, vertical], 1200.0, temperature_C=celsius, contamination=clean,
        end_play_mm=play_mm,
    )  # fmt: skip
    assert got.equivalent_load[0] == pytest.approx(exact.equivalent_load, rel=1e-9)
    assert got.basic[0] == pytest.approx(exact.basic, rel=1e-9)
    # lives differ by factors between a clean and a dirty bearing: 12 % of interpolation is no matter
    assert got.reference_basic[0] == pytest.approx(exact.reference_basic, rel=0.08)
    assert got.reference_modified[0] == pytest.approx(exact.reference_modified, rel=0.12)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["WJ130x240", "SRB120x260"])
@pytest.mark.parametrize("more_mm", [-0.04, 0.0, 0.04])
def test_lives_of_other_kinds_are_those_at_a_radial_clearance(name: str, more_mm: float) -> None:
    bearing, surface = load_any_bearing(name), surface_of(name)
    assert isinstance(bearing, RadialBearing)
    clearance = bearing.radial_clearance + 1e-3 * more_mm
    kappa = GREASE.kinematic_viscosity(WARM[0]) / reference_viscosity(bearing, SPEED)
    got = surface.lives(*(np.array([each]) for each in (80e3, 6e3, clearance, kappa, 0.6)))
    drawn = replace(bearing, radial_clearance=clearance)
    exact = life(drawn, [0.0, 6.0, 80.0], 1200.0, temperature_C=60.0, contamination=0.6)
    assert got.basic[0] == pytest.approx(exact.basic, rel=1e-9)
    assert got.reference_basic[0] == pytest.approx(exact.reference_basic, rel=0.08)
    assert got.reference_modified[0] == pytest.approx(exact.reference_modified, rel=0.12)


@cache
def surface_of(name: str) -> LifeSurface:
    bearing = load_any_bearing(name)
    return LifeSurface(bearing, 70e3, usual_play(bearing), SPEED)


@pytest.mark.parametrize(
    ("name", "play_mm", "around_mm"),
    [("HS130x230", 0.1, 0.08), ("WJ130x240", 0.13, 0.04), ("SRB120x260", 0.1, 0.04)],
)
def test_the_play_that_is_assumed_is_that_of_the_kind(name: str, play_mm: float, around_mm: float) -> None:
    ends = _play(Estimates(None, (), 0.3, 2, 20.0), load_any_bearing(name))
    assert ends == pytest.approx((1e-3 * (play_mm - around_mm), 1e-3 * (play_mm + around_mm)))


def test_where_nothing_is_unsure_all_three_quantiles_are_the_life(surface: LifeSurface) -> None:
    rated = counter(surface).rate(KnownLoad(70e3, 1.0), found(), 0.0)
    assert rated is not None
    exact = life(BEARING, [0.0, 4.0, 70.0], 1200.0, temperature_C=60.0, end_play_mm=0.1)
    assert np.ptp(rated.basic) < 1e-3 * rated.basic[1]
    assert rated.basic[1] == pytest.approx(exact.basic * TURN, rel=1e-3)
    assert rated.reference_modified[1] == pytest.approx(exact.reference_modified * TURN, rel=0.1)
    assert isnan(rated.used[1])
    assert not rated.spans


def test_the_interval_of_a_load_alone_is_its_power_of_ten_thirds(surface: LifeSurface) -> None:
    rated = counter(surface).rate(LOAD, found((-1.0, 1.0)), 0.0)
    assert rated is not None
    low, _, high = rated.basic
    assert log(high / low) == pytest.approx(10.0 / 3.0 * 2.0 * NORMAL_90 * LOAD.deviation, rel=0.05)
    assert rated.parts["load"] > 0.99


@pytest.mark.slow
def test_the_interval_is_that_of_draws_through_the_existing_function(surface: LifeSurface) -> None:
    ends = LifeAssumptions((50.0 + ZERO_CELSIUS, 80.0 + ZERO_CELSIUS), (0.45, 0.75), (1.0, 1.0), (0.0, 0.0))
    rated = counter(surface, ends).rate(LOAD, found((-1e3, 9e3)), 0.0)
    assert rated is not None
    random, lives = np.random.default_rng(8), []
    for _ in range(60):
        load, side, warm, clean = random.normal(size=4)
        lives.append(
            life(
                BEARING,
                [0.0, 4.0 + 5.0 / NORMAL_90 * side, 70.0 * exp(LOAD.deviation * load)],
                1200.0,
                temperature_C=65.0 + 15.0 / NORMAL_90 * warm,
                contamination=float(np.clip(0.6 + 0.15 / NORMAL_90 * clean, 0.05, 1.0)),
                end_play_mm=0.1,
            ).reference_modified
            * TURN
        )
    drawn = np.log(lives)
    low, middle, high = np.log(rated.reference_modified)
    # of 60 draws the mean scatters by 0.13, the deviation by 0.09 of the deviation
    assert middle == pytest.approx(drawn.mean(), abs=0.4 * drawn.std())
    assert (high - low) / (2.0 * NORMAL_90) == pytest.approx(drawn.std(), rel=0.3)


def test_every_doubt_widens_the_interval(surface: LifeSurface) -> None:
    sure = counter(surface).rate(LOAD, found(), 0.0)
    assert sure is not None
    width = log(sure.reference_modified[2] / sure.reference_modified[0])
    for wider in (
        replace(SURE, contamination=(0.4, 0.8)),
        replace(SURE, viscosity=(0.5, 2.0)),
        replace(SURE, temperature=(310.0, 370.0)),
    ):
        rated = counter(surface, wider).rate(LOAD, found(), 0.0)
        assert rated is not None
        assert log(rated.reference_modified[2] / rated.reference_modified[0]) > 1.2 * width


def test_swings_of_the_load_shorten_the_life_by_the_mean_of_its_power(surface: LifeSurface) -> None:
    calm = counter(surface).rate(KnownLoad(70e3, 1.0), found((-1.0, 1.0)), 0.0)
    rough = counter(surface, replace(SURE, swing=(0.2, 0.2))).rate(
        KnownLoad(70e3, 1.0), found((-1.0, 1.0)), 0.0
    )
    assert calm is not None
    assert rough is not None
    draws = 1.0 + 0.2 * np.random.default_rng(1).normal(size=400_000)
    factor = np.mean(np.abs(draws) ** (10.0 / 3.0))
    assert calm.basic[1] / rough.basic[1] == pytest.approx(factor, rel=0.02)


def test_miners_sum_is_the_one_by_hand(surface: LifeSurface) -> None:
    made = counter(surface)
    loads = [KnownLoad(value, 1.0) for value in (60e3, 90e3, 70e3)]
    begun, basic = (1e8, 3e8, 4e8), []
    rated = None
    for load, mileage in zip(loads, begun, strict=True):
        made.begin(mileage)
        rated = made.rate(load, found(), mileage + 2e5)
        assert rated is not None
        basic.append(rated.reference_basic[1])
    assert rated is not None
    middles = 0.5 * (1e8 + 2e5 + 3e8), 0.5 * (3e8 + 2e5 + 4e8)
    spans = ((0.0, middles[0]), middles, (middles[1], 4e8 + 2e5))
    np.testing.assert_allclose(rated.spans, spans)
    by_hand = sum((end - begin) / each for (begin, end), each in zip(spans, basic, strict=True))
    assert rated.used_basic[1] == pytest.approx(by_hand, rel=1e-3)
    assert any("the recordings stand for 0 to 200,100 km" in each for each in rated.sentences)


def test_the_load_between_recordings_widens_what_is_used_and_not_the_life(surface: LifeSurface) -> None:
    sure = counter(surface).rate(LOAD, found(), 4e8)
    doubtful = counter(surface, replace(SURE, between=0.3)).rate(LOAD, found(), 4e8)
    assert sure is not None
    assert doubtful is not None
    assert doubtful.reference_basic == sure.reference_basic
    assert doubtful.used_basic[2] / doubtful.used_basic[0] > 1.5 * sure.used_basic[2] / sure.used_basic[0]


def test_a_lateral_load_that_is_not_estimated_is_assumed_and_named(surface: LifeSurface) -> None:
    silent = Estimates(None, (), 3.0, 2, 20.0)
    rated = counter(surface).rate(LOAD, silent, 0.0)
    assert rated is not None
    assert not rated.lateral_is_estimated
    assert "-10.5 to 10.5 kN (assumed)" in rated.sentences[0]
    assert counter(surface).rate(LOAD, replace(silent, shaft_frequency=0.0), 0.0) is None
