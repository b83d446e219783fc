"""What the parts of a scene file say otherwise than their nouns: short forms, usual values of one another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import BeforeValidator, Discriminator, Field, Tag, WithJsonSchema, field_validator
from pydantic_core import PydanticKnownError

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant, gold_pressure_viscosity, walther_viscosity
from beardyn_core.config.file_model import FileModel, SourcedModel
from beardyn_core.config.keys import Name, Text, keys_of, reads
from beardyn_core.config.structure import box_problems, modes_of_effects, mounting_of, seat_of
from beardyn_core.edge import UNITS, NounError, Problem, WorkedOut, places
from beardyn_core.effects import EffectSet
from beardyn_core.errors import InputError
from beardyn_core.rail.measured import speed_points
from beardyn_core.scene.background import Background
from beardyn_core.scene.defect import Growth, Patch
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation
from beardyn_core.scene.running import Timetable
from beardyn_core.scene.scene import Numerics, Scene
from beardyn_core.scene.sensor import FINE_STEPS, PASSBAND, RATES, Accelerometer, SensorType, steps_do_not_fit
from beardyn_core.scene.tier import LARGEST_STEPS, LONG_STEPS, TIERS
from beardyn_core.scene.waviness import Band, Waviness

_AUTO = {"const": "auto"}


def _tagged(first: str, is_first: Any, second: str) -> Discriminator:
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


_Amplitude = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=50.0)]


@reads(Waviness)
class WavinessFile(FileModel):
    """Single orders with one amplitude or one each, or a band."""

    amplitude_um: (
        Annotated[
            Annotated[_Amplitude, Tag("<one>")] | Annotated[tuple[_Amplitude, ...], Tag("<each>")],
            _tagged("<each>", lambda value: isinstance(value, list | tuple), "<one>"),
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
        WithJsonSchema({"enum": [rate / 1e3 for rate in RATES]}),
    ] = Field(
        RATES[0] / 1e3,
        description=f"51.2 needs an even numerics.steps_per_sample of {FINE_STEPS} or more, its default then",
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


def _number_of_steps(value: Any) -> Any:
    if isinstance(value, float) and value in LONG_STEPS:
        return value  # in the fast tiers
    if not isinstance(value, int) or isinstance(value, bool):
        raise PydanticKnownError("int_type")
    if value < 1:
        raise PydanticKnownError("greater_than_equal", {"ge": 1})
    return value


_WORDS = {place.key: place.words for place in places(Numerics)}


@reads(Numerics)
class NumericsFile(FileModel):
    """Numbers of the discretisation, of which a scene may leave some open with `auto`."""

    laminae: Annotated[
        int,
        Field(strict=True, ge=1, le=100),
        WithJsonSchema({"anyOf": [{"type": "integer", "minimum": 1, "maximum": 100}, _AUTO]}),
    ] = Field(Numerics.laminae, description=_WORDS["laminae"])
    integrator: Literal["implicit", "explicit"] = Field("implicit", description=_WORDS["integrator"])
    steps_per_sample: Annotated[
        int | float,
        BeforeValidator(_number_of_steps),
        WithJsonSchema(
            {
                "anyOf": [
                    {"type": "integer", "minimum": 1, "maximum": LARGEST_STEPS["explicit"]},
                    {"enum": list(LONG_STEPS)},
                    _AUTO,
                ]
            }
        ),
    ] = Field(4, description=_WORDS["steps_per_sample"])

    @field_validator("steps_per_sample")
    @classmethod
    def _few_enough(cls, steps: float, info: Any) -> float:
        most = LARGEST_STEPS[info.data.get("integrator", "explicit")]
        if steps > most:
            raise PydanticKnownError("less_than_equal", {"le": most})
        return steps


@reads(EffectSet)
class EffectsFile(FileModel):
    """The effects of a scene: options, `true` for the usual ones, `false` or nothing for absent."""

    name: Name = Field("custom", description="of the set")
    purpose: Text = Field("", description="one line: what the set is for")
    preset: Name | None = Field(None, description="set to start from; the keys given here change it")

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        return super()._prepare({**data, "traction": None} if data.get("traction") is False else data)

    @classmethod
    def _advice(cls, key: str, given: set[str]) -> str:
        if key == "ring_flexibility":
            return "ring_flexibility is called `structure` now; what it held is structure of kind: rings"
        return super()._advice(key, given)


def overlay(preset: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Change the effects of a preset: named options replace those of the preset, the rest stays."""
    merged = dict(preset)
    for key, change in changes.items():
        base = preset.get(key)
        if (
            isinstance(change, dict)
            and isinstance(base, dict)
            and change.get("kind", base.get("kind")) == base.get("kind")
        ):
            if "table" in change:  # the content is that of the table before
                base = {name: value for name, value in base.items() if name != "content"}
            merged[key] = {**base, **change}
        elif change is True and isinstance(base, dict):
            merged[key] = base
        else:
            merged[key] = change
    return merged


