"""Each kind of cage and each of its options in whole runs: pairs of forces, energy, absence, stability."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.choice import load_scene
from beardyn_core.effects import Cage, CageModel, KinematicCage, LandGuidance, PocketFilm, RotatingCage
from beardyn_core.physics.bodies.layout import (
    CAGE_BODY,
    CHANGE,
    CUP_BODY,
    ENERGY_LOST,
    LOSS_LAND,
    LOSS_POCKET,
    POCKET,
    POSITION,
)
from beardyn_core.physics.cage.parameters import cage_params
from beardyn_core.physics.tiers.build import build_parameters
from beardyn_core.physics.tiers.status import Status
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.effects.fresh_kernels import run_afresh
from test.kernels.momentum import momenta
from test.kernels.rig import Rig
from test.kernels.states import shaken
from test.runs import advance_blocks, constant_load, started
from test.scenes import LOAD_80_KN, SPEED, scene_with

pytestmark = pytest.mark.slow

CAGES: dict[str, CageModel] = {
    "dry": Cage(),
    "lubricated": Cage(lubrication=PocketFilm()),
    "on the cup": Cage(guidance=LandGuidance(clearance=5e-5)),
    "lubricated on the cone": Cage(
        lubrication=PocketFilm(), guidance=LandGuidance(on="cone", clearance=5e-5)
    ),
    "rotating": RotatingCage(),
    "kinematic": KinematicCage(),
}


def scene_of(cage: CageModel, **changes: Any) -> Scene:
    scene = scene_with(**changes)
    return replace(scene, effects=replace(scene.effects, cage=cage))


def with_pocket(scene: Scene, clearance: float) -> Scene:
    cage = replace(scene.bearing.cage, circumferential_clearance=clearance)
    # a pocket without play is refused unless the bearing is forced
    return replace(scene, bearing=replace(scene.bearing, cage=cage, forced=clearance == 0.0))


@cache
def blocks(kind: str) -> tuple[Block, ...]:
    return advance_blocks(scene_of(CAGES[kind]), constant_load(LOAD_80_KN, SPEED), 25)


def until_it_ends(twin: Twin, count: int) -> list[Block]:
    """Blocks up to the one in which the model leaves its range."""
    found: list[Block] = []
    try:
        while len(found) < count:
            found.append(twin.advance())
    except ValidityError as error:
        if not isinstance(error.block, Block):
            raise
        found.append(error.block)
    return found


def load_over_azimuth(found: tuple[Block, ...]) -> Any:
    """Mean cup load by azimuth in 24 sectors and row, after 0.2 s; NaN where nobody was, [N]."""
    contacts = np.concatenate([block.contacts for block in found[10:]])[..., 0, :]
    load = np.linalg.norm(contacts[..., 3:6], axis=-1)
    angle = np.arctan2(contacts[..., 0], contacts[..., 2])
    sector = np.floor((angle + np.pi) / (2.0 * np.pi) * 24.0).astype(int) % 24
    return np.array([[load[:, row][sector[:, row] == k].mean() for k in range(24)] for row in range(2)])


def mean(found: tuple[Block, ...], name: str) -> Any:
    return np.concatenate([getattr(block, name) for block in found[10:]]).mean(axis=0)


@pytest.mark.parametrize("kind", CAGES)
def test_momentum_is_exchanged_in_pairs(kind: str) -> None:
    """As in test_momentum_pairs: what the rollers win, cup, cone and cages lose, to rounding."""
    rig = shaken(11)
    scene = scene_of(CAGES[kind])
    p = build_parameters(scene, rig.arrangement, np.zeros(6))
    cage = p.effects.cage
    assert cage is not None
    # a cage that follows the rings hands its weight on, which is no pair
    cage = cage._replace(mass=0.0) if cage.rotating or cage.kinematic else cage
    rig.parameters = p._replace(effects=p.effects._replace(cage=cage, gravity=None))
    linear_before, angular_before, size = momenta(rig)
    rig.run(1)
    linear_after, angular_after, _ = momenta(rig)
    wrenches, bodies = rig.work.wrenches, rig.state.bodies
    force, moment = np.zeros(3), np.zeros(3)
    for body in range(4):
        lift = np.array([0.0, cage.place * (1.0 if body == 3 else -1.0), 0.0])
        place = bodies[body, POSITION : POSITION + 3] + (lift if body >= CAGE_BODY else 0.0)
        force += wrenches[body, :3]
        moment += wrenches[body, 3:] + np.cross(place, wrenches[body, :3])
    assert np.abs(wrenches[CAGE_BODY:]).max() > 0.01
    assert np.abs(linear_after - linear_before + p.step * force).max() < 1e-12 * size
    assert np.abs(angular_after - angular_before + p.step * moment).max() < 1e-13 * size
    assert not np.any(bodies[CUP_BODY, :CHANGE])


@pytest.mark.parametrize("kind", CAGES)
def test_energy_balance_closes(kind: str) -> None:
    """Half a second at 80 kN from an even start: the residual at the production step stays below 0.02 %."""
    audit = blocks(kind)[-1].audit
    assert audit is not None
    assert audit.residual < 2e-4
    assert all(block.status == 0 for block in blocks(kind))


@pytest.mark.parametrize("kind", CAGES)
def test_cage_turns_with_the_epicyclic_speed_under_load(kind: str) -> None:
    """Harris and Kotzalas (2006), ch. 10; ADORE's claim is 0.2 % under load, 0.5 % here as in the anchors."""
    scene = scene_of(CAGES[kind])
    np.testing.assert_allclose(mean(blocks(kind), "cage_speed"), cage_speed(scene.bearing, SPEED), rtol=5e-3)


