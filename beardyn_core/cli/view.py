"""``beardyn view``: a recording in 3-D with its curves, and moving pictures of it."""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import file_problems
from beardyn_core.cli.options import add_box, add_force, port
from beardyn_core.study.animation import SUBJECTS

if TYPE_CHECKING:
    from beardyn_core.record.run import Run

ENDINGS = {"save": ".rrd", "screenshot": ".png", "gif": ".gif", "mp4": ".mp4"}


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "view",
        help="replay a recording: the bearing in 3-D and its curves; or a moving picture of it",
        description="Replay a recording: the bearing in 3-D, forces, vibration, speeds, envelope spectrum. "
        "Without an option the viewer opens in a window. --gif and --mp4 write a moving picture of five "
        "seconds instead, without a viewer and without a screen.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to show")
    add_box(parser)
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--web", action="store_true", help="serve the viewer to a browser on this machine")
    for option, ending, words in (
        ("--save", "rrd", "write a rerun file and open nothing; default none"),
        ("--screenshot", "png", "write a picture, without a screen too; default none"),
        ("--gif", "gif", "write a moving picture (extra `plot`); default none"),
        ("--mp4", "mp4", "write a film (extras `plot` and `mp4`); default none"),
    ):
        where.add_argument(option, metavar=f"FILE.{ending}", type=Path, help=words)
    parser.add_argument(
        "--of",
        choices=SUBJECTS,
        help="what --gif and --mp4 show: load_zone, the rollers over one turn of the cage; crossing, rollers "
        "that cross a spall of a ring, with the vibration; default crossing where a ring has a spall, else "
        "load_zone",
    )
    parser.add_argument(
        "--at",
        metavar="SECONDS",
        type=float,
        help="simulated time to show first, in the window, --screenshot, --gif and --mp4, s; default the "
        "beginning, of moving pictures 0.25 s after it",
    )
    add_force(parser, "replace the file of --save, --screenshot, --gif or --mp4")
    parser.add_argument(
        "--port",
        type=port,
        metavar="N",
        help="port of the page with --web, 1 to 65535; default a free one",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.record.bag_scanning import scan_recording
    from beardyn_core.record.reading import read_run

    if problems := option_problems(args):
        raise InputError(problems)
    if not (args.web or any(getattr(args, name) for name in ENDINGS)):
        from beardyn_core.record.viewer import require_display

        scan_recording(args.recording)  # a file that is none comes before a screen that is none
        require_display()
    recording = read_run(args.recording, args.box)
    if recording.problem:
        print(f"{recording.problem}; showing what is there", file=sys.stderr)
    if recording.box:
        print(_which_box(recording), file=sys.stderr)
    if args.at is not None:
        _require_time(recording, args.at)
    if args.gif or args.mp4:
        return _write_moving_picture(recording, args)
    return _show(recording, args)


def option_problems(args: argparse.Namespace) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    moving = args.gif or args.mp4
    if moving:
        problems = missing("matplotlib", "a moving picture", "plot")
        problems += missing("imageio_ffmpeg", "an MP4 file", "mp4") if args.mp4 else []
    else:
        problems = missing("rerun", "a view", "view")
    if args.of and not moving:
        problems.append("--of: is that of --gif and --mp4; give one of them")
    if args.at is not None and (args.web or args.save):
        option = "--web" if args.web else "--save"
        problems.append(
            f"--at: a viewer opens {'a page' if args.web else 'a file'} at its beginning, so {option} takes "
            "no --at; give --screenshot, --gif, --mp4, or none of them for a window"
        )
    if args.port is not None and not args.web:
        problems.append("--port: is that of --web; give both")
    for name, ending in ENDINGS.items():
        problems += file_problems(
            f"--{name}",
            getattr(args, name),
            inputs=[Path(args.recording)],
            force=args.force,
            ending=ending,
        )
    return problems


def _which_box(recording: Run) -> str:
    """Name the axlebox that is shown, and the others with their faults."""
    from beardyn_core.record.view_title import faults_elsewhere

    faults = faults_elsewhere(recording)
    others = ", ".join(
        f"{name} ({faults[name]})" if name in faults else name
        for name in recording.boxes
        if name != recording.box
    )
    return f"shows the axlebox {recording.box}; --box shows another: {others}"


def _require_time(recording: Run, at: float) -> None:
    """Refuse a time that is not in the recording."""
    times = recording.bodies.time if len(recording.bodies) else recording.force.time
    low, high = (float(times[0]), float(times[-1])) if len(times) else (0.0, 0.0)
    if not min(low, 0.0) <= at <= high:
        raise InputError(f"--at {at:g}: the recording goes from {low:.3f} to {high:.3f} s")


def _write_moving_picture(recording: Run, args: argparse.Namespace) -> int:
    from beardyn_core.study.animation.picture_file import moving_picture, write_gif, write_mp4

    began = time.perf_counter()
    with last_words(lambda: "nothing has been written"):
        picture = moving_picture(recording, args.of, args.at)
        path = args.gif or args.mp4
        count = (write_gif if args.gif else write_mp4)(picture, path, replace=args.force)
    print(
        f"{path}: {picture.what}, {picture.begin:.3f} to {picture.end:.3f} s; {count} frames, "
        f"{path.stat().st_size / 1e6:.2f} MB, drawn in {time.perf_counter() - began:.0f} s"
    )
    return 0


def _show(recording: Run, args: argparse.Namespace) -> int:
    from beardyn_core.record import viewer
    from beardyn_core.record.rerun_view import save

    if args.save:
        with last_words(lambda: "nothing has been written"):
            target = save(recording, args.save, replace=args.force)
        print(f"{target}: {target.stat().st_size / 1e6:.1f} MB; open it with: rerun {target}")
        return 0
    with tempfile.TemporaryDirectory(prefix="beardyn-view-") as folder:
        target = save(recording, Path(folder) / f"{Path(recording.label).stem}.rrd")
        if args.screenshot:
            print(viewer.take_picture(target, args.screenshot, at=args.at))
        elif args.web:
            _serve(target, args.port)
        else:
            return 0 if viewer.open_window(target, args.at) == 0 else 2
    return 0


def _serve(target: Path, port: int | None) -> None:
    from beardyn_core.record import viewer

    # A terminated command must not leave the server behind: both ways of ending it unwind the stack.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with suppress(KeyboardInterrupt), viewer.web_viewer(target, port) as page:
        print(f"open {page.url}\nend with Ctrl-C", flush=True)
        page.process.wait()
