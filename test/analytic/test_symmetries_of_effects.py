"""Mirror images of a scene with every effect on: backwards is forwards seen in a mirror, and so are the rows.

A mirror across the axle's vertical plane (x) turns the shaft the other way round; one across the middle of
the bearing (y) swaps the rows and keeps the shaft's direction. What a mirror does is known exactly, so a
wrong sign of speed, moment or row in any effect shows.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.choice import load_scene
from beardyn_core.effects import (
    Audit,
    Cage,
    ContactDamping,
    CoulombTraction,
    Drag,
    EffectSet,
    Gravity,
    LandGuidance,
    LineFilm,
    LoadSharingTraction,
    PocketFilm,
    Rib,
    RibShearedFilm,
    RingStructure,
    RollingResistance,
    RotatingCage,
    Seal,
    SmallRib,
    Thermal,
)
from beardyn_core.physics.tiers import build
from beardyn_core.rail.build import load_history
from beardyn_core.scene.defect import Defect, MissingRoller, RollerError, WornPocket
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import ConstantOperation
from beardyn_core.scene.patch import Growth, Patch
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin
from test.kernels.rig import parameters_of

Float = NDArray[np.float64]

EVERYTHING = EffectSet(
    contact_damping=ContactDamping(),
    traction=LoadSharingTraction(),
    film=LineFilm(isoviscous=True, thermal="murch_wilson"),
    rolling_resistance=RollingResistance(hysteresis=0.007),
    drag=Drag(),
    rib=Rib(roller_end=True, drilling=True, lubrication=RibShearedFilm()),
    small_rib=SmallRib(),
    cage=Cage(lubrication=PocketFilm(), guidance=LandGuidance()),
    seal=Seal(),
    structure=RingStructure(),
    gravity=Gravity(),
    thermal=Thermal(time_scale=1e3),
    audit=Audit(),
)
DRY = EffectSet(
    contact_damping=ContactDamping(),
    traction=CoulombTraction(),
    film=LineFilm(),
    rolling_resistance=RollingResistance(kind="biboulet_houpert"),
    rib=Rib(),
    cage=RotatingCage(),
    gravity=Gravity(),
    audit=Audit(),
)
EFFECTS = {"everything": EVERYTHING, "dry": DRY}
FORCE, MOMENT, SPEED = (4e3, 3e3, 60e3), (0.0, 0.0, 50.0), 122.0
X_MIRROR, Y_MIRROR = np.array([-1.0, 1.0, 1.0]), np.array([1.0, -1.0, 1.0])


def scene_of(effects: str, tier: str) -> Scene:
    count = 17
    defects = (
        Patch("cup", 0, 0.1, 6e-3, 60e-6, 20e-3, offset=5e-3, growth=Growth(0.0, 0.03)),
        Patch("roller", 1, 0.3, 3e-3, 30e-6, 20e-3, roller=2, rim_height=2e-6, rim_width=1e-3),
        RollerError(1, 3, 2e-6),
        WornPocket(0, 5, 0.1e-3),
    )
    assert load_scene("static_80kN").bearing.roller_count == count
    return replace(
        load_scene("static_80kN", tier=tier),
        effects=EFFECTS[effects],
        operation=ConstantOperation(FORCE, SPEED, MOMENT),
        mounting=Mounting(
            journal_tilt="free", box_centre=(0.0, 0.01, 0.02), suspension_centre=(0.05, 0.02, 0.0),
            box_inertia=(4.0, 4.0, 4.0), load_offset=(0.0, 5e-3, 0.0),
        ),
        defects=defects,
        end_play=5e-5,
    )  # fmt: skip


def vector(values: tuple[float, float, float], mirror: Float) -> tuple[float, float, float]:
    x, y, z = np.asarray(values) * mirror
    return (float(x), float(y), float(z))


def mirrored(scene: Scene, mirror: Float) -> Scene:
    """The scene in a mirror: polar vectors flip along the mirror's normal, axial ones across it."""
    backwards = mirror is X_MIRROR
    operation, mounting, count = scene.operation, scene.mounting, scene.bearing.roller_count
    assert isinstance(operation, ConstantOperation)

    def number(given: int) -> int:
        return -given % count if backwards else given

    def defect(given: Defect) -> Defect:
        row = given.row if backwards else 1 - given.row
        assert not isinstance(given, FieldSpall)  # grows to one side by chance
        if isinstance(given, Patch):
            azimuth = -given.azimuth if backwards else given.azimuth
            return replace(given, row=row, azimuth=azimuth, roller=number(given.roller))
        if isinstance(given, RollerError | MissingRoller):
            return replace(given, row=row, roller=number(given.roller))
        return replace(given, row=row, pocket=number(given.pocket))

    return replace(
        scene,
        operation=ConstantOperation(
            vector(operation.force, mirror),
            -operation.speed if backwards else operation.speed,
            vector(operation.moment, -mirror),
        ),
        mounting=replace(
            mounting,
            box_centre=vector(mounting.box_centre, mirror),
            suspension_centre=vector(mounting.suspension_centre, mirror),
            load_offset=vector(mounting.load_offset, mirror),
        ),
        defects=tuple(defect(each) for each in scene.defects),
    )


