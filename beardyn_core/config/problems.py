"""From what the models refuse to sentences: file, key, value, what is allowed."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

from pydantic import ValidationError

from beardyn_core.base.edge import LIMIT_WORDS
from beardyn_core.base.spelling import closest
from beardyn_core.base.units import unit_of

Place = tuple[str | int, ...]


@dataclass(frozen=True)
class Origin:
    """Where a part of the resolved scene was written."""

    place: A[Place, "keys of the part in the resolved scene"]
    label: A[str, "file (or option) it was written in"]
    keys: A[Place, "keys of the part in that file"] = ()


_LIMITS = {"greater_than": "gt", "greater_than_equal": "ge", "less_than": "lt", "less_than_equal": "le"}


def key_path(place: Sequence[str | int]) -> str:
    """Write a key path: ``defects[0].width_mm``."""
    path = ""
    for part in place:
        path += f"[{part}]" if isinstance(part, int) else f"{'.' if path else ''}{part}"
    return path


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, (list, tuple)) and len(value) > 6:
        return f"a list of {len(value)}"
    text = "empty" if value is None else repr(value)
    return text if len(text) <= 80 else f"{text[:77]}..."


# What else a union takes where a mapping was expected, by the tag of its mapping.
_INSTEAD_OF_KEYS = {"<inline>": "a name or ", "<options>": "true, false or "}


# What is allowed where that depends on the kind of the mistake alone, with numbers of its context.
_SIMPLE = {
    **dict.fromkeys(("int_type", "int_parsing", "int_from_float"), "it must be a whole number"),
    **dict.fromkeys(("string_type", "string_too_short"), "it must be a text"),
    "string_too_long": "it must be at most {max_length} characters",
    # the only pattern there is
    "string_pattern_mismatch": "it must begin with a letter, and consist of letters a to z, digits and "
    "underscores",
    **dict.fromkeys(("bool_type", "bool_parsing"), "it must be true or false"),
    "too_short": "it must have at least {min_length} entries",
    "too_long": "it must have at most {max_length} entries",
}


def _expectation(found: Any, unit: str | None) -> str:
    """Say what is allowed where a value was refused."""
    kind, context = found["type"], found.get("ctx", {})
    in_unit = f" in {unit}" if unit else ""
    if kind in _LIMITS:
        limit = _LIMITS[kind]
        return f"it must be {LIMIT_WORDS[limit]} {context[limit]:g}"
    if kind in ("float_type", "float_parsing"):
        text = unit and isinstance(found["input"], str)
        hint = " (the unit is in the key, write the number alone)" if text else ""
        table = " or a mapping of keys to values" if "<plain>" in found["loc"] else ""
        return f"it must be a number{in_unit}{hint}{table}"
    if kind in ("finite_number", "tuple_type", "list_type"):
        return f"it must be a {'finite number' if kind == 'finite_number' else 'list'}{in_unit}"
    if kind == "literal_error":
        allowed = context["expected"].replace(" or ", ", ")
        return f"allowed are {allowed}{_guess(found['input'], allowed)}"
    if kind in ("model_type", "model_attributes_type", "dict_type"):
        named = _INSTEAD_OF_KEYS.get(str(found["loc"][-1]) if found["loc"] else "", "")
        return f"it must be {named}a mapping of keys to values"
    return _SIMPLE[kind].format(**context) if kind in _SIMPLE else str(found["msg"])


def _guess(value: Any, allowed: str) -> str:
    meant = closest(value, re.findall(r"'<?(\w+)>?'", allowed)) if isinstance(value, str) else None
    return f"; did you mean '{meant}'?" if meant else ""


def _complaint(key: str, found: Any, unit: str | None) -> str:
    """Say key, value and what is allowed."""
    kind, value, context = found["type"], found["input"], found.get("ctx", {})
    if kind == "unknown_key":
        return f"{key}: {context['advice']}"
    if kind == "missing" and isinstance(found["loc"][-1], int):
        return f"{key} is {_value(value)}; it must have 3 entries"
    if kind == "missing":
        return f"{key} is missing; give {f'a number in {unit}' if unit else 'it'}"
    if kind == "problem":
        return f"{key}{': ' if key else ''}{context['advice']}"
    if kind == "union_tag_invalid":
        tags = re.findall(r"'<(\w+)>'", context["expected_tags"])
        # a switch is true or false, not a kind
        allowed = ", ".join(repr(tag) for tag in tags if tag != "switch")
        kind_given = value.get("kind") if isinstance(value, dict) else None
        if kind_given is None:
            return f"{key}.kind is missing; allowed are {allowed}"
        return f"{key}.kind is {_value(kind_given)}; allowed are {allowed}{_guess(kind_given, allowed)}"
    if kind == "union_tag_not_found":
        return f"{key} is {_value(value)}; it must be a mapping with the key `kind`"
    return f"{key} is {_value(value)}; {_expectation(found, unit)}"


def sentences(error: ValidationError, origins: Sequence[Origin]) -> list[str]:
    """Write one sentence for each mistake."""
    found = []
    short_lists: set[Place] = set()
    for mistake in error.errors():
        if _only_lacks_refused_entries(mistake):
            continue
        place = tuple(part for part in mistake["loc"] if not str(part).startswith("<"))
        if mistake["type"] == "missing" and isinstance(place[-1], int):
            place = place[:-1]
            if place in short_lists:
                continue
            short_lists.add(place)
        unit = unit_of(str(next((part for part in reversed(place) if isinstance(part, str)), "")))
        label, key = locate(place, origins)
        if label.startswith("--"):
            found.append(_complaint(label, mistake, unit).replace(f"{label} is ", f"{label} ", 1))
        else:
            found.append(f"{label}: {_complaint(key, mistake, unit)}")
    return found


def _only_lacks_refused_entries(mistake: Any) -> bool:
    """Tell whether a list is called too short only because its refused entries were not counted."""
    given = mistake["input"]
    return (
        mistake["type"] == "too_short"
        and isinstance(given, (list, tuple))
        and len(given) >= mistake["ctx"]["min_length"]
    )


def locate(place: Place, origins: Sequence[Origin]) -> tuple[str, str]:
    """Find the file that a place came from, and its key path in that file."""
    owners = [origin for origin in origins if place[: len(origin.place)] == origin.place]
    origin = max(owners, key=lambda owner: len(owner.place))
    return origin.label, key_path((*origin.keys, *place[len(origin.place) :]))
