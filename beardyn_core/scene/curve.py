"""A curve of the track: radius, cant and its transitions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from beardyn_core.scene.ranges import outside, refuse

HANDS = ("left", "right")


@dataclass(frozen=True)
class Curve:
    """A circular arc between two clothoids, on which curvature and cant grow linearly.

    Parameters
    ----------
    radius : float
        Of the arc, [m].
    cant : float
        The outer rail above the inner one; negative when it lies lower, [m].
    begin : float
        Where the first transition begins, from the start of the run, [m].
    length : float
        From there to the end of the second transition, [m].
    transition : float
        Length of each transition, [m].
    hand : str
        ``left`` or ``right``: where it turns, looking forward. A left axlebox runs on the inner rail of a
        left-hand curve.
    """

    radius: float
    cant: float
    begin: float
    length: float
    transition: float
    hand: str = "left"

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "curve"
        yield from outside(owner, "radius", self.radius, 50.0, 1e5, "m")
        yield from outside(owner, "cant", self.cant, -0.05, 0.25, "m")
        yield from outside(owner, "begin", self.begin, 0.0, 1e6, "m")
        yield from outside(owner, "length", self.length, 2.0, 1e5, "m")
        yield from outside(owner, "transition", self.transition, 1.0, 1e4, "m")
        if 2.0 * self.transition > self.length:
            yield (
                f"{owner}: transition is {self.transition:g} m; it must be at most half of the length, "
                f"{0.5 * self.length:g} m"
            )
        if self.hand not in HANDS:
            yield f"{owner}: hand is {self.hand!r}; allowed are {', '.join(HANDS)}"

    @property
    def end(self) -> float:
        """Where the second transition ends, [m]."""
        return self.begin + self.length
