"""Plots of runs, recordings and static solutions, each on axes that it returns.

Every function takes ``ax=None``, axes to draw on, and draws on new ones otherwise. They need matplotlib
(``pip install 'beardyn[plot]'``), which is imported when the first of them is called.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from numbers import Real
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from beardyn_core.api.plot_sources import bearing_signal, rollers_on_cup, run_from, vibration_of
from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from beardyn_core.api.statics import Load
    from beardyn_core.base.arrays import Float
    from beardyn_core.bearing.kinematics import FaultFrequencies
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.physics.statics.static import StaticSolution
    from beardyn_core.record.run import Run

__all__ = ["envelope_spectrum", "load_zone", "spectrum", "stiffness_curve", "torque_curve", "waterfall"]

_AXES = ("x", "y", "z")
_SEGMENT_S = 1.0  # of the parts of a spectrum, which then has lines of 1 Hz
_PARTS = 8  # that overlap by half, at least: of fewer the lines scatter too much to be read
_SPEEDING = 1.05  # fastest over slowest speed from which a run is drawn over its speed
_SAME_SPEED = 2e-3  # of the fastest, below which two segments are drawn as one
_END_PLAYS_MM = tuple(np.round(np.linspace(-0.1, 0.3, 9), 3).tolist())
_CLEARANCES_MM = tuple(np.round(np.linspace(0.0, 0.24, 9), 3).tolist())
_SPEEDS_RPM = tuple(np.linspace(100.0, 1500.0, 15).tolist())


def load_zone(
    source: Run | StaticSolution | Path | str,
    *,
    at: float | None = None,
    pressure: bool = False,
    ax: Axes | None = None,
) -> Axes:
    """Plot the load of every roller on the cup over its azimuth.

    Parameters
    ----------
    source : Run, StaticSolution, Path or str
        A simulated run or its recording, or what `equilibrium` gives.
    at : float, optional
        Moment of the run, s; default all of it after the start has settled.
    pressure : bool
        Plot the largest Hertz pressure of the cup in place of the load.
    ax : polar axes, optional

    Returns
    -------
    matplotlib.axes.Axes
        Azimuth 0 is up (+z), azimuth 90 degrees is forward (+x).

    Raises
    ------
    InputError
        The run has no contacts, as a measured one.
    """
    draw = _drawing()
    azimuth, load, stress = rollers_on_cup(source, at)
    values = (
        (stress * 1e-9, "Hertz pressure on the cup", "GPa") if pressure else (load * 1e-3, "Load zone", "kN")
    )
    axes = draw.polar(ax)
    draw.draw_load_zone(axes, azimuth, *values)
    return axes


def spectrum(
    source: Run | Path | str,
    *,
    axes: str = "xyz",
    sensor: str = "",
    highest_Hz: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Plot the spectrum of the acceleration.

    Parameters
    ----------
    source : Run, Path or str
        Simulated or measured run, a recording, or a measured file that states its rate and unit. What a file
        lacks is given to `read_measured`.
    axes : str
        Of the accelerometer, such as ``z``; those that were not measured are left out.
    sensor : str, optional
        Accelerometer; by default the first.
    highest_Hz : float, optional
        End of the frequency axis; by default half the sampling rate.
    ax : axes, optional

    Returns
    -------
    matplotlib.axes.Axes
        Amplitude spectral density after Welch: parts of 1 s, of a short run eight that overlap by half.
    """
    from scipy.signal import welch

    draw = _drawing()
    if not axes or set(axes) - set(_AXES):
        raise InputError(f"axes is {axes!r}; give one or more of x, y and z")
    signal = vibration_of(run_from(source), sensor)
    length = min(2 * len(signal) // (_PARTS + 1), round(_SEGMENT_S * signal.rate))
    frequency, power = welch(np.nan_to_num(signal.values), signal.rate, nperseg=length, axis=0)
    known = np.asarray(np.isfinite(signal.values).all(axis=0))
    chosen = [name for name in _AXES if name in axes and known[_AXES.index(name)]]
    if not chosen:
        raise InputError(f"axes is {axes!r}; the run has {', '.join(np.array(_AXES)[known])}")
    shown = _lines_up_to(frequency, highest_Hz)
    place = draw.cartesian(ax)
    densities = {name: np.sqrt(power[shown, _AXES.index(name)]) for name in chosen}
    draw.draw_spectrum(place, frequency[shown], densities)
    return place


def envelope_spectrum(
    source: Run | Path | str,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    harmonics: int = 3,
    ax: Axes | None = None,
) -> Axes:
    """Plot the order spectrum of the envelope with labelled fault orders: BPFO, BPFI, 2 BSF, FTF.

    Parameters
    ----------
    source : Run, Path or str
        As of `spectrum`, with vibration and shaft angle.
    bearing : bearing, NamePlate or str, optional
        By default that of the run.
    sensor : str, optional
        Accelerometer; by default the first, or the one of the bearing of a measured run.
    harmonics : int
        Multiples of each order that are marked. A spalled roller strikes at 2 BSF.
    ax : axes, optional

    Returns
    -------
    matplotlib.axes.Axes
        Level over the background by cycles per shaft revolution; band of the envelope and order tracking are
        those of the monitor.

    Raises
    ------
    InputError
        The run has too few revolutions of the shaft, or does not name its bearing.
    """
    from dataclasses import replace

    from beardyn_core.record.envelope_spectrum import envelope_order_spectrum

    draw = _drawing()
    if harmonics < 1:
        raise InputError(f"harmonics is {harmonics}; give 1 or more")
    run = run_from(source)
    if len(run.shaft) < 2:
        raise InputError(
            f"{run.label}: has no speed of the shaft; bd.read_measured(file, speed_rpm=...) reads a measured "
            "file with it"
        )
    measured = bearing_signal(run, bearing, sensor)
    orders = _orders(measured.frequencies)
    highest = (harmonics + 0.3) * max(value for value in orders.values() if np.isfinite(value))
    signal = measured.signal
    known = np.isfinite(signal.values).all(axis=0)
    found = envelope_order_spectrum(
        replace(signal, values=signal.values[:, known]), measured.run.shaft, highest
    )
    if found is None:
        raise InputError(
            f"{measured.run.label}: no envelope spectrum; the shaft must turn four times or more, one way"
        )
    place = draw.cartesian(ax)
    draw.draw_envelope_spectrum(place, found.order, found.level, orders, harmonics)
    return place


def waterfall(
    source: Run | Path | str,
    *,
    axis: str = "z",
    sensor: str = "",
    bearing: RollerBearing | NamePlate | str | None = None,
    highest_Hz: float | None = None,
    segment_s: float = 0.2,
    ax: Axes | None = None,
) -> Axes:
    """Plot the spectrum of the acceleration over the speed of a run-up, or over time.

    Parameters
    ----------
    source : Run, Path or str
        As of `spectrum`.
    axis : str
        ``x``, ``y`` or ``z`` of the accelerometer.
    sensor, bearing : optional
        As in `envelope_spectrum`; fault frequencies are drawn where the bearing is known.
    highest_Hz : float, optional
        End of the frequency axis; by default half the sampling rate.
    segment_s : float
        Length of each spectrum, s; the next one begins half of it later.
    ax : axes, optional

    Returns
    -------
    matplotlib.axes.Axes
        Over the shaft speed where that only grows or only falls by 5 % or more, else over the time.
    """
    from scipy.signal import spectrogram

    draw = _drawing()
    if axis not in _AXES:
        raise InputError(f"axis is {axis!r}; allowed are x, y, z")
    run = run_from(source)
    try:
        measured = bearing_signal(run, bearing, sensor)
        signal, orders = measured.signal, _orders(measured.frequencies)
    except InputError:
        if bearing is not None:
            raise
        signal, orders = vibration_of(run, sensor), {}
    values = signal.values[:, _AXES.index(axis)]
    length = round(segment_s * signal.rate)
    if not np.isfinite(values).all() or not 16 <= length <= len(values):
        raise InputError(
            f"axis {axis} of {run.label} cannot be drawn: it was not measured, or segment_s ({segment_s:g}) "
            f"is not between 16 samples and the run ({len(values) / signal.rate:g} s)"
        )
    frequency, moment, power = spectrogram(values, signal.rate, nperseg=length, noverlap=length // 2)
    moment = moment + float(signal.time[0])
    shown = _lines_up_to(frequency, highest_Hz)
    density, frequency = np.sqrt(power[shown].T), frequency[shown]
    rpm = _mean_rpm(run, moment, segment_s)
    place, label = moment, "time [s]"
    kept = None if rpm is None else _places_of_run_up(rpm)
    if rpm is not None and kept is not None:
        place, label, density, rpm = rpm[kept], "shaft speed [rpm]", density[kept], rpm[kept]
    lines = {} if rpm is None else {name: each * rpm / 60.0 for name, each in orders.items() if each == each}
    chosen = draw.cartesian(ax)
    draw.draw_waterfall(chosen, frequency, place, density, label, lines)
    return chosen


def stiffness_curve(
    bearing: RollerBearing | str,
    load_kN: Load = 80.0,
    *,
    end_play_mm: float | Sequence[float] | None = None,
    radial_clearance_mm: Sequence[float] | None = None,
    ax: Axes | None = None,
    **options: Any,
) -> Axes:
    """Plot the stiffness of a bearing along x, y and z against its end play or its radial clearance.

    Parameters
    ----------
    bearing, load_kN
        See `equilibrium`.
    end_play_mm : sequence of float, optional
        Negative for preload. Default -0.1 to 0.3 of tapered bearings. A number where the stiffness is plotted
        against ``radial_clearance_mm``.
    radial_clearance_mm : sequence of float, optional
        Of cylindrical and spherical bearings, default 0 to 0.24.
    ax : axes, optional
    **options
        Of `beardyn_core.stiffness`.

    Returns
    -------
    matplotlib.axes.Axes
    """
    from beardyn_core.api.making import bearing as bearing_of
    from beardyn_core.api.statics import stiffness
    from beardyn_core.bearing.geometry import Bearing

    draw = _drawing()
    given: dict[str, Any] = {"end_play_mm": end_play_mm, "radial_clearance_mm": radial_clearance_mm}
    given = {key: value for key, value in given.items() if value is not None}
    if given:
        name, values = list(given.items())[-1]
    elif isinstance(bearing_of(bearing), Bearing):
        name, values = "end_play_mm", _END_PLAYS_MM
    else:
        name, values = "radial_clearance_mm", _CLEARANCES_MM
    if np.ndim(values) != 1 or len(values) < 2:
        raise InputError(f"{name} is {values!r}; give two numbers or more")
    given[name] = list(values)
    found = np.asarray(stiffness(bearing, load_kN, **given, **options))
    place = draw.cartesian(ax)
    words = f"{name.removesuffix('_mm').replace('_', ' ')} [mm]"
    draw.draw_stiffness(place, np.asarray(values), 1e-6 * np.diagonal(found, axis1=1, axis2=2), words)
    return place


def torque_curve(
    bearing: RollerBearing | str,
    load_kN: Load = 80.0,
    *,
    speed_rpm: Sequence[float] = _SPEEDS_RPM,
    ax: Axes | None = None,
    **options: Any,
) -> Axes:
    """Plot the running torque of raceways and ribs against the speed.

    Parameters
    ----------
    bearing, load_kN
        See `equilibrium`.
    speed_rpm : sequence of float
    ax : axes, optional
    **options
        Of `beardyn_core.torque`.

    Returns
    -------
    matplotlib.axes.Axes
    """
    from beardyn_core.api.statics import torque

    draw = _drawing()
    if np.ndim(speed_rpm) != 1 or len(speed_rpm) < 2:
        raise InputError(f"speed_rpm is {speed_rpm!r}; give two numbers or more")
    found = np.asarray(torque(bearing, list(speed_rpm), load_kN, **options))
    place = draw.cartesian(ax)
    draw.draw_torque(place, np.asarray(speed_rpm), found)
    return place


def _drawing() -> ModuleType:
    """Import what draws."""
    from beardyn_core.base.optional import library

    library("matplotlib", "bd.plot", "plot")
    from beardyn_core.study import plot_axes

    return plot_axes


def _lines_up_to(frequency: Float, highest_Hz: float | None) -> slice:
    """Choose the lines of a spectrum to draw, without the one at 0 Hz; refuse an end below the first."""
    if highest_Hz is None:
        return slice(1, None)
    if not isinstance(highest_Hz, Real) or not highest_Hz >= frequency[1]:
        raise InputError(f"highest_Hz is {highest_Hz!r}; give a frequency of {frequency[1]:.3g} Hz or more")
    return slice(1, int(np.searchsorted(frequency, highest_Hz, side="right")))


def _orders(frequencies: FaultFrequencies) -> Mapping[str, float]:
    """Name the orders of a bearing as they are drawn."""
    return {
        "BPFO": frequencies.bpfo,
        "BPFI": frequencies.bpfi,
        "2 BSF": 2.0 * frequencies.bsf,
        "FTF": frequencies.ftf,
    }


def _mean_rpm(run: Run, moment: Float, segment_s: float) -> Float | None:
    """Average the shaft speed over the segments around some moments, [rpm]; ``None`` without a shaft."""
    shaft = run.shaft
    if len(shaft) < 2:
        return None
    half = 0.5 * segment_s
    turned = np.interp(moment + half, shaft.time, shaft.angle) - np.interp(
        moment - half, shaft.time, shaft.angle
    )
    span = np.minimum(moment + half, shaft.time[-1]) - np.maximum(moment - half, shaft.time[0])
    return np.asarray(np.abs(turned) / np.maximum(span, 1e-9) * (30.0 / np.pi), np.float64)


def _places_of_run_up(rpm: Float) -> NDArray[np.int64] | None:
    """Choose the segments to draw over the speed, slowest first; ``None`` where that comes and goes."""
    if len(rpm) < 3 or float(rpm.max()) <= _SPEEDING * float(rpm.min()):
        return None
    same = _SAME_SPEED * float(rpm.max())
    steps = np.diff(rpm)
    if not (np.all(steps > -same) or np.all(steps < same)):
        return None
    order = np.argsort(rpm, kind="stable")
    kept = [int(order[0])]
    for place in order[1:].tolist():
        if rpm[place] > rpm[kept[-1]] + same:
            kept.append(place)
    return np.array(kept)
