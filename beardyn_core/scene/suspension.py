"""Primary suspension of freight bogies: progressive springs and load-dependent friction."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from beardyn_core.scene.ranges import outside, refuse


@dataclass(frozen=True)
class ProgressiveSuspension:
    """Springs of one axlebox, vertical: soft while empty, stiff when the inner springs join in.

    Parameters
    ----------
    soft_stiffness, stiff_stiffness : float
        Before and after the inner springs join in, [N/m].
    meeting_load : float
        Spring load at which they do, [N].
    friction_ratio : float
        Friction over spring load, as of a Lenoir link, [-].
    friction_speed : float
        Sliding speed at which friction has 76 % of its full value, [m/s].
    """

    soft_stiffness: float
    stiff_stiffness: float
    meeting_load: float
    friction_ratio: float = 0.12
    friction_speed: float = 0.005

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "primary suspension"
        yield from outside(owner, "soft_stiffness", self.soft_stiffness, 1e4, 1e8, "N/m")
        yield from outside(owner, "stiff_stiffness", self.stiff_stiffness, 1e4, 1e8, "N/m")
        yield from outside(owner, "meeting_load", self.meeting_load, 0.0, 1e6, "N")
        yield from outside(owner, "friction_ratio", self.friction_ratio, 0.0, 0.5, "")
        yield from outside(owner, "friction_speed", self.friction_speed, 0.001, 1.0, "m/s")

    def compression(self, load: float) -> float:
        """Of the springs under a load, [m]."""
        soft = min(load, self.meeting_load) / self.soft_stiffness
        return soft + max(load - self.meeting_load, 0.0) / self.stiff_stiffness
