"""From names and files to frozen nouns: references resolved, every mistake reported at once."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, Protocol, TypeVar

from pydantic import TypeAdapter, ValidationError

from beardyn_core.bearing.consistency import check
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.choice.free import Free
from beardyn_core.choice.usual_step import usual_step
from beardyn_core.config.automatic import AUTO, REFERENCE, Explanation, choice_for, resolved, take_auto
from beardyn_core.config.bearing_file import BearingKeys
from beardyn_core.config.defect_file import DefectKeys, WavinessKeys
from beardyn_core.config.effects_file import EffectsKeys, overlay
from beardyn_core.config.excitation_file import WheelDefectKeys
from beardyn_core.config.file_model import FileModel
from beardyn_core.config.folders import find
from beardyn_core.config.lubricant_file import LubricantKeys
from beardyn_core.config.missing import missing_problems
from beardyn_core.config.operation_file import USUAL_WHEEL_DIAMETER_MM, WheelDiameter
from beardyn_core.config.problems import Origin, Place, key_path, located, sentences
from beardyn_core.config.scene_file import NumericsKeys, SceneKeys
from beardyn_core.config.units import stem_of
from beardyn_core.config.vehicle_file import VehicleKeys
from beardyn_core.config.yaml_text import read_file, read_mapping, write_mapping
from beardyn_core.effects import EffectSet
from beardyn_core.errors import InputError
from beardyn_core.rail.irregularity import RAIL_LAYOUT
from beardyn_core.rail.measured import read_measurement
from beardyn_core.rail.spectra import DENSITY_LAYOUT
from beardyn_core.rail.table import read_table
from beardyn_core.scene.integrator import integrator_problems
from beardyn_core.scene.irregularity import MEASURED
from beardyn_core.scene.operation import Vehicle
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIER_NAMES, contradictions

Noun = TypeVar("Noun", covariant=True)
Keys = TypeVar("Keys", bound=FileModel)


class _Describes(Protocol[Noun]):
    def noun(self) -> Noun: ...


def load_scene(
    name: str | Path,
    *,
    effects: str | None = None,
    tier: str | None = None,
    duration: float | None = None,
    laminae: int | None = None,
    seed: int | None = None,
    accuracy_percent: float | None = None,
    quantities: list[str] | None = None,
    outside_load: bool = False,
) -> Scene:
    """Scene of a shipped name or of a file.

    Parameters
    ----------
    name : str or Path
        A shipped scene, or the path of a YAML file.
    effects : str, optional
        Preset or file instead of the scene's effects, or ``auto``.
    tier : str, optional
    duration : float, optional
        [s].
    laminae, seed : int, optional
    accuracy_percent, quantities : float, list of str, optional
        What is asked for, when something is ``auto``.
    outside_load : bool
        Whether the load comes from elsewhere than the scene's operation: the lumped tier then takes no steps
        longer than a sample unless the scene gives them.

    Raises
    ------
    InputError
        With every mistake in the scene and in the files it refers to.
    """
    path = find("scenes", str(name))
    overrides: dict[Place, Any] = {
        ("effects",): effects,
        ("tier",): tier,
        ("duration_s",): duration,
        ("numerics", "laminae"): laminae,
        ("seed",): seed,
        ("accuracy_percent",): accuracy_percent,
        ("quantities",): quantities,
    }
    given = {place: value for place, value in overrides.items() if value is not None}
    return _Reading(read_file(path), str(path), path.parent, outside_load).scene(given)


def explain_scene(
    name: str | Path,
    *,
    effects: str | None = None,
    tier: str | None = None,
    accuracy_percent: float | None = None,
    quantities: list[str] | None = None,
) -> Explanation:
    """Why a scene is computed as it is, and what would be chosen for it; arguments as of `load_scene`.

    Parameters
    ----------
    name : str or Path
    effects, tier : str, optional
    accuracy_percent : float, optional
        Instead of the scene's.
    quantities : list of str, optional
        Instead of the scene's.

    Raises
    ------
    InputError
        With every mistake.
    """
    path = find("scenes", str(name))
    overrides: dict[Place, Any] = {
        ("effects",): effects,
        ("tier",): tier,
        ("accuracy_percent",): accuracy_percent,
        ("quantities",): quantities,
    }
    given = {place: value for place, value in overrides.items() if value is not None}
    reference = load_effects(REFERENCE)
    keys, free = _Reading(read_file(path), str(path), path.parent).keys(given)
    current = choice_for(keys, free, reference)
    if free.anything:
        return Explanation(resolved(keys, current), current, None)
    every = _Reading(read_file(path), str(path), path.parent)
    every.data.pop("tier", None)
    every.data.pop("numerics", None)
    automatic = choice_for(*every.keys({**given, ("effects",): AUTO, ("tier",): AUTO}), reference)
    return Explanation(keys.noun(""), current, automatic)


def scene_from_text(text: str, label: str = "scene") -> Scene:
    """Scene of a YAML text, such as the one recorded with a run; see `load_scene`."""
    return _Reading(read_mapping(text, label), label, Path()).scene({})


def scene_from_mapping(data: dict[str, Any], label: str, folder: Path) -> Scene:
    """Scene of the mapping in a scene file that lies in a folder; see `load_scene`."""
    return _Reading(data, label, folder).scene({})


def load_bearing(name: str | Path) -> Bearing:
    """Bearing of a shipped name or of a file; raises `InputError` with every mistake and contradiction."""
    path = find("bearings", str(name))
    return bearing_from_mapping(read_file(path), str(path))


def bearing_from_mapping(data: dict[str, Any], label: str) -> Bearing:
    """Make a bearing of the mapping in a bearing file; see `load_bearing`."""
    bearing = _validated(BearingKeys, data, label).noun()
    if problems := check(bearing):
        raise InputError([f"{label}: {_plain(problem)}" for problem in problems])
    return bearing


def load_lubricant(name: str | Path) -> Lubricant:
    """Lubricant of a shipped name or of a file; raises `InputError` with every mistake."""
    return _load(LubricantKeys, find("lubricants", str(name))).noun()


def load_vehicle(name: str | Path) -> Vehicle:
    """Vehicle of a shipped name or of a file; raises `InputError` with every mistake."""
    return _load(VehicleKeys, find("vehicles", str(name))).noun()


def load_effects(name: str | Path) -> EffectSet:
    """Effects of a shipped preset or of a file; raises `InputError` with every mistake."""
    return _load(EffectsKeys, find("effects", str(name))).noun()


def _load(keys: type[Keys], path: Path) -> Keys:
    return _validated(keys, read_file(path), str(path))


def _validated(keys: type[Keys], data: dict[str, Any], label: str) -> Keys:
    try:
        return keys.model_validate(data)
    except ValidationError as error:
        raise InputError(sentences(error, [Origin((), label)])) from None


def _plain(problem: str) -> str:
    return problem.removesuffix(".")


class _Reading:
    """One scene being read: the resolved mapping, where its parts came from, the mistakes so far."""

    def __init__(self, data: dict[str, Any], label: str, folder: Path, outside_load: bool = False) -> None:
        self.data = dict(data)
        self.folder = folder
        self.outside_load = outside_load
        self.origins = [Origin((), label)]
        self.problems: list[str] = []

    def scene(self, overrides: dict[Place, Any]) -> Scene:
        keys, free = self.keys(overrides)
        if free.anything:
            return resolved(keys, choice_for(keys, free, load_effects(REFERENCE)))
        return keys.noun(write_mapping(keys.model_dump(mode="json", exclude_none=True)))

    def keys(self, overrides: dict[Place, Any]) -> tuple[SceneKeys, Free]:
        """The validated scene, and what of it may be chosen."""
        for place, value in overrides.items():
            self._override(place, value)
        self._inline(self.data, "bearing", "bearings", ())
        self._inline(self.data, "lubricant", "lubricants", ())
        self.data.setdefault("effects", "standard")
        free = take_auto(self.data)
        self._inline_effects()
        operation = self.data.get("operation")
        if isinstance(operation, dict):
            operation = self.data["operation"] = dict(operation)
            self._inline(operation, "vehicle", "vehicles", ("operation",))
            self._locate_files(operation)
        try:
            keys = SceneKeys.model_validate(self.data)
        except ValidationError as error:
            self.problems += sentences(error, self.origins)
        self._check_contradictions(free)
        self._check_integrator(free)
        if self.problems:
            raise InputError(list(dict.fromkeys(self.problems)))
        if not free.anything and "steps_per_sample" not in self.data.get("numerics", {}):
            keys = _with_usual_step(keys, self.outside_load)
        return keys, free

    def _complain(self, place: Place, problems: list[str]) -> None:
        label, key = located(place, self.origins)
        where = label if label.startswith("--") else f"{label}: {key}"
        self.problems += [f"{where}: {text}" for text in problems]

    def _override(self, place: Place, value: Any) -> None:
        owner = self.data
        for key in place[:-1]:
            inner = owner.get(str(key), {})
            if not isinstance(inner, dict):
                return  # the scene file is wrong here and is told so
            copy = dict(inner)
            owner[str(key)] = copy
            owner = copy
        owner[str(place[-1])] = value
        self.origins.append(Origin(place, f"--{stem_of(str(place[-1]))}", place))

    def _inline(self, owner: dict[str, Any], key: str, kind: str, above: Place) -> None:
        """Replace a reference by what it refers to."""
        name = owner.get(key)
        if not isinstance(name, str):
            return
        place = (*above, key)
        try:
            path = find(kind, name, self.folder)
        except InputError as error:
            self._complain(place, error.problems)
            return
        try:
            owner[key] = read_file(path)
            self.origins.append(Origin(place, str(path)))
        except InputError as error:
            self.problems += error.problems

    def _inline_effects(self) -> None:
        given = self.data["effects"]
        if isinstance(given, dict) and isinstance(given.get("preset"), str):
            preset = {"effects": given["preset"]}
            self._inline(preset, "effects", "effects", ())
            if isinstance(preset["effects"], dict):
                changes = {key: value for key, value in given.items() if key != "preset"}
                self.data["effects"] = overlay(preset["effects"], changes)
                base = self.origins[0]
                self.origins += [Origin(("effects", key), base.label, ("effects", key)) for key in changes]
        else:
            self._inline(self.data, "effects", "effects", ())
        resolved = self.data["effects"]
        if isinstance(resolved, dict) and resolved is not given and "preset" in resolved:
            self._complain(
                ("effects", "preset"), ["a preset cannot start from another preset; write its effects out"]
            )

    def _locate_files(self, operation: dict[str, Any]) -> None:
        """Make the paths of measured files absolute, and read them for their mistakes."""
        take = str(operation.get("take", "both"))
        recording = str(operation.get("path", "")).lower().endswith(".mcap")
        if operation.get("kind") == ("mcap" if recording else "csv"):
            self._locate(operation, "path", lambda path: read_measurement(path, take))
        self._locate(operation, "measured_speed", lambda path: read_measurement(path, "speed"))
        irregularity = operation.get("irregularity")
        if isinstance(irregularity, dict) and irregularity.get("kind") in MEASURED:
            irregularity = operation["irregularity"] = dict(irregularity)
            profile = irregularity["kind"] == "csv"
            layout = RAIL_LAYOUT if profile else DENSITY_LAYOUT
            self._locate(irregularity, "path", lambda path: read_table(path, layout))

    def _locate(self, owner: dict[str, Any], key: str, read: Callable[[Path], object]) -> None:
        path = owner.get(key)
        if not isinstance(path, str):
            return
        located_path = (self.folder / path).resolve()
        owner[key] = str(located_path)
        try:
            read(located_path)
        except InputError as error:
            self.problems += error.problems

    def _check_contradictions(self, free: Free) -> None:
        """What is well written and cannot be; parts with other mistakes are left out."""
        self._check_tier(free)
        self._check_pockets()
        self._check_wheel()
        bearing_keys = _valid(BearingKeys, self.data.get("bearing"))
        if bearing_keys is None:
            return
        bearing = bearing_keys.noun()
        label = max(
            (origin for origin in self.origins if origin.place in ((), ("bearing",))),
            key=lambda o: len(o.place),
        ).label
        problems = check(bearing)
        self.problems += [f"{label}: {_plain(problem)}" for problem in problems]
        faults: tuple[tuple[str, Any], ...] = (("defects", DefectKeys), ("waviness", WavinessKeys))
        for key, keys in faults:
            entries = self.data.get(key)
            for index, given in enumerate(entries if isinstance(entries, list) and not problems else []):
                fault = _valid(keys, given)
                for problem in fault.contradictions(bearing) if fault else []:
                    self.problems.append(f"{self.origins[0].label}: {key_path((key, index))}.{problem}")
        for place, problem in missing_problems(self.data, bearing):
            self._complain(place, [problem])

    def _check_wheel(self) -> None:
        operation = self.data.get("operation")
        if not isinstance(operation, dict):
            return
        diameter: Any = WheelDiameter
        diameter_mm = _valid(diameter, operation.get("wheel_diameter_mm", USUAL_WHEEL_DIAMETER_MM))
        entries = operation.get("wheel_defects")
        keys: Any = WheelDefectKeys
        for index, given in enumerate(entries if isinstance(entries, list) and diameter_mm else []):
            defect = _valid(keys, given)
            for problem in defect.contradictions(diameter_mm) if defect else []:
                place = key_path(("operation", "wheel_defects", index))
                self.problems.append(f"{self.origins[0].label}: {place}.{problem}")

    def _check_tier(self, free: Free) -> None:
        tier = self.data.get("tier", "full")
        effects = _valid(EffectsKeys, self.data.get("effects"))
        numerics = _valid(NumericsKeys, self.data.get("numerics", {}))
        if tier in TIER_NAMES and effects is not None and numerics is not None:
            has_rib = effects.noun().rib is not None
            found = contradictions(tier, has_rib, numerics.laminae, numerics.steps_per_sample)
            if free.tier:
                found = [f"auto may have to take the tier {tier!r}: {problem}" for problem in found]
            self._complain(("tier",), found)

    def _check_integrator(self, free: Free) -> None:
        numerics = self.data.get("numerics")
        if isinstance(numerics, dict):
            tier, given = self.data.get("tier", "full"), "steps_per_sample" in numerics
            problems = integrator_problems(str(numerics.get("integrator")), tier, given, free.anything)
            self._complain(("numerics", "integrator"), problems)

    def _check_pockets(self) -> None:
        effects, entries = _valid(EffectsKeys, self.data.get("effects")), self.data.get("defects")
        if effects is None or effects.noun().cage is not None or not isinstance(entries, list):
            return
        for index, given in enumerate(entries):
            if isinstance(given, dict) and given.get("kind") == "worn_pocket":
                self._complain(
                    ("defects", index),
                    ["a worn pocket needs the cage, which effects leave out: set effects.cage to true"],
                )


def _with_usual_step(keys: SceneKeys, outside_load: bool) -> SceneKeys:
    """The scene with the step that its tier takes for it."""
    assert isinstance(keys.numerics, NumericsKeys)
    steps = usual_step(keys.noun(""), outside_load).steps_per_sample
    numerics = keys.numerics.model_copy(update={"steps_per_sample": steps})
    return keys.model_copy(update={"numerics": numerics})


def _valid(keys: type[Keys], data: Any) -> Keys | None:
    try:
        return TypeAdapter(keys).validate_python(data)
    except ValidationError:
        return None
