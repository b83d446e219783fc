"""Questions that need no run, three lines each, and the same answers as of the functions below them."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.config import load_lubricant
from beardyn_core.effects import Rib, RibMixedFilm, RingStructure
from beardyn_core.physics.modal_body import rings
from beardyn_core.physics.rib import rib_params
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.statics.torque import rib_torque

BEARING = "HS130x230"


def test_stiffness_grows_with_preload() -> None:
    found = bd.stiffness(BEARING, 20, end_play_mm=[-0.1, 0.0, 0.1])
    assert found.shape == (3, 3, 3)
    vertical = found[:, 2, 2]
    assert vertical[0] > vertical[1] > vertical[2] > 0.0
    single = bd.stiffness(BEARING, 20, end_play_mm=0.1)
    np.testing.assert_array_equal(single, found[2])
    bearing = bd.bearing(BEARING)
    direct = solve(bearing, (0.0, 0.0, 2e4), end_play=1e-4, body=rings(bearing, RingStructure(), 2))
    np.testing.assert_allclose(single, direct.stiffness_tilt_held, rtol=1e-9)
    free = bd.stiffness(BEARING, 20, end_play_mm=0.1, tilt="free")
    np.testing.assert_allclose(free, direct.stiffness_tilt_free, rtol=1e-6, atol=1.0)


def test_the_load_distribution_carries_the_load() -> None:
    loads = bd.load_distribution(BEARING, [0, 0, 80], end_play_mm=0.1)
    assert loads.shape == (2, 17)
    bearing = bd.bearing(BEARING)
    azimuth = 2 * np.pi * np.arange(17) / 17
    radial = (loads * np.cos(azimuth)).sum() * np.cos(bearing.cup_angle)
    assert radial == pytest.approx(80e3, rel=1e-3)
    np.testing.assert_array_equal(loads, bd.equilibrium(BEARING, 80, end_play_mm=0.1).cup_load)


def test_rings_bend_unless_they_are_said_to_be_rigid() -> None:
    elastic, rigid = bd.equilibrium(BEARING, 80), bd.equilibrium(BEARING, 80, rings="rigid")
    assert rigid.largest_roller_load == solve(bd.bearing(BEARING), (0, 0, 8e4), end_play=2e-4).cup_load.max()
    assert elastic.largest_roller_load < 0.8 * rigid.largest_roller_load
    assert sum(elastic.loaded_roller_count) > sum(rigid.loaded_roller_count)
    for answer in (bd.load_distribution, bd.stiffness):
        assert not np.allclose(answer(BEARING, 80), answer(BEARING, 80, rings="rigid"), rtol=0.05)
    with pytest.raises(bd.InputError, match="rings is 'soft'; allowed are elastic, rigid"):
        bd.equilibrium(BEARING, 80, rings="soft")  # type: ignore[arg-type]


@pytest.mark.parametrize("how", ["elastic", "rigid"])
def test_stiffness_is_the_slope_of_the_load_however_the_rings_are(how: Literal["elastic", "rigid"]) -> None:
    less, more = (bd.equilibrium(BEARING, load, rings=how).displacement[2] for load in (79.9, 80.1))
    slope = bd.stiffness(BEARING, 80, rings=how)
    assert 200.0 / (more - less) == pytest.approx(1.0 / np.linalg.inv(slope)[2, 2], rel=2e-3)


def test_lives_are_of_the_standard_with_rigid_rings_and_say_so() -> None:
    standard, bending = bd.life(BEARING, 80), bd.life(BEARING, 80, rings="elastic")
    assert (standard.rings, bending.rings) == ("rigid", "elastic")
    assert standard.basic == bending.basic
    assert bending.reference_basic > 1.2 * standard.reference_basic


def test_torque_rises_with_speed_and_load() -> None:
    found = bd.torque(BEARING, [200, 600, 1200])
    assert found.shape == (3,)
    # that of flooded raceways: ribs rub less with a film, and settled grease starves fast ones
    assert (np.diff(bd.torque(BEARING, [200, 600, 1200], rib_friction=0.0, supply="flooded")) > 0.0).all()
    assert bd.torque(BEARING, 600, 120) > found[1] == bd.torque(bd.bearing(BEARING), 600)
    assert bd.torque(BEARING, 600, rib_friction=0.0) < found[1]


@pytest.mark.parametrize("rpm", [60.0, 1165.0])
def test_ribs_rub_as_film_and_asperities_share_the_load(rpm: float) -> None:
    """As in a scene with the effects `full`, but for the corner of dry friction, which only steps need."""
    bearing, oil, speed = bd.bearing(BEARING), load_lubricant("L055"), rpm * np.pi / 30.0
    rib = Rib(lubrication=RibMixedFilm(), drilling=True, regularisation_speed=1e-6)
    law = rib_params(bearing, rib, oil, 343.15)
    expected = rib_torque(bearing, bd.equilibrium(bearing, speed_rpm=rpm), speed, law)
    found = bd.torque(bearing, rpm) - bd.torque(bearing, rpm, rib_friction=0.0)
    assert found == pytest.approx(expected, rel=1e-9)


def test_less_oil_is_less_torque_and_less_film() -> None:
    supplies = ("channelled", "settled", "fresh", "flooded")
    assert (np.diff([bd.torque(BEARING, 1165, supply=supply) for supply in supplies]) > 0.0).all()
    assert (
        np.diff([np.nanmin(bd.film(BEARING, 1165, supply=supply)["cup"]) for supply in supplies]) > 0.0
    ).all()
    assert np.isfinite(bd.torque(BEARING, 0.0))
    with pytest.raises(
        bd.InputError, match="supply is 'wet'; allowed are flooded, fresh, settled, channelled"
    ):
        bd.torque(BEARING, 1165, supply="wet")


def test_life_falls_with_load_by_the_exponent_of_the_standard() -> None:
    light, heavy = bd.life(BEARING, 40), bd.life(BEARING, 80)
    assert light.basic / heavy.basic == pytest.approx(2.0 ** (10 / 3))
    assert heavy.modified < bd.life(BEARING, 80, contamination=1.0).modified
    with pytest.raises(bd.InputError, match="shaft that turns"):
        bd.life(BEARING, 80, 0.0)
    with pytest.raises(bd.InputError, match="contamination is 7; it must be from 0 to 1"):
        bd.life(BEARING, 80, contamination=7)


def test_loads_that_cannot_be_meant_are_refused_or_warned_of_as_on_the_command_line() -> None:
    with pytest.raises(bd.InputError, match=r"load_kN: .* times the static load rating .* check the unit"):
        bd.stiffness(BEARING, 80_000)
    with pytest.warns(UserWarning, match="load_kN: the force is 80 N, less than a thousandth"):
        bd.load_distribution(BEARING, 0.08)
    for wrong in ("80", [1, 2], ["a", "b", "c"], None):
        with pytest.raises(bd.InputError, match=r"load_kN is .*; give one number, upwards, or three"):
            bd.load_distribution(BEARING, wrong)  # type: ignore[arg-type]
    with pytest.raises(bd.InputError, match="end_play_mm is 'x'; give a number"):
        bd.stiffness(BEARING, end_play_mm=["x"])  # type: ignore[list-item]


def test_numbers_of_numpy_are_numbers() -> None:
    eight: list[Any] = [np.int64(8), np.float32(8.0), np.array([0, 0, 8])]
    for load in eight:
        np.testing.assert_array_equal(bd.load_distribution(BEARING, load), bd.load_distribution(BEARING, 8))
    speed: Any = np.int64(600)
    assert bd.torque(BEARING, speed) == bd.torque(BEARING, 600)
    plays: Any = np.array([0.0, 0.1])
    found = bd.stiffness(BEARING, end_play_mm=plays)
    np.testing.assert_array_equal(found[1], bd.stiffness(BEARING, end_play_mm=0.1))


def test_film_grows_with_speed_and_is_thinner_when_hot() -> None:
    slow, fast, hot = (
        bd.film(BEARING, rpm, temperature_C=celsius) for rpm, celsius in ((300, 70), (1200, 70), (300, 100))
    )
    loaded = np.isfinite(slow["cone"])
    assert loaded.any()
    assert (fast["cone"][loaded] > slow["cone"][loaded]).all()
    assert (hot["cone"][loaded] < slow["cone"][loaded]).all()
    assert 1e-8 < np.nanmin(slow["cone"]) < np.nanmin(slow["cup"]) < 1e-5


def test_fault_frequencies_are_per_revolution_or_in_hertz() -> None:
    per_rev, hertz = bd.fault_frequencies(BEARING), bd.fault_frequencies(BEARING, 600)
    assert set(per_rev) == {"FTF", "BPFO", "BPFI", "BSF"}
    assert per_rev["BPFO"] + per_rev["BPFI"] == pytest.approx(17.0)
    assert hertz["BPFO"] == pytest.approx(10.0 * per_rev["BPFO"])
    assert bd.bearing(BEARING).frequencies.bpfo == per_rev["BPFO"]


def test_questions_that_make_no_sense_are_refused() -> None:
    with pytest.raises(bd.InputError, match="give one number, upwards"):
        bd.stiffness(BEARING, [1, 2])
    with pytest.raises(bd.InputError, match="-60 to 200"):
        bd.film(BEARING, 100, temperature_C=343)
    with pytest.raises(bd.InputError, match="tilt"):
        bd.stiffness(BEARING, tilt="loose")  # type: ignore[arg-type]
