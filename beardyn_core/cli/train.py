"""``beardyn train``: estimators of load, end play and spall, from a set of labelled runs or for a bearing."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from beardyn_core.api.estimating import train
from beardyn_core.api.training import MadeEstimator, axes_problems, estimator_files, make_estimators
from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.outputs import file_problems
from beardyn_core.cli.generated_parser import add_command, add_parameter, names
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.measured_options import in_options
from beardyn_core.cli.options import add_json

if TYPE_CHECKING:
    from beardyn_core.follow.estimator import Estimator
    from beardyn_core.study.table import Table

_OF_BEARING = ("sensor", "like", "workers")
_OF_SET = ("calibration", "test")
_OF_A_SET = ("xyz",)  # axes, where none are given


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    more = "With --bearing or --scene its runs are simulated first, 30 to 90 min of one core in all."
    parser = add_command(subparsers, "train", train, more)
    add_parameter(
        parser, train, "runs", "set", metavar="DIR", nargs="?", suffix="; needed but for --bearing, --scene"
    )
    add_parameter(
        parser,
        make_estimators,
        "output",
        "-o",
        "--output",
        metavar="FILE.npz",
        suffix="; needed with DIR, --scene",
    )
    add_parameter(parser, train, "calibration", metavar="DIR")
    add_parameter(parser, train, "test", metavar="DIR")
    add_parameter(
        parser, make_estimators, "axes", metavar="AXES", type=names, default=None, usual="xyz,z, of DIR xyz"
    )
    group = parser.add_argument_group(
        "a bearing, an axlebox", "runs of it are simulated next to the file; called again, it goes on"
    )
    add_parameter(
        group, make_estimators, "bearing", metavar="NAME", required=False, default=None, usual="none"
    )
    add_parameter(group, make_estimators, "scene", metavar="SCENE")
    add_parameter(group, make_estimators, "sensor", metavar="NAME")
    add_parameter(group, make_estimators, "like", metavar="SWEEP")
    add_parameter(group, make_estimators, "workers", metavar="N")
    add_parameter(parser, make_estimators, "force")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    if problems := option_problems(args):
        raise InputError(problems)
    made = _of_bearing(args) if args.set is None else _of_set(args)
    if args.json:
        first, *others = made
        content = {
            "file": first.file,
            "card": first.estimator.card,
            "other_files": [each.file for each in others],
        }
        print(json_text("train", content))
        return 0
    for each in made:
        print(table(each.estimator).text())
        size = f"{each.file.stat().st_size / 1e3:.0f} kB"
        print(
            f"written: {each.file}, {size}"
            if each.is_new
            else f"{each.file} was there before; --force makes it anew"
        )
    return 0


def option_problems(args: argparse.Namespace) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    problems = []
    simulated = [name for name in ("bearing", "scene") if getattr(args, name) is not None]
    if args.set is None and not simulated:
        problems.append("DIR, --bearing, --scene: give a set of runs, or what is simulated")
    elif len(simulated) > 1:
        problems.append("--bearing, --scene: a scene has its bearing; give one of the two")
    elif args.set is not None and simulated:
        problems.append(
            f"DIR {args.set}, --{simulated[0]}: the runs of a set have their bearing; give one of the two"
        )
    elif args.output is None and (args.set is not None or args.scene is not None):
        problems.append("--output: is missing; give the file of the estimator")
    idle = _OF_SET if simulated else _OF_BEARING
    for name in idle:
        if getattr(args, name):
            which = "a set of runs" if simulated else "a bearing that is simulated"
            problems.append(f"--{name}: is of {which}; leave it out")
    wrong = [] if args.axes is None else axes_problems(args.axes, "--axes")
    if args.set is not None and args.output is not None:
        inputs = [args.set, *args.calibration, *([args.test] if args.test else [])]
        files = [args.output] if wrong else estimator_files(args.output, args.axes or _OF_A_SET).values()
        for file in files:
            problems += file_problems("--output", file, inputs=inputs, force=args.force, ending=".npz")
    return problems + wrong


def _of_bearing(args: argparse.Namespace) -> list[MadeEstimator]:
    given = {} if args.axes is None else {"axes": args.axes}
    try:
        with last_words(lambda: "the same command goes on"):
            return list(
                make_estimators(
                    args.bearing, args.output, scene=args.scene, sensor=args.sensor, like=args.like,
                    workers=args.workers, force=args.force, progress=True, **given,
                )
            )  # fmt: skip
    except InputError as error:
        raise InputError(
            [in_options(each, ["bearing", "scene", "output"]) for each in error.problems]
        ) from None


def _of_set(args: argparse.Namespace) -> list[MadeEstimator]:
    made = []
    for axes, file in estimator_files(args.output, args.axes or _OF_A_SET).items():
        found = train(
            args.set, file, calibration=args.calibration, test=args.test, axes=tuple(axes), force=args.force
        )
        made.append(MadeEstimator(file, found, is_new=True))
    return made


def table(estimator: Estimator) -> Table:
    """Tell how well an estimator does on bearings that it has not learnt from."""
    from beardyn_core.follow.quantities import BY_NAME
    from beardyn_core.study.table import Table

    rows: list[tuple[str, ...]] = []
    for name, known in estimator.card["quantities"].items():
        test, quantity = known.get("test"), BY_NAME[name]
        if test is None:
            rows.append(
                (quantity.words, str(known["runs"]), f"{100 * known['explained']:.0f} %", *3 * ("-",))
            )
            continue
        error = f"{100 * test['error']:.0f} %" if quantity.relative else quantity.width_text(test["error"])
        inside = [f"{100 * each:.0f} %" for each in test["coverage"]]
        rows.append((quantity.words, str(known["runs"]), f"{100 * known['explained']:.0f} %", error, *inside))
    card = estimator.card
    if condition := card["condition"]:
        inside = [f"{100 * each:.0f} %" for each in condition["coverage"]]
        named = f"named in {100 * condition['named']:.0f} %"
        rows.insert(0, ("condition", str(condition["runs"]), "-", named, *inside))
    return Table(
        f"{estimator.plate.name}, {card['runs']} runs of {card['bearings']} bearings of {card['set']}",
        ("quantity", "runs", "explained", "median error", "in 50 %", "in 90 %"),
        tuple(rows),
    )
