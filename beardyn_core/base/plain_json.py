"""JSON on the way out and in: strict text of what we write, a bounded reading of what others wrote."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Collection, Mapping
from typing import Any

from beardyn_core.base.edge import places
from beardyn_core.base.errors import InputError

LONGEST_TEXT = 4_000_000  # characters; the description of a scene with every part takes 60 000
DEEPEST = 32  # levels of objects and lists; ours have at most 8
_UNIT = re.compile(r"(?<!shape )\[([^]]+)\]$")
LONGEST_NUMBER = 400  # digits; the longest float64 written in full has 309 before its point


def strict_text(content: Mapping[str, Any], indent: int | None = None) -> str:
    """Write one strict JSON object; what it cannot hold is converted as by `plain`."""
    return json.dumps(plain(content), indent=indent, allow_nan=False)


def plain(value: Any) -> Any:
    """Convert a value to what strict JSON can hold: NaN and infinity to null, arrays and tuples to lists."""
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    if hasattr(value, "tolist"):  # an array or a number of NumPy
        return plain(value.tolist())
    if isinstance(value, (list, tuple, set, frozenset)):
        return [plain(each) for each in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if value is None or isinstance(value, (bool, int, str)):
        return value
    return str(value)


def keyed_fields(noun: Any, without: Collection[str] = (), **keys: str) -> dict[str, Any]:
    """List the fields of a dataclass for JSON, each by its name and the unit that its words end with.

    A field ``time`` with the words ``of the last sample, [s]`` has the key ``time_s``, one in [m/s^2] ends
    with ``_m_per_s2``; counts, ratios and texts have their names alone.

    Parameters
    ----------
    noun : dataclass
    without : collection of str
        Fields that JSON has not.
    **keys
        Keys of fields that are called otherwise there.
    """
    return {
        keys.get(place.field) or _with_unit(place.field, place.words): getattr(noun, place.field)
        for place in places(type(noun))
        if place.field not in without
    }


def _with_unit(name: str, words: str) -> str:
    match = _UNIT.search(words)
    unit = "" if match is None else match[1].partition(" re ")[0]
    if unit in ("", "-"):
        return name
    return f"{name}_{unit.replace('/', '_per_').replace('^', '').replace(' ', '_')}"


def read_object(text: str, required: Mapping[str, type | tuple[type, ...]] | None = None) -> dict[str, Any]:
    """Read one JSON object that anybody may have written.

    Parameters
    ----------
    text : str
    required : mapping of str to type, optional
        Keys that must be there, each with the type of its value.

    Returns
    -------
    dict
        Every text in it can be encoded as UTF-8.

    Raises
    ------
    InputError
        The text is too long, nested too deeply, no JSON object, or a required key is missing.
    """
    if len(text) > LONGEST_TEXT:
        raise InputError(f"the text has {len(text)} characters; allowed are up to {LONGEST_TEXT}")
    try:
        found = json.loads(text, parse_int=_whole_number)
    except RecursionError:
        raise InputError(_TOO_DEEP) from None
    except ValueError as error:
        raise InputError(f"the text is no JSON object ({error})") from None
    if not isinstance(found, dict):
        raise InputError(f"the text is a JSON {_name_of(found)}; an object is needed")
    _check_values(found)
    problems = [
        f"the key '{key}' is missing" if key not in found else f"the key '{key}' is a {_name_of(found[key])}"
        for key, kind in (required or {}).items()
        if not isinstance(found.get(key), kind)
    ]
    if problems:
        raise InputError(problems)
    return found


_TOO_DEEP = f"the text has more than {DEEPEST} levels of lists and objects in each other"
_NAMES = {dict: "object", list: "list", str: "text", bool: "true or false", type(None): "null"}


def _name_of(value: object) -> str:
    return _NAMES.get(type(value), "number")


def _whole_number(digits: str) -> int:
    if len(digits) > LONGEST_NUMBER:
        raise ValueError(f"a number has {len(digits)} digits")
    return int(digits)


def _check_values(found: dict[str, Any]) -> None:
    """Check depth and texts level by level, for a recursion could be exhausted."""
    level: list[Any] = [found]
    for _ in range(DEEPEST):
        below: list[Any] = []
        for each in level:
            parts = [*each.keys(), *each.values()] if isinstance(each, dict) else each
            for part in parts:
                if isinstance(part, str):
                    _check_text(part)
                elif isinstance(part, (dict, list)):
                    below.append(part)
        if not below:
            return
        level = below
    raise InputError(_TOO_DEEP)


def _check_text(text: str) -> None:
    if text.isascii():
        return
    try:
        text.encode()
    except UnicodeEncodeError:
        raise InputError("a text in it has half of a character (a lone surrogate)") from None
