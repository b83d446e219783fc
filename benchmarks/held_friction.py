"""What it costs in accuracy to hold the friction of raceways: every few steps against every step.

``python -m benchmarks.held_friction`` runs the full tier's right answers with `friction_substeps` at several
spacings, each from the same few beginnings a nanometre apart, for the bearing is chaotic: what the runs of
every step differ by among themselves is what a difference has to be seen beside. Runs of one scene take
turns, block by block, and their processor time is compared too.
"""

from __future__ import annotations

import argparse
import json
import math
import statistics
import time
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.physics.bodies.layout import (
    CONE_BODY,
    CONTACT_OUTPUT,
    CUP_BODY,
    POSITION,
    RADIUS,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
)
from beardyn_core.physics.tiers.status import chatter_index
from beardyn_core.scene.scene import Scene
from beardyn_core.study.measures import third_octave_levels
from beardyn_core.twin import Twin
from benchmarks.right_answers import full_scenes
from benchmarks.runs import Table, started

NAMES = ("torque", "force", "deflection", "largest load")
BANDS = 9  # the highest third octaves, from 1.6 kHz
_SETTLING = 5  # blocks
_APART = 1e-9  # [m]


@dataclass
class Run:
    """One run: its twin, and what each block said."""

    twin: Twin
    steps: float
    seconds: list[float] = field(default_factory=list)
    found: list[tuple[float, ...]] = field(default_factory=list)
    acceleration: list[NDArray[np.float64]] = field(default_factory=list)
    chatter: float = 0.0

    @staticmethod
    def of(scene: Scene, steps: float, beginning: int, blocks: int) -> Run:
        """Begin a run."""
        twin = started(scene, blocks)
        held = twin._kernel_parameters.held._replace(steps=steps)
        twin._kernel_parameters = twin._kernel_parameters._replace(held=held)
        assert twin._state is not None
        twin._state.rollers[:, RADIUS] += beginning * _APART
        return Run(twin, steps)

    def advance(self) -> None:
        """Advance by a block."""
        began = time.process_time()
        block = self.twin.advance()
        self.seconds.append(time.process_time() - began)
        state, signals = self.twin._state, self.twin.step_signals
        assert state is not None
        place = state.bodies[:, POSITION : POSITION + 3]
        loads = np.linalg.norm(state.rollers[:, CONTACT_OUTPUT : CONTACT_OUTPUT + 3], axis=1)
        self.found.append(
            (
                float(signals[:, SIGNAL_TORQUE].mean()),
                float(np.linalg.norm(signals[:, SIGNAL_FORCE : SIGNAL_FORCE + 3].mean(axis=0))),
                float(np.linalg.norm(place[CONE_BODY] - place[CUP_BODY])),
                float(loads.max()),
            )
        )
        self.acceleration.append(block.acceleration[0, :, 2])
        self.chatter = max(self.chatter, float(chatter_index(state, len(signals)).max()))

    def means(self) -> NDArray[np.float64]:
        """Average `NAMES` over the blocks after settling."""
        return np.asarray(np.mean(self.found[_SETTLING:], axis=0))

    def levels(self) -> NDArray[np.float64]:
        """Work out the third octaves of the vertical acceleration, [dB]."""
        return third_octave_levels(np.concatenate(self.acceleration[_SETTLING:])[:, None])[-BANDS:]


def held_friction(spacings: list[float], blocks: int, beginnings: int, names: list[str]) -> Table:
    """Compare spacings with the first of them."""
    rows: list[tuple[Any, ...]] = []
    for name, scene in full_scenes().items():
        if names and not any(part in name for part in names):
            continue
        quiet = replace(scene, sensors=tuple(replace(each, noise_density=0.0) for each in scene.sensors))
        runs = [
            Run.of(quiet, steps, beginning, blocks + 1)
            for steps in spacings
            for beginning in range(beginnings)
        ]
        for turn in range(blocks):
            for run in runs if turn % 2 else reversed(runs):
                run.advance()
        groups = [runs[first : first + beginnings] for first in range(0, len(runs), beginnings)]
        rows += [_row(name, group, groups[0]) for group in groups]
    return Table(
        "held_friction",
        "Friction of the raceways every so many steps, against every step",
        (
            "run", "steps", "old / new time", *(f"{each} %" for each in NAMES), "chatter",
            "third octaves dB", "of every step, apart dB",
        ),
        rows,
        f"{blocks} blocks of 20 ms, {beginnings} beginnings 1 nm apart; +- twice the standard error of the "
        "difference. Third octaves: largest difference of the mean levels, 1.6 to 10 kHz; beside it the "
        "largest standard error of such a difference of runs of every step, doubled.",
    )  # fmt: skip


def _row(name: str, group: list[Run], first: list[Run]) -> tuple[Any, ...]:
    pairs = zip(first, group, strict=True)
    ratio = statistics.median(
        a / b for old, new in pairs for a, b in zip(old.seconds[1:], new.seconds[1:], strict=True)
    )
    means, reference = (np.array([run.means() for run in runs]) for runs in (group, first))
    levels, wanted = (np.array([run.levels() for run in runs]) for runs in (group, first))
    scale = 100.0 / reference.mean(axis=0)
    difference = scale * (means.mean(axis=0) - reference.mean(axis=0))
    count = len(group)
    doubt = 2.0 * np.abs(scale) * np.sqrt((means.var(axis=0, ddof=1) + reference.var(axis=0, ddof=1)) / count)
    cells = tuple(f"{d:+.3f} +- {s:.3f}" for d, s in zip(difference, doubt, strict=True))
    apart = 2.0 * math.sqrt(2.0 / count) * wanted.std(axis=0, ddof=1)
    off = np.abs(levels.mean(axis=0) - wanted.mean(axis=0))
    return (
        name,
        group[0].steps,
        ratio,
        *cells,
        max(run.chatter for run in group),
        float(off.max()),
        float(apart.max()),
    )


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.held_friction", description=__doc__)
    parser.add_argument("--steps", type=float, nargs="+", default=[1.0, 2.0, 3.0, 6.0])
    parser.add_argument("--blocks", type=int, default=40)
    parser.add_argument("--beginnings", type=int, default=5)
    parser.add_argument("--runs", nargs="+", default=[], help="parts of the names of runs")
    parser.add_argument("--json")
    given = parser.parse_args()
    table = held_friction(given.steps, given.blocks, given.beginnings, given.runs)
    print("\n".join(table.lines()))
    if given.json:
        with open(given.json, "w", encoding="utf-8") as file:
            json.dump(table.to_json(), file, indent=1)


if __name__ == "__main__":
    main()
