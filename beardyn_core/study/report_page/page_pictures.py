"""Pictures of a page: spectrum with labelled lines, waveform, levels over files; they differ in grey too."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.chain import MonitorResult
from beardyn_core.monitor.chain.ambiguity import CAGE
from beardyn_core.study.inspection import Inspection
from beardyn_core.study.report_page.file_levels import FileLevel
from beardyn_core.study.report_page.identity import loudest_axis, shaft_frequency, signal_of

SMALL = 6.5  # size of labels, [pt]
_PARTS: dict[str, tuple[str, str, Any]] = {
    "cup": ("BPFO", "#1f4e9c", "-"),
    "cone": ("BPFI", "#c2571a", (0, (5, 2))),
    "roller": ("2 BSF", "#2c7a3f", (0, (2, 1.5))),
}
_SHAFT, _COMB, _INK = "#777777", "#a3123a", "0.1"
_HARMONICS, _SHAFT_MULTIPLES = 5, 3
_FLOOR = -5.0  # [dB]
_LABEL_SHARE = 0.1  # of the height, for a row of labels
_ROWS = 4  # of labels above each other
_BINS = 900  # of a waveform: minimum and maximum of each are drawn
_TURNS = 3.0  # of the shaft in the close-up
_FLOOR_OF_BAND = 500.0  # [Hz], where the monitor gives no band


class Marked(NamedTuple):
    """A line of the spectrum that is marked."""

    order: float
    label: str
    colour: str
    style: Any  # of a line, as matplotlib takes it


def draw_spectrum(axes: Axes, inspection: Inspection) -> None:
    """Draw the spectrum of the envelope behind the verdict, with a label at every line that matters."""
    axes.set(xlabel="order, cycles per revolution of the shaft", ylabel="over background, dB")
    result = inspection.results.concluded
    if result is None or result.spectrum is None or not len(result.spectrum.order):
        _say(axes, "no analysis was possible: there is no spectrum")
        return
    orders = inspection.mounted.plate.frequencies
    lines = marked_lines(
        (orders.bpfo, orders.bpfi, orders.bsf, orders.ftf),
        result.verdict, result.fault_order, result.comb_order, result.also_fits,
    )  # fmt: skip
    draw_marked_spectrum(axes, result.spectrum.order, result.spectrum.level, lines)


def draw_marked_spectrum(axes: Axes, order: Float, level: Float, lines: Sequence[Marked]) -> None:
    """Draw a spectrum, shape [line], with a label at every marked line that has room."""
    axes.set(xlabel="order, cycles per revolution of the shaft", ylabel="over background, dB")
    highest = max((each.order for each in lines), default=order[-1]) * 1.04
    end = min(float(order[-1]), highest)
    lines = [each for each in lines if each.order <= end]
    shown = order <= end
    order, level = order[shown], np.maximum(level[shown], _FLOOR)
    top = float(level.max()) + 2.0
    for place, _, colour, style in lines:
        axes.plot([place, place], [_FLOOR, top], color=colour, linestyle=style, linewidth=0.8, zorder=1)
    axes.plot(order, level, color=_INK, linewidth=0.6, zorder=2)
    labels = _placed_labels(axes, lines, end)
    rows = 1 + max((row for row, *_ in labels), default=0)
    axes.set(xlim=(0.0, end), ylim=(_FLOOR, _FLOOR + (top - _FLOOR) / (1.0 - rows * _LABEL_SHARE)))
    axes.set_yticks([tick for tick in axes.get_yticks() if _FLOOR <= tick <= top])
    step = _LABEL_SHARE * (top - _FLOOR) / (1.0 - rows * _LABEL_SHARE)
    for row, middle, each in labels:
        axes.text(
            middle, top + (row + 0.15) * step, each.label,
            color=each.colour, fontsize=SMALL, ha="center", va="bottom", parse_math=False,
        )  # fmt: skip


def marked_lines(
    orders: tuple[float, float, float, float],
    verdict: str,
    fault_order: float,
    comb_order: float,
    also_fits: Sequence[str],
) -> list[Marked]:
    """List the lines that are marked: the part that is called with its harmonics first.

    Parameters
    ----------
    orders : tuple of float
        BPFO, BPFI, BSF and FTF from bearing data, [-].
    fault_order, comb_order : float
        As found, NaN without, [-].
    """
    bpfo, bpfi, bsf, ftf = orders
    fundamentals = {"cup": bpfo, "cone": bpfi, "roller": 2.0 * bsf}
    found: list[Marked] = []
    for part in sorted(_PARTS, key=lambda part: part != verdict):
        symbol, colour, style = _PARTS[part]
        shown = (
            part == verdict and CAGE not in also_fits
        )  # else the cage alone shows it, which is marked below
        step, count = (fault_order, _HARMONICS) if shown else (fundamentals[part], 2)
        if isfinite(step):
            found += _multiples(step, count, symbol, colour, style)
    if isfinite(comb_order):
        found += _multiples(comb_order, _HARMONICS, "strikes", _COMB, "-.")
    found += _multiples(1.0, _SHAFT_MULTIPLES, "shaft", _SHAFT, ":")
    if isfinite(ftf):
        found.append(Marked(ftf, "FTF", _SHAFT, ":"))
    return found


def _multiples(order: float, count: int, label: str, colour: str, style: Any) -> list[Marked]:
    return [
        Marked(number * order, label if number == 1 else f"{number}×{label}", colour, style)
        for number in range(1, count + 1)
    ]


def _placed_labels(axes: Axes, lines: Sequence[Marked], end: float) -> list[tuple[int, float, Marked]]:
    """Choose row and middle of labels, so that none covers another; one without room is left out."""
    figure = axes.get_figure(root=True)
    assert figure is not None
    points = axes.get_position().width * float(figure.get_figwidth()) * 72.0
    taken: list[list[tuple[float, float]]] = [[] for _ in range(_ROWS)]
    placed = []
    for each in lines:
        half = 0.5 * (len(each.label) * 0.62 * SMALL + 3.0) * end / points
        middle = min(max(each.order, half), end - half)
        for row, others in enumerate(taken):
            if all(middle + half <= low or middle - half >= high for low, high in others):
                others.append((middle - half, middle + half))
                placed.append((row, middle, each))
                break
    return placed


def draw_waveform(axes: Axes, inspection: Inspection) -> None:
    """Draw the whole record: the minimum and the maximum of each short piece, so that no peak is lost."""
    axes.set(xlabel="time, s", ylabel="acceleration, m/s²")
    signal = signal_of(inspection)
    if len(signal) < 2:
        _say(axes, "there is no vibration in the record")
        return
    name, values = loudest_axis(signal)
    time = signal.time - float(signal.time[0])
    edges = np.linspace(0, len(values), min(_BINS, len(values)) + 1).astype(int)[:-1]
    low, high = np.minimum.reduceat(values, edges), np.maximum.reduceat(values, edges)
    axes.fill_between(time[edges], low, high, color=_INK, linewidth=0.3)
    axes.set(xlim=(0.0, float(time[-1])))
    axes.set_title(f"whole record, axis {name}", fontsize=SMALL + 0.5, loc="left", pad=3)


def draw_strikes(axes: Axes, inspection: Inspection) -> None:
    """Draw a few turns of the shaft in the band that was judged, and how long one passage takes."""
    axes.set(xlabel="time, ms", ylabel="m/s²")
    signal, hertz = signal_of(inspection), shaft_frequency(inspection.run)
    if len(signal) < 2 or not hertz > 0.0:
        _say(axes, "there is no vibration with a speed in the record")
        return
    result = inspection.results.concluded
    name, values = loudest_axis(signal)
    band = (_FLOOR_OF_BAND, 0.45 * signal.rate)
    if result is not None and isfinite(result.band[0]):
        band = result.band
    count = min(len(values), round(_TURNS * signal.rate / hertz))
    margin = min(count, (len(values) - count) // 2)
    begin = max(0, (len(values) - count) // 2 - margin)
    received = _in_band(values[begin : begin + count + 2 * margin], signal.rate, band)[
        margin : margin + count
    ]
    axes.plot(np.arange(len(received)) * (1e3 / signal.rate), received, color=_INK, linewidth=0.5)
    end = len(received) * 1e3 / signal.rate
    axes.set(xlim=(0.0, end))
    at = (begin + margin) / signal.rate
    title = f"{_TURNS:g} turns of the shaft from {at:.2f} s, axis {name}, {band[0]:.0f} to {band[1]:.0f} Hz"
    axes.set_title(title, fontsize=SMALL + 0.5, loc="left", pad=3)
    _draw_passage(axes, result, end)


def _draw_passage(axes: Axes, result: MonitorResult | None, end: float) -> None:
    """Draw how long it is from one strike of the fault to the next."""
    hertz = np.nan
    if result is not None:
        hertz = result.fault_frequency if isfinite(result.fault_frequency) else result.comb_frequency
    if not hertz > 0.0 or 1e3 / hertz > end:
        return
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.28 * (high - low))
    period, place = 1e3 / hertz, high + 0.10 * (high - low)
    axes.annotate(
        "",
        (0.02 * end, place),
        (0.02 * end + period, place),
        arrowprops={"arrowstyle": "|-|,widthA=0.3,widthB=0.3"},
    )
    axes.text(
        0.035 * end + period, place, f"from strike to strike {period:.2f} ms", fontsize=SMALL, va="center"
    )


def _in_band(values: Float, rate: float, band: tuple[float, float]) -> Float:
    lines, frequency = np.fft.rfft(values), np.fft.rfftfreq(len(values), 1.0 / rate)
    lines[(frequency < band[0]) | (frequency > band[1])] = 0.0
    return np.asarray(np.fft.irfft(lines, len(values)), np.float64)


def draw_levels(axes: Axes, levels: Sequence[FileLevel]) -> None:
    """Draw the level of each file; a fault is a filled square, else a circle, nothing known a cross."""
    number = np.arange(1, len(levels) + 1)
    rms = np.array([each.rms for each in levels])
    axes.plot(number, rms, color="0.6", linewidth=0.8, zorder=1)
    marks = {
        "no fault found": (("healthy",), "o", "white"),
        "fault, or hot": (("cup", "cone", "roller", "hot_box"), "s", _COMB),
        "unexplained": (("unexplained",), "D", "0.7"),
        "cannot tell": (("not_diagnosable", "waiting"), "x", _INK),
    }
    for label, (verdicts, marker, colour) in marks.items():
        own = np.array([each.verdict in verdicts for each in levels])
        if own.any():
            edge: Any = {} if marker == "x" else {"edgecolors": _INK}
            axes.scatter(
                number[own], rms[own], s=16, marker=marker, color=colour, linewidths=0.8, label=label, **edge
            )
    axes.set(xlabel="file, in the order of the table below", ylabel="rms, m/s²")
    axes.set_ylim(0.0, 1.25 * float(np.nanmax(rms)) if np.isfinite(rms).any() else 1.0)
    axes.set_xlim(0.5, len(levels) + 0.5)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.legend(loc="upper left", fontsize=SMALL, ncols=4, frameon=False, handletextpad=0.2)


def _say(axes: Axes, sentence: str) -> None:
    axes.text(0.5, 0.5, sentence, transform=axes.transAxes, ha="center", va="center", fontsize=SMALL + 1.5)
    axes.set(xticks=[], yticks=[])
