"""``python -m evidence.random``: random scenes, what `make random` runs."""

from __future__ import annotations

import argparse
import sys
import time
from collections import Counter
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.experiments import EngineError
from evidence.random.book import code, results, try_many
from evidence.random.scenes import KERNELS, case
from evidence.random.trial import FAILED, VERDICTS, Tried

TELL_EVERY = 500


def main(words: list[str] | None = None) -> int:
    """Try random scenes; gives the exit code: 0 when none has failed."""
    parser = argparse.ArgumentParser(
        prog="make random ARGS=...",
        description="Random legal scenes, each finite or ended with a sentence. Ctrl-C loses nothing: the "
        "same command goes on.",
    )
    parser.add_argument("--fast", type=int, default=200, metavar="N", help="scenes in the fast tiers (200)")
    parser.add_argument("--full", type=int, default=20, metavar="N", help="scenes in tier full (20)")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of all draws (1)")
    parser.add_argument("--jobs", type=int, default=2, metavar="N", help="processes side by side (2)")
    parser.add_argument("-o", "--output", type=Path, default=Path("random_runs"), metavar="DIR",
                        help="folder of results (random_runs)")  # fmt: skip
    parser.add_argument("--show", nargs=2, metavar=("SPEED", "NUMBER"), help="print a scene: --show fast 17")
    arguments = parser.parse_args(words)
    if arguments.jobs < 1:
        parser.error(f"--jobs is {arguments.jobs}; at least 1 is needed")
    if arguments.show:
        speed, number = arguments.show
        if speed not in KERNELS or not number.isdigit():
            parser.error(f"--show is {speed} {number}; it must be {' or '.join(KERNELS)} and a number")
        print(case(int(number), arguments.seed, speed).text, end="")
        return 0
    failed = 0
    try:
        for speed in KERNELS:
            failed += _many(speed, getattr(arguments, speed), arguments)
    except KeyboardInterrupt:
        print(f"\ninterrupted; the same command goes on with what is in {arguments.output}", file=sys.stderr)
        return 130
    except (InputError, EngineError) as error:
        print(error, file=sys.stderr)
        return 2
    return 1 if failed else 0


def _many(speed: str, count: int, arguments: argparse.Namespace) -> int:
    """Try scenes of a speed, tell what came of them; gives how many have failed."""
    began, index = time.monotonic(), 0

    def tell(each: Tried) -> None:
        nonlocal index
        index += 1
        if each.verdict == FAILED:
            print(f"{speed} {each.number}: FAILED\n{each.says}", flush=True)
        if index % TELL_EVERY == 0:
            print(f"{speed}: {index} in {time.monotonic() - began:.0f} s", flush=True)

    try_many(arguments.output, speed, count, arguments.seed, arguments.jobs, tell)
    done = [each for each in results(arguments.output, speed, arguments.seed, code()) if each.number < count]
    counts = Counter(each.verdict for each in done)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in VERDICTS if counts[verdict])
    print(f"{speed}: {len(done)} scenes: {told or 'none'}; {time.monotonic() - began:.0f} s")
    return counts[FAILED]


if __name__ == "__main__":
    sys.exit(main())
