"""``beardyn ladder``: what accuracy costs, for one scene."""

from __future__ import annotations

import argparse
import logging
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import as_a_whole, folder_problems, write_whole
from beardyn_core.cli.files import check_inputs, made_folder, tell_doubts
from beardyn_core.cli.generated_parser import names
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_force, add_json

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene
    from beardyn_core.study.ladder_result import Ladder

DONE, INTERRUPTED = 0, 130
FILES = ("ladder.json", "ladder.png")
_USUAL_ACCURACY = 5.0
_LONGEST_S = 3600.0
# [%], as in a scene file
_FINEST_ACCURACY, _COARSEST_ACCURACY = 0.1, 50.0


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "ladder",
        help="accuracy study: error next to cost for tiers, effects, slices and steps",
        description="Accuracy study. Run a scene over tiers, effects, slices (laminae) and steps, and "
        "compare each level with a converged reference of the same scene: wall time per "
        "simulated second, and errors with their run-to-run band. Takes some minutes, and a "
        "minute more for every set of effects that is not compiled yet. Ctrl-C keeps the levels "
        "done so far; with -o the same command goes on from there.",
    )
    parser.add_argument("scene", metavar="SCENE", help="shipped scene or YAML file")
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=Path,
        help="write ladder.json and ladder.png to this folder; default none",
    )
    parser.add_argument("--duration", metavar="S", type=float, help="simulated time compared, s; default 1.2")
    parser.add_argument(
        "--settling", metavar="S", type=float, help="simulated time before that, s; default 0.4"
    )
    parser.add_argument(
        "--accuracy",
        metavar="PERCENT",
        type=float,
        help="accuracy to judge the settings by, 0.1 to 50 %%; default the scene's, or 5",
    )
    parser.add_argument(
        "--quantities",
        metavar="NAMES",
        help="quantities that the accuracy applies to, with commas between; default the scene's, or all",
    )
    parser.add_argument("--quick", action="store_true", help="few levels")
    parser.add_argument(
        "--each-effect", action="store_true", help="also `all` less each of its effects in turn"
    )
    add_force(parser, "start over in a folder that holds a study, and lose it")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.choice.load import scene_with_all
    from beardyn_core.study.ladder import climb, comparison_of, compile_levels, expected_wall
    from beardyn_core.study.ladder_levels import automatic, levels_of
    from beardyn_core.study.ladder_report import json_object, table
    from beardyn_core.study.ladder_store import RUNS_FILE, store_of

    with check_inputs(lambda inputs: option_problems(args, inputs)):
        scene = scene_with_all(args.scene)

    plan = comparison_of(scene, args.duration, args.settling)
    asked = tuple(names(args.quantities) or scene.quantities)
    _refuse_what_it_cannot_compare(scene, asked, plan.fault_line is not None)
    accuracy = 0.01 * args.accuracy if args.accuracy else scene.accuracy or 0.01 * _USUAL_ACCURACY
    levels = levels_of(scene, quick=args.quick, each_effect=args.each_effect)
    levels = levels.including(automatic(scene, accuracy, asked))
    expected = expected_wall(levels, plan)
    goes_on = _goes_on(args.output)
    again = "the same command goes on from here" if args.output else "with -o a study can be taken up again"
    print(
        f"beardyn: {scene.name}, {len(levels.levels)} levels and the reference, "
        f"some {expected / 60.0:.1f} minutes once all kernels are compiled",
        file=sys.stderr,
    )
    tell_doubts(scene)
    store = store_of(plan, args.output)
    if args.output is not None:
        with made_folder(args.output):
            if args.force:
                (args.output / RUNS_FILE).unlink(missing_ok=True)
    with _quiet():
        with (
            last_words(lambda: "no level has been run; what is compiled is kept for the next time"),
            _bar("compiled", "{n:.0f}/{total:.0f}", len(levels.levels) + 1) as bar,
        ):
            compile_levels(plan, levels, bar)
        with (
            last_words(lambda: f"the reference was not done, so no result has been written; {again}"),
            _bar("run", "{percentage:.0f} %", expected) as bar,
        ):
            ladder = climb(plan, levels, accuracy, asked, bar, store=store)
    found = json_object(ladder)
    print(json_text("ladder", found) if args.json else table(ladder), flush=True)
    if args.output is not None:
        write(ladder, found, args.output, replace=args.force or goes_on)
        if not ladder.interrupted:  # times of a later go are those of another state of the machine
            (args.output / RUNS_FILE).unlink(missing_ok=True)
    if ladder.interrupted:
        kept = (
            f"are in {args.output}; {again}" if args.output else "are printed; with -o they are written too"
        )
        print(f"beardyn: interrupted; the {len(ladder.rows)} levels done so far {kept}", file=sys.stderr)
    return INTERRUPTED if ladder.interrupted else DONE


