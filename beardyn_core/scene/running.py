"""What a run meets besides straight track at constant speed: curves, brake and drive of an axle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.edge import At, refuse

HANDS = ("left", "right")
BRAKES = ("disc", "block", "clasp")


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


@dataclass(frozen=True)
class Braking:
    """Brake of an axle; how much it must brake follows from the speed profile."""

    brake: A[str, At(one_of=BRAKES), "on the axle, one block a wheel, or two blocks whose forces cancel"] = (
        "disc"
    )
    share: A[float, At(ge=0.0, le=10.0), "over what would brake this axle's own part of the vehicle"] = 1.0
    friction: A[float, At(ge=0.05, le=0.6), "of block on wheel"] = 0.25
    disc_radius: A[float, At("mm", gt=0.0, ge=100.0, le=600.0), "at which the pads act"] = 0.25
    ahead: A[bool, "whether caliper or block are ahead of the axle, at +x"] = True

    def __post_init__(self) -> None:
        refuse(self, "braking")


@dataclass(frozen=True)
class Starting:
    """Drive of an axle."""

    share: A[
        float,
        At(ge=0.0, le=20.0),
        "over what would speed up this axle's own part: 2 where half of the axles drive",
    ] = 1.0

    def __post_init__(self) -> None:
        refuse(self, "starting")
