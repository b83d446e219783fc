"""``beardyn sweep``: labelled runs by the thousand, on this machine or any Dask cluster."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

from beardyn_core.api.sweeping import Lines, clock, cluster_of, sweep
from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.outputs import folder_problems
from beardyn_core.cli.generated_parser import add_command, add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_json, add_tls, tls_of

if TYPE_CHECKING:
    from beardyn_core.experiments import Cluster
    from beardyn_core.population.sweeping import Swept

DONE, DIFFERS, INTERRUPTED = 0, 3, 130


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = add_command(subparsers, "sweep", sweep)
    add_parameter(
        parser,
        sweep,
        "sweep",
        "sweep",
        metavar="SWEEP",
        nargs="?",
        type=str,
        suffix="; needed but for --verify",
    )
    add_parameter(parser, sweep, "output", "-o", "--output", metavar="DIR", required=True)
    parser.add_argument("--runs", metavar="N", type=int, help="how many runs; default the sweep's")
    parser.add_argument("--seed", metavar="N", type=int, help="of all draws; default the sweep's")
    parser.add_argument(
        "--hours", metavar="H", type=float, help="stop after so long, h; default the sweep's, or never"
    )
    add_parameter(parser, sweep, "workers", metavar="N")
    add_parameter(parser, sweep, "memory_GB", "--memory", metavar="GB")
    add_parameter(parser, sweep, "scheduler", metavar="ADDR")
    add_tls(parser)
    parser.add_argument(
        "--verify", action="store_true", help="compare the files of a finished set with its checksums, no run"
    )
    add_parameter(parser, sweep, "force")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    if args.verify:
        return _verify(args)
    if args.sweep is None:
        raise InputError("SWEEP is missing: give a shipped sweep or a YAML file, or --verify")
    from beardyn_core.experiments import EngineError
    from beardyn_core.population.request import make_plan
    from beardyn_core.population.sweeping import conduct

    cluster = cluster_of(args.workers, args.scheduler, tls_of(args), args.memory)
    changes = {"runs": args.runs, "seed": args.seed, "hours": args.hours}
    if problems := option_problems(args, cluster):  # reported before effects are chosen, which takes long
        raise InputError([*_mistakes_of(args.sweep, changes), *problems])
    plan = make_plan(args.sweep, _say, **changes)
    bar = _Bar(plan.sweep.run_count) if sys.stderr.isatty() else Lines()
    try:
        with last_words(
            lambda: f"{bar.done} of {plan.sweep.run_count} runs are done; the same command goes on"
        ):
            swept = conduct(plan, args.output, cluster, force=args.force, report=bar, say=_say)
    except EngineError as error:
        raise InputError(str(error)) from error
    finally:
        bar.close()
    print(json_text("sweep", json_object(swept)) if args.json else describe_sweep(swept), flush=True)
    return DONE


def option_problems(args: argparse.Namespace, cluster: Cluster) -> list[str]:
    """List what is wrong with the options; nothing is created."""
    from beardyn_core.population.folder import ABOUT

    folder = args.output
    problems = cluster.problems() + folder_problems("--output", folder)
    if folder.is_dir() and any(folder.iterdir()) and not (folder / ABOUT).is_file():
        problems.append(
            f"--output {folder}: holds files and no set of runs; give a new folder, for nothing there is "
            "replaced"
        )
    return problems


def _mistakes_of(name: str, changes: dict[str, Any]) -> list[str]:
    """List the mistakes in a sweep file and in the scenes of its runs, without choosing effects."""
    from beardyn_core.config import read_sweep
    from beardyn_core.population.sweep_scenes import mistakes_of

    try:
        return mistakes_of(*read_sweep(name, **changes))
    except InputError as error:
        return error.problems


def json_object(swept: Swept) -> dict[str, object]:
    """Give what `--json` prints."""
    return {
        "folder": swept.folder,
        "complete": swept.complete,
        "runs": swept.total,
        "done": swept.done,
        "failed": swept.failed,
        "here": swept.here,
        "wall_time_s": swept.seconds,
        "difficulty": swept.difficulty,
    }


def describe_sweep(swept: Swept) -> str:
    """Say what there is."""
    from beardyn_core.population.difficulty import difficulty_line

    if not swept.here:
        done = f"{swept.folder}: all {swept.done} runs were done before, {swept.failed} failed"
        return f"{done}\n{difficulty_line(swept.difficulty)}"
    rate = swept.here / swept.seconds
    rest = "" if swept.complete else f" of {swept.total}; the same command goes on"
    return (
        f"{swept.folder}: {swept.done} runs{rest}, {swept.failed} failed; {swept.here} of them now, in "
        f"{clock(swept.seconds)}, {rate:.2f} a second\n{difficulty_line(swept.difficulty)}"
    )


def _verify(args: argparse.Namespace) -> int:
    from beardyn_core.population.finalizing import verify

    problems = verify(args.output)
    if args.json:
        print(json_text("sweep", {"folder": args.output, "problems": problems}))
    for problem in problems:
        print(f"beardyn: {problem}", file=sys.stderr)
    if not problems and not args.json:
        print(f"{args.output}: every file is what it was when the set was closed")
    return DIFFERS if problems else DONE


class _Bar:
    """Progress with rate, time left and failures; called after every task."""

    def __init__(self, total: int) -> None:
        from tqdm import tqdm

        self.done = 0
        self._linked = False
        self._bar = tqdm(
            total=total,
            bar_format="{bar:30} {n_fmt}/{total_fmt} runs{postfix}",
            disable=None,
            leave=False,
        )

    def __call__(self, now: object) -> None:
        from beardyn_core.experiments.loop import Progress

        assert isinstance(now, Progress)
        if not self._linked and now.dashboard:
            _say(f"dashboard {now.dashboard}")
            self._linked = True
        self.done = now.done
        left = f", {clock(now.remaining)} left" if now.here else ""
        failed = f", {now.failed} failed" if now.failed else ""
        self._bar.n = now.done
        self._bar.set_postfix_str(f"{now.rate:.2f} a second, {now.workers} workers{left}{failed}")

    def close(self) -> None:
        self._bar.close()


def _say(text: str) -> None:
    print(f"beardyn: {text}", file=sys.stderr, flush=True)
