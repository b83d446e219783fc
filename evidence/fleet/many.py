"""Thousands of recordings of 500 axleboxes: time, memory, size of the store.

``python -m evidence.fleet.many --folder DIR --runs DIR`` prints them. The recordings are those of
`evidence.fleet.signals`, 1.6 s long.
"""

from __future__ import annotations

import argparse
import os
import resource
import time
from pathlib import Path

import numpy as np

import beardyn_core as bd
from beardyn_core.fleet.identity import Axlebox
from evidence.fleet.signals import HEALTHY, RATE, STEP, twin_run, write_recording

_WHO = (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
AXLEBOXES, TRAIN = 500, 20  # and those of a train


def write_many(folder: Path, count: int, kept: Path) -> None:
    """Write recordings in turn of all axleboxes, every hundredth axlebox with a spall."""
    healthy = [twin_run(f"healthy_{seed}", kept) for seed in range(HEALTHY)]
    faulty = twin_run("cup_8", kept)
    folder.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    boxes = [
        Axlebox(f"T{number // TRAIN}", str(number % TRAIN // 2), ("left", "right")[number % 2])
        for number in range(AXLEBOXES)
    ]
    for number in range(count):
        day, place = divmod(number, AXLEBOXES)
        box = boxes[place]
        path = (
            folder
            / box.vehicle
            / f"{box.axle}_{box.side}"
            / f"2026-{1 + day // 28:02d}-{1 + day % 28:02d}.npz"
        )
        path.parent.mkdir(parents=True, exist_ok=True)
        write_recording(path, faulty if place % 100 == 50 else healthy[number % HEALTHY], 1.0, random)


def main() -> None:
    """Add the recordings and print what it took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--runs", type=Path, required=True, help="where the runs of the twin are kept")
    parser.add_argument("--count", type=int, default=10_000)
    args = parser.parse_args()
    write_many(args.folder / "recordings", args.count, args.runs)
    store, begin, cpu = args.folder / "many.sqlite", time.time(), os.times()
    told = bd.fleet(store).add(
        args.folder / "recordings", pattern="{vehicle}/{axle}_{side}/{date}.npz", bearing="HS130x230",
        channels="z=z", unit="m/s2", scale=STEP, rate_Hz=RATE, tacho_channel="tacho", estimator="none",
        workers=os.cpu_count() or 1,
    )  # fmt: skip
    seconds, after = time.time() - begin, os.times()
    used = after.children_user + after.user - cpu.children_user - cpu.user
    own, child = (resource.getrusage(who).ru_maxrss / 1024.0 for who in _WHO)
    added, size = max(told.added, 1), store.stat().st_size
    print(f"{told.added} recordings added, {len(told.refused)} refused, in {seconds:.0f} s")
    print(f"processor: {used / added:.3f} s a recording; load of the machine {os.getloadavg()[0]:.1f}")
    print(f"memory: {own:.0f} MB, and {child:.0f} MB of the largest process that analysed")
    print(f"store: {size / 1e6:.1f} MB, {size / added / 1e3:.1f} kB a recording")
    begin = time.time()
    status = bd.fleet(store).status()
    print(f"status of {len(status.standings)} axleboxes in {time.time() - begin:.1f} s: {status.counts()}")


if __name__ == "__main__":
    main()
