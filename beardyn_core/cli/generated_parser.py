"""Parsers of commands from the functions of `beardyn_core.api` that they call.

A function says everything about its parameters once: types, defaults and choices in the signature, words in
the section Parameters of its docstring. From there follow the arguments of the command::

    parser = add_command(subparsers, "train", train)
    add_parameter(parser, train, "axes", "--axes", metavar="AXES")

The first sentence of the words is the help of the argument; what follows it is for Python. The first line of
the docstring is the purpose of the command, the paragraphs before the first section are its description. A
type is that of the command line: `Literal` gives choices, `bool` a flag, a sequence of names one text with
commas, of others an option that is given again; `Path` goes before a text, and objects of Python are left
out. Annotations are read without what a module imports for type checkers alone: no parser loads a library.
"""

from __future__ import annotations

import argparse
import builtins
import inspect
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated as A
from typing import Any, Literal, get_args, get_origin, get_type_hints

from beardyn_core.base.edge import Place, alternatives, kind_of, plain_hint

_SECTION = re.compile(r"^(\w[\w ]*)\n-{3,}$", re.MULTILINE)
_PARAMETER = re.compile(r"^(\w+(?:, \w+)*)(?: :.*)?$")


@dataclass(frozen=True)
class Parameter:
    """A parameter of a function, as a command line can give it."""

    hint: A[Any, "type, with ``None`` where nothing need be given"]
    default: A[Any, "`inspect.Parameter.empty` where it must be given"]
    words: A[str, "in the docstring, all sentences"]

    def help_of(self, keywords: Mapping[str, Any], usual: str = "") -> str:
        """Write its help: the first sentence, with the default where that is not in it."""
        sentence = re.split(r"\.(?:\s+(?=[A-Z`])|$)", self.words, maxsplit=1)[0]
        text, _, default = _plain(sentence).partition("; default ")
        text = text if text[1:2].isupper() else text[:1].lower() + text[1:]
        if keywords.get("action") == "append":
            text += "; may be given again"
        if keywords.get("type") is names:
            text += "; with commas between"
        if keywords.get("required"):
            text += "; no default"
        elif usual or default:
            text += f"; default {usual or default}"
        elif "default" in keywords:
            text += f"; default {_written(keywords['default'])}"
        return text.replace("%", "%%")

    @property
    def keywords(self) -> dict[str, Any]:
        """What `argparse` must know of it; without its name, whatever that is."""
        kinds = alternatives(self.hint)
        if bool in kinds:
            return {"action": "store_true"}
        one = next((each for each in kinds if get_origin(each) is Literal), None)
        if one is not None:
            return {"choices": get_args(one)}
        row = next((each for each in kinds if _is_row(each)), None)
        plain = kinds if row is None else alternatives(get_args(row)[0])
        if row is not None and plain == (str,):
            return {"type": names}
        kind = next((each for each in (float, int, Path) if each in plain), None)
        found: dict[str, Any] = {} if kind is None else {"type": kind}
        return found if row is None else {**found, "action": "append"}


@cache
def parameters_of(function: Callable[..., Any]) -> dict[str, Parameter]:
    """List the parameters of a function by their names."""
    words = _words_of(inspect.getdoc(function) or "")
    function = inspect.unwrap(function)
    names = _Names({**vars(builtins), **vars(sys.modules[function.__module__])})
    hints = get_type_hints(function, {}, names, include_extras=True)
    found = {}
    for name, each in inspect.signature(function).parameters.items():
        if name not in hints:  # the object of a method
            continue
        hint = plain_hint(hints[name])[0]
        found[name] = Parameter(hint, each.default, words.get(name, ""))
    return found


def add_command(
    subparsers: argparse._SubParsersAction[argparse.ArgumentParser],
    name: str,
    function: Callable[..., Any],
    more: str = "",
) -> argparse.ArgumentParser:
    """Add the parser of a command with the purpose and the description of its function.

    Parameters
    ----------
    subparsers : argparse action
        Of `beardyn`.
    name : str
        Of the command.
    function : function
        That the command calls.
    more : str
        What the description says of the command alone.
    """
    text = (inspect.getdoc(function) or "").split("\n\nParameters\n---", maxsplit=1)[0]
    first, _, rest = text.partition("\n\n")
    purpose = _plain(first)
    described = " ".join(each for each in (_plain(rest) or purpose, more) if each)
    purpose = purpose if purpose.endswith("..") else purpose.removesuffix(".")
    return subparsers.add_parser(name, help=purpose[:1].lower() + purpose[1:], description=described)


