"""The one loop of a run: make the load, compile kernels, solve the equilibrium, advance to the end."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.announcements import announced_on_stderr
from beardyn_core.base.interrupts import hold_interrupts
from beardyn_core.rail.build import load_of_run
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.sensors.block import Block
from beardyn_core.twin import Twin


@dataclass(frozen=True)
class Simulation:
    """A scene at t = 0, ready to advance."""

    twin: A[Twin, "its kernels are compiled and its equilibrium is solved"]
    load: A[LoadHistory, "load on the journal over the whole run; the twin has it"]
    block_count: A[int, "blocks of 20 ms to the end"]

    def blocks(self, at_once: int = 1) -> Iterator[Block]:
        """Advance to the end, block by block.

        Parameters
        ----------
        at_once : int
            Blocks of 20 ms in one, up to ``twin.blocks_at_once``: the same bits in less time.

        Raises
        ------
        ValidityError
            The model left its range of validity; the last block is in the error's ``block``.
        """
        for first in range(0, self.block_count, at_once):
            with hold_interrupts():
                block = self.twin.advance(min(at_once, self.block_count - first))
            yield block


def start(scene: Scene, duration: float | None = None, load: LoadHistory | None = None) -> Simulation:
    """Make the load of a scene, compile its kernels and solve its equilibrium.

    Parameters
    ----------
    duration : float, optional
        Simulated time in place of the scene's own; rounded up to whole blocks, [s].
    load : LoadHistory, optional
        In place of that of the scene's operation, as long as the run.

    Raises
    ------
    InputError
        The load cannot be made.
    ValidityError
        There is no equilibrium under it.
    """
    with hold_interrupts():
        twin = Twin(scene)
        seconds = scene.duration if duration is None else duration
        count = max(1, math.ceil(seconds * 1e9 / twin.block_ns - 1e-6))
        if load is None:
            load = load_of_run(scene, count * twin.block_ns * 1e-9)
        twin.warm()
        twin.start(load)
        return Simulation(twin, load.until(count * twin.block_ns), count)


def blocks(scene: Scene, duration: float | None = None, at_once: int = 1) -> Iterator[Block]:
    """Simulate a scene and give its blocks of 20 ms one after the other.

    Parameters
    ----------
    duration : float, optional
        In place of the scene's own, [s].
    at_once : int
        See `Simulation.blocks`.

    Raises
    ------
    InputError, ValidityError
        See `start` and `Simulation.blocks`.
    """
    with announced_on_stderr():
        begun = start(scene, duration)
    yield from begun.blocks(at_once)
