"""Which parameters were given to one node itself, and which to whoever shares a file or a wildcard.

ROS hands a node all overrides that match its name and does not say where they come from. A name under
``/**:`` is meant for many nodes, and those that do not know it have to live with it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

PARAMETERS_KEY = "ros__parameters"


def own_parameters(full_name: str, words: Sequence[str]) -> set[str]:
    """List the parameters that are given to one node by ``-p`` or under its own name in a file.

    Parameters
    ----------
    full_name : str
        Namespace and name of the node, ``/axlebox/twin``.
    words : sequence of str
        Arguments of the process.

    Returns
    -------
    set of str
        Without those of sections with a wildcard (``/**:``, ``/*/twin:``).
    """
    found: set[str] = set()
    for option, value in _ros_options(words):
        if option in ("-p", "--param"):
            name = value.partition(":=")[0]
            node, colon, own = name.rpartition(":")
            if not colon or node == full_name.rpartition("/")[2]:
                found.add(own)
        else:
            found |= _own_of_file(Path(value), full_name)
    return found


def _ros_options(words: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Go through the options of parameters inside ``--ros-args ... --``, each with its value."""
    inside = False
    for word, following in zip(words, [*words[1:], ""], strict=True):
        if word in ("--ros-args", "--"):
            inside = word == "--ros-args"
        elif inside and word in ("-p", "--param", "--params-file"):
            yield word, following


def _own_of_file(path: Path, full_name: str) -> set[str]:
    try:
        content = yaml.safe_load(path.read_text())
    except (OSError, ValueError, yaml.YAMLError):
        return set()  # rclpy has refused it already, or reads a dialect of its own
    own = full_name.strip("/")
    return {
        name for node, section in _sections(content, "") if node == own for name in _flat_names(section, "")
    }


def _sections(content: Any, path: str) -> Iterator[tuple[str, Mapping[Any, Any]]]:
    """Go through the parameter sections of a file, each with the node name above it."""
    if not isinstance(content, Mapping):
        return
    for key, below in content.items():
        if key == PARAMETERS_KEY and isinstance(below, Mapping):
            yield path, below
        else:
            yield from _sections(below, f"{path}/{str(key).strip('/')}".strip("/"))


def _flat_names(section: Mapping[Any, Any], prefix: str) -> Iterator[str]:
    for key, value in section.items():
        name = f"{prefix}{key}"
        if isinstance(value, Mapping):
            yield from _flat_names(value, f"{name}.")
        else:
            yield name
