"""From names and files to frozen nouns: references resolved, every mistake reported at once."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated as A
from typing import Any

from pydantic import ValidationError

from beardyn_core.base.edge import places
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import UNITS, stem_of
from beardyn_core.bearing.any_bearing import (
    BEARING_OF_KIND,
    AnyBearing,
)
from beardyn_core.bearing.consistency import check
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.life import load_doubts
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import FEWEST_OF_ELLIPSE, SphericalBearing
from beardyn_core.config.automatic import AUTO, auto_in_its_box, set_rings, take_auto
from beardyn_core.config.content import located_table, self_contained
from beardyn_core.config.folders import find
from beardyn_core.config.keys import keys_of, valid
from beardyn_core.config.missing import entries_of, missing_problems
from beardyn_core.config.problems import Origin, Place, key_path, locate, sentences
from beardyn_core.config.scene_file import overlay, with_length
from beardyn_core.config.yaml_text import read_file, read_mapping
from beardyn_core.effects import EffectSet
from beardyn_core.rail.irregularity import RAIL_LAYOUT
from beardyn_core.rail.measured import read_measurement
from beardyn_core.rail.spectra import DENSITY_LAYOUT
from beardyn_core.rail.table import read_table
from beardyn_core.rail.transfer_path import path_read
from beardyn_core.scene.defect import Defect
from beardyn_core.scene.excitation import MEASURED, WheelDefect
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.scene import Free, Numerics, Scene
from beardyn_core.scene.tier import TIER_NAMES, contradictions, integrator_problems
from beardyn_core.scene.waviness import Waviness

_SLICES_OF_BARREL = 12  # loads and deflections within 0.4 % of those with 60


@dataclass(frozen=True)
class OpenScene:
    """A scene as its file has it, before `beardyn_core.choice` closes what the file leaves open."""

    scene: A[Scene, "with stand-ins for what is open"]
    free: A[Free, "what the file leaves to be chosen with ``auto``"]
    step_given: A[bool, "whether the file gives the time step"]
    keys: A[dict[str, Any], "of its file, every reference replaced by what it names"]


def read_scene(
    name: str | Path, overrides: dict[Place, Any] | None = None, without: tuple[str, ...] = ()
) -> OpenScene:
    """Read the scene of a shipped name or of a file; what it leaves open with ``auto`` stays open.

    Parameters
    ----------
    name : str or Path
        A shipped scene, or the path of a YAML file.
    overrides : dict, optional
        Place of a key -> value instead of the file's, of the command line.
    without : tuple of str, optional
        Keys to leave out.

    Raises
    ------
    InputError
        With every mistake in the scene and in the files it refers to.
    """
    path = find("scenes", str(name))
    data = {key: value for key, value in read_file(path).items() if key not in without}
    return _Reading(data, str(path), path.parent).scene(overrides or {})


def read_scene_text(text: str, label: str = "scene") -> OpenScene:
    """Read the scene of a YAML text, such as the one recorded with a run; see `read_scene`."""
    return read_scene_mapping(read_mapping(text, label), label, Path())


def read_scene_mapping(
    data: dict[str, Any], label: str, folder: Path, origins: Sequence[Origin] = ()
) -> OpenScene:
    """Read the scene of the mapping in a scene file that lies in a folder; see `read_scene`.

    Parameters
    ----------
    origins : sequence of Origin, optional
        Places whose values stand in another file, for what is said of them.
    """
    reading = _Reading(data, label, folder)
    reading.origins += origins
    return reading.scene({})


class _Reading:
    """One scene being read: the resolved mapping, where its parts came from, the mistakes so far."""

    def __init__(self, data: dict[str, Any], label: str, folder: Path) -> None:
        self.data = dict(data)
        self.folder = folder
        self.origins = [Origin((), label)]
        self.problems: list[str] = []

    def scene(self, overrides: dict[Place, Any]) -> OpenScene:
        """Resolve the references, read the scene and find every mistake."""
        for place, value in overrides.items():
            self._override(place, value)
        self._inline(self.data, "bearing", "bearings", ())
        self._require_kind()
        self._inline(self.data, "lubricant", "lubricants", ())
        self._inline(self.data, "background", "backgrounds", ())
        free = take_auto(self.data)
        self._slice_barrels()
        self._inline_effects()
        self._inline_sensors()
        operation = self.data.get("operation")
        if isinstance(operation, dict):
            operation = self.data["operation"] = dict(operation)
            self._inline(operation, "vehicle", "vehicles", ("operation",))
            self._locate_files(operation)
        scene: Scene | None = None
        try:
            scene = keys_of(Scene).model_validate(self.data).noun()
        except ValidationError as error:
            self.problems += sentences(error, self.origins)
        self._check_contradictions(free)
        self._check_integrator(free)
        if self.problems or scene is None:
            raise InputError(list(dict.fromkeys(self.problems)))
        given = "steps_per_sample" in self.data.get("numerics", {})
        return OpenScene(self_contained(scene), free, given, self.data)

    def _slice_barrels(self) -> None:
        """Write down how many slices barrels have where the scene does not."""
        numerics = self.data.get("numerics", {})
        if self._kind == SphericalBearing.kind and isinstance(numerics, dict) and "laminae" not in numerics:
            self.data["numerics"] = {**numerics, "laminae": _SLICES_OF_BARREL}

    @property
    def _kind(self) -> str:
        bearing = self.data.get("bearing")
        return str(bearing.get("kind", Bearing.kind)) if isinstance(bearing, dict) else Bearing.kind

    def _require_kind(self) -> None:
        """Refuse a bearing of a kind that there is not at once: no other key of the scene is about it."""
        bearing = self.data.get("bearing")
        if not isinstance(bearing, dict) or "kind" not in bearing:
            return
        if not isinstance(bearing["kind"], str) or bearing["kind"] not in BEARING_OF_KIND:
            allowed = ", ".join(BEARING_OF_KIND)
            where = self.origins[0].label
            raise InputError(f"{where}: bearing.kind is {bearing['kind']!r}; allowed are {allowed}")
        if bearing["kind"] == Bearing.kind:  # its keys have none
            self.data["bearing"] = {key: value for key, value in bearing.items() if key != "kind"}

    def _complain(self, place: Place, problems: list[str]) -> None:
        label, key = locate(place, self.origins)
        where = label if label.startswith("--") else f"{label}: {key}"
        self.problems += [f"{where}: {text}" for text in problems]

    def _override(self, place: Place, value: Any) -> None:
        owner = self.data
        if place == ("rings",):
            owner["effects"] = set_rings(owner.get("effects"), value)
            return
        if place == ("effects",) and value == AUTO:
            value = auto_in_its_box(self._written_effects())
        for key in place[:-1]:
            inner = owner.get(str(key), {})
            if not isinstance(inner, dict):
                return  # a mistake of the scene file, reported later
            copy = dict(inner)
            owner[str(key)] = copy
            owner = copy
        owner[str(place[-1])] = value
        self.origins.append(Origin(place, f"--{stem_of(str(place[-1]))}", place))

    def _written_effects(self) -> Any:
        given = self.data.get("effects")
        if not isinstance(given, str) or given == AUTO:
            return given
        try:
            return read_file(find("effects", given, self.folder))
        except InputError:
            return given  # the mistake is in what is not taken

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
            found = read_file(path)
            owner[key] = located_table(found, path.parent) if kind == "effects" else found
            self.origins.append(Origin(place, str(path)))
        except InputError as error:
            self.problems += error.problems

    def _inline_sensors(self) -> None:
        """Resolve the types of the sensors and read their measured paths for mistakes."""
        sensors = self.data.get("sensors")
        if not isinstance(sensors, list | tuple):
            return
        self.data["sensors"] = [dict(each) if isinstance(each, dict) else each for each in sensors]
        for place, sensor in entries_of(self.data, "sensors"):
            self._inline(sensor, "type", "sensors", place)
            paths = sensor.get("measured_paths")
            if isinstance(paths, list | tuple):
                sensor["measured_paths"] = [dict(each) if isinstance(each, dict) else each for each in paths]
                for _, path in entries_of(sensor, "measured_paths"):
                    self._locate(path, "path", partial(path_read, path.get("content")))

    def _inline_effects(self) -> None:
        given = self.data["effects"] = located_table(self.data["effects"], self.folder)
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
        # what a recording has may name the file of another machine
        located_path = Path(path) if owner.get("content") else (self.folder / path).resolve()
        owner[key] = str(located_path)
        try:
            read(located_path)
        except InputError as error:
            self.problems += error.problems

    def _check_contradictions(self, free: Free) -> None:
        """Find what is well written and cannot be; parts with other mistakes are left out."""
        self._check_tier(free)
        self._check_pockets()
        self._check_wheel()
        bearing = valid(AnyBearing, self.data.get("bearing"))
        if bearing is None:
            return
        label, _ = locate(("bearing",), self.origins)
        problems = check(bearing)
        self.problems += [f"{label}: {problem.removesuffix('.')}" for problem in problems]
        self._check_forces(bearing)
        faults: tuple[tuple[str, Any], ...] = (("defects", Defect), ("waviness", Waviness))
        for key, hint in faults:
            for place, given in [] if problems else entries_of(self.data, key):
                if fault := valid(hint, given):
                    for problem in with_length(fault, bearing.effective_length).contradictions(bearing):
                        self.problems.append(f"{self.origins[0].label}: {key_path(place)}.{problem}")
        scatter = None if problems else valid(Scatter, self.data.get("scatter"))
        if scatter is not None:
            self._complain(("scatter",), list(scatter.contradictions(bearing)))
        for place, problem in missing_problems(self.data, bearing):
            self._complain(place, [problem])

    def _check_forces(self, bearing: RollerBearing) -> None:
        """Refuse forces that no bearing of this size can be meant to carry."""
        operation = self.data.get("operation")
        if not isinstance(operation, dict):
            return
        for place, owner in [((), operation), *entries_of(operation, "steps")]:
            force = owner.get("force_kN")
            if not isinstance(force, list) or not all(_is_number(each) for each in force):
                continue
            problem, _ = load_doubts(bearing, [UNITS["kN"].to_si(float(each)) for each in force])
            if problem:
                self._complain(("operation", *place, "force_kN"), [problem])

    def _check_wheel(self) -> None:
        operation = self.data.get("operation")
        if not isinstance(operation, dict):
            return
        place = next(each for each in places(QuarterVehicleOperation) if each.field == "wheel_diameter")
        given = operation.get(place.key, place.at.scale.to_edge(place.default))
        if not isinstance(given, int | float) or not place.at.limits["ge"] <= given <= place.at.limits["le"]:
            return
        for where_in, written in entries_of(operation, "wheel_defects"):
            if defect := valid(WheelDefect, written):
                for problem in defect.contradictions(0.5 * place.at.scale.to_si(float(given))):
                    where = key_path(("operation", *where_in))
                    self.problems.append(f"{self.origins[0].label}: {where}.{problem}")

    def _check_tier(self, free: Free) -> None:
        tier = self.data.get("tier", "full")
        effects = valid(EffectSet, self.data.get("effects"))
        numerics = valid(Numerics, self.data.get("numerics", {}))
        if tier in TIER_NAMES and effects is not None and numerics is not None:
            barrels = self._kind == SphericalBearing.kind
            has_rib = effects.rib is not None or barrels  # which are held by their raceways
            bends = "" if effects.structure is None else effects.structure.kind
            unaudited = bool(effects.thermal) and effects.audit is None and "audit" not in free.effects
            steps = numerics.steps_per_sample
            found = contradictions(tier, has_rib, numerics.laminae, steps, bends, unaudited)
            if barrels and numerics.laminae < FEWEST_OF_ELLIPSE:
                found.append(
                    f"a spherical roller bearing needs numerics.laminae of at least {FEWEST_OF_ELLIPSE}, not "
                    f"{numerics.laminae}: its contact ellipses are made of them"
                )
            if "structure" in free.effects:
                hint = "; effects that nobody names are chosen: name some without structure, such as dry"
                found = [f"{each}{hint}" if "structure" in each else each for each in found]
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
        effects = valid(EffectSet, self.data.get("effects"))
        if effects is None or effects.cage is not None:
            return
        needed = "a worn pocket needs the cage, which effects leave out: set effects.cage to true"
        for place, given in entries_of(self.data, "defects"):
            if given.get("kind") == "worn_pocket":
                self._complain(place, [needed])


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
