"""A tier is a scene's choice: every channel, the same bits again, and what is missing is said."""

from __future__ import annotations

import pickle
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.kinematics import cage_speed, fault_frequencies
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.effects import CoulombTraction
from beardyn_core.monitor.chain import MonitorResult
from beardyn_core.monitor.streaming import Monitor, MonitorInput, run_monitor
from beardyn_core.rail.build import load_history
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIER_NAMES
from beardyn_core.study.desk_run import run
from beardyn_core.twin import Twin
from test.runs import assert_same, blocks_of, started, wandering_load
from test.tiers.runs import FAST, scene_of

LATER = ("body_pose", "body_twist", "contacts")


def moving(tier: str) -> Scene:
    """Play, suspended box, tilting journal, a spall: everything a tier has."""
    scene = load_scene("cup_spall", tier=tier)
    return replace(scene, mounting=replace(scene.mounting, journal_tilt="free"))


@pytest.mark.parametrize("tier", FAST)
def test_restart_from_a_snapshot_is_bit_identical(tier: str) -> None:
    """In the same twin after it ran on, and in a fresh twin of the same scene."""
    scene = moving(tier)
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


@pytest.mark.parametrize("tier", FAST)
def test_a_block_has_the_channels_of_the_full_tier(tier: str) -> None:
    """Same shapes; rollers orbit with the cage, in the lumped tier at its kinematic speed; no audit."""
    full, fast = (
        blocks_of(scene_of("cup_spall", "full"), 0.1)[-1],
        blocks_of(scene_of("cup_spall", tier), 0.1)[-1],
    )
    assert fast.body_pose.shape == full.body_pose.shape
    assert fast.contacts.shape == full.contacts.shape
    assert fast.acceleration.shape == full.acceleration.shape
    scene = scene_of("cup_spall", tier)
    slip = {"lumped": (1e-4, 1e-3), "quasistatic": (1e-2, 3e-2)}[tier]
    np.testing.assert_allclose(
        fast.cage_speed[:, 0], cage_speed(scene.bearing, 1.0) * fast.shaft_speed, rtol=slip[0]
    )
    np.testing.assert_allclose(
        fast.roller_speed, fast.cage_speed[:, :1, None] * np.ones((1, 2, 17)), rtol=slip[1]
    )
    assert not fast.contacts[..., 3, :].any()
    assert fast.audit is None
    assert np.any(fast.contacts[-1, ..., :3, 3:6])


@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize("name", ["static_80kN", "cup_spall"])
def test_films_differ_from_the_full_tier_by_the_loads_alone(name: str, tier: str) -> None:
    """A roller of the full tier orbits up to 1 % off pure rolling, so its film is up to 0.7 % off.

    Where a fast tier gives a roller another load at an instant, a lightly loaded one of the lumped tier up to
    half as much again, the film follows with the load exponent of the formula.
    """
    full, fast = (blocks_of(scene_of(name, each), 0.1)[-1] for each in ("full", tier))
    film_params = Twin(scene_of(name, tier))._parameters.effects.film
    assert film_params is not None
    for kind in (0, 1):
        load, load_full = (np.linalg.norm(b.contacts[..., kind, 3:6], axis=-1) for b in (fast, full))
        both = (load > 500.0) & (load_full > 500.0)
        assert both.sum() > 30
        film, film_full = fast.contacts[..., kind, 7][both], full.contacts[..., kind, 7][both]
        by_load = (load[both] / load_full[both]) ** film_params.load_exponent
        np.testing.assert_allclose(film, film_full * by_load, rtol=0.01)
        assert film.mean() == pytest.approx(film_full.mean(), rel=0.01)


