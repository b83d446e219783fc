"""Choices that were worked out before, kept next to the compiled kernels.

A choice takes seconds, and a scene is read more often than it is changed. What is kept is found by a hash of
all that the choice depends on, so that it never has to be thrown away by hand: the scene with the files it
names, what of it was open, the sources of the rules with the measured costs.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from dataclasses import fields, is_dataclass, replace
from enum import Enum
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

from beardyn_core.base.cache_root import cache_root, shipped_root
from beardyn_core.base.outputs import as_a_whole
from beardyn_core.choice.costs import COST_FILE
from beardyn_core.choice.rule import Choice
from beardyn_core.choice.source_hash import source_hash
from beardyn_core.effects import EffectSet, ModalStructure
from beardyn_core.scene.scene import Free, Scene
from beardyn_core.structure.mounted_box import is_path, table_path

_RULES = Path(__file__).with_name("choose.py")
_NUMBERS = ("numpy", "scipy")
_DIGEST = hashlib.sha256().digest_size
_MOST = 1 << 26  # bytes of a file

_known: dict[str, Choice] = {}


class _UnhashableError(Exception):
    """A value of which it is not known how to hash it."""


def typical(scene: Scene) -> Scene:
    """Give a scene the seeds that every choice is made with: chance decides no effect.

    Two bearings of a lot, or two rides on the same track, are then computed with the same physics and the
    same kernels.
    """
    scatter = None if scene.scatter is None else replace(scene.scatter, seed=1)
    return replace(scene, seed=1, scatter=scatter)


def kept(scene: Scene, free: Free, given: EffectSet | None, work_out: Callable[[], Choice]) -> Choice:
    """Find the choice for a scene where it was made before, else make it and keep it.

    Parameters
    ----------
    scene, free, given :
        As of `beardyn_core.choice.choose.choose`.
    work_out : callable
        Makes the choice.

    Returns
    -------
    Choice
        Its `kept` says whether it was read from a file.

    Notes
    -----
    A damaged file counts as none, and is written again; a folder that cannot be written to keeps nothing.
    Files appear as a whole, so that several processes may make the same choice at once.
    """
    try:
        key = _key(scene, free, given)
    except (_UnhashableError, OSError):
        return work_out()
    path = folder() / f"{key}.choice"
    if key not in _known:
        found = _read(path) or _read(folder(shipped_root()) / path.name)
        if found is None:
            found = work_out()
            if found.judged:
                _write(path, found)
        _known[key] = found
    return _known[key]


def folder(root: Path | None = None) -> Path:
    """Name the folder of the choices by these rules: by default in the user's cache."""
    return (cache_root() if root is None else root) / "choices" / _rules()


@cache
def _rules() -> str:
    digest = hashlib.sha256(source_hash(_RULES).encode())
    digest.update(COST_FILE.read_bytes())
    for package in _NUMBERS:
        digest.update(f"{package} {version(package)}\n".encode())
    return digest.hexdigest()[:16]


def _key(scene: Scene, free: Free, given: EffectSet | None) -> str:
    # neither name nor purpose is in any reason
    digest = hashlib.sha256()
    for part in _spell_out((replace(scene, name="", purpose=""), free, given)):
        digest.update(part.encode())
        digest.update(b"\n")
    return digest.hexdigest()[:32]


def _spell_out(value: Any) -> Iterator[str]:
    """Spell a value out, the same in every process; a file by its content."""
    if value is None or isinstance(value, bool | int | float | str):
        yield repr(value)
    elif isinstance(value, Path):
        yield f"file {hashlib.sha256(value.read_bytes()).hexdigest()}"
    elif isinstance(value, Enum):
        yield f"{type(value).__name__}.{value.name}"
    elif is_dataclass(value) and not isinstance(value, type):
        yield f"{type(value).__name__}("
        for field in fields(value):
            if field.compare:
                yield field.name
                yield from _spell_out(getattr(value, field.name))
        if isinstance(value, ModalStructure) and not value.content:
            yield from _spell_out(Path(value.table) if is_path(value.table) else table_path(value.table))
        yield ")"
    elif isinstance(value, tuple | list):
        yield "["
        for each in value:
            yield from _spell_out(each)
        yield "]"
    elif isinstance(value, frozenset | set):
        yield from _spell_out(sorted(value))
    elif isinstance(value, Mapping):
        yield from _spell_out(sorted(value.items()))
    else:
        raise _UnhashableError(type(value).__name__)


def _read(path: Path) -> Choice | None:
    """Read a choice; ``None`` where there is none, or a damaged one."""
    with suppress(Exception):  # whatever a damaged pickle raises
        if path.stat().st_size > _MOST:
            return None
        content = path.read_bytes()
        if hashlib.sha256(content[_DIGEST:]).digest() == content[:_DIGEST]:
            found = pickle.loads(content[_DIGEST:])
            if isinstance(found, Choice):
                return replace(found, kept=True)
    return None


def _write(path: Path, choice: Choice) -> None:
    content = pickle.dumps(choice)
    with suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        with as_a_whole(path) as fresh:
            fresh.write_bytes(hashlib.sha256(content).digest() + content)
