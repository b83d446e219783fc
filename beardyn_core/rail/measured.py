"""Load and speed from a CSV file or from a recording, and the load history of a run that follows them.

Columns of a CSV file, in any order, named in the first line:

| column | unit | |
|---|---|---|
| `time_s` | s | strictly increasing; the first row is time 0 of the run |
| `speed_rpm` or `shaft_speed_rad_s` | rpm, rad/s | one of the two, unless only the force is taken |
| `fx_N`, `fy_N`, `fz_N` | N | force on the journal, world axes, unless only the speed is taken |
| `mx_Nm`, `my_Nm`, `mz_Nm` | N m | optional, moment on the journal |
| `ux_m`, `uy_m`, `uz_m` | m | optional, displacement of the bogie end of the suspension |

A second line may give the units. Lines that begin with `#` are comments.

A recording (MCAP) gives its ``load/blocks``; else its ``load/wrench`` and ``load/shaft``; else what a twin
measured, ``force`` and ``shaft``.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import note_read
from beardyn_core.rail.table import Column, Layout, read_table
from beardyn_core.scene.load import LoadHistory, sampled_load
from beardyn_core.scene.operation import MeasuredOperation
from beardyn_core.scene.running import speed_at

TIME = "time_s"
SPEEDS = ("speed_rpm", "shaft_speed_rad_s")
FORCES = ("fx_N", "fy_N", "fz_N")
MOMENTS = ("mx_Nm", "my_Nm", "mz_Nm")
BOGIE = ("ux_m", "uy_m", "uz_m")
GAP = (20.0, 0.05)
LARGEST_FORCE = 1e7  # on a journal [N]; an axle load is some 1e5
DOUBTED_FORCE = 1e3  # the journal of an empty wagon carries 2e4 [N]

log = logging.getLogger("beardyn")


@dataclass(frozen=True)
class Measurement:
    """Load and speed of a file, SI, time from its first sample on; zeros for what was not read."""

    time: A[Float, "shape [sample], [s]"]
    wrench: A[Float, "shape [sample, 6], [N, N m]"]
    shaft_speed: A[Float, "shape [sample], [rad/s]"]
    bogie: A[Float, "shape [sample, 3], [m]"]
    stream: A[LoadHistory | None, "the very samples, when they were a stream of load for the twin"] = None


def read_measurement(path: Path, take: str = "both") -> Measurement:
    """Read and check a file of load and speed: a recording when it ends in ``.mcap``, else a CSV file.

    Parameters
    ----------
    take : str
        ``both``, ``force`` or ``speed``: what must be there.

    Raises
    ------
    InputError
        With everything that is wrong with the file, each with its line numbers.
    """
    path = Path(path)
    note_read(path)
    try:
        changed = path.stat().st_mtime_ns
    except OSError:
        changed = 0  # the reader says it better
    return _read(path, take, changed)


@lru_cache(maxsize=4)
def _read(path: Path, take: str, changed: int) -> Measurement:
    """Read a file, and cache it, because one scene needs it several times."""
    if path.suffix.lower() == ".mcap":
        # that room builds upon this one: it is named, not imported
        recorded: Measurement = import_module("beardyn_core.record.load_reading").read_recorded_load(
            path, take
        )
        return recorded
    return _read_csv(path, take)


def _read_csv(path: Path, take: str) -> Measurement:
    wanted = take != "speed"
    layout = Layout(
        what="load and speed" if take == "both" else take,
        columns=(
            Column(TIME, "s"),
            Column("speed_rpm", "rpm", needed=False),
            Column("shaft_speed_rad_s", "rad/s", needed=False),
            *(Column(name, "N", needed=wanted) for name in FORCES),
            *(Column(name, "Nm", needed=False) for name in MOMENTS),
            *(Column(name, "m", needed=False) for name in BOGIE),
        ),
        ascending=TIME,
        gap=GAP,
        one_of=() if take == "force" else (SPEEDS,),
    )
    table = read_table(path, layout)
    nothing = np.zeros(len(table[TIME]))

    def column(name: str) -> Float:
        return table.get(name, nothing)

    _check_forces(path, table)
    speed = column("speed_rpm") * (np.pi / 30.0) if "speed_rpm" in table else column("shaft_speed_rad_s")
    return Measurement(
        time=column(TIME) - column(TIME)[0],
        wrench=np.column_stack([column(name) for name in (*FORCES, *MOMENTS)]),
        shaft_speed=speed,
        bogie=np.column_stack([column(name) for name in BOGIE]),
    )


def _check_forces(path: Path, table: dict[str, Float]) -> None:
    """Refuse forces that no axle has, and warn of those so small that they may be in another unit."""
    forces = {name: np.abs(table[name]).max() for name in FORCES if name in table}
    if not forces:
        return
    name = max(forces, key=lambda each: forces[each])
    if forces[name] > LARGEST_FORCE:
        row = int(np.abs(table[name]).argmax())
        raise InputError(
            f"{path}: {name} is {table[name][row]:.4g} at {table[TIME][row]:g} s; allowed is up to "
            f"{LARGEST_FORCE:g} N either way: check the unit"
        )
    if 0.0 < forces[name] < DOUBTED_FORCE:
        log.warning(
            "warning: %s: %s is the largest force and never exceeds %.4g N, too little for a railway axle: "
            "should the numbers be kN, multiply them by 1000",
            path,
            name,
            forces[name],
        )


def speed_points(path: Path, wheel_diameter: float, spacing: float = 0.02) -> tuple[tuple[float, float], ...]:
    """Compute the speed profile, [s], [m/s], of a vehicle from the measured speed of its shaft.

    On wheels of a diameter [m], the measured speed averaged over a spacing [s].

    Raises
    ------
    InputError
        The file is bad, or no railway is that fast.
    """
    measured = read_measurement(path, "speed")
    speed = 0.5 * wheel_diameter * measured.shaft_speed
    if np.abs(speed).max() > 400.0 / 3.6:
        raise InputError(
            f"{path}: the speed reaches {3.6 * np.abs(speed).max():.4g} km/h on a wheel of "
            f"{1e3 * wheel_diameter:g} mm; allowed is up to 400 km/h: correct the file or the wheel"
        )
    bin_of = np.floor(measured.time / spacing).astype(np.int64)
    first = np.flatnonzero(np.concatenate(([True], np.diff(bin_of) > 0)))
    count = np.diff(np.append(first, len(speed)))
    mean_time = np.add.reduceat(measured.time, first) / count
    mean_speed = np.add.reduceat(speed, first) / count
    return tuple(zip(mean_time.tolist(), mean_speed.tolist(), strict=True))


def replay_load(operation: MeasuredOperation, count: int, rate: float) -> LoadHistory:
    """Read the load of a file in a number of samples at a rate [Hz], and add the parts that are modelled.

    A recorded stream of load that is taken whole is passed on sample by sample, at its own rate. Raises
    `InputError` when the run is longer.
    """
    measured = read_measurement(operation.path, operation.take)
    end = (count - 1) / rate
    if measured.time[-1] < end - 1e-9:
        raise InputError(
            f"{operation.path}: covers {measured.time[-1]:g} s; the run needs {end:g} s: "
            f"shorten the duration or give a longer file"
        )
    if operation.take == "both" and measured.stream is not None:
        return measured.stream.until(round(end * 1e9))
    signals = _resample_load(measured, count, rate)
    time = np.arange(count) / rate
    wrench, shaft_speed, bogie = signals[:, :6], signals[:, 6], signals[:, 7:]
    if operation.take == "force":
        shaft_speed = speed_at(operation.speed_profile, time) / (0.5 * operation.wheel_diameter)
    if operation.take == "speed":
        assert operation.force is not None
        wrench = np.tile(np.array([*operation.force, 0.0, 0.0, 0.0]), (count, 1))
        bogie = np.zeros((count, 3))
    return sampled_load(wrench, shaft_speed, bogie, round(1e9 / rate))


def _resample_load(measured: Measurement, count: int, rate: float) -> Float:
    # compiled: not for who reads files
    from beardyn_core.base.low_pass import decimate, thinning_kernel
    from beardyn_core.scene.band_limited import interpolate_columns

    signals = np.column_stack([measured.wrench, measured.shaft_speed, measured.bogie])
    factor = int(np.ceil(round(1.0 / (rate * float(np.median(np.diff(measured.time)))), 6)))
    grid_ns = np.arange((count - 1) * factor + 1, dtype=np.float64) * (1e9 / (rate * factor))
    time_ns = np.round(measured.time * 1e9).astype(np.int64)
    signals = interpolate_columns(time_ns, signals, 0, grid_ns)
    if factor <= 1:
        return signals
    kernel = thinning_kernel(factor)
    return np.column_stack([decimate(column, factor, kernel) for column in signals.T])
