"""An operation whose load, speed, or both, come from a file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.edge import At, Vector, refuse
from beardyn_core.scene.speed import POINTS, Profile, not_ascending

TAKES = ("both", "force", "speed")


@dataclass(frozen=True)
class MeasuredOperation:
    """Load and speed read from a CSV file or from a recording (see `rail.measured`)."""

    KINDS: ClassVar[tuple[str, ...]] = ("csv", "mcap")

    path: A[
        Path,
        "relative to the scene file; of a CSV file columns as in the documentation of `rail.measured`, of a "
        "recording load/blocks, load/wrench and load/shaft, or force and shaft",
    ]
    take: A[
        str, At(one_of=TAKES), "force: the speed is modelled, speed_profile; speed: the load is, force_kN"
    ] = "both"
    speed_profile: A[Profile, POINTS, "with take: force; linear in between, held before and after"] = ()
    wheel_diameter: A[
        float, At("mm", gt=0.0, ge=300.0, le=1500.0), "running diameter, for the speed profile"
    ] = 0.92
    force: A[Vector | None, At("kN"), "with take: speed; on the journal along x, y, z"] = None

    def __post_init__(self) -> None:
        refuse(self, "operation (measured)")

    @property
    def kind(self) -> str:
        """Kind of the file."""
        return "mcap" if self.path.suffix.lower() == ".mcap" else "csv"

    def rules(self) -> Iterator[str]:
        """Check that load and speed each have exactly one source, and that times increase."""
        wants_speed, wants_force = self.take == "force", self.take == "speed"
        if wants_speed and not self.speed_profile:
            yield "speed_profile is missing; take is 'force', so the speed must come from there"
        if wants_force and self.force is None:
            yield "force_kN is missing; take is 'speed', so the load must come from there"
        if self.speed_profile and not wants_speed:
            yield f"speed_profile is given and take is {self.take!r}; it needs take: force"
        if self.force is not None and not wants_force:
            yield f"force_kN is given and take is {self.take!r}; it needs take: speed"
        yield from not_ascending("speed_profile", [time for time, _ in self.speed_profile])
