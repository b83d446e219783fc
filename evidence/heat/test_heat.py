"""Torque and temperatures of the page: published bands, and the rule for hot boxes beside them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from beardyn_core.choice.heat_interval import heat_interval
from beardyn_core.config import load_lubricant
from beardyn_core.monitor.chain import MonitorSettings
from evidence.heat.cases import (
    HEALTHY,
    NTN_LIGHT,
    NTN_STATE,
    OVERGREASED,
    PRELOADED,
    SPEEDS_KMH,
    STARVED,
    SUMMER,
    of_car,
    of_class_k,
    on_the_rig,
    published_band,
    steady,
    torque_grid,
    torque_point,
    torque_without_stiffening,
)
from evidence.heat.intervals import published
from evidence.heat.published import (
    EMPTY,
    LIP_SEAL,
    LOW_TORQUE,
    NTN_RISE,
    RUSSIAN_CARS,
    STANDARD,
    AxleResistance,
    Resistance,
)
from evidence.heat.skf import BEARING_32216, OIL, axlebox_moment, row_moment
from evidence.heat.tables import settled_range
from evidence.validation.heat import L055_70_C, NTN_TOLERANCE, RUSSIAN_TOLERANCE
from evidence.validation.losses import high_speed_static, power_loss


def test_catalogue_model_by_hand() -> None:
    """A 32216: d_m 110 mm, 6 kN of thrust, Y 1.4, 58.2 mm2/s, 2000 rpm in oil.

    G = 2.27e-6 110^2.38 (10.9 1.4 6000)^0.31 = 5.66; (58.2 2000)^0.6 = 1094; heating 0.85, supply 0.85.
    """
    found = row_moment(BEARING_32216, 0.0, 6e3, 2000.0, 58.2, OIL)
    assert found.rolling == pytest.approx(5.66e-3 * 1094 * 0.85 * 0.85, rel=0.02)
    assert found.sliding == pytest.approx(0.018 * 110**0.82 * 2 * 1.4 * 6e3 * 0.002e-3, rel=0.02)


def test_viscosity_of_the_catalogue_rows_is_that_of_the_grease() -> None:
    assert 1e6 * load_lubricant("L055").kinematic_viscosity(343.15) == pytest.approx(L055_70_C, rel=0.01)
    assert torque_point(70.0, 1165.0).catalogue == pytest.approx(
        axlebox_moment(80e3, 1165.0, L055_70_C).total, rel=0.01
    )


@pytest.mark.parametrize("temperature", [40.0, 70.0, 100.0])
def test_fresh_grease_has_the_torque_of_the_catalogue(temperature: float) -> None:
    """Within 35 % from 600 rpm on."""
    for speed in (600.0, 1165.0, 2000.0):
        point = torque_point(temperature, speed)
        assert point.contacts["fresh"] == pytest.approx(point.catalogue, rel=0.35), (temperature, speed)


@pytest.mark.slow
def test_settled_grease_lies_between_measured_boxes_and_the_catalogue() -> None:
    """Above what NTN's rig can have lost, 2 N m, and below SKF's model where that holds, 20 °C and more.

    Above that model only where its factor of replenishment has taken nearly all: viscosity times speed of
    more than 5e5.
    """
    oil = load_lubricant("L055")
    for point in torque_grid():
        if point.temperature_c < 20.0:
            continue
        assert point.whole["channelled"] > 2.0
        flow = 1e6 * oil.kinematic_viscosity(point.temperature_c + 273.15) * point.speed_rpm
        assert point.contacts["settled"] < point.catalogue or flow > 5e5, point
        supplies = [point.contacts[name] for name in ("channelled", "settled", "fresh", "flooded")]
        assert supplies == sorted(supplies)


@pytest.mark.parametrize("temperature", [40.0, 70.0, 100.0])
def test_settled_grease_is_within_the_band_of_published_torques_at_service_temperature(
    temperature: float,
) -> None:
    low, high = published_band()
    least, most = settled_range(temperature)
    assert low < least
    assert most < high


def test_stiff_seals_bring_the_torque_in_the_cold_into_the_published_band() -> None:
    """Without them it is below, the less the colder; the band is of service temperature."""
    low, high = published_band()
    for temperature in (0.0, 20.0):
        least, most = settled_range(temperature)
        assert low < least
        assert most < high
    assert settled_range(-20.0)[0] > low
    bare = [torque_without_stiffening(each, 300.0) / low for each in (-20.0, 0.0, 20.0)]
    assert bare == sorted(bare)
    assert bare[-1] < 1.0


@pytest.mark.slow
def test_healthy_boxes_are_as_warm_as_in_service_at_high_speed_and_cooler_below() -> None:
    """In service 20 to 50 K above the air: ours from 200 km/h on; below it is less, as the page says."""
    found = {speed: steady(HEALTHY, speed) for speed in SPEEDS_KMH}
    assert all(each.settles for each in found.values())
    rises = {speed: each.rise("axlebox") for speed, each in found.items()}
    assert 20.0 < rises[200.0] < rises[300.0] < 50.0
    assert 10.0 < rises[80.0] < 20.0


@pytest.mark.slow
def test_the_monitor_is_silent_on_healthy_boxes_and_calls_those_in_trouble() -> None:
    """At 300 km/h in air of 40 °C; what runs away passes every threshold on its way to 200 °C inside."""
    settings, summer = MonitorSettings(), (("ambient", SUMMER),)
    assert steady(replace(HEALTHY, thermal=summer), 300.0).box < settings.warm
    assert steady(replace(PRELOADED, thermal=summer), 300.0).box > settings.warm
    for state in (OVERGREASED, STARVED):
        found = steady(state, 300.0)
        assert not found.settles
        assert found.box > settings.warm


@pytest.mark.slow
def test_little_grease_and_light_seals_are_what_the_rig_asks_for() -> None:
    """The cause that the validation page names."""
    assert on_the_rig(NTN_STATE).rise("cup") > 2.0 * NTN_RISE
    assert on_the_rig(NTN_LIGHT).rise("cup") == pytest.approx(NTN_RISE, rel=NTN_TOLERANCE)


@pytest.mark.parametrize(
    "car", [*(pytest.param(car, marks=pytest.mark.slow) for car in RUSSIAN_CARS[:-1]), RUSSIAN_CARS[-1]]
)
def test_freight_cars_have_the_torque_of_their_resistance(car: Resistance) -> None:
    found = of_car(car)
    assert found.power / found.speed == pytest.approx(car.torque, rel=RUSSIAN_TOLERANCE)


@pytest.mark.parametrize("axle", [STANDARD, pytest.param(EMPTY, marks=pytest.mark.slow)])
def test_lip_seals_bring_class_k_to_the_published_torque_of_standard_and_of_empty_axles(
    axle: AxleResistance,
) -> None:
    """The causes that the validation page names; a loaded axle with low-torque seals then has too much."""
    torques = [
        found.power / found.speed for found in (of_class_k(each, LIP_SEAL) for each in (axle, LOW_TORQUE))
    ]
    assert torques[0] == pytest.approx(axle.torque, rel=RUSSIAN_TOLERANCE)
    assert torques[1] > (1.0 + RUSSIAN_TOLERANCE) * LOW_TORQUE.torque


def test_rollers_pressed_by_their_orbit_make_the_rolling_loss_of_the_crh380b() -> None:
    """The cause that the validation page names: with rollers at rest the loss is 1864 W."""
    static = high_speed_static(None, "locked")
    assert (static.cup_load > 0.0).all()
    assert static.loaded_roller_count == (7, 3)
    assert power_loss(None, "locked") == pytest.approx(2558.0, rel=0.01)


@pytest.mark.slow
def test_measured_temperatures_are_inside_the_intervals_of_their_scenes() -> None:
    for each in published():
        low, _, high = heat_interval(each.scene).rise(each.part)
        assert low <= each.least, each.name
        assert each.most <= high, each.name
