"""The springs over patches, and the gap of waviness, against plain geometry."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from beardyn_core.bearing.holed_line import lost_share
from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.defect import FaultParams
from beardyn_core.physics.lamina_table import contact_radii, surface_radius
from beardyn_core.physics.patch_path import edge_softness, reach_of, roller_path
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.scene.defect import WornPocket
from beardyn_core.scene.patch import PATCH_KINDS, Patch
from beardyn_core.scene.waviness import Waviness, band_amplitudes
from test.examples import fast_ones
from test.kernels import naive_patch
from test.kernels.casting import Float, through
from test.kernels.fault_entries import (
    patch_springs,
    seen_by_sound_rollers,
    wave_gaps,
    worn_pockets,
)
from test.kernels.pressed_roller import (
    ENERGY,
    ENERGY_SLOPE,
    FAR,
    LET_GO,
    NEAR,
    PENETRATION,
    STIFFNESS,
    pressed,
)
from test.kernels.rig import parameters_of
from test.scenes import scene_with, tapered

CUP_RADIUS = surface_radius(scene_with().bearing, "cup")
PLACES = ((np.arange(6) + 0.5) / 6 - 0.5) * scene_with().bearing.effective_length
RADII = naive_patch.rolling_radii(tapered(scene_with()), PLACES)
SPALL = Patch(on="cup", row=0, azimuth=0.3, width=6e-3, depth=1e-4, length=0.025)
FULL = replace(SPALL, length=0.05)


def faults_of(width: int, *patches: Patch, waviness: tuple[Waviness, ...] = ()) -> FaultParams:
    scene = scene_with(defects=patches, waviness=waviness)
    return parameters_of(scene, width).effects.faults


def springs(
    lanes: Any, azimuth: Any, *patches: Patch, spin: float = 0.0, depth: float = 0.0, block: int = 0
) -> Float:
    """Share, gap, slopes at a depth and softness of the damaged springs of row 0, shape [case, lamina, 5].

    Row 1 must be sound.

    Row 0 is in the first lanes; with one lane block 0 is a roller of row 0.
    """
    width = lanes.width
    azimuth = np.asarray(azimuth, dtype=float)
    cases = np.stack([azimuth, np.full_like(azimuth, spin), np.full_like(azimuth, depth)], axis=1)
    rows = np.repeat(cases, width, axis=0)
    faults = faults_of(width, *patches)
    surfaces, damage = (faults.cup, faults.roller), faults.cup_damage
    found = through(lanes, patch_springs, rows, 30, block, 6, surfaces, damage)
    found = found.reshape(len(azimuth), width, 6, 5)
    found[..., 4] /= 1.0 - found[..., 4]
    if width > 1:
        np.testing.assert_array_equal(found[:, width // 2 :, :, 1], 0.0)
        np.testing.assert_array_equal(found[:, width // 2 :, :, 0], 0.0)
    return found[:, 0]


@cache
def naive_path(patch: Patch, arcs: tuple[float, ...], radius: float) -> list[float]:
    """Searched point by point: once for all lanes."""
    return [
        naive_patch.path_of_roller(
            arc, 0.5 * patch.width, patch.depth, patch.kind, patch.rim_height, patch.rim_width, radius
        )
        for arc in arcs
    ]


def test_roller_sinks_into_a_spall_as_geometry_says(lanes: Any) -> None:
    """2 nm: chords of the path's 12 um cells."""
    azimuth = 0.3 + np.linspace(-0.06, 0.06, 401)
    found = springs(lanes, azimuth, FULL)[:, 2]
    exact = np.array([naive_patch.spall_sink((a - 0.3) * CUP_RADIUS, 3e-3, 1e-4, RADII[2]) for a in azimuth])
    beyond = np.abs(azimuth - 0.3) * CUP_RADIUS > 3.02e-3
    np.testing.assert_array_equal(found[beyond, 1], 0.0)
    away_from_kink = np.abs(exact - 1e-4) > 1e-6
    np.testing.assert_allclose(found[away_from_kink, 1], exact[away_from_kink], atol=2e-9)
    assert found[:, 1].max() == pytest.approx(1e-4, rel=1e-12)  # the floor: 338 um would be the bridged depth
    np.testing.assert_allclose(found[exact > 0.0, 0], 1.0, rtol=1e-9)


