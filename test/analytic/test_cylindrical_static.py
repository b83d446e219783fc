"""Static load distribution of cylindrical axlebox bearings against independent solutions and closed forms."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import beardyn_core as bd
from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.any_bearing import AnyBearing
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.profile import Profile
from beardyn_core.bearing.rib_face import flat_rib_truncation
from beardyn_core.config import load_any_bearing
from beardyn_core.physics.statics.static import StaticSolution, solve
from evidence.validation.kind_solutions import standard_loads, thrust_by_small_motions
from test.bearings import CYLINDRICAL

LAMINAE = 30


def shipped(name: str = "WJ130x240") -> CylindricalBearing:
    bearing: AnyBearing = load_any_bearing(name)
    assert isinstance(bearing, CylindricalBearing)
    return bearing


def rest(bearing: CylindricalBearing, *force: float, tilt: str = "locked") -> StaticSolution:
    return solve(bearing, force, end_play=None, tilt=tilt, laminae=LAMINAE)


@pytest.mark.parametrize("name", CYLINDRICAL)
@pytest.mark.parametrize("radial", [20e3, 80e3, 200e3])
@pytest.mark.parametrize("clearance", [0.0, 0.08e-3, 0.18e-3])
def test_load_distribution_is_that_of_the_standard(name: str, radial: float, clearance: float) -> None:
    """ISO/TS 16281 (2008), cylindrical roller bearings, with its own constant, 4 % softer, and profile."""
    bearing = replace(shipped(name), radial_clearance=clearance, profile=Profile("iso_16281"))
    expected = standard_loads(bearing, radial)
    found = rest(bearing, 0.0, 0.0, radial).cup_load
    assert_allclose(found[0], found[1], rtol=1e-9)
    assert found.max() == pytest.approx(expected.max(), rel=0.02)
    assert_allclose(found[0], expected, atol=0.03 * expected.max())


def test_straight_rollers_without_clearance_have_the_largest_load_of_the_books() -> None:
    """Harris, Rolling Bearing Analysis: Q_max = 4.08 F / Z for line contact; Z is 17 here, not endless."""
    bearing = replace(shipped(), radial_clearance=0.0, profile=Profile())
    found = rest(bearing, 0.0, 0.0, 50e3).cup_load
    assert found.max() == pytest.approx(4.08 * 25e3 / bearing.roller_count, rel=5e-3)


def test_clearance_takes_rollers_out_of_the_load_zone() -> None:
    loose = [rest(replace(shipped(), radial_clearance=play), 0.0, 0.0, 80e3) for play in (0.0, 1e-4, 3e-4)]
    counts = [sum(each.loaded_roller_count) for each in loose]
    heaviest = [each.largest_roller_load for each in loose]
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > counts[-1]
    assert heaviest == sorted(heaviest)


@pytest.mark.parametrize("name", CYLINDRICAL)
@pytest.mark.parametrize("axial", [-20e3, -2e3, 2e3, 20e3])
def test_ribs_of_one_row_carry_the_axial_load(name: str, axial: float) -> None:
    """The cone's rib of the row that the axle moves away from pushes; the cup's other rib holds."""
    bearing = shipped(name)
    found = rest(bearing, 0.0, axial, 80e3)
    row = 0 if axial > 0 else 1
    along = math.cos(bearing.rib_opening)
    assert along * found.rib_load[row].sum() == pytest.approx(abs(axial), rel=1e-3)
    assert along * found.cup_rib_load[row].sum() == pytest.approx(abs(axial), rel=1e-3)
    assert found.rib_load[1 - row].sum() == 0.0
    assert found.displacement[1] * np.sign(axial) > 0.5 * bearing.end_play


def test_couple_of_the_ribs_is_that_of_the_raceways() -> None:
    """Each loaded roller: both rib forces pass through the centres of its end spheres."""
    bearing = shipped()
    found = rest(bearing, 0.0, 20e3, 80e3)
    place = ((np.arange(LAMINAE) + 0.5) / LAMINAE - 0.5) * bearing.effective_length
    couple = (found.cup_lamina_load[0] - found.cone_lamina_load[0]) @ place
    loaded = found.rib_load[0] > 1e3
    assert loaded.sum() >= 3
    tilt = np.abs(found.roller_tilt[0][loaded])
    apart = 2.0 * bearing.end_radius - bearing.roller_length
    lever = apart * np.sin(bearing.rib_opening - tilt)
    assert_allclose(np.abs(couple[loaded]), lever * found.rib_load[0][loaded], rtol=2e-3)


def test_thrust_of_ribs_is_that_of_small_motions() -> None:
    """One row under its radial load and thrust, against equations of its own; rib loads to 3 %."""
    bearing = shipped()
    found = rest(bearing, 0.0, 12e3, 80e3)
    radial = float(found.cone_load[0] @ np.cos(2.0 * math.pi * np.arange(17) / 17))
    start = float(found.displacement[2]), float(found.displacement[1])
    loads, ribs = thrust_by_small_motions(bearing, radial, float(found.rib_load[0].sum()), start)
    heavy = found.rib_load[0] > 0.1 * found.rib_load.max()
    assert_allclose(found.cone_load[0][heavy], loads[heavy], rtol=0.03)
    assert_allclose(found.rib_load[0][heavy], ribs[heavy], rtol=0.03)


def test_a_contact_beyond_its_rib_face_is_told_with_both_lengths() -> None:
    """Next to the cube root of Hertz: eight times the load is twice as long."""
    bearing = shipped()
    assert not flat_rib_truncation(bearing, 200.0)
    lengths = [
        [float(sentence.split(" reaches ")[1].split()[0]) for sentence in flat_rib_truncation(bearing, load)]
        for load in (1000.0, 8000.0)
    ]
    assert len(lengths[0]) == len(lengths[1]) == 2  # of the inner ring and of the outer ring
    assert_allclose(lengths[1], 2.0 * np.array(lengths[0]), rtol=0.01)
    assert all("ends 1.50 mm from its middle" in sentence for sentence in flat_rib_truncation(bearing, 1e3))


@pytest.mark.slow
@pytest.mark.parametrize("tilt", ["locked", "free"])
def test_stiffness_is_the_slope_of_load_over_displacement(tilt: str) -> None:
    bearing, step = shipped(), 50.0
    middle = rest(bearing, 0.0, 8e3, 80e3, tilt=tilt)
    stiffness = middle.stiffness_tilt_free if tilt == "free" else middle.stiffness_tilt_held
    slopes = np.zeros((3, 3))
    for axis in range(3):
        force = np.array([0.0, 8e3, 80e3])
        change = np.zeros(3)
        change[axis] = step
        ahead, behind = (rest(bearing, *(force + sign * change), tilt=tilt) for sign in (1.0, -1.0))
        slopes[:, axis] = (ahead.displacement - behind.displacement) / (2.0 * step)
    assert_allclose(slopes @ stiffness, np.eye(3), atol=0.02)


def test_axle_floats_by_its_end_play() -> None:
    found = rest(shipped(), 0.0, 1.0, 80e3)
    assert found.displacement[1] == pytest.approx(0.4e-3, rel=0.02)
    assert rest(shipped(), 0.0, 0.0, 80e3).displacement[1] == pytest.approx(0.0, abs=1e-9)


def test_thrust_that_tips_rollers_is_refused_with_one_lamina() -> None:
    """Ribs would carry all of it and the raceways nothing: no couple of the rollers is solved for."""
    for load in ((0.0, -10.0, 0.0), (0.0, 10.0, 24.0)):
        with pytest.raises(InputError, match=r"laminae is 1, .* tips"):
            bd.equilibrium("WJ130x240", load, laminae=1)
    assert bd.equilibrium("WJ130x240", (0.0, -10.0, 0.0), laminae=2).cup_load.sum() > 5e3
    assert bd.equilibrium("WJ130x240", (0.0, 10.0, 26.0), laminae=1).rib_load.sum() == pytest.approx(
        1e4, rel=1e-3
    )


def test_a_pair_without_ribs_of_the_inner_ring_carries_no_axial_load() -> None:
    floating = replace(shipped(), cone_ribs="none")
    with pytest.raises(InputError, match="carries no axial load"):
        rest(floating, 0.0, 1e3, 80e3)
    assert rest(floating, 0.0, 0.0, 80e3).largest_roller_load > 1e4


@pytest.mark.parametrize(
    "force",
    [
        (0.0, 60e3, 20e3),
        (0.0, 0.0, 100.0),
        (0.0, 500.0, 1e3),
        (0.0, 1e3, 500.0),
        (0.0, 30e3, 2e3),
        (50e3, -20e3, -90e3),
        (0.0, 5e3, 700e3),
    ],
)
@pytest.mark.parametrize("tilt", ["locked", "free"])
def test_hard_cases_converge(force: tuple[float, float, float], tilt: str) -> None:
    """Thrust beyond the radial load, light load, heavy load."""
    found = rest(shipped(), *force, tilt=tilt)
    carried = np.abs(found.residual) / np.linalg.norm(force)
    assert carried < 1e-6


def test_centrifugal_force_presses_every_roller_on_the_cup() -> None:
    bearing, speed = shipped(), 150.0
    found = solve(bearing, (0.0, 0.0, 80e3), end_play=None, laminae=LAMINAE, speed=speed)
    orbit = bearing.cage_ratio * speed
    light = bearing.roller_mass * orbit**2 * 0.5 * bearing.pitch_diameter
    assert found.cup_load.min() == pytest.approx(light, rel=1e-6)
    assert_allclose(found.cup_load - found.cone_load, light, rtol=1e-5)


def test_a_single_row_that_finds_no_rest_is_told_in_words_of_cylinders() -> None:
    """No cones that drive apart, no end play: ribs."""
    with pytest.raises(ValidityError) as refused:
        solve(shipped(), (0.0, -100.0, 0.0), end_play=None, rows=1, laminae=2)
    sentence = str(refused.value)
    assert "rib of" in sentence
    assert "cone_ribs" in sentence
    assert "own thrust" not in sentence
    assert "end play" not in sentence


@pytest.mark.parametrize(("cone_ribs", "way"), [("outer", 1.0), ("inner", -1.0)])
def test_a_single_row_carries_thrust_towards_its_rib(cone_ribs: str, way: float) -> None:
    bearing = replace(shipped(), cone_ribs=cone_ribs)
    found = solve(bearing, (0.0, 2e3 * way, 4e4), end_play=None, rows=1, laminae=20)
    assert found.rib_load.sum() == pytest.approx(2e3, rel=0.01)
    with pytest.raises(ValidityError, match="2000 N push the axle"):
        solve(bearing, (0.0, -2e3 * way, 4e4), end_play=None, rows=1, laminae=20)
