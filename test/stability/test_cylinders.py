"""Cylindrical pairs in what tips, reverses or hardly loads them: no run fails, rollers keep their course."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from beardyn_core.physics.bodies import layout
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.runs import constant_load, started, stepped_load
from test.tiers.test_cylinders import SPEED, scene_of

TIERS = ("lumped", "quasistatic", "full")
pytestmark = pytest.mark.slow
KN = 1e3
# a roller between ribs with 0.15 mm of play on ends of 28 mm turns by 11 mrad at most
MOST_SKEW = 0.012


def scene(tier: str, tilt: str = "locked") -> Scene:
    return scene_of(tier, (0.0, 0.0, 80.0), tilt)


def run(twin: Twin, count: int = 12) -> list[Block]:
    return [twin.advance() for _ in range(count)]


def fine(blocks: list[Block]) -> None:
    """Every number is finite, no block has a reason to end the run."""
    for block in blocks:
        assert block.status == 0
        assert np.isfinite(block.force_waveform).all()
        assert np.isfinite(block.body_pose).all()


@cache
def thrust_to_and_fro() -> LoadHistory:
    return stepped_load(
        [
            (0.0, (0.0, 10 * KN, 60 * KN), SPEED),
            (0.06, (0.0, 10 * KN, 60 * KN), SPEED),
            (0.12, (0.0, -10 * KN, 60 * KN), SPEED),
            (0.18, (0.0, -10 * KN, 60 * KN), SPEED),
            (0.24, (0.0, 10 * KN, 60 * KN), SPEED),
            (1.0, (0.0, 10 * KN, 60 * KN), SPEED),
        ]
    )


@pytest.mark.parametrize("tier", TIERS)
def test_thrust_that_reverses_crosses_the_float_and_is_carried_on_the_other_side(tier: str) -> None:
    """The axle moves through its end play, 0.8 mm, and the ribs of the other row take the force."""
    blocks = run(started(scene(tier), thrust_to_and_fro()), 10)
    fine(blocks)
    along = np.concatenate([block.body_pose[:, 1, 1] - block.body_pose[:, 0, 1] for block in blocks])
    assert along[0] > 0.39e-3
    assert along.min() < -0.39e-3
    force = np.concatenate([block.force_waveform[:, 1] for block in blocks])
    assert force.min() < -10 * KN  # the axle strikes the ribs of the other row


@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize(
    ("force", "speed"),
    [
        ((0.0, 24.0, 40.0), SPEED),  # 0.6 of the radial load, where catalogues allow 0.4
        ((0.0, 0.0, 1.0), 2.5 * SPEED),
        ((20.0, -4.0, 30.0), SPEED),
        ((0.0, 0.0, 250.0), SPEED),
    ],
    ids=["thrust", "light", "across", "heavy"],
)
def test_loads_beyond_the_usual_are_survived(
    tier: str, force: tuple[float, float, float], speed: float
) -> None:
    load = (force[0] * KN, force[1] * KN, force[2] * KN)
    blocks = run(started(scene(tier), constant_load(load, speed)))
    fine(blocks)
    mean = np.concatenate([block.force_waveform[:, :3] for block in blocks[6:]]).mean(axis=0)
    np.testing.assert_allclose(mean, load, atol=0.03 * max(map(abs, load)) + 200.0)


@pytest.mark.parametrize("tier", TIERS)
def test_a_moment_tilts_the_axle_and_both_rows_answer(tier: str) -> None:
    """1.5 kN m about x: the ends of the rollers bear, the rows share 40 kN unevenly."""
    load = constant_load((0.0, 0.0, 40 * KN), SPEED, 10.0, 1.5 * KN, 0.0, 0.0)
    blocks = run(started(scene(tier, "free"), load))
    fine(blocks)
    contacts = np.concatenate([block.contacts for block in blocks[6:]])
    rows = np.linalg.norm(contacts[..., 0, 3:6], axis=-1).max(axis=2).mean(axis=0)
    assert rows.max() > 1.5 * rows.min()


@pytest.mark.parametrize("skew", [2e-3, 8e-3, -8e-3])
def test_rollers_that_start_askew_are_turned_back_by_their_ribs(skew: float) -> None:
    """Full tier: every roller begins askew by 0.1 and 0.5 degrees; ribs and raceways keep it from more."""
    twin = started(scene("full"), constant_load((0.0, 5 * KN, 60 * KN), SPEED))
    state: Any = twin._state
    axis = state.rollers[:, layout.AXIS : layout.AXIS + 3]
    axis[:, 1] = skew
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    blocks = run(twin)
    fine(blocks[1:])  # a roller askew by half a degree slips at once
    assert np.abs(state.rollers[:, layout.AXIS + 1]).max() < MOST_SKEW
    loaded = np.linalg.norm(state.rollers[:, layout.CONTACT_OUTPUT : layout.CONTACT_OUTPUT + 3], axis=1) > 3e3
    assert np.abs(state.rollers[:, layout.AXIS + 1][loaded]).max() < 2e-3


def test_a_pair_that_is_lifted_and_set_down_again_runs_on() -> None:
    points = [(0.0, 40.0), (0.04, 40.0), (0.08, -20.0), (0.14, -20.0), (0.18, 40.0), (1.0, 40.0)]
    load = stepped_load([(time, (0.0, 0.0, each * KN), SPEED) for time, each in points])
    blocks = run(started(scene("full"), load), 14)
    fine(blocks)
    last = np.concatenate([block.force_waveform[:, 2] for block in blocks[11:]])
    assert last.mean() == pytest.approx(40 * KN, rel=0.1)


def test_ribs_without_their_edges_and_rims_change_little_under_a_usual_load() -> None:
    """Guidance is on the faces: what is beyond them hardly counts where rollers run true."""
    found = []
    for whole in (True, False):
        effects = scene("full").effects
        assert effects.rib is not None
        rib = replace(effects.rib, window=whole, roller_end=whole)
        twin = started(
            replace(scene("full"), effects=replace(effects, rib=rib)),
            constant_load((0.0, 5 * KN, 80 * KN), SPEED),
        )
        blocks = run(twin, 8)
        fine(blocks)
        found.append(np.concatenate([block.shaft_torque for block in blocks[4:]]).mean())
    assert found[0] == pytest.approx(found[1], rel=0.03)
