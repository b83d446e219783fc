"""Defects, waviness and roughness as written in a scene."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal, Self

from pydantic import Discriminator, Field, Tag, model_validator

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.config.file_model import (
    Count,
    FileModel,
    Fraction,
    NonNegative,
    Number,
    Positive,
    problem,
)
from beardyn_core.config.units import DEG, MM, UM
from beardyn_core.scene.defect import (
    Growth,
    MissingRoller,
    Patch,
    RollerError,
    WornPocket,
    width_problem,
)
from beardyn_core.scene.waviness import Waviness, band_amplitudes

Row = Annotated[Count, Field(ge=0, le=1)]


def _no_such(key: str, number: int, bearing: Bearing) -> list[str]:
    """What is wrong with the number of a roller or pocket."""
    if number < bearing.roller_count:
        return []
    return [
        f"{key} is {number}; {bearing.name} has {bearing.roller_count} rollers per row, "
        f"0 to {bearing.roller_count - 1}"
    ]


def _not_on_a_roller(roller: int, on: str) -> str:
    return f"roller is {roller}, but on is {on!r}: only `on: roller` has a roller's number"


class GrowthKeys(FileModel):
    """Linear growth of a patch during the run."""

    from_s: NonNegative = Field(description="simulated time up to which it has its initial size")
    to_s: Positive = Field(description="simulated time from which it has its full size")
    initial_share: Fraction = Field(0.0, description="of the full size")
    size: Literal["both", "width", "depth"] = Field("both", description="what grows")

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.to_s <= self.from_s:
            raise problem(f"to_s is {self.to_s:g}; it must be greater than from_s, {self.from_s:g}")
        return self

    def noun(self) -> Growth:
        """The growth, SI."""
        return Growth(self.from_s, self.to_s, self.initial_share, self.size != "depth", self.size != "width")


class PatchKeys(FileModel):
    """A patch of a raceway or a roller that is not where it should be."""

    kind: Literal["spall", "rectangular", "half_sine", "elliptic", "dent", "brinelling"] = "spall"
    on: Literal["cup", "cone", "roller"]
    row: Row = Field(description="0 inboard, 1 outboard")
    azimuth_deg: Number = Field(
        0.0, description="from +z (the top) towards +x, in the body's own frame at the start of the run"
    )
    width_mm: Annotated[Positive, Field(le=200.0)] = Field(description="in rolling direction")
    depth_um: Annotated[Positive, Field(le=5000.0)]
    length_mm: Positive | None = Field(None, description="along the roller; the whole contact when not given")
    offset_mm: Number = Field(0.0, description="centre from mid-length, positive towards the large end")
    roller: Annotated[Count, Field(ge=0)] = Field(0, description="which roller, with `on: roller`")
    rim_height_um: Annotated[NonNegative, Field(le=500.0)] = Field(0.0, description="raised shoulder")
    rim_width_mm: Annotated[Positive, Field(le=50.0)] | None = Field(
        None, description="of the shoulder on each side; a quarter of the width when not given"
    )
    growth: GrowthKeys | None = None

    @model_validator(mode="after")
    def _roller_is_meant(self) -> Self:
        if self.on != "roller" and self.roller != 0:  # a recorded scene says every number, 0 too
            raise problem(_not_on_a_roller(self.roller, self.on))
        return self

    def contradictions(self, bearing: Bearing) -> list[str]:
        """What of this defect does not fit the bearing; key, value and what is allowed."""
        found = []
        effective_mm = bearing.effective_length * MM
        length_mm = effective_mm if self.length_mm is None else self.length_mm
        slack_mm = 1e-9 * effective_mm
        if self.on == "roller":
            found += _no_such("roller", self.roller, bearing)
        if length_mm > effective_mm + slack_mm:
            found.append(
                f"length_mm is {length_mm:g}; it must be at most {effective_mm:g}, the effective length"
            )
        elif abs(self.offset_mm) + 0.5 * length_mm > 0.5 * effective_mm + slack_mm:
            found.append(
                f"offset_mm is {self.offset_mm:g}; with length_mm {length_mm:g} the patch reaches beyond the "
                f"effective roller length, {effective_mm:g} mm"
            )
        if self.on == "roller" and self.width_mm > bearing.roller_diameter * MM:
            found.append(
                f"width_mm is {self.width_mm:g}; it must be at most {bearing.roller_diameter * MM:g}, "
                "the roller diameter"
            )
        if self.depth_um / UM > 0.1 * bearing.roller_diameter:
            found.append(
                f"depth_um is {self.depth_um:g}; it must be at most {0.1 * bearing.roller_diameter * UM:g}, "
                "a tenth of the roller diameter"
            )
        if problem := width_problem(self.width_mm / MM, self.on, bearing):
            found.append(problem)
        if self.kind == "brinelling":
            pitch_mm = (
                math.pi * (bearing.pitch_diameter - bearing.roller_diameter) / bearing.roller_count * MM
            )
            if self.on == "roller":
                found.append("on is 'roller'; brinelling is one dent a roller, on the cup or the cone")
            elif self.width_mm > 0.5 * pitch_mm:
                found.append(
                    f"width_mm is {self.width_mm:g}; it must be at most {0.5 * pitch_mm:.4g}, "
                    "half a roller pitch"
                )
        return found

    def noun(self, bearing: Bearing) -> Patch:
        """The patch, SI."""
        rim_width_mm = 0.25 * self.width_mm if self.rim_width_mm is None else self.rim_width_mm
        return Patch(
            on=self.on,
            row=self.row,
            azimuth=self.azimuth_deg * DEG,
            width=self.width_mm / MM,
            depth=self.depth_um / UM,
            length=bearing.effective_length if self.length_mm is None else self.length_mm / MM,
            offset=self.offset_mm / MM,
            roller=self.roller,
            kind=self.kind,
            rim_height=self.rim_height_um / UM,
            rim_width=rim_width_mm / MM,
            growth=self.growth.noun() if self.growth else None,
        )


class RollerErrorKeys(FileModel):
    """A roller of another diameter than the others."""

    kind: Literal["diameter"]
    row: Row = Field(description="0 inboard, 1 outboard")
    roller: Annotated[Count, Field(ge=0)]
    diameter_um: Annotated[Number, Field(ge=-1000.0, le=200.0)] = Field(
        description="difference to the nominal diameter, positive when too large"
    )

    def contradictions(self, bearing: Bearing) -> list[str]:
        """What of this defect does not fit the bearing."""
        return _no_such("roller", self.roller, bearing)

    def noun(self, _bearing: Bearing) -> RollerError:
        """The error, SI."""
        return RollerError(self.row, self.roller, self.diameter_um / UM)


class WornPocketKeys(FileModel):
    """A cage pocket with more room than the others."""

    kind: Literal["worn_pocket"]
    row: Row = Field(description="0 inboard, 1 outboard")
    pocket: Annotated[Count, Field(ge=0)] = Field(description="the pocket of the roller of the same number")
    clearance_mm: Annotated[Positive, Field(le=5.0)] = Field(
        description="added to the clearance along the pitch circle, front and rear together"
    )

    def contradictions(self, bearing: Bearing) -> list[str]:
        """What of this defect does not fit the bearing."""
        return _no_such("pocket", self.pocket, bearing)

    def noun(self, _bearing: Bearing) -> WornPocket:
        """The worn pocket, SI."""
        return WornPocket(self.row, self.pocket, self.clearance_mm / MM)


class MissingRollerKeys(FileModel):
    """A roller that is not there; its pocket is empty."""

    row: Row = Field(description="0 inboard, 1 outboard")
    roller: Annotated[Count, Field(ge=0)]

    def contradictions(self, bearing: Bearing) -> list[str]:
        """What of this roller does not fit the bearing."""
        return _no_such("roller", self.roller, bearing)

    def noun(self) -> MissingRoller:
        """The missing roller."""
        return MissingRoller(self.row, self.roller)


def _defect_tag(value: Any) -> str | None:
    if isinstance(value, dict):
        return f"<{value.get('kind', 'spall')}>"
    kind = getattr(value, "kind", None)
    return None if kind is None else f"<{kind}>"


DefectKeys = Annotated[
    Annotated[PatchKeys, Tag("<spall>")]
    | Annotated[PatchKeys, Tag("<rectangular>")]
    | Annotated[PatchKeys, Tag("<half_sine>")]
    | Annotated[PatchKeys, Tag("<elliptic>")]
    | Annotated[PatchKeys, Tag("<dent>")]
    | Annotated[PatchKeys, Tag("<brinelling>")]
    | Annotated[RollerErrorKeys, Tag("<diameter>")]
    | Annotated[WornPocketKeys, Tag("<worn_pocket>")],
    Discriminator(_defect_tag),
]

Order = Annotated[Count, Field(ge=1, le=1000)]


class BandKeys(FileModel):
    """A band of orders whose amplitudes fall with a power of the order."""

    first: Order = Field(description="lowest order, waves per circumference")
    last: Order = Field(description="highest order")
    rms_um: Annotated[NonNegative, Field(le=50.0)] = Field(description="of the whole band")
    exponent: Annotated[Number, Field(ge=0.0, le=4.0)] = 1.0

    @model_validator(mode="after")
    def _in_order(self) -> Self:
        if self.last < self.first:
            raise problem(f"last is {self.last}; it must be at least first, {self.first}")
        return self


class WavinessKeys(FileModel):
    """Harmonics around a raceway or the rollers: single orders or a band."""

    on: Literal["cup", "cone", "roller"]
    row: Row = Field(description="0 inboard, 1 outboard")
    roller: Annotated[Count, Field(ge=0)] | None = Field(
        None, description="which roller, with `on: roller`; all of the row when not given"
    )
    orders: Annotated[tuple[Order, ...], Field(min_length=1)] | None = Field(
        None, description="waves per circumference"
    )
    amplitude_um: Annotated[NonNegative, Field(le=50.0)] | None = Field(None, description="of each order")
    band: BandKeys | None = None
    seed: Annotated[Count, Field(ge=0, le=2**32 - 1)] = Field(1, description="of the phases")

    @model_validator(mode="after")
    def _one_of_two(self) -> Self:
        singles = self.orders is not None and self.amplitude_um is not None
        partly = self.orders is not None or self.amplitude_um is not None
        if singles == (self.band is not None) or (self.band is not None and partly):
            raise problem("give either `orders` with `amplitude_um`, or `band`")
        return self

    @model_validator(mode="after")
    def _roller_is_meant(self) -> Self:
        if self.on != "roller" and self.roller is not None:
            raise problem(_not_on_a_roller(self.roller, self.on))
        return self

    def contradictions(self, bearing: Bearing) -> list[str]:
        """What of this waviness does not fit the bearing."""
        return [] if self.roller is None else _no_such("roller", self.roller, bearing)

    def noun(self) -> Waviness:
        """The waviness, SI."""
        if self.band is not None:
            band = self.band
            orders = tuple(range(band.first, band.last + 1))
            amplitudes = band_amplitudes(band.first, band.last, band.rms_um / UM, band.exponent)
        else:
            assert self.orders is not None
            assert self.amplitude_um is not None
            orders = self.orders
            amplitudes = (self.amplitude_um / UM,) * len(orders)
        return Waviness(self.on, self.row, orders, amplitudes, self.roller, self.seed)


class RoughnessKeys(FileModel):
    """Composite roughness in place of the bearing's; it counts in the film parameter only."""

    raceway_um: Positive | None = Field(None, description="rms of roller and raceway")
    rib_um: Positive | None = Field(None, description="rms of roller end and rib")