class RoughnessKeys(FileModel):
    """Composite roughness in place of the bearing's; it counts in the film parameter only."""

    raceway_um: Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)] | None = Field(
        None, description="rms of roller and raceway"
    )
    rib_um: Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)] | None = Field(
        None, description="rms of roller end and rib"
    )


@reads(Scene)
class SceneFile(FileModel):
    """One bearing under one operation, with all that is asked of the run."""

    roughness: RoughnessKeys = Field(
        RoughnessKeys(),
        description="composite, in place of the bearing's; it counts in the film parameter only",
    )
    numerics: Annotated[
        Annotated[Literal["auto"], Tag("<name>")] | Annotated[keys_of(Numerics), Tag("<inline>")],  # type: ignore[valid-type]
        _tagged("<name>", lambda value: isinstance(value, str), "<inline>"),
    ] = Field(keys_of(Numerics)(), description="discretisation of the run, or auto")

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        """Write down the time step of the tier, or of a fast sensor, where the scene does not."""
        tier, numerics = TIERS.get(str(data.get("tier", "full"))), data.get("numerics", {})
        if tier is None or not isinstance(numerics, dict) or "steps_per_sample" in numerics:
            return data
        sensors = data.get("sensors")
        fast = isinstance(sensors, list | tuple) and any(
            isinstance(each, dict) and each.get("rate_kHz") == RATES[1] / 1e3 for each in sensors
        )
        steps = max(tier.steps_per_sample, FINE_STEPS if fast else 1)
        return {**data, "numerics": {**numerics, "steps_per_sample": steps}}

    def make(self) -> Scene | None:
        """Make the scene, with what its parts leave to each other; ``None`` with an unread reference."""
        given = self.values()
        parts = ("bearing", "lubricant", "effects", "numerics", "operation")
        if isinstance(given["background"], str) or any(
            isinstance(given[part], str) or given[part] is None for part in parts
        ):
            return None
        bearing, um = given["bearing"], UNITS["um"]
        if self.roughness.raceway_um is not None:
            bearing = replace(bearing, raceway_roughness=um.to_si(self.roughness.raceway_um))
        if self.roughness.rib_um is not None:
            bearing = replace(bearing, rib_roughness=um.to_si(self.roughness.rib_um))
        closure = given["temperatures"].closure(bearing) if given["temperatures"] else 0.0
        mounted = bearing.end_play if given["end_play"] is None else given["end_play"]
        defects = tuple(with_length(defect, bearing.effective_length) for defect in given["defects"])
        given |= {"bearing": bearing, "end_play": mounted + closure, "defects": defects}
        return Scene(**{**given, "mounting": self._with_box_of_table(given, bearing)})

    def _with_box_of_table(self, given: dict[str, Any], bearing: Bearing) -> Mounting:
        """Take the box from the table of its modes, and find sensors that sit nowhere on it."""
        mounting: Mounting = given["mounting"]
        problems = []
        try:
            modes = modes_of_effects(given["effects"])
            if modes is None:
                return mounting
            taken = mounting_of(modes, mounting, bearing)
        except InputError as error:
            problems = [Problem(each, ("effects", "structure")) for each in error.problems]
            raise NounError("structure", problems) from error
        problems += box_problems(self.mounting.model_fields_set, mounting, taken, modes.name)  # type: ignore[attr-defined]
        for index, sensor in enumerate(given["sensors"]):
            if sensor.measured_paths:
                twice = (
                    "the box rings by its modes: a measured path behind them would hear each of them twice"
                )
                problems.append(Problem(f"{twice}; leave one out", ("sensors", index, "measured_paths")))
            try:
                seat_of(sensor, modes)
            except InputError as error:
                problems += [Problem(each, ("sensors", index)) for each in error.problems]
        if problems:
            raise NounError("structure", problems)
        return taken

    def rules(self) -> Iterator[str | Problem]:
        """Find what is given twice, and a time step that does not serve the sensors."""
        given = self.values()
        for index, name in enumerate(given["quantities"]):
            if name in given["quantities"][:index]:
                yield f"quantities[{index}] is {name!r}, given twice; name each quantity once"
        names = [sensor.name for sensor in given["sensors"]]
        for index, name in enumerate(names):
            if name in names[:index]:
                yield f"sensors[{index}].name is {name!r}, given twice; each sensor needs its own name"
        if isinstance(given["numerics"], Numerics):
            steps = given["numerics"].steps_per_sample
            found = steps_do_not_fit(given["sensors"], steps)
            if found:
                yield found
            if steps < 1 and isinstance(given["background"], Background) and given["background"].forces:
                yield (
                    f"numerics.steps_per_sample is {steps:g}; a background with forces needs at least 1, for "
                    "they reach 8 kHz"
                )
            operation = given["operation"]
            if steps < 1 and isinstance(operation, QuarterVehicleOperation) and operation.bends_in_the_twin:
                yield (
                    f"numerics.steps_per_sample is {steps:g}; a coupled wheelset needs at least 1, for the "
                    "box rings on its end at 2.7 kHz"
                )
        yield from _axle_held_twice(given["operation"], given["mounting"])
        hearing = PASSBAND * max((sensor.rate for sensor in given["sensors"]), default=0.0)
        if given["vibration_to"] is not None and given["vibration_to"] > hearing:
            yield (
                f"vibration_to_Hz is {given['vibration_to']:g}; the sensors hear to {hearing:g} Hz: ask for "
                f"less, or give one rate_kHz {RATES[-1] / 1e3:g}, which hears to {PASSBAND * RATES[-1]:g} Hz"
            )
        yield from _rough_twice(given["background"], given["operation"])


def _axle_held_twice(operation: Any, mounting: Any) -> Iterator[str]:
    """Find what a wheelset that bends in the twin cannot go with: its bending is what tilts the journal."""
    if not isinstance(operation, QuarterVehicleOperation) or not operation.bends_in_the_twin:
        return
    for key, needed in (("journal_tilt", "locked"), ("cup", "suspended")):
        found = getattr(mounting, key, needed)
        if found != needed:
            yield f"mounting.{key} is {found}; with operation.wheelset coupled it must be {needed}"


def _rough_twice(background: Any, operation: Any) -> Iterator[str]:
    """Find a roughness without a rail, or one besides that of the irregularity."""
    if not isinstance(background, Background) or background.roughness is None or operation is None:
        return
    if not isinstance(operation, QuarterVehicleOperation):
        yield "background.roughness needs an operation of kind quarter_vehicle, with a wheel on a rail"
    elif operation.irregularity.short_waves is not None:
        yield (
            "background.roughness and operation.irregularity.short_waves are both given; they are the same "
            "waves: leave one out"
        )


def with_length(defect: Any, effective_length: float) -> Any:
    """Give a patch without a length that of the contact, [m]."""
    return replace(defect, length=effective_length) if getattr(defect, "length", 0.0) is None else defect