def test_contact_is_softer_near_the_edges_of_a_spall_and_as_a_sound_one_in_its_middle(lanes: Any) -> None:
    """Against the same law by a root search, to 1 % of the greatest.

    5 % where the floor or both edges take over: there it falls to nothing within three cells of 13 um.
    """
    bearing = tapered(scene_with())
    azimuth = 0.3 + np.linspace(-0.032, 0.032, 161)
    arcs = (azimuth - 0.3) * CUP_RADIUS
    for patch in (FULL, replace(FULL, width=1e-3)):
        found = springs(lanes, azimuth, patch)
        for lamina in (0, 5):
            radius = RADII[lamina]
            exact = np.array([naive_patch.edge_softness(arc, patch, radius, bearing) for arc in arcs])
            sinks = np.array(
                [naive_patch.spall_sink(arc, 0.5 * patch.width, patch.depth, radius) for arc in arcs]
            )
            tolerance = exact.max() * np.where(sinks > 0.9 * sinks.max(), 0.05, 0.01)
            assert exact.max() > 0.25
            assert np.all(np.abs(found[:, lamina, 4] - exact) < tolerance)
    np.testing.assert_array_equal(springs(lanes, azimuth, replace(FULL, kind="dent"))[..., 4], 0.0)


def test_softness_of_two_patches_adds_and_covers_a_lamina_as_their_gaps(lanes: Any) -> None:
    edge = 0.3 + 3e-3 / CUP_RADIUS
    roller = Patch(on="roller", row=0, azimuth=0.1, width=6e-3, depth=3e-5, length=0.05, roller=0)
    on_roller = 0.1 + 3.05e-3 / (0.5 * scene_with().bearing.roller_diameter)
    both = springs(lanes, [edge], FULL, roller, spin=on_roller)[0]
    alone = springs(lanes, [edge], FULL)[0] + springs(lanes, [0.0], roller, spin=on_roller)[0]
    assert alone[:, 4].min() > 0.1
    np.testing.assert_allclose(both[:, 0], 1.0, rtol=1e-9)
    np.testing.assert_allclose(both[:, 4], alone[:, 4], rtol=1e-9)
    # beyond the edge there is no gap, and the softness has the share of its own
    beyond = springs(lanes, [edge + 1e-4 / CUP_RADIUS], SPALL)[0]
    np.testing.assert_allclose(beyond[:, 0], springs(lanes, [0.3], SPALL)[0, :, 0], atol=1e-9)


def test_a_floor_that_rises_to_the_edge_bears_before_its_deepest_place() -> None:
    """Ten times softer than a sound contact it would be if the roller could sink to the middle's depth."""
    bearing, radius = scene_with().bearing, 9e-3
    patch = Patch(on="cone", row=0, azimuth=0.0, width=8e-3, depth=8e-5, length=0.05, kind="elliptic")
    size = (patch.width, patch.depth, 0.0)
    reach = reach_of(patch, size, radius, bearing)
    path = roller_path(patch, size, radius, reach)
    softness = edge_softness(patch, size, radius, reach, path, bearing)
    spall = replace(patch, kind="spall", width=6e-3)
    size = (spall.width, spall.depth, 0.0)
    reach = reach_of(spall, size, radius, bearing)
    sharp = edge_softness(spall, size, radius, reach, roller_path(spall, size, radius, reach), bearing)
    assert softness[0] == 0.0
    assert 0.5 * sharp.max() < softness.max() < 3.0 * sharp.max()


@pytest.mark.parametrize("rim", [(0.0, 0.0), (4e-6, 1e-3)])
@pytest.mark.parametrize("kind", fast_ones(PATCH_KINDS, 0, 1))
def test_path_of_every_kind_is_that_of_a_disc_rolled_over_the_surface(
    lanes: Any, kind: str, rim: tuple[float, float]
) -> None:
    """The highest of all touching points, searched point by point; 10 nm for the 12 um cells of both.

    Where the roller leaves the edge for the floor the path has a kink of slope 0.07 within one cell.
    """
    patch = replace(FULL, kind=kind, depth=3e-5, rim_height=rim[0], rim_width=rim[1])
    azimuth = 0.3 + np.linspace(-0.05, 0.05, 87)
    found = springs(lanes, azimuth, patch)
    for lamina in (0, 5):
        exact = naive_path(patch, tuple((azimuth[::2] - 0.3) * CUP_RADIUS), RADII[lamina])
        error = np.abs(found[::2, lamina, 1] - exact)
        assert error[np.abs(np.array(exact) - 3e-5) > 1e-6].max() < 1e-8
        assert error.max() < 0.25 * 0.07 * 15e-6
    assert found[..., 1].max() == pytest.approx(3e-5, rel=1e-3)
    assert found[..., 1].min() == pytest.approx(-rim[0], rel=0.02)


