"""An operation whose load, speed, or both, come from a file."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from beardyn_core.scene.ranges import not_finite, outside, refuse

TAKES = ("both", "force", "speed")


@dataclass(frozen=True)
class MeasuredOperation:
    """Load and speed read from a CSV file or from a recording (see `rail.measured`).

    Parameters
    ----------
    path : Path
        The file; the config room resolves a relative path against the folder of the scene file.
    take : str
        ``both``; ``force``: the speed is `speed_profile`; ``speed``: the load is `force`.
    speed_profile : tuple of (time, speed) pairs
        Time, [s], and speed of the vehicle, [m/s]: linear in between, held before and after.
    wheel_diameter : float
        Running diameter, for the speed profile, [m].
    force : tuple of 3 floats or None
        On the journal, [N].
    """

    path: Path
    take: str = "both"
    speed_profile: tuple[tuple[float, float], ...] = ()
    wheel_diameter: float = 0.92
    force: tuple[float, float, float] | None = None

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "operation (measured)"
        if self.take not in TAKES:
            yield f"{owner}: take is {self.take!r}; allowed are {', '.join(TAKES)}"
        if bool(self.speed_profile) != (self.take == "force"):
            yield f"{owner}: a speed_profile is given when, and only when, take is 'force'"
        if (self.force is not None) != (self.take == "speed"):
            yield f"{owner}: a force is given when, and only when, take is 'speed'"
        yield from outside(owner, "wheel_diameter", self.wheel_diameter, 0.3, 1.5, "m")
        if self.force is not None:
            yield from not_finite(owner, "force", self.force)
        for index, (time, speed) in enumerate(self.speed_profile):
            yield from not_finite(owner, f"time of speed_profile point {index}", (time,))
            yield from outside(
                owner, f"speed of speed_profile point {index}", abs(speed), 0.0, 400 / 3.6, "m/s"
            )
        for index, ((one, _), (two, _)) in enumerate(itertools.pairwise(self.speed_profile), start=1):
            if not two > one:
                yield (
                    f"{owner}: speed_profile point {index} is at {two:g} s; it must be later than point "
                    f"{index - 1} at {one:g} s"
                )
