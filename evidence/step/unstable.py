"""Explicit steps across their limit, of the whole bearing: finite, right in the mean, and not stable."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from beardyn_core.base.errors import ValidityError
from beardyn_core.physics.bodies.layout import SIGNAL_TORQUE
from beardyn_core.physics.tiers.status import chatter_index
from beardyn_core.rail.build import load_history
from beardyn_core.twin import Twin
from evidence.step.cases import REFERENCE, Method, Point, scene_of
from evidence.step.run import BEGIN

UNSTABLE_EFFECTS = ("standard", "dry")
UNSTABLE_METHODS = (
    REFERENCE,
    *(Method("explicit", steps) for steps in (78, 40, 20, 8, 6, 4, 2)),
    Method("implicit", 4),
)


@dataclass(frozen=True)
class UnstableRun:
    """What a step comes to in the second block of 20 ms.

    Parameters
    ----------
    effects, load, method : str
    begun : float
        Mean torque of the first `run.BEGIN` seconds, [N m].
    mean, scatter, scatter_every_second : float
        Torque at every step, its standard deviation, and that of every second step, [N m].
    chatter : float
        Chatter index of the monitor, [-].
    ended : bool
        The run left the model's validity; the numbers are NaN.
    """

    effects: str
    load: str
    method: str
    begun: float
    mean: float
    scatter: float
    scatter_every_second: float
    chatter: float
    ended: bool


def unstable_run(effects: str, point: Point, method: Method) -> UnstableRun:
    """Run two blocks from equilibrium."""
    twin = Twin(scene_of(point, method, effects=effects))
    twin.start(load_history(twin.scene.operation, twin.scene.mounting, 0.1, 1))
    try:
        twin.advance()
        every = twin.step_signals[:, SIGNAL_TORQUE]
        begun = float(every[: round(1e9 * BEGIN / twin.block_ns * len(every))].mean())
        twin.advance()
    except ValidityError:
        return UnstableRun(effects, point.name, method.name, *(5 * (float("nan"),)), ended=True)
    torque = twin.step_signals[:, SIGNAL_TORQUE]
    index = float(chatter_index(twin.snapshot().state, len(torque)).max())
    return UnstableRun(
        effects, point.name, method.name, begun, float(torque.mean()), float(torque.std()),
        float(torque[::2].std()), index, ended=False,
    )  # fmt: skip


def unstable_runs(points: Sequence[Point]) -> list[dict[str, Any]]:
    """Run all of them, as rows of JSON; numbers of runs that ended are ``None``."""
    found = [
        asdict(unstable_run(effects, point, method))
        for effects in UNSTABLE_EFFECTS
        for point in points
        for method in UNSTABLE_METHODS
    ]
    return [{key: None if value != value else value for key, value in row.items()} for row in found]
