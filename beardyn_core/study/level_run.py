"""What an accuracy study compares: load and windows of every run, and one run of a level."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.arrays import Float
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.scene import Scene
from beardyn_core.study.ladder_levels import Level
from beardyn_core.study.measures import FaultLine, Outcome


@dataclass(frozen=True)
class Comparison:
    """Load of every run of a ladder, and the windows in which runs are compared."""

    scene: Scene
    load: A[LoadHistory, "made once, felt by all levels"]
    settling: A[float, "[s]"]
    edges: A[tuple[float, ...], "ends of the windows, [s]"]
    revolutions: A[int, "whole cage revolutions that the windows cover; 0 when there is none"]
    block_count: int
    fault_line: FaultLine | None


@dataclass(frozen=True)
class Run:
    """One run of a level."""

    outcome: A[Outcome | None, "``None`` when it left the model's validity"]
    walls: A[Float, "shape [block], wall time per simulated second of each block after settling, [-]"]
    status: str


@dataclass(frozen=True)
class Attempt:
    """One of the runs of a level."""

    place: A[int, "of the level in the ladder; 0 is the reference"]
    level: Level
    number: A[int, "0 is the scene itself, see `vary_start`"]