@pytest.mark.parametrize("tier", FAST)
def test_a_block_looked_at_late_says_what_it_said_at_once(tier: str) -> None:
    """Poses, twists and contacts are worked out at the first look: blocks later, and from several threads."""
    scene = moving(tier)
    at_once, late = started(scene, wandering_load()), started(scene, wandering_load())
    expected = []
    for _ in range(4):
        block = at_once.advance()
        expected.append([getattr(block, name).copy() for name in LATER])
    kept = [late.advance() for _ in range(4)]
    with ThreadPoolExecutor(4) as pool:
        for block, arrays in zip(kept, expected, strict=True):
            for name, array in zip(LATER, arrays, strict=True):
                found = list(pool.map(lambda _, b=block, n=name: getattr(b, n), range(4)))
                for each in found:
                    np.testing.assert_array_equal(each, array)
    again = pickle.loads(pickle.dumps(late.advance()))
    np.testing.assert_array_equal(again.contacts, at_once.advance().contacts)


@pytest.mark.parametrize("tier", FAST)
def test_mirrored_rollers_carry_mirrored_loads(tier: str) -> None:
    """Pure radial load: both rows carry the same, roller k of one as roller k of the other."""
    block = blocks_of(scene_of("static_80kN", tier), 0.1)[-1]
    load = np.linalg.norm(block.contacts[-1, :, :, 0, 3:6], axis=-1)
    np.testing.assert_allclose(load[0], load[1], rtol=1e-9, atol=1e-6)
    assert np.abs(block.force[:, 1]).max() < 1e-6 * block.force[:, 2].mean()


@pytest.mark.parametrize("tier", FAST)
def test_effects_beyond_a_tier_are_listed_and_not_ignored(tier: str) -> None:
    scene = replace(scene_of("static_80kN", tier), duration=0.1)
    summary = run(scene)
    assert summary.not_in_tier == ("audit", "rib.roller_end")
    assert set(summary.effects) == {"contact_damping", "traction", "film", "rib", "cage", "gravity"}
    assert summary.energy_residual is None
    truth = Twin(scene).truth()
    assert truth["tier"] == tier
    assert truth["not_in_this_tier"]["effects"] == list(summary.not_in_tier)
    assert "energy audit" in truth["not_in_this_tier"]["channels"]


@pytest.mark.parametrize("tier", FAST)
def test_traction_without_a_film_is_beyond_a_fast_tier(tier: str) -> None:
    scene = scene_of("static_80kN", tier)
    dry = replace(scene, effects=replace(scene.effects, traction=CoulombTraction(), film=None))
    assert "traction" in dry.missing_effects
    assert "traction" not in scene.missing_effects


def test_the_full_tier_misses_nothing() -> None:
    assert scene_of("static_80kN", "full").missing_effects == ()


@pytest.mark.parametrize("tier", TIER_NAMES)
def test_a_tier_brings_its_own_step_and_a_resolved_scene_keeps_it(tier: str) -> None:
    scene = load_scene("static_80kN", tier=tier)
    assert scene.numerics.steps_per_sample == {"lumped": 0.25, "quasistatic": 1, "full": 4}[tier]
    assert scene_from_text(scene_text(scene)).numerics == scene.numerics
    assert scene_from_text(scene_text(scene)).tier == tier


@pytest.mark.parametrize("tier", FAST)
def test_half_the_step_gives_the_same_load_distribution(tier: str) -> None:
    """Without cages, in whose pockets the rollers would be at other places."""
    scene = scene_of("static_80kN", tier)
    scene = replace(scene, effects=replace(scene.effects, cage=None))
    fine = replace(scene, numerics=replace(scene.numerics, steps_per_sample=4))
    peaks = []
    for each in (scene, fine):
        blocks = blocks_of(each, 0.3)[5:]
        cup = np.concatenate([np.linalg.norm(block.contacts[..., 0, 3:6], axis=-1) for block in blocks])
        peaks.append(cup.max(axis=(1, 2)).mean())
    assert peaks[0] == pytest.approx(peaks[1], rel=1e-3)


def verdicts(tier: str, name: str, healthy: bool) -> list[MonitorResult]:
    """What the monitor says of a run."""
    scene = scene_of(name, tier)
    scene = replace(scene, defects=()) if healthy else scene
    monitor = Monitor(fault_frequencies(scene.bearing), scene.bearing.roller_count)
    found = run_monitor(monitor, map(MonitorInput.of_block, blocks_of(scene, 2.2)))
    return [result for result in found if result.verdict != "waiting"]