def test_slope_is_the_derivative_of_the_gap(lanes: Any) -> None:
    """At a depth the loss of firmness counts, too, by 9/19 of it."""
    azimuth = 0.3 + np.linspace(-0.029, 0.029, 38)
    step, depth = 1e-7, 1e-5
    for patch in (replace(FULL, kind="dent", depth=3e-5), FULL):
        found = springs(lanes, azimuth, patch, depth=depth)
        ahead, behind = springs(lanes, azimuth + step, patch), springs(lanes, azimuth - step, patch)
        difference = (ahead[..., 1] - behind[..., 1]) / (2.0 * step)
        lost = np.log1p(ahead[..., 4]) - np.log1p(behind[..., 4])
        difference += 9.0 / 19.0 * depth * lost / (2.0 * step)
        np.testing.assert_allclose(found[..., 2], difference, atol=2e-3 * np.abs(difference).max())
        np.testing.assert_array_equal(found[..., 3], 0.0)


def test_narrow_spall_is_limited_by_its_edges_and_wide_one_by_its_floor(lanes: Any) -> None:
    deep = replace(FULL, width=2e-3, depth=1e-3)
    radius = RADII[0]
    bridged, softness = springs(lanes, [0.3], deep)[0, 0, [1, 4]]
    assert softness == pytest.approx(0.0, abs=1e-12)
    assert bridged == pytest.approx(radius - math.sqrt(radius**2 - 1e-6), rel=1e-9)
    wide = replace(FULL, width=2e-2, depth=2e-5)
    assert springs(lanes, [0.3], wide)[0, 0, 1] == pytest.approx(2e-5)


def test_a_roller_of_one_spring_over_a_patch_carries_what_two_raceways_let_it(lanes: Any) -> None:
    """A rigid roller between a whole raceway and one with a patch: to 3.5 % of the load of a sound one.

    Under the patch is a share f of firmness s, with a gap of g over the approach. The twin takes the depth as
    linear, which costs most, 3.3 %, where all of the roller is half as firm.
    """
    grid = list(itertools.product((0.0, 0.16, 0.5, 1.0), (1.0, 0.5), (0.0, 0.2, 0.45, 0.8, 1.5)))
    approach = 2.4e-5
    cases = np.array([(approach, f, f * (1.0 - s), f * s * g * approach) for f, s, g in grid])
    found = through(lanes, seen_by_sound_rollers, np.repeat(cases, lanes.width, axis=0), 2)
    seen, slope = found.reshape(len(grid), lanes.width, 2)[:, 0].T

    def exact(approach: float, f: float, s: float, gap: float) -> float:
        def excess(e: float) -> float:
            over = f * s * max(e - gap, 0.0) ** (10.0 / 9.0)
            return (1.0 - f) * e ** (10.0 / 9.0) + over - (approach - e) ** (10.0 / 9.0)

        depth = brentq(excess, 0.0, approach)
        return (2.0 * (approach - depth)) ** (10.0 / 9.0)

    loads = np.array([exact(approach, f, s, g * approach) for f, s, g in grid]) / approach ** (10.0 / 9.0)
    np.testing.assert_allclose((seen / approach) ** (10.0 / 9.0), loads, atol=0.035)
    assert loads.min() < 0.01
    assert np.all((slope >= 0.0) & (slope <= 1.0))


