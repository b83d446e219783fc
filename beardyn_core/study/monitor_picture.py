"""The order spectrum of the envelope that a monitor judged, with the lines of every part. Needs no screen."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.monitor.chain import MonitorResult
from beardyn_core.monitor.chain.ambiguity import CAGE
from beardyn_core.monitor.chain.fault_lines import TURNS

WIDTH_PX, HEIGHT_PX, DPI = 1200, 420, 100
_PARTS = (
    ("cup", "outer ring (cup), BPFO", "#4C72B0"),
    ("cone", "inner ring (cone), BPFI", "#DD8452"),
    ("roller", "rollers, 2 BSF", "#55A868"),
)
_COMB = "#C44E52"
_FLOOR = -5.0  # below which the spectrum is not drawn, [dB]


def monitor_picture(judged: Mapping[str, tuple[MonitorResult, FaultFrequencies]], path: Path) -> None:
    """Draw the envelope spectrum behind the verdict on each bearing, by its title, to a PNG."""
    monitor_figure(judged).savefig(path, dpi=DPI, format="png")


def monitor_figure(judged: Mapping[str, tuple[MonitorResult, FaultFrequencies]]) -> Figure:
    """Draw a figure with an axis for each bearing, one above the other."""
    size = (WIDTH_PX / DPI, len(judged) * HEIGHT_PX / DPI)
    figure = Figure(figsize=size, dpi=DPI, layout="constrained")
    every = figure.subplots(len(judged), 1, squeeze=False)[:, 0]
    for axes, (label, (result, orders)) in zip(every, judged.items(), strict=True):
        _draw(axes, label, result, orders)
    return figure


def _draw(axes: Axes, label: str, result: MonitorResult, orders: FaultFrequencies) -> None:
    axes.set_title(f"{label}: {result.reason}", fontsize=9, wrap=True)
    axes.set(xlabel="order, cycles per shaft revolution", ylabel="envelope over background, dB")
    if result.spectrum is None:
        return
    order, level = result.spectrum.order, np.maximum(result.spectrum.level, _FLOOR)
    fundamentals = {"cup": orders.bpfo, "cone": orders.bpfi, "roller": 2.0 * orders.bsf}
    for part, words, colour in _PARTS:
        called = part == result.verdict and CAGE not in result.also_fits
        step = result.fault_order if called else fundamentals[part]
        if not np.isfinite(step):
            continue  # an order that the bearing data do not give
        for harmonic in range(1, int(order[-1] / step) + 1):
            name = words if harmonic == 1 else None
            axes.axvline(harmonic * step, color=colour, linewidth=0.9, alpha=0.6, label=name)
    if CAGE in result.also_fits:
        for multiple in range(1, TURNS + 1):
            name = "roller or cage, FTF" if multiple == 1 else None
            axes.axvline(multiple * result.fault_order, color=_COMB, linewidth=0.9, label=name)
    if np.isfinite(result.comb_order):
        for harmonic in range(1, int(order[-1] / result.comb_order) + 1):
            name = f"fits no part: order {result.comb_order:.3f}" if harmonic == 1 else None
            axes.axvline(harmonic * result.comb_order, color=_COMB, linestyle="--", linewidth=0.9, label=name)
    axes.plot(order, level, color="0.15", linewidth=0.7)
    axes.set(xlim=(0.0, float(order[-1])), ylim=(_FLOOR, float(level.max()) + 3.0))
    axes.legend(loc="upper right", fontsize=8)
