"""How the bearing is held: axlebox, journal, suspension and guidance of the vehicle."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.edge import SHARE, At, Vector, refuse
from beardyn_core.base.units import UNITS


@dataclass(frozen=True)
class ProgressiveSuspension:
    """Springs of one axlebox, vertical: soft while empty, stiff when the inner springs join in."""

    soft_stiffness: A[float, At("MN_per_m", gt=0.0, ge=0.01, le=100.0), "while the inner springs are free"]
    stiff_stiffness: A[float, At("MN_per_m", gt=0.0, ge=0.01, le=100.0), "with the inner springs"]
    meeting_load: A[float, At("kN", ge=0.0, le=1000.0), "spring load at which the inner springs join in"]
    friction_ratio: A[float, At(ge=0.0, le=0.5), "friction over spring load"] = 0.12
    friction_speed: A[
        float,
        At("m_per_s", gt=0.0, ge=0.001, le=1.0),
        "sliding speed at which friction has 76 % of its full value",
    ] = 0.005

    def __post_init__(self) -> None:
        refuse(self, "primary suspension")

    def compression(self, load: float) -> float:
        """Find the compression of the springs under a load, [m]."""
        soft = min(load, self.meeting_load) / self.soft_stiffness
        return soft + max(load - self.meeting_load, 0.0) / self.stiff_stiffness


@dataclass(frozen=True)
class Guidance:
    """Wheel guidance, lateral secondary suspension and heights of a vehicle."""

    conicity: A[float, SHARE, "equivalent conicity of the wheelset"] = 0.1
    flange_clearance: A[
        float, At("mm", gt=0.0, ge=1.0, le=30.0), "from the middle of the track to either rail"
    ] = 6.0e-3
    flange_stiffness: A[float, At("MN_per_m", gt=0.0, ge=1.0, le=1000.0), "of a rail under a flange"] = 4.0e7
    flange_damping: A[float, At("kN_s_per_m", ge=0.0, le=10000.0), "of a rail under a flange"] = 1.0e5
    friction: A[float, At(ge=0.01, le=1.0), "limit of the creep force over the wheel load"] = 0.35
    secondary_stiffness: A[
        float, At("kN_per_mm", gt=0.0, ge=0.01, le=100.0), "lateral, one side of one bogie"
    ] = 1.7e5
    secondary_damping: A[float, At("kN_s_per_m", ge=0.0, le=10000.0), "lateral, one side of one bogie"] = (
        3.0e4
    )
    body_height: A[float, At("m", gt=0.0, ge=0.5, le=4.0), "centre of mass above the rail"] = 1.7
    bogie_height: A[float, At("m", gt=0.0, ge=0.2, le=2.0), "centre of mass above the rail"] = 0.6
    axlebox_spacing: A[
        float, At("m", gt=0.0, ge=1.0, le=3.0), "between the bearing centres of a wheelset"
    ] = 2.0

    def __post_init__(self) -> None:
        refuse(self, "guidance")


@dataclass(frozen=True)
class Mounting:
    """Axlebox on its suspension, and the journal in it.

    A load that acts off the bearing centre also turns the journal with the moment offset x force; a
    journal that is locked holds all but its first value. A single row thrusts the journal out along y.
    """

    cup: A[str, At(one_of=("held", "suspended")), "fixed in space, or moving with the axlebox"] = "suspended"
    journal_tilt: A[str, At(one_of=("locked", "free")), "tilt of the journal in space"] = "locked"
    box_mass: A[float, At("kg", gt=0.0), "axlebox without the cup"] = 100.0
    box_inertia: A[
        Vector, At("kg_m2", gt=0.0), "axlebox without the cup, about x, y, z through the bearing centre"
    ] = (2.0, 2.0, 2.0)
    journal_mass: A[float, At("kg", gt=0.0), "half wheelset"] = 900.0
    journal_inertia: A[float, At("kg_m2", gt=0.0), "about x and z"] = 50.0
    stiffness: A[Vector, At("MN_per_m", ge=0.0), "suspension between axlebox and bogie along x, y, z"] = (
        1.0e7,
        5.0e6,
        1.2e6,
    )
    damping: A[Vector, At("kN_s_per_m", ge=0.0), "suspension between axlebox and bogie along x, y, z"] = (
        2.0e4,
        2.0e4,
        1.0e4,
    )
    rotational_stiffness: A[
        Vector, At("kN_m_per_rad", ge=0.0), "restraint of the axlebox against turning about x, y, z"
    ] = (1.0e5, 2.0e5, 1.0e5)
    rotational_damping: A[
        Vector, At("N_m_s_per_rad", ge=0.0), "of the axlebox against turning about x, y, z"
    ] = (5.0e2, 1.0e3, 5.0e2)
    box_centre: A[
        Vector, At("mm"), "centre of mass of the axlebox without the cup, from the bearing centre"
    ] = (0.0, 0.0, 0.0)
    suspension_centre: A[
        Vector, At("mm"), "where the springs act on the axlebox, from the bearing centre"
    ] = (0.0, 0.0, 0.0)
    load_offset: A[Vector, At("mm"), "where the load acts on the journal, from the bearing centre"] = (
        0.0,
        0.0,
        0.0,
    )
    axial_prop_stiffness: A[
        float, At("MN_per_m", ge=0.0), "of a spring between journal and ground along y; a single row needs it"
    ] = 0.0
    axial_prop_damping: A[float, At("kN_s_per_m", ge=0.0), "of a damper next to that spring"] = 0.0
    side: A[
        str,
        At(one_of=("left", "right"), absent=True),
        "end of the wheelset that the axlebox is on: the axle that bends goes on towards -y from a left one. "
        "left when left out",
    ] = "left"

    def rules(self) -> Iterator[str]:
        """Check inertia and centre of mass of the axlebox against each other."""
        x, y, z = (c * c for c in self.box_centre)
        least = (self.box_mass * (y + z), self.box_mass * (x + z), self.box_mass * (x + y))
        if any(have <= need for have, need in zip(self.box_inertia, least, strict=True) if need):
            yield (
                f"box_inertia_kg_m2 is {list(self.box_inertia)}; about the bearing centre it must be "
                f"above {[round(value, 4) for value in least]}, what box_mass_kg alone has at box_centre_mm"
            )
        if any(self.load_offset) and self.cup == "held" and self.journal_tilt == "locked":
            offset = [UNITS["mm"].to_edge(value) for value in self.load_offset]
            yield (
                f"load_offset_mm is {offset}; it turns nothing while cup is held and "
                "journal_tilt is locked: set journal_tilt to free or cup to suspended"
            )

    def about_bearing_centre(self, wrench: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert loads on the journal to force and moment about the centre, shape [..., 6], [N, N m]."""
        if not any(self.load_offset):
            return wrench
        force, moment = wrench[..., :3], wrench[..., 3:]
        return np.concatenate([force, moment + np.cross(self.load_offset, force)], axis=-1)
