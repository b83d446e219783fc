"""From a measured operation to the load history that the twin consumes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from beardyn_core.errors import InputError
from beardyn_core.rail.measured import Measurement, read_measurement
from beardyn_core.scene.load import LoadHistory
from beardyn_core.scene.measured import MeasuredOperation
from beardyn_core.scene.speed import speed_at

Float = NDArray[np.float64]


def replayed(
    operation: MeasuredOperation, count: int, rate: float, thin: Callable[[Float, int], Float]
) -> LoadHistory:
    """Read the load of a file, and add the parts that are modelled.

    A recorded stream of load that is taken whole is passed on sample by sample, at its own rate.

    Parameters
    ----------
    operation : MeasuredOperation
    count : int
        Samples asked for.
    rate : float
        [Hz].
    thin : callable
        Every n-th sample of a signal after a low-pass, of (signal, n).

    Returns
    -------
    LoadHistory

    Raises
    ------
    InputError
        The file is bad or shorter than the run.
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
    signals = _resampled(measured, count, rate, thin)
    time = np.arange(count) / rate
    wrench, shaft_speed, bogie = signals[:, :6], signals[:, 6], signals[:, 7:]
    if operation.take == "force":
        shaft_speed = speed_at(operation.speed_profile, time) / (0.5 * operation.wheel_diameter)
    if operation.take == "speed":
        assert operation.force is not None
        wrench = np.tile(np.array([*operation.force, 0.0, 0.0, 0.0]), (count, 1))
        bogie = np.zeros((count, 3))
    return LoadHistory(
        time_ns=np.arange(count, dtype=np.int64) * round(1e9 / rate),
        wrench=np.ascontiguousarray(wrench),
        shaft_speed=np.ascontiguousarray(shaft_speed),
        bogie=np.ascontiguousarray(bogie),
    )


def _resampled(measured: Measurement, count: int, rate: float, thin: Callable[[Float, int], Float]) -> Float:
    signals = np.column_stack([measured.wrench, measured.shaft_speed, measured.bogie])
    factor = int(np.ceil(round(1.0 / (rate * float(np.median(np.diff(measured.time)))), 6)))
    grid = np.arange((count - 1) * factor + 1) / (rate * factor)
    signals = np.column_stack([np.interp(grid, measured.time, column) for column in signals.T])
    return np.column_stack([thin(column, factor) for column in signals.T]) if factor > 1 else signals
