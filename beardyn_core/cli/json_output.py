"""Writes the JSON object of a command, strict and versioned; `docs/json.md` explains every key.

The vocabulary: SI units without multiples, the unit as last words of the key (`_N_m`, `_rad_per_s`); levels
in dB; what has no unit (counts, ratios, shares of 1) has none in its key. Every object begins with
``schema_version`` and ``command``. What a dataclass holds takes its keys from there: `keyed_fields`.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from beardyn_core.base.plain_json import strict_text

SCHEMA_VERSION = 1
"""Raised when a key is renamed, removed or changes its meaning; a new key does not raise it."""


def json_text(command: str, content: Mapping[str, Any], indent: int | None = None) -> str:
    """Write what a command found, under the keys of `docs/json.md`, as one strict JSON object.

    Arrays, tuples and paths are converted, NaN and infinity become null; files are indented.
    """
    return strict_text({"schema_version": SCHEMA_VERSION, "command": command, **content}, indent)


def rename_keys(value: Any, names: Mapping[str, str]) -> Any:
    """Rename the keys of mappings, nested ones and those in lists included; others keep their name."""
    if isinstance(value, Mapping):
        return {names.get(key, key): rename_keys(each, names) for key, each in value.items()}
    if isinstance(value, (list, tuple)):
        return [rename_keys(each, names) for each in value]
    return value
