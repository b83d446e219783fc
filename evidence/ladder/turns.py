"""What the levels of a ladder cost, measured in turns: a machine that slows down then slows all of them."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np

from beardyn_core.base.errors import ValidityError
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder_levels import Level
from beardyn_core.study.ladder_result import Cost, Ladder, LevelResult
from beardyn_core.twin import Twin

TURNS, SETTLING = 9, 1
TURN_S = 0.1  # of wall time, so that a run finds its data in the caches for nearly all of it
_LONGEST_S = 0.5  # simulated in a turn


def in_turns(ladder: Ladder, scene: Scene, turns: int = TURNS) -> Ladder:
    """Replace the costs of a ladder's levels by those of turns in one process.

    A level that failed in the climb, or fails in a turn, which go on for longer, keeps what the climb found.

    Parameters
    ----------
    ladder : Ladder
    scene : Scene
        The one that was climbed.
    turns : int
        Of each level, after one that is not counted.
    """
    timed = [row for row in (ladder.reference, *ladder.rows) if row.errors]
    blocks = [_blocks_of_a_turn(row) for row in timed]
    twins = [
        _started(row.level, scene, count * (turns + SETTLING))
        for row, count in zip(timed, blocks, strict=True)
    ]
    taken = np.zeros((turns + SETTLING, len(timed)))
    going = list(range(len(timed)))
    for turn in range(turns + SETTLING):
        for place in going[:: 1 if turn % 2 else -1]:
            began = time.perf_counter()
            try:
                _advance(twins[place], blocks[place])
            except ValidityError:
                going.remove(place)
                continue
            simulated = blocks[place] * 1e-9 * Twin.block_ns
            taken[turn, place] = (time.perf_counter() - began) / simulated
    lower, median, upper = np.quantile(taken[SETTLING:], (0.25, 0.5, 0.75), axis=0)
    costs = {
        timed[place].level.name: Cost(float(median[place]), float(lower[place]), float(upper[place]))
        for place in going
    }

    def costing(row: LevelResult) -> LevelResult:
        return replace(row, cost=costs.get(row.level.name, row.cost))

    return replace(
        ladder,
        reference=costing(ladder.reference),
        neighbour=None if ladder.neighbour is None else costing(ladder.neighbour),
        rows=tuple(costing(row) for row in ladder.rows),
    )


def _blocks_of_a_turn(row: LevelResult) -> int:
    simulated = min(TURN_S / row.cost.median, _LONGEST_S)
    return max(math.ceil(simulated / (1e-9 * Twin.block_ns)), 1)


def _started(level: Level, scene: Scene, blocks: int) -> Twin:
    return start(level.applied(scene), blocks * 1e-9 * Twin.block_ns).twin


def _advance(twin: Twin, blocks: int) -> None:
    """Advance by blocks, as many at once as a run on the desk takes."""
    for first in range(0, blocks, twin.blocks_at_once):
        twin.advance(min(twin.blocks_at_once, blocks - first))
