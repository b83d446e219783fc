"""``beardyn simulate`` of a scene with several axleboxes: all of them at once, one recording."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.interrupts import last_words
from beardyn_core.cli.files import tell_doubts
from beardyn_core.cli.json_output import json_text

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene
    from beardyn_core.sensors.block import Block
    from beardyn_core.study.train_run import TrainRun

DONE, INVALID = 0, 3
SHOWN = 16  # boxes that the terminal lists


def run(scene: Scene, args: argparse.Namespace) -> int:
    """Run the command for a scene with axleboxes; gives the exit code."""
    from tqdm import tqdm

    from beardyn_core.record.sinks import TrainSink
    from beardyn_core.study import train_run

    assert scene.axleboxes is not None
    count = len(scene.axleboxes.boxes)
    print(f"beardyn: {scene.name}, {count} axleboxes, {scene.purpose}", file=sys.stderr)
    tell_doubts(scene)
    boxes = train_run.start(scene)
    pictures = scene.axleboxes.pictures
    sink = None if args.output is None else TrainSink(args.output, replace=args.force, pictures=pictures)
    bar_format = "{desc} {bar} {n:.2f}/{total:.2f} s [{elapsed}<{remaining}]"
    with tqdm(
        total=scene.duration, desc="simulated", bar_format=bar_format, disable=None, leave=False
    ) as bar:

        def progress(blocks: Mapping[str, Block]) -> None:
            end = max((block.end_ns for block in blocks.values()), default=0) * 1e-9
            bar.update(max(min(end, bar.total) - bar.n, 0.0))

        with last_words(lambda: _kept(args.output, bar.n)):
            done = train_run.advance(boxes, sink, progress=progress)
    found = json_text("simulate", json_object(done, args.output)) if args.json else text(done, args.output)
    print(found)
    for failure in done.failures:
        print(f"beardyn: {failure}", file=sys.stderr)
    return INVALID if done.failures else DONE


def _kept(recording: Path | None, until: float) -> str:
    """Say what an interrupted run has left behind."""
    if recording is None or not until:
        return "nothing has been written"
    return f"{recording} holds the run until {until:.2f} s, and is closed and readable"


def json_object(done: TrainRun, recording: Path | None) -> dict[str, Any]:
    """Gather what ``--json`` prints."""
    first = next(iter(done.summaries.values()))
    return {
        "scene": first.scene,
        "tier": first.tier,
        "effects": first.effects,
        "not_in_tier": first.not_in_tier,
        "chosen": first.chosen or None,
        "duration_s": done.duration,
        "wall_time_s": done.wall_time,
        "processor_time_s": done.processor_time,
        "real_time_factor": done.real_time_factor,
        "status": "; ".join(done.failures) or "complete",
        "axleboxes": {
            name: {
                "faults": each.faults,
                "mean_force_N": each.mean_force,
                "shaft_torque_N_m": each.shaft_torque,
                "cage_speed_ratio": each.cage_speed_ratio,
                "temperature_K": dict(each.temperatures) or None,
                "clipped_samples": {sensor: count for sensor, count, _ in each.clipped},
                "status": each.status,
            }
            for name, each in done.summaries.items()
        },
        "recording": recording,
    }


def text(done: TrainRun, recording: Path | None) -> str:
    """Write the summary for the terminal."""
    summaries = done.summaries
    first = next(iter(summaries.values()))
    share = done.processor_time / done.duration / len(summaries)
    lines = [
        ("scene", first.scene),
        ("tier", first.tier),
        ("effects", ", ".join(first.effects) or "none"),
        *([("", first.chosen)] if first.chosen else []),
        *([("not in this tier", ", ".join(first.not_in_tier))] if first.not_in_tier else []),
        (
            "simulated",
            f"{done.duration:.2f} s of {len(summaries)} axleboxes in {done.wall_time:.2f} s, real-time "
            f"factor {done.real_time_factor:.2f}, {1e3 * share:.1f} ms of processor for a second of one",
        ),
    ]
    if recording is not None and recording.exists():
        lines.append(("recording", f"{recording}, {recording.stat().st_size / 1e6:.1f} MB"))
    table = [f"{'axlebox':16}{'force z kN':>12}{'torque N m':>12}  faults"]
    for name, each in list(summaries.items())[:SHOWN]:
        table.append(
            f"{name:16}{each.mean_force[2] * 1e-3:12.2f}{each.shaft_torque:12.3f}  "
            f"{'; '.join(each.faults) or 'none'}"
        )
    if len(summaries) > SHOWN:
        table.append(f"... and {len(summaries) - SHOWN} more; --json lists them all")
    return "\n".join([*(f"{name:20} {value}" for name, value in lines), "", *table])
