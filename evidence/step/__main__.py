"""``python -m evidence.step``: the chosen step against an explicit one; `make step`."""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import replace
from pathlib import Path

from evidence.runner import write_json
from evidence.step.cases import POINTS
from evidence.step.study import QUICK, Extent, run_study
from evidence.step.table import point_tables, unstable_table, verdict_text


def main(words: list[str] | None = None) -> int:
    """Run the study, print its tables, write the JSON."""
    parser = argparse.ArgumentParser(
        prog="make step ARGS=...",
        description="Implicit time steps against an explicit reference of 0.1 us, at two loads.",
    )
    parser.add_argument("--quick", action="store_true", help="short runs: wide bands, most verdicts open")
    parser.add_argument("--duration", type=float, metavar="S", help="compared of each run")
    parser.add_argument("--references", type=int, metavar="N", help="runs of the reference, 2 or more")
    parser.add_argument("--load", choices=[point.name for point in POINTS], help="one load alone")
    parser.add_argument("--jobs", type=int, default=1, metavar="N", help="side by side (1)")
    parser.add_argument("-o", "--output", type=Path, default=Path("step.json"), metavar="FILE")
    arguments = parser.parse_args(words)
    extent = QUICK if arguments.quick else Extent()
    if arguments.duration is not None:
        if not 0.2 <= arguments.duration <= 600.0:
            parser.error(f"--duration is {arguments.duration:g}; allowed is 0.2 to 600")
        extent = replace(extent, duration=arguments.duration)
    if arguments.references is not None:
        if arguments.references < 2:
            parser.error(f"--references is {arguments.references}; at least 2 are needed for a band")
        extent = replace(extent, reference_runs=arguments.references)
    if arguments.jobs < 1:
        parser.error(f"--jobs is {arguments.jobs}; at least 1 is needed")
    points = [point for point in POINTS if arguments.load in (None, point.name)]
    began = time.monotonic()
    try:
        found = run_study(extent, points, arguments.jobs, lambda text: print(text, flush=True))
    except KeyboardInterrupt:
        print("\ninterrupted: nothing is written", file=sys.stderr)
        return 130
    write_json(arguments.output, found)
    for point in found["points"]:
        for table in point_tables(point, found):
            print(f"\n{table.text()}")
        print("\n".join(verdict_text(point, asked) for asked in point["chosen"]))
    print(f"\n{unstable_table(found).text()}")
    print(f"\n{time.monotonic() - began:.0f} s; written to {arguments.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
