"""Base of every configuration file's model: strict numbers, unknown keys explained, all mistakes kept."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar, get_args

from pydantic import (
    BaseModel,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    PrivateAttr,
    ValidationError,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError

from beardyn_core.base.edge import NounError, Place, Problem, alternatives, rules_of
from beardyn_core.base.spelling import closest
from beardyn_core.base.units import Unit, stem_of, unit_of


class FileModel(BaseModel):
    """Mapping in a configuration file; keys end in their unit."""

    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="constants")
    noun_type: ClassVar[type | None] = None
    places: ClassVar[tuple[Place, ...]] = ()
    schema_changes: ClassVar[dict[str, Callable[[dict[str, Any]], None]]] = {}  # of a key, in the JSON schema
    checked_elsewhere: ClassVar[tuple[str, ...]] = ()  # keys that the reader of the whole file checks
    _noun: Any = PrivateAttr(None)

    def values(self) -> dict[str, Any]:
        """Convert the keys to the fields of the noun, SI; a key left out has the noun's usual value."""
        found = {}
        for place in self.places:
            value = _in_si(getattr(self, place.key), place.at.scale)
            if place.at.switch and value is False:
                value = None
            if isinstance(value, str) and Path in alternatives(place.hint):
                value = Path(value)
            if value is not None or not place.at.absent:
                found[place.field] = value
        return found

    def make(self) -> Any:
        """Make the noun."""
        assert self.noun_type is not None
        return self.noun_type(**self.values())

    def noun(self) -> Any:
        """Return the noun, SI."""
        return self._noun

    @model_validator(mode="wrap")
    @classmethod
    def _explain(cls, data: Any, handler: Callable[[Any], Any]) -> Any:
        if not isinstance(data, dict):
            return handler(data)
        data = cls._prepare(data)
        unknown = [key for key in data if key not in cls.model_fields]
        details: list[InitErrorDetails] = [
            InitErrorDetails(
                type=PydanticCustomError(
                    "unknown_key", "{advice}", {"advice": cls._advice(str(key), set(data))}
                ),
                loc=(key,),
                input=data[key],
            )
            for key in unknown
        ]
        known = {key: value for key, value in data.items() if key in cls.model_fields}
        excused = {cls._meant(str(key), set(data)) for key in unknown}
        try:
            made = handler(known)
            details += [] if unknown else made._mistakes()
        except ValidationError as error:
            details += [
                _again(found)
                for found in error.errors()
                if not (found["type"] == "missing" and len(found["loc"]) == 1 and found["loc"][0] in excused)
            ]
        if details:
            raise ValidationError.from_exception_data(cls.__name__, details)
        return made

    def rules(self) -> Iterator[str | Problem]:
        """Find what the keys, each right by itself, cannot be together before there is a noun."""
        yield from ()

    def _mistakes(self) -> list[InitErrorDetails]:
        """Make the noun and find what its numbers cannot be together."""
        found = list(rules_of(self))
        if self.noun_type and not found:
            try:
                self._noun = self.make()
                found = list(rules_of(self._noun))
            except NounError as error:
                found = error.found
        return [
            InitErrorDetails(type=problem(each.text), loc=each.place, input=None)
            for each in found
            if not (each.place and each.place[0] in self.checked_elsewhere)
        ]

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        """Write short forms out: `true` as options without a key, `false` as the key that is not there."""
        prepared = dict(data)
        for place in cls.places:
            if place.at.switch and isinstance(value := data.get(place.key), bool):
                prepared[place.key] = {} if value else cls.model_fields[place.key].default
        return prepared

    @classmethod
    def _meant(cls, key: str, given: set[str]) -> str | None:
        """Find the known key that an unknown one was probably meant to be, rather one not given yet."""
        free = [known for known in cls.model_fields if known not in given]
        for known in (*free, *cls.model_fields):
            if stem_of(known) == stem_of(key):
                return known
        return closest(key, free) or closest(key, cls.model_fields)

    @classmethod
    def _advice(cls, key: str, given: set[str]) -> str:
        meant = cls._meant(key, given)
        allowed = f"allowed keys are {', '.join(cls.model_fields)}"
        if meant is None:
            return f"unknown key; {allowed}"
        unit = unit_of(meant)
        if unit and stem_of(meant) == stem_of(key):
            return f"unknown key; give `{meant}`, a number in {unit}"
        return f"unknown key; did you mean `{meant}`? {allowed[0].upper()}{allowed[1:]}"


