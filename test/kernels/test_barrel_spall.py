"""Load that a barrel loses over a spall in the fast tiers, next to a plain sum over many slices."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from beardyn_core.bearing.contact_law import barrel_ellipse
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.choice import scene_from_mapping
from beardyn_core.physics.tiers.tiers import TIERS
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Scene
from test.kernels.casting import through
from test.kernels.fault_entries import barrel_springs, massless_rollers
from test.kernels.rig import parameters_of

FINE = 2000
LOADS = [2.3e3, 17e3]  # of the heaviest roller under 8 and 80 kN
DEEP, WIDTH = 3e-4, 12e-3
# length along the roller, offset of its middle, depth [m]
PARTS = [(6e-3, 0.0, DEEP), (8e-3, 5e-3, DEEP), (12e-3, -9e-3, DEEP), (40e-3, 0.0, 3e-6), (8e-3, 2e-3, 4e-6)]


@cache
def scene_of(tier: str, patch: Patch) -> Scene:
    """A barrel bearing without effects but the patch."""
    scene = scene_from_mapping(
        {
            "scene": "barrels",
            "bearing": "SRB120x260",
            "lubricant": "L055",
            "effects": "standard",
            "tier": tier,
            "operation": {"kind": "constant", "force_kN": [0, 0, 60], "speed_rpm": 600.0},
            "numerics": {"laminae": 60},
        },
        "barrels",
        Path(),
    )
    return replace(scene, defects=(patch,))


def spall(length: float, offset: float, depth: float) -> Patch:
    return Patch(on="cup", row=0, azimuth=1.0, width=WIDTH, depth=depth, length=length, offset=offset)


def bearing() -> SphericalBearing:
    found = scene_of("quasistatic", spall(*PARTS[0])).bearing
    assert isinstance(found, SphericalBearing)
    return found


def slow_load(ring: str, depth: float, patch: Patch | None = None, gap: float = 0.0) -> float:
    """Sum the slices of a contact, each with its own place, over a floor that lies deeper by a gap [N]."""
    law, length = barrel_ellipse(bearing(), ring), bearing().effective_length
    x = ((np.arange(FINE) + 0.5) / FINE - 0.5) * length
    sunk = depth - (x / law.reach) ** 2
    if patch is not None:
        sunk = sunk - gap * (np.abs(x - patch.offset) < 0.5 * patch.length)
    return float(law.stiffness * length / FINE * np.maximum(sunk, 0.0).sum())


def depth_of(ring: str, load: float) -> float:
    return float(brentq(lambda depth: slow_load(ring, depth) - load, 0.0, 1e-3, xtol=1e-15))


def slow_load_between_rings(approach: float, patch: Patch | None = None, gap: float = 0.0) -> float:
    """Load of both contacts in series, that with the cup over a patch."""
    on_cup = brentq(
        lambda depth: slow_load("cup", depth, patch, gap) - slow_load("cone", approach - depth),
        0.0, approach, xtol=1e-15,
    )  # fmt: skip
    return slow_load("cone", approach - float(on_cup))


def gap_at_middle(p: Any) -> float:
    """Gap over the middle of the patch, whose edges soften nothing there."""
    surface = p.effects.faults.cup
    assert surface.softness[0] == 0.0
    return float(surface.paths[0])


def quasistatic(lanes: Any, patch: Patch, depth: float) -> tuple[float, float, float]:
    """Load over the middle of a patch and far from it at a depth [m], and the gap there."""
    p = parameters_of(scene_of("quasistatic", patch), lanes.width)
    cases = np.repeat(np.array([[1.0, depth], [3.0, depth]]), lanes.width, 0)
    near, far = through(lanes, barrel_springs, cases, 1, p.roller.half_length, p)[:: lanes.width, 0]
    return near, far, gap_at_middle(p)


def lumped(lanes: Any, patch: Patch, approach: float) -> tuple[float, float, float]:
    """The same at an approach of the rings."""
    scene = scene_of("lumped", patch)
    base = parameters_of(scene, lanes.width)
    p = TIERS["lumped"].parameters(scene, base)
    cases = np.repeat(np.array([[1.0, approach, 0.0], [3.0, approach, 0.0]]), lanes.width, 0)
    near, far = through(lanes, massless_rollers, cases, 1, p)[:: lanes.width, 0]
    return near, far, gap_at_middle(base)


@pytest.mark.parametrize("tier", [quasistatic, lumped])
@pytest.mark.parametrize("load", LOADS)
def test_a_deep_spall_longer_than_the_ellipse_leaves_nothing(
    lanes: Any, tier: Callable[..., tuple[float, float, float]], load: float
) -> None:
    whole = depth_of("cup", load), depth_of("cone", load)
    near, far, _ = tier(lanes, spall(40e-3, 0.0, DEEP), whole[0] if tier is quasistatic else sum(whole))
    assert far == pytest.approx(load, rel=0.02)
    assert abs(near) < 0.005 * load


@pytest.mark.parametrize("load", LOADS)
@pytest.mark.parametrize("part", PARTS)
def test_a_part_of_the_ellipse_is_lost_as_a_plain_sum_has_it(
    lanes: Any, part: tuple[float, float, float], load: float
) -> None:
    """Within 1 % of the intact load, also where a barrel finds its balance between both rings."""
    patch, depth = spall(*part), depth_of("cup", load)
    near, far, gap = quasistatic(lanes, patch, depth)
    expected = slow_load("cup", depth, patch, gap)
    assert expected < 0.95 * load
    assert near / far == pytest.approx(expected / load, abs=0.01)
    approach = depth + depth_of("cone", load)
    near, far, gap = lumped(lanes, patch, approach)
    assert near / far == pytest.approx(slow_load_between_rings(approach, patch, gap) / load, abs=0.01)
