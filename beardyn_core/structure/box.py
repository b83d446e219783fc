"""An axlebox in figures: a housing around the cup, blocks that are cast to it, and where things sit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.edge import At, Vector, refuse
from beardyn_core.structure.damping import DAMPING, DampingTable

_NAME = At(longest=80, pattern=r"^[A-Za-z][A-Za-z0-9_]*$")


@dataclass(frozen=True)
class Block:
    """A cuboid of the box's material; what lies inside of the bore is cut away."""

    centre: A[Vector, At("mm"), "from the bearing centre along x, y, z"]
    size: A[Vector, At("mm", gt=0.0, le=1000.0), "along x, y, z"]


@dataclass(frozen=True)
class Disc:
    """A cover that closes one end of the housing."""

    side: A[str, At(one_of=("inboard", "outboard")), "end of the housing"]
    thickness: A[float, At("mm", ge=2.0, le=60.0), "along the axle"]
    hole_diameter: A[float, At("mm", ge=0.0, le=400.0), "for the axle; 0 for a closed cover"] = 0.0


@dataclass(frozen=True)
class Seat:
    """A place on the box where a sensor or a spring sits: the mean motion of a small ball around it."""

    name: A[str, _NAME, "by which scenes name it"]
    position: A[Vector, At("mm"), "from the bearing centre along x, y, z"]
    radius: A[float, At("mm", gt=0.0, le=100.0), "of the ball; at least one node of the mesh is taken"] = (
        0.015
    )


@dataclass(frozen=True)
class Box:
    """An axlebox with the cup of its bearing, one body of two materials."""

    name: A[str, At(longest=80), "of the box"]
    bearing: A[str, At(longest=200), "shipped bearing or path of its file, whose cup the bore holds"]
    outer_diameter: A[float, At("mm", gt=0.0, le=800.0), "of the housing around the cup"]
    length: A[float, At("mm", gt=0.0, le=600.0), "of the housing along the axle"]
    description: A[str, At(usual=""), "what it is, in a few words"] = ""
    arc: A[
        float, At("deg", ge=60.0, le=360.0), "of the housing around the cup, its middle on top; 360 all round"
    ] = 6.283185307179586
    blocks: A[tuple[Block, ...], "cast to the housing"] = ()
    discs: A[tuple[Disc, ...], "covers"] = ()
    sensors: A[tuple[Seat, ...], "where accelerometers may sit"] = ()
    suspension: A[tuple[Seat, ...], "where springs, links and dampers hold the box"] = ()
    youngs_modulus: A[float, At("GPa", gt=0.0, le=500.0), "of housing, blocks and discs"] = 170.0e9
    poisson_ratio: A[float, At(ge=0.0, le=0.45), "of housing, blocks and discs"] = 0.28
    density: A[float, At("kg_per_m3", gt=0.0, le=20000.0), "of housing, blocks and discs"] = 7100.0
    damping_ratio: A[
        float | DampingTable, DAMPING, "of every mode, over the critical one, or a table over the frequency"
    ] = 0.02
    sources: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        refuse(self, f"box {self.name!r}")

    def rules(self) -> Iterator[str]:
        """Check that seats have names of their own and that a cover has a housing to close."""
        names = [seat.name for seat in (*self.sensors, *self.suspension)]
        for name in sorted({name for name in names if names.count(name) > 1}):
            yield f"the seat {name!r} is there {names.count(name)} times; give each a name of its own"
        if not self.sensors:
            yield "sensors is empty; name at least one place where an accelerometer may sit"
        if self.discs and self.arc < 6.28:
            yield "discs need a housing all round; leave arc_deg out, or the discs"
