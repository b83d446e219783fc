"""Runs of cylindrical roller bearings against their statics, their kinematics and what they must not do."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.physics.statics.initial_equilibrium import weight_on_cone
from beardyn_core.physics.statics.static import StaticSolution, solve
from beardyn_core.physics.suspension import mounting_params, tilt_restraint
from beardyn_core.physics.tiers.status import is_fatal
from beardyn_core.physics.tiers.tiers import spring_laminae
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from test.runs import blocks_of
from test.tiers.steady import Force, steady_scene

TIERS = ("lumped", "quasistatic", "full")
FAST = TIERS[:2]
NAME = "WJ130x240"
RPM = 600.0
SPEED = RPM * math.pi / 30.0
PHASES = 8


@cache
def scene_of(tier: str, force: Force, tilt: str = "locked") -> Scene:
    """A pair under a steady load, the cup held, with the standard effects."""
    return steady_scene(NAME, tier, force, RPM, tilt, numerics={"laminae": 8})


@cache
def second_half(tier: str, force: Force, tilt: str = "locked", duration: float = 0.4) -> tuple[Block, ...]:
    blocks = blocks_of(scene_of(tier, force, tilt), duration)
    assert not any(block.status for block in blocks)
    return blocks[len(blocks) // 2 :]


def joined(blocks: tuple[Block, ...], name: str) -> np.ndarray[Any, Any]:
    return np.concatenate([getattr(block, name) for block in blocks])


@cache
def statics_of(tier: str, force: Force, tilt: str = "locked") -> tuple[StaticSolution, ...]:
    """Equilibria over the places that rollers pass through."""
    scene = scene_of(tier, force, tilt)
    laminae = spring_laminae(scene) if tier == "lumped" else scene.numerics.laminae
    restraint = tilt_restraint(scene.mounting, mounting_params(scene.bearing, scene.mounting, np.zeros(6)))
    return tuple(
        solve(
            scene.bearing,
            [1e3 * each for each in force],
            end_play=scene.end_play,
            tilt=tilt,
            laminae=laminae,
            speed=SPEED,
            roller_phase=float(phase),
            tilt_stiffness=restraint,
        )
        for phase in np.arange(PHASES) / PHASES * 2.0 * math.pi / scene.bearing.roller_count
    )


def of_statics(tier: str, force: Force, tilt: str) -> tuple[np.ndarray[Any, Any], float, float]:
    """Mean displacement [m], largest load of a raceway and sum of the loads of the cone's ribs [N]."""
    found = statics_of(tier, force, tilt)
    return (
        np.asarray(np.mean([each.displacement for each in found], axis=0)),
        float(np.mean([each.largest_roller_load for each in found])),
        float(np.mean([each.rib_load.sum() for each in found])),
    )


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize(
    ("force", "tilt"),
    [((0.0, 0.0, 80.0), "locked"), ((0.0, 5.0, 80.0), "locked"), ((0.0, -8.0, 60.0), "free")],
)
def test_a_steady_run_has_load_and_deflection_of_the_statics(tier: str, force: Force, tilt: str) -> None:
    """Within 1 %: mean force on the cup, displacement, largest roller load, and what the ribs carry."""
    blocks = second_half(tier, force, tilt)
    displacement, heaviest, _ = of_statics(tier, force, tilt)
    pose = joined(blocks, "body_pose")
    moved = (pose[:, 1, :3] - pose[:, 0, :3]).mean(axis=0)
    # without thrust nothing holds the axle within its float, in which it may creep
    scale = float(np.linalg.norm(displacement)) if force[1] else scene_of(tier, force, tilt).end_play
    assert moved[1] == pytest.approx(displacement[1], abs=0.01 * scale)
    assert moved[2] == pytest.approx(displacement[2], rel=0.01)
    contacts = joined(blocks, "contacts")
    load = np.linalg.norm(contacts[..., 0, 3:6], axis=-1)
    assert load.max(axis=(1, 2)).mean() == pytest.approx(heaviest, rel=0.01)
    mean = joined(blocks, "force_waveform").mean(axis=0)
    assert mean[1] == pytest.approx(1e3 * force[1], abs=0.01 * 1e3 * force[2])
    assert mean[2] == pytest.approx(1e3 * force[2], rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize("axial", [5.0, -5.0])
def test_thrust_goes_through_the_rib_of_one_row_either_way(tier: str, axial: float) -> None:
    """The rib of the inner ring is at the outer ends: thrust outwards in one row comes from the other."""
    force = (0.0, axial, 80.0)
    ribs = joined(second_half(tier, force), "contacts")[:, :, :, 2]
    load = np.linalg.norm(ribs[..., 3:6], axis=-1)
    # of the inner ring, at every roller and every instant: those of the outer ring push the other way
    assert (np.sign(axial) * ribs[..., 4] > -1e-9).all()
    pushing, idle = (0, 1) if axial > 0.0 else (1, 0)
    assert load[:, pushing].sum(axis=-1).mean() == pytest.approx(1e3 * abs(axial), rel=0.02)
    assert load[:, idle].sum(axis=-1).mean() < 0.05 * 1e3 * abs(axial)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("force", "within"),
    [((0.0, 24.0, 40.0), 0.015), ((0.0, 32.0, 80.0), 0.01), ((0.0, 3.0, 1.0), 0.25)],
    ids=["more than catalogues allow", "as much as they allow", "three times the load"],
)
def test_thrust_lifts_the_axle_in_the_lumped_tier_too(force: Force, within: float) -> None:
    """Leaning rollers press their raceways: without that the last is off five times, the first 3 %."""
    blocks = second_half("lumped", force, duration=0.12)
    displacement, heaviest, _ = of_statics("lumped", force, "locked")
    pose = joined(blocks, "body_pose")
    assert (pose[:, 1, 2] - pose[:, 0, 2]).mean() == pytest.approx(displacement[2], rel=within)
    load = np.linalg.norm(joined(blocks, "contacts")[..., 0, 3:6], axis=-1)
    assert load.max(axis=(1, 2)).mean() == pytest.approx(heaviest, rel=max(0.05, within))


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
@pytest.mark.parametrize(
    "force", [(0.0, 0.5, 1.0), (0.0, 1.0, 0.5), (5.0, 20.0, 60.0), (0.0, 60.0, 20.0), (0.0, 20.0, 1.0)]
)
def test_light_loads_and_thrust_beyond_the_limit_run(tier: str, force: Force) -> None:
    """Rollers tip and bear on the edges of ribs, which the status says; forces stay in balance."""
    scene = scene_of(tier, force)
    blocks = blocks_of(scene, 0.3)
    assert not any(is_fatal(block.status) for block in blocks)
    later = blocks[len(blocks) // 2 :]
    for name in ("force_waveform", "body_pose", "contacts"):
        assert np.isfinite(joined(later, name)).all()
    carried = 1e3 * np.array(force) - np.array([0.0, 0.0, weight_on_cone(scene)])
    mean = joined(later, "force_waveform").mean(axis=0)[:3]
    assert mean == pytest.approx(carried, abs=0.02 * 1e3 * float(np.linalg.norm(force)))


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
def test_cages_and_rollers_turn_as_pure_rolling_has_it(tier: str) -> None:
    blocks = second_half(tier, (0.0, 0.0, 80.0))
    frequencies = fault_frequencies(scene_of(tier, (0.0, 0.0, 80.0)).bearing)
    ratio = joined(blocks, "cage_speed").mean(axis=0) / (frequencies.ftf * SPEED)
    # rollers leave the load zone ahead of their pockets, so that a cage is slower by the play of these
    assert ratio == pytest.approx(1.0, abs=0.006)
    assert ratio.max() <= 1.0 + 1e-9
    twist = joined(blocks, "body_twist")[:, 4:]
    spin = np.abs(twist[..., 4] - ratio.mean() * frequencies.ftf * SPEED)
    heavy = np.linalg.norm(joined(blocks, "contacts")[..., 1, 3:6], axis=-1).reshape(len(spin), -1) > 5e3
    assert spin[heavy].mean() == pytest.approx(frequencies.bsf * SPEED, rel=0.005)


@pytest.mark.slow
@pytest.mark.parametrize("tier", FAST)
def test_rollers_that_pass_shake_the_cup_at_bpfo(tier: str) -> None:
    blocks = second_half(tier, (0.0, 0.0, 80.0), duration=0.8)
    force = joined(blocks, "force_waveform")[:, 2]
    spectrum = np.abs(np.fft.rfft((force - force.mean()) * np.hanning(len(force))))
    hertz = np.fft.rfftfreq(len(force), 1.0 / 25_600.0)
    low = hertz < 300.0
    loudest = hertz[low][np.argmax(spectrum[low])]
    cage = joined(blocks, "cage_speed").mean() / (2.0 * math.pi)
    passing = 17.0 * cage
    order = loudest / passing
    assert order == pytest.approx(round(order), abs=0.05)
    assert round(order) >= 1


@pytest.mark.slow
def test_the_full_tier_keeps_its_energy_and_its_momentum() -> None:
    """Energy within 1e-4 of what is dissipated; axial force on the cup is that of the journal."""
    blocks = second_half("full", (0.0, 5.0, 80.0))
    audit = blocks[-1].audit
    assert audit is not None
    assert audit.residual < 1e-4
    assert joined(blocks, "force_waveform")[:, 1].mean() == pytest.approx(5e3, rel=0.01)


def test_an_axle_without_thrust_floats_between_its_ribs() -> None:
    blocks = second_half("lumped", (0.0, 0.0, 80.0))
    pose = joined(blocks, "body_pose")
    bearing = scene_of("lumped", (0.0, 0.0, 80.0)).bearing
    assert isinstance(bearing, CylindricalBearing)
    assert np.abs(pose[:, 1, 1] - pose[:, 0, 1]).max() < 0.5 * bearing.end_play


def test_a_pair_without_ribs_of_the_inner_ring_carries_no_thrust() -> None:
    scene = scene_of("lumped", (0.0, 5.0, 80.0))
    assert isinstance(scene.bearing, CylindricalBearing)
    bearing = replace(scene.bearing, cone_ribs="none")
    with pytest.raises(InputError, match="carries no axial load"):
        blocks_of(replace(scene, bearing=bearing), 0.02)


@pytest.mark.slow
@pytest.mark.parametrize("axial", [6.0, -6.0])
def test_a_single_row_between_two_ribs_of_its_inner_ring_carries_thrust_either_way(axial: float) -> None:
    scene = scene_of("lumped", (0.0, axial, 40.0))
    assert isinstance(scene.bearing, CylindricalBearing)
    scene = replace(scene, bearing=replace(scene.bearing, cone_ribs="both"), rows=1)
    force = joined(blocks_of(scene, 0.2)[-5:], "force_waveform")[:, 1]
    assert force.mean() == pytest.approx(1e3 * axial, rel=0.05)


@pytest.mark.parametrize(("cup_ribs", "way"), [("outer", -1.0), ("inner", 1.0)])
def test_a_single_row_between_a_rib_of_either_ring_carries_thrust_one_way(cup_ribs: str, way: float) -> None:
    """A rib of the inner ring holds with one of the outer ring at the other end of the rollers."""
    scene = scene_of("lumped", (0.0, 6.0 * way, 40.0))
    assert isinstance(scene.bearing, CylindricalBearing)
    assert replace(scene.bearing, cone_ribs="both").row_is_held
    bearing = replace(scene.bearing, cone_ribs="both", cup_ribs=cup_ribs)
    assert not bearing.row_is_held
    force = joined(blocks_of(replace(scene, bearing=bearing, rows=1), 0.2)[-5:], "force_waveform")[:, 1]
    assert force.mean() == pytest.approx(6e3 * way, rel=0.05)
    other = scene_of("lumped", (0.0, -6.0 * way, 40.0))
    with pytest.raises(ValidityError, match=r"6000 N push the axle towards .*cup_ribs") as refused:
        blocks_of(replace(other, bearing=bearing, rows=1), 0.02)
    assert ("towards +y" if way < 0.0 else "towards -y") in str(refused.value)


def test_a_single_row_without_ribs_of_the_outer_ring_carries_no_thrust() -> None:
    scene = scene_of("lumped", (0.0, -6.0, 40.0))
    assert isinstance(scene.bearing, CylindricalBearing)
    bearing = replace(scene.bearing, cone_ribs="both", cup_ribs="none")
    with pytest.raises(InputError, match="carries no axial load"):
        blocks_of(replace(scene, bearing=bearing, rows=1), 0.02)
