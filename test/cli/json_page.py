"""The keys that docs/json.md documents for each command, against those of objects."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

PAGE = Path(__file__).parents[2] / "docs" / "json.md"


def documented(command: str) -> list[str]:
    """Paths in the table of a command, such as ``findings[].score_dB``; ``*`` stands for any name."""
    page = PAGE.read_text(encoding="utf-8")
    section = re.search(rf"^## `beardyn {command}`\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL)
    assert section is not None, f"{PAGE.name} has no section on {command}"
    rows = re.findall(r"^\| (`[^|]*`) \|", section[1], re.MULTILINE)
    return ["schema_version", "command", *(path for row in rows for path in re.findall(r"`([^`]+)`", row))]


def paths_of(value: Any, above: str = "") -> Iterator[str]:
    """Paths of all values of an object; an absent or empty one ends its path early."""
    if isinstance(value, dict) and value:
        for key, each in value.items():
            name = key.replace(".", "·")  # that of a file
            yield from paths_of(each, f"{above}.{name}" if above else name)
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for each in value:
            yield from paths_of(each, f"{above}[]")
    else:
        yield above


def _same(path: str, pattern: str) -> bool:
    names, wanted = path.split("."), pattern.split(".")
    return len(names) == len(wanted) and all(
        want in ("*", name) or (want == "*[]" and name.endswith("[]"))
        for name, want in zip(names, wanted, strict=True)
    )


def _begins(pattern: str, path: str) -> bool:
    """Whether an empty value at a path stands for what the pattern documents inside of it."""
    count = len(path.split("."))
    head = pattern.split(".")[:count]
    return len(head) == count and _same(path.removesuffix("[]"), ".".join(head).removesuffix("[]"))


def check_known(command: str, *objects: dict[str, Any]) -> None:
    """Fail when an object has a key that is not documented."""
    patterns = documented(command)
    found = {path for each in objects for path in paths_of(each)}
    unknown = [
        path
        for path in sorted(found)
        if not any(_same(path, pattern) or _begins(pattern, path) for pattern in patterns)
    ]
    assert not unknown, f"{command}: not in {PAGE.name}: {unknown}"


def check(command: str, *objects: dict[str, Any]) -> None:
    """Fail when an object has a key that is not documented, or when no object has a documented one."""
    check_known(command, *objects)
    found = {path for each in objects for path in paths_of(each)}
    absent = [pattern for pattern in documented(command) if not any(_same(path, pattern) for path in found)]
    assert not absent, f"{command}: in {PAGE.name}, but in no object: {absent}"
