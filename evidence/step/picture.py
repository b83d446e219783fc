"""Spectra of the housing at the reference and at the chosen step. Needs no screen."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

WIDTH_PX, HEIGHT_PX, DPI = 1200, 640, 100
_LIMIT_DB = 12.0
_REFERENCE, _CHOSEN, _OTHER = "0.25", "#C44E52", "#4C72B0"


def step_picture(data: dict[str, Any], path: Path) -> None:
    """Draw for each load the levels of 50 Hz lines, and below their differences from the reference.

    Parameters
    ----------
    data : mapping
        As of `study.run_study`.
    path : Path
        Where the PNG goes.
    """
    figure = Figure(figsize=(WIDTH_PX / DPI, HEIGHT_PX / DPI), dpi=DPI, layout="constrained")
    FigureCanvasAgg(figure)
    points = data["points"]
    panels = figure.subplots(2, len(points), squeeze=False, sharex=True, height_ratios=(1.5, 1.0))
    frequency = 1e-3 * np.array(data["lines_Hz"])
    for column, point in enumerate(points):
        _column(panels[0, column], panels[1, column], frequency, point)
    panels[0, 0].set_ylabel("dB re 1 µm/s$^2$ in 50 Hz, all axes")
    panels[1, 0].set_ylabel("difference, dB")
    figure.savefig(path, dpi=DPI, format="png")


def _column(levels: Axes, differences: Axes, frequency: Any, point: dict[str, Any]) -> None:
    reference = point["reference"]
    truth, band = np.array(reference["lines_dB"]), np.array(reference["lines_band_dB"])
    levels.plot(frequency, truth, color=_REFERENCE, lw=1.6, label=f"{reference['name']}, reference")
    differences.fill_between(frequency, -band, band, color="0.85", lw=0.0, label="run-to-run band")
    for asked, colour in (("torque", _OTHER), ("vibration", _CHOSEN)):
        row = _row(point, asked)
        if "ended" in row:
            continue
        change = np.array(row["lines"]["difference_dB"])
        levels.plot(frequency, truth + change, color=colour, lw=0.8, label=f"{row['name']}, for {asked}")
        differences.plot(frequency, change, color=colour, lw=0.8)
    differences.axhline(0.0, color=_REFERENCE, lw=0.8)
    differences.set_ylim(-_LIMIT_DB, _LIMIT_DB)
    differences.set_xlim(0.0, frequency[-1])
    differences.set_xlabel("kHz")
    levels.set_title(f"{point['name']}, {point['speed_rad_s']:g} rad/s", fontsize=11, loc="left")
    for axes in (levels, differences):
        axes.grid(alpha=0.25)
        axes.legend(fontsize=8, loc="upper right", frameon=False)


def _row(point: dict[str, Any], asked: str) -> dict[str, Any]:
    steps = point["chosen"][asked]["steps_per_sample"]
    return next(row for row in point["rows"] if (row["integrator"], row["steps"]) == ("implicit", steps))
