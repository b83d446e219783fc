"""Every moment of a run belongs to one stage."""

from __future__ import annotations

import math
import time

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.cli.simulate import json_object, text
from beardyn_core.physics.bodies.step_stages import KERNEL_STAGES
from beardyn_core.rail.build import load_history
from beardyn_core.record.sinks import MemorySink
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.sensors.stage_clock import (
    KERNEL,
    LOAD,
    OBSERVE,
    REST,
    SINKS,
    STAGES,
    StageClock,
    stage_lines,
)
from beardyn_core.study import desk_run
from beardyn_core.twin import Twin


class Ticking:
    """A clock that is moved by hand."""

    def __init__(self) -> None:
        self.time = 0.0

    def __call__(self) -> float:
        return self.time


def test_stages_add_up_to_the_time_since_begin() -> None:
    now = Ticking()
    clock = StageClock(now)
    now.time = 5.0  # waiting
    clock.begin()
    for stage, end in ((LOAD, 6.0), (OBSERVE, 8.0), (LOAD, 8.5)):
        now.time = end
        clock.lap(stage)
    assert {each.stage: each.seconds for each in clock.times()} == {LOAD: 1.5, OBSERVE: 2.0}


def test_kernel_time_is_shared_out_by_cycles() -> None:
    now = Ticking()
    clock = StageClock(now)
    cycles = np.zeros(len(KERNEL_STAGES))
    cycles[[0, 3]] = 300.0, 100.0
    now.time = 8.0
    clock.lap_kernel(cycles)
    assert [(each.stage, each.seconds) for each in clock.times()] == [("contact", 6.0), ("rib", 2.0)]
    now.time = 9.0
    clock.lap_kernel(np.zeros(len(KERNEL_STAGES)))
    assert clock.times()[-1].stage == KERNEL
    assert sum(each.seconds for each in clock.times()) == 9.0


def test_table_gives_time_per_simulated_second_and_share() -> None:
    now = Ticking()
    clock = StageClock(now)
    now.time = 0.3
    clock.lap(OBSERVE)
    now.time = 0.4
    clock.lap(SINKS)
    rows = [line.split() for line in stage_lines(clock.times(), 2.0)[1:]]
    assert rows == [
        ["observe", "150.00", "75.0", "%"],
        ["sinks", "50.00", "25.0", "%"],
        ["sum", "200.00", "100.0", "%"],
    ]


@pytest.mark.parametrize("tier", ["lumped", "full"])
def test_stages_of_a_run_add_up_to_its_wall_time(tier: str) -> None:
    scene = load_scene("static_80kN", tier=tier, duration=0.2)
    # whatever else the machine does falls into one stage or another: the quietest of three runs
    assert min(share_beside_the_model(scene) for _ in range(3)) < 0.2


def share_beside_the_model(scene: Scene) -> float:
    """Check that the stages of a run add up; share of sinks and of what is in no stage."""
    ends: list[float] = []

    def progress(_block: Block) -> None:
        ends.append(time.perf_counter())

    began = time.perf_counter()
    summary = desk_run.run(scene, [MemorySink()], progress)
    began_to_end = time.perf_counter() - began
    found = {each.stage: each.seconds for each in summary.stages}
    assert set(found) <= set(STAGES)
    expected = {KERNEL} if scene.tier == "lumped" else set(KERNEL_STAGES) - {"losses"}
    assert expected | {LOAD, OBSERVE, SINKS, REST} <= set(found)
    assert (KERNEL in found) == (scene.tier == "lumped")
    whole = sum(found.values())
    assert whole < began_to_end
    if max(summary.wall_time, ends[-1] - ends[0]) > whole:
        return math.inf  # the machine stood still between two stages
    return (found[SINKS] + found[REST]) / whole


def test_summary_and_json_show_the_stages() -> None:
    summary = desk_run.run(load_scene("static_80kN", tier="lumped", duration=0.1))
    stages = json_object(summary, None)["stages_s"]
    assert list(stages) == [name for name in STAGES if name in stages]
    assert SINKS not in stages
    assert sum(stages.values()) == pytest.approx(sum(each.seconds for each in summary.stages))
    assert "ms per simulated s" in text(summary, None, verbose=True)


def test_waiting_between_blocks_belongs_to_no_stage() -> None:
    scene = load_scene("static_80kN", tier="lumped", duration=0.1)
    now = Ticking()
    twin = Twin(scene)
    twin.stages = StageClock(now)
    now.time = 100.0
    twin.start(load_history(scene.operation, scene.mounting, 0.1, scene.seed))
    twin.advance()
    assert twin.stages.times() == ()