def add_parameter(
    target: Any,
    function: Callable[..., Any],
    parameter: str,
    *flags: str,
    usual: str = "",
    suffix: str = "",
    **differences: Any,
) -> None:
    """Add an argument of a command from the parameter of a function.

    Parameters
    ----------
    target : argparse parser or group
    function : function
        That has the parameter.
    parameter : str
        Its name there.
    *flags
        Options, ``-o``, ``--output``, or the name of what has a place; by default that of the parameter as an
        option.
    usual : str
        Default of the command in words, where it differs.
    suffix : str
        What the command says besides.
    **differences
        Of the command from the function: ``metavar``, ``nargs``, ``required``, and what else argparse takes.
    """
    known = parameters_of(function)[parameter]
    flags = flags or (flag(parameter),)
    keywords = known.keywords
    if "nargs" in differences:
        keywords.pop("action", None)
    if flags[0].startswith("-") and "required" not in differences and keywords.get("action") != "store_true":
        default = None if known.default is inspect.Parameter.empty else known.default
        keywords["default"] = list(default or ()) if keywords.get("action") == "append" else default
    keywords |= differences
    target.add_argument(*flags, **{"help": known.help_of(keywords, usual) + suffix, **keywords})


def add_field(target: Any, place: Place, suffix: str = "", **differences: Any) -> None:
    """Add an option from the field of a dataclass that is written at the edge: unit, limits, words, default.

    Parameters
    ----------
    target : argparse parser or group
    place : Place
        Of the field.
    suffix : str
        What the command says besides.
    **differences
        Of the command from the field, as argparse takes them.
    """
    kind = kind_of(place)
    unit = place.key.rpartition("_")[2] if place.at.unit else place.field.rpartition("_")[2]
    allowed = [each for each in place.at.one_of if each]
    words = place.words if "default" in place.words else f"{place.words}; default {_usual(place)}"
    words += f"; one of {', '.join(allowed)}" if allowed else ""
    keywords = {
        "metavar": "N" if kind is int else unit.upper(),
        "type": kind,
        "help": f"{words}{suffix}".replace("%", "%%"),
        **differences,
    }
    target.add_argument(flag(place.key), **keywords)


def flag(key: str) -> str:
    """Write the option of a key."""
    return f"--{key.lower().replace('_', '-')}"


def _usual(place: Place) -> str:
    if not isinstance(place.default, int | float) or place.at.absent:
        return "none"
    return f"{place.at.scale.to_edge(place.default) if place.at.unit else place.default:g}"


def names(text: str | None) -> list[str] | None:
    """Split names with commas between them; ``None`` where there is no option."""
    return None if text is None else [name.strip() for name in text.split(",")]


class _Names(dict[str, Any]):
    """What names of an annotation stand for; one that is imported for a type checker alone for itself."""

    def __missing__(self, name: str) -> type:
        return type(name, (), {})


def _is_row(hint: Any) -> bool:
    """Tell whether a type is a sequence of others."""
    return isinstance(origin := get_origin(hint), type) and issubclass(origin, Sequence)


def _words_of(docstring: str) -> dict[str, str]:
    """List the words of the parameters in a docstring by their names."""
    sections = _SECTION.split(docstring)
    text = dict(zip(sections[1::2], sections[2::2], strict=True)).get("Parameters", "")
    found: dict[str, list[str]] = {}
    names: list[str] = []
    for line in text.splitlines():
        if match := _PARAMETER.match(line):
            names = match[1].split(", ")
        for name in names if line.startswith(" ") else ():
            found.setdefault(name, []).append(line.strip())
    return {name: " ".join(lines) for name, lines in found.items()}


def _plain(text: str) -> str:
    """Write a sentence of a docstring for the terminal: a function that is a command is called that."""
    from beardyn_core.cli.main import command_names

    text = " ".join(text.split())
    known = command_names()
    text = re.sub(
        r"(?<!`)`(\w+)`(?!`)", lambda m: f"`beardyn {m[1]}`" if m[1] in known else f"`{m[1]}`", text
    )
    return re.sub(r"``([^`\s]+)``", r"\1", text).replace("``", "`")


def _written(default: Any) -> str:
    """Write a default for the help."""
    if default is None or default in ("", (), []):
        return "none"
    return f"{default:g}" if isinstance(default, int | float) else str(default)
