"""Every defect of a bearing: patches, field spalls, a roller of another diameter or none, a worn pocket."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Annotated as A
from typing import Any, ClassVar

from beardyn_core.base.edge import INTERNAL, ROW, At
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.patch import LEAST_DEPTH, Growth, Patch, no_such, raceway_diameter


@dataclass(frozen=True)
class _OneRoller:
    """What is wrong with one roller as a whole."""

    on: ClassVar[str] = "roller"

    row: A[int, ROW, "0 inboard, 1 outboard"]
    roller: A[int, At(ge=0), "which roller"]

    def contradictions(self, bearing: RollerBearing) -> Iterator[str]:
        """Check that the roller is one of the bearing."""
        return no_such("roller", self.roller, bearing)


@dataclass(frozen=True)
class RollerError(_OneRoller):
    """A roller of another diameter than the others."""

    diameter: A[
        float, At("um", ge=-1000.0, le=200.0), "difference to the nominal diameter, positive when too large"
    ]
    kind: A[str, At(one_of=("diameter",), required=True), "which of the kinds this is"] = "diameter"

    def described(self) -> str:
        """Describe the defect in a few words."""
        return f"roller {self.roller}, row {self.row}, {self.diameter * 1e6:+.1f} µm in diameter"


@dataclass(frozen=True)
class WornPocket:
    """A cage pocket with more room than the others."""

    on: ClassVar[str] = "cage"

    row: A[int, ROW, "0 inboard, 1 outboard"]
    pocket: A[int, At(ge=0), "the pocket of the roller of the same number"]
    clearance: A[
        float,
        At("mm", gt=0.0, le=5.0),
        "added to the clearance along the pitch circle, front and rear together",
    ]
    kind: A[str, At(one_of=("worn_pocket",), required=True), "which of the kinds this is"] = "worn_pocket"

    def contradictions(self, bearing: RollerBearing) -> Iterator[str]:
        """Check that the defect is possible in the bearing."""
        return no_such("pocket", self.pocket, bearing)

    def described(self) -> str:
        """Describe the defect in a few words."""
        return f"pocket {self.pocket} of the cage, row {self.row}, worn by {self.clearance * 1e3:.2f} mm"


@dataclass(frozen=True)
class MissingRoller(_OneRoller):
    """A missing roller; its pocket is empty."""

    kind: A[str, INTERNAL] = "missing"

    def described(self) -> str:
        """Describe the defect in a few words."""
        return f"roller {self.roller}, row {self.row}, missing"


Defect = Patch | FieldSpall | RollerError | WornPocket | MissingRoller


def every_patch(defects: Sequence[Defect], bearing: RollerBearing) -> tuple[Patch, ...]:
    """List all patches of raceways and rollers, those that a field spall consists of among them."""
    found: list[Patch] = []
    for defect in defects:
        found += [defect] if isinstance(defect, Patch) else ()
        found += defect.patches(bearing) if isinstance(defect, FieldSpall) else ()
    return tuple(found)


def doubts_about(defects: Sequence[Defect], bearing: RollerBearing) -> list[str]:
    """Warn of defects that are possible but unusual."""
    found = []
    for index, defect in enumerate(defects):
        if not isinstance(defect, Patch):
            continue
        if defect.growth is None and defect.depth < LEAST_DEPTH:
            found.append(
                f"defects[{index}]: {defect.described()}: shallower than {1e6 * LEAST_DEPTH:g} µm, as rough "
                "as a raceway is: check the unit"
            )
        if defect.on == "roller":
            continue
        pitch = math.pi * raceway_diameter(defect.on, bearing) / bearing.roller_count
        if defect.width > pitch:
            found.append(
                f"defects[{index}]: {defect.described()}: wider than the {1e3 * pitch:.0f} mm between two "
                "rollers, so that several are in it at once and none strikes by itself"
            )
    return found


def defect_from(stored: Mapping[str, Any]) -> Defect:
    """Make a defect from the mapping that `dataclasses.asdict` gives for it."""
    for defect in (FieldSpall, RollerError, WornPocket, MissingRoller):
        if stored.get("kind") == defect.kind:
            return defect(**{key: value for key, value in stored.items() if key != "drawn"})
    growth = stored.get("growth")
    return Patch(**{**stored, "growth": None if growth is None else Growth(**growth)})


def truth_of(defect: Defect, time: float) -> dict[str, Any]:
    """Describe a defect as a mapping for JSON; a growing one with its size at a time [s]."""
    found = asdict(defect)
    if isinstance(defect, FieldSpall):
        found["drawn"] = defect.truth()
    if isinstance(defect, Patch) and defect.growth is not None:
        width, depth, rim = defect.size_at(time)
        found["size_now"] = {"time": time, "width": width, "depth": depth, "rim_height": rim}
    return found
