"""Key paths of a scene, ``defects[0].width_mm``: read, and a value set at one."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.config.automatic import AUTO
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file

Place = tuple[str | int, ...]

_WORD = r"[A-Za-z_][\w]*"
_PATH = re.compile(rf"{_WORD}(?:\[\d+\])*(?:\.{_WORD}(?:\[\d+\])*)*")
_PART = re.compile(rf"({_WORD})|\[(\d+)\]")
# keys that may hold the name of a file in place of what is in it, and the kind of that file
_NAMED = {
    "bearing": "bearings",
    "lubricant": "lubricants",
    "background": "backgrounds",
    "vehicle": "vehicles",
    "type": "sensors",
}


class AbsentError(Exception):
    """A list has no such entry in this run, so that nothing can be set in it."""


def place_of(path: str) -> Place:
    """Read a key path.

    Raises
    ------
    InputError
        It is none.
    """
    if not is_place(path):
        raise InputError(f"{path!r} is no key path; write it as in `operation.speed_profile[0].speed_kmh`")
    return tuple(word or int(number) for word, number in _PART.findall(path))


def is_place(path: str) -> bool:
    """Tell whether a text is a key path."""
    return _PATH.fullmatch(path) is not None


def with_value(data: dict[str, Any], place: Place, value: Any, folder: Path) -> dict[str, Any]:
    """Set the value at a place of a scene's mapping; what is not changed is shared with the one before.

    Mappings on the way are made where the scene has none; a name of a file gives way to what is in it.

    Raises
    ------
    AbsentError
        A list on the way is too short.
    InputError
        There is something on the way that has no keys or no entries.
    """
    return _set(data, place, 0, value, folder)


def _set(owner: Any, place: Place, depth: int, value: Any, folder: Path) -> Any:
    if depth == len(place):
        return value
    part = place[depth]
    if isinstance(part, int):
        if owner is None or (isinstance(owner, list | tuple) and part >= len(owner)):
            raise AbsentError
        if not isinstance(owner, list | tuple):
            raise InputError(f"{_text(place[:depth])} is no list")
        entries = list(owner)
        entries[part] = _set(entries[part], place, depth + 1, value, folder)
        return entries
    if isinstance(owner, str) and depth:
        owner = _open_named_file(place[:depth], owner, folder)
    if owner is None or isinstance(owner, bool):
        owner = {}
    if not isinstance(owner, dict):
        raise InputError(f"{_text(place[:depth])} has no keys: it is {owner!r}")
    changed = {**owner, part: _set(owner.get(part), place, depth + 1, value, folder)}
    if part == "table":  # what was read from the table before
        changed.pop("content", None)
    return changed


def _open_named_file(place: Place, name: str, folder: Path) -> dict[str, Any]:
    """Read the file that is named at a place."""
    key = place[-1]
    if key == "effects":
        return {"preset": name}
    if key == "numerics" and name == AUTO:
        return dict.fromkeys(("laminae", "steps_per_sample"), AUTO)
    if key not in _NAMED:
        raise InputError(f"{_text(place)} is {name!r}; it has no keys")
    return read_file(find(_NAMED[str(key)], name, folder))


def _text(place: Place) -> str:
    from beardyn_core.config.problems import key_path

    return key_path(place)