@pytest.mark.parametrize("kind", [kind for kind in CAGES if kind != "dry"])
def test_roller_loads_are_those_of_the_free_cage(kind: str) -> None:
    """At 80 kN a cage decides nothing: loads by azimuth within 1 % of the heaviest."""
    expected, found = load_over_azimuth(blocks("dry")), load_over_azimuth(blocks(kind))
    assert np.nanmax(expected) > 8e3
    assert np.nanmax(np.abs(found - expected)) < 0.01 * np.nanmax(expected)


def test_kinematic_cage_holds_every_roller_near_its_pocket() -> None:
    scene = scene_of(KinematicCage())
    last = blocks("kinematic")[-1]
    pocket = last.cage_angle[-1][:, None] + 2.0 * np.pi * np.arange(17) / 17
    away = (last.roller_angle[-1] - pocket + np.pi) % (2.0 * np.pi) - np.pi
    assert np.abs(away).max() * 0.5 * scene.bearing.pitch_diameter < 1e-3
    assert np.ptp(last.cage_speed) == 0.0


def test_cages_that_follow_the_rings_stand_between_them() -> None:
    for kind in ("rotating", "kinematic"):
        pose = blocks(kind)[-1].body_pose
        middle = 0.5 * (pose[:, 0, :3] + pose[:, 1, :3])
        np.testing.assert_allclose(
            pose[:, 2:4, [0, 2]], np.repeat(middle[:, None, [0, 2]], 2, axis=1), atol=1e-8
        )


def rig_of(cage: CageModel, **members: Any) -> Rig:
    rig = Rig.at_equilibrium(scene_of(cage), cage_ratio=0.98)
    effects = rig.parameters.effects
    assert effects.cage is not None
    rig.parameters = rig.parameters._replace(effects=effects._replace(cage=effects.cage._replace(**members)))
    return rig


def test_options_and_kinds_that_are_absent_leave_no_code() -> None:
    """Compiled afresh: what a cage does without, its step does not contain."""
    sizes = {}
    for kind in ("dry", "lubricated", "on the cup", "rotating", "kinematic"):
        sizes[kind] = run_afresh(scene_of(CAGES[kind]), 2).instructions
    assert sizes["kinematic"] < sizes["rotating"] < sizes["dry"]
    assert sizes["dry"] < sizes["lubricated"]
    assert sizes["dry"] < sizes["on the cup"]


def test_film_without_viscosity_is_no_film() -> None:
    """Cages 2 % too slow, so that every pocket works: the same motion to 1e-12 of the load over 5 ms."""
    film = rig_of(CAGES["lubricated"]).parameters.effects.cage.film  # type: ignore[union-attr]
    assert film is not None
    zero = rig_of(CAGES["lubricated"], film=film._replace(wedge=0.0, squeeze=0.0, shear=0.0))
    absent = rig_of(CAGES["dry"])
    found, expected = zero.run(512)[0], absent.run(512)[0]
    np.testing.assert_allclose(found[:, :6], expected[:, :6], atol=1e-12 * 8e4 * 100)
    np.testing.assert_allclose(zero.state.bodies, absent.state.bodies, rtol=1e-9, atol=1e-12)
    assert zero.state.energy[ENERGY_LOST + LOSS_POCKET] > 1e-3


