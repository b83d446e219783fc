"""What a second core could give a step of the full tier at most: ``python benchmarks/two_cores.py``.

Two threads that advance half of the rollers each would wait for each other twice a step: rings and cages go
on from the sums over all rollers, and rollers from the rings. Measured is what such a wait takes, on two
counters that the threads write and read in turn, and what share of a step the rollers are; from both follows
the most that the two could gain. Run it on a machine with two idle cores.
"""

from __future__ import annotations

import statistics
import threading
import time
from typing import Any

import numba
import numpy as np
from numba import types
from numpy.typing import NDArray

from beardyn_core.physics.lanes.lanes import typed_intrinsic
from beardyn_core.sensors.stage_clock import StageClock
from benchmarks.right_answers import full_scenes
from benchmarks.runs import SETTLING_BLOCKS, Table, started

WAITS, TURNS, BLOCKS = 200_000, 9, 40
ROLLERS = ("motion", "contact", "film", "traction", "losses", "rib", "cage", "solve", "settle")
_OWN_LINE = 16  # counters apart, two cache lines


@typed_intrinsic
def _read(_typing: Any, counters: Any, place: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        view = context.make_array(signature.args[0])(context, builder, args[0])
        return builder.load_atomic(builder.gep(view.data, [args[1]]), "acquire", 8)

    return types.int64(counters, types.intp), generate


@typed_intrinsic
def _write(_typing: Any, counters: Any, place: Any, count: Any) -> Any:
    def generate(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        view = context.make_array(signature.args[0])(context, builder, args[0])
        builder.store_atomic(args[2], builder.gep(view.data, [args[1]]), "release", 8)
        return context.get_dummy_value()

    return types.void(counters, types.intp, types.int64), generate


@numba.njit(nogil=True)
def _meet(own: int, other: int, counters: NDArray[np.int64], waits: int) -> None:
    """Tell the other thread of every count, and wait until it has come as far."""
    for count in range(1, waits + 1):
        _write(counters, own, count)
        while _read(counters, other) < count:
            pass


def wait_s() -> float:
    """Measure the time of one wait of two threads for each other, the median of several turns, [s]."""
    _meet(0, _OWN_LINE, np.full(2 * _OWN_LINE, WAITS), 1)
    taken = []
    for _ in range(TURNS):
        counters = np.zeros(2 * _OWN_LINE, dtype=np.int64)
        places = ((0, _OWN_LINE), (_OWN_LINE, 0))
        threads = [threading.Thread(target=_meet, args=(*each, counters, WAITS)) for each in places]
        began = time.perf_counter()
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        taken.append((time.perf_counter() - began) / WAITS)
    return statistics.median(taken)


def two_cores() -> Table:
    """Work out the most that two threads would gain, for each right answer of the full tier."""
    wait, rows = wait_s(), []
    for name, scene in full_scenes().items():
        twin = started(scene, BLOCKS + SETTLING_BLOCKS)
        shares, steps = [], []
        for _ in range(BLOCKS + SETTLING_BLOCKS):
            twin.stages = StageClock()
            done = twin.advance()
            times = {each.stage: each.seconds for each in twin.stages.times()}
            shares.append(sum(times.get(stage, 0.0) for stage in ROLLERS) / sum(times.values()))
            steps.append(done.wall_s / (512 * scene.numerics.steps_per_sample))
        share, step = (statistics.median(each[SETTLING_BLOCKS:]) for each in (shares, steps))
        assert twin._state is not None
        blocks = twin._state.rollers.shape[0]
        larger = -(-blocks // 2) / blocks
        left = (1.0 - share) + share * larger + 2.0 * wait / step
        rows.append((name, blocks, 1e6 * step, 100.0 * share, 1e6 * wait, 1.0 / left))
    return Table(
        "two_cores",
        "What a second core could give a step of the full tier",
        ("run", "blocks of rollers", "us/step", "rollers %", "us a wait", "at most"),
        rows,
        "At most: rollers shared as evenly as whole blocks allow, two waits a step, nothing else in the way.",
    )


if __name__ == "__main__":
    print("\n".join(two_cores().lines()))
