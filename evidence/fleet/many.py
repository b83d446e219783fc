"""Thousands of recordings of 500 axleboxes: killed again and again, a second writer, time, memory, size.

``python -m evidence.fleet.many --folder DIR --runs DIR`` prints what it finds. The recordings are those of
`evidence.fleet.signals`, 1.6 s long, one a week of each axlebox. ``beardyn fleet add`` adds them as a process
of its own, which is killed with all it has at random times and begun anew; at the end nothing may be missing
and nothing twice. One axlebox in so many has a spall that grows from 2 to 20 mm.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta
from pathlib import Path
from tempfile import TemporaryFile
from typing import Annotated as A

import numpy as np

from beardyn_core.experiments import core_count
from beardyn_core.fleet.identity import Axlebox
from evidence.fleet.signals import HEALTHY, RATE, STEP, WIDTHS_MM, TwinRun, twin_run, write_recording

AXLEBOXES, TRAIN = 500, 20  # and those of a train
BEGIN, EVERY_DAYS = datetime(2025, 1, 6, 10, 0, tzinfo=UTC), 7
KM_A_WEEK = 4200
PATTERN = "{vehicle}/{axle}_{side}/{date}_{mileage_km}.npz"
LATEST_S = 15.0  # after its first recording, within which a process is killed
PATIENCE_S, LOOK_S = 240.0, 0.1
REFUSED = "another process is writing it"


@dataclass(frozen=True)
class Used:
    """What a command has taken, its processes included."""

    wall: A[float, "[s]"]
    processor: A[float, "[s]"]
    memory: A[float, "largest resident set of one of its processes, [MB]"]
    code: A[int, "that it ended with"]
    out: str
    errors: str


def boxes() -> list[Axlebox]:
    """List the axleboxes."""
    return [
        Axlebox(f"T{number // TRAIN}", str(number % TRAIN // 2), ("left", "right")[number % 2])
        for number in range(AXLEBOXES)
    ]


def path_of(box: Axlebox, week: int) -> Path:
    """Name the file of a recording."""
    day = BEGIN + timedelta(days=EVERY_DAYS * week)
    return Path(box.vehicle, f"{box.axle}_{box.side}", f"{day:%Y%m%d}_{100_000 + KM_A_WEEK * week}.npz")


def width_mm(week: int, weeks: int) -> float:
    """Width of a growing spall: by the same factor every week, in the steps that were simulated, [mm]."""
    width = 2.0 * 10.0 ** (week / max(weeks - 1, 1))
    return max(each for each in WIDTHS_MM if each <= width + 1e-9)


def write_many(folder: Path, count: int, faulty: int, kept: Path) -> None:
    """Write recordings in turn of all axleboxes; every so-manieth has a growing spall."""
    healthy = [twin_run(f"healthy_{seed}", kept) for seed in range(HEALTHY)]
    spalls: dict[float, TwinRun] = {}
    random, every = np.random.default_rng(1), boxes()
    weeks = -(-count // AXLEBOXES)
    for number in range(count):
        week, place = divmod(number, AXLEBOXES)
        run = healthy[number % HEALTHY]
        if place % faulty == faulty // 2:
            width = width_mm(week, weeks)
            if width not in spalls:
                spalls[width] = twin_run(f"cup_{width:g}", kept)
            run = spalls[width]
        path = folder / path_of(every[place], week)
        if path.exists():
            continue
        path.parent.mkdir(parents=True, exist_ok=True)
        write_recording(path, run, 1.0, random)


def command(*words: str) -> list[str]:
    """Give the command line of ``beardyn fleet``."""
    return [sys.executable, "-m", "beardyn_core.cli.main", "fleet", *words]


def take(*words: str) -> Used:
    """Run a command of the fleet to its end, and measure what it takes."""
    begin = time.monotonic()
    with TemporaryFile("w+") as out, TemporaryFile("w+") as errors:
        process = subprocess.Popen(command(*words), stdout=out, stderr=errors)
        memory = 0.0
        while True:
            ended, status, usage = os.wait4(process.pid, os.WNOHANG)
            if ended:
                break
            memory = max([memory, *map(largest_memory, family_of(process.pid))])
            time.sleep(LOOK_S)
        process.returncode = os.waitstatus_to_exitcode(status)
        texts = []
        for file in (out, errors):
            file.seek(0)
            texts.append(file.read())
    processor = usage.ru_utime + usage.ru_stime
    return Used(time.monotonic() - begin, processor, memory, process.returncode, *texts)


def family_of(process: int) -> list[int]:
    """List a process and its children that are there."""
    try:
        told = Path(f"/proc/{process}/task/{process}/children").read_text(encoding="ascii")
    except OSError:
        return []
    return [process, *map(int, told.split())]


def largest_memory(process: int) -> float:
    """Read the largest resident set that a process has had so far, [MB]; 0 where it has gone."""
    try:
        lines = Path(f"/proc/{process}/status").read_text(encoding="utf-8").splitlines()
    except OSError:
        return 0.0
    return next((int(line.split()[1]) / 1024.0 for line in lines if line.startswith("VmHWM")), 0.0)


def begun(words: Sequence[str], store: Path) -> subprocess.Popen[bytes]:
    """Begin a command, and wait until it has added a recording or has ended."""
    before, until = counted(store), time.monotonic() + PATIENCE_S
    process = subprocess.Popen(
        command(*words), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True
    )
    while counted(store) == before and process.poll() is None and time.monotonic() < until:
        time.sleep(LOOK_S)
    return process


def kill(process: subprocess.Popen[bytes]) -> None:
    """Kill a command with all its processes."""
    if process.poll() is None:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait(PATIENCE_S)


def counted(store: Path) -> int:
    """Count the recordings in a store; 0 where there is none yet."""
    if not store.exists():
        return 0
    with closing(sqlite3.connect(f"{store.resolve().as_uri()}?mode=ro", uri=True)) as connection:
        try:
            return int(connection.execute("select count(*) from recording").fetchone()[0])
        except sqlite3.OperationalError:  # its tables are not made yet
            return 0


def faults_of(store: Path, folder: Path) -> list[str]:
    """List what is wrong with a store that has all recordings of a folder."""
    with closing(sqlite3.connect(f"{store.resolve().as_uri()}?mode=ro", uri=True)) as connection:
        sound = connection.execute("pragma integrity_check").fetchone()[0]
        rows = [Path(row[0]) for row in connection.execute("select file from recording")]
    there = set(folder.rglob("*.npz"))
    found = [] if sound == "ok" else [f"the store is damaged: {sound}"]
    if len(rows) != len(set(rows)):
        found.append(f"{len(rows) - len(set(rows))} recordings are in it twice")
    if missing := there - set(rows):
        found.append(f"{len(missing)} recordings are missing, such as {min(missing)}")
    return found


def main() -> None:
    """Add the recordings and print what it took."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", type=Path, required=True)
    parser.add_argument("--runs", type=Path, required=True, help="where the runs of the twin are kept")
    parser.add_argument("--count", type=int, default=10_000, help="recordings")
    parser.add_argument("--kills", type=int, default=8, help="times that the process is killed")
    parser.add_argument("--faulty", type=int, default=100, help="one axlebox in so many has a spall")
    parser.add_argument("--workers", type=int, default=core_count())
    parser.add_argument("--estimator", default="none", help="as of `beardyn fleet add`")
    args = parser.parse_args()
    recordings, store = args.folder / "recordings", args.folder / "many.sqlite"
    begin = time.monotonic()
    write_many(recordings, args.count, args.faulty, args.runs)
    print(f"{args.count} recordings written in {time.monotonic() - begin:.0f} s", flush=True)
    words = [
        *("add", str(recordings), "--store", str(store), "--pattern", PATTERN, "--bearing", "HS130x230"),
        *("--channels", "z=z", "--unit", "m/s2", "--scale", str(STEP), "--rate-hz", str(RATE)),
        *("--tacho-channel", "tacho", "--estimator", args.estimator, "--workers", str(args.workers)),
    ]
    random = np.random.default_rng(2)
    for number in range(args.kills):
        process, before = begun(words, store), counted(store)
        if number == 0:
            second = take(*words)
            assert second.code == 2, second
            assert REFUSED in second.errors, second
            print("a second writer is refused", flush=True)
        after = float(random.uniform(0.0, LATEST_S))
        time.sleep(after)
        seen = counted(store)
        kill(process)
        now = counted(store)
        print(f"killed {after:.1f} s after its first one: {now} recordings, {now - before} more", flush=True)
        assert now >= seen >= before, "recordings are lost"
    added = take(*words, "--json")
    told = json.loads(added.out)
    found = faults_of(store, recordings)
    print(f"{told['added']} added, {told['known']} were there, {len(told['refused'])} refused")
    print(f"missing, twice or damaged: {'; '.join(found) or 'nothing'}")
    per = added.processor / max(told["added"], 1)
    print(f"processor: {per:.3f} s a recording, {added.wall:.0f} s in all, load {os.getloadavg()[0]:.1f}")
    print(f"memory: {added.memory:.0f} MB of the largest process")
    size, there = store.stat().st_size, counted(store)
    print(f"store: {size / 1e6:.1f} MB, {size / there / 1e3:.2f} kB a recording")
    again = take(*words)
    print(f"the same command once more: {again.wall:.1f} s, {again.processor:.1f} s of a processor")
    status = take("status", "--store", str(store))
    print(f"status: {status.wall:.1f} s, {status.memory:.0f} MB: {status.out.splitlines()[0]}")
    page = args.folder / "many.html"
    report = take("report", "--store", str(store), "--html", str(page), "--force")
    print(f"report: {report.wall:.1f} s, {report.memory:.0f} MB, page {page.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
