"""The largest load of every contact between snapshots: what 200 snapshots a second miss."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.run import blocks
from beardyn_core.scene.tier import TIERS
from beardyn_core.sensors.block import CONTACT_KINDS, LARGEST, Block

CUP, POCKET = CONTACT_KINDS.index("cup"), CONTACT_KINDS.index("pocket")


def watched(contacts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Load of each contact but the pocket at the snapshots, and its largest since the snapshot before."""
    loads = np.linalg.norm(contacts[..., :POCKET, 3:6], axis=-1)
    return loads, contacts[..., :POCKET, LARGEST]


@pytest.mark.parametrize("tier", TIERS)
def test_the_largest_load_is_no_less_than_that_of_the_snapshot_and_starts_anew_behind_it(tier: str) -> None:
    scene = load_scene("static_80kN", tier=tier, effects="dry", duration=0.3)
    loads, largest = watched(np.concatenate([block.contacts for block in blocks(scene)]))
    assert (largest >= loads * (1.0 - 1e-9)).all()
    cup, most = loads[10:, ..., CUP], largest[10:, ..., CUP]
    assert (most.min(axis=0) < 0.7 * most.max(axis=0)).all(), "a roller leaves the load zone"
    between = np.maximum(cup[1:], cup[:-1])
    usual = np.median(most[1:] / np.maximum(between, 1.0))
    assert 1.0 <= usual < 1.05


@pytest.mark.parametrize("tier", ["lumped", "quasistatic"])
def test_several_blocks_at_once_have_the_largest_loads_of_one_at_a_time(tier: str) -> None:
    scene = load_scene("static_80kN", tier=tier, effects="dry", duration=0.2)
    single, long = (np.concatenate([block.contacts for block in blocks(scene, at_once=n)]) for n in (1, 5))
    np.testing.assert_array_equal(long, single)
    assert (single[..., CUP, LARGEST] > 0.0).any()


def test_every_strike_of_a_wheel_flat_shows_in_the_largest_loads_and_not_in_the_snapshots() -> None:
    scene = load_scene("wheel_flat", tier="lumped", effects="dry")
    found: list[Block] = list(blocks(scene))
    force = np.concatenate([block.force_waveform[:, 2] for block in found])
    rate = scene.waveform_rate
    settled = slice(round(0.3 * rate), None)
    strong = np.flatnonzero(force[settled] > 0.9 * force[settled].max()) / rate + 0.3
    strikes = strong[np.concatenate([[True], np.diff(strong) > 0.02])]
    loads, largest = watched(np.concatenate([block.contacts for block in found]))
    time = np.concatenate([block.snapshot_time_ns for block in found]) * 1e-9
    shown = {"snapshots": loads[..., CUP].max(axis=(1, 2)), "largest": largest[..., CUP].max(axis=(1, 2))}
    usual = np.median(shown["largest"])
    seen = {
        name: sum(values[(time > t - 1e-3) & (time < t + 7e-3)].max() > 1.2 * usual for t in strikes)
        for name, values in shown.items()
    }
    assert len(strikes) > 15
    assert seen["largest"] == len(strikes)
    assert seen["snapshots"] < len(strikes)
