"""Several blocks of 20 ms in one have the bits of one after the other."""

from dataclasses import fields, replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.physics.tiers.kinematic_step import TRENDS_PER_BLOCK
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS
from beardyn_core.sensors import channels
from beardyn_core.sensors.block import Block, Vibration
from beardyn_core.study.desk_run import run
from beardyn_core.twin import Twin

COUNT = 24
STREAMS = [
    field.name
    for field in fields(Block)
    if field.name not in ("index", "wall_s", "status", "audit", "temperature", "pictures", "vibration")
    and not field.name.startswith(("start_", "end_", "waveform_sample", "trend_sample", "snapshot_sample"))
]


def scene_of(tier: str, name: str, steps: float = 1) -> Scene:
    scene = replace(load_scene(name), tier=tier)
    return replace(scene, duration=COUNT * 0.02, numerics=replace(scene.numerics, steps_per_sample=steps))


def blocks_of(scene: Scene, cuts: list[int]) -> list[Block]:
    twin = start(scene, COUNT * 0.02).twin
    return [twin.advance(count) for count in cuts]


def streams(blocks: list[Block]) -> dict[str, Any]:
    found = {name: np.concatenate([getattr(block, name) for block in blocks]) for name in STREAMS}
    for name in ("body_pose", "body_twist", "contacts"):
        found[name] = np.concatenate([getattr(block, name) for block in blocks])
    found["vibration"] = np.concatenate([block.vibration[0].acceleration for block in blocks])
    found["vibration_time_ns"] = np.concatenate([block.vibration[0].time_ns for block in blocks])
    return found


@pytest.mark.parametrize(
    ("tier", "name", "steps"),
    [
        ("lumped", "static_80kN", 1),
        ("lumped", "smooth_run", 1),
        ("lumped", "smooth_run", 3),
        ("lumped", "smooth_run", 0.5),
        ("lumped", "static_80kN", 0.25),
        ("quasistatic", "smooth_run", 1),
    ],
)
def test_any_number_of_blocks_at_once_gives_the_same_bits(tier: str, name: str, steps: float) -> None:
    scene = scene_of(tier, name, steps)
    one = streams(blocks_of(scene, [1] * COUNT))
    for cuts in ([8, 8, 8], [1, 2, 5, 8, 8]):
        several = streams(blocks_of(scene, cuts))
        for stream, values in one.items():
            assert np.array_equal(values, several[stream]), (cuts, stream)


def test_one_block_says_where_it_begins_and_ends() -> None:
    first, second = blocks_of(scene_of("lumped", "static_80kN"), [8, 8])
    assert (first.index, first.start_ns, first.end_ns) == (0, 0, 160_000_000)
    assert (second.index, second.start_ns, second.end_ns) == (8, 160_000_000, 320_000_000)
    assert isinstance(second.vibration[0], Vibration)


def test_a_snapshot_between_long_blocks_goes_on_with_the_same_bits() -> None:
    scene = scene_of("lumped", "static_80kN")
    twin = start(scene, COUNT * 0.02).twin
    twin.advance(3)
    kept = twin.snapshot()
    first = streams([twin.advance(8)])
    twin.restore(kept)
    second = streams([twin.advance(1) for _ in range(8)])
    assert all(np.array_equal(first[name], second[name]) for name in first)


def test_only_what_the_kernel_changes_alone_may_take_several() -> None:
    assert Twin(scene_of("lumped", "static_80kN")).blocks_at_once == TIERS["lumped"].blocks_at_once > 1
    full = Twin(load_scene("static_80kN"))
    assert full.blocks_at_once == 1
    with pytest.raises(ValueError, match="blocks is 2; allowed is 1 to 1"):
        full.advance(2)
    assert TRENDS_PER_BLOCK == channels.TRENDS_PER_BLOCK


def test_a_desk_run_ends_where_its_duration_does() -> None:
    ends: list[int] = []
    scene = replace(scene_of("lumped", "static_80kN"), duration=0.69)
    summary = run(scene, progress=lambda block: ends.append(block.end_ns))
    assert ends == [640_000_000, 700_000_000]
    assert summary.duration == pytest.approx(0.7)
