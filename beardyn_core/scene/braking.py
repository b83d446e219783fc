"""What an axle does when the vehicle slows down or speeds up."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from beardyn_core.scene.ranges import outside, refuse

BRAKES = ("disc", "block", "clasp")


@dataclass(frozen=True)
class Braking:
    """Brake of an axle; how much it must brake follows from the speed profile.

    Parameters
    ----------
    brake : str
        ``disc`` (on the axle, caliper at axle height), ``block`` (one block a wheel, at axle height) or
        ``clasp`` (two blocks a wheel, whose forces cancel).
    share : float
        Brake force of this axle over what would brake its own share of the vehicle, [-].
    friction : float
        Of block on wheel, [-].
    disc_radius : float
        At which the pads act, [m].
    ahead : bool
        Whether caliper or block are ahead of the axle (at +x).
    """

    brake: str = "disc"
    share: float = 1.0
    friction: float = 0.25
    disc_radius: float = 0.25
    ahead: bool = True

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "braking"
        if self.brake not in BRAKES:
            yield f"{owner}: brake is {self.brake!r}; allowed are {', '.join(BRAKES)}"
        yield from outside(owner, "share", self.share, 0.0, 10.0, "")
        yield from outside(owner, "friction", self.friction, 0.05, 0.6, "")
        yield from outside(owner, "disc_radius", self.disc_radius, 0.1, 0.6, "m")


@dataclass(frozen=True)
class Starting:
    """Drive of an axle.

    Parameters
    ----------
    share : float
        Tractive force of this axle over what would speed up its own share of the vehicle: 2 where
        every other axle is driven, [-].
    """

    share: float = 1.0

    def __post_init__(self) -> None:
        refuse(outside("starting", "share", self.share, 0.0, 20.0, ""))
