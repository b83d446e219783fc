"""Bodies and contacts more often than 200 times a second: what is kept, and what stays as it was."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.choice import load_scene
from beardyn_core.record.run import Run
from beardyn_core.run import blocks
from beardyn_core.scene.scene import SNAPSHOT_RATES, Numerics, Scene, snapshots_do_not_fit
from beardyn_core.scene.tier import TIERS
from beardyn_core.twin import Twin


def scene_at(rate: float, tier: str) -> Scene:
    return replace(load_scene("static_80kN", tier=tier, effects="dry", duration=0.2), snapshot_rate=rate)


@pytest.mark.parametrize("tier", TIERS)
def test_every_snapshot_has_its_time_and_the_slow_ones_are_among_them(tier: str) -> None:
    slow, fast = (Run.of_blocks(blocks(scene_at(rate, tier))) for rate in (200.0, 3200.0))
    assert fast.contacts.rate == 3200.0 == fast.bodies.rate
    assert len(fast.contacts) == 16 * len(slow.contacts) == 640
    np.testing.assert_array_equal(fast.contacts.time_ns[15::16], slow.contacts.time_ns)
    np.testing.assert_array_equal(np.diff(fast.bodies.sample), 1)
    # the same run; fast tiers renew what they hold as often as they are looked at
    load = slow.contacts.load[..., :2]
    np.testing.assert_allclose(fast.contacts.load[15::16, ..., :2], load, atol=0.01 * load.max())
    np.testing.assert_allclose(fast.force.values[:, 2], slow.force.values[:, 2], rtol=2e-3)
    assert fast.vibration.rate == slow.vibration.rate
    assert len(fast.torque) == len(slow.torque)
    assert fast.rollers.speed.shape == slow.rollers.speed.shape
    np.testing.assert_allclose(fast.rollers.angle[-1], slow.rollers.angle[-1], atol=6e-3)  # loose in pockets
    np.testing.assert_allclose(fast.cages.speed[-1], slow.cages.speed[-1], rtol=1e-3)


def test_more_snapshots_see_what_the_largest_load_has_seen() -> None:
    """Of a wheel flat 12 800 snapshots hold the strikes that 200 miss; the largest of 200 are theirs."""
    scene = load_scene("wheel_flat", tier="lumped", effects="dry", duration=0.6)
    scene = replace(scene, numerics=replace(scene.numerics, steps_per_sample=1))
    slow, fast = (
        Run.of_blocks(blocks(replace(scene, snapshot_rate=rate))).contacts for rate in (200.0, 12800.0)
    )
    cup = slow.of("cup")
    assert fast.load[..., cup].max() > 1.1 * slow.load[..., cup].max()
    within = fast.load[..., cup].reshape(len(slow), 64, *slow.slip.shape[1:3]).max(axis=1)
    np.testing.assert_allclose(within.max(), slow.largest[..., cup].max(), rtol=0.02)


def test_the_rate_is_kept_by_a_recording(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    run = bd.simulate(scene_at(800.0, "lumped"), record=path)
    read = bd.read(path)
    assert read.contacts.rate == read.bodies.rate == 800.0
    assert read.duration == pytest.approx(0.2)
    np.testing.assert_allclose(read.contacts.load, run.contacts.load, rtol=1e-6)
    np.testing.assert_allclose(read.contacts.pressure, run.contacts.pressure, rtol=1e-6)


@pytest.mark.parametrize(
    ("rate", "steps", "allowed"), [(300.0, 4, "12800"), (12800.0, 0.5, "6400"), (6400.0, 0.25, "3200")]
)
def test_a_rate_that_steps_cannot_give_is_refused(rate: float, steps: float, allowed: str) -> None:
    said = snapshots_do_not_fit(rate, steps)
    assert said is not None
    assert said.endswith(allowed)
    numerics = Numerics(steps_per_sample=steps)
    with pytest.raises(bd.InputError, match="snapshot_rate_Hz is"):
        Twin(replace(scene_at(rate, "lumped"), numerics=numerics))


def test_a_scene_names_the_rate_and_its_mistakes() -> None:
    named: dict[str, Any] = {"effects": "standard", "tier": "lumped", "numerics": {"steps_per_sample": 1}}
    assert bd.scene("static_80kN", snapshot_rate_Hz=1600, **named).snapshot_rate == 1600.0
    with pytest.raises(bd.InputError, match="is 900; with steps_per_sample 1 allowed are 200"):
        bd.scene("static_80kN", snapshot_rate_Hz=900, **named)
    with pytest.raises(bd.InputError, match="snapshot_rate_Hz"):
        bd.scene("static_80kN", snapshot_rate_Hz=25600, **named)
    assert all(snapshots_do_not_fit(rate, 1.0) is None for rate in SNAPSHOT_RATES)


def test_a_step_that_nobody_gave_is_short_enough() -> None:
    usual = load_scene("static_80kN", tier="lumped", effects="standard").numerics.steps_per_sample
    assert usual < 1
    fast = bd.scene("static_80kN", tier="lumped", effects="standard", snapshot_rate_Hz=12800)
    assert fast.numerics.steps_per_sample == 1
