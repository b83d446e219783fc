"""Rollers of the fast tiers against the slow exact equilibrium of `physics.statics.roller_equilibrium`."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.physics.bodies.layout import CAGE_BODY, CONE_BODY, CUP_BODY, POSITION, TILT, TURN
from beardyn_core.physics.statics.roller_contacts import ConePose, contact_model
from beardyn_core.physics.statics.roller_equilibrium import (
    RollerState,
    load_of_approach,
    solve_rollers,
    spring_params,
)
from beardyn_core.physics.statics.static import _rotation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Waviness
from beardyn_core.sensors.block import LARGEST, Block
from beardyn_core.twin import Twin
from test.runs import constant_load
from test.tiers.runs import Float, heavy, scene_of

POSES = [
    ((0.0, 0.0, 2e-5), (0.0, 0.0)),
    ((8e-6, 3e-5, 1.5e-5), (0.0, 0.0)),
    ((-1e-5, -6e-5, 2.5e-5), (1e-4, -2e-4)),
]


def held(
    scene: Scene, pose: tuple[float, ...], tilt: tuple[float, ...], speed: float, blocks: int
) -> tuple[Block, Twin]:
    """Last block of a run with the cone held at a pose, and the twin after it."""
    twin = Twin(heavy(scene))
    twin.start(constant_load((0.0, 0.0, 1e4), speed))
    assert twin._state is not None
    bodies = twin._state.bodies
    bodies[CONE_BODY, POSITION : POSITION + 3] = pose
    bodies[CONE_BODY, [TILT, TILT + 2]] = tilt
    bodies[CUP_BODY, POSITION : POSITION + 3] = 0.0
    return [twin.advance() for _ in range(blocks)][-1], twin


def exact(
    scene: Scene, pose: tuple[float, ...], tilt: tuple[float, ...], speed: float, phase: float
) -> RollerState:
    """Rollers in balance at a pose, as the static solution sees them."""
    model = contact_model(scene.bearing, scene.end_play, scene.numerics.laminae, speed, phase)
    return solve_rollers(model, ConePose(np.array(pose), _rotation(*tilt)), None)


def loads(block: Block, kind: int) -> Float:
    """Loads of one kind of contact at the end of a block, shape [row, roller]."""
    return np.asarray(np.linalg.norm(block.contacts[-1, :, :, kind, 3:6], axis=-1))


@pytest.mark.parametrize(("pose", "tilt"), POSES)
def test_newton_steps_of_the_kernel_reach_the_exact_equilibrium(
    pose: tuple[float, ...], tilt: tuple[float, ...]
) -> None:
    scene = scene_of("static_80kN", "quasistatic")
    block, _ = held(scene, pose, tilt, 0.0, 2)
    reference = exact(scene, pose, tilt, 0.0, 0.0)
    for kind, contact in enumerate((reference.cup, reference.cone, reference.rib)):
        expected = contact.force.sum(axis=-1)
        np.testing.assert_allclose(loads(block, kind), expected, rtol=1e-6, atol=1e-6 * expected.max())


def test_rollers_follow_the_turning_cage_in_balance() -> None:
    """One Newton step a time step: the load of a roller stays within 0.1 % of the largest exact one."""
    scene, (pose, tilt), speed = scene_of("static_80kN", "quasistatic"), POSES[2], 122.0
    block, twin = held(scene, pose, tilt, speed, 3)
    assert twin._state is not None
    reference = exact(scene, pose, tilt, speed, float(twin._state.bodies[CAGE_BODY, TURN]))
    for kind, contact in enumerate((reference.cup, reference.cone, reference.rib)):
        expected = contact.force.sum(axis=-1)
        np.testing.assert_allclose(loads(block, kind), expected, atol=1e-3 * expected.max())


def test_a_tilt_of_the_kernel_is_the_tilt_of_the_exact_equilibrium() -> None:
    scene, (pose, tilt) = scene_of("static_80kN", "quasistatic"), POSES[2]
    _, twin = held(scene, pose, tilt, 0.0, 2)
    assert twin._state is not None
    fields = twin._arrangement.to_rollers(np.moveaxis(twin._state.rollers, 1, 0))
    found = np.arctan2(fields[6], fields[8]) - scene.bearing.contact_angle
    reference = exact(scene, pose, tilt, 0.0, 0.0)
    pressed = reference.cone.force.sum(axis=-1) > 100.0
    assert pressed.sum() > 10
    np.testing.assert_allclose(found[pressed], reference.position[..., 2][pressed], atol=1e-9)


@pytest.mark.parametrize("on", ["cup", "cone", "roller"])
def test_crests_of_waves_press_rollers_that_the_round_rings_would_not_touch(on: str) -> None:
    """A roller that leaves the load zone lets go of it crest by crest, not at once."""
    size, apart, turning = 2e-6, 1e-6, 10.0
    scene = replace(
        scene_of("static_80kN", "lumped"), end_play=1e-4, waviness=(Waviness(on, 0, (40,), (size,)),)
    )
    place = (scene.bearing.normal_gap(scene.end_play) - apart) / math.cos(scene.bearing.cup_angle)
    found = {}
    for waves in (scene.waviness, ()):
        _, twin = held(replace(scene, waviness=waves), (0.0, 0.0, place), (0.0, 0.0), turning, 1)
        contacts = np.concatenate([twin.advance().contacts for _ in range(15)])
        found[waves] = contacts[..., 0, LARGEST].max(axis=(0, 2))
    share = spring_params(scene.bearing, scene.numerics.laminae).cone_share
    crest = size * {"cup": 1.0, "cone": share, "roller": 1.0 + share}[on]
    approach, load = load_of_approach(scene.bearing, 20)
    np.testing.assert_allclose(found[()], 0.0, atol=1.0)
    np.testing.assert_allclose(
        found[scene.waviness],
        [np.interp(crest - apart, approach[::-1], load[::-1]), 0.0],
        rtol=0.05,
        atol=1.0,
    )


# With a profile the contact grows from the middle lamina by lamina, which no short series follows.
FIT = {"straight": 1e-5, "crowned": 0.04, "logarithmic": 0.04}


@pytest.mark.parametrize("kind", FIT)
def test_spring_of_a_roller_is_its_equilibrium_between_the_rings(kind: str) -> None:
    """From 100 N upwards; what the fit leaves below is of no weight in any load distribution."""
    bearing = scene_of("static_80kN", "lumped").bearing
    assert isinstance(bearing, Bearing)
    bearing = replace(bearing, profile=replace(bearing.profile, kind=kind, drop=5e-6, design_pressure=3e9))
    approach, load = load_of_approach(bearing, 20)
    root = approach ** (1.0 / 9.0)
    fitted = approach * root * np.polyval(spring_params(bearing, 20).series[::-1], root)
    judged = load > 100.0
    assert judged.sum() >= 12
    np.testing.assert_allclose(fitted[judged], load[judged], rtol=FIT[kind])


@pytest.mark.parametrize("laminae", [1, 2, 4])
def test_a_crown_that_few_laminae_hardly_see_still_has_a_spring(laminae: int) -> None:
    """A single lamina has the mean drop: light loads find no contact at all, and the spring none either."""
    bearing = scene_of("static_80kN", "lumped").bearing
    assert isinstance(bearing, Bearing)
    bearing = replace(bearing, profile=replace(bearing.profile, kind="logarithmic", design_pressure=1.5e9))
    approach, load = load_of_approach(bearing, laminae)
    assert (load == 0.0).any()
    root = approach ** (1.0 / 9.0)
    fitted = approach * root * np.polyval(spring_params(bearing, laminae).series[::-1], root)
    np.testing.assert_allclose(np.maximum(fitted, 0.0), load, rtol=0.13, atol=2e-3 * load.max())


def test_without_profile_and_rib_compliance_two_line_contacts_are_in_series() -> None:
    """ISO/TS 16281: the spring of a roller between two raceways is 2^(10/9) softer than one contact."""
    bearing = scene_of("static_80kN", "lumped").bearing
    approach, load = load_of_approach(bearing, 6)
    one = line_contact_factor(bearing.material, bearing.effective_length)
    series = one * (0.5 * approach) ** (10.0 / 9.0)
    assert np.all(load < series)
    np.testing.assert_allclose(load[approach > 2e-5], series[approach > 2e-5], rtol=0.06)
