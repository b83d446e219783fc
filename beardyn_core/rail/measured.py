"""Load and speed from a CSV file.

Columns, in any order, named in the first line:

| column | unit | |
|---|---|---|
| `time_s` | s | strictly increasing; the first row is time 0 of the run |
| `speed_rpm` or `shaft_speed_rad_s` | rpm, rad/s | one of the two |
| `fx_N`, `fy_N`, `fz_N` | N | force on the journal, world axes |
| `mx_Nm`, `my_Nm`, `mz_Nm` | N m | optional, moment on the journal |
| `ux_m`, `uy_m`, `uz_m` | m | optional, displacement of the bogie end of the suspension |

Lines that begin with `#` are comments.
"""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from beardyn_core.errors import InputError

Float = NDArray[np.float64]

TIME = "time_s"
SPEEDS = ("speed_rpm", "shaft_speed_rad_s")
FORCES = ("fx_N", "fy_N", "fz_N")
MOMENTS = ("mx_Nm", "my_Nm", "mz_Nm")
BOGIE = ("ux_m", "uy_m", "uz_m")
COLUMNS = (TIME, *SPEEDS, *FORCES, *MOMENTS, *BOGIE)

_SHOWN = 5
_GAP_RATIO = 20.0
_GAP_LEAST = 0.05


@dataclass(frozen=True)
class Measurement:
    """What a CSV file holds, SI, time from its first row on.

    Parameters
    ----------
    time : float64 array, shape [sample]
        [s].
    wrench : float64 array, shape [sample, 6]
        [N, N m].
    shaft_speed : float64 array, shape [sample]
        [rad/s].
    bogie : float64 array, shape [sample, 3]
        [m].
    """

    time: Float
    wrench: Float
    shaft_speed: Float
    bogie: Float


def read_measurement(path: Path) -> Measurement:
    """Read and check a CSV file of load and speed.

    Parameters
    ----------
    path : Path

    Returns
    -------
    Measurement

    Raises
    ------
    InputError
        With everything that is wrong with the file, each with its line numbers.
    """
    path = Path(path)
    names, lines, rows = _read_rows(path)
    problems = _header_problems(path, names)
    problems += _ragged_problems(path, names, lines, rows)
    if not rows:
        problems.append(f"{path}: no rows after the header; at least two are needed")
    if problems:
        raise InputError(problems)
    table, problems = _numbers(path, names, lines, rows)
    if not problems:
        problems = _time_problems(path, np.asarray(lines), table[:, names.index(TIME)])
    if problems:
        raise InputError(problems)

    def column(name: str) -> Float:
        return table[:, names.index(name)] if name in names else np.zeros(len(table))

    speed = column("speed_rpm") * (np.pi / 30.0) if "speed_rpm" in names else column("shaft_speed_rad_s")
    return Measurement(
        time=column(TIME) - column(TIME)[0],
        wrench=np.column_stack([column(name) for name in (*FORCES, *MOMENTS)]),
        shaft_speed=speed,
        bogie=np.column_stack([column(name) for name in BOGIE]),
    )


def _read_rows(path: Path) -> tuple[list[str], list[int], list[list[str]]]:
    lines: list[int] = []
    rows: list[list[str]] = []
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file)
            for row in reader:
                if row and not row[0].lstrip().startswith("#"):
                    lines.append(reader.line_num)
                    rows.append(row)
    except FileNotFoundError:
        raise InputError(f"{path}: no such file; give the path of a CSV file of load and speed") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: the file is not UTF-8 text; save it as UTF-8") from None
    except (OSError, csv.Error) as error:
        raise InputError(f"{path}: cannot be read as CSV text: {error}") from None
    if not rows:
        raise InputError(f"{path}: the file is empty; the first line must name columns: {', '.join(COLUMNS)}")
    return [name.strip() for name in rows[0]], lines[1:], rows[1:]


def _header_problems(path: Path, names: list[str]) -> list[str]:
    allowed = f"allowed are {', '.join(COLUMNS)}"
    problems = [f"{path}: unknown column {name!r}; {allowed}" for name in names if name not in COLUMNS]
    problems += [f"{path}: column {name!r} appears twice" for name in COLUMNS if names.count(name) > 1]
    problems += [
        f"{path}: column {name!r} is missing; {allowed}" for name in (TIME, *FORCES) if name not in names
    ]
    speeds = [name for name in SPEEDS if name in names]
    if len(speeds) != 1:
        problems.append(
            f"{path}: {'both speed columns are' if speeds else 'no speed column is'} there; give exactly one "
            f"of {', '.join(SPEEDS)}"
        )
    return problems


def _ragged_problems(path: Path, names: list[str], lines: list[int], rows: list[list[str]]) -> list[str]:
    ragged = [line for line, row in zip(lines, rows, strict=True) if len(row) != len(names)]
    if not ragged:
        return []
    return [f"{path}, {_listed(ragged)}: not {len(names)} values as in the header"]


def _numbers(
    path: Path, names: list[str], lines: list[int], rows: list[list[str]]
) -> tuple[Float, list[str]]:
    try:
        table = np.array(rows, dtype=np.float64)
    except ValueError:
        problems = []
        for index, name in enumerate(names):
            bad = [
                (line, row[index])
                for line, row in zip(lines, rows, strict=True)
                if not _is_number(row[index])
            ]
            if bad:
                found = _listed([line for line, _ in bad])
                problems.append(f"{path}, {found}: {name} is {bad[0][1]!r}; it must be a number")
        return np.empty((0, 0)), problems
    problems = []
    for index, name in enumerate(names):
        bad_rows = np.flatnonzero(~np.isfinite(table[:, index]))
        if len(bad_rows):
            found = _listed([lines[row] for row in bad_rows])
            value = table[bad_rows[0], index]
            problems.append(f"{path}, {found}: {name} is {value}; every value must be finite")
    return table, problems


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _time_problems(path: Path, lines: NDArray[np.int64], time: Float) -> list[str]:
    if len(time) < 2:
        return [f"{path}: only one row; at least two are needed"]
    step = np.diff(time)
    backward = np.flatnonzero(step <= 0.0)
    if len(backward):
        found = _listed([int(line) for line in lines[backward + 1]])
        return [f"{path}, {found}: {TIME} does not increase; rows must be in order of time, none twice"]
    usual = float(np.median(step))
    gaps = np.flatnonzero((step > _GAP_RATIO * usual) & (step > _GAP_LEAST))
    if len(gaps):
        found = _listed([int(line) for line in lines[gaps + 1]])
        return [
            f"{path}, {found}: {TIME} jumps by {step[gaps[0]]:g} s where the usual step is {usual:g} s; "
            f"fill the gap or split the file"
        ]
    return []


def _listed(lines: list[int]) -> str:
    shown = ", ".join(str(line) for line in lines[:_SHOWN])
    more = f" and {len(lines) - _SHOWN} more" if len(lines) > _SHOWN else ""
    return f"line{'s' if len(lines) > 1 else ''} {shown}{more}"
