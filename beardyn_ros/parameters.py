"""Parameters of a node: declared once from a table, refused with a sentence.

ROS hands a node all overrides that match its name and does not say where they come from. A name under
``/**:`` is meant for many nodes, and those that do not know it have to live with it; a name that is given to
one node itself has to be known.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import yaml

from beardyn_core.base.errors import InputError

PARAMETERS_KEY = "ros__parameters"


@dataclass(frozen=True)
class NodeParameter:
    """One parameter of a node.

    Parameters
    ----------
    name : str
    default : bool, int, float or str
        Its type is the type of the parameter.
    description : str
    unit : str
        '' when it has none.
    minimum, maximum : float or None
        Allowed range, both ends included.
    choices : tuple of str
        Allowed words; empty: any.
    live : bool
        May change while the node runs; otherwise it is read-only.
    """

    name: str
    default: bool | int | float | str
    description: str
    unit: str = ""
    minimum: float | None = None
    maximum: float | None = None
    choices: tuple[str, ...] = ()
    live: bool = False

    @property
    def type_name(self) -> str:
        """Type in the words of a ROS user."""
        return {bool: "bool", int: "integer", float: "double", str: "string"}[type(self.default)]

    def convert(self, value: bool | int | float | str) -> bool | int | float | str:
        """Convert a value to the parameter's type, or raise an `InputError` that says what is allowed."""
        wanted = type(self.default)
        if wanted is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if isinstance(value, bool) and str(value).lower() in self.choices:
            value = str(value).lower()  # YAML reads the word as this
        if type(value) is not wanted:
            raise InputError(
                f"parameter '{self.name}': {value!r} is of type {type(value).__name__}, "
                f"{self.type_name} is needed ({self.description})"
            )
        if self.choices and value not in self.choices:
            raise InputError(
                f"parameter '{self.name}': '{value}' is not allowed, choose one of {', '.join(self.choices)}"
            )
        low, high = self.minimum, self.maximum
        if isinstance(value, (int, float)) and not (
            (low is None or value >= low) and (high is None or value <= high) and isfinite(value)
        ):
            raise InputError(f"parameter '{self.name}': {value} is outside {self.allowed_range}")
        return value

    @property
    def allowed_range(self) -> str:
        """Range and unit as a sentence part."""
        unit = f" {self.unit}" if self.unit else ""
        if self.minimum is not None and self.maximum is not None:
            return f"the range {self.minimum:g} to {self.maximum:g}{unit}"
        if self.minimum is not None:
            return f"the range from {self.minimum:g}{unit} upwards"
        return f"the range up to {self.maximum:g}{unit}" if self.maximum is not None else "no range"


class ParameterValues:
    """Current values by attribute name; follows live changes.

    Parameters
    ----------
    node : rclpy.node.Node
        Its overrides (command line, parameter file) are checked against the table.
    table : sequence of NodeParameter

    Notes
    -----
    A name that the table does not have is an error when it is given to this node itself, by ``-p`` or under
    its own name in a file. Under ``/**:`` it is meant for others, and only reported.

    Raises
    ------
    InputError
        Every unknown name and bad value at once; nothing is declared then.
    """

    def __init__(self, node: Any, table: Sequence[NodeParameter]) -> None:
        from rclpy.parameter import Parameter

        self._table = {parameter.name: parameter for parameter in table}
        self._node = node
        overrides = node._parameter_overrides
        known = ", ".join(sorted(self._table))
        unknown = [name for name in overrides if name not in self._table and not _owned_by_ros(name)]
        own = own_parameters(node.get_fully_qualified_name(), sys.argv) if unknown else set()
        problems = [
            f"node {node.get_name()}: unknown parameter '{name}', known are {known}"
            for name in unknown
            if name in own
        ]
        for parameter in table:
            if parameter.name not in overrides:
                continue
            try:
                value = parameter.convert(overrides[parameter.name].value)
            except InputError as error:
                problems += [f"node {node.get_name()}: {sentence}" for sentence in error.problems]
            else:
                overrides[parameter.name] = Parameter(parameter.name, value=value)
        if problems:
            raise InputError(problems)
        if unknown:
            names = ", ".join(f"'{name}'" for name in unknown)
            node.get_logger().warning(
                f"not a parameter of this node, left to the others that share it: {names}"
            )
        for parameter in table:
            node.declare_parameter(parameter.name, parameter.default, _descriptor(parameter))
        node.add_on_set_parameters_callback(self._check_live_change)

    def is_given(self, name: str) -> bool:
        """Tell whether a parameter was given to the node at its start."""
        return name in self._node._parameter_overrides

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name not in self._table:
            raise AttributeError(name)
        return self._node.get_parameter(name).value

    def _check_live_change(self, changes: Sequence[Any]) -> Any:
        from rcl_interfaces.msg import SetParametersResult

        for change in changes:
            if change.name in self._table:
                try:
                    self._table[change.name].convert(change.value)
                except InputError as error:
                    return SetParametersResult(successful=False, reason=str(error))
        return SetParametersResult(successful=True)


def _owned_by_ros(name: str) -> bool:
    return name == "use_sim_time" or name.startswith(("qos_overrides.", "start_type_description_service"))


def _descriptor(parameter: NodeParameter) -> Any:
    from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

    notes = [f"unit {parameter.unit}"] if parameter.unit else []
    if parameter.choices:
        notes.append("one of " + ", ".join(parameter.choices))
    descriptor = ParameterDescriptor(
        description=parameter.description,
        additional_constraints="; ".join(notes),
        read_only=not parameter.live,
    )
    if parameter.minimum is not None or parameter.maximum is not None:
        low = -1.0e308 if parameter.minimum is None else float(parameter.minimum)
        high = 1.0e308 if parameter.maximum is None else float(parameter.maximum)
        if isinstance(parameter.default, float):
            descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high, step=0.0)]
        else:
            bound = 2**62
            descriptor.integer_range = [
                IntegerRange(from_value=int(max(low, -bound)), to_value=int(min(high, bound)), step=1)
            ]
    return descriptor


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
