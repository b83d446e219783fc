"""Drawing of the plots of `beardyn_core.plot`: load zone, spectra, waterfall, curves, on one axes each."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import patheffects, pyplot
from matplotlib.axes import Axes
from matplotlib.projections.polar import PolarAxes

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.study.report_page.page_pictures import Marked, draw_marked_spectrum
from beardyn_core.study.summary_picture import orient_load_zone

LINES = {"BPFO": "#1f4e9c", "BPFI": "#c2571a", "2 BSF": "#2c7a3f", "FTF": "#777777"}
"""Colour of each fault frequency."""
_STYLES: Mapping[str, Any] = {"BPFO": "-", "BPFI": (0, (5, 2)), "2 BSF": (0, (2, 1.5)), "FTF": ":"}
_ROWS = (("row 0 (inboard)", "#c2571a", "o", "-"), ("row 1 (outboard)", "#1f4e9c", "^", "--"))
_BINS = 72  # around the circumference, for means
_AXES = (("x", "#1f4e9c", "-"), ("y", "#c2571a", "--"), ("z", "#2c7a3f", "-."))
_RANGE_DB = 60.0  # of a waterfall


def cartesian(ax: Axes | None) -> Axes:
    """Give the axes to draw on: new ones where there are none."""
    if ax is None:
        return pyplot.subplots(layout="constrained")[1]
    if isinstance(ax, PolarAxes):
        raise InputError("ax is polar; give plain axes, as of plt.subplots(), or none")
    return ax


def polar(ax: Axes | None) -> PolarAxes:
    """Give the polar axes to draw on: new ones where there are none."""
    found = pyplot.subplots(layout="constrained", subplot_kw={"projection": "polar"})[1] if ax is None else ax
    if not isinstance(found, PolarAxes):
        raise InputError("ax is not polar; give axes of plt.subplots(subplot_kw={'projection': 'polar'})")
    return found


def draw_load_zone(axes: PolarAxes, azimuth: Float, value: Float, name: str, unit: str) -> None:
    """Draw a number of every roller over its azimuth, from +z (up) towards +x (forward, to the right).

    Parameters
    ----------
    azimuth, value : float64 array, shape [moment, row, roller]
        [rad], and in the unit that is written at the axes.
    """
    orient_load_zone(axes, float(np.nanmax(value, initial=0.0)))
    one = len(azimuth) == 1
    for row, (label, colour, marker, style) in enumerate(_ROWS[: azimuth.shape[1]]):
        angle, number = np.mod(azimuth[:, row], 2.0 * np.pi).ravel(), value[:, row].ravel()
        if one:
            axes.vlines(angle, 0.0, number, color=colour, alpha=0.5, linewidth=2.0)
        else:
            axes.plot(*_means_around(angle, number), color=colour, linestyle=style, linewidth=1.6, zorder=3)
        axes.scatter(
            angle, number, s=30 if one else 3, marker=marker, color=colour, alpha=0.8 if one else 0.15,
            label=f"{label}, largest {np.nanmax(number, initial=0.0):.3g} {unit}",
        )  # fmt: skip
    axes.set_title(f"{name} [{unit}]")
    legend = axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.07), fontsize="small", frameon=False)
    for handle in legend.legend_handles:
        if handle is not None:
            handle.set_alpha(1.0)


def _means_around(angle: Float, number: Float) -> tuple[Float, Float]:
    """Average over equal parts of the circumference, those that are empty left out, and close the curve."""
    part = (angle * (_BINS / (2.0 * np.pi))).astype(np.int64) % _BINS
    count = np.bincount(part, minlength=_BINS)
    mean = np.bincount(part, number, _BINS)[count > 0] / count[count > 0]
    middle = (np.flatnonzero(count) + 0.5) * (2.0 * np.pi / _BINS)
    return np.append(middle, middle[:1] + 2.0 * np.pi), np.append(mean, mean[:1])


def draw_spectrum(axes: Axes, frequency: Float, densities: Mapping[str, Float]) -> None:
    """Draw amplitude spectral densities [m/s^2/sqrt(Hz)] of some axes over the frequency [Hz]."""
    colours = {name: (colour, style) for name, colour, style in _AXES}
    for name, density in densities.items():
        colour, style = colours.get(name, ("0.2", "-"))
        axes.semilogy(frequency, density, color=colour, linestyle=style, linewidth=0.7, label=f"axis {name}")
    axes.set(xlabel="frequency [Hz]", ylabel="acceleration [m/s²/√Hz]", xlim=(0.0, float(frequency[-1])))
    axes.grid(alpha=0.3)
    if len(densities) > 1:
        axes.legend(fontsize="small")


def draw_envelope_spectrum(
    axes: Axes, order: Float, level: Float, orders: Mapping[str, float], harmonics: int
) -> None:
    """Draw the level of an envelope over its background [dB] with labelled multiples of fault orders [-]."""
    lines = [
        Marked(number * each, name if number == 1 else f"{number}×{name}", LINES[name], _STYLES[name])
        for name, each in orders.items()
        for number in range(1, 1 + (1 if name == "FTF" else harmonics))
        if np.isfinite(each) and number * each <= order[-1]
    ]
    draw_marked_spectrum(axes, order, level, lines)


def draw_waterfall(
    axes: Axes, frequency: Float, place: Float, density: Float, label: str, orders: Mapping[str, Float]
) -> None:
    """Draw a spectrum at every place of a run-up, and lines of fault frequencies.

    Parameters
    ----------
    place : float64 array, shape [place]
        Speed or time, growing; ``label`` names it with its unit.
    density : float64 array, shape [place, frequency]
        [m/s^2/sqrt(Hz)].
    orders : mapping of str to float64 array, shape [place]
        Frequency of each line at every place, [Hz].
    """
    decibels = 20.0 * np.log10(np.maximum(density, 1e-300))
    top = float(decibels.max())
    mesh = axes.pcolormesh(
        frequency, place, decibels, shading="nearest", cmap="magma", vmin=top - _RANGE_DB, vmax=top,
        rasterized=True,
    )  # fmt: skip
    figure = axes.get_figure(root=True)
    assert figure is not None
    figure.colorbar(mesh, ax=axes, label="dB over 1 m/s²/√Hz")
    for level, (name, line) in enumerate(orders.items()):
        inside = np.flatnonzero(line <= frequency[-1])
        axes.plot(line[inside], place[inside], color="white", linestyle=_STYLES[name], linewidth=0.8)
        if len(inside):  # at heights of their own: 2 BSF is close to BPFO
            at = inside[int((0.98 - 0.07 * level) * (len(inside) - 1))]
            text = axes.annotate(
                name, (line[at], place[at]), (4, 0), textcoords="offset points", color="white",
                fontsize="x-small", va="top",
            )  # fmt: skip
            text.set_path_effects([patheffects.withStroke(linewidth=1.2, foreground="black")])
    axes.set(xlabel="frequency [Hz]", ylabel=label, xlim=(0.0, float(frequency[-1])))


def draw_stiffness(axes: Axes, play: Float, stiffness: Float, label: str) -> None:
    """Draw the stiffness along each axis [MN/m], shape [case, 3], over a play [mm]."""
    for (name, colour, style), values in zip(_AXES, stiffness.T, strict=True):
        axes.plot(play, values, color=colour, linestyle=style, marker=".", label=f"along {name}")
    axes.set(xlabel=label, ylabel="stiffness [MN/m]")
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")


def draw_torque(axes: Axes, rpm: Sequence[float] | Float, torque: Float) -> None:
    """Draw the running torque [N m] over the speed [rpm]."""
    axes.plot(rpm, torque, color=_AXES[0][1], marker=".")
    axes.set(xlabel="shaft speed [rpm]", ylabel="running torque [N m]")
    axes.set_ylim(bottom=0.0)
    axes.grid(alpha=0.3)
