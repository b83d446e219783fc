"""Edges of the rib face, rim of the roller end, film, drilling and small rib against slow references."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from beardyn_core.bearing.contact_law import rib_contact
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet, Rib, RibMixedFilm, RibShearedFilm, SmallRib
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.rib import RibParams
from beardyn_core.physics.small_rib import SmallRibParams
from test.kernels import naive, naive_rib
from test.kernels.casting import through
from test.kernels.entries import rib_gaps, ribs, small_ribs
from test.kernels.rig import parameters_of
from test.kernels.states import packed, random_motion
from test.scenes import scene_with, standard_scene, tapered

Float = NDArray[np.float64]
LANES8 = Lanes(8)
SPHERE = Rib(roller_end=False)
BEARING = tapered(standard_scene())


@cache
def rib_of(rib: Rib) -> RibParams:
    scene = scene_with(replace(EffectSet(), rib=rib))
    found = parameters_of(scene).effects.rib
    assert found is not None
    return found


@cache
def rib_beyond_the_apex() -> RibParams:
    """Take a sphere flatter than the rib around the ring: its rim touches on both sides."""
    scene = scene_with(replace(EffectSet(), rib=Rib(friction=0.0)))
    bearing = replace(tapered(scene), forced=True, sphere_ratio=1.02)
    found = parameters_of(replace(scene, bearing=bearing)).effects.rib
    assert found is not None
    return found


@cache
def small_rib(**options: Any) -> SmallRibParams:
    scene = scene_with(replace(EffectSet(), small_rib=SmallRib(**options)))
    found = parameters_of(scene).effects.small_rib
    assert found is not None
    return found


def placed(tilt: float, skew: float, shift: float, azimuth: float = 0.4) -> naive.Motion:
    """A roller at rest, tilted (moves the contact over the face) and skewed (over the roller end)."""
    angle = BEARING.contact_angle + tilt
    axis = np.array(
        [math.sin(angle) * math.cos(skew), math.cos(angle) * math.sin(skew), math.cos(angle) * math.cos(skew)]
    )
    axis /= np.linalg.norm(axis)
    offset = BEARING.roller_mass_offset
    nominal = np.array([math.sin(BEARING.contact_angle), 0.0, math.cos(BEARING.contact_angle)])
    centre = offset * nominal + np.array(
        [0.5 * BEARING.pitch_diameter, 0.0, 0.5 * BEARING.row_spacing + shift]
    )
    c, s = math.cos(azimuth), math.sin(azimuth)
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    ring_axis = np.array([2e-4, -1e-4, 1.0])
    ring_axis /= np.linalg.norm(ring_axis)
    zero = np.zeros(3)
    return naive.Motion(turn @ centre, turn @ axis, zero, zero, ring_axis, zero, zero)


def gaps(cases: list[naive.Motion], rib: RibParams, lanes: Any = LANES8) -> Float:
    return through(lanes, rib_gaps, np.array([packed(m) for m in cases]), 7, rib)


def results(cases: list[naive.Motion], rib: RibParams, orbit: float = 0.0, lanes: Any = LANES8) -> Float:
    return through(lanes, ribs, np.array([packed(m, orbit) for m in cases]), 8, rib, None)


# --- window


@settings(deadline=None, max_examples=40)
@given(
    tilt=st.floats(-0.015, 0.015),
    skew=st.floats(-5e-3, 5e-3),
    shift=st.floats(-3e-4, 3e-4),
    azimuth=st.floats(-3.0, 3.0),
)
def test_depth_in_the_rounded_face_is_that_of_a_search(
    tilt: float, skew: float, shift: float, azimuth: float
) -> None:
    """Distance to a truncated cone with rounded edges by minimisation over its face; 1e-9 m."""
    rib = rib_of(SPHERE)
    motion = placed(tilt, skew, shift, azimuth)
    found = gaps([motion], rib)[0]
    depth, point = naive_rib.depth_by_search(motion.centre, motion.axis, motion.ring_axis, rib)
    assert found[0] == pytest.approx(depth, abs=1e-9)
    towards = point - motion.centre - rib.sphere_place * motion.axis
    # the search finds the place to the root of its tolerance
    assert found[1:4] == pytest.approx(towards / np.linalg.norm(towards), abs=2e-5)


def test_face_edge_and_undercut_are_all_met() -> None:
    """The placements of the search reach both edges: tilt moves the contact 0.48 mm a mrad."""
    rib = rib_of(SPHERE)
    lean = np.array([rib.normal_axial, rib.normal_radial])
    slopes = []
    for tilt in (-0.012, 0.0, 0.012):
        found = gaps([replace(placed(tilt, 0.0, 0.0, 0.0), ring_axis=np.array([0.0, 0.0, 1.0]))], rib)[0]
        normal = np.array([found[3], found[1]])
        slopes.append(float(normal[1] * lean[0] - normal[0] * lean[1]))
    assert abs(slopes[1]) < 1e-15
    assert max(slopes) > 2e-3
    assert min(slopes) < -2e-3


def test_inside_the_window_the_edges_change_nothing(lanes: Any) -> None:
    """The default is the unlimited cone of before where the contact is on the face: 1e-12."""
    rng = np.random.default_rng(3)
    cases = [
        placed(rng.uniform(-2e-3, 2e-3), rng.uniform(-2e-3, 2e-3), 2e-5, rng.uniform(-3, 3))
        for _ in range(40)
    ]
    with_ = gaps(cases, rib_of(SPHERE), lanes)
    without = gaps(cases, rib_of(replace(SPHERE, window=False)), lanes)
    np.testing.assert_allclose(with_[:, 0], without[:, 0], rtol=0.0, atol=1e-17)
    np.testing.assert_allclose(with_[:, 1:], without[:, 1:], rtol=1e-12, atol=1e-15)


@pytest.mark.parametrize(
    ("rib", "reach"),
    [(rib_of(Rib(roller_end=False, friction=0.0)), 6e-3), (rib_of(Rib(friction=0.0)), 6e-3),
     (rib_beyond_the_apex(), 4e-4)],
    ids=["sphere", "rim", "two points of the rim"],
)  # fmt: skip
def test_elastic_force_and_moment_are_the_gradient_of_the_energy(rib: RibParams, reach: float) -> None:
    """On the face, over both edges and on the rim, also across the borders: nothing is gained by moving."""
    rng = np.random.default_rng(5)
    cases = []
    for _ in range(60):
        motion = placed(rng.uniform(-reach, reach), 0.5 * rng.uniform(-reach, reach), 0.0, 0.0)
        depth = gaps([motion], rib)[0, 0]
        cases.append(replace(motion, centre=motion.centre + (2e-5 - depth) * motion.axis))
    found = results(cases, rib)
    load = np.linalg.norm(found[:, :3], axis=1)
    assert load.min() > 1e3
    step = 1e-8
    for i in range(3):
        unit = np.eye(3)[i]
        ahead = results([replace(m, centre=m.centre + step * unit) for m in cases], rib)[:, 6]
        behind = results([replace(m, centre=m.centre - step * unit) for m in cases], rib)[:, 6]
        assert np.all(np.abs(-(ahead - behind) / (2 * step) - found[:, i]) <= 1e-4 * load)
        small = 1e-7
        turned = [replace(m, axis=m.axis + small * np.cross(unit, m.axis)) for m in cases]
        ahead = results(turned, rib)[:, 6]
        turned = [replace(m, axis=m.axis - small * np.cross(unit, m.axis)) for m in cases]
        behind = results(turned, rib)[:, 6]
        # lever of the contact 30 mm
        assert np.all(np.abs(-(ahead - behind) / (2 * small) - found[:, 3 + i]) <= 1e-4 * load * 0.03)


# --- rim of the roller end


def test_beyond_the_rim_the_deepest_point_of_the_rim_carries(lanes: Any) -> None:
    """Search over the rim circle; skew of 2 mrad and more takes the contact off the sphere."""
    rib = rib_of(Rib(roller_end=True, window=False))
    rng = np.random.default_rng(7)
    cases = [
        placed(rng.uniform(-1e-3, 1e-3), rng.choice([-1, 1]) * rng.uniform(2.5e-3, 8e-3), 0.0, 0.3)
        for _ in range(40)
    ]
    found = gaps(cases, rib, lanes)
    for motion, row in zip(cases, found, strict=True):
        depth, point = naive_rib.rim_depth_by_search(motion.centre, motion.axis, motion.ring_axis, rib)
        assert row[0] == pytest.approx(depth, abs=1e-9)
        assert row[4:7] == pytest.approx(point - motion.centre, abs=2e-5)
        from_axis = np.linalg.norm(np.cross(row[4:7], motion.axis))
        assert from_axis == pytest.approx(rib.end.radius, rel=1e-9)  # type: ignore[union-attr]


def test_a_sphere_beyond_the_apex_bears_on_both_sides_of_its_rim(lanes: Any) -> None:
    """Upright both points are pressed alike, and what turns the roller about its radius cancels."""
    rib = rib_beyond_the_apex()
    motion = replace(placed(0.0, 0.0, 0.0, 0.0), ring_axis=np.array([0.0, 0.0, 1.0]))
    depth, point = naive_rib.rim_depth_by_search(motion.centre, motion.axis, motion.ring_axis, rib)
    upright = replace(motion, centre=motion.centre + (5e-6 - depth) * motion.axis)
    depth, point = naive_rib.rim_depth_by_search(upright.centre, upright.axis, upright.ring_axis, rib)
    assert abs(point[1]) > 5e-3
    found = results([upright], rib, lanes=lanes)[0]
    assert found[6] == pytest.approx(2.0 * 0.4 * rib.stiffness * depth**2.5, rel=1e-6)
    load = np.linalg.norm(found[:3])
    assert load == pytest.approx(2.0 * rib.stiffness * depth**1.5, rel=1e-3)
    assert abs(found[1]) < 1e-9 * load
    assert abs(found[3]) < 1e-9 * load * abs(point[1])


def test_inside_the_rim_the_rim_changes_nothing() -> None:
    cases = [placed(tilt, 5e-4, 2e-5) for tilt in np.linspace(-1e-3, 1e-3, 9)]
    with_rim, without = (gaps(cases, rib_of(rib)) for rib in (Rib(roller_end=True), SPHERE))
    np.testing.assert_allclose(with_rim, without, rtol=1e-13)  # two programs round differently


def test_depth_is_continuous_where_the_sphere_hands_over_to_the_rim() -> None:
    cases = [placed(0.0, skew, 0.0) for skew in np.linspace(0.0, 6e-3, 1201)]
    depth = gaps(cases, rib_of(Rib(roller_end=True)))[:, 0]
    assert np.abs(np.diff(depth, 2)).max() < 2e-9


# --- friction, film, drilling


def moving_cases(count: int, seed: int) -> list[naive.Motion]:
    rng = np.random.default_rng(seed)
    cases = []
    for _ in range(count):
        motion = random_motion(standard_scene(), rng, tilt=3e-4)
        motion = replace(motion, ring_omega=122.0 * motion.ring_axis)
        cases.append(replace(motion, centre=motion.centre + np.array([0.0, 0.0, 2e-5])))
    return cases


@pytest.mark.parametrize("lubrication", [RibMixedFilm(0.6, 0.12, 0.008), RibShearedFilm(0.6, 0.12, 0.04)])
@pytest.mark.parametrize("drilling", [False, True], ids=["sliding", "spinning"])
def test_lubricated_wrench_is_the_plain_formula(lubrication: Any, drilling: bool, lanes: Any) -> None:
    """Film, load sharing, friction and spin written out; roughness 0.418 um taken 20 times to mix."""
    scene = scene_with(replace(EffectSet(), rib=Rib(lubrication=lubrication, drilling=drilling)))
    assert isinstance(scene.bearing, Bearing)
    scene = replace(scene, bearing=replace(scene.bearing, rib_roughness=8e-6))
    rib = parameters_of(scene).effects.rib
    assert rib is not None
    contact = rib_contact(tapered(scene))
    oil = (
        scene.lubricant.dynamic_viscosity(scene.temperature),
        scene.lubricant.pressure_viscosity_at(scene.temperature),
    )
    cases, orbit = moving_cases(24, 11), 52.0
    found, places = results(cases, rib, orbit, lanes), gaps(cases, rib, lanes)
    touching = 0
    for motion, row, place in zip(cases, found, places, strict=True):
        depth, normal, arm = place[0], place[1:4], place[4:7]
        if depth <= 0.0:
            assert not row.any()
            continue
        touching += 1
        load = rib.stiffness * depth**1.5
        larger, smaller = contact.semi_axes(load)
        speed = naive_rib.entrainment(motion, motion.centre + arm, orbit)
        # the kernel's floor of the entrainment speed is 1 mm/s
        film = naive_rib.film_thickness(load, abs(speed) + 1e-3, contact, oil, 0.6)
        share = 1.0 - math.exp(-1.8 * (film / 8e-6) ** 1.2)
        assert 0.05 < share < 0.9

        def friction(
            load: float, slip: float, film: float = film, share: float = share, size: Any = (larger, smaller)
        ) -> float:
            regular = slip / math.hypot(slip, rib.regularisation)
            if isinstance(lubrication, RibMixedFilm):
                return load * regular * (share * 0.008 + (1.0 - share) * 0.12)
            pressure = load / (math.pi * size[0] * size[1])
            newton = oil[0] * math.exp(oil[1] * pressure) * slip / film
            wet = newton * 0.04 * pressure / math.hypot(newton, 0.04 * pressure) * load / pressure
            return load * regular * (1.0 - share) * 0.12 + share * wet

        reach = math.sqrt(0.18) * larger if drilling else 0.0
        expected = naive_rib.wrench(motion, depth, normal, arm, rib, friction, reach)
        size = np.linalg.norm(expected.force)
        assert np.linalg.norm(row[:3] - expected.force) <= 1e-7 * size
        assert np.linalg.norm(row[3:6] - expected.moment) <= 1e-7 * size * 0.05
        assert row[7] == pytest.approx(film, rel=1e-8)
    assert touching > 12


def test_entrainment_of_a_rolling_roller_is_that_of_the_contact_fixed_frame() -> None:
    """About 5 m/s at 122 rad/s, not the half sum in the axlebox frame (9 m/s) nor the sliding (1.9 m/s)."""
    from beardyn_core.bearing.kinematics import cage_speed, roller_cone_spin, roller_spin

    orbit, spin = cage_speed(BEARING, 122.0), roller_spin(BEARING, 122.0)
    motion = replace(placed(0.0, 0.0, 1e-5, 0.0), ring_axis=np.array([0.0, 0.0, 1.0]))
    motion = replace(
        motion,
        velocity=np.array([0.0, orbit * motion.centre[0], 0.0]),
        omega=np.array([0.0, 0.0, orbit]) - spin * motion.axis,
        ring_omega=np.array([0.0, 0.0, 122.0]),
    )
    rib = rib_of(SPHERE)
    arm = gaps([motion], rib)[0, 4:7]
    slip = np.linalg.norm(motion.slip(motion.centre + arm))
    assert slip == pytest.approx(roller_cone_spin(BEARING, 122.0) * BEARING.rib_contact_height, rel=0.01)
    radius = float(np.hypot(*(motion.centre + arm)[:2]))
    expected = (122.0 - orbit) * radius - 0.5 * slip
    assert naive_rib.entrainment(motion, motion.centre + arm, orbit) == pytest.approx(expected, rel=1e-3)


def test_spin_dissipates_as_the_friction_torque_of_the_rib() -> None:
    """Zhao et al. 2026: T = mu Q h sqrt(1 + 0.18 (a/h)^2) about the common generator."""
    rib = rib_of(Rib(drilling=True, regularisation_speed=1e-6))
    cases = moving_cases(24, 13)
    found, places = results(cases, rib), gaps(cases, rib)
    for motion, row, place in zip(cases, found, places, strict=True):
        if place[0] <= 0.0:
            continue
        load = rib.stiffness * place[0] ** 1.5
        arm = place[4:7]
        slip = motion.slip(motion.centre + arm)
        relative = motion.omega - motion.ring_omega
        normal = place[1:4]
        sliding = slip - (slip @ normal) * normal
        power = -(row[:3] + load * normal) @ sliding - (row[3:6] - np.cross(arm, row[:3])) @ relative
        half_axis = rib_contact(BEARING).semi_axes(load)[0]
        spin = float(relative @ normal)
        height = float(np.linalg.norm(sliding)) / abs(spin)
        expected = 0.05 * load * height * math.sqrt(1.0 + 0.18 * (half_axis / height) ** 2) * abs(spin)
        assert power == pytest.approx(expected, rel=1e-6)


# --- small rib


def small_results(cases: list[naive.Motion], rib: SmallRibParams, lanes: Any = LANES8) -> Float:
    return through(lanes, small_ribs, np.array([packed(m) for m in cases]), 7, rib)


def test_small_rib_is_as_deep_as_the_furthest_point_of_its_circle(lanes: Any) -> None:
    """The circle behind the plane of the roller end, by sampling; the roller is moved to the small rib."""
    rib = small_rib()
    rng = np.random.default_rng(17)
    pressed = 0
    for _ in range(30):
        motion = placed(rng.uniform(-2e-3, 2e-3), rng.uniform(-2e-3, 2e-3), -rng.uniform(3.5e-4, 5e-4))
        found = small_results([motion], rib, lanes)[0]
        radial, around = naive_rib._frame(motion.ring_axis, motion.centre)
        angles = np.linspace(-0.2, 0.2, 20001)[:, None]
        circle = rib.place * motion.ring_axis + rib.radius * (
            np.cos(angles) * radial + np.sin(angles) * around
        )
        depth = float(((circle - motion.centre) @ motion.axis).max()) - rib.end_place
        pressed += int(depth > 1e-6)
        energy = 0.5 * rib.stiffness * max(depth, 0.0) ** 2
        assert found[6] == pytest.approx(energy, rel=1e-3, abs=1e-7)
    assert 5 < pressed < 30


def test_small_rib_stands_off_by_its_clearance() -> None:
    """Along the roller axis from where the roller just touches the large rib."""
    rib = small_rib()
    straight = replace(placed(0.0, 0.0, 0.0, 0.0), ring_axis=np.array([0.0, 0.0, 1.0]))
    for travel, pressed in ((0.399e-3, False), (0.401e-3, True)):
        moved = replace(straight, centre=straight.centre - travel * straight.axis)
        found = small_results([moved], rib)[0]
        assert (found[6] > 0.0) == pressed
        if pressed:
            assert found[:3] == pytest.approx(rib.stiffness * 1e-6 * straight.axis, rel=1e-3)


def test_small_rib_force_is_the_gradient_of_its_energy() -> None:
    rib = small_rib(friction=0.0)
    rng = np.random.default_rng(19)
    cases = [placed(rng.uniform(-1e-3, 1e-3), rng.uniform(-1e-3, 1e-3), -5e-4) for _ in range(16)]
    found = small_results(cases, rib)
    load = np.linalg.norm(found[:, :3], axis=1)
    assert load.min() > 100.0
    for i in range(3):
        unit = np.eye(3)[i]
        ahead, behind = (
            small_results([replace(m, centre=m.centre + d * unit) for m in cases], rib)[:, 6]
            for d in (1e-8, -1e-8)
        )
        assert np.all(np.abs(-(ahead - behind) / 2e-8 - found[:, i]) <= 1e-5 * load)
        ahead, behind = (
            small_results([replace(m, axis=m.axis + d * np.cross(unit, m.axis)) for m in cases], rib)[:, 6]
            for d in (1e-7, -1e-7)
        )
        assert np.all(np.abs(-(ahead - behind) / 2e-7 - found[:, 3 + i]) <= 1e-4 * load * 0.03)
