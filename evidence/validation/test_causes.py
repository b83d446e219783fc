"""Causes that the validation page gives for measured rows that miss: a run without each comes within."""

from __future__ import annotations

from dataclasses import replace

import pytest

from evidence.heat.cases import HEALTHY, SUMMER, State, torque_point
from evidence.impact.cases import healthy
from evidence.impact.study import received
from evidence.measured.levels import SHALLOW, ours_over_load, ratio
from evidence.validation import wheel_waves, wheelset
from evidence.validation.anchor import turns
from evidence.validation.heat import FLEET, SERVICE_TOLERANCE, SKF_TOLERANCE, grease_celsius, in_train
from evidence.validation.losses import LAYER, loss_under, torque_32216, unpressed
from evidence.validation.rigs import (
    COMBINED_MISSES,
    COMBINED_TOLERANCE,
    COMBINED_TORQUES,
    GHENT_MISSES,
    GHENT_TOLERANCE,
    GHENT_TORQUES,
    RIB_FILM,
    WARMER,
    combined,
    ghent,
    torque,
    warmed,
)
from evidence.validation.roller_loads import counts
from evidence.validation.spalls import FAULTS_OF_CWRU, sound_ringing
from evidence.validation.statics import bounce_frequency
from test.examples import fast_ones

COLD_PLAY = 2.0e-4
LOSS_OF_ZHAO = 1641.7
MEASURED_32216 = {(celsius, speed): measured for celsius, speed, measured in COMBINED_TORQUES}
MEASURED_32008 = {
    (supplied, speed): measured
    for speed, *both in GHENT_TORQUES
    for supplied, measured in zip((55.0, 65.0), both, strict=True)
}


def because(cause: str) -> list[tuple[float, float]]:
    return [where for where, why in GHENT_MISSES.items() if why.startswith(cause)]


def test_rollers_of_71_g_bounce_in_the_published_band() -> None:
    assert bounce_frequency(615.0, 0.071) == pytest.approx(30e3, rel=0.1)


def test_a_layer_of_oil_in_place_of_a_flooded_inlet_brings_the_32216_to_the_measured_torque() -> None:
    for speed, measured in ((500.0, 1.30), (2000.0, 2.95)):
        assert torque_32216(speed, supply=LAYER) == pytest.approx(measured, rel=0.15)
    assert torque_32216(4000.0, supply=LAYER) < 0.75 * 3.75


def test_rollers_that_their_orbit_does_not_press_bring_7_and_3_to_the_published_loss() -> None:
    static = unpressed(15e3, 2e-4)
    assert static.loaded_roller_count == (7, 3)
    assert loss_under(static) == pytest.approx(LOSS_OF_ZHAO, rel=0.15)


def test_five_loaded_rollers_a_row_and_no_others_bring_the_published_loss() -> None:
    static = unpressed(3e3, 3e-4)
    assert static.loaded_roller_count == (5, 5)
    assert loss_under(static) == pytest.approx(LOSS_OF_ZHAO, rel=0.15)


@pytest.mark.parametrize("speed", fast_ones([300.0, 1165.0, 2000.0], 0))
def test_fresh_grease_brings_the_axlebox_to_the_model_of_the_catalogue(speed: float) -> None:
    point = torque_point(70.0, speed)
    assert point.contacts["fresh"] == pytest.approx(point.catalogue, rel=SKF_TOLERANCE)


@pytest.mark.slow
def test_a_sound_bearing_without_cages_is_no_more_impulsive_than_noise() -> None:
    """At 90 km/h: kurtosis as published, and the crest factor below the published ones."""
    uncaged = received(replace(healthy(90.0), caged=False))
    assert uncaged.kurtosis == pytest.approx(3.0, rel=0.1)
    assert uncaged.peak / uncaged.rms < 4.9


@pytest.mark.parametrize(("celsius", "speed"), COMBINED_MISSES)
def test_less_oil_at_the_inlets_brings_the_32216_to_the_measured_torque_or_below(
    celsius: float, speed: float
) -> None:
    starved = torque(replace(combined(celsius), supply="fresh"), speed)
    measured = MEASURED_32216[celsius, speed]
    below = (1.0 - COMBINED_TOLERANCE) * measured
    assert starved < (1.0 + COMBINED_TOLERANCE) * measured
    assert (starved > below) is ("between" not in COMBINED_MISSES[celsius, speed])


@pytest.mark.parametrize(("supplied", "speed"), because(WARMER))
def test_oil_warmed_by_the_measured_torque_brings_the_32008_to_it(supplied: float, speed: float) -> None:
    measured = MEASURED_32008[supplied, speed]
    ours = torque(warmed(ghent(supplied), speed, measured), speed)
    assert ours == pytest.approx(measured, rel=GHENT_TOLERANCE)


