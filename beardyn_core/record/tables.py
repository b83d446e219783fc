"""A run as tables: each signal with its columns, as xarray and as pandas."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import InputError
from beardyn_core.base.optional import library
from beardyn_core.record.arrays import Timed
from beardyn_core.record.encoding import POSE_AXES, TWIST_AXES
from beardyn_core.record.plot_values import BOUNDS
from beardyn_core.scene.load import WRENCH_AXES

if TYPE_CHECKING:
    from beardyn_core.record.run import Run

VIBRATION = "vibration"
VALUE = "value_"
SIGNALS = (
    *(VIBRATION, "force", "force_waveform", "specific_force", "shaft", "torque", "cages", "rollers"),
    *("bodies", "contacts", "load", "temperature"),
)
_AXES = POSE_AXES[:3]


_CONTACT = ("row", "roller", "kind")
# the arrays of a signal that has several: axes after the time, unit
_PARTS: dict[str, dict[str, tuple[tuple[str, ...], str]]] = {
    "shaft": {"angle": ((), "rad"), "speed": ((), "rad/s")},
    "cages": {"angle": (("row",), "rad"), "speed": (("row",), "rad/s")},
    "rollers": {"angle": (("row", "roller"), "rad"), "speed": (("row", "roller"), "rad/s")},
    "bodies": {"pose": (("body", "coordinate"), "m, -"), "twist": (("body", "motion"), "m/s, rad/s")},
    "contacts": {
        "point": ((*_CONTACT, "axis"), "m"),
        "force": ((*_CONTACT, "axis"), "N"),
        "slip": (_CONTACT, "m/s"),
        "film": (_CONTACT, "m"),
        "largest": (_CONTACT, "N"),
        "pressure": (_CONTACT, "Pa"),
        "largest_pressure": (_CONTACT, "Pa"),
    },
    "load": {
        "wrench": (("component",), "N, N m"),
        "shaft_speed": ((), "rad/s"),
        "bogie": (("axis",), "m"),
    },
}


@dataclass(frozen=True, eq=False)
class Part:
    """One array of a signal."""

    values: A[NDArray[Any], "shape [time, ...]"]
    dims: A[tuple[str, ...], "names of the axes after the time"]
    unit: str


def signal_names(run: Run) -> tuple[str, ...]:
    """Name the signals of a run; further accelerometers are ``vibration_<sensor>``.

    What monitor and follower published for plots is ``value_<name>``, where a recording has it.
    """
    others = tuple(topic.replace("/", "_") for topic in run.sensor_topics if topic != VIBRATION)
    return (VIBRATION, *others, *SIGNALS[1:], *(f"{VALUE}{name}" for name in run.plot_values))


def signal_of(run: Run, name: str) -> Timed:
    """Give a signal by one of `signal_names`.

    Raises
    ------
    InputError
        There is none of this name.
    """
    known = signal_names(run)
    if name not in known:
        raise InputError(f"signal {name!r} is not one of the run; allowed are {', '.join(known)}")
    if name.startswith(f"{VIBRATION}_"):
        return run.sensor_topics[f"{VIBRATION}/{name.removeprefix(f'{VIBRATION}_')}"]
    if name.startswith(VALUE):
        return run.plot_values[name.removeprefix(VALUE)]
    signal: Timed = getattr(run, name)
    return signal


def parts_of(run: Run, name: str) -> dict[str, Part]:
    """Give the arrays of a signal by their names, with the names of their axes and their units."""
    signal: Any = signal_of(run, name)
    if name in _PARTS:
        return {part: Part(getattr(signal, part), *about) for part, about in _PARTS[name].items()}
    dims = {3: ("axis",), 0: (), len(WRENCH_AXES): ("component",)}[len(signal.components)]
    dims = ("part",) if name == "temperature" else dims
    dims = ("bound",) if name.startswith(VALUE) else dims
    return {"values": Part(signal.values, dims, signal.unit)}


def coordinates_of(run: Run) -> dict[str, tuple[Any, ...]]:
    """Give the labels along each axis that `parts_of` names."""
    rows, rollers = run.rollers.angle.shape[1:]
    return {
        "axis": _AXES,
        "component": WRENCH_AXES,
        "row": tuple(range(rows)),
        "roller": tuple(range(rollers or run.contacts.slip.shape[2])),
        "kind": run.contacts.kinds,
        "body": run.bodies.names,
        "coordinate": POSE_AXES,
        "motion": TWIST_AXES,
        "part": run.temperature.components,
        "bound": BOUNDS,
    }


def columns_of(run: Run, name: str) -> dict[str, NDArray[Any]]:
    """Give a signal as the columns of a table, a row a sample, the time first, [s].

    Names are joined by ``_``: ``ax`` of the vibration, ``speed_0_3`` for row 0, roller 3. Of the contacts
    there is a row for each that touches, with the columns ``row``, ``roller`` and ``kind``.
    """
    signal: Any = signal_of(run, name)
    if name == "contacts":
        return _contact_columns(signal)
    columns: dict[str, NDArray[Any]] = {"time": signal.time}
    for part, array in parts_of(run, name).items():
        places = np.ndindex(array.values.shape[1:])
        for column, place in zip(_column_names(run, name, part, array), places, strict=True):
            columns[column] = np.moveaxis(array.values, 0, -1)[place]
    return columns


def units_of(run: Run, name: str) -> dict[str, str]:
    """Give the units of the columns of `columns_of`, where each array of the signal has one unit."""
    if name == "contacts":
        return {}
    units = {"time": "s"}
    for part, array in parts_of(run, name).items():
        for column in _column_names(run, name, part, array):
            if array.unit and "," not in array.unit:
                units[column] = array.unit
    return units


def _column_names(run: Run, name: str, part: str, array: Part) -> list[str]:
    """Name the columns of one array of a signal, in the order of its places."""
    labels = coordinates_of(run)
    own = getattr(signal_of(run, name), "components", ())
    axes = [own] if len(array.dims) == 1 and len(own) == array.values.shape[1] else None
    axes = axes or [labels[dim] for dim in array.dims]
    found = []
    for place in np.ndindex(array.values.shape[1:]):
        words = [str(axis[k]) for axis, k in zip(axes, place, strict=True)]
        stem = [part] if part in ("angle", "speed", "bogie", "shaft_speed") else []
        stem = [name] if part == "values" and not words else stem
        found.append("_".join((*stem, *words)))
    return found


def _contact_columns(contacts: Any) -> dict[str, NDArray[Any]]:
    here = contacts.touching
    snapshot, row, roller, kind = np.nonzero(here)
    columns = {
        "time": contacts.time[snapshot],
        "row": row,
        "roller": roller,
        "kind": np.array(contacts.kinds)[kind],
    }
    columns |= {axis: contacts.point[here][:, k] for k, axis in enumerate(_AXES)}
    columns |= {f"f{axis}": contacts.force[here][:, k] for k, axis in enumerate(_AXES)}
    names = ("slip", "film", "largest", "pressure", "largest_pressure")
    return columns | {name: getattr(contacts, name)[here] for name in names}


def to_pandas(run: Run, signal: str = VIBRATION) -> Any:
    """Give one signal as a ``pandas.DataFrame`` over the time in seconds.

    Parameters
    ----------
    signal : str
        One of `signal_names`; see `columns_of` for the columns.

    Returns
    -------
    pandas.DataFrame
        Its ``attrs`` are the labels of the run.

    Raises
    ------
    InputError
        pandas is not installed, or there is no such signal.
    """
    pandas = library("pandas", "to_pandas", "data")
    frame = pandas.DataFrame(columns_of(run, signal)).set_index("time")
    frame.attrs = labels_of(run)
    return frame


def to_xarray(run: Run) -> Any:
    """Give all signals as an ``xarray.Dataset``.

    Each signal has its own time, ``time_<signal>`` in seconds; the other axes are ``axis``, ``component``,
    ``row``, ``roller``, ``kind``, ``body``, ``coordinate``, ``motion`` and ``part``. A signal of one array
    is a variable of its name, the arrays of others are ``<signal>_<array>``: ``rollers_speed``. The
    attributes are the labels of the run, and ``truth`` as JSON.

    Raises
    ------
    InputError
        xarray is not installed.
    """
    xarray = library("xarray", "to_xarray", "data")
    variables, coordinates = {}, {}
    for name in signal_names(run):
        time = f"time_{name}"
        coordinates[time] = (time, signal_of(run, name).time, {"units": "s"})
        for part, array in parts_of(run, name).items():
            key = name if part == "values" else f"{name}_{part}"
            variables[key] = ((time, *array.dims), array.values, {"units": array.unit})
    used = {dim for dims, *_ in variables.values() for dim in dims}
    labels = {dim: list(names) for dim, names in coordinates_of(run).items() if dim in used}
    return xarray.Dataset(variables, {**coordinates, **labels}, attrs=labels_of(run))


def labels_of(run: Run) -> dict[str, Any]:
    """Give the labels that have a value, and the whole truth as JSON, for attributes of files and tables."""
    labels = {key: value for key, value in run.labels.items() if value is not None}
    return {**labels, "truth": json.dumps(run.truth)}
