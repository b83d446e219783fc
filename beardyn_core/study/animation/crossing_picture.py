"""Rollers that cross a spall: cross-section, close-up, roller loads, and the vibration with the strikes."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from scipy.signal import butter, sosfiltfilt

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.monitor.chain import MonitorSettings
from beardyn_core.monitor.streaming import measured_axes
from beardyn_core.record.arrays import Signal
from beardyn_core.record.load_colours import SPALL_COLOUR
from beardyn_core.record.run import Run
from beardyn_core.sensors.summary import SETTLING_S
from beardyn_core.study.animation.cross_section import CrossSection, rgb
from beardyn_core.study.animation.moving_figure import MovingFigure, mean_load, new_figure, slowness
from beardyn_core.study.animation.row_motion import RowMotion
from beardyn_core.study.animation.spall_close_up import SpallCloseUp
from beardyn_core.study.animation.spall_passages import (
    Passages,
    chosen_window,
    passages,
    ring_spalls,
    shown_spall,
)

SHOWN = 3  # passages
_AXES = "xyz"
_LINE = "#1f4e79"
_KILO = 1e-3
_MS = 1e3
_PADDING_S = 0.05  # next to the window, for the filter


def crossing_picture(run: Run, at: float | None, seconds: float) -> MovingFigure:
    """Draw three rollers that cross the spall, the most loaded one in the middle.

    Parameters
    ----------
    run : Run
    at : float or None
        From where on such rollers are looked for, [s]; ``None``: after the start has settled.
    seconds : float
        How long the picture takes, for its caption.

    Raises
    ------
    InputError
        The recording has no spall of a ring or no vibration, or too few rollers cross the spall.
    """
    spall = shown_spall(run)
    if not len(run.vibration):
        raise InputError(f"{run.label}: --of crossing shows vibration, and the recording has none")
    motion = RowMotion.of(run, spall.row)
    low, high = motion.span
    searched = min(low + SETTLING_S, 0.5 * (low + high)) if at is None else max(at, low)
    begin, end = chosen_window(run, motion, spall, searched, SHOWN)
    largest = float(motion.load.max(initial=0.0))
    shape = run.described().shape
    figure = new_figure(run, motion.row)
    near = [each for each in ring_spalls(run.described()) if each.row == motion.row]
    section_axes = figure.add_axes((0.01, 0.375, 0.46, 0.54))
    section = CrossSection(section_axes, shape, motion, largest, near)
    section.draw_load(section_axes, mean_load(run, begin, end))
    close_up = SpallCloseUp(figure.add_axes((0.50, 0.46, 0.475, 0.41)), shape, motion, largest, spall)
    loads = figure.add_axes((0.07, 0.235, 0.91, 0.115))
    trace = figure.add_axes((0.07, 0.085, 0.91, 0.135), sharex=loads)
    found = passages(motion, spall)
    shown = np.flatnonzero((found.time >= begin) & (found.time <= end))
    _draw_loads(loads, motion, found, begin, end)
    time, band, caption = _trace(run.vibration, begin, end)
    _draw_trace(trace, time, band, begin, end, caption)
    for each in shown:
        for axes in (loads, trace):
            axes.axvline(_MS * found.time[each], color=rgb(SPALL_COLOUR), lw=1.0, ls=":")
        text = f" roller {found.roller[each]} over the spall"
        style: dict[str, Any] = {"fontsize": 7, "va": "top", "color": rgb(SPALL_COLOUR)}
        loads.text(_MS * found.time[each], 0.98, text, transform=loads.get_xaxis_transform(), **style)
    (past,) = trace.plot([], [], color=_LINE, lw=0.9)
    (cursor,) = trace.plot([], [], color="0.3", lw=1.0)
    (above,) = loads.plot([], [], color="0.3", lw=1.0)
    clock = figure.text(0.975, 0.925, "", fontsize=8, ha="right", va="top", color="0.3")
    slow = slowness(begin, end, seconds)

    def show(now: float) -> None:
        moment = motion.at(now)
        section.show(moment)
        close_up.show(moment)
        gone = int(np.searchsorted(time, now, side="right"))
        past.set_data(_MS * time[:gone], band[:gone])
        cursor.set_data([_MS * now, _MS * now], trace.get_ylim())
        above.set_data([_MS * now, _MS * now], loads.get_ylim())
        clock.set_text(f"t = {now:.4f} s, {slow}")

    parts = [*section.moving, *close_up.moving, past, cursor, above, clock]
    return MovingFigure(figure, parts, show, begin, end, f"{SHOWN} rollers that cross the spall")


def _draw_loads(axes: Axes, motion: RowMotion, found: Passages, begin: float, end: float) -> None:
    """Draw the load of each roller while it passes, with the samples that the recording has."""
    shown = np.flatnonzero((found.time >= begin) & (found.time <= end))
    reach = 0.5 * (end - begin) / SHOWN
    lowest, highest = np.inf, 0.0
    for each in shown:
        first, last = (float(found.time[each]) + side * reach for side in (-1.0, 1.0))
        near = motion.time[(motion.time > first) & (motion.time < last)]
        times = np.concatenate(([first], near, [last]))
        load = _KILO * np.array([motion.at(float(time)).load[found.roller[each]] for time in times])
        axes.plot(_MS * times, load, color=_LINE, lw=1.0)
        lowest, highest = min(lowest, float(load.min())), max(highest, float(load.max()))
    margin = 0.2 * (highest - lowest) or 1.0
    axes.set(xlim=(_MS * begin, _MS * end), ylim=(max(lowest - margin, 0.0), highest + 2.5 * margin))
    axes.tick_params(labelsize=8, labelbottom=False)
    _dress(axes, "roller load", "kN")


def _dress(axes: Axes, caption: str, unit: str) -> None:
    axes.set_ylabel(unit, fontsize=8)
    style: dict[str, Any] = {"fontsize": 7, "va": "top", "color": "0.3", "transform": axes.transAxes}
    axes.text(0.005, 0.95, caption, **style)
    axes.grid(alpha=0.3)


def _trace(vibration: Signal, begin: float, end: float) -> tuple[Float, Float, str]:
    """Take one axis around the window, z where it is measured, in the band that the monitor looks at.

    Returns
    -------
    time : array, shape [sample]
        [s].
    values : array, shape [sample]
        [m/s^2].
    caption : str
        Axis and band.
    """
    near = (vibration.time >= begin - _PADDING_S) & (vibration.time <= end + _PADDING_S)
    time, values = vibration.time[near], vibration.values[near]
    measured = [name for column, name in enumerate(_AXES) if np.isfinite(values[:, column]).all()]
    if len(time) < 16 or not measured or measured_axes(values).shape[1] == 0:
        raise InputError("the vibration has gaps around the crossing; choose another time with --at")
    axis = "z" if "z" in measured else measured[0]
    signal, rate = values[:, _AXES.index(axis)], vibration.rate
    low, high = MonitorSettings().band[0], min(MonitorSettings().band[1], 0.45 * rate)
    caption = f"vibration {axis}"
    if low < 0.8 * high:
        signal = sosfiltfilt(butter(4, (low, high), "bandpass", fs=rate, output="sos"), signal)
        caption = f"vibration {axis}, {1e-3 * low:g} to {1e-3 * high:g} kHz"
    shown = (time >= begin) & (time <= end)
    return time[shown], np.asarray(signal)[shown], caption


def _draw_trace(axes: Axes, time: Float, band: Float, begin: float, end: float, caption: str) -> None:
    axes.plot(_MS * time, band, color="0.82", lw=0.8)
    reach = 1.3 * float(np.abs(band).max(initial=0.0)) or 1.0
    axes.set(xlim=(_MS * begin, _MS * end), ylim=(-reach, reach))
    axes.set_xlabel("time [ms]", fontsize=8)
    axes.tick_params(labelsize=8)
    _dress(axes, caption, "m/s²")
