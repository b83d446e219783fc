"""``beardyn demo``: the main job in one go, without ROS.

The same recording, monitor and report as ``python -m beardyn_ros demo``, which runs them as nodes.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from beardyn_core.base.interrupts import last_words
from beardyn_core.base.outputs import files_read
from beardyn_core.cli.files import tell_doubts
from beardyn_core.study.demo_console import Progress, add_arguments, say

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from beardyn_core.sensors.block import Block
    from beardyn_core.study.desk_run import RunSummary

DONE, INVALID = 0, 3


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "demo",
        help="simulate, record and diagnose a spalled bearing under a train",
        description="Simulate a spalled bearing under wheel-rail load, record it, let a monitor find the "
        "fault, draw it. Without ROS; `python -m beardyn_ros demo` does the same with nodes.",
    )
    add_arguments(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.choice import load_scene
    from beardyn_core.study import desk_run
    from beardyn_core.study.demo_report import RECORDING_NAME, demo_folder
    from beardyn_core.study.monitored_recording import MonitoredRecording

    with files_read() as inputs:
        scene = load_scene(args.scene, effects=args.effects, duration=args.duration)
    folder = demo_folder(args.output, say, inputs=inputs, force=args.force)
    say(f"{scene.name}: {scene.purpose}")
    tell_doubts(scene)
    progress = Progress(scene.duration)
    recording = MonitoredRecording(
        folder / RECORDING_NAME,
        scene.bearing,
        lambda finding: progress.receive(finding.verdict),
        replace=args.force,
    )

    def kept() -> str:
        exists = (folder / RECORDING_NAME).exists()
        return f"{folder / RECORDING_NAME} holds the run so far" if exists else "nothing has been written"

    with last_words(kept):
        try:
            summary = desk_run.run(scene, [recording], _progress_callback(progress))
        finally:
            progress.close()
        return _report(folder, summary, args)


def _report(folder: Path, summary: RunSummary, args: argparse.Namespace) -> int:
    """Draw and say what was found; gives the exit code."""
    from beardyn_core.study.demo_report import Pace, report

    pace = Pace(summary.duration, summary.real_time_factor)
    report(folder, pace, say, picture_of_view=not args.no_view)
    if not summary.complete:
        print(f"beardyn: {summary.status}", file=sys.stderr)
    return DONE if summary.complete else INVALID


def _progress_callback(progress: Progress) -> Callable[[Block], None]:
    """Move the progress with every block."""
    simulated = wall = 0.0

    def show(block: Block) -> None:
        nonlocal simulated, wall
        simulated += (block.end_ns - block.start_ns) * 1e-9
        wall += block.wall_s
        progress.show(simulated, simulated / max(wall, 1e-9))

    return show
