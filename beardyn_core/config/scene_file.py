"""What a scene file says otherwise than its nouns: short forms, usual values of one another."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BeforeValidator, Field, Tag, WithJsonSchema, field_validator
from pydantic_core import PydanticKnownError

from beardyn_core.base.edge import NounError, Problem, alternatives, kinds_of, places, written_value
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import UNITS
from beardyn_core.bearing.any_bearing import AnyBearing
from beardyn_core.bearing.consistency import check
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import MOST_END_PLAY
from beardyn_core.bearing.radial_bearing import MOST_CLEARANCE, MOST_PRELOAD, RadialBearing
from beardyn_core.bearing.roller_bearing import ROW_COUNT, RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config.file_model import FileModel
from beardyn_core.config.keys import Name, Text, keys_of, reads
from beardyn_core.config.part_files import choose_form
from beardyn_core.effects import EffectSet
from beardyn_core.scene.background import Background
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Numerics, Scene, snapshots_do_not_fit
from beardyn_core.scene.sensor import FINE_STEPS, PASSBAND, RATES, rates_do_not_fit, steps_do_not_fit
from beardyn_core.scene.tier import LARGEST_STEPS, LONG_STEPS, TIERS
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of, seat_of

_AUTO = {"const": "auto"}
_BOX_KEYS = ("box_mass_kg", "box_centre_mm", "box_inertia_kg_m2")


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


# of effects of several kinds: the one that a mapping has when it does not say one
_USUAL_KINDS = {
    place.key: kinds_of(options[0])[0]
    for place in places(EffectSet)
    if place.at.switch and len(options := alternatives(place.hint)) > 1
}


def overlay(preset: dict[str, Any], changes: dict[str, Any]) -> dict[str, Any]:
    """Change the effects of a preset: named options replace those of the preset, the rest stays."""
    merged = dict(preset)
    for key, change in changes.items():
        base = preset.get(key)
        if (
            isinstance(change, dict)
            and isinstance(base, dict)
            and change.get("kind", of := base.get("kind", _USUAL_KINDS.get(key))) == of
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
    radial_clearance_mm: Annotated[float, Field(strict=True, allow_inf_nan=False, ge=-0.1, le=1.0)] | None = (
        Field(None, description="total radial travel of cylinders or barrels, in place of the bearing's")
    )
    numerics: Annotated[
        Annotated[Literal["auto"], Tag("<name>")] | Annotated[keys_of(Numerics), Tag("<inline>")],  # type: ignore[valid-type]
        choose_form("<name>", lambda value: isinstance(value, str), "<inline>"),
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
        if self.roughness.rib_um is not None and not isinstance(bearing, SphericalBearing):
            bearing = replace(bearing, rib_roughness=um.to_si(self.roughness.rib_um))
        if self.radial_clearance_mm is not None and isinstance(bearing, RadialBearing):
            clearance = UNITS["mm"].to_si(self.radial_clearance_mm)
            bearing = replace(bearing, radial_clearance=clearance)
        defects = tuple(with_length(defect, bearing.effective_length) for defect in given["defects"])
        end_play = _mounted_end_play(given, bearing)
        if isinstance(bearing, RadialBearing):
            bearing = replace(bearing, radial_clearance=bearing.radial_clearance + _closure(given, bearing))
        else:
            end_play += _closure(given, bearing)
        given |= {"bearing": bearing, "end_play": end_play, "defects": defects}
        return Scene(**{**given, "mounting": self._with_box_of_table(given, bearing)})

    def _with_box_of_table(self, given: dict[str, Any], bearing: AnyBearing) -> Mounting:
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
        problems += _box_problems(self.mounting.model_fields_set, mounting, taken, modes.name)  # type: ignore[attr-defined]
        for index, sensor in enumerate(given["sensors"]):
            if sensor.measured_paths:
                twice = (
                    "the box rings by its modes: a measured path behind them would count each of them twice"
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
        if unlike := rates_do_not_fit(given["sensors"]):
            yield unlike
        if isinstance(given["numerics"], Numerics):
            steps = given["numerics"].steps_per_sample
            found = steps_do_not_fit(given["sensors"], steps)
            if found:
                yield found
            if apart := snapshots_do_not_fit(given["snapshot_rate"], steps):
                yield apart
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
        if isinstance(given["bearing"], AnyBearing):
            yield from _play_out_of_range(given, given["bearing"])
            yield from _not_of_this_kind(self.radial_clearance_mm, given, given["bearing"])
            if self.roughness.rib_um is not None and given["bearing"].self_aligning:
                named = f"{given['bearing'].name} is a {given['bearing'].words}"
                yield Problem(f"{named}: it has no ribs", ("roughness", "rib_um"))
        reception = PASSBAND * max((sensor.rate for sensor in given["sensors"]), default=0.0)
        if given["vibration_to"] is not None and given["vibration_to"] > reception:
            yield (
                f"vibration_to_Hz is {given['vibration_to']:g}; the sensors measure to {reception:g} Hz: ask "
                f"for less, or give one rate_kHz {RATES[-1] / 1e3:g}, which measures to "
                f"{PASSBAND * RATES[-1]:g} Hz"
            )
        yield from _rough_twice(given["background"], given["operation"])


def _not_of_this_kind(
    clearance: float | None, given: dict[str, Any], bearing: AnyBearing
) -> Iterator[Problem]:
    """Find a play that the bearing does not have, and an axle that nothing holds along its axis."""
    if not isinstance(bearing, RadialBearing):
        if clearance is not None:
            yield Problem(
                f"{bearing.name} is a {bearing.words}; its play is end_play_mm", ("radial_clearance_mm",)
            )
        return
    if not isinstance(bearing, CylindricalBearing):
        if given["end_play"] is not None:
            yield Problem(
                f"{bearing.name} is a {bearing.words}; its play is radial_clearance_mm", ("end_play_mm",)
            )
        return
    if given["end_play"] is not None:
        for sentence in check(bearing.mounted(given["end_play"])):
            yield Problem(sentence.removesuffix("."), ("end_play_mm",))
    single = given["rows"] != ROW_COUNT
    held = bearing.row_is_held if single else bearing.carries_thrust
    if not held and getattr(given["mounting"], "axial_prop_stiffness", 1.0) == 0.0:
        ribs = f"cone_ribs {bearing.cone_ribs}, cup_ribs {bearing.cup_ribs}"
        if bearing.carries_thrust:
            lack = f"with rows 1 is a single row with {ribs}: it holds the axle along its axis one way only"
        else:
            lack = (
                f"has {ribs}: no rib of the inner ring has one of the outer ring at the other ends of its "
                "rollers, so that nothing holds the axle along its axis"
            )
        yield Problem(
            f"{bearing.name} {lack}; give mounting.axial_prop_stiffness_MN_per_m, or ribs "
            f"{'on both sides of both rings, as NUP has' if single else 'as NJ and NJP have'}",
            ("rows",) if bearing.carries_thrust else ("bearing",),
        )


def _mounted_end_play(given: dict[str, Any], bearing: AnyBearing) -> float:
    """Return the end play when mounted, [m]."""
    return float(bearing.end_play if given["end_play"] is None else given["end_play"])


def _closure(given: dict[str, Any], bearing: RollerBearing) -> float:
    """Return what the temperatures of the parts add to it, [m]."""
    return float(given["temperatures"].closure(bearing)) if given["temperatures"] else 0.0


def _play_out_of_range(given: dict[str, Any], bearing: AnyBearing) -> Iterator[Problem]:
    """Find temperatures that open or close the bearing beyond what its contacts are for."""
    mm, mounted, closure = UNITS["mm"], _mounted_end_play(given, bearing), _closure(given, bearing)
    if isinstance(bearing, RadialBearing):
        open_by = bearing.radial_clearance + closure
        if not -MOST_PRELOAD <= open_by <= MOST_CLEARANCE:
            yield Problem(
                f"temperatures make the radial clearance of {mm.to_edge(bearing.radial_clearance):.3g} mm "
                f"when mounted one of {mm.to_edge(open_by):.3g} mm; it must lie between "
                f"{-mm.to_edge(MOST_PRELOAD):g} and {mm.to_edge(MOST_CLEARANCE):g} mm",
                ("temperatures",),
            )
        return
    if abs(mounted + closure) > MOST_END_PLAY:
        yield Problem(
            f"temperatures make the end play of {mm.to_edge(mounted):.3g} mm when mounted one of "
            f"{mm.to_edge(mounted + closure):.3g} mm; it must lie between {-mm.to_edge(MOST_END_PLAY):g} and "
            f"{mm.to_edge(MOST_END_PLAY):g} mm",
            ("temperatures",),
        )


def _box_problems(given: set[str], stated: Mounting, taken: Mounting, name: str) -> Iterator[Problem]:
    """Find keys of a mounting that say something else of the box than its table."""
    for place in places(Mounting):
        if place.key in _BOX_KEYS and place.key in given:
            said, meant = getattr(stated, place.field), getattr(taken, place.field)
            if not np.allclose(said, meant, rtol=1e-3, atol=1e-4):
                shown = written_value(meant, place.at)
                yield Problem(
                    f"{place.key} is {written_value(said, place.at)}; the box {name} of effects.structure "
                    f"has {shown} without the cup: leave the key out",
                    ("mounting",),
                )


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
