"""``beardyn baseline``: a simple learner trained on a set of runs, to compare others with."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.plain_json import keyed_fields
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json

if TYPE_CHECKING:
    from collections.abc import Sequence

    from beardyn_core.population.labelled_set import LabelledSet
    from beardyn_core.population.learner import Judgement, Learner


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "baseline",
        help="train a simple learner on a set of runs, test it on bearings that it has not seen",
        description="Train random forests on the features of the runs in the training part of a set that "
        "`beardyn sweep` has made, and test them on its test part, whose bearings are others: which part is "
        "spalled, and how wide. Sets of other conditions can be tested too.",
    )
    parser.add_argument("set", metavar="DIR", type=Path, help="set to train and to test with")
    parser.add_argument(
        "--test",
        metavar="DIR",
        type=Path,
        action="append",
        default=[],
        help="another set, all of it for testing; may be given again; default none",
    )
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of the trees; default 0")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.population.labelled_set import TEST, TRAIN, LabelledSet
    from beardyn_core.population.learner import Learner

    runs = LabelledSet(args.set)
    others = [LabelledSet(path) for path in args.test]
    learner = Learner(seed=args.seed).fit(runs)
    found = [learner.judged(f"{args.set}, part {TEST}", runs)]
    found += [learner.judged(str(path), other, None) for path, other in zip(args.test, others, strict=True)]
    if args.json:
        trained = len(runs.runs_of(TRAIN))
        print(json_text("baseline", json_object(learner, trained, found, [runs, *others])))
    else:
        print(table(learner, found, [runs, *others]))
    return 0


def json_object(
    learner: Learner, trained: int, found: list[Judgement], sets: Sequence[LabelledSet]
) -> dict[str, Any]:
    """Give what `--json` prints."""
    return {
        "trained_on": trained,
        "features": learner.importance(),
        "tests": [
            {
                **keyed_fields(
                    each,
                    count="runs",
                    balanced="balanced_accuracy",
                    matrix="named",
                    width_error="width_relative_error",
                ),
                "difficulty": runs.difficulty,
            }
            for each, runs in zip(found, sets, strict=True)
        ],
    }


def table(learner: Learner, found: list[Judgement], sets: Sequence[LabelledSet]) -> str:
    """Write what was found as tables."""
    from beardyn_core.population.difficulty import difficulty_line
    from beardyn_core.study.table import Table

    lines: list[str] = []
    for each, runs in zip(found, sets, strict=True):
        named = sorted({name for row in each.matrix.values() for name in row})
        title = (
            f"{each.name}: {each.count} runs, {100 * each.accuracy:.0f} % named right "
            f"({100 * each.balanced:.0f} % with each condition counted alike)"
        )
        rows = tuple(
            (right, *(str(row.get(name, 0)) for name in named)) for right, row in each.matrix.items()
        )
        lines.append(Table(title, ("condition", *(f"named {name}" for name in named)), rows).text())
        if each.width_error == each.width_error:
            lines.append(
                f"width of the spall: median error {100 * each.width_error:.0f} %, bias "
                f"{1e3 * each.width_bias:+.1f} mm"
            )
        lines += [difficulty_line(runs.difficulty), ""]
    best = list(learner.importance().items())[:5]
    lines.append("features that decide: " + ", ".join(f"{name} {100 * share:.0f} %" for name, share in best))
    return "\n".join(lines)
