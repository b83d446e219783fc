"""A curve of the track: radius, cant and its transitions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At, refuse

HANDS = ("left", "right")


@dataclass(frozen=True)
class Curve:
    """A circular arc between two clothoids, on which curvature and cant grow linearly."""

    radius: A[float, At("m", gt=0.0, ge=50.0, le=1e5), "of the arc"]
    cant: A[float, At("mm", ge=-50.0, le=250.0), "the outer rail above the inner one"] = 0.0
    begin: A[
        float, At("m", ge=0.0, le=1e6), "where the first transition begins, from the start of the run"
    ] = 0.0
    length: A[float, At("m", gt=0.0, ge=2.0, le=1e5, required=True), "with both transitions"] = 100.0
    transition: A[float, At("m", gt=0.0, ge=1.0, le=1e4, required=True), "length of each"] = 30.0
    hand: A[
        str, At(one_of=HANDS), "where it turns; a left axlebox is on the inner rail of a left-hand curve"
    ] = "left"

    def __post_init__(self) -> None:
        refuse(self, "curve")

    def rules(self) -> Iterator[str]:
        """Find transitions that the curve cannot hold."""
        if 2.0 * self.transition > self.length:
            yield (
                f"transition_m is {self.transition:g}; it must be at most half of length_m, "
                f"{0.5 * self.length:g}"
            )

    @property
    def end(self) -> float:
        """Where the second transition ends, [m]."""
        return self.begin + self.length