def test_patch_takes_of_each_lamina_a_share_of_what_lies_in_it_and_keeps_the_mean_gap(lanes: Any) -> None:
    """One factor for all of a patch, 0.72 for a hole along half of the line (`test_spall_loss`)."""
    found = springs(lanes, [0.3], SPALL)[0]
    edges = (np.arange(7) / 6 - 0.5) * 0.05
    overlap = np.array(
        [max(0.0, min(b, 0.0125) - max(a, -0.0125)) / (b - a) for a, b in itertools.pairwise(edges)]
    )
    share = lost_by_a_hole(25e-3) / 0.5
    assert 0.7 < share < 0.75
    np.testing.assert_allclose(found[:, 0], share * overlap, rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(found[:, 0] * found[:, 1], 1e-4 * overlap, rtol=1e-9, atol=1e-15)


def lost_by_a_hole(length: float) -> float:
    """Share of the load that a hole in the middle takes, between the radii of cup and cone, [-]."""
    bearing = scene_with().bearing
    radius = 0.5 * sum(float(contact_radii(bearing, ring, 1)[0]) for ring in ("cup", "cone"))
    hole = (-0.5 * length, 0.5 * length)
    return lost_share([hole], bearing.effective_length, radius, bearing.material.contact_modulus)


def test_patches_of_cup_and_roller_add_and_overlap_keeps_the_mean_gap(lanes: Any) -> None:
    roller = Patch(on="roller", row=0, azimuth=0.1, width=6e-3, depth=3e-5, length=0.05, roller=0)
    both = springs(lanes, [0.3], FULL, roller, spin=0.1)[0]
    np.testing.assert_allclose(both[:, 0], 1.0, rtol=1e-9)
    np.testing.assert_allclose(both[:, 1], 1.3e-4, rtol=1e-9)
    half = springs(lanes, [0.3], SPALL, roller, spin=0.1)[0]
    alone = springs(lanes, [0.3], SPALL)[0]
    np.testing.assert_allclose(half[:, 0] * half[:, 1], alone[:, 0] * alone[:, 1] + 3e-5, rtol=1e-9)
    assert np.all(half[:, 0] <= 1.0)


def test_a_contact_feels_the_patches_of_its_own_ring_and_roller_only(lanes: Any) -> None:
    faults = faults_of(lanes.width, FULL)
    assert faults.cone is None
    assert faults.cone_damage is None
    other = Patch(on="roller", row=0, azimuth=0.0, width=6e-3, depth=3e-5, length=0.05, roller=9)
    np.testing.assert_array_equal(springs(lanes, [0.3], other), 0.0)
    block = 9 if lanes.width == 1 else 9 // (lanes.width // 2)
    lane = 9 % max(lanes.width // 2, 1)
    faults = faults_of(lanes.width, other)
    rows = np.zeros((lanes.width, 3))
    found = through(lanes, patch_springs, rows, 30, block, 6, (faults.cup, faults.roller), faults.cup_damage)
    np.testing.assert_array_equal(np.flatnonzero(found[:, 1]), [lane])


def test_patch_is_found_again_after_any_number_of_turns(lanes: Any) -> None:
    azimuth = 0.31 + 2.0 * np.pi * np.array([-1000.0, -1.0, 0.0, 1.0, 1000.0])
    found = springs(lanes, azimuth, FULL)[:, 2, 1]
    np.testing.assert_allclose(found, found[2], rtol=1e-8)
    assert found[2] > 0.0


def test_brinelling_is_one_groove_at_every_roller_pitch(lanes: Any) -> None:
    grooves = replace(FULL, kind="brinelling", width=1e-3, depth=5e-6)
    pitch = 2.0 * math.pi / 17
    found = springs(lanes, 0.3 + 2e-4 + pitch * np.arange(-9, 20), grooves)[:, 2, 1]
    np.testing.assert_allclose(found, found[0], rtol=1e-8)
    single = springs(lanes, [0.3 + 2e-4], replace(grooves, kind="elliptic"))[0, 2, 1]
    assert found[0] == pytest.approx(single, rel=1e-9)
    np.testing.assert_array_equal(springs(lanes, 0.3 + pitch * (np.arange(5) + 0.5), grooves), 0.0)


@pytest.mark.parametrize("kind", PATCH_KINDS)
def test_patch_of_no_depth_is_no_gap(lanes: Any, kind: str) -> None:
    flat = replace(FULL, depth=0.0, kind=kind)
    np.testing.assert_array_equal(springs(lanes, np.linspace(0.2, 0.4, 50), flat)[..., 1], 0.0)


def test_nan_azimuth_stays_in_the_gap_of_waves_and_reads_no_memory_beyond(lanes: Any) -> None:
    waves = faults_of(lanes.width, waviness=(Waviness("cup", 0, (5,), (1e-6,)),)).cup_waves
    azimuth = np.full((lanes.width, 1), np.nan)
    assert np.isnan(through(lanes, wave_gaps, azimuth, 2, 0, waves)[:, 0]).all()


@pytest.mark.parametrize("on", ["cup", "roller"])
def test_waviness_is_the_sum_of_its_orders(lanes: Any, on: str) -> None:
    """Chords of 64 points a wave are off by 0.12 % of the shortest wave, their slopes by 5 %."""
    orders = tuple(range(2, 41))
    wave = Waviness(on, 0, orders, band_amplitudes(2, 40, 1e-6), None, 7)
    faults = faults_of(lanes.width, waviness=(wave,))
    waves = faults.cup_waves if on == "cup" else faults.roller_waves
    azimuth = np.linspace(-9.0, 9.0, 200)
    rows = np.repeat(azimuth[:, None], lanes.width, axis=0)
    found = through(lanes, wave_gaps, rows, 2, 0, waves).reshape(len(azimuth), lanes.width, 2)
    np.testing.assert_allclose(found[:, 0, 0], wave.gap(azimuth, 0), atol=2e-9)
    slope = (wave.gap(azimuth + 1e-6, 0) - wave.gap(azimuth - 1e-6, 0)) / 2e-6
    np.testing.assert_allclose(found[:, 0, 1], slope, atol=0.05 * np.abs(slope).max())
    if lanes.width > 1:
        np.testing.assert_array_equal(found[:, lanes.width // 2 :], 0.0)  # the other row is round
        if on == "roller":
            np.testing.assert_allclose(found[:, 1, 0], wave.gap(azimuth, 1), atol=2e-9)


@pytest.mark.parametrize(("rate", "gone"), [(-0.5, 1.0), (-1e-3, 0.0), (0.5, 0.0)])
def test_energy_of_springs_that_open_too_fast_goes_to_their_dampers(
    lanes: Any, rate: float, gone: float
) -> None:
    """Opening at 0.5 m/s a spring less than 2.8 um deep would pull: all of them; at 1 mm/s none."""
    found = pressed(lanes, [NEAR, FAR], 2e-6, replace(SPALL, depth=1e-6), rate=rate)
    assert found[:, ENERGY].min() > 1e-5
    np.testing.assert_allclose(found[:, LET_GO], -gone * found[:, ENERGY_SLOPE] * rate, rtol=1e-5, atol=1e-9)
    np.testing.assert_array_equal(found[:, STIFFNESS] == 0.0, bool(gone))


def test_penetration_near_a_patch_is_that_of_its_springs(lanes: Any) -> None:
    """On the floor 100 um down a roller is pressed by 3 um; where sound laminae hold it, by their depth."""
    depth = 3e-6 + FULL.depth
    floor, sound = pressed(lanes, [NEAR, FAR], depth, FULL)[:, PENETRATION]
    assert sound == pytest.approx(depth, rel=1e-9)
    assert floor == pytest.approx(3e-6, abs=5e-7)
    held = pressed(lanes, [NEAR, FAR], depth, SPALL)[0, PENETRATION]
    assert held == pytest.approx(depth, rel=0.05)


def test_worn_pocket_is_a_pocket_with_more_clearance_and_its_neighbours_are_not(lanes: Any) -> None:
    wear = 4e-4
    sound = parameters_of(scene_with(), lanes.width)
    worn = build_parameters(
        scene_with(defects=(WornPocket(0, 0, wear),)), Arrangement(17, lanes.width), np.zeros(6)
    ).effects.faults.pockets
    cage, roller = sound.effects.cage, sound.roller
    assert cage is not None
    bearing = scene_with().bearing
    axis = (math.sin(bearing.contact_angle), 0.0, math.cos(bearing.contact_angle))
    at_rest = [*axis, *(0.0,) * 15]
    place = [0.5 * bearing.pitch_diameter, 0.0, cage.roller_place / axis[2]]
    cases = np.array(
        [[*place, *at_rest[:3], 0, 0, 1.0, *at_rest[6:], a] for a in np.linspace(-0.02, 0.02, 41)]
    )
    assert cases.shape[1] == 22
    rows = np.repeat(cases, lanes.width, axis=0)
    found = through(lanes, worn_pockets, rows, 6, 0, worn, roller, cage).reshape(41, lanes.width, 6)
    wider = cage._replace(half_clearance=cage.half_clearance + 0.5 * wear)
    expected = through(lanes, worn_pockets, rows, 6, 0, None, roller, wider).reshape(41, lanes.width, 6)
    usual = through(lanes, worn_pockets, rows, 6, 0, None, roller, cage).reshape(41, lanes.width, 6)
    np.testing.assert_allclose(found[:, 0], expected[:, 0], rtol=1e-12)
    assert np.abs(found[:, 0] - usual[:, 0]).max() > 1.0
    if lanes.width > 1:
        np.testing.assert_array_equal(found[:, 1:], usual[:, 1:])
