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
SHOWN = 4  # boxes that the short answer lists


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
    if args.json:
        print(json_text("simulate", json_object(done, args.output)))
    else:
        print(text(done, args.output, args.verbose))
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
                "largest_roller_load_N": each.largest_roller_load,
                "largest_pressure_Pa": each.largest_pressure,
                "temperature_K": dict(each.temperatures) or None,
                "clipped_samples": {sensor: count for sensor, count, _ in each.clipped},
                "status": each.status,
            }
            for name, each in done.summaries.items()
        },
        "recording": recording,
    }


def text(done: TrainRun, recording: Path | None, verbose: bool = False) -> str:
    """Write the summary for the terminal: faulty boxes first, and with ``verbose`` all of them and more."""
    from beardyn_core.choice.rule import shorten_summary

    summaries = done.summaries
    first = next(iter(summaries.values()))
    share = done.processor_time / done.duration / len(summaries)
    absent = f", without {', '.join(first.not_in_tier)}" if first.not_in_tier else ""
    lines = [
        ("scene", f"{first.scene}, {len(summaries)} axleboxes"),
        (
            "computed",
            f"tier {first.tier}, {len(first.effects)} effects{absent}, {first.rings} rings; "
            f"{done.duration:.2f} s in {done.wall_time:.2f} s, real-time factor {done.real_time_factor:.2g}",
        ),
        *([("accuracy", shorten_summary(first.chosen))] if first.chosen else []),
    ]
    if verbose:
        lines += [
            ("processor", f"{1e3 * share:.1f} ms for a second of one axlebox"),
            ("effects", ", ".join(first.effects) or "none"),
            *([("", first.chosen)] if first.chosen else []),
        ]
    if recording is not None and recording.exists():
        lines.append(("recording", f"{recording}, {recording.stat().st_size / 1e6:.1f} MB"))
    table = [f"{'axlebox':16}{'force z kN':>12}{'roller kN':>12}{'GPa':>7}{'torque N m':>12}  faults"]
    ordered = sorted(summaries.items(), key=lambda each: not each[1].faults)
    shown = ordered if verbose else ordered[:SHOWN]
    for name, each in shown:
        table.append(
            f"{name:16}{each.mean_force[2] * 1e-3:12.2f}{each.largest_roller_load * 1e-3:12.2f}"
            f"{each.largest_pressure * 1e-9:7.2f}{abs(each.shaft_torque):12.3f}  "
            f"{'; '.join(each.faults) or 'none'}"
        )
    if len(summaries) > len(shown):
        table.append(f"... and {len(summaries) - len(shown)} more: --verbose lists them all")
    return "\n".join([*(f"{name:12} {value}" for name, value in lines), "", *table])