def run(scene: Scene) -> tuple[Block, ...]:
    """Three blocks of a warming bearing; two of a dry one, where the cage's impacts magnify rounding."""
    twin = Twin(scene)
    blocks = 2 if scene.effects is DRY else 3
    twin.start(load_history(scene.operation, scene.mounting, 0.1, scene.seed))
    return tuple(twin.advance() for _ in range(blocks))


@contextmanager
def friction_in_every_step() -> Iterator[None]:
    """Rollers in a mirror have other neighbours, with which they decide what of their friction is held."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(build, "HELD_SAMPLES", 0.0)
        yield


@cache
def direct(effects: str, tier: str) -> tuple[Block, ...]:
    with friction_in_every_step():
        return run(scene_of(effects, tier))


CASES = [("everything", "full"), ("dry", "full"), ("dry", "quasistatic"), ("dry", "lumped")]


@pytest.mark.parametrize("mirror", [X_MIRROR, Y_MIRROR], ids=["backwards", "rows swapped"])
@pytest.mark.parametrize(("effects", "tier"), CASES)
def test_a_scene_in_a_mirror_runs_as_its_mirror_image(effects: str, tier: str, mirror: Float) -> None:
    backwards = mirror is X_MIRROR
    here = direct(effects, tier)
    with friction_in_every_step():
        there = run(mirrored(scene_of(effects, tier), mirror))
    wrench = np.concatenate([mirror, -mirror])
    turn = -1.0 if backwards else 1.0
    count = here[0].contacts.shape[2]
    rollers = -np.arange(count) % count if backwards else np.arange(count)
    for one, other in zip(here, there, strict=True):
        assert one.status == other.status == 0
        if not len(one.force):  # the filters hold the first samples back
            continue
        scale = np.abs(one.force[:, :3]).max()
        # stiff pockets in an explicit step make 1e-8 m of rounding in 20 ms; a wrong sign makes more
        tolerance = 2e-3 if tier == "quasistatic" else 1e-6
        np.testing.assert_allclose(other.force * wrench, one.force, rtol=0.0, atol=tolerance * scale)
        np.testing.assert_allclose(
            turn * other.shaft_torque,
            one.shaft_torque,
            rtol=0.0,
            atol=tolerance * np.abs(one.shaft_torque).max(),
        )
        cages = other.cage_speed if backwards else other.cage_speed[:, ::-1]
        np.testing.assert_allclose(turn * cages, one.cage_speed, rtol=tolerance)
        place, image = one.body_pose[:, :2, :3], other.body_pose[:, :2, :3] * mirror
        np.testing.assert_allclose(image, place, rtol=0.0, atol=tolerance * np.abs(place).max())
        contacts = other.contacts if backwards else other.contacts[:, ::-1]
        contacts = contacts[:, :, rollers]
        np.testing.assert_allclose(
            contacts[..., 3:6] * mirror, one.contacts[..., 3:6], rtol=0.0, atol=tolerance * scale
        )
        # rounding grows fastest in the slip of rollers that hardly carry; they slide with metres a second
        pressed = np.linalg.norm(one.contacts[..., 3:6], axis=-1) > 1.0
        np.testing.assert_allclose(contacts[pressed, 6], one.contacts[pressed, 6], rtol=0.0, atol=2e-3)
        if one.temperature is not None:
            assert other.temperature is not None
            np.testing.assert_allclose(other.temperature, one.temperature, rtol=1e-9)


def test_repeated_runs_have_the_same_bits() -> None:
    """Memory comes at four places in turn: a table read beyond its end showed in every fourth run."""
    first, *others = (run(scene_of("everything", "full")) for _ in range(5))
    for other in others:
        for one, again in zip(first, other, strict=True):
            np.testing.assert_array_equal(again.force_waveform, one.force_waveform)


def test_tables_of_films_have_a_column_for_every_spring_of_a_damaged_contact() -> None:
    scene = scene_of("everything", "full")
    effects = parameters_of(scene).effects
    assert effects.faults.cup_damage is not None
    assert effects.film is not None
    assert effects.film.rigid is not None
    assert effects.load_sharing is not None
    assert effects.load_sharing.aihara is not None
    springs = effects.faults.cup_damage.laminae.shape[1]
    assert springs == 2 * scene.numerics.laminae
    assert effects.film.rigid.log2_factor.shape == (2, springs)
    assert effects.load_sharing.aihara.log2_pressure.shape == (2, springs)


def test_what_the_mirrors_compare_is_not_symmetric_by_itself() -> None:
    block = direct("everything", "full")[-1]
    assert np.abs(block.force[:, 0]).min() > 1e3
    assert np.abs(block.contacts[:, 0, :, 0, 3:6] - block.contacts[:, 1, :, 0, 3:6]).max() > 100.0
