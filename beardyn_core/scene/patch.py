"""A patch of a raceway or a roller that lies deeper or higher than the healthy surface, and its growth."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import INTERNAL, ROW, At
from beardyn_core.bearing.roller_bearing import RollerBearing

LEAST_DEPTH = 1e-7  # of a patch: about the roughness of a raceway [m]
SMALLEST_SINK = 1e-8  # of a roller into a patch that it bridges [m]

PATCH_KINDS = ("spall", "rectangular", "half_sine", "elliptic", "dent", "brinelling")


def no_such(key: str, number: int, bearing: RollerBearing) -> Iterator[str]:
    """Report a number of a roller or pocket that the bearing does not have."""
    if number >= bearing.roller_count:
        yield (
            f"{key} is {number}; {bearing.name} has {bearing.roller_count} rollers per row, "
            f"0 to {bearing.roller_count - 1}"
        )


def not_on_a_roller(roller: int, on: str) -> str:
    """Report a roller number on a surface that is not a roller."""
    return f"roller is {roller}, but on is {on!r}: only `on: roller` has a roller's number"


@dataclass(frozen=True)
class Growth:
    """Linear growth of a patch from a share of its size to all of it."""

    start: A[float, At("s", ge=0.0, key="from"), "simulated time up to which it has its initial size"]
    end: A[float, At("s", gt=0.0, key="to"), "simulated time from which it has its full size"]
    initial: A[float, At(ge=0.0, le=1.0, key="initial_share"), "of the full size"] = 0.0
    width: A[bool, INTERNAL, "the width grows"] = True
    depth: A[bool, INTERNAL, "depth and height of the rim grow"] = True

    def rules(self) -> Iterator[str]:
        """Check that the growth ends after it begins."""
        if self.end <= self.start:
            yield f"to_s is {self.end:g}; it must be greater than from_s, {self.start:g}"

    def as_written(self, keys: dict[str, Any]) -> dict[str, Any]:
        """Write as one word which sizes grow."""
        size = {(True, True): "both", (True, False): "width", (False, True): "depth"}
        return {**keys, "size": size[self.width, self.depth]}

    def factor(self, time: float) -> float:
        """Find the share of the size at a time [s], [-]."""
        passed = min(max((time - self.start) / (self.end - self.start), 0.0), 1.0)
        return self.initial + (1.0 - self.initial) * passed


@dataclass(frozen=True)
class Patch:
    """A patch of a raceway or a roller that lies deeper or higher than the healthy surface.

    The azimuth is that of its centre, of brinelling of the centre of its first dent; a roller's 0 faces the
    cup. The width is without the rim, of brinelling that of each dent. The rim is sin^2 in rolling direction.
    With u from -1 to 1 across the width and h the depth the floor is: ``spall`` and ``rectangular`` h,
    ``half_sine`` h cos(pi u / 2), ``elliptic`` h sqrt(1 - u^2), ``dent`` h cos^2(pi u / 2) (a bell without
    edges), ``brinelling`` one elliptic groove a roller pitch.
    """

    on: A[str, At(one_of=("cup", "cone", "roller")), "the surface it is on"]
    row: A[int, ROW, "0 inboard, 1 outboard"]
    azimuth: A[
        float,
        At("deg", usual=0.0),
        "from +z (the top) towards +x, in the body's own frame at the start of the run",
    ]
    width: A[float, At("mm", gt=0.0, le=200.0), "in rolling direction"]
    depth: A[float, At("um", gt=0.0, le=5000.0), "below the undamaged surface"]
    length: A[float, At("mm", gt=0.0, optional=True), "along the roller; the whole contact when left out"]
    offset: A[float, At("mm"), "centre from mid-length, positive towards the large end"] = 0.0
    roller: A[int, At(ge=0), "which roller, with `on: roller`"] = 0
    kind: A[str, At(one_of=PATCH_KINDS), "shape of its floor"] = "spall"
    rim_height: A[float, At("um", ge=0.0, le=500.0), "raised shoulder"] = 0.0
    rim_width: A[
        float,
        At("mm", ge=0.0, le=50.0, optional=True),
        "of the shoulder on each side; a quarter of the width when left out",
    ] = 0.0
    growth: A[Growth | None, "of its size during the run"] = None

    def rules(self) -> Iterator[str]:
        """Check the patch by itself, without a bearing."""
        if self.on != "roller" and self.roller != 0:  # a recorded scene says every number, 0 too
            yield not_on_a_roller(self.roller, self.on)
        if self.rim_height > 0.0 and self.rim_width == 0.0:
            yield f"rim_width_mm is 0; a shoulder with rim_height_um {self.rim_height * 1e6:g} needs a width"

    def contradictions(self, bearing: RollerBearing) -> Iterator[str]:
        """Check that the patch fits on the bearing."""
        effective, length = bearing.effective_length * 1e3, self.length * 1e3
        slack = 1e-9 * effective
        if self.on == "roller":
            yield from no_such("roller", self.roller, bearing)
        if problem := width_problem(self.width, self.on, bearing):
            yield problem
        if length > effective + slack:
            yield f"length_mm is {length:g}; it must be at most {effective:g}, the effective length"
        elif abs(self.offset * 1e3) + 0.5 * length > 0.5 * effective + slack:
            yield (
                f"offset_mm is {self.offset * 1e3:g}; with length_mm {length:g} the patch reaches beyond the "
                f"effective roller length, {effective:g} mm"
            )
        if self.on == "roller" and self.width > bearing.roller_diameter:
            yield (
                f"width_mm is {self.width * 1e3:g}; it must be at most {bearing.roller_diameter * 1e3:g}, "
                "the roller diameter"
            )
        if self.depth > 0.1 * bearing.roller_diameter:
            yield (
                f"depth_um is {self.depth * 1e6:g}; it must be at most "
                f"{0.1 * bearing.roller_diameter * 1e6:g}, a tenth of the roller diameter"
            )
        if self.kind == "brinelling":
            pitch = math.pi * (bearing.pitch_diameter - bearing.roller_diameter) / bearing.roller_count
            if self.on == "roller":
                yield "on is 'roller'; brinelling is one dent a roller, on the cup or the cone"
            elif self.width > 0.5 * pitch:
                yield (
                    f"width_mm is {self.width * 1e3:g}; it must be at most {0.5e3 * pitch:.4g}, "
                    "half a roller pitch"
                )

    def size_at(self, time: float) -> tuple[float, float, float]:
        """Find width, depth and rim height at a time [s], [m]."""
        if self.growth is None:
            return self.width, self.depth, self.rim_height
        factor = self.growth.factor(time)
        deep = factor if self.growth.depth else 1.0
        return self.width * (factor if self.growth.width else 1.0), self.depth * deep, self.rim_height * deep

    def described(self) -> str:
        """Describe the defect in a few words."""
        what = self.kind.replace("_", "-")
        where = (
            f"roller {self.roller}, row {self.row}" if self.on == "roller" else f"{self.on}, row {self.row}"
        )
        words = f"{what} on the {where}, {self.width * 1e3:.1f} mm wide, {self.depth * 1e6:.0f} µm deep"
        if self.growth is not None:
            words += f", growing from {self.growth.start:g} to {self.growth.end:g} s"
        return words


def width_problem(width: float, on: str, bearing: RollerBearing) -> str:
    """Say why a patch on cup, cone or roller cannot be of that width [m]; empty when it can.

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


def raceway_diameter(on: str, bearing: RollerBearing) -> float:
    """Compute the mean diameter of the raceway of the cup or the cone, [m]."""
    side = 1.0 if on == "cup" else -1.0
    return bearing.pitch_diameter + side * bearing.roller_diameter * math.cos(bearing.contact_angle)
