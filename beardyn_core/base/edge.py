"""What a field of a noun is at the edge: its unit, its limits and its words there.

A noun is a frozen dataclass in SI. What its file says in other units stands on the field::

    length: Annotated[float, At("mm", gt=0.0, le=150.0), "along the circumference"] = 0.04

From that one line follow the key ``length_mm`` of the file, its limits, its words in the JSON schema and in
the reference page (`beardyn_core.config`), the text of a recorded scene (`write_noun`) and what a noun
made in Python refuses (`refuse`).
"""

from __future__ import annotations

import dataclasses
import math
import operator
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import NoneType, UnionType
from typing import Annotated, Any, NamedTuple, Union, get_args, get_origin, get_type_hints

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import UNITS, Unit

_PLAIN = Unit("")
_PERCENT = Unit("", times=0.01)


@dataclasses.dataclass(frozen=True)
class At:
    """How a field is written at the edge."""

    unit: Annotated[str, "ending of the key, one of `UNITS` or ``percent``; empty for what has no unit"] = ""
    # limits in that unit, of every number in the field
    gt: float | None = None
    ge: float | None = None
    lt: float | None = None
    le: float | None = None
    one_of: Annotated[tuple[str, ...], "the texts that are allowed"] = ()
    size: Annotated[tuple[int, int | None] | None, "fewest and most entries of a list"] = None
    entry: Annotated[Any, "named tuple that each entry of a list of plain tuples is written as"] = None
    longest: Annotated[int | None, "most characters of a text, which then cannot be empty"] = None
    key: Annotated[str | None, "key without its unit where it is not the field's own name"] = None
    required: Annotated[bool, "the file must give the key although the field has a usual value"] = False
    # ... or may leave it out although the field has no usual value; its reader fills it in
    optional: bool = False
    usual: Annotated[Any, "usual value, in the unit of the edge, of a key whose field has none"] = None
    pattern: Annotated[str | None, "regular expression that a text must fit"] = None
    absent: Annotated[bool, "the usual value stands for a key that is not given: the file has none"] = False
    switch: Annotated[bool, "``true`` stands for the usual options, ``false`` for none"] = False
    reference: Annotated[bool, "the name of a file may stand for the mapping"] = False

    @property
    def scale(self) -> Unit:
        """Unit of the numbers."""
        return _PERCENT if self.unit == "percent" else UNITS.get(self.unit, _PLAIN)

    @property
    def limits(self) -> dict[str, Any]:
        """Limits that are set, in the unit of the edge."""
        every = {"gt": self.gt, "ge": self.ge, "lt": self.lt, "le": self.le}
        return {name: limit for name, limit in every.items() if limit is not None}


LIMIT_WORDS = {"gt": "greater than", "ge": "at least", "lt": "less than", "le": "at most"}
INTERNAL = "<not in a file>"
Vector = tuple[float, float, float]
ROW = At(ge=0, le=1)
SHARE = At(ge=0.0, le=1.0)
SEED = At(ge=0, le=2**32 - 1)


class Place(NamedTuple):
    """A field of a noun, and the key it is written with."""

    field: str
    key: str
    hint: Any  # type without its notes
    at: At
    words: str
    default: Any  # `dataclasses.MISSING` where there is none


def places(noun: Any) -> tuple[Place, ...]:
    """List the fields of a noun (a dataclass or a named tuple) that a file can give, in their order."""
    return _places(noun)


@cache
def _places(noun: Any) -> tuple[Place, ...]:
    hints = get_type_hints(noun, include_extras=True)
    found = []
    for name, default in _defaults(noun).items():
        hint, notes = plain_hint(hints[name])
        if INTERNAL in notes:
            continue
        at = At()
        for note in (each for each in notes if isinstance(each, At)):
            set_here = {
                f.name: v for f in dataclasses.fields(At) if (v := getattr(note, f.name)) != f.default
            }
            at = dataclasses.replace(at, **set_here)
        words = next((each for each in reversed(notes) if isinstance(each, str)), "")
        stem = at.key or name
        found.append(Place(name, f"{stem}_{at.unit}" if at.unit else stem, hint, at, words, default))
    return tuple(found)


