"""``beardyn train``: an estimator of load, end play and spall from a set of labelled runs."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from beardyn_core.api.estimating import train
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json

if TYPE_CHECKING:
    from beardyn_core.follow.estimator import Estimator
    from beardyn_core.study.table import Table


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(subparsers, "train", train)
    add_parameter(parser, train, "runs", "set", metavar="DIR")
    add_parameter(parser, train, "output", "-o", "--output", metavar="FILE.npz", required=True)
    add_parameter(parser, train, "calibration", metavar="DIR")
    add_parameter(parser, train, "test", metavar="DIR")
    add_parameter(parser, train, "axes", metavar="AXES", type=str, default="xyz")
    add_parameter(parser, train, "force")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    inputs = [args.set, *args.calibration, *([args.test] if args.test else [])]
    problems = file_problems("--output", args.output, inputs=inputs, force=args.force, ending=".npz")
    if not args.axes or set(args.axes) - set("xyz") or len(set(args.axes)) < len(args.axes):
        problems.append(f"--axes {args.axes!r}: give one or more of x, y and z, each once")
    if problems:
        raise InputError(problems)
    found = train(
        args.set,
        args.output,
        calibration=args.calibration,
        test=args.test,
        axes=[each for each in "xyz" if each in args.axes],
        force=args.force,
    )
    if args.json:
        print(json_text("train", {"file": args.output, "card": found.card}))
    else:
        print(table(found).text())
        print(f"written: {args.output}, {args.output.stat().st_size / 1e3:.0f} kB")
    return 0


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