@pytest.mark.slow
@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize(("name", "verdict"), [("cup_spall", "cup"), ("cone_spall", "cone")])
def test_monitor_finds_a_spall_in_a_run_of_a_fast_tier(tier: str, name: str, verdict: str) -> None:
    results = verdicts(tier, name, healthy=False)
    assert results
    assert {result.verdict for result in results} == {verdict}


@pytest.mark.slow
@pytest.mark.parametrize("tier", FAST)
def test_monitor_is_quiet_on_the_healthy_run_of_a_fast_tier(tier: str) -> None:
    results = verdicts(tier, "cup_spall", healthy=True)
    assert results
    assert {result.verdict for result in results} == {"healthy"}


@pytest.mark.parametrize("steps", [1, 2])
def test_quasistatic_rollers_that_start_in_a_groove_carry_the_load(steps: int) -> None:
    """The static start knows no groove under every roller: all lose their contact at once."""
    scene = scene_of("brinelling", "quasistatic")
    blocks = blocks_of(replace(scene, numerics=replace(scene.numerics, steps_per_sample=steps)), 0.1)
    assert all(block.status == 0 for block in blocks)
    lifted = blocks_of(replace(scene_of("static_80kN", "quasistatic"), end_play=scene.end_play), 0.1)[-1]
    np.testing.assert_allclose(blocks[-1].force[:, 2].mean(), lifted.force[:, 2].mean(), rtol=1e-3)


@pytest.mark.parametrize("frequency", [2.0, 20.0])
def test_quasistatic_rollers_follow_an_axial_load_through_the_play(frequency: float) -> None:
    """One step a sample is as good as eight; a row whose load goes away leaves cup and rib and comes back."""
    scene = scene_of("cup_spall", "quasistatic")
    found = {}
    for steps in (1, 8):
        twin = Twin(replace(scene, numerics=replace(scene.numerics, steps_per_sample=steps), end_play=2e-4))
        load = load_history(scene.operation, scene.mounting, 0.5, scene.seed)
        load.wrench[:, 1] += 2e4 * np.sin(2e-9 * np.pi * frequency * load.time_ns)
        twin.start(load)
        blocks = [twin.advance() for _ in range(24)]
        assert all(block.status == 0 for block in blocks)
        found[steps] = np.concatenate([block.force[:, :3] for block in blocks])
    common = min(len(force) for force in found.values())  # the filters hold back samples of unlike steps
    # of first order in the step; a tenth of a percent of the swing
    assert np.sqrt(np.mean((found[1][:common] - found[8][:common]) ** 2)) < 20.0


@pytest.mark.parametrize("speed_rpm", [0, 1000, 3000, 6000])
@pytest.mark.parametrize("force_kN", [0.0, -0.0048, -0.2, 20.0])
@pytest.mark.parametrize(
    "keys",
    [
        "missing_rollers: [{row: 0, roller: 3}]",
        "scatter: {grade: G5, seed: 3}",
        "rows: 1\nmounting: {cup: suspended, axial_prop_stiffness_MN_per_m: 50}",
    ],
    ids=["missing roller", "scatter", "single row"],
)
def test_lumped_tier_starts_with_light_loads_and_single_rows(
    keys: str, force_kN: float, speed_rpm: float
) -> None:
    """Rollers that come and go, and a row whose tilt nothing but the box's springs holds."""
    scene = scene_from_text(
        "scene: light\nbearing: HS130x230\nlubricant: L055\ntier: lumped\neffects: standard\n"
        f"operation: {{kind: constant, force_kN: [0, 0, {force_kN}], speed_rpm: {speed_rpm}}}\n{keys}\n",
        "light",
    )
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, 0.02, 1))
    assert np.isfinite(twin.snapshot().state.bodies).all()