def _defaults(noun: type) -> dict[str, Any]:
    """List the fields of a noun with their usual values."""
    if not dataclasses.is_dataclass(noun):
        usual: dict[str, Any] = noun._field_defaults  # type: ignore[attr-defined]
        return {name: usual.get(name, dataclasses.MISSING) for name in noun._fields}  # type: ignore[attr-defined]
    return {
        field.name: field.default_factory()
        if field.default_factory is not dataclasses.MISSING
        else field.default
        for field in dataclasses.fields(noun)
    }


def plain_hint(hint: Any) -> tuple[Any, tuple[Any, ...]]:
    """Split a type from the notes that `Annotated` puts on it."""
    if get_origin(hint) is Annotated:
        inner, *notes = get_args(hint)
        deeper, before = plain_hint(inner)
        return deeper, (*before, *notes)
    return hint, ()


def kind_of(place: Place) -> type:
    """Tell what one number or text of a field is: float, int or str."""
    hint = str(plain_hint(place.hint)[0])
    return float if "float" in hint else int if "int" in hint else str


def is_noun(hint: Any) -> bool:
    """Tell whether a type is written as a mapping of keys."""
    return isinstance(hint, type) and (dataclasses.is_dataclass(hint) or hasattr(hint, "_field_defaults"))


def alternatives(hint: Any) -> tuple[Any, ...]:
    """List the types of a union without ``None``; a type alone is its only alternative."""
    if get_origin(hint) in (Union, UnionType):
        return tuple(each for each in get_args(hint) if each is not NoneType)
    return (hint,)


def may_be_none(hint: Any) -> bool:
    """Tell whether a union has ``None`` in it."""
    return NoneType in get_args(hint)


def has_no_key_for_its_kind(noun: type) -> bool:
    """Tell whether the kind of a noun is nothing that a file can say: it stands under a key of its own."""
    return "kind" in _defaults(noun) and all(place.field != "kind" for place in places(noun))


def kinds_of(noun: type) -> tuple[str, ...]:
    """List the values of the key ``kind`` that stand for a noun where several are possible."""
    field = next((place for place in places(noun) if place.key == "kind"), None)
    if field is not None:
        return field.at.one_of
    kinds: tuple[str, ...] = getattr(noun, "KINDS", ()) or (noun.kind,)  # type: ignore[attr-defined]
    return kinds


def is_kind(noun: type) -> bool:
    """Tell whether the file names the kind of a noun with a key that is no field of it."""
    return isinstance(noun.__dict__.get("kind"), (str, property)) and "kind" not in _defaults(noun)


def needs_no_kind(noun: type) -> bool:
    """Tell whether a mapping without a kind is one of a noun that has kinds next to it."""
    return not is_kind(noun) and all(place.key != "kind" for place in places(noun))


def write_noun(noun: Any) -> dict[str, Any]:
    """Write a noun as the mapping of its file: edge units, every number, nothing that is ``None``.

    A noun whose file says something in another way changes the mapping in its method ``as_written``.
    """
    found: dict[str, Any] = {"kind": noun.kind} if is_kind(type(noun)) else {}
    for place in places(type(noun)):
        value = getattr(noun, place.field)
        if place.key == "sources":
            found["sources"] = dict(value)
        elif value is not None and not is_absent(place, value):
            found[place.key] = written_value(value, place.at)
    return noun.as_written(found) if hasattr(noun, "as_written") else found


def is_absent(place: Place, value: Any) -> bool:
    """Tell whether a value stands for a key that is not given; NaN stands for itself."""
    return place.at.absent and (value == place.default or (value != value and place.default != place.default))


def written_value(value: Any, at: At) -> Any:
    """Write one value of a field as it stands in a file."""
    if isinstance(value, Path):
        return str(value)
    if is_noun(type(value)):
        return write_noun(value)
    if isinstance(value, tuple):
        return [written_value(_name_numbers(each, at), at) for each in value]
    return at.scale.to_edge(value) if isinstance(value, float | int) and at.unit else value


