"""The gap over a spall against plain geometry."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest

from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.build import build_parameters
from beardyn_core.model.fault_params import surface_radius
from beardyn_core.model.parameters import SpallParams
from beardyn_core.scene.defect import Spall
from test.kernels import naive
from test.kernels.casting import through
from test.kernels.entries import spalls
from test.kernels.rig import scene_with

SPALL = Spall(on="cup", row=0, azimuth=0.3, width=6e-3, depth=1e-4, length=0.025)


def patch_of(spall: Spall, width: int) -> SpallParams:
    scene = scene_with(defects=(spall,))
    found = build_parameters(scene, Arrangement(17, width), np.zeros(6)).effects.faults
    patch = {"cup": found.cup, "cone": found.cone, "roller": found.roller}[spall.on]
    assert patch is not None
    return patch


def gaps(lanes: Any, spall: Spall, azimuth: Any, lamina: int) -> Any:
    """Row 0 is in the first lanes; with one lane block 0 is a roller of row 0."""
    width = lanes.width
    half = max(width // 2, 1)
    rows = np.repeat(np.asarray(azimuth)[:, None], width, axis=1).reshape(-1, 1)
    found = through(lanes, spalls, rows, 1, lamina, 0.0133, patch_of(spall, width))
    found = found.reshape(len(azimuth), width)
    if width > 1:
        np.testing.assert_array_equal(found[:, half:], 0.0)  # the other row is sound
    return found[:, 0]


def test_roller_sinks_into_a_spall_as_geometry_says(lanes: Any) -> None:
    """Parabola for circle: the sink is low by (e / 2 r)^2, 1.3 % at the middle of a 6 mm spall."""
    azimuth = 0.3 + np.linspace(-0.06, 0.06, 401)
    radius = surface_radius(scene_with().bearing, "cup")
    found = gaps(lanes, SPALL, azimuth, 2)
    exact = np.array([naive.spall_sink((a - 0.3) * radius, 3e-3, 1e-4, 0.0133) for a in azimuth])
    np.testing.assert_array_equal(found > 0.0, exact > 0.0)
    assert np.abs(found - exact).max() <= 0.015 * exact.max()
    assert found.max() == 1e-4  # the floor: 338 um would be the bridged depth


def test_wide_shallow_spall_is_limited_by_its_floor_and_narrow_by_its_edges(lanes: Any) -> None:
    azimuth = np.array([0.3])
    deep = Spall(on="cup", row=0, azimuth=0.3, width=2e-3, depth=1e-3, length=0.05)
    bridged = gaps(lanes, deep, azimuth, 0)[0]
    assert bridged == pytest.approx(0.0133 - math.sqrt(0.0133**2 - 1e-6), rel=2e-3)
    assert gaps(lanes, Spall(on="cup", row=0, azimuth=0.3, width=2e-2, depth=2e-5, length=0.05), azimuth, 0)[
        0
    ] == pytest.approx(2e-5)


def test_spall_covers_its_laminae_only(lanes: Any) -> None:
    """Half of the length in the middle: of six laminae the inner ones with more than half of them covered."""
    covered = [gaps(lanes, SPALL, np.array([0.3]), k)[0] > 0.0 for k in range(6)]
    assert covered == [False, False, True, True, False, False] or covered == [
        False,
        True,
        True,
        True,
        True,
        False,
    ]
    edges = (np.arange(7) / 6 - 0.5) * 0.05
    overlap = [max(0.0, min(b, 0.0125) - max(a, -0.0125)) / (b - a) for a, b in itertools.pairwise(edges)]
    assert covered == [share > 0.5 for share in overlap]


def test_spall_is_found_again_after_any_number_of_turns(lanes: Any) -> None:
    azimuth = 0.31 + 2.0 * np.pi * np.array([-1000.0, -1.0, 0.0, 1.0, 1000.0])
    found = gaps(lanes, SPALL, azimuth, 2)
    np.testing.assert_allclose(found, found[2], rtol=1e-8)
    assert found[2] > 0.0


def test_spall_of_no_depth_is_no_gap(lanes: Any) -> None:
    flat = Spall(on="cup", row=0, azimuth=0.3, width=6e-3, depth=0.0, length=0.05)
    np.testing.assert_array_equal(gaps(lanes, flat, np.linspace(0.2, 0.4, 50), 2), 0.0)
