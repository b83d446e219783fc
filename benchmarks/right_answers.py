"""Speed of right answers against floors and goals: each run with the effects and the step of its accuracy.

Processor time, so that a machine that others use too says about the same; runs take turns.
"""

from __future__ import annotations

import statistics
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from beardyn_core.choice import load_scene
from beardyn_core.record.messages import typestore
from beardyn_core.record.sinks import TrainSink
from beardyn_core.scene.axleboxes import Axleboxes
from beardyn_core.scene.scene import Scene
from beardyn_core.study import train_run
from benchmarks.real_time_factor import chosen_steps
from benchmarks.runs import SETTLING_BLOCKS, Table, started

THIN_RINGS = {"preset": "auto", "structure": {"kind": "rings"}}
CORES = 2  # of the machine that a train is to run on in real time
_TRAIN_S = 3.2


@dataclass(frozen=True)
class Asked:
    """What a run is asked to reach, as simulated over processor time."""

    floor: float
    goal: float


ASKED = {
    "full, healthy, vibration to 10 kHz": Asked(1.5, 3.0),
    "full, spall, vibration to 10 kHz": Asked(1.2, 2.5),
    "quasistatic, vibration to 5 kHz": Asked(15.0, 40.0),
    "lumped, vibration to 1 kHz": Asked(150.0, 500.0),
    "lumped, the same in thin rings": Asked(150.0, 500.0),
    "full, preset all, converged step": Asked(1.5, 2.5),
}
TRAIN = Asked(64.0, 128.0)


def _scenes() -> dict[str, Scene]:
    """Make the scene of each row of `ASKED`."""
    preset = load_scene("static_80kN", effects="all")
    steps = replace(preset.numerics, steps_per_sample=chosen_steps(preset))
    found = (
        load_scene("smooth_run", tier="full", effects="auto"),
        load_scene("cup_spall", tier="full", effects="auto"),
        load_scene("smooth_run", tier="quasistatic", effects="auto", vibration_to=5000.0),
        _lumped("auto"),
        _lumped(THIN_RINGS),
        replace(preset, numerics=steps),
    )
    return dict(zip(ASKED, found, strict=True))


def _lumped(effects: Any) -> Scene:
    """Make the healthy scene in `lumped`, for vibration to 1 kHz."""
    return load_scene("smooth_run", tier="lumped", effects=effects, vibration_to=1000.0)


def full_scenes() -> dict[str, Scene]:
    """Take the scenes of the full tier."""
    return {name: scene for name, scene in _scenes().items() if scene.tier == "full"}


def verdict(now: float, asked: Asked) -> str:
    """Say what a number reaches."""
    return "goal" if now >= asked.goal else "floor" if now >= asked.floor else "short of the floor"


def right_answers(turns: int) -> Table:
    """Time every row of `ASKED` in turns, as many blocks at once as a run without a recording takes."""
    scenes = _scenes()
    blocks = {name: started(scene, 1).blocks_at_once for name, scene in scenes.items()}
    count = turns + SETTLING_BLOCKS
    twins = {name: started(scene, count * blocks[name]) for name, scene in scenes.items()}
    taken: dict[str, list[float]] = {name: [] for name in scenes}
    for turn in range(count):
        for name in scenes if turn % 2 else reversed(scenes):
            began = time.process_time()
            twins[name].advance(blocks[name])
            if turn >= SETTLING_BLOCKS:
                taken[name].append((time.process_time() - began) / blocks[name])
    rows = []
    for name, asked in ASKED.items():
        factor = twins[name].block_ns * 1e-9 / statistics.median(taken[name])
        numerics = scenes[name].numerics
        made = (numerics.laminae, numerics.steps_per_sample)
        rows.append((name, *made, asked.floor, asked.goal, factor, verdict(factor, asked)))
    return Table(
        "right_answers",
        "Right answers: simulated over processor time, recording off",
        ("run", "laminae", "steps a sample", "floor", "goal", "now", "reached"),
        rows,
        f"Medians of {turns} turns. Each scene with the effects, laminae and step that `auto` takes for "
        "force, deflection, roller load and torque within 5 % and the vibration that is named; the preset "
        "with all of its effects.",
    )


def train(axles: int) -> Table:
    """Run the boxes of a train in `lumped` with a recording, with bodies and contacts in it and without."""
    rows = []
    typestore()  # once a process, not for a box
    for what, effects, pictures in (
        ("signals alone", "auto", False),
        ("with bodies and contacts", "auto", True),
        ("signals alone, thin rings", THIN_RINGS, False),
    ):
        boxes_of = Axleboxes(axles=axles, pictures=pictures)
        whole = replace(_lumped(effects), duration=_TRAIN_S, axleboxes=boxes_of)
        boxes = train_run.start(whole)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "train.mcap"
            done = train_run.advance(boxes, TrainSink(path, pictures=pictures))
            size = 1e-6 * path.stat().st_size
        each = done.processor_time / (len(boxes) * done.duration)
        in_time = CORES / each
        rows.append(
            (
                what, len(boxes), TRAIN.floor, TRAIN.goal, 1e3 * each, in_time, verdict(in_time, TRAIN),
                done.real_time_factor, size / (len(boxes) * done.duration),
            )
        )  # fmt: skip
    columns = (
        *("recording", "boxes", "floor", "goal", "ms of processor a box second"),
        *(f"boxes in real time on {CORES} cores", "reached", "RTF of this run, wall", "MB a box second"),
    )
    note = (
        f"One process, one file, {_TRAIN_S:g} s. Boxes in real time: {CORES} cores over the processor time "
        "of one box; the wall time is that of the machine as it was, with whatever else ran on it."
    )
    return Table("train", "Axleboxes of a train in lumped, recorded", columns, rows, note)
