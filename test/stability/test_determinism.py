"""The same input gives the same bits: twice, after a restart, and however the load is cut."""

from __future__ import annotations

import numpy as np

from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from test.kernels.rig import Rig
from test.runs import assert_same, started, wandering_load
from test.scenes import scene_with, standard_scene


def moving_scene() -> Scene:
    """Play, suspended box, tilting journal: every body moves."""
    return scene_with(end_play=1e-4, cup="suspended", journal_tilt="free")


def test_two_runs_are_bit_identical() -> None:
    first, second = (started(moving_scene(), wandering_load()) for _ in range(2))
    for _ in range(8):
        assert_same(first.advance(), second.advance())


def test_restart_from_a_snapshot_is_bit_identical() -> None:
    """In the same twin after it ran on, and in a fresh twin of the same scene."""
    scene = moving_scene()
    twin = started(scene, wandering_load())
    for _ in range(4):
        twin.advance()
    kept = twin.snapshot()
    ahead = [twin.advance() for _ in range(5)]
    twin.restore(kept)
    fresh = Twin(scene)
    fresh.restore(kept)
    for block in ahead:
        assert_same(twin.advance(), block)
        assert_same(fresh.advance(), block)


def test_a_snapshot_is_not_changed_by_the_run_that_goes_on() -> None:
    twin = started(standard_scene(), wandering_load())
    twin.advance()
    kept = twin.snapshot()
    rollers = kept.state.rollers.copy()
    twin.advance()
    np.testing.assert_array_equal(kept.state.rollers, rollers)


def test_cut_of_the_load_stream_does_not_matter() -> None:
    """All at once against pieces of 7 samples, and against just what covers the next block."""
    whole = wandering_load(401)
    scene = moving_scene()
    first = started(scene, whole)
    second = started(scene, whole.part(0, 7))
    third = started(scene, whole.part(0, 1))
    for start in range(7, len(whole), 7):
        assert second.feed(whole.part(start, min(start + 7, len(whole))))
    for index in range(8):
        while not third.covered():
            at = third.load.last_ns
            assert at is not None
            sample = int(at // 500_000) + 1
            assert third.feed(whole.part(sample, sample + 1))
        block = first.advance()
        assert_same(block, second.advance())
        assert_same(block, third.advance())
        assert index == block.index


def test_cut_of_a_run_into_blocks_does_not_matter() -> None:
    """600 steps in one call and in calls of 1, 7, 92, 500: the motion is the same to the last bit."""
    whole, pieces = Rig.at_equilibrium(standard_scene()), Rig.at_equilibrium(standard_scene())
    signals, _, _ = whole.run(600)
    cut = np.concatenate([pieces.run(count)[0] for count in (1, 7, 92, 500)])
    np.testing.assert_array_equal(cut, signals)
    np.testing.assert_array_equal(pieces.state.bodies, whole.state.bodies)
    np.testing.assert_array_equal(pieces.state.energy, whole.state.energy)
    np.testing.assert_array_equal(pieces.fields()[:13], whole.fields()[:13])