def test_land_without_viscosity_in_a_wide_ring_is_no_land() -> None:
    land = rig_of(CAGES["on the cup"]).parameters.effects.cage.land  # type: ignore[union-attr]
    assert land is not None
    zero = rig_of(CAGES["on the cup"], land=land._replace(film=0.0, drag=0.0, clearance=1.0))
    absent = rig_of(CAGES["dry"])
    found, expected = zero.run(512)[0], absent.run(512)[0]
    np.testing.assert_allclose(found[:, :6], expected[:, :6], atol=1e-12 * 8e4 * 100)
    assert zero.state.energy[ENERGY_LOST + LOSS_LAND] == 0.0


def test_no_wear_is_the_cage_as_it_was_and_wear_lets_it_swing_further() -> None:
    assert scene_of(Cage(pocket_wear=0.0)).effects == scene_of(Cage()).effects
    worn = started(scene_of(Cage(pocket_wear=3e-4)), constant_load(LOAD_80_KN, SPEED))
    found = tuple(worn.advance() for _ in range(25))

    def swing(run: tuple[Block, ...]) -> float:
        centre = np.concatenate([block.body_pose[:, 2:4, [0, 2]] for block in run[10:]])
        return float(np.abs(centre).max())

    assert swing(found) > 1.5 * swing(blocks("dry"))


@pytest.mark.parametrize("clearance", [0.0, 2e-3])
@pytest.mark.parametrize("kind", ["dry", "lubricated", "rotating"])
def test_pocket_without_play_and_with_far_too_much_stays_stable(kind: str, clearance: float) -> None:
    """All 34 pockets pressed on both bars at once, or 2 mm apart.

    From some 1 mm of play on an unloaded roller is thrown on its rib beyond the edge sooner or later, which
    ends a run with its sentence; numbers and energy balance are sound up to then.
    """
    twin = started(with_pocket(scene_of(CAGES[kind]), clearance), constant_load(LOAD_80_KN, SPEED))
    found = until_it_ends(twin, 15)
    assert clearance > 0.0 or len(found) == 15
    audit = found[-1].audit
    assert audit is not None
    assert audit.residual < 1e-3
    assert all(block.status & ~(Status.OFF_RIB if clearance > 0.0 else 0) == 0 for block in found)
    pocket = np.concatenate([block.contacts for block in found])[..., POCKET, 3:6]
    assert np.linalg.norm(pocket, axis=-1).max() < 5e3


def test_lands_lose_energy_and_guide_the_cage() -> None:
    centre = np.concatenate([block.body_pose[:, 2:4, [0, 2]] for block in blocks("on the cup")[10:]])
    free = np.concatenate([block.body_pose[:, 2:4, [0, 2]] for block in blocks("dry")[10:]])
    assert np.hypot(*np.moveaxis(centre, -1, 0)).max() < 0.9 * np.hypot(*np.moveaxis(free, -1, 0)).max()
    rig = rig_of(CAGES["on the cup"])
    rig.run(512)
    assert rig.state.energy[ENERGY_LOST + LOSS_LAND] > 0.0


@pytest.mark.parametrize("temperature", [213.15, 233.15, 343.15])
def test_land_film_of_cold_lubricant_stays_within_what_an_explicit_cage_follows(temperature: float) -> None:
    scene = replace(load_scene("static_5kN"), temperature=temperature)
    scene = replace(scene, effects=replace(scene.effects, cage=Cage(guidance=LandGuidance())))
    step = 1e-5
    cage = cage_params(scene, step)
    assert cage is not None
    assert cage.land is not None
    land, ring = cage.land, scene.bearing.cage
    assert math.pi * land.film / land.clearance * step < 0.5 * ring.mass
    assert land.drag * step < 0.5 * ring.polar_inertia
    assert 0.0 < land.most_eccentric <= 0.99
