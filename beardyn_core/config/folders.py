"""How the name of a thing in the configuration becomes a file."""

from __future__ import annotations

import os
from pathlib import Path

from beardyn_core.base.config_folder import config_folder
from beardyn_core.base.errors import InputError
from beardyn_core.base.spelling import closest

KINDS = (
    "bearings",
    "lubricants",
    "vehicles",
    "effects",
    "scenes",
    "trials",
    "sweeps",
    "structures",
    "sensors",
    "backgrounds",
)
_SUFFIXES = (".yaml", ".yml")
_CALLED = {"effects": "effects preset", "plates": "bearing data"}  # one of a kind, in messages
_AUTO = "auto"  # in place of a set of effects
_FORMER = {("effects", "full"): "all"}  # older names, in scenes and recordings that are kept


def shipped_names(kind: str) -> tuple[str, ...]:
    """List the names of what is shipped of one of `KINDS`, sorted."""
    folder = config_folder() / kind
    return tuple(sorted(path.stem for path in folder.glob("*") if path.suffix in _SUFFIXES))


def find(kind: str, name: str, beside: Path | None = None) -> Path:
    """Find the file of a named thing.

    A name with a slash or a ``.yaml`` ending is a path, relative to ``beside`` first and to the working
    folder second; any other name is a shipped one.

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    beside : Path, optional
        Folder of the file that mentions the name.

    Raises
    ------
    InputError
        With the places searched or the names there are.
    """
    singular = _CALLED.get(kind, kind[:-1])
    if "/" in name or os.sep in name or Path(name).suffix in _SUFFIXES:
        places = [Path(name)] if beside is None else [beside / name, Path(name)]
        for path in dict.fromkeys(places):
            if path.is_file():
                return path
        if folders := [path for path in dict.fromkeys(places) if path.is_dir()]:
            raise InputError(
                f"{folders[0]}: is a folder; give the path of a {singular} file, ending in .yaml"
            )
        searched = " and ".join(str(path.absolute()) for path in dict.fromkeys(places))
        raise InputError(f"the {singular} file {name!r} was not found; searched {searched}")
    folder = config_folder() / kind
    for called in (name, _FORMER.get((kind, name), name)):
        for suffix in _SUFFIXES:
            if (path := folder / f"{called}{suffix}").is_file():
                return path
    if Path(name).is_dir():
        raise InputError(f"{name}: is a folder; give the path of a {singular} file, ending in .yaml")
    names = shipped_names(kind)
    chosen = kind == "effects" and name != _AUTO
    guess = closest(name, (*names, _AUTO) if chosen else names)
    hint = f"did you mean {guess}? " if guess else ""
    raise InputError(
        f"there is no {singular} {name!r} in {folder}; {hint}shipped are {', '.join(names) or 'none'}; "
        f"{f'{_AUTO} chooses them; ' if chosen else ''}a file of your own is given by its path, ending in "
        ".yaml"
    )