def _in_si(value: Any, scale: Unit) -> Any:
    """Convert the value of a key to that of the field."""
    if isinstance(value, FileModel):
        return value.noun()
    if isinstance(value, tuple):
        return tuple(_in_si(each, scale) for each in value)
    if isinstance(value, bool) or not isinstance(value, float | int):
        return value
    return scale.to_si(value)


def _again(found: Any) -> InitErrorDetails:
    """Take an error as it was found, to raise it once more with others."""
    context = found.get("ctx", {})
    if found["type"] in ("unknown_key", "problem", "value_error"):
        message = found["msg"].replace("{", "(").replace("}", ")")
        kind = "unknown_key" if found["type"] == "unknown_key" else "problem"
        return InitErrorDetails(
            type=PydanticCustomError(kind, "{advice}", {"advice": context.get("advice", message)}),
            loc=found["loc"],
            input=found["input"],
        )
    return InitErrorDetails(type=found["type"], loc=found["loc"], input=found["input"], ctx=context)


def problem(sentence: str) -> PydanticCustomError:
    """Make a mistake of a sentence: what is wrong and what is allowed, without file and key."""
    return PydanticCustomError("problem", "{advice}", {"advice": sentence})


class SourcedPart(FileModel):
    """A mapping inside a file whose numbers may say where they come from."""

    @classmethod
    def __get_pydantic_json_schema__(cls, core_schema: Any, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        schema = handler.resolve_ref_schema(handler(core_schema))
        for key, plain in schema["properties"].items():
            if key not in ("name", "description", "sources") and not _is_part(
                cls.model_fields[key].annotation
            ):
                about = {
                    name: plain.pop(name) for name in ("title", "description", "default") if name in plain
                }
                sourced = {
                    "type": "object",
                    "properties": {
                        "value": {**plain, "description": "as it is given without a source"},
                        "source": {"type": "string", "description": "where the value comes from"},
                    },
                    "required": ["value", "source"],
                    "additionalProperties": False,
                }
                schema["properties"][key] = {**about, "anyOf": [plain, sourced]}
        return schema


def _is_part(annotation: Any) -> bool:
    parts = (annotation, *get_args(annotation))  # a part may be left out: `Part | None`
    return any(isinstance(part, type) and issubclass(part, SourcedPart) for part in parts)


class SourcedModel(SourcedPart):
    """A file whose numbers may say where they come from: ``{value: 17, source: catalogue}``."""

    sources: dict[str, Annotated[str, Field(strict=True)]] = Field(
        {}, description="key without unit -> where its value comes from"
    )

    def values(self) -> dict[str, Any]:
        """Convert the keys to the fields of the noun, SI; sources become pairs."""
        return {**super().values(), "sources": tuple(self.sources.items())}

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        plain, sources = split_sources(super()._prepare(data))
        if sources and "sources" not in plain:
            plain["sources"] = sources
        return plain


def split_sources(data: dict[str, Any], owner: str = "") -> tuple[dict[str, Any], dict[str, Any]]:
    """Replace each ``{value, source}`` by its value; return the mapping and the sources by dotted name."""
    plain: dict[str, Any] = {}
    sources: dict[str, Any] = {}
    for key, value in data.items():
        name = f"{owner}{stem_of(key)}"
        if isinstance(value, dict) and set(value) == {"value", "source"}:
            plain[key] = value["value"]
            sources[name] = value["source"]
        elif isinstance(value, dict) and key != "sources":
            plain[key], inner = split_sources(value, f"{name}.")
            sources |= inner
        else:
            plain[key] = value
    return plain, sources
