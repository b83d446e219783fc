"""Files of one noun: a bearing, a lubricant, a vehicle, a box, a sensor, a background, effects, a trial."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

from pydantic import ValidationError

import beardyn_core.config.part_files
import beardyn_core.config.scene_file  # noqa: F401  both say what the files of nouns may have besides
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import note_read
from beardyn_core.bearing.any_bearing import (
    BEARING_OF_KIND,
    AnyBearing,
    require_tapered,
)
from beardyn_core.bearing.consistency import check
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.config.content import located_table, with_table
from beardyn_core.config.folders import find, shipped_names
from beardyn_core.config.keys import keys_of
from beardyn_core.config.problems import Origin, sentences
from beardyn_core.config.yaml_text import read_file
from beardyn_core.effects import EffectSet
from beardyn_core.scene.background import Background
from beardyn_core.scene.operation import Vehicle
from beardyn_core.scene.sensor import SensorType
from beardyn_core.scene.sweep import Sweep
from beardyn_core.scene.trial import Trial
from beardyn_core.structure.box import Box
from beardyn_core.structure.fitting import FittedBox, fit_box
from beardyn_core.structure.imported import ModeFile


def load_bearing(name: str | Path) -> Bearing:
    """Load a shipped tapered bearing or that of a file, for what only tapered ones have.

    Raises
    ------
    InputError
        With every mistake and contradiction, or for a bearing of another kind with what that one can do.
    """
    return require_tapered(load_any_bearing(name), "contact searches")


def load_any_bearing(name: str | Path) -> AnyBearing:
    """Load a shipped bearing of any kind or that of a file; raises `InputError` with every mistake."""
    path = find("bearings", str(name))
    return bearing_from_mapping(read_file(path), str(path))


def bearing_from_mapping(data: dict[str, Any], label: str) -> AnyBearing:
    """Make a bearing of the mapping in its file, tapered where it names no kind; see `load_any_bearing`."""
    kind = data.get("kind", Bearing.kind)
    if not isinstance(kind, str) or kind not in BEARING_OF_KIND:
        raise InputError(f"{label}: kind is {kind!r}; allowed are {', '.join(BEARING_OF_KIND)}")
    refused = []
    if kind == Bearing.kind:
        data = {key: value for key, value in data.items() if key != "kind"}
    elif "derive" in data:
        data = {key: value for key, value in data.items() if key != "derive"}
        words = BEARING_OF_KIND[kind].words
        refused = [
            f"{label}: derive is for tapered roller bearings; the file of a {words} gives every number, see "
            f"`beardyn schema {kind}_bearing`"
        ]
    try:
        bearing: AnyBearing = read_noun(BEARING_OF_KIND[kind], data, label)
    except InputError as error:
        several = sum(" is missing;" in problem for problem in error.problems) > 1
        if kind == Bearing.kind and several and "derive" not in data:
            hint = f"{label}: `derive: true` derives what is missing from five numbers; see bearing_data.md"
            raise InputError([*error.problems, hint]) from None
        raise InputError([*refused, *error.problems]) from None
    if problems := [*refused, *(f"{label}: {problem.removesuffix('.')}" for problem in check(bearing))]:
        raise InputError(problems)
    return bearing


def load_lubricant(name: str | Path) -> Lubricant:
    """Load a shipped lubricant or that of a file; raises `InputError` with every mistake."""
    return _load(Lubricant, find("lubricants", str(name)))


def load_vehicle(name: str | Path) -> Vehicle:
    """Load a shipped vehicle or that of a file; raises `InputError` with every mistake."""
    return _load(Vehicle, find("vehicles", str(name)))


def load_box(name: str | Path) -> Box | ModeFile:
    """Load a shipped axlebox or that of a file: in figures, like another one, or as modes of another program.

    Raises
    ------
    InputError
        With every mistake.
    """
    path = find("structures", str(name))
    data = read_file(path)
    noun = ModeFile if "modes" in data else FittedBox if "like" in data else Box
    if "bearing" not in data:
        raise InputError(
            f"{path}: bearing is missing; files of earlier versions lack it: add the one whose cup is in the "
            "box, such as `bearing: HS130x230`"
        )
    box: Box | ModeFile | FittedBox = read_noun(noun, data, str(path))
    if isinstance(box, ModeFile):
        grid = None if box.grid is None else path.parent / box.grid
        box = replace(box, modes=path.parent / box.modes, grid=grid)
        for each in (box.modes, *([grid] if grid else ())):
            note_read(each)
    if box.bearing not in shipped_names("bearings"):
        box = replace(box, bearing=str(find("bearings", box.bearing, path.parent)))
    return _fitted_box(box, path) if isinstance(box, FittedBox) else box


def box_for(box: Box, bearing: str | Path, name: str | None = None) -> Box:
    """Fit a box in figures to another bearing, sizes in proportion; raises `InputError` with every mistake.

    Parameters
    ----------
    bearing : str or Path
        Shipped bearing or path of its file.
    name : str, optional
        Of the box; that of the other one and of the bearing when left out.
    """
    carried = load_any_bearing(bearing)
    fitted = fit_box(box, load_any_bearing(box.bearing), carried)
    return replace(fitted, name=name or f"{box.name}_{carried.name}", bearing=str(bearing))


def _fitted_box(fitted: FittedBox, path: Path) -> Box:
    like = find("structures", fitted.like, path.parent)
    data = read_file(like)
    if other := next((key for key in ("modes", "like") if key in data), None):
        raise InputError(
            f"{path}: like is {fitted.like!r}, whose file has the key {other}; it must be a box in figures, "
            "with outer_diameter_mm and length_mm"
        )
    box = load_box(like)
    assert isinstance(box, Box)
    made = box_for(box, fitted.bearing, fitted.name)
    return replace(made, description=fitted.description or box.description)


def load_sensor(name: str | Path) -> SensorType:
    """Load a shipped kind of sensor or that of a file; raises `InputError` with every mistake."""
    return _load(SensorType, find("sensors", str(name)))


def load_background(name: str | Path) -> Background:
    """Load a shipped background or that of a file; raises `InputError` with every mistake."""
    return _load(Background, find("backgrounds", str(name)))


def load_effects(name: str | Path) -> EffectSet:
    """Load the effects of a shipped preset or of a file; raises `InputError` with every mistake."""
    path = find("effects", str(name))
    effects: EffectSet = read_noun(EffectSet, located_table(read_file(path), path.parent), str(path))
    return with_table(effects)


def read_trial(
    name: str | Path, *, tier: str | None = None, seed: int | None = None, effects: str | None = None
) -> tuple[Trial, Path]:
    """Read the trial of a shipped name or of a file, its sizes in order, and find its path.

    Parameters
    ----------
    tier, seed, effects : optional
        Instead of the file's; with another tier the check falls away where it is the same one.

    Raises
    ------
    InputError
        With every mistake in the file.
    """
    path = find("trials", str(name))
    data = read_file(path)
    if tier is not None:
        data["tier"] = tier
        if isinstance(data.get("check"), dict) and data["check"].get("tier") == tier:
            del data["check"]
    if seed is not None:
        data["seed"] = seed
    if effects is not None:
        data["effects"] = effects
    trial: Trial = read_noun(Trial, data, str(path))
    return replace(trial, folder=path.parent, sizes=tuple(sorted(trial.sizes))), path


def read_sweep(name: str | Path | dict[str, Any], **changes: Any) -> tuple[Sweep, str]:
    """Read the sweep of a shipped name, a file or a mapping, and find what to call it in messages.

    Parameters
    ----------
    name : str, Path or dict
    **changes
        Keys in place of the file's, such as ``runs`` and ``seed``; ``None``: the file's own.

    Raises
    ------
    InputError
        With every mistake in the file.
    """
    path = None if isinstance(name, dict) else find("sweeps", str(name))
    data = dict(name) if isinstance(name, dict) else read_file(find("sweeps", str(name)))
    data |= {key: value for key, value in changes.items() if value is not None}
    label = "sweep" if path is None else str(path)
    sweep: Sweep = read_noun(Sweep, data, label)
    folder = Path() if path is None else path.parent
    return replace(sweep, folder=folder, changes=dict(sweep.changes or {})), label


def _load(noun: type, path: Path) -> Any:
    return read_noun(noun, read_file(path), str(path))


def read_noun(noun: type, data: dict[str, Any], label: str) -> Any:
    """Read a noun of a type from the mapping of its file.

    Raises
    ------
    InputError
        With every mistake, each with the label of the file.
    """
    try:
        return keys_of(noun).model_validate(data).noun()
    except ValidationError as error:
        raise InputError(sentences(error, [Origin((), label)])) from None
