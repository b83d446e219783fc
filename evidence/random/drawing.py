"""Draw what a file may say of a noun: from its declared units, limits and words, by chance.

Nothing here knows a noun. A key that is added to one is drawn from then on; where its declaration leaves open
what is sensible (a name, a path, a place in millimetres), `Own` says it, and `undrawable` finds what nobody
says.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, get_args, get_origin

import numpy as np

from beardyn_core.base.edge import (
    At,
    Place,
    alternatives,
    has_no_key_for_its_kind,
    is_kind,
    is_noun,
    kinds_of,
    places,
    plain_hint,
)

Chance = np.random.Generator
ABSENT = object()
# of a key that may be left out
GIVEN = 0.25
# of a number that it is one of its limits, or zero
AT_A_LIMIT = 0.1
# of a number without limits: this many decades to either side of its usual value
AROUND = 1.0
# of a number that may be anything above zero: decades below its upper limit
DECADES = 4.0
MOST_ENTRIES = 3

Own = Mapping[tuple[str, str], Callable[[Chance], Any]]


def draw(noun: type, chance: Chance, own: Own, given: float = GIVEN) -> dict[str, Any]:
    """Draw the mapping of a noun's file.

    Parameters
    ----------
    noun : type
        Frozen dataclass or named tuple whose fields have `At`.
    own : mapping
        By class and field: what is drawn there instead; ``ABSENT`` leaves the key out.
    given : float
        Chance of each key that may be left out.
    """
    found: dict[str, Any] = {"kind": _one_of(kinds_of(noun), chance)} if is_kind(noun) else {}
    for place in places(noun):
        special = own.get((noun.__name__, place.field))
        if special is not None:
            value = special(chance)
        elif _needed(place) or chance.random() < given:
            value = _value(place.hint, place.at, place.default, chance, own)
        else:
            value = ABSENT
        if value is not ABSENT:
            found[place.key] = value
    return found


def redrawn(noun: Any, chance: Chance, share: float) -> dict[str, Any]:
    """Draw some of the numbers of a noun anew, none of them zero; the others are left out.

    Parameters
    ----------
    share : float
        Chance of each number.
    """
    found = {"kind": noun.kind} if is_kind(type(noun)) and len(kinds_of(type(noun))) == 1 else {}
    kind = len(found)
    for place in places(type(noun)):
        value = getattr(noun, place.field)
        if place.hint is float and isinstance(value, float) and value and chance.random() < share:
            found[place.key] = drawn_number(
                place.at, _usual_size(value, place.at), chance
            ) or place.at.scale.to_edge(value)
    return found if len(found) > kind else {}


def undrawable(noun: type, own: Own) -> Iterator[str]:
    """List the fields of a noun and of all in it of which nobody says what they can be."""
    for place in places(noun):
        if (noun.__name__, place.field) in own:
            continue
        for hint in _leaves(place.hint):
            if is_noun(hint):
                yield from undrawable(hint, own)
            elif not _drawable(hint, place):
                yield f"{noun.__name__}.{place.field}"


def _leaves(hint: Any) -> Iterator[Any]:
    hint, _ = plain_hint(hint)
    for each in alternatives(hint):
        if get_origin(each) is tuple:
            yield from (leaf for entry in get_args(each) if entry is not ... for leaf in _leaves(entry))
        else:
            yield each


def _drawable(hint: Any, place: Place) -> bool:
    at = place.at
    if hint is bool or get_origin(hint) is not None or at.one_of or at.entry:
        return True
    if hint in (str, Path):
        return False
    low, high = _limits(at)
    return (low is not None and high is not None) or bool(_usual_size(place.default, at))


def _needed(place: Place) -> bool:
    at = place.at
    return at.required or (place.default is dataclasses.MISSING and not at.optional and at.usual is None)


def _value(hint: Any, at: At, default: Any, chance: Chance, own: Own) -> Any:
    hint, _ = plain_hint(hint)
    options = alternatives(hint)
    if len(options) > 1:
        options = tuple(each for each in options if not (is_noun(each) and has_no_key_for_its_kind(each)))
    hint = _one_of(options, chance)
    if is_noun(hint):
        return draw(hint, chance, own)
    if get_origin(hint) is tuple:
        return _entries(get_args(hint), at, default, chance, own)
    if at.one_of:
        return _one_of(at.one_of, chance)
    if get_args(hint):  # one of some literal values
        return _one_of(get_args(hint), chance)
    if hint is bool:
        return bool(chance.integers(2))
    number = drawn_number(at, _usual_size(default, at), chance)
    return round(number) if hint is int else number


def _entries(types: tuple[Any, ...], at: At, default: Any, chance: Chance, own: Own) -> list[Any]:
    inner = dataclasses.replace(at, size=None, entry=None)
    if types[-1] is not ...:
        usual = default if isinstance(default, tuple) else (default,) * len(types)
        return [_value(each, inner, one, chance, own) for each, one in zip(types, usual, strict=True)]
    fewest, most = at.size or (0, None)
    count = int(chance.integers(max(fewest, 1), min(most or MOST_ENTRIES, MOST_ENTRIES) + 1))
    return [_value(at.entry or types[0], inner, None, chance, own) for _ in range(count)]


def drawn_number(at: At, usual: float | None, chance: Chance) -> float:
    """Draw a number within limits, in the unit of the edge.

    Between limits that are both given evenly, or evenly in its logarithm where they are decades apart; where
    one is missing, about the usual value.
    """
    low, high = _limits(at)
    if low is None or high is None:
        assert usual is not None, at
        number = usual * 10.0 ** chance.uniform(-AROUND, AROUND)
        return float(min(max(number, -math.inf if low is None else low), math.inf if high is None else high))
    if chance.random() < AT_A_LIMIT:
        ends = [each for each in (at.ge, at.le) if each is not None]
        ends += [0.0] if low < 0.0 < high else []
        if ends:
            return float(ends[int(chance.integers(len(ends)))])
    if low >= 0.0 and high > 0.0 and low < 10.0**-2 * high:
        decades = DECADES if low == 0.0 else min(DECADES, math.log10(high / low))
        return float(high * 10.0 ** -chance.uniform(0.0, decades))
    return float(chance.uniform(low, high))


def _limits(at: At) -> tuple[float | None, float | None]:
    lows = [each for each in (at.gt, at.ge) if each is not None]
    highs = [each for each in (at.lt, at.le) if each is not None]
    return max(lows, default=None), min(highs, default=None)


def _usual_size(default: Any, at: At) -> float | None:
    """Give the size of a usual value in the unit of the edge; ``None`` where there is none or it is zero."""
    if isinstance(default, tuple) and default and all(isinstance(each, float) for each in default):
        default = max(default, key=abs)
    if not isinstance(default, float | int) or isinstance(default, bool) or default == 0:
        return None
    return float(at.scale.to_edge(default)) if at.unit else float(default)


def _one_of(options: Any, chance: Chance) -> Any:
    return options[int(chance.integers(len(options)))]
