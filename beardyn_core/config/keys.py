"""From an annotated noun to the model of its file: keys in edge units, limits, words, and the noun back."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable
from functools import cache, reduce
from operator import or_
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar, cast, get_args, get_origin

from pydantic import Discriminator, Field, StrictBool, Tag, TypeAdapter, ValidationError, create_model

from beardyn_core.base.edge import (
    At,
    Place,
    alternatives,
    has_no_key_for_its_kind,
    is_kind,
    is_noun,
    kinds_of,
    may_be_none,
    needs_no_kind,
    places,
    plain_hint,
)
from beardyn_core.base.units import Unit
from beardyn_core.config.file_model import FileModel, SourcedModel, SourcedPart

Text = Annotated[str, Field(strict=True)]
Name = Annotated[str, Field(strict=True, min_length=1, max_length=80)]

_BASES: dict[type, type[FileModel]] = {}
_MADE: dict[str, type[FileModel]] = {}
_Model = TypeVar("_Model", bound=FileModel)


def reads(noun: type) -> Callable[[type[_Model]], type[_Model]]:
    """Make a model the base of the keys of a noun: keys of the file alone, short forms, what follows."""

    def register(base: type[_Model]) -> type[_Model]:
        late = [model for model in _MADE.values() if model.noun_type is noun]
        assert not late, f"files of {noun.__name__} have been read before {base.__name__} was there"
        _BASES[noun] = base
        return base

    return register


def keys_of(noun: Any, usual_kind: str | None = None, part_of_sourced: bool = False) -> type[FileModel]:
    """Make the model of the mapping that a noun is read from.

    Parameters
    ----------
    noun : type
        A dataclass or named tuple whose fields have `beardyn_core.base.edge.At`.
    usual_kind : str, optional
        Kind of a mapping that does not say its kind.
    part_of_sourced : bool
        Whether the mapping is in a file whose numbers may say where they come from.
    """
    return _keys_of(noun, usual_kind, part_of_sourced)


@cache
def _keys_of(noun: Any, usual_kind: str | None, part_of_sourced: bool) -> type[FileModel]:
    sourced = part_of_sourced or any(place.key == "sources" for place in places(noun))
    own = SourcedModel if sourced and not part_of_sourced else SourcedPart if sourced else FileModel
    base = _BASES.get(noun, own)
    made: dict[str, Any] = {}
    if is_kind(noun):
        kinds: Any = Literal[kinds_of(noun)]
        made["kind"] = (kinds, Field(usual_kind or ..., description="which of the kinds this is"))
    for place in places(noun):
        if place.key not in base.model_fields:
            made[place.key] = _field(place, sourced)
            if change := base.schema_changes.get(place.key):
                annotation, field = made[place.key]
                made[place.key] = (Annotated[annotation, Field(json_schema_extra=change)], field)
    name, words = f"{noun.__name__}Keys", (noun.__doc__ or "").split("\n")[0]
    model = cast(Any, create_model(name, __base__=base, __doc__=words, __module__=__name__, **made))
    model.noun_type, model.places = noun, places(noun)
    _MADE[name] = model
    return _MADE[name]


def in_order(name: str, keys: Iterable[str]) -> list[str]:
    """Put the keys of a model in the order of its noun, those of the file alone behind them."""
    model = _MADE.get(name)
    order = [place.key for place in model.places] if model else []
    head = ("kind", "name", "purpose", "preset")
    return sorted(keys, key=lambda key: (key not in head, order.index(key) if key in order else len(order)))


@cache
def _adapter(hint: Any) -> TypeAdapter[Any]:
    return TypeAdapter(_annotation(hint, At(), False))


def valid(hint: Any, data: Any) -> Any:
    """Read a noun of a type, or of one of a union, from what a file says; ``None`` when it is wrong."""
    try:
        return _adapter(hint).validate_python(data).noun()
    except ValidationError:
        return None


def _field(place: Place, sourced: bool) -> tuple[Any, Any]:
    """Make the type and the usual value of a key."""
    at, default = place.at, place.default
    annotation = _annotation(place.hint, at, sourced)
    words = place.words or None
    if at.usual is not None:
        return annotation, Field(_usual(at.usual, None, sourced), description=words)
    if at.required or (default is dataclasses.MISSING and not at.optional):
        return annotation, Field(description=words)
    if at.switch:
        return annotation, Field(None if default is None else False, description=words)
    if at.absent or at.optional or may_be_none(place.hint):
        return annotation | None, Field(None, description=words)
    return annotation, Field(_usual(default, at.scale, sourced), description=words)


def _usual(value: Any, scale: Unit | None, sourced: bool) -> Any:
    """Convert the usual value of a field to that of its key."""
    if is_noun(type(value)):
        return keys_of(type(value), None, sourced)()
    if isinstance(value, tuple):
        return tuple(_usual(each, scale, sourced) for each in value)
    return scale.to_edge(value) if isinstance(value, float) and scale else value


def _annotation(hint: Any, at: At, sourced: bool) -> Any:
    """Make the pydantic type of a key."""
    hint, _ = plain_hint(hint)
    options = alternatives(hint)
    if options != (hint,):
        return _union(options, at, sourced)
    if is_noun(hint):
        return _union((hint,), at, sourced)
    if get_origin(hint) is tuple:
        return _list(get_args(hint), at, sourced)
    if at.one_of:
        return Literal[at.one_of]
    # strict: a text such as "3 mm" and `true` are not numbers; not-a-number and infinity are refused
    if hint is float:
        return Annotated[float, Field(strict=True, allow_inf_nan=False, **at.limits)]
    if hint is int:
        return Annotated[int, Field(strict=True, **at.limits)]
    if hint is bool:
        return StrictBool
    if hint in (str, Path):
        limits: dict[str, Any] = {"min_length": 1, "max_length": at.longest} if at.longest else {}
        return Annotated[str, Field(strict=True, pattern=at.pattern, **limits)]
    return hint


def _list(entries: tuple[Any, ...], at: At, sourced: bool) -> Any:
    inner = dataclasses.replace(at, size=None, entry=None)
    if at.entry:
        entries = (at.entry, ...)
    if entries[-1] is not ...:
        return tuple[tuple(_annotation(each, inner, sourced) for each in entries)]  # type: ignore[misc]
    several: Any = tuple[_annotation(entries[0], inner, sourced), ...]  # type: ignore[misc]
    if at.size is None:
        return several
    fewest, most = at.size
    return Annotated[several, Field(min_length=fewest, max_length=most)]


def _union(options: tuple[Any, ...], at: At, sourced: bool) -> Any:
    """Make the type of one of several nouns, a name or a switch; no key is a tag in brackets."""
    if len(options) > 1:
        options = tuple(each for each in options if not (is_noun(each) and has_no_key_for_its_kind(each)))
    if len(options) > 1 and sum(map(is_noun, options)) == 1:
        return _plain_or_table(options, at, sourced)
    if not all(is_noun(option) for option in options):
        return reduce(or_, (_annotation(option, at, sourced) for option in options))
    tagged: list[Any] = []
    usual: str | None = None
    if len(options) == 1:
        model = keys_of(options[0], None, sourced)
        if not (at.switch or at.reference):
            return model
        tagged = [Annotated[model, Tag("<options>" if at.switch else "<inline>")]]
    else:
        first = at.switch or needs_no_kind(options[0])
        usual = kinds_of(options[0])[0] if first else next(filter(None, map(_usual_kind, options)), None)
        for option in options:
            model = keys_of(option, usual if usual in kinds_of(option) and is_kind(option) else None, sourced)
            plain = at.reference and option is options[0]  # a mapping or a name, without a kind
            tagged += [
                Annotated[model, Tag("<inline>" if plain else f"<{kind}>")] for kind in kinds_of(option)
            ]
    if at.switch:
        tagged.insert(0, Annotated[bool | None, Tag("<switch>")])
    if at.reference:
        tagged.insert(0, Annotated[str, Tag("<name>")])

    def tag(value: Any) -> str | None:
        """Tell what a value is, or the kind that it says or usually has."""
        if at.switch and (value is None or isinstance(value, bool)):
            return "<switch>"
        if at.reference and isinstance(value, str):
            return "<name>"
        if len(options) == 1:
            return "<inline>" if at.reference else "<options>"
        kind = value.get("kind", usual) if isinstance(value, dict) else getattr(value, "kind", None)
        if at.reference and kind in (None, usual):
            return "<inline>"
        return f"<{kind}>" if kind is not None or isinstance(value, dict) else None

    return Annotated[reduce(or_, tagged), Discriminator(tag)]


def _plain_or_table(options: tuple[Any, ...], at: At, sourced: bool) -> Any:
    """Make the type of a plain value or the keys of a noun; a mistake is explained in the form given."""
    tagged = [
        Annotated[_annotation(option, at, sourced), Tag("<table>" if is_noun(option) else "<plain>")]
        for option in options
    ]

    def tag(value: Any) -> str:
        """Tell a mapping from a plain value."""
        return "<table>" if isinstance(value, dict | FileModel) else "<plain>"

    return Annotated[reduce(or_, tagged), Discriminator(tag)]


def _usual_kind(noun: type) -> str | None:
    """Find the kind that a mapping of a noun has when it does not say one."""
    field = next((place for place in places(noun) if place.key == "kind"), None)
    return None if field is None or field.at.required else field.default