@pytest.mark.parametrize(("supplied", "speed"), because(RIB_FILM))
def test_film_friction_of_the_source_at_the_ribs_brings_the_32008_to_the_measured_torque(
    supplied: float, speed: float
) -> None:
    ours = torque(replace(ghent(supplied), rib_film_friction=0.002), speed)
    assert ours == pytest.approx(MEASURED_32008[supplied, speed], rel=GHENT_TOLERANCE)


def test_higher_ribs_serve_the_32008_at_200_rpm_and_not_at_400() -> None:
    rig = ghent(65.0)
    higher = replace(rig, bearing=replace(rig.bearing, rib_contact_height=1.3e-3, rib_height=2.6e-3))
    off = {speed: torque(higher, speed) / MEASURED_32008[65.0, speed] - 1.0 for speed in (200.0, 400.0)}
    assert abs(off[200.0]) < GHENT_TOLERANCE < off[400.0]


@pytest.mark.slow
def test_a_rigid_cup_little_axial_force_and_the_cold_play_together_load_as_many_rollers_as_measured() -> None:
    assert counts(0.0, 3.0, True, COLD_PLAY) == (5.0, 5.0)
    assert counts(40.0, 3.0, True, COLD_PLAY) == (7.0, 5.0)
    for alone in ({"axial": 3.0}, {"rigid": True}, {"end_play": COLD_PLAY}):
        assert max(counts(0.0, **alone)) > 6.0


@pytest.mark.parametrize(
    "state",
    fast_ones(
        [State("summer", thermal=(("ambient", SUMMER),)), State("small box", thermal=(("box_area", 0.4),))], 0
    ),
    ids=lambda state: state.name,
)
def test_summer_or_a_smaller_box_warms_the_grease_to_what_is_reported(state: State) -> None:
    assert grease_celsius(320.0, state) == pytest.approx(100.0, abs=SERVICE_TOLERANCE)


SHELTERED = (("air_speed", 0.1),)
IN_TRAIN = {
    ("first place", 200.0): State("sheltered", thermal=SHELTERED),
    ("first place", 300.0): HEALTHY,
    ("second place", 200.0): State("sheltered, seals of 0.6 N m", seal_torque=0.6, thermal=SHELTERED),
    ("second place", 300.0): State("seals of 1.2 N m", seal_torque=1.2),
}


@pytest.mark.parametrize(("place", "speed", "air", "coolest", "warmest"), fast_ones(FLEET, 0))
def test_surroundings_and_seals_bring_boxes_into_the_span_of_the_train_at_one_speed(
    place: str, speed: float, air: float, coolest: float, warmest: float
) -> None:
    assert coolest <= in_train(speed, air, IN_TRAIN[place, speed]) <= warmest


def test_rougher_rails_take_the_level_on_a_chinese_line_out_of_the_measured_one() -> None:
    frequency, up, _ = wheelset.spectra(300, line="china_ballastless", roughness="average_network")
    rough = float(up[(frequency >= 10.0) & (frequency < 500.0)].sum()) ** 0.5
    assert rough > (1.0 + wheelset.CHINA_TOLERANCE) * 8.8


def test_a_sensor_is_moved_sideways_by_the_end_of_the_axle_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """In the rail model, whose level with a sensor at its height is 10 m/s^2."""
    usual = wheelset.level(300, True)
    monkeypatch.setitem(wheelset.RUNS, 0, wheelset.RUNS[300])
    monkeypatch.setattr(wheelset, "SENSOR_HEIGHT", 0.0)
    assert wheelset.level(0, True) < 0.05 * usual


def test_a_force_along_the_axle_tells_the_rows_apart() -> None:
    loaded, largest = wheel_waves.pushed_along()
    assert wheel_waves.differ(loaded)
    assert wheel_waves.differ(largest)


@pytest.mark.slow
def test_high_waves_turn_the_mean_of_the_roller_loads_of_one_row() -> None:
    assert [turns(row) for row in wheel_waves.mean_loads(wheel_waves.HIGHER)] == [False, True]


@pytest.mark.slow
def test_short_waves_cover_the_strikes_of_a_sound_bearing_at_low_speed() -> None:
    assert sound_ringing(90.0, 1e-3) > 6.0
    assert sound_ringing(90.0) == pytest.approx(3.1, abs=0.3)


@pytest.mark.slow
def test_a_small_fault_of_smooth_raceways_stands_out_as_on_the_motor() -> None:
    least, most = FAULTS_OF_CWRU[7]
    assert ratio(7) < least < ratio(7, waves=False) < most


@pytest.mark.slow
def test_a_spall_on_whose_floor_rollers_rest_is_hardly_louder_under_more_load() -> None:
    """What was measured, 0.07 to 0.28, lies between floors of 2.5 and 5 um."""
    assert ours_over_load() > 0.6
    assert ours_over_load(2.5e-6) < 0.07 < 0.28 < ours_over_load(SHALLOW) < 0.35
