"""YAML in and out: the 1.2 core scalars, duplicate keys refused, faults of syntax as sentences."""

from __future__ import annotations

import re
from collections.abc import Hashable
from copy import deepcopy
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from beardyn_core.base.edge import write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.base.inputs import text_of_file
from beardyn_core.base.outputs import note_read

if TYPE_CHECKING:
    from beardyn_core.scene.scene import Scene


LONGEST_NUMBER = 100  # digits of a whole number; the seeds of NumPy have 39


def _whole_number(node: yaml.Node) -> int:
    digits = len(node.value.lstrip("+-"))
    if digits > LONGEST_NUMBER:
        raise yaml.MarkedYAMLError(
            problem=f"a whole number of {digits} digits; allowed are up to {LONGEST_NUMBER}",
            problem_mark=node.start_mark,
        )
    return int(node.value)


def _float(text: str) -> float:
    special = re.fullmatch(r"([-+]?)\.(inf|nan)", text.lower())
    return float("".join(special.groups()) if special else text)


class _Loader(yaml.SafeLoader):
    """The safe loader without YAML 1.1 surprises.

    ``on`` and ``no`` are words, ``1e-3`` is a number, ``12:30`` is not one, and a key given twice is refused.
    """

    yaml_implicit_resolvers: dict[str, list[tuple[str, re.Pattern[str]]]] = {}  # noqa: RUF012

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        seen: dict[Any, int] = {}
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            line = key_node.start_mark.line + 1
            if not isinstance(key, str):
                raise yaml.MarkedYAMLError(
                    problem=f"the key {key!r} is not a word", problem_mark=key_node.start_mark
                )
            if key in seen:
                raise yaml.MarkedYAMLError(
                    problem=f"the key {key!r} is given twice (first in line {seen[key]})",
                    problem_mark=key_node.start_mark,
                )
            seen[key] = line
        return super().construct_mapping(node, deep=deep)


for _kind, _pattern, _first in (
    ("bool", r"^(?:true|True|false|False)$", list("tTfF")),
    ("null", r"^(?:~|null|Null|NULL|)$", ["~", "n", "N", ""]),
    ("int", r"^[-+]?[0-9]+$", list("-+0123456789")),
    (
        "float",
        r"^(?:[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?|[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))$",
        list("-+0123456789."),
    ),
):
    _Loader.add_implicit_resolver(f"tag:yaml.org,2002:{_kind}", re.compile(_pattern), _first)
_Loader.add_constructor("tag:yaml.org,2002:int", lambda _, node: _whole_number(node))
_Loader.add_constructor("tag:yaml.org,2002:float", lambda _, node: _float(node.value))


class _Dumper(yaml.SafeDumper):
    """The safe dumper that quotes what `_Loader` would read as something else than text."""

    yaml_implicit_resolvers: dict[str, list[tuple[str, re.Pattern[str]]]] = {  # noqa: RUF012
        first: [
            *_Loader.yaml_implicit_resolvers.get(first, []),
            *yaml.SafeDumper.yaml_implicit_resolvers.get(first, []),
        ]
        for first in {*_Loader.yaml_implicit_resolvers, *yaml.SafeDumper.yaml_implicit_resolvers}
    }


# What the safe loader raises on a scalar that is not what its tag says, such as `!!timestamp 2026-99-99`.
_BROKEN_SCALAR = (ValueError, KeyError, TypeError, AttributeError, OverflowError, IndexError)


def read_mapping(text: str, label: str) -> dict[str, Any]:
    """Read the mapping written in a YAML text.

    Parameters
    ----------
    label : str
        What to call the text in a complaint, usually the file's path.

    Raises
    ------
    InputError
        With the line, when the text is not YAML, not a mapping or gives a key twice.
    """
    try:
        data = deepcopy(_data(text))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        where = f", line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        raise InputError(f"{label}{where}: {error.problem or error.context}") from None
    except yaml.YAMLError as error:
        raise InputError(f"{label}: {' '.join(str(error).split())}") from None
    except RecursionError:
        raise InputError(f"{label}: nested too deeply to be read") from None
    except _BROKEN_SCALAR as error:
        raise InputError(f"{label}: a value does not fit its tag ({error}); leave the tag out") from None
    if not isinstance(data, dict):
        found = "empty" if data is None else f"a {type(data).__name__}"
        raise InputError(
            f"{label}: the file is {found}; it must be a mapping of keys to values (`key: value`)"
        )
    return data


@lru_cache(maxsize=128)
def _data(text: str) -> Any:
    """Parse a text once: scenes name the same few bearings, lubricants and effects again and again."""
    return yaml.load(text, Loader=_Loader)  # a subclass of the safe loader


def read_file(path: Path) -> dict[str, Any]:
    """Read the mapping in a YAML file; see `read_mapping`."""
    note_read(path)
    try:
        text = text_of_file(path)
    except UnicodeDecodeError:
        raise InputError(f"{path}: the file is not UTF-8 text") from None
    except OSError as error:
        raise InputError(f"{path}: the file cannot be read ({error.strerror})") from None
    return read_mapping(text, str(path))


def write_mapping(data: dict[str, Any]) -> str:
    """Write a mapping as YAML, keys in their order; `read_mapping` gives the mapping back."""
    return yaml.dump(
        data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, default_flow_style=None, width=110
    )


def scene_text(scene: Scene) -> str:
    """Write a scene as YAML: edge units, every reference resolved, every file.

    Returns
    -------
    str
        `beardyn_core.choice.scene_from_text` makes the same scene of it. A number of which no decimal in edge
        units is the exact value in SI comes back as its neighbour.
    """
    from beardyn_core.config.content import self_contained  # brings numpy along

    return write_mapping(write_noun(self_contained(scene)))
