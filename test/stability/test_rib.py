"""A rib at and beyond its limits: edges carry, impossible spheres are survived when forced."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest

from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet, Rib
from beardyn_core.physics.tiers.status import Status, describe
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from test.runs import constant_load, started
from test.scenes import SPEED, scene_with, tapered

pytestmark = pytest.mark.slow


def forced(rib: Rib, **change: Any) -> Scene:
    scene = scene_with(replace(EffectSet(), rib=rib))
    bearing: Bearing = replace(tapered(scene), forced=True, **change)
    return replace(scene, bearing=bearing)


def blocks_of(scene: Scene, force: tuple[float, float, float], count: int) -> tuple[list[Block], str]:
    """Blocks of a run, and the sentence it ended with, if it did."""
    twin = started(scene, constant_load(force, SPEED))
    blocks: list[Block] = []
    try:
        for _ in range(count):
            blocks += [twin.advance()]
    except ValidityError as error:
        return [*blocks, cast(Block, error.block)], str(error)
    return blocks, ""


def finite(blocks: list[Block]) -> None:
    for block in blocks:
        for name in ("force_waveform", "shaft_torque", "cage_speed", "roller_speed", "body_pose", "contacts"):
            assert np.isfinite(getattr(block, name)).all(), name
        assert not Status(block.status) & Status.NOT_FINITE


@pytest.mark.parametrize("height", [0.6e-3, 5.4e-3], ids=["undercut", "corner"])
def test_edge_of_the_rib_carries_when_the_sphere_misses_the_face(height: float) -> None:
    """Contact 0.4 mm beyond either end of the face: the same thrust, a status that says so, no end."""
    force = (0.0, 1.5e4, 8e4)
    blocks, ended = blocks_of(forced(Rib(), rib_contact_height=height), force, 6)
    finite(blocks)
    assert ended == ""
    assert blocks[-1].status & Status.RIB_EDGE
    assert "edge of its rib" in describe(blocks[-1].status)
    assert blocks[-1].force[:, 1].mean() == pytest.approx(1.5e4, rel=0.05)
    sound, _ = blocks_of(scene_with(), force, 2)
    assert not sound[-1].status & Status.RIB_EDGE


@pytest.mark.parametrize("ratio", [0.97, 1.0, 1.02])
def test_sphere_as_large_as_the_apex_distance_is_survived_when_forced(ratio: float) -> None:
    """Santos (2017) lost such contacts: here the rim of the roller end carries, the thrust is balanced."""
    blocks, ended = blocks_of(forced(Rib(roller_end=True), sphere_ratio=ratio), (0.0, 0.0, 8e4), 6)
    finite(blocks)
    assert ended == ""
    assert blocks[-1].force[:, 2].mean() == pytest.approx(8e4, rel=0.03)
    assert np.abs(blocks[-1].force_waveform).max() < 3e5


def test_too_large_a_sphere_without_a_rim_ends_with_a_sentence() -> None:
    blocks, ended = blocks_of(forced(Rib(roller_end=False), sphere_ratio=1.02), (0.0, 0.0, 8e4), 3)
    finite(blocks)
    assert "beyond the edge of its large end" in ended or "pressed more than" in ended
