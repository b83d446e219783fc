"""All benchmarks in one run: tables on the terminal, numbers in a JSON file."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable
from pathlib import Path

from benchmarks import (
    kernel_levers,
    naive_model,
    paced_twin,
    parallel_twins,
    real_time_factor,
    right_answers,
    sink_throughput,
    starting,
    step_costs,
)
from benchmarks.runs import Table, machine

PARTS = (
    *("right", "train", "rtf", "fast", "scenes", "stages", "levers", "laminae", "rollers"),
    *("start", "compile", "sinks", "parallel", "paced", "yardstick"),
)


def measure(part: str, quick: bool, done: dict[str, Table]) -> Table:
    """Run one part; ``quick`` is a fifth of the turns."""
    turns = 8 if quick else 40
    parts: dict[str, Callable[[], Table]] = {
        "right": lambda: right_answers.right_answers(turns),
        "train": lambda: right_answers.train(4 if quick else 32),
        "rtf": lambda: real_time_factor.tiers_and_effects(turns),
        "fast": lambda: real_time_factor.fast_tiers(turns),
        "scenes": lambda: real_time_factor.scenes(turns),
        "stages": lambda: step_costs.stages(2 * turns),
        "levers": lambda: kernel_levers.kernel_levers(turns),
        "laminae": lambda: step_costs.laminae(turns // 2),
        "rollers": lambda: step_costs.rollers(turns // 2),
        "start": lambda: starting.cold_start(3 if quick else 9),
        "compile": starting.compiling,
        "sinks": lambda: sink_throughput.sinks(25, 3 if quick else 9),
        "parallel": lambda: parallel_twins.parallel(turns // 2),
        "paced": lambda: paced_twin.paced(6.0 if quick else 60.0),
        "yardstick": lambda: naive_model.yardstick(1e-5 if quick else 5e-5, _standard_rtf(done, turns)),
    }
    return parts[part]()


def _standard_rtf(done: dict[str, Table], turns: int) -> float:
    """Find the factor of the full tier with standard effects, measured in this run."""
    table = done.get("rtf") or real_time_factor.standard_alone(turns)
    (row,) = [row for row in table.rows if row[0] == "full standard"]
    return float(row[2])


def main() -> None:
    """Measure, print, write."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument(
        "--json", metavar="FILE", type=Path, default=Path("bench.json"), help="where the numbers go"
    )
    parser.add_argument("--only", nargs="+", choices=PARTS, default=list(PARTS), help="parts to measure")
    parser.add_argument("--quick", action="store_true", help="fewer turns, for a quick look")
    arguments = parser.parse_args()
    about = machine()
    print(f"{about['processor']}, one core; load average before: {about['load_average_before']:.2f}")
    began = time.perf_counter()
    done: dict[str, Table] = {}
    for part in PARTS:
        if part in arguments.only:
            done[part] = measure(part, arguments.quick, done)
            print("\n".join(done[part].lines()), flush=True)
            tables = {table.name: table.to_json() for table in done.values()}
            result = {"machine": about, "wall_s": time.perf_counter() - began, "tables": tables}
            arguments.json.write_text(json.dumps(result, indent=1), encoding="utf-8")
    print(f"\n{time.perf_counter() - began:.0f} s; numbers in {arguments.json}")


if __name__ == "__main__":
    main()