def _name_numbers(entry: Any, at: At) -> Any:
    """Give an entry of a list, a plain tuple, the names of its numbers."""
    return at.entry(*entry) if at.entry and type(entry) is tuple else entry


class Problem(NamedTuple):
    """What is wrong with a noun: a sentence, in keys and units of the file, and the part it is about."""

    text: str
    place: tuple[str | int, ...] = ()


class NounError(InputError):
    """A noun that cannot be.

    Parameters
    ----------
    owner : str
        What the noun is called.
    """

    def __init__(self, owner: str, found: list[Problem]) -> None:
        super().__init__([f"{owner}{_path(problem.place)}: {problem.text}" for problem in found])
        self.found = found


def rules_of(noun: Any) -> Iterator[Problem]:
    """Find what the numbers of a noun, each right by itself, cannot be together (its method `rules`)."""
    for found in noun.rules() if hasattr(noun, "rules") else ():
        yield Problem(found) if isinstance(found, str) else found


def outside(noun: Any) -> Iterator[Problem]:
    """Find values of a noun beyond their limits, not finite, or no word that is allowed."""
    for place in places(type(noun)):
        value = getattr(noun, place.field)
        if value is None or is_absent(place, value):
            continue
        if place.at.one_of and isinstance(value, str) and value not in place.at.one_of:
            yield Problem(f"{place.key} is {value!r}; allowed are {', '.join(filter(None, place.at.one_of))}")
        elif isinstance(value, float | int):
            yield from _number_outside(place.key, value, place.at)
        elif isinstance(value, tuple):
            yield from _entries_outside(place, value)
        else:
            yield from _inside(value, place.key)


def _entries_outside(place: Place, value: tuple[Any, ...]) -> Iterator[Problem]:
    fewest, most = place.at.size or (0, None)
    if len(value) < fewest:
        yield Problem(f"{place.key} is {value or 'empty'}; give at least {fewest}")
    if most is not None and len(value) > most:
        yield Problem(f"{place.key} has {len(value)} entries; allowed are {fewest} to {most}")
    if value and all(isinstance(each, float | int) for each in value):
        found = [each for one in value for each in _number_outside(place.key, one, place.at)]
        if found and not all(math.isfinite(each) for each in value):
            yield Problem(f"{place.key} is {value}; every component must be a finite number")
        else:
            for index, one in enumerate(value):
                yield from _number_outside(f"{place.key}[{index}]", one, place.at)
        return
    for index, each in enumerate(value):
        yield from _inside(_name_numbers(each, place.at), place.key, index)


def _inside(part: Any, *place: str | int) -> Iterator[Problem]:
    """Find the mistakes of a part that does not refuse them by itself."""
    if is_noun(type(part)) and not hasattr(part, "__post_init__"):
        for found in list(outside(part)) or list(rules_of(part)):
            yield Problem(found.text, (*place, *found.place))


def _number_outside(name: str, value: float, at: At) -> Iterator[Problem]:
    edge = at.scale.to_edge(value)
    broken = next((name for name, limit in at.limits.items() if not getattr(operator, name)(edge, limit)), "")
    if broken:
        yield Problem(f"{name} is {edge:g}; it must be {LIMIT_WORDS[broken]} {at.limits[broken]:g}")
    elif not math.isfinite(edge):
        yield Problem(f"{name} is {edge:g}; it must be a finite number")


def refuse(noun: Any, owner: str) -> None:
    """Raise `InputError` with every mistake in a noun made in Python, if there is one.

    Parameters
    ----------
    owner : str
        What to call it.
    """
    if found := [*outside(noun), *rules_of(noun)]:
        raise NounError(owner, found)


def _path(place: tuple[str | int, ...]) -> str:
    return "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in place)


class WorkedOut(tuple):
    """A tuple that remembers what it has been worked out from; equal to the plain tuple.

    Parameters
    ----------
    source : object
        What stands in the file instead of the values.
    """

    source: Any

    def __new__(cls, values: Any, source: Any = None) -> WorkedOut:
        """Make it."""
        made = super().__new__(cls, values)
        made.source = source
        return made

    def __reduce__(self) -> tuple[Any, ...]:
        return (WorkedOut, (tuple(self), self.source))
