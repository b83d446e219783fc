"""Kill a recorder again and again while a twin runs: ``python -m evidence.ros.kills [--times 100]``."""

from __future__ import annotations

import argparse
import random
import signal
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated as A

from beardyn_core.record.reading import read_run
from test.ros.graph import Graph

LARGEST_LOSS_S = 1.0
KILLS_OF_ONE_RUN = 20


@dataclass(frozen=True)
class Kill:
    """One killed recorder."""

    number: int
    held_s: A[float, "vibration in the file, [s]"]
    lost_s: A[float, "wall time from the last sample in the file to the kill, [s]"]
    gaps: A[int, "places in the file where samples are missing"]


def killed_recorders(graph: Graph, folder: Path, times: int, seed: int = 1) -> Iterator[Kill]:
    """Record a twin that runs in real time, kill the recorder at a random moment, and read what it left.

    Parameters
    ----------
    graph : Graph
    folder : Path
        Of the files.
    times : int
    seed : int
        Of the moments.
    """
    moments = random.Random(seed)
    graph.fake_twin(speed_factor=1.0)
    graph.listen("vibration")
    graph.fake_load(duration=max(600.0, 30.0 * times))
    graph.until_state("running")
    for number in range(1, times + 1):
        path = folder / f"killed_{number}.mcap"
        graph.node_process("recorder", output=str(path))
        graph.until(partial(_is_filled, path), f"file {number}")
        graph.until(partial(_is_past, time.monotonic() + moments.uniform(0.0, 2.0)), "a moment")
        graph.processes.signal("recorder", signal.SIGKILL)
        received = _last_sample(graph)
        vibration = read_run(path).vibration
        step = 1.0 / vibration.rate
        yield Kill(
            number,
            len(vibration) * step,
            (received - int(vibration.sample[-1])) * step,
            int((vibration.sample[1:] - vibration.sample[:-1] != 1).sum()),
        )
        path.unlink()
        graph.messages["vibration"].clear()


def _is_filled(path: Path) -> bool:
    return path.is_file() and path.stat().st_size > 200_000


def _is_past(moment: float) -> bool:
    return time.monotonic() >= moment


def _last_sample(graph: Graph) -> int:
    """Return the running index of the last sample that the listener has received."""
    from beardyn_core.record.clouds import cloud_to_arrays

    return int(cloud_to_arrays(graph.messages["vibration"][-1])["sample"][-1])


def main(words: Sequence[str] | None = None) -> int:
    """Run the trial; gives 1 when a file lacked more than `LARGEST_LOSS_S`."""
    parser = argparse.ArgumentParser(prog="python -m evidence.ros.kills", description=__doc__)
    parser.add_argument("--times", type=int, default=100, help="recorders to kill (default 100)")
    parser.add_argument("--seed", type=int, default=1, help="of the moments (default 1)")
    args = parser.parse_args(words)
    found: list[Kill] = []
    while len(found) < args.times:
        count = min(KILLS_OF_ONE_RUN, args.times - len(found))
        with tempfile.TemporaryDirectory(prefix="kills-") as name, Graph(Path(name)) as graph:
            for each in killed_recorders(graph, Path(name), count, args.seed + len(found)):
                print(
                    f"{each.number:4} held {each.held_s:6.3f} s, lost {each.lost_s:6.3f} s, gaps {each.gaps}"
                )
                found.append(each)
    worst = max(each.lost_s for each in found)
    mean = sum(each.lost_s for each in found) / len(found)
    print(f"{len(found)} killed: lost {mean:.3f} s on average, {worst:.3f} s at worst")
    return int(worst > LARGEST_LOSS_S or any(each.gaps for each in found))


if __name__ == "__main__":
    sys.exit(main())