def _refuse_what_it_cannot_compare(scene: Scene, asked: tuple[str, ...], has_fault_line: bool) -> None:
    problems = []
    if scene.numerics.integrator != "implicit":
        problems.append(
            f"{scene.name}: numerics.integrator: the ladder compares implicit steps; allowed is 'implicit'"
        )
    if "fault_line" in asked and not has_fault_line:
        problems.append(f"--quantities: 'fault_line': {scene.name} has no fault whose line could be compared")
    if problems:
        raise InputError(problems)


def option_problems(args: argparse.Namespace, inputs: Sequence[Path] = ()) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    from beardyn_core.study.measures import QUANTITIES

    problems = [
        f"{name} {value:g}: allowed is more than 0 and at most {_LONGEST_S:g} s"
        for name, value in (("--duration", args.duration), ("--settling", args.settling))
        if value is not None and not 0.0 < value <= _LONGEST_S
    ]
    accuracy = args.accuracy
    if accuracy is not None and not _FINEST_ACCURACY <= accuracy <= _COARSEST_ACCURACY:
        problems.append(
            f"--accuracy {accuracy:g}: allowed is {_FINEST_ACCURACY:g} to {_COARSEST_ACCURACY:g} percent"
        )
    unknown = [name for name in names(args.quantities) or () if name not in QUANTITIES]
    problems += [
        f"--quantities: {name!r} is not known; known are {', '.join(QUANTITIES)}" for name in unknown
    ]
    problems += missing("distributed", "a ladder", "sweep")
    if args.output is not None:
        problems += missing("matplotlib", "--output", "plot")
    force = args.force or _goes_on(args.output)  # the results of fewer levels are replaced
    return problems + folder_problems("--output", args.output, FILES, inputs=inputs, force=force)


def _goes_on(folder: Path | None) -> bool:
    """Tell whether a folder holds an interrupted study."""
    from beardyn_core.study.ladder_store import RUNS_FILE

    return folder is not None and (folder / RUNS_FILE).is_file()


def write(ladder: Ladder, found: dict[str, Any], folder: Path, *, replace: bool) -> None:
    """Write ladder.json and ladder.png; `replace` those that are there."""
    from beardyn_core.study.ladder_picture import ladder_picture

    with made_folder(folder):
        write_whole(folder / FILES[0], json_text("ladder", found, indent=1) + "\n", replace=replace)
        with as_a_whole(folder / FILES[1], replace=replace) as fresh:
            ladder_picture(ladder, fresh)


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep each level's messages about its kernels away from the bar."""
    logger = logging.getLogger("beardyn")
    before = logger.level
    logger.setLevel(logging.WARNING)
    try:
        yield
    finally:
        logger.setLevel(before)


@contextmanager
def _bar(what: str, count: str, total: float) -> Iterator[Callable[[str, float], None]]:
    """Show the time left; takes the level that runs and the share of the whole that is done."""
    from tqdm import tqdm

    shown = f"{what:9}{{bar:30}} {count}{{postfix}} [{{elapsed}}<{{remaining}}]"
    with tqdm(total=total, bar_format=shown, miniters=0, disable=None, leave=False) as bar:

        def move(name: str, done: float) -> None:
            bar.set_postfix_str(name, refresh=False)
            bar.update(min(done, max(bar.total - bar.n, 0.0)))

        yield move
