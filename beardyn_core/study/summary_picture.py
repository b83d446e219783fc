"""One picture of a run: forces, load zone, envelope spectrum, speed. Needs no screen."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from beardyn_core.base.arrays import Float

WIDTH_PX, HEIGHT_PX, DPI = 1600, 1000, 100
_AXIS_COLOURS = ("#4C72B0", "#55A868", "#C44E52")
_ROW_COLOURS = ("#C44E52", "#4C72B0")
_FAULT_COLOURS = {"BPFO": "#C44E52", "BPFI": "#4C72B0", "2 BSF": "#DD8452", "FTF": "#8172B3"}
_HARMONICS = 4  # of the highest marker, shown whole


@dataclass(frozen=True)
class SummaryData:
    """Arrays of a run that the picture shows."""

    title: A[str, "name of the scene"]
    verdict: A[str, "verdict of the monitor, in a sentence"]
    time: A[Float, "shape [sample], [s]"]
    force: A[Float, "shape [sample, 3], of the rollers on the cup, world axes, [N]"]
    load: A[Float, "shape [sample, 3], on the journal, [N]"]
    shaft_speed: A[Float, "shape [sample], [rad/s]"]
    cage_speed: A[Float, "shape [sample, row], [rad/s]"]
    roller_azimuth: A[Float, "shape [row, roller] or [moment, row, roller], from +z towards +x, [rad]"]
    roller_load: A[Float, "the shape of ``roller_azimuth``, normal load between cup and roller, [N]"]
    envelope_order: A[Float, "shape [line], cycles per shaft revolution, [-]"]
    envelope_amplitude: A[Float, "shape [line], amplitude of the envelope, [m/s^2]"]
    markers: A[Mapping[str, float], "``BPFO``, ``BPFI``, ``2 BSF``, ``FTF``: order per shaft revolution, [-]"]
    shaft_frequency: A[float, "mean during the analysis, for the frequency scale, [Hz]"]


def summary_picture(data: SummaryData, path: Path) -> None:
    """Draw the picture, 1600 x 1000 pixels, to a PNG."""
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, layout="constrained")
    figure.suptitle(f"{data.title}\n{data.verdict}", fontsize=15)
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(1.75, 1.0))[0]
    forces, speeds, spectrum = left.subplots(3, 1, height_ratios=(1.0, 0.7, 1.3))
    rows = data.roller_load.shape[-2]
    zones = right.subplots(rows, 1, squeeze=False, subplot_kw={"projection": "polar"})[:, 0]
    _draw_forces(forces, data)
    _draw_speeds(speeds, data)
    speeds.sharex(forces)
    _draw_spectrum(spectrum, data)
    for row, zone in enumerate(zones):
        assert isinstance(zone, PolarAxes)
        _draw_load_zone(zone, data, row)
    figure.savefig(path, dpi=DPI, format="png")


def _draw_forces(axes: Axes, data: SummaryData) -> None:
    for column, (name, colour) in enumerate(zip("xyz", _AXIS_COLOURS, strict=True)):
        axes.plot(data.time, data.force[:, column] / 1e3, color=colour, lw=0.9, label=f"cup {name}")
    for column, (name, colour) in enumerate(zip("xyz", _AXIS_COLOURS, strict=True)):
        label = f"journal {name}"
        axes.plot(data.time, data.load[:, column] / 1e3, color=colour, lw=0.9, ls=":", alpha=0.8, label=label)
    axes.set_ylabel("force [kN]")
    axes.set_title("Force on the cup, load on the journal", fontsize=11, loc="left")
    axes.tick_params(labelbottom=False)
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=8, ncols=6, frameon=False)
    axes.grid(alpha=0.3)


def _draw_speeds(axes: Axes, data: SummaryData) -> None:
    rpm = 30.0 / np.pi
    axes.plot(data.time, data.shaft_speed * rpm, color="0.2", label="shaft")
    for row, colour in enumerate(_ROW_COLOURS[: data.cage_speed.shape[1]]):
        name = f"cage, row {row} ({'inboard' if row == 0 else 'outboard'})"
        axes.plot(data.time, data.cage_speed[:, row] * rpm, color=colour, ls=("-", "--")[row], label=name)
    axes.set_ylim(bottom=min(0.0, 1.05 * float(np.min(data.shaft_speed, initial=0.0)) * rpm))
    axes.set_ylabel("speed [rpm]")
    axes.set_xlabel("time [s]")
    axes.set_title("Speeds", fontsize=11, loc="left")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), fontsize=8, ncols=3, frameon=False)
    axes.grid(alpha=0.3)


def _draw_spectrum(axes: Axes, data: SummaryData) -> None:
    highest = (_HARMONICS + 0.5) * max(data.markers.values(), default=10.0)
    shown = (data.envelope_order <= highest) & (data.envelope_order > 0.1)
    order, amplitude = data.envelope_order[shown], data.envelope_amplitude[shown]
    axes.plot(order, amplitude, color="0.25", lw=0.8)
    top = 1.25 * float(amplitude.max(initial=0.0)) or 1.0
    axes.set(xlim=(0.0, highest), ylim=(0.0, top))
    for level, (name, marked) in enumerate(data.markers.items()):
        colour = _FAULT_COLOURS.get(name, "0.5")
        # one line of text a marker: neighbours such as 2 BSF and BPFO do not overlap
        height = top * (0.985 - 0.062 * level)
        for h in range(1, 1 + (1 if name == "FTF" else int(highest / marked))):
            fade = 0.9 if h == 1 else 0.45
            axes.axvline(h * marked, color=colour, lw=1.1, ls="--", alpha=fade, zorder=0)
            text = f" {name}" if h == 1 else f" {h}x"
            axes.text(h * marked, height, text, color=colour, fontsize=8.5, va="top")
    axes.set(xlabel="order [cycles per shaft revolution]", ylabel="envelope [m/s²]")
    axes.set_title("Envelope spectrum of the axlebox vibration", fontsize=11, loc="left")
    axes.grid(alpha=0.3)
    if data.shaft_frequency > 0.0:
        rate = data.shaft_frequency
        both_ways = (lambda order: np.asarray(order) * rate, lambda hertz: np.asarray(hertz) / rate)
        scale = axes.secondary_xaxis("top", functions=both_ways)
        scale.set_xlabel(f"frequency [Hz] at {rate:.2f} Hz shaft speed", fontsize=9)
        scale.tick_params(labelsize=8)


def orient_load_zone(axes: PolarAxes, largest: float) -> None:
    """Turn polar axes so that azimuth 0 (+z) is up and +x to the right, with room for a largest number."""
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_xticks(np.deg2rad(np.arange(0, 360, 45)))
    axes.set_xticklabels(["0° (+z, up)", "45°", "90°\n(+x)", "135°", "180°", "225°", "270°", "315°"])
    axes.set_ylim(0.0, 1.1 * largest or 1.0)
    axes.set_rlabel_position(157.5)  # the housing may press rollers at the sides, none below


def _draw_load_zone(axes: PolarAxes, data: SummaryData, row: int) -> None:
    """Draw the load of each roller of a row at each moment, a panel a row: none hides the other."""
    azimuth, load = (
        values[None] if values.ndim == 2 else values for values in (data.roller_azimuth, data.roller_load)
    )
    orient_load_zone(axes, float(load.max(initial=0.0)) / 1e3)
    angle, force, colour = azimuth[:, row].ravel(), load[:, row].ravel() / 1e3, _ROW_COLOURS[row]
    if len(azimuth) == 1:
        axes.vlines(angle, 0.0, force, color=colour, alpha=0.5, lw=2)
    axes.scatter(angle, force, color=colour, s=30 if len(azimuth) == 1 else 4, alpha=0.7)
    side = "inboard" if row == 0 else "outboard"
    title = f"Load zone of row {row} ({side}): cup–roller load [kN], largest {force.max(initial=0.0):.2f}"
    axes.set_title(title, fontsize=11, pad=14)
