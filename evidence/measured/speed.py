"""How often the speed found in a vibration is in its interval: ``python -m evidence.measured.speed``.

The interval was fitted on records of CWRU; those of MFPT had no part in it. The speed is sought from three
quarters of the stated one to four thirds, so that its place in the range tells nothing.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.monitor.speed import speed_from_vibration
from evidence.measured.cases import Listening, listenings, records

RANGE = (0.75, 4.0 / 3.0)  # of the stated speed
INTERVAL = 1.96  # standard deviations
PIECE = 10.0  # of a record, as files are searched, [s]


@dataclass(frozen=True)
class Told:
    """What the vibration says of a speed that is known."""

    certain: bool
    error: A[float, "largest over the record, relative, [-]"]
    half: A[float, "half of the interval there, relative, [-]"]

    @property
    def covered(self) -> bool:
        """Whether the stated speed is in the interval all along."""
        return self.error <= self.half


def told_of(listening: Listening) -> Told:
    """Find the speed in the beginning of a record."""
    signal = listening.acceleration[: int(PIECE * listening.rate), None]
    speed = listening.shaft_frequency
    low, high = (share * speed for share in RANGE)
    track = speed_from_vibration(signal, listening.rate, low, high, (listening.plate.frequencies,))
    if not track.certain:
        return Told(False, np.nan, np.nan)
    error = np.abs(track.frequency / speed - 1.0)
    half = INTERVAL * track.deviation / speed
    worst = int(np.argmax(error - half))
    return Told(True, float(error[worst]), float(half[worst]))


def main(arguments: Sequence[str] | None = None) -> int:
    """Search the records and print each, and how many are covered."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--cwru", type=Path, metavar="FOLDER", help="with the .mat files of CWRU")
    parser.add_argument("--mfpt", type=Path, metavar="FOLDER", help="with the .mat files of MFPT")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="every Nth record; default all")
    args = parser.parse_args(arguments)
    received = []
    print("| record | certain | error % | half of the interval % |\n|---|---|--:|--:|")
    for record in records(args.cwru, args.mfpt)[:: args.every]:
        told = told_of(next(listenings(record)))
        received.append(told)
        numbers = f"{100.0 * told.error:.2f} | {100.0 * told.half:.2f}" if told.certain else " | "
        print(f"| {record.name} | {'yes' if told.certain else 'no'} | {numbers} |", flush=True)
    certain = [each for each in received if each.certain]
    covered = sum(each.covered for each in certain)
    print(f"\ncertain: {len(certain)} of {len(received)}; covered: {covered} of {len(certain)}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
