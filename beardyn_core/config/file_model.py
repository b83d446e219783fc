"""Base of every configuration file's model: strict numbers, unknown keys explained, all mistakes kept."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, TypeVar, get_args

from pydantic import (
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    GetJsonSchemaHandler,
    Tag,
    ValidationError,
    model_validator,
)
from pydantic_core import InitErrorDetails, PydanticCustomError

from beardyn_core.config.folders import closest
from beardyn_core.config.units import stem_of, unit_of

# Strict: a text such as "3 mm" and `true` are not numbers; not-a-number and infinity are refused.
Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)]
NonNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0)]
Fraction = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0, le=1.0)]
Friction = Annotated[NonNegative, Field(le=1.0)]
Count = Annotated[int, Field(strict=True)]
Text = Annotated[str, Field(strict=True)]
Name = Annotated[str, Field(strict=True, min_length=1, max_length=80)]
Vector = tuple[Number, Number, Number]
PositiveVector = tuple[Positive, Positive, Positive]
NonNegativeVector = tuple[NonNegative, NonNegative, NonNegative]

Model = TypeVar("Model", bound="FileModel")
# Tags of unions stand in brackets so that no key is mistaken for one.
# A reference by name, or the thing itself written in place.
Reference = Annotated[
    Annotated[str, Tag("<name>")] | Annotated[Model, Tag("<inline>")],
    Discriminator(lambda value: "<name>" if isinstance(value, str) else "<inline>"),
]
# Options, `true` for the usual ones, `false` or nothing for absent.
Switch = Annotated[
    Annotated[bool | None, Tag("<switch>")] | Annotated[Model, Tag("<options>")],
    Discriminator(lambda value: "<switch>" if value is None or isinstance(value, bool) else "<options>"),
]


def kind_tag(value: Any) -> str | None:
    """Tag of a mapping (or model) that says what it is with its key ``kind``."""
    if isinstance(value, dict):
        return f"<{value.get('kind')}>"
    kind = getattr(value, "kind", None)
    return None if kind is None else f"<{kind}>"


class FileModel(BaseModel):
    """Mapping in a configuration file; keys end in their unit."""

    model_config = ConfigDict(extra="forbid", frozen=True, ser_json_inf_nan="constants")

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
        except ValidationError as error:
            details += [
                _again(found)
                for found in error.errors()
                if not (found["type"] == "missing" and len(found["loc"]) == 1 and found["loc"][0] in excused)
            ]
        if details:
            raise ValidationError.from_exception_data(cls.__name__, details)
        return made

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        """Mapping with short forms written out."""
        return data

    @classmethod
    def _meant(cls, key: str, given: set[str]) -> str | None:
        """Known key that an unknown key was probably meant to be, rather one that is not given yet."""
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


def _again(found: Any) -> InitErrorDetails:
    """An error as it was found, to be raised once more with others."""
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
    """A mistake found by a validator: what is wrong and what is allowed, without file and key."""
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
                    "properties": {"value": plain, "source": {"type": "string"}},
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

    sources: dict[str, Text] = Field({}, description="key without unit -> where its value comes from")

    @classmethod
    def _prepare(cls, data: dict[str, Any]) -> dict[str, Any]:
        plain, sources = _without_sources(data, "")
        if sources and "sources" not in plain:
            plain["sources"] = sources
        return plain


def _without_sources(data: dict[str, Any], owner: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Mapping with each ``{value, source}`` replaced by its value, and the sources by dotted name."""
    plain: dict[str, Any] = {}
    sources: dict[str, Any] = {}
    for key, value in data.items():
        name = f"{owner}{stem_of(key)}"
        if isinstance(value, dict) and set(value) == {"value", "source"}:
            plain[key] = value["value"]
            sources[name] = value["source"]
        elif isinstance(value, dict) and key != "sources":
            plain[key], inner = _without_sources(value, f"{name}.")
            sources |= inner
        else:
            plain[key] = value
    return plain, sources
