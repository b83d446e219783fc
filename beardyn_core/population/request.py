"""What a user asks for: the scenes of a sweep file, or every mistake in it, in its scene and in its runs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.config import read_sweep
from beardyn_core.config.folders import find
from beardyn_core.config.yaml_text import read_file
from beardyn_core.population.sweep_scenes import SweepScenes, mistakes_of, scenes_of

_EVEN = (
    "sampling sobol fills all keys evenly, but few runs of it have keys that go together, and a learner that "
    "sees one then knows the other: take random for a set to learn from"
)
_UNVARIED = {"key": "seed", "kind": "choice", "one_of": [1]}
# a sweep of which nothing is wrong, that keys of another are tried in
_EMPTY = {"sweep": "mistakes", "purpose": "to find them", "scene": "smooth_run", "runs": 16}


def make_plan(
    sweep: str | Path | Mapping[str, Any], say: Callable[[str], None] = lambda _: None, **changes: Any
) -> SweepScenes:
    """Make the scenes of a shipped sweep, a file or a mapping.

    Parameters
    ----------
    say : callable, optional
        Called with what takes time, and what would mislead a learner.
    **changes
        Keys in place of those of the file.

    Raises
    ------
    InputError
        With every mistake: where the file itself is wrong, also those that its other keys make in a scene.
    """
    name = dict(sweep) if isinstance(sweep, Mapping) else sweep
    try:
        found, label = read_sweep(name, **changes)
    except InputError as error:
        raise InputError([*error.problems, *_of_the_rest(name)]) from None
    if found.sampling == "sobol":
        say(_EVEN)
    return scenes_of(found, label, say)


def _of_the_rest(name: dict[str, Any] | str | Path) -> list[str]:
    """List the mistakes that those keys of a sweep make in a scene which are right by themselves."""
    if isinstance(name, dict):
        data, label, folder = name, "sweep", Path()
    else:
        try:
            path = find("sweeps", str(name))
            data, label, folder = read_file(path), str(path), path.parent
        except InputError:  # there is no such file, and that has been reported
            return []
    kept = dict(_EMPTY)
    for key in ("scene", "set", "seed", "signals"):
        if key in data and _is_mapping({**kept, "vary": [_UNVARIED], key: data[key]}):
            kept[key] = data[key]
    entries: list[Any] = []
    for entry in data["vary"] if isinstance(data.get("vary"), list) else ():
        if _is_mapping({**kept, "vary": [*entries, entry]}):
            entries.append(entry)
    found, _ = read_sweep({**kept, "vary": entries or [_UNVARIED]})
    return mistakes_of(replace(found, folder=folder), label) if "scene" in data else []


def _is_mapping(data: dict[str, Any]) -> bool:
    try:
        read_sweep(data)
    except InputError:
        return False
    return True
