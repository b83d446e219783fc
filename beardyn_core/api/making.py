"""Bearings, lubricants and scenes from names, files, mappings or a few arguments."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from numbers import Real
from pathlib import Path
from typing import Any

from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import file_problems, write_whole
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.choice import scene_from_mapping
from beardyn_core.config.automatic import AUTO, names_a_box, set_rings
from beardyn_core.config.folders import find
from beardyn_core.config.nouns import bearing_from_mapping, load_lubricant, read_noun
from beardyn_core.config.plates import load_plate
from beardyn_core.config.yaml_text import read_file, scene_text, write_mapping
from beardyn_core.effects import EffectSet, RingStructure
from beardyn_core.scene.scene import EFFECTS, Scene

USUAL_BEARING, USUAL_LUBRICANT = "HS130x230", "L055"
_ENDINGS = (".yaml", ".yml")
USUAL_LOAD_KN, USUAL_SPEED_RPM = 80.0, 1000.0
_NO_PATCH = ("diameter", "field_spall", "worn_pocket")  # kinds of faults without a depth of their own


def bearing(
    source: str | Path | RollerBearing | None = None, /, *, rollers: int | None = None, **keys: Any
) -> Any:
    """Give a shipped bearing, one of a file, or one made in code, with changes.

    Parameters
    ----------
    source : str, Path or bearing, optional
        Shipped bearing, YAML file, or a bearing. Without it a tapered bearing is made of ``rollers``,
        ``pitch_diameter_mm``, ``roller_diameter_mm``, ``roller_length_mm`` and ``contact_angle_deg``; every
        other number is derived from them as docs/python.md lists, and marked so in ``bearing.sources``. In a
        YAML file ``derive: true`` does the same.
    rollers : int, optional
        Per row.
    **keys
        Keys of a bearing file in its units, in place of what the file or the derivation gives:
        ``end_play_mm=0.1``, ``name="mine"``.

    Returns
    -------
    Bearing, CylindricalBearing or SphericalBearing
        By the key ``kind`` of its file: ``tapered`` where there is none.

    Raises
    ------
    InputError
        With every mistake and contradiction.

    Examples
    --------
    >>> bearing("HS130x230", end_play_mm=0.1).end_play
    0.0001
    """
    if rollers is not None:
        keys = {"roller_count": rollers, **keys}
    keys = _plain(keys)
    if isinstance(source, RollerBearing):
        made = bearing_from_mapping({**write_noun(source), **keys}, f"bearing {source.name}")
        kept = ((key, text) for key, text in made.sources if getattr(made, key, 0) == getattr(source, key, 0))
        return replace(made, sources=tuple(kept))  # a changed number is not of its source any more
    if source is not None:
        path = find("bearings", str(source))
        return bearing_from_mapping({**read_file(path), **keys}, str(path))
    if set(keys) == {"name"}:
        given = repr(keys["name"])
        raise InputError(
            f"name is {given}, and no number is given; the bearing of this name is bearing({given})"
        )
    derive = {"derive": True} if keys.get("kind", Bearing.kind) == Bearing.kind else {}
    return bearing_from_mapping({**derive, **keys}, "bearing made in code")


def save(noun: RollerBearing | NamePlate | Lubricant | Scene, path: str | Path, force: bool = False) -> Path:
    """Write a bearing, bearing data, a lubricant or a scene to a YAML file, which loads again as the same.

    Parameters
    ----------
    noun : bearing, NamePlate, Lubricant or Scene
        Every number is written in the units of the file, with its source where it has one. The file of a
        scene holds all that the scene refers to.
    path : str or Path
        Ending in ``.yaml`` or ``.yml``.
    force : bool
        Replace the file when it exists; default refuse.

    Returns
    -------
    Path
        Of the file; `bearing`, `name_plate`, `lubricant` and `scene` take it, and so do scenes and commands.

    Raises
    ------
    InputError
        It is none of the nouns above; the file exists, has another ending or cannot be written.

    Examples
    --------
    >>> mine = bearing("HS130x230", end_play_mm=0.1)
    >>> bearing(save(mine, "mine.yaml")) == mine
    True
    """
    file = Path(path)
    problems = [*_unsaved(noun), *file_problems("path", file, force=force)]
    if file.suffix.lower() not in _ENDINGS:
        problems.append(f"path {file}: ends in {file.suffix or 'nothing'}; allowed are {', '.join(_ENDINGS)}")
    if problems:
        raise InputError(problems)
    text = scene_text(noun) if isinstance(noun, Scene) else write_mapping(write_noun(noun))
    write_whole(file, text, replace=force)
    return file


def _unsaved(noun: Any) -> list[str]:
    """State why a noun is not saved, and what is meant instead."""
    if isinstance(noun, RollerBearing | Lubricant | NamePlate | Scene):
        return []
    from beardyn_core.record.run import Run

    found = f"noun is a {type(noun).__name__}"
    if isinstance(noun, str | Path):
        found = (
            f"noun is the name {str(noun)!r}; `beardyn new` copies a shipped file, and bd.bearing(name), "
            "bd.lubricant(name) or bd.scene(name) gives what can be saved"
        )
    elif isinstance(noun, Run):
        found += "; its bearing is run.bearing, its scene the YAML text run.scene_text"
    return [f"{found}; save takes a bearing, bearing data, a lubricant or a scene"]


def name_plate(source: str | Path | None = None, /, **keys: Any) -> NamePlate:
    """Give bearing data of the catalogue, of a file, of a bearing, or made in code.

    Parameters
    ----------
    source : str or Path, optional
        Designation in the catalogue, shipped bearing, or YAML file.
    **keys
        Inner dimensions ``roller_count``, ``roller_diameter_mm``, ``pitch_diameter_mm``,
        ``contact_angle_deg`` (default 0), or maker's factors ``bpfo``, ``bpfi``, ``bsf``, ``ftf``, or both,
        in place of what the source gives. What is not given and does not follow is NaN in ``frequencies``.

    Raises
    ------
    InputError
        With every mistake.

    Examples
    --------
    >>> round(name_plate("6205-2RS JEM").frequencies.bpfo, 4)
    3.5848
    >>> name_plate(bpfo=8.24, bpfi=10.76).roller_count
    19
    """
    known = {} if source is None else write_noun(load_plate(source))
    known.pop("sources", None)
    made: NamePlate = read_noun(NamePlate, {**known, **_plain(keys)}, "bearing data")
    return made


def lubricant(name: str | Path) -> Lubricant:
    """Give a shipped lubricant or one of a YAML file.

    Raises
    ------
    InputError
        With every mistake.
    """
    return load_lubricant(name)


def scene(
    source: str | Path | Mapping[str, Any] | Scene | None = None,
    *,
    bearing: str | RollerBearing | Mapping[str, Any] | None = None,
    lubricant: str | Lubricant | Mapping[str, Any] | None = None,
    load_kN: float | Sequence[float] | None = None,
    speed_rpm: float | None = None,
    speed_kmh: float | None = None,
    faults: Sequence[Mapping[str, Any]] | None = None,
    tier: str | None = None,
    effects: str | Mapping[str, Any] | EffectSet | None = None,
    duration: float | None = None,
    laminae: int | None = None,
    seed: int | None = None,
    rings: str | None = None,
    **keys: Any,
) -> Scene:
    """Give a shipped scene, one of a file or of a mapping, or one made in code, with changes.

    Parameters
    ----------
    source : str, Path, mapping or Scene, optional
        Name of a shipped scene, YAML file, mapping with the keys of a scene file, or a scene; what was chosen
        automatically for that is chosen anew for the changed one. Without it
        the scene has the bearing HS130x230, the grease L055, 80 kN upwards on the journal and 1000 rpm.
    bearing, lubricant : optional
        Name, file, keys of such a file, or what `bearing` and `lubricant` give.
    load_kN : float or 3 floats, optional
        Constant load on the journal, upwards or along x, y, z; it replaces the scene's operation.
    speed_rpm : float, optional
        Constant speed of the shaft; it replaces the scene's operation.
    speed_kmh : float, optional
        Constant speed of a scene that runs on a track.
    faults : sequence of mappings, optional
        Defects in place of the scene's, with the keys of a scene file; ``row`` is 0 and ``depth_um`` 100
        where they are not given: ``[{"on": "cup", "width_mm": 6}]``. An empty sequence: none.
    tier, effects, duration, laminae, seed : optional
        See `beardyn_core.simulate`; effects are those that 5 % of accuracy need when nothing names any.
    rings : str, optional
        ``elastic`` or ``rigid``, as of `equilibrium`: the effect ``structure`` on or off, whatever else the
        effects are; default that of the effects.
    **keys
        Other keys of a scene file in their units: ``end_play_mm=0.05``, ``temperature_C=40``.

    Returns
    -------
    Scene

    Raises
    ------
    InputError
        With every mistake.
    """
    data, label, folder = _mapping_of(source)
    if isinstance(source, Scene) and effects is None:
        data |= _left_open(source)
    changes: dict[str, Any] = {
        "bearing": write_noun(bearing) if isinstance(bearing, RollerBearing) else bearing,
        "lubricant": write_noun(lubricant) if isinstance(lubricant, Lubricant) else lubricant,
        "tier": tier,
        "effects": None if isinstance(effects, EffectSet) else effects,
        "duration_s": duration,
        "seed": seed,
        "defects": None if faults is None else _faults(faults),
        **keys,
    }
    data |= {key: _plain(value) for key, value in changes.items() if value is not None}
    if rings is not None:
        written = set_rings(data.get("effects"), rings)
        if isinstance(effects, EffectSet):
            bending = None if rings == "rigid" else effects.structure or RingStructure()
            effects = replace(effects, structure=bending)
        else:
            data["effects"] = written
    _set_operation(data, load_kN, speed_rpm, speed_kmh)
    numerics = data.get("numerics", {})
    if isinstance(numerics, Mapping):
        numerics = dict(numerics)
        if tier is not None and isinstance(source, Scene):
            numerics.pop("steps_per_sample", None)  # that of the new tier
        if laminae is not None:
            numerics["laminae"] = laminae
        if numerics:
            data["numerics"] = numerics
    made = scene_from_mapping(data, label, folder)
    return replace(made, effects=effects) if isinstance(effects, EffectSet) else made


def _mapping_of(source: str | Path | Mapping[str, Any] | Scene | None) -> tuple[dict[str, Any], str, Path]:
    """Give the keys of a scene, what to call it in messages, and the folder its files lie in."""
    if isinstance(source, Scene):
        return write_noun(source), f"scene {source.name}", Path()
    if isinstance(source, Mapping):
        return dict(source), "scene", Path()
    if source is not None:
        path = find("scenes", str(source))
        return read_file(path), str(path), path.parent
    usual = {"scene": "scene", "bearing": USUAL_BEARING, "lubricant": USUAL_LUBRICANT}
    return {**usual, "operation": _usual_operation()}, "scene made in code", Path()


def _left_open(scene: Scene) -> dict[str, Any]:
    """Write the keys that open again what was chosen for a scene; none where that has been changed."""
    opened = scene.left_open
    if opened is None or not opened.still(scene):
        return {}
    free, had = opened.free, write_noun(opened.effects)
    kept = {name: had.get(name, False) for name in EFFECTS if name not in free.effects}
    box = {"structure": had["structure"]} if names_a_box(had) else {}
    numerics = write_noun(scene.numerics)
    numerics |= {"laminae": AUTO} if free.laminae else {}
    numerics |= {"steps_per_sample": AUTO} if free.steps else {}
    found: dict[str, Any] = {
        "effects": {"preset": AUTO, **kept, **box},
        "numerics": numerics,
        "tier": AUTO if free.tier else scene.tier,
    }
    if opened.rate_still(scene):
        sensors = [write_noun(sensor) for sensor in scene.sensors]
        found["sensors"] = [
            {key: value for key, value in each.items() if key != "rate_kHz"} for each in sensors
        ]
    return found


def _usual_operation() -> dict[str, Any]:
    return {"kind": "constant", "force_kN": [0.0, 0.0, USUAL_LOAD_KN], "speed_rpm": USUAL_SPEED_RPM}


def _set_operation(
    data: dict[str, Any],
    load_kN: float | Sequence[float] | None,
    speed_rpm: float | None,
    speed_kmh: float | None,
) -> None:
    """Change load and speed of a scene's keys."""
    found = data.get("operation")
    operation = dict(found) if isinstance(found, Mapping) else {}
    if load_kN is not None or speed_rpm is not None:
        if speed_kmh is not None:
            raise InputError("speed_kmh is given with load_kN or speed_rpm; a constant load has speed_rpm")
        if operation.get("kind") != "constant":
            operation = _usual_operation()
        if load_kN is not None:
            force = _plain(load_kN)
            operation["force_kN"] = [0.0, 0.0, force] if isinstance(load_kN, Real) else force
        if speed_rpm is not None:
            operation["speed_rpm"] = _plain(speed_rpm)
        data["operation"] = operation
    elif speed_kmh is not None:
        if operation.get("kind") != "quarter_vehicle":
            raise InputError(
                f"speed_kmh is {speed_kmh}; this scene does not run on a track, give speed_rpm instead"
            )
        operation["speed_profile"] = [{"time_s": 0, "speed_kmh": _plain(speed_kmh)}]
        data["operation"] = operation


def _faults(given: Any) -> list[dict[str, Any]]:
    """Complete the keys of every fault."""
    several = list(given) if isinstance(given, Iterable) and not isinstance(given, str | Mapping) else [given]
    if isinstance(given, str | Mapping) or not all(isinstance(each, Mapping) for each in several):
        raise InputError(
            f"faults is {given!r}; it must be a list of mappings: "
            'faults=[{"on": "cup", "width_mm": 6}], or [] for none'
        )
    # row 0, and 100 um deep when it is a patch
    return [
        {"row": 0, **({"depth_um": 100.0} if each.get("kind", "spall") not in _NO_PATCH else {}), **each}
        for each in several
    ]


def _plain(value: Any) -> Any:
    """Turn NumPy numbers and arrays, also inside lists and mappings, into those of Python."""
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    return value.tolist() if hasattr(value, "tolist") else value
