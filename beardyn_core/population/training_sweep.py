"""The runs that an estimator learns from: the sweep of a vehicle class, fitted to a bearing."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from math import dist, log
from pathlib import Path
from typing import Annotated as A
from typing import Any

from beardyn_core.base.edge import Vector, write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.life import dynamic_rating
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config import load_any_bearing, load_box, read_scene, read_sweep
from beardyn_core.config.folders import find, shipped_names
from beardyn_core.config.yaml_text import read_file
from beardyn_core.effects import ModalStructure
from beardyn_core.population.sweep_scenes import open_base
from beardyn_core.structure.box import Box
from beardyn_core.structure.fitting import fit_box
from beardyn_core.structure.mounted_box import modes_of_effects

ENDING = "_axlebox"  # of the names of shipped sweeps that estimators learn from, one a vehicle class
LEARNT, TRUER = "learnt", "full"  # runs that teach, in the tier of the sweep; runs of the tier that is true
PARTS = (LEARNT, TRUER)
MOST = {LEARNT: 300, TRUER: 100}
"""Runs of each part, fewer where the sweep has fewer: with them estimators take 30 to 90 min of one core."""
# processor time of a run of 1.5 to 2.5 s with 12 laminae, and of the choice of effects of a part, [s]
_SECONDS = {
    Bearing.kind: {LEARNT: 3.5, TRUER: 6.0},
    CylindricalBearing.kind: {LEARNT: 5.5, TRUER: 11.0},
    SphericalBearing.kind: {LEARNT: 3.0, TRUER: 9.0},
}
_CHOICE_S = {Bearing.kind: 100.0, CylindricalBearing.kind: 450.0, SphericalBearing.kind: 130.0}
_SPLIT = {"train": 0.7, "validation": 0.3, "test": 0.0}  # runs of the true tier judge
_LOADS = ("operation.vehicle.body_mass_t", "operation.payload_t", "operation.lateral_force_kN")
_WIDTH, _LENGTH = "defects[0].width_mm", "defects[0].length_mm"
_END_PLAY, _CLEARANCE = "end_play_mm", "radial_clearance_mm"
_OF_BOX = ("effects.", "sensors[")  # beginnings of keys that a calibrated scene has its own values of
# what a calibration leaves open of them: stiffness and damping as factors, end play, [mm]
_STIFFNESS, _DAMPING, _PLAY = 0.02, 1.6, 0.03
_TABLE, _TYPE = "effects.structure.table", "sensors[0].type"
_DIGITS = 4
_DIGEST = 16  # letters


@dataclass(frozen=True)
class TrainingSweep:
    """Sweeps of one bearing: one that teaches, one of the true tier."""

    bearing: RollerBearing
    like: A[str, "shipped sweep or file that they are like"]
    keys: A[dict[str, Any], "of the sweep that teaches, as of its file"]
    box: A[Box | None, "whose modes are to be computed, fitted to the bearing; none where its own is shipped"]
    scene: A[str, "text of the scene of one axlebox; empty of a vehicle class"] = ""

    @property
    def digest(self) -> str:
        """What an estimator of it depends on, but for the code."""
        keys = json.dumps([self.keys, self.scene], sort_keys=True, default=str)
        return hashlib.sha256(keys.encode()).hexdigest()[:_DIGEST]

    def of_part(self, part: str, table: Path | None = None) -> dict[str, Any]:
        """Give the keys of the sweep of a part.

        Parameters
        ----------
        part : str
            `LEARNT` or `TRUER`: no bearing is in both.
        table : Path, optional
            Modes of `box`.
        """
        keys = {**self.keys, "set": {**self.keys["set"]}, "runs": self.count(part)}
        if table is not None:
            keys["set"][_TABLE] = str(table)
        if part == LEARNT:
            keys["split"] = dict(_SPLIT)
        else:
            keys["set"]["tier"] = TRUER
            keys["sweep"] = f"{keys['sweep']}, {TRUER}"
            keys["seed"] = self.keys.get("seed", 1) + 1
            keys["runs_per_bearing"] = 1
        return keys

    def count(self, part: str) -> int:
        """Tell how many runs a part has."""
        return min(MOST[part], int(self.keys.get("runs", MOST[part])))

    @property
    def seconds(self) -> float:
        """Processor time of all runs and of the choice of their effects, about, [s]."""
        kind = self.bearing.kind
        return sum(self.count(part) * _SECONDS[kind][part] + _CHOICE_S[kind] for part in PARTS)


def compose_sweep(
    bearing: RollerBearing, *, sensor: str = "", like: str = "", scene: str = ""
) -> TrainingSweep:
    """Fit the sweep of a vehicle class to a bearing, or to one axlebox.

    Loads go with the dynamic rating, widths of spalls with the distance of two rollers, their lengths with
    the length of the rollers, the radial clearance with that of the drawing, and sizes of the box with those
    of the cup. The bearing of the sweep itself has what is in the sweep.

    Parameters
    ----------
    bearing : RollerBearing
    sensor : str, optional
        Kind of the accelerometer, shipped or a file; default that of the sweep.
    like : str, optional
        Sweep of a vehicle class and this kind of bearing, shipped or a file; default that whose bearing is
        most like this one.
    scene : str, optional
        Scene of one axlebox, such as a calibration has written: its box and its sensor are varied by as much
        as a calibration leaves open of them.

    Raises
    ------
    InputError
        With every mistake; the sweep is none of an axlebox, of another kind of bearing, or its box cannot be
        fitted.
    """
    like = like or closest_sweep(bearing)
    path = find("sweeps", like)
    keys = read_file(path)
    sweep, label = read_sweep(path)
    model = open_base(sweep, label)[1].scene
    own = model.bearing
    if own.kind != bearing.kind:
        raise InputError(
            f"{label}: is of {own.name}, a {own.words}; {bearing.name} is a {bearing.words}: like must be "
            f"one of {', '.join(sweeps_of(bearing.kind))}, or a file of that kind"
        )
    structure = model.effects.structure
    if not isinstance(structure, ModalStructure):
        raise InputError(f"{label}: its scene {sweep.scene} has no box that rings; an estimator needs one")
    if sweep.scene not in shipped_names("scenes"):
        keys["scene"] = str(find("scenes", sweep.scene, sweep.folder).absolute())
    changes: dict[str, Any] = {**sweep.changes}
    box = None
    if bearing != own:
        keys["sweep"] = f"{keys['sweep']} of {bearing.name}"[:80]
        keys["vary"] = [_fitted(each, bearing, own) for each in keys["vary"]]
        changes["bearing"] = bearing.name if _is_shipped(bearing) else write_noun(bearing)
        modes = modes_of_effects(model.effects)
        assert modes is not None
        if not scene and list(modes.cup.differences(bearing)):
            drawn = load_box(structure.table)
            if not isinstance(drawn, Box):
                raise InputError(
                    f"{label}: its box {structure.table} is not in figures; it fits {own.name} alone"
                )
            box = fit_box(drawn, load_any_bearing(drawn.bearing), bearing)
            for number, each in enumerate(model.sensors):
                changes[f"sensors[{number}].position_mm"] = _seat(each.position, drawn, box)
    if scene:
        changes.pop("bearing", None)
        keys |= _of_axlebox(keys, find("scenes", scene).absolute())
    if sensor:
        kind = find("sensors", sensor)
        changes[_TYPE] = sensor if sensor in shipped_names("sensors") else str(kind.absolute())
    text = find("scenes", scene).read_text(encoding="utf-8") if scene else ""
    return TrainingSweep(bearing, like, {**keys, "set": changes}, box, text)


def _of_axlebox(keys: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """Replace what is drawn of boxes and sensors by what a calibration leaves open of one.

    Raises
    ------
    InputError
        The scene has no box that rings.
    """
    scene = read_scene(path).scene
    structure = scene.effects.structure
    if not isinstance(structure, ModalStructure):
        raise InputError(f"{path}: its axlebox has no modes; estimators need a box that rings")
    factors = {"stiffness_factor": 1.0 + _STIFFNESS, "damping_factor": _DAMPING}
    drawn: list[dict[str, Any]] = [
        _around(f"effects.structure.{name}", getattr(structure, name), factor)
        for name, factor in factors.items()
    ]
    rides = [each for each in keys["vary"] if not each["key"].startswith(_OF_BOX)]
    if any(each["key"] == _END_PLAY for each in rides):  # a radial clearance is not calibrated
        rides = [each for each in rides if each["key"] != _END_PLAY]
        play = float(write_noun(scene)[_END_PLAY])  # as mounted, not when it is warm
        drawn.append({"key": _END_PLAY, "kind": "uniform", "low": play - _PLAY, "high": play + _PLAY})
    name = f"{keys['sweep']} in {scene.name}"[:80]
    return {
        "sweep": name,
        "scene": str(path),
        "vary": [*rides, *({**each, "per": "bearing"} for each in drawn)],
    }


def _around(key: str, middle: float, factor: float) -> dict[str, Any]:
    ends = {"low": round(middle / factor, _DIGITS), "high": round(middle * factor, _DIGITS)}
    return {"key": key, "kind": "log_uniform", **ends}


def closest_sweep(bearing: RollerBearing) -> str:
    """Find the shipped sweep of the kind of a bearing whose own one is most like it.

    Compared are rollers, contact angle and envelope.
    """
    return min(sweeps_of(bearing.kind), key=lambda name: _unlikeness(bearing, bearing_of(name)))


def sweeps_of(kind: str) -> list[str]:
    """List the shipped sweeps of vehicle classes with a kind of bearing."""
    names = (name for name in shipped_names("sweeps") if name.endswith(ENDING))
    return [name for name in names if bearing_of(name).kind == kind]


def bearing_of(name: str) -> RollerBearing:
    """Find the bearing of the scene of a shipped sweep."""
    return load_any_bearing(read_file(find("scenes", read_sweep(name)[0].scene))["bearing"])


def _unlikeness(one: RollerBearing, other: RollerBearing) -> float:
    sizes = ("roller_count", "contact_angle", "outer_diameter", "width")
    pairs = ((getattr(one, name), getattr(other, name)) for name in sizes)
    return sum(log(first / last) ** 2 for first, last in pairs if first != last)  # cylinders have no angle


def _is_shipped(bearing: RollerBearing) -> bool:
    return bearing.name in shipped_names("bearings") and load_any_bearing(bearing.name) == bearing


def _seat(position: Vector, drawn: Box, fitted: Box) -> list[float]:
    """Find where the seat of a sensor is in the fitted box, [mm]."""
    number = min(range(len(drawn.sensors)), key=lambda k: dist(drawn.sensors[k].position, position))
    return [round(1e3 * each, _DIGITS) for each in fitted.sensors[number].position]


def _fitted(entry: Mapping[str, Any], bearing: RollerBearing, own: RollerBearing) -> dict[str, Any]:
    """Scale the ends of what is drawn for one bearing to another."""
    factor = 1.0
    if entry["key"] in _LOADS:
        factor = dynamic_rating(bearing).radial / dynamic_rating(own).radial
    elif entry["key"] == _LENGTH:
        factor = bearing.effective_length / own.effective_length
    elif entry["key"] == _WIDTH:
        spacing, usual = (each.pitch_diameter / each.roller_count for each in (bearing, own))
        factor = spacing / usual
    elif entry["key"] == _CLEARANCE and isinstance(bearing, RadialBearing) and isinstance(own, RadialBearing):
        factor = bearing.radial_clearance / own.radial_clearance
    ends = {name: float(f"{factor * entry[name]:.{_DIGITS}g}") for name in ("low", "high") if name in entry}
    if entry["key"] == _WIDTH:
        ends.pop("low", None)  # the smallest spall is as large in any bearing
    return {**entry, **(ends if factor != 1.0 else {})}
