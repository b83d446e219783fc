"""Hash of the sources that a choice may come from: of its rules, and of all that they import."""

from __future__ import annotations

import hashlib
import re
from functools import cache
from pathlib import Path

_CORE = Path(__file__).resolve().parents[1]
_IMPORT = re.compile(rb"^ *(?:from|import) +beardyn_core([.\w]*)(?: +import +([\w, ]+)$)?", re.MULTILINE)


@cache
def source_hash(source: Path) -> str:
    """Hash a file and what it imports from this package, directly or not, also inside of functions.

    Parameters
    ----------
    source : Path
    """
    waiting = [source.resolve()]
    reached: set[Path] = set()
    while waiting:
        path = waiting.pop()
        if path not in reached:
            reached.add(path)
            waiting += _imported_files(path)
    digest = hashlib.sha256()
    for path in sorted(reached):
        digest.update(path.name.encode())
        digest.update(_text(path))
    return digest.hexdigest()[:16]


@cache
def _text(path: Path) -> bytes:
    return path.read_bytes()


@cache
def _imported_files(source: Path) -> tuple[Path, ...]:
    """List the files of this package that a file imports: of a room its modules that are named, else all."""
    found: list[Path] = []
    for match in _IMPORT.finditer(_text(source)):
        place = _CORE.joinpath(*match.group(1).decode().split(".")[1:])
        modules = [place / f"{name.strip()}.py" for name in (match.group(2) or b"").decode().split(",")]
        if not place.is_dir():
            modules = [place.with_suffix(".py")]
        elif not all(module.is_file() for module in modules):
            modules = sorted(place.glob("*.py"))
        found += modules
    return tuple(found)
