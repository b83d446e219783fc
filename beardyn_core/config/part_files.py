"""What the files of parts say otherwise than their nouns: a lubricant, defects, operations, sensors."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Discriminator, Field, Tag, WithJsonSchema

import beardyn_core.config.derivation  # noqa: F401  what the file of a bearing may have besides
from beardyn_core.base.edge import WorkedOut
from beardyn_core.bearing.lubricant import Lubricant, gold_pressure_viscosity, walther_viscosity
from beardyn_core.config.file_model import FileModel, SourcedModel
from beardyn_core.config.keys import Text, keys_of, reads
from beardyn_core.rail.measured import speed_points
from beardyn_core.scene.field_spall import FieldSpall, width_of_stage
from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation
from beardyn_core.scene.patch import Growth, Patch
from beardyn_core.scene.running import Timetable
from beardyn_core.scene.sensor import ALL_RATES, RATE_WORDS, RATES, Accelerometer, SensorType
from beardyn_core.scene.waviness import Band, Waviness


def choose_form(first: str, is_first: Any, second: str) -> Discriminator:
    """Choose between two forms of a value."""
    return Discriminator(lambda value: first if is_first(value) else second)


@reads(Lubricant)
class LubricantFile(SourcedModel):
    """A lubricant, whose pressure viscosity may follow from its base oil."""

    def values(self) -> dict[str, Any]:
        """Fill in the pressure viscosity."""
        found = super().values()
        if found["pressure_viscosity"] is None:
            viscosity = walther_viscosity(
                found["kinematic_viscosity_40"],
                found["kinematic_viscosity_100"],
                found["pressure_viscosity_temperature"],
            )
            found["pressure_viscosity"] = gold_pressure_viscosity(viscosity, found["base_oil"])
        return found


@reads(Growth)
class GrowthFile(FileModel):
    """A growth, which says in one word what grows."""

    size: Literal["both", "width", "depth"] = Field("both", description="what grows")

    def values(self) -> dict[str, Any]:
        """Turn the word into two truths."""
        return {**super().values(), "width": self.size != "depth", "depth": self.size != "width"}


@reads(Patch)
class PatchFile(FileModel):
    """A patch, whose shoulder follows from its width."""

    def values(self) -> dict[str, Any]:
        """Fill in the width of the shoulder."""
        found = super().values()
        rim = 0.25 * found["width"] if found["rim_width"] is None else found["rim_width"]
        return {**found, "rim_width": rim}


@reads(FieldSpall)
class FieldSpallFile(FileModel):
    """A field spall, whose width may follow from its stage."""

    stage: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=1.0, le=5.0)] | None = Field(
        None,
        description="of growth, in place of its width: 1 a pit, 2 small, 3 medium, 4 large, 5 raceway-wide",
    )

    def values(self) -> dict[str, Any]:
        """Draw the width of a stage."""
        found = super().values()
        if self.stage is not None:
            found["width"] = width_of_stage(self.stage, found["seed"])
        return found

    def rules(self) -> Iterator[str]:
        """Find neither or both of width and stage."""
        if (getattr(self, "width_mm", None) is None) == (self.stage is None):
            yield "give either `width_mm` or `stage`"


_Amplitude = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=50.0)]


@reads(Waviness)
class WavinessFile(FileModel):
    """Single orders with one amplitude or one each, or a band."""

    amplitude_um: (
        Annotated[
            Annotated[_Amplitude, Tag("<one>")] | Annotated[tuple[_Amplitude, ...], Tag("<each>")],
            choose_form("<each>", lambda value: isinstance(value, list | tuple), "<one>"),
        ]
        | None
    ) = Field(None, description="of each order: one for all, or a list with one an order")
    band: keys_of(Band) | None = Field(  # type: ignore[valid-type]
        None, description="a band of orders, instead"
    )

    def values(self) -> dict[str, Any]:
        """Work the orders and amplitudes out."""
        found = super().values()
        if self.band is not None:
            band = self.band.noun()
            return {**found, "orders": band.orders, "amplitudes": band.amplitudes}
        orders, amplitudes = found["orders"] or (), found["amplitudes"]
        several = amplitudes if isinstance(amplitudes, tuple) else (amplitudes,) * len(orders)
        return {**found, "orders": orders, "amplitudes": several}

    def rules(self) -> Iterator[str]:
        """Find neither or both of orders and band."""
        given = (getattr(self, "orders", None) is not None, self.amplitude_um is not None)
        if all(given) == (self.band is not None) or (self.band is not None and any(given)):
            yield "give either `orders` with `amplitude_um`, or `band`"


@reads(MeasuredOperation)
class MeasuredFile(FileModel):
    """A measured operation, whose kind must be that of its file."""

    kind: Literal["csv", "mcap"] = Field(description="a CSV file or a recording")

    def rules(self) -> Iterator[str]:
        """Find a file of another kind."""
        path, recording = self.path, self.path.lower().endswith(".mcap")  # type: ignore[attr-defined]
        if self.kind == "csv" and recording:
            yield f"path is {path!r}; that is a recording: use kind: mcap"
        if self.kind == "mcap" and not recording:
            yield f"path is {path!r}; a recording ends in .mcap: for CSV text use kind: csv"


def _one_or_list(schema: dict[str, Any]) -> None:
    """Say in the schema of a list that one item alone will do."""
    several = {"type": schema.pop("type"), "items": schema.pop("items")}
    schema["anyOf"] = [several["items"], several]


@reads(QuarterVehicleOperation)
class QuarterVehicleFile(FileModel):
    """An operation on the rail, whose speed comes from one of three places."""

    schema_changes: ClassVar[dict[str, Any]] = {"curve": _one_or_list}
    checked_elsewhere: ClassVar[tuple[str, ...]] = ("wheel_defects",)
    measured_speed: Text | None = Field(
        None, description="instead: CSV file or recording, relative to the scene file, with the shaft speed"
    )
    timetable: keys_of(Timetable) | None = Field(  # type: ignore[valid-type]
        None, description="from stop to stop, instead of a profile"
    )

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        curve = data.get("curve")
        return super()._prepare({**data, "curve": [curve]} if isinstance(curve, dict) else data)

    def values(self) -> dict[str, Any]:
        """Work the speed profile out."""
        found = super().values()
        if self.timetable is not None:
            timetable = self.timetable.noun()
            found["speed_profile"] = WorkedOut(timetable.speed_profile(), timetable)
        elif self.measured_speed is not None:
            path = Path(self.measured_speed)
            found["speed_profile"] = WorkedOut(speed_points(path, found["wheel_diameter"]), path)
        return found

    def rules(self) -> Iterator[str]:
        """Find a speed from nowhere or from two places."""
        sources = ("speed_profile", "timetable", "measured_speed")
        given = [name for name in sources if getattr(self, name) is not None]
        if len(given) != 1:
            found = "speed_profile is missing" if not given else f"{' and '.join(given)} are given"
            yield f"{found}; give exactly one of {', '.join(sources)}"


@reads(Accelerometer)
class SensorFile(FileModel):
    """A sensor, which has from its type what it does not give itself; the schema lists the rates."""

    rate_kHz: Annotated[
        float,
        Field(strict=True, allow_inf_nan=False),
        WithJsonSchema({"enum": [rate / 1e3 for rate in ALL_RATES]}),
    ] = Field(
        RATES[0] / 1e3,
        description=RATE_WORDS,
    )

    def values(self) -> dict[str, Any]:
        """Take from the type what is not given."""
        found = super().values()
        kind = found["type"]
        if not isinstance(kind, SensorType):
            return {**found, "type": None}
        given = {
            place.field
            for place in self.places
            if place.key in self.model_fields_set and getattr(self, place.key) is not None
        }
        own = {field.name for field in fields(SensorType)} & {place.field for place in self.places}
        return found | {name: getattr(kind, name) for name in own - given - {"name"}}
