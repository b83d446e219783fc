"""The load zone over a turn of the cage: cross-section, load by azimuth, and the load of one roller."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.lines import Line2D

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.record.load_colours import SPALL_COLOUR, load_colours
from beardyn_core.record.run import Run
from beardyn_core.sensors.summary import SETTLING_S
from beardyn_core.study.animation.cross_section import CrossSection, rgb
from beardyn_core.study.animation.moving_figure import MovingFigure, mean_load, new_figure, slowness
from beardyn_core.study.animation.row_motion import RowMotion
from beardyn_core.study.animation.spall_passages import TURN, ring_spalls

_BINS = 72
_KILO = 1e-3
_FOLLOWED = "#1f4e79"


def load_zone_picture(run: Run, at: float | None, seconds: float) -> MovingFigure:
    """Draw the load zone over one turn of the cage.

    Parameters
    ----------
    run : Run
    at : float or None
        Where it begins, [s]; ``None``: after the start has settled.
    seconds : float
        How long the picture takes, for its caption.

    Raises
    ------
    InputError
        The rollers do not go around once from there to the end of the recording.
    """
    motion = _busier_row(run)
    low, high = motion.span
    begin = min(low + SETTLING_S, 0.5 * (low + high)) if at is None else max(at, low)
    turn = motion.cage_period(begin)
    if begin + turn > high:
        lasts = f"takes {turn:.2f} s" if np.isfinite(turn) else "has no end, as they stand still"
        raise InputError(
            f"{run.label}: one turn of the rollers about the axis {lasts}; the recording ends "
            f"{high - begin:.2f} s after {begin:.3f} s. Begin earlier (--at), or record longer or faster"
        )
    largest = float(motion.load.max(initial=0.0))
    spalls = [each for each in ring_spalls(run.described()) if each.row == motion.row]
    figure = new_figure(run, motion.row)
    section_axes = figure.add_axes((0.01, 0.30, 0.46, 0.61))
    section = CrossSection(section_axes, run.described().shape, motion, largest, spalls)
    section.draw_load(section_axes, mean_load(run, begin, begin + turn))
    zone = figure.add_axes((0.555, 0.41, 0.42, 0.47))
    _draw_zone(zone, motion, begin)
    for spall in spalls:
        if spall.on == "cup":
            place = np.degrees(np.mod(spall.azimuth + np.pi, TURN) - np.pi)
            zone.axvline(place, color=rgb(SPALL_COLOUR), lw=1.2, ls=":", label="spall")
    zone.legend(loc="upper right", fontsize=7, frameon=False)
    followed = int(np.flatnonzero(motion.present)[0])
    trace = figure.add_axes((0.08, 0.085, 0.895, 0.19))
    _draw_trace(trace, motion, followed, begin, begin + turn)
    dots = zone.scatter(
        np.zeros(len(motion.present)), np.zeros(len(motion.present)), s=42, ec="0.25", zorder=4
    )
    (ring,) = zone.plot([], [], "o", ms=11, mfc="none", mec=_FOLLOWED, mew=1.8)
    (cursor,) = trace.plot([], [], color="0.4", lw=0.9)
    (point,) = trace.plot([], [], "o", color=_FOLLOWED, ms=6)
    clock = figure.text(0.975, 0.925, "", fontsize=8, ha="right", va="top", color="0.3")
    slow = slowness(begin, begin + turn, seconds)

    def show(time: float) -> None:
        moment = motion.at(time)
        section.show(moment)
        load = moment.load[followed]
        _place_dots(dots, ring, moment.azimuth, moment.load, motion, largest, followed)
        cursor.set_data([time, time], trace.get_ylim())
        point.set_data([time], [_KILO * load])
        clock.set_text(f"t = {time:.4f} s, {slow}")

    parts = [*section.moving, dots, ring, cursor, point, clock]
    return MovingFigure(figure, parts, show, begin, begin + turn, "load zone over one turn of the cage")


def _busier_row(run: Run) -> RowMotion:
    """Take the row that has a spall of a ring, or carries more."""
    described = run.described()
    rows = range(int(described.truth.get("rows", 2)))
    spalled = [each.row for each in ring_spalls(described)]
    if spalled:
        return RowMotion.of(run, spalled[0])
    motions = [RowMotion.of(run, row) for row in rows]
    return max(motions, key=lambda each: float(each.load.mean()))


def _draw_zone(axes: Axes, motion: RowMotion, begin: float) -> None:
    settled = motion.time >= begin
    azimuth = np.mod(motion.azimuth[settled][:, motion.present].ravel() + np.pi, TURN) - np.pi
    load = _KILO * motion.load[settled][:, motion.present].ravel()
    edges = np.linspace(-np.pi, np.pi, _BINS + 1)
    middle = np.degrees(0.5 * (edges[1:] + edges[:-1]))
    low, high = _range_by_bin(np.digitize(azimuth, edges) - 1, load)
    axes.fill_between(middle, low, high, color="0.85", lw=0, label="range over the recording")
    axes.set(xlim=(-180.0, 180.0), ylim=(0.0, 1.12 * _KILO * float(motion.load.max(initial=0.0)) or 1.0))
    axes.set_xticks(np.arange(-180, 181, 60))
    axes.set_xlabel("azimuth from the top, forward positive [deg]", fontsize=8)
    axes.set_ylabel("roller on the outer ring (cup) [kN]", fontsize=8)
    axes.tick_params(labelsize=8)
    axes.grid(alpha=0.3)


def _range_by_bin(index: Int, load: Float) -> tuple[Float, Float]:
    """Find the smallest and largest load of each bin; NaN where no roller has been."""
    low, high = np.full(_BINS, np.inf), np.full(_BINS, -np.inf)
    inside = np.clip(index, 0, _BINS - 1)
    np.minimum.at(low, inside, load)
    np.maximum.at(high, inside, load)
    empty = ~np.isfinite(low)
    low[empty], high[empty] = np.nan, np.nan
    return low, high


def _draw_trace(axes: Axes, motion: RowMotion, followed: int, begin: float, end: float) -> None:
    times = np.unique(np.clip(np.concatenate(([begin, end], motion.time)), begin, end))
    load = _KILO * np.array([motion.at(float(time)).load[followed] for time in times])
    axes.plot(times, load, color=_FOLLOWED, lw=1.2)
    axes.set(xlim=(begin, end), ylim=(0.0, 1.15 * float(load.max(initial=0.0)) or 1.0))
    axes.set_xlabel("time [s]", fontsize=8)
    axes.set_ylabel(f"roller {followed} [kN]", fontsize=8)
    axes.tick_params(labelsize=8)
    axes.grid(alpha=0.3)


def _place_dots(
    dots: PathCollection,
    ring: Line2D,
    azimuth: Float,
    load: Float,
    motion: RowMotion,
    largest: float,
    followed: int,
) -> None:
    place = np.degrees(np.mod(azimuth + np.pi, TURN) - np.pi)
    here = motion.present
    dots.set_offsets(np.stack((place[here], _KILO * load[here]), axis=1))
    dots.set_facecolor((load_colours(load[here], largest) / 255.0).tolist())
    ring.set_data([place[followed]], [_KILO * load[followed]])
