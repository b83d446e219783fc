"""``python -m evidence.hard``: the hard battery, what `make hard` runs."""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import asdict
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.config import load_bearing
from beardyn_core.experiments import EngineError
from evidence.hard.battery import earlier_results, forget, kernels_of, run_battery
from evidence.hard.case import TOPICS, HardCase
from evidence.hard.catalogue import CASES
from evidence.hard.explicit_contact import hidden_chatter
from evidence.hard.report import HEAD, details, line, summary, write_json
from evidence.hard.run import STARTS
from evidence.hard.verdict import FAILED, Outcome

ROLLER_OF = "HS130x230"


def main(words: list[str] | None = None) -> int:
    """Run the battery; gives the exit code: 0 when nothing fails that is not a listed known failure."""
    parser = argparse.ArgumentParser(
        prog="make hard ARGS=...",
        description="Hard cases, each judged by its measures. Ctrl-C loses nothing: the next run goes on. "
        "One process at a time writes a folder.",
    )
    parser.add_argument("names", nargs="*", metavar="CASE", help="cases or topics; all when left out")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="side by side (2)")
    parser.add_argument("--starts", type=int, default=STARTS, metavar="N", help=f"of each case ({STARTS})")
    parser.add_argument("--fast", action="store_true", help="only the subset that the tests run")
    parser.add_argument("--no-long", action="store_true", help="without the two longest cases")
    parser.add_argument("--again", action="store_true", help="repeat cases that are done already")
    parser.add_argument("--list", action="store_true", help="list the cases and what each would break")
    parser.add_argument("-o", "--output", type=Path, default=Path("hard.json"), metavar="FILE")
    parser.add_argument("--folder", type=Path, default=Path("hard_runs"), metavar="DIR",
                        help="folder of results and checkpoints")  # fmt: skip
    arguments = parser.parse_args(words)
    known = {*TOPICS, *(case.name for case in CASES)}
    if unknown := [name for name in arguments.names if name not in known]:
        parser.error(f"there is no case or topic {', '.join(unknown)}; topics are {', '.join(TOPICS)}")
    if arguments.jobs < 1:
        parser.error(f"--jobs is {arguments.jobs}; at least 1 is needed")
    if arguments.starts < 1:
        parser.error(f"--starts is {arguments.starts}; at least 1 is needed")
    cases = _chosen(arguments)
    if arguments.list:
        for case in cases:
            print(f"{case.topic:10} {case.name:28} {case.breaks}")
        return 0
    if arguments.again:
        try:
            forget(cases, arguments.folder)
        except InputError as error:
            print("\n".join(error.problems), file=sys.stderr)
            return 2
    return _battery(cases, arguments.folder, arguments.jobs, arguments.starts, arguments.output)


def _chosen(arguments: argparse.Namespace) -> list[HardCase]:
    return [
        case
        for case in CASES
        if (not arguments.names or case.name in arguments.names or case.topic in arguments.names)
        and (case.fast or not arguments.fast)
        and not (case.long and arguments.no_long)
    ]


def _battery(cases: list[HardCase], folder: Path, jobs: int, starts: int, output: Path) -> int:
    by_name = {case.name: case for case in cases}
    if earlier := earlier_results(folder):
        print(f"{folder}: {len(earlier)} results (*.outcome) are of an earlier version, which kept them in "
              "another form; they stay, and their cases are run again", file=sys.stderr)  # fmt: skip
    kernels = kernels_of(cases)
    print(f"{len(cases)} hard cases on {kernels} kernels, {jobs} side by side; a kernel that is not in the "
          "cache takes about a minute.")  # fmt: skip
    print(HEAD, flush=True)
    began = time.monotonic()

    def report(outcome: Outcome, _there: int, _of: int) -> None:
        print("\n".join([line(outcome), *details(by_name[outcome.name], outcome)]), flush=True)

    try:
        outcomes = run_battery(cases, folder, jobs, report, starts)
    except KeyboardInterrupt:
        print(f"\ninterrupted; the same command goes on with what is in {folder}", file=sys.stderr)
        return 130
    except (InputError, EngineError) as error:
        print(error, file=sys.stderr)
        return 2
    chatter = [asdict(row) for row in hidden_chatter(load_bearing(ROLLER_OF))]
    write_json(output, cases, outcomes, kernels=kernels, jobs=jobs, hidden_chatter=chatter)
    print(f"{summary(outcomes)}; {time.monotonic() - began:.0f} s; written to {output}")
    return 1 if any(outcome.verdict == FAILED for outcome in outcomes) else 0


if __name__ == "__main__":
    sys.exit(main())
