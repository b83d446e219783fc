"""``beardyn trial``: the benchmark of a monitor over a matrix of scenes."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.api.simulating import simulate
from beardyn_core.base.interrupts import last_words
from beardyn_core.base.optional import missing
from beardyn_core.base.outputs import as_a_whole, folder_problems, write_whole
from beardyn_core.cli.files import check_inputs, made_folder
from beardyn_core.cli.generated_parser import add_parameter
from beardyn_core.cli.json_output import json_text
from beardyn_core.cli.options import add_force, add_json, add_monitor

if TYPE_CHECKING:
    from beardyn_core.scene.trial import Trial
    from beardyn_core.study.trial import TrialRun
    from beardyn_core.study.trial_result import TrialResult

DONE, INTERRUPTED = 0, 130
FILES = ("trial.json", "trial.png")
_MOST_JOBS = 256


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    """Declare the command."""
    parser = subparsers.add_parser(
        "trial",
        help="benchmark of a monitor: detection rate and false alarms over many scenes",
        description="Benchmark of monitors. Run one, ours or your own, over faults, sizes, speeds, tracks "
        "and wheels, and print how often it finds the fault, how often it alarms on a healthy "
        "bearing, and the smallest spall it finds, with 95 % intervals. `quick` takes two "
        "minutes of one core, `default` an hour, and a minute more for every set of effects "
        "that is not compiled yet; choosing effects where neither benchmark nor scene names any "
        "takes half a minute to two, once. With -o a run that is done is kept, and an "
        "interrupted benchmark goes on where it was; a folder of another benchmark or monitor "
        "is refused.",
    )
    parser.add_argument(
        "matrix",
        metavar="TRIAL",
        nargs="?",
        default="default",
        help="shipped trial or YAML file; default `default`",
    )
    add_monitor(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        type=Path,
        help="keep the runs here, write trial.json and, of a trial with spalls, trial.png; default none",
    )
    parser.add_argument("--jobs", metavar="N", type=int, help="processes; default one for each core")
    of_all = (
        "the trial's or its scene's, or what it needs to be within 5 % of the full model, the same in all "
        "runs of a tier"
    )
    add_parameter(parser, simulate, "effects", metavar="NAME", usual=of_all)
    parser.add_argument("--tier", metavar="T", help="lumped, quasistatic or full; default the trial's")
    parser.add_argument(
        "--seed",
        metavar="N",
        type=int,
        help="seed of tracks, noise and places of spalls; default the trial's",
    )
    add_force(parser, "start over in a folder that holds runs, and lose them")
    add_json(parser)
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """Run the command; gives the exit code."""
    from beardyn_core.choice import load_trial
    from beardyn_core.choice.trial import leaves_open
    from beardyn_core.experiments.cluster import core_count
    from beardyn_core.study.trial import conduct, plan_of, warm
    from beardyn_core.study.trial_report import json_object, table
    from beardyn_core.study.trial_result import TrialResult

    with check_inputs(lambda inputs: option_problems(args, inputs)):
        trial = load_trial(args.matrix, tier=args.tier, seed=args.seed, effects=args.effects)
    folder = args.output
    if leaves_open(trial):
        print(
            "beardyn: choosing the effects of the runs: half a minute to two, kept for the next time",
            file=sys.stderr,
        )
    plan = plan_of(trial, args.monitor, folder, force=args.force)
    if folder is not None:
        folder.mkdir(exist_ok=True)
    jobs = args.jobs or core_count()
    if plan.kept:
        print(f"beardyn: {len(plan.kept)} of {len(trial.cells())} runs were done before", file=sys.stderr)
    if plan.outdated:
        print(
            f"beardyn: {plan.outdated} runs are out of date, for the code or a file they depend on has "
            "changed; they are run again, and kept until then",
            file=sys.stderr,
        )
    again = "the same command goes on from here" if folder else "with -o a trial can be taken up again"
    progress = _Bar(trial, len(plan.kept))

    def kept() -> str:
        done = len(plan.kept) + len(progress.runs)
        return f"{done} of {len(trial.cells())} runs are done; {again}"

    interrupted = False
    if plan.missing:
        with last_words(kept):
            warm(plan.request.trial)
    try:
        with last_words(kept):
            runs = conduct(plan, folder, jobs, progress)
    except KeyboardInterrupt:
        interrupted = True
        runs = [*plan.kept.values(), *progress.runs]
    finally:
        progress.close()
    result = TrialResult.of(trial, args.monitor, runs)
    found = {**json_object(result), "complete": not interrupted}
    print(json_text("trial", found) if args.json else table(result), flush=True)
    if folder is not None:
        _write(result, found, folder, drawn=not interrupted)
    if interrupted:
        print(f"beardyn: interrupted; {kept()}", file=sys.stderr)
    return INTERRUPTED if interrupted else DONE


def option_problems(args: argparse.Namespace, inputs: Sequence[Path] = ()) -> list[str]:
    """List what is wrong with the options; nothing is created.

    The results of a trial that goes on in its folder are replaced by those of more runs.
    """
    from beardyn_core.study.trial import RUNS_FILE

    problems = []
    if args.jobs is not None and not 1 <= args.jobs <= _MOST_JOBS:
        problems.append(f"--jobs {args.jobs}: allowed is 1 to {_MOST_JOBS}")
    runs = None if args.output is None else args.output / RUNS_FILE
    goes_on = runs is not None and runs.is_file() and runs.stat().st_size > 0
    if args.jobs != 1:
        problems += missing("distributed", "a trial on several cores (not --jobs 1)", "sweep")
    if args.output is not None:
        problems += missing("matplotlib", "--output", "plot")
    return problems + folder_problems(
        "--output", args.output, FILES, inputs=inputs, force=args.force or goes_on
    )


def _write(result: TrialResult, found: dict[str, object], folder: Path, *, drawn: bool) -> None:
    """Write trial.json of the runs there are, and trial.png, which only a complete trial of spalls has."""
    with made_folder(folder):
        write_whole(folder / FILES[0], json_text("trial", found, indent=1) + "\n")
        if drawn and result.trial.faults:
            from beardyn_core.study.trial_picture import trial_picture

            with as_a_whole(folder / FILES[1]) as fresh:
                trial_picture(result, fresh)
        else:
            (folder / FILES[1]).unlink(missing_ok=True)


class _Bar:
    """Progress with the time left; it is called for every run that ends."""

    def __init__(self, trial: Trial, kept: int) -> None:
        from tqdm import tqdm

        self.runs: list[TrialRun] = []
        self._bar = tqdm(
            total=len(trial.cells()),
            initial=kept,
            bar_format="{bar:30} {n_fmt}/{total_fmt} runs{postfix} [{elapsed}<{remaining}]",
            disable=None,
            leave=False,
        )

    def __call__(self, run: TrialRun) -> None:
        self.runs.append(run)
        self._bar.set_postfix_str(run.key.rpartition(", run")[0], refresh=False)
        self._bar.update(1)

    def close(self) -> None:
        self._bar.close()
