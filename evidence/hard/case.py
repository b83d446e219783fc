"""What a hard case is: a scene with changes, a load, limits, what it must report. Data, no verdict."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, LARGEST_PENETRATION, Status

Vector = tuple[float, float, float]

RUN_AS = {
    "run": "the twin runs the scene to its end",
    "end": "the run, or its start, must end with a sentence",
    "refused scene": "the configuration must refuse it with a sentence",
    "refused load": "a bad piece arrives in mid-run: refused with a sentence, and the run is bit-identical "
    "to one without it",
    "restart": "half a run, a snapshot through bytes, the other half three times: straight on, after "
    "restoring, in a fresh twin; compared bit by bit",
    "coarse step": "500 steps of the twin's own kernel with the step multiplied; it must report",
    "explicit": "one roller between two raceways with explicit steps, judged by the twin's chatter monitor",
}

# Ways without a run that a nanometre could change.
WITHOUT_STARTS = ("refused scene", "explicit")

TOPICS = ("load", "speed", "lubricant", "geometry", "faults", "numerics", "endurance")


@dataclass(frozen=True)
class Point:
    """Load on the journal and shaft speed at one time; linear in between.

    Parameters
    ----------
    time : float
        [s].
    force : tuple of 3 floats
        World axes, [N].
    speed : float
        Of the shaft, [rad/s].
    moment : tuple of 3 floats
        [N m].
    """

    time: float
    force: Vector
    speed: float
    moment: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Limit:
    """What a measure must keep to.

    Parameters
    ----------
    measure : str
        A field of `watch.Measures`.
    low, high : float
        In the unit of the measure.
    """

    measure: str
    low: float = -math.inf
    high: float = math.inf


# What every run of the full tier must keep to. The energy residual is that of the design; the frames are
# renormalised every step; momentum is exchanged in pairs, so what is left is rounding of 2048 steps.
USUAL_LIMITS = (
    Limit("energy_residual", high=1e-2),
    Limit("penetration", high=LARGEST_PENETRATION),
    Limit("chatter_index", high=LARGEST_CHATTER_INDEX),
    Limit("axis_error", high=1e-12),
    Limit("quaternion_error", high=1e-12),
    Limit("momentum_residual", high=1e-9),
)


@dataclass(frozen=True)
class HardCase:
    """One situation in which such codes break.

    Parameters
    ----------
    name, topic : str
    breaks : str
        What would break.
    guard : str
        What holds it.
    run_as : str
        One of `RUN_AS`.
    scene : str
        Shipped scene it starts from.
    changes : mapping
        Keys of the scene file in place of the scene's own; mappings are merged, lists replaced.
    forced : mapping
        Fields of the bearing, SI, ``cage.`` before those of its cage: put in past the configuration's check.
    load : tuple of Point
        In place of the scene's operation; empty: the operation.
    duration : float
        Simulated, [s].
    limits : tuple of Limit
        On top of `USUAL_LIMITS`; one for the same measure replaces the usual one.
    must_report, may_report : Status
        Status bits that have to appear, of a ``coarse step`` at least one of them, and further ones that may.
    sentence : str
        Words of the sentence with which it must end or be refused.
    refined : bool
        Whether half the step must leave the statistics within their band.
    fast : bool
        In the fast subset, of a few blocks and of the effect sets the other fast tests compile.
    long : bool
        Minutes; continued from its last checkpoint after an interruption.
    factor : float
        ``coarse step``: of the production step; ``explicit``: the step, [s].
    known_failure : str
        Why it is known to fail; empty when it must pass.
    start : int
        End play that it begins apart from the scene's, [nm].
    """

    name: str
    topic: str
    breaks: str
    guard: str
    run_as: str = "run"
    scene: str = "static_80kN"
    changes: Mapping[str, Any] = field(default_factory=dict)
    forced: Mapping[str, Any] = field(default_factory=dict)
    load: tuple[Point, ...] = ()
    duration: float = 0.2
    limits: tuple[Limit, ...] = ()
    must_report: Status = Status.FINE
    may_report: Status = Status.FINE
    sentence: str = ""
    refined: bool = True
    fast: bool = False
    long: bool = False
    factor: float = 1.0
    known_failure: str = ""
    start: int = 0

    def __post_init__(self) -> None:
        if self.run_as not in RUN_AS or self.topic not in TOPICS:
            raise ValueError(
                f"hard case {self.name!r}: run_as {self.run_as!r} or topic {self.topic!r} is not known"
            )

    @property
    def all_limits(self) -> tuple[Limit, ...]:
        """The usual limits with its own in place of them, and its further ones."""
        own = {limit.measure for limit in self.limits}
        return (*(limit for limit in USUAL_LIMITS if limit.measure not in own), *self.limits)


def steady(force: Vector, speed: float, moment: Vector = (0.0, 0.0, 0.0)) -> tuple[Point, ...]:
    """Hold one load and one speed for ever."""
    return (Point(0.0, force, speed, moment), Point(1e5, force, speed, moment))


def through(*points: Point) -> tuple[Point, ...]:
    """Go through points of load and speed; hold the last one."""
    last = points[-1]
    return (*points, Point(last.time + 1e5, last.force, last.speed, last.moment))
