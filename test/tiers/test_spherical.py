"""Runs of spherical roller bearings against their statics, their kinematics and what they must not do."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.choice import scene_from_mapping
from beardyn_core.physics.statics.static import StaticSolution, solve
from beardyn_core.physics.tiers.tiers import spring_laminae
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from test.runs import blocks_of
from test.tiers.steady import Force, steady_scene

TIERS = ("lumped", "quasistatic", "full")
NAME = "SRB120x260"
RPM = 600.0
SPEED = RPM * math.pi / 30.0
PHASES = 8
Array = np.ndarray[Any, Any]


@cache
def scene_of(tier: str, force: Force, tilt: str = "locked") -> Scene:
    """A bearing under a steady load, the cup held, with the standard effects."""
    return steady_scene(NAME, tier, force, RPM, tilt)


@cache
def second_half(tier: str, force: Force, duration: float = 0.4) -> tuple[Block, ...]:
    blocks = blocks_of(scene_of(tier, force), duration)
    assert not any(block.status for block in blocks)
    return blocks[len(blocks) // 2 :]


def joined(blocks: tuple[Block, ...], name: str) -> Array:
    return np.concatenate([getattr(block, name) for block in blocks])


@cache
def statics_of(tier: str, force: Force) -> tuple[StaticSolution, ...]:
    """Equilibria over the places that rollers pass through."""
    scene = scene_of(tier, force)
    laminae = spring_laminae(scene) if tier == "lumped" else scene.numerics.laminae
    return tuple(
        solve(
            scene.bearing,
            [1e3 * each for each in force],
            end_play=None,
            laminae=laminae,
            speed=SPEED,
            roller_phase=float(phase),
        )
        for phase in np.arange(PHASES) / PHASES * 2.0 * math.pi / scene.bearing.roller_count
    )


def displacement_of(blocks: tuple[Block, ...]) -> Array:
    pose = joined(blocks, "body_pose")
    return np.asarray((pose[:, 1, :3] - pose[:, 0, :3]).mean(axis=0))


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize("force", [(0.0, 0.0, 80.0), (0.0, 5.0, 80.0), (0.0, -10.0, 80.0)])
def test_a_steady_run_has_load_and_deflection_of_the_statics(tier: str, force: Force) -> None:
    """Within 1 %: force on the cup, deflection, largest roller load, and 2 % what each row carries."""
    blocks, found = second_half(tier, force), statics_of(tier, force)
    displacement = np.mean([each.displacement for each in found], axis=0)
    moved = displacement_of(blocks)
    assert moved[2] == pytest.approx(displacement[2], rel=0.01)
    # along the axle friction of the raceways counts: it holds back some hundredths of the thrust
    assert moved[1] == pytest.approx(displacement[1], abs=0.015 * float(np.linalg.norm(displacement)))
    load = np.linalg.norm(joined(blocks, "contacts")[..., 0, 3:6], axis=-1)
    heaviest = float(np.mean([each.largest_roller_load for each in found]))
    assert load.max(axis=(1, 2)).mean() == pytest.approx(heaviest, rel=0.01)
    rows = np.mean([each.cup_load.sum(axis=-1) for each in found], axis=0)
    np.testing.assert_allclose(load.sum(axis=-1).mean(axis=0), rows, rtol=0.02)
    mean = joined(blocks, "force_waveform").mean(axis=0)
    assert mean[1] == pytest.approx(1e3 * force[1], abs=0.01 * 1e3 * force[2])
    assert mean[2] == pytest.approx(1e3 * force[2], rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
def test_axial_load_loads_one_row_more(tier: str) -> None:
    load = np.linalg.norm(joined(second_half(tier, (0.0, -10.0, 80.0)), "contacts")[..., 0, 3:6], axis=-1)
    inner, outer = load.sum(axis=-1).mean(axis=0)
    assert inner > 2.0 * outer


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
def test_cages_and_rollers_turn_as_pure_rolling_has_it(tier: str) -> None:
    blocks = second_half(tier, (0.0, 0.0, 80.0))
    frequencies = fault_frequencies(scene_of(tier, (0.0, 0.0, 80.0)).bearing)
    ratio = joined(blocks, "cage_speed").mean(axis=0) / (frequencies.ftf * SPEED)
    assert ratio == pytest.approx(1.0, abs=0.006)
    twist = joined(blocks, "body_twist")[:, 4:]
    heavy = np.linalg.norm(joined(blocks, "contacts")[..., 1, 3:6], axis=-1).reshape(len(twist), -1) > 5e3
    turning = np.linalg.norm(twist[..., 3:6], axis=-1)
    cage = ratio.mean() * frequencies.ftf * SPEED
    cosine = math.cos(scene_of(tier, (0.0, 0.0, 80.0)).bearing.contact_angle)
    # against the cage a roller spins with bsf; with the cage's own turn about another axis
    spin = cage * cosine - frequencies.bsf * SPEED
    across = cage * math.sqrt(1.0 - cosine**2)
    assert turning[heavy].mean() == pytest.approx(math.hypot(spin, across), rel=0.005)


@pytest.mark.slow
@pytest.mark.parametrize("force", [(0.0, 0.0, 80.0), (0.0, 5.0, 80.0), (0.0, 0.0, 8.0)])
def test_the_full_tier_keeps_its_energy_and_its_momentum(force: Force) -> None:
    """Energy within 1e-4 of what is dissipated; forces on the cup are those on the journal."""
    blocks = second_half("full", force)
    audit = blocks[-1].audit
    assert audit is not None
    assert audit.residual < 1e-4
    mean = joined(blocks, "force_waveform").mean(axis=0)
    assert mean[1] == pytest.approx(1e3 * force[1], abs=0.01 * 1e3 * force[2])


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize("ring", ["CUP_BODY", "CONE_BODY"])
def test_a_tilted_ring_feels_no_moment(tier: str, ring: str) -> None:
    """Cup or journal held at 2 mrad: less than 0.2 % of the load is left at the sphere, friction along it."""
    from beardyn_core.physics.bodies import layout
    from beardyn_core.run import start

    scene = scene_of(tier, (0.0, 0.0, 80.0))
    assert isinstance(scene.bearing, SphericalBearing)
    begun = start(scene, 0.3)
    state = begun.twin._state
    assert state is not None
    state.bodies[getattr(layout, ring), layout.TILT] += 2e-3
    blocks = tuple(begun.blocks(1))
    assert not any(block.status for block in blocks)
    force = joined(blocks[len(blocks) // 2 :], "force_waveform").mean(axis=0)
    assert np.abs(force[[3, 5]]).max() < 0.002 * 80e3 * scene.bearing.sphere_radius
    still = joined(second_half(tier, (0.0, 0.0, 80.0)), "force_waveform")[:, 2].mean()
    assert force[2] == pytest.approx(still, rel=0.005)


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize("force", [(0.0, 0.0, 8.0), (5.0, 20.0, 60.0), (0.0, 30.0, 1.0)])
def test_light_and_axial_loads_run(tier: str, force: Force) -> None:
    blocks = second_half(tier, force)
    for name in ("force_waveform", "body_pose", "contacts", "acceleration"):
        assert np.isfinite(joined(blocks, name)).all()
    mean = joined(blocks, "force_waveform").mean(axis=0)
    assert mean[:3] == pytest.approx(1e3 * np.array(force), abs=0.02 * 1e3 * float(np.linalg.norm(force)))


@pytest.mark.slow
def test_rollers_that_start_skewed_come_back_under_load() -> None:
    """5 mrad of skew at the start; in the load zone traction turns the rollers to their own few mrad."""
    from beardyn_core.physics.bodies import layout
    from beardyn_core.run import start

    begun = start(scene_of("full", (0.0, 0.0, 80.0)), 0.2)
    assert begun.twin._state is not None
    rollers = begun.twin._state.rollers
    rollers[:, layout.AXIS + 1] = 5e-3
    length = np.sqrt((rollers[:, layout.AXIS : layout.AXIS + 3] ** 2).sum(axis=1, keepdims=True))
    rollers[:, layout.AXIS : layout.AXIS + 3] /= length
    blocks = tuple(begun.blocks(1))
    assert not any(block.status for block in blocks)
    load = np.linalg.norm(joined(blocks[-3:], "contacts")[..., 0, 3:6], axis=-1)
    heaviest = float(np.mean([each.largest_roller_load for each in statics_of("full", (0.0, 0.0, 80.0))]))
    assert load.max(axis=(1, 2)).mean() == pytest.approx(heaviest, rel=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("tier", ["lumped", "quasistatic"])
def test_over_a_deep_spall_longer_than_the_ellipse_a_roller_carries_nothing(tier: str) -> None:
    """What is left is its centrifugal force, 1 % of the load in the healthy bearing."""
    spall = Patch(on="cup", row=0, azimuth=0.0, width=12e-3, depth=3e-4, length=20e-3)

    def load_at_the_bottom(scene: Scene) -> float:
        later = blocks_of(replace(scene, snapshot_rate=3200.0), 0.3)[1:]
        load = np.linalg.norm(joined(tuple(later), "contacts")[:, 0, :, 0, 3:6], axis=-1)
        place = joined(tuple(later), "body_pose")[:, 4 : 4 + load.shape[1], :3]
        return float(load[np.abs(np.arctan2(place[..., 0], place[..., 2])) < 0.007].mean())

    healthy = scene_of(tier, (0.0, 0.0, 8.0))
    assert load_at_the_bottom(replace(healthy, defects=(spall,))) < 0.01 * load_at_the_bottom(healthy)


def test_fewer_slices_than_an_ellipse_needs_are_refused() -> None:
    with pytest.raises(InputError, match="at least 10"):
        scene_from_mapping(
            {
                "scene": "barrels",
                "bearing": NAME,
                "lubricant": "L055",
                "numerics": {"laminae": 4},
                "operation": {"kind": "constant", "force_kN": [0, 0, 60], "speed_rpm": RPM},
            },
            "barrels",
            Path(),
        )


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        ({"end_play_mm": 0.1}, "its play is radial_clearance_mm"),
        ({"roughness": {"rib_um": 0.3}}, "it has no ribs"),
    ],
)
def test_keys_of_what_barrels_do_not_have_are_refused(keys: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        scene_from_mapping(
            {
                "scene": "barrels",
                "bearing": NAME,
                "lubricant": "L055",
                "operation": {"kind": "constant", "force_kN": [0, 0, 60], "speed_rpm": RPM},
                **keys,
            },
            "barrels",
            Path(),
        )


def test_less_clearance_is_less_deflection() -> None:
    scene = scene_of("lumped", (0.0, 0.0, 40.0))
    assert isinstance(scene.bearing, SphericalBearing)
    tight = replace(scene, bearing=replace(scene.bearing, radial_clearance=0.05e-3))
    lower = displacement_of(blocks_of(tight, 0.2)[-5:])[2]
    assert displacement_of(second_half("lumped", (0.0, 0.0, 40.0)))[2] - lower > 0.02e-3
