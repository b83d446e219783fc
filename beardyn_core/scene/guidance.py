"""What the lateral motion of a vehicle depends on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from beardyn_core.scene.ranges import outside, refuse


@dataclass(frozen=True)
class Guidance:
    """Wheel guidance, lateral secondary suspension and heights of a vehicle.

    Parameters
    ----------
    conicity : float
        Equivalent conicity of the wheelset, [-].
    flange_clearance : float
        Lateral play of the wheelset from the middle of the track to either rail, [m].
    flange_stiffness, flange_damping : float
        Of a rail under a flange, [N/m], [N s/m].
    friction : float
        Limit of the creep force over the wheel load, [-].
    secondary_stiffness, secondary_damping : float
        Lateral, one side of one bogie, [N/m], [N s/m].
    body_height, bogie_height : float
        Centres of mass above the rail, [m].
    axlebox_spacing : float
        Between the bearing centres of a wheelset, [m].
    """

    conicity: float = 0.1
    flange_clearance: float = 6.0e-3
    flange_stiffness: float = 4.0e7
    flange_damping: float = 1.0e5
    friction: float = 0.35
    secondary_stiffness: float = 1.7e5
    secondary_damping: float = 3.0e4
    body_height: float = 1.7
    bogie_height: float = 0.6
    axlebox_spacing: float = 2.0

    def __post_init__(self) -> None:
        refuse(self._problems())

    def _problems(self) -> Iterator[str]:
        owner = "guidance"
        yield from outside(owner, "conicity", self.conicity, 0.0, 1.0, "")
        yield from outside(owner, "flange_clearance", self.flange_clearance, 1e-3, 0.03, "m")
        yield from outside(owner, "flange_stiffness", self.flange_stiffness, 1e6, 1e9, "N/m")
        yield from outside(owner, "flange_damping", self.flange_damping, 0.0, 1e7, "N s/m")
        yield from outside(owner, "friction", self.friction, 0.01, 1.0, "")
        yield from outside(owner, "secondary_stiffness", self.secondary_stiffness, 1e4, 1e8, "N/m")
        yield from outside(owner, "secondary_damping", self.secondary_damping, 0.0, 1e7, "N s/m")
        yield from outside(owner, "body_height", self.body_height, 0.5, 4.0, "m")
        yield from outside(owner, "bogie_height", self.bogie_height, 0.2, 2.0, "m")
        yield from outside(owner, "axlebox_spacing", self.axlebox_spacing, 1.0, 3.0, "m")
