"""Do nodes that leave stop those who stay? ``python -m evidence.ros.leaving [--plain]``.

Watchers stay in a graph that comers join, speak in and leave, as fast as it goes. A watcher that makes no
sound for 8 s has stopped for good (issue 6502 of Fast DDS) and is replaced. To see in a minute what otherwise
happens once in 450 graphs, watchers announce themselves every 4 ms instead of every 0.2 s, and
acknowledgements take 1 ms longer (`slow_acknowledgement.c`, which needs a C compiler and the Fast DDS 3.2 of
the wheels).
"""

from __future__ import annotations

import argparse
import os
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_ros.environment import (
    FASTDDS_LOCAL_PROFILE,
    PROFILE_VARIABLES,
    prepare_environment,
    this_machine_only,
)
from beardyn_ros.processes import free_domain_id, release_domain_id

STOPPED_AFTER_S = 8.0
SLOW = Path(__file__).with_name("slow_acknowledgement.c")
USUAL_PERIOD = "<leaseAnnouncement><sec>0</sec><nanosec>200000000</nanosec></leaseAnnouncement>"


@dataclass(frozen=True)
class Leavings:
    """What became of the watchers."""

    joins: int
    stopped: A[int, "watchers that stopped for good"]
    busy: A[int | None, "removals of a writer that was being answered; None: not counted"]
    found_s: A[tuple[float, ...], "from a comer's first publisher until all watchers listen, sorted, [s]"]


def profile_text(period_s: float) -> str:
    """Write the profile of this machine with another period of announcements, [s]."""
    text = FASTDDS_LOCAL_PROFILE.read_text()
    assert USUAL_PERIOD in text
    seconds, nanoseconds = divmod(round(period_s * 1e9), 10**9)
    wanted = f"<sec>{seconds}</sec><nanosec>{nanoseconds}</nanosec>"
    return text.replace(USUAL_PERIOD, f"<leaseAnnouncement>{wanted}</leaseAnnouncement>")


def slow_acknowledgements(folder: Path, delay_us: int) -> dict[str, str]:
    """Compile what makes acknowledgements slow; variables of processes that have it, none without means."""
    compiler = shutil.which("cc")
    libraries = [path for folder in sys.path for path in Path(folder).parent.parent.glob("libfastdds.so.3.2")]
    if compiler is None or not libraries:
        return {}
    built = folder / "slow_acknowledgement.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-o", built, SLOW, "-ldl"], check=True)
    return {
        "LD_PRELOAD": str(built),
        "FASTDDS_LIBRARY": str(libraries[0]),
        "SLOW_ACKNOWLEDGEMENT_US": str(delay_us),
        "BUSY_LOG": str(folder / "busy"),
    }


def leavings(joins: int, plain: bool, folder: Path) -> Leavings:
    """Let comers join and leave; the profile and everything else is in the environment.

    Parameters
    ----------
    joins : int
    plain : bool
        Leave by `destroy_node` alone instead of `leave_quietly`.
    folder : Path
    """
    from test.ros.comers import WATCHERS, come_and_go, watch

    domain = free_domain_id()
    watchers = [_fork(watch, domain) for _ in range(WATCHERS)]
    for _, pipe in watchers:
        os.read(pipe, 1)
    comer, comings = _fork(come_and_go, domain, plain)
    received = dict.fromkeys((pipe for _, pipe in watchers), time.monotonic())
    stopped, rest = 0, b""
    found: list[float] = []
    try:
        while len(found) < joins:
            ready = select.select([comings, *received], [], [], 1.0)[0]
            for pipe in ready:
                told = os.read(pipe, 4096)
                if pipe == comings:
                    assert told, "the comer has ended"
                    *lines, rest = (rest + told).split(b"\n")
                    found += [float(line) for line in lines]
                else:
                    received[pipe] = time.monotonic()
            for place, (watcher, pipe) in enumerate(watchers):
                if time.monotonic() - received[pipe] > STOPPED_AFTER_S:
                    stopped += 1
                    _end(watcher, pipe)
                    del received[pipe]
                    watchers[place] = _fork(watch, domain)
                    received[watchers[place][1]] = time.monotonic()
    finally:
        for process, pipe in (*watchers, (comer, comings)):
            _end(process, pipe)
        release_domain_id(domain)
    log = folder / "busy"
    counted = "LD_PRELOAD" in os.environ
    busy = (log.stat().st_size if log.exists() else 0) if counted else None
    return Leavings(joins, stopped, busy, tuple(sorted(found)))


def _fork(run: Callable[..., None], *words: Any) -> tuple[int, int]:
    """Run a function in a new process, with a pipe from it; no context of ROS is alive here."""
    reading, writing = os.pipe()
    if process := os.fork():
        os.close(writing)
        return process, reading
    try:
        run(writing, *words)
    finally:
        os._exit(1)


def _end(process: int, pipe: int) -> None:
    os.kill(process, signal.SIGKILL)
    os.waitpid(process, 0)
    os.close(pipe)


def main(words: Sequence[str] | None = None) -> int:
    """Count what is left behind and print it."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.leaving", description=__doc__)
    parser.add_argument("--plain", action="store_true", help="leave by destroy_node alone")
    parser.add_argument("--joins", type=int, default=60)
    parser.add_argument("--period", type=float, default=0.004, help="of announcements, [s] (default 0.004)")
    parser.add_argument("--delay", type=int, default=1000, help="of acknowledgements, [us] (default 1000)")
    parser.add_argument("--inside", help=argparse.SUPPRESS)  # a folder: the environment is made
    args = parser.parse_args(words)
    if args.inside:
        told = leavings(args.joins, args.plain, Path(args.inside))
        middle, late = (told.found_s[int(share * len(told.found_s))] for share in (0.5, 0.99))
        busy = "not counted" if told.busy is None else told.busy
        print(
            f"{told.joins} joins, announcements every {args.period:g} s: {told.stopped} watcher(s) stopped, "
            f"{busy} removal(s) of a writer in an answer; found after {middle:.3f} s (99 %: {late:.3f} s)"
        )
        return 0
    prepare_environment()
    with tempfile.TemporaryDirectory(prefix="leaving-") as name:
        profile = Path(name) / "profile.xml"
        profile.write_text(profile_text(args.period))
        own = {**this_machine_only(), PROFILE_VARIABLES[0]: str(profile)}
        environment = {**os.environ, **own, **slow_acknowledgements(Path(name), args.delay)}
        again = [sys.executable, "-m", "evidence.ros.leaving", *(sys.argv[1:] if words is None else words)]
        return subprocess.run([*again, "--inside", name], env=environment).returncode


if __name__ == "__main__":
    sys.exit(main())
