"""Defects: patches of raceways and rollers, a roller of another diameter or none, a worn cage pocket."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

from beardyn_core.bearing.geometry import Bearing

SMALLEST_SINK = 1e-8  # of a roller into a patch that it bridges [m]
PATCH_KINDS = ("spall", "rectangular", "half_sine", "elliptic", "dent", "brinelling")


@dataclass(frozen=True)
class Growth:
    """Linear growth of a patch from a share of its size to all of it.

    Parameters
    ----------
    start, end : float
        Simulated time before which the patch has its initial and after which it has its full size, [s].
    initial : float
        Share of the size at the start, 0 to 1, [-].
    width, depth : bool
        Which sizes grow; depth includes the height of the rim.
    """

    start: float
    end: float
    initial: float = 0.0
    width: bool = True
    depth: bool = True

    def factor(self, time: float) -> float:
        """Share of the size at a time [s], [-]."""
        passed = min(max((time - self.start) / (self.end - self.start), 0.0), 1.0)
        return self.initial + (1.0 - self.initial) * passed


@dataclass(frozen=True)
class Patch:
    """A patch of a raceway or a roller that is not where it should be.

    Parameters
    ----------
    on : str
        ``cup``, ``cone`` or ``roller``.
    row : int
        0 inboard, 1 outboard.
    azimuth : float
        Centre, from +z towards +x, in the body's own frame (the cone's and the roller's at the start
        of the run; a roller's 0 faces the cup), [rad]. Of brinelling the centre of its first dent.
    width : float
        Extent in rolling direction without the rim; of brinelling that of each dent, [m].
    depth : float
        Depth, [m].
    length : float
        Extent along the roller, [m].
    offset : float
        Centre along the roller from the middle of its effective length, positive towards the large
        end, [m].
    roller : int
        Which roller, for ``on='roller'``.
    kind : str
        Floor of the patch, with u from -1 to 1 across the width and h the depth: ``spall`` and
        ``rectangular`` h, ``half_sine`` h cos(pi u / 2), ``elliptic`` h sqrt(1 - u^2), ``dent``
        h cos^2(pi u / 2) (a bell without edges), ``brinelling`` one elliptic groove a roller pitch.
    rim_height, rim_width : float
        Raised shoulder on both sides, sin^2 in rolling direction, [m].
    growth : Growth or None
    """

    on: str
    row: int
    azimuth: float
    width: float
    depth: float
    length: float
    offset: float = 0.0
    roller: int = 0
    kind: str = "spall"
    rim_height: float = 0.0
    rim_width: float = 0.0
    growth: Growth | None = None

    def size_at(self, time: float) -> tuple[float, float, float]:
        """Width, depth and rim height at a time [s], [m]."""
        if self.growth is None:
            return self.width, self.depth, self.rim_height
        factor = self.growth.factor(time)
        deep = factor if self.growth.depth else 1.0
        return self.width * (factor if self.growth.width else 1.0), self.depth * deep, self.rim_height * deep

    def described(self) -> str:
        """What it is, in a few words."""
        what = self.kind.replace("_", "-")
        where = (
            f"roller {self.roller}, row {self.row}" if self.on == "roller" else f"{self.on}, row {self.row}"
        )
        words = f"{what} on the {where}, {self.width * 1e3:.1f} mm wide, {self.depth * 1e6:.0f} µm deep"
        if self.growth is not None:
            words += f", growing from {self.growth.start:g} to {self.growth.end:g} s"
        return words


Spall = Patch  # what `Patch` is without a `kind`


@dataclass(frozen=True)
class RollerError:
    """A roller of another diameter than the others.

    Parameters
    ----------
    row, roller : int
    diameter : float
        Difference to the nominal diameter, positive when too large, [m].
    """

    row: int
    roller: int
    diameter: float
    kind: str = "diameter"

    @property
    def on(self) -> str:
        """The body at fault."""
        return "roller"

    def described(self) -> str:
        """What it is, in a few words."""
        return f"roller {self.roller}, row {self.row}, {self.diameter * 1e6:+.1f} µm in diameter"


@dataclass(frozen=True)
class WornPocket:
    """A cage pocket with more room than the others.

    Parameters
    ----------
    row, pocket : int
        The pocket of the roller of the same number.
    clearance : float
        Added to the clearance along the pitch circle, front and rear together, [m].
    """

    row: int
    pocket: int
    clearance: float
    kind: str = "worn_pocket"

    @property
    def on(self) -> str:
        """The body at fault."""
        return "cage"

    def described(self) -> str:
        """What it is, in a few words."""
        return f"pocket {self.pocket} of the cage, row {self.row}, worn by {self.clearance * 1e3:.2f} mm"


@dataclass(frozen=True)
class MissingRoller:
    """A roller that is not there; its pocket is empty.

    Parameters
    ----------
    row, roller : int
    """

    row: int
    roller: int
    kind: str = "missing"

    @property
    def on(self) -> str:
        """The body at fault."""
        return "roller"

    def described(self) -> str:
        """What it is, in a few words."""
        return f"roller {self.roller}, row {self.row}, missing"


Defect = Patch | RollerError | WornPocket | MissingRoller


def width_problem(width: float, on: str, bearing: Bearing) -> str:
    """Say why a patch cannot be that wide, in mm; empty when it can.

    Parameters
    ----------
    width : float
        In rolling direction, [m].
    on : str
        ``cup``, ``cone`` or ``roller``.
    bearing : Bearing

    Notes
    -----
    A roller of radius R that bridges a width w sinks by w^2 / 8 R: at the least width by 10 nm, a tenth of
    the roughness of a raceway and less, so nothing of it could be seen. A patch of more than half a raceway
    has no edges that a roller in the load zone meets one after the other.
    """
    least = math.sqrt(8.0 * 0.5 * bearing.roller_diameter * SMALLEST_SINK)
    if width < least:
        return (
            f"width_mm is {1e3 * width:g}; it must be at least {1e3 * least:.2g}: a roller sinks less than "
            f"{1e9 * SMALLEST_SINK:g} nm into a narrower one"
        )
    half = 0.5 * math.pi * raceway_diameter(on, bearing)
    if on != "roller" and width > half:
        return f"width_mm is {1e3 * width:g}; it must be at most {1e3 * half:.0f}, half of the raceway"
    return ""


def raceway_diameter(on: str, bearing: Bearing) -> float:
    """Mean diameter of the raceway of the cup or the cone, [m]."""
    side = 1.0 if on == "cup" else -1.0
    return bearing.pitch_diameter + side * bearing.roller_diameter * math.cos(bearing.contact_angle)


def doubts_about(defects: Sequence[Defect], bearing: Bearing) -> list[str]:
    """Say what is unusual about defects that can be.

    Parameters
    ----------
    defects : sequence of Defect
    bearing : Bearing
    """
    found = []
    for index, defect in enumerate(defects):
        if not isinstance(defect, Patch) or defect.on == "roller":
            continue
        pitch = math.pi * raceway_diameter(defect.on, bearing) / bearing.roller_count
        if defect.width > pitch:
            found.append(
                f"defects[{index}]: {defect.described()}: wider than the {1e3 * pitch:.0f} mm between two "
                "rollers, so that several are in it at once and none strikes by itself"
            )
    return found


def defect_from(stored: Mapping[str, Any]) -> Defect:
    """A defect from the mapping that `dataclasses.asdict` makes of it."""
    fields = dict(stored)
    kind = fields.get("kind", "spall")
    if kind == "diameter":
        return RollerError(**fields)
    if kind == "worn_pocket":
        return WornPocket(**fields)
    if kind == "missing":
        return MissingRoller(**fields)
    growth = fields.get("growth")
    return Patch(**{**fields, "growth": None if growth is None else Growth(**growth)})


def truth_of(defect: Defect, time: float) -> dict[str, Any]:
    """A defect as JSON-able truth; a growing one with its size at a time [s]."""
    found = asdict(defect)
    if isinstance(defect, Patch) and defect.growth is not None:
        width, depth, rim = defect.size_at(time)
        found["size_now"] = {"time": time, "width": width, "depth": depth, "rim_height": rim}
    return found
