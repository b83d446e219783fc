"""``beardyn view``: a recording in 3-D with its curves."""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
from contextlib import suppress
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import file_problems
from beardyn_core.cli.options import add_box, add_force, port


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "view",
        help="replay a recording: the bearing in 3-D and its curves",
        description="Replay a recording: the bearing in 3-D, forces, vibration, speeds, envelope spectrum. "
        "Without an option the viewer opens in a window.",
    )
    parser.add_argument("recording", metavar="run.mcap", help="recording to show")
    add_box(parser)
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--web", action="store_true", help="serve the viewer to a browser on this machine")
    where.add_argument(
        "--save", metavar="FILE.rrd", type=Path, help="write a rerun file and open nothing; default none"
    )
    where.add_argument(
        "--screenshot",
        metavar="FILE.png",
        type=Path,
        help="write a picture, without a screen too; default none",
    )
    add_force(parser, "replace the file of --save or --screenshot")
    parser.add_argument(
        "--port",
        type=port,
        metavar="N",
        help="port of the page with --web, 1 to 65535; default a free one",
    )
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.record import viewer
    from beardyn_core.record.reading import read_run

    if problems := option_problems(args):
        raise InputError(problems)
    from beardyn_core.record.rerun_view import save

    if not (args.web or args.save or args.screenshot):
        viewer.require_display()
    recording = read_run(args.recording, args.box)
    if recording.problem:
        print(f"{recording.problem}; showing what is there", file=sys.stderr)
    if recording.box:
        others = ", ".join(name for name in recording.boxes if name != recording.box)
        print(f"shows the axlebox {recording.box}; --box shows another: {others}", file=sys.stderr)
    if args.save:
        with last_words(lambda: "nothing has been written"):
            target = save(recording, args.save, replace=args.force)
        print(f"{target}: {target.stat().st_size / 1e6:.1f} MB; open it with: rerun {target}")
        return 0
    with tempfile.TemporaryDirectory(prefix="beardyn-view-") as folder:
        target = save(recording, Path(folder) / f"{Path(recording.label).stem}.rrd")
        if args.screenshot:
            print(viewer.take_picture(target, args.screenshot))
        elif args.web:
            _serve(target, args.port)
        else:
            return 0 if viewer.open_window(target) == 0 else 2
    return 0


def option_problems(args: argparse.Namespace) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    problems = missing("rerun", "a view", "view")
    if args.port is not None and not args.web:
        problems.append("--port: is that of --web; give both")
    for option, file, ending in (("--save", args.save, ".rrd"), ("--screenshot", args.screenshot, ".png")):
        problems += file_problems(
            option, file, inputs=[Path(args.recording)], force=args.force, ending=ending
        )
    return problems


def _serve(target: Path, port: int | None) -> None:
    from beardyn_core.record import viewer

    # A terminated command must not leave the server behind: both ways of ending it unwind the stack.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    with suppress(KeyboardInterrupt), viewer.web_viewer(target, port) as page:
        print(f"open {page.url}\nend with Ctrl-C", flush=True)
        page.process.wait()
