"""How the speed of this tree compares with that of another one: the runs of `right_answers`, block by block.

``python -m benchmarks.two_trees /path/to/older/tree`` starts a process of each tree, both with a compiled
step, and has them advance in turns; the ratio is that of their processor times, so that other work on the
machine slows both. The cache of compiled kernels is told by ``$BEARDYN_CACHE_DIR`` as usual.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
from pathlib import Path

_HERE = Path(__file__).resolve().parents[1]
_WORKER = """
import sys, time
from benchmarks.right_answers import _scenes
from benchmarks.runs import started
(scene,) = [scene for name, scene in _scenes().items() if sys.argv[1] in name]
twin = started(scene, int(sys.argv[2]))
count = twin.blocks_at_once
twin.advance(count)
print("ready", flush=True)
for _ in sys.stdin:
    began = time.process_time()
    twin.advance(count)
    print((time.process_time() - began) / (0.02 * count), flush=True)
"""


def _start(tree: Path, run: str, blocks: int) -> subprocess.Popen[str]:
    environment = {**os.environ, "PYTHONPATH": str(tree)}
    worker = subprocess.Popen(
        [sys.executable, "-c", _WORKER, run, str(blocks)], cwd=tree, env=environment, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE,
    )  # fmt: skip
    assert worker.stdout is not None
    if "ready" not in worker.stdout.readline():
        raise SystemExit(f"{tree} does not run {run!r}")
    return worker


def _advance(worker: subprocess.Popen[str]) -> float:
    assert worker.stdin is not None
    assert worker.stdout is not None
    worker.stdin.write("\n")
    worker.stdin.flush()
    return float(worker.stdout.readline())


def compare(other: Path, run: str, turns: int) -> None:
    """Print the processor seconds a simulated second of both trees and the median ratio of the turns."""
    workers = [_start(tree, run, 16 * (turns + 2)) for tree in (other, _HERE)]
    taken: tuple[list[float], list[float]] = ([], [])
    for turn in range(turns):
        for which in (0, 1) if turn % 2 else (1, 0):
            taken[which].append(_advance(workers[which]))
    for worker in workers:
        worker.terminate()
    old, new = (statistics.median(each) for each in taken)
    ratios = sorted(a / b for a, b in zip(*taken, strict=True))
    middle = f"{ratios[turns // 4]:.3f} to {ratios[3 * turns // 4]:.3f}"
    ratio = statistics.median(ratios)
    quickest = " and ".join(f"{1e3 * min(each):.2f}" for each in taken)
    print(f"{run}: {1 / old:.3f} before, {1 / new:.3f} now, old / new {ratio:.3f} ({middle})")
    print(f"{run}: quickest {quickest} ms a simulated second")


def main() -> None:
    """Compare the runs that are named."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.two_trees", description=__doc__)
    parser.add_argument("other", type=Path, help="the older tree")
    parser.add_argument("--runs", nargs="+", default=["preset"], help="a part of the name of each run")
    parser.add_argument("--turns", type=int, default=24)
    given = parser.parse_args()
    for run in given.runs:
        compare(given.other.resolve(), run, given.turns)


if __name__ == "__main__":
    main()
