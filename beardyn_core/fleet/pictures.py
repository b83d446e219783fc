"""Pictures of the page of a fleet: health over time, spectrum and waveform behind an alarm, sisters."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from beardyn_core.fleet.analysis import Evidence
from beardyn_core.fleet.health import SCALE, HealthPoint
from beardyn_core.fleet.identity import Axlebox
from beardyn_core.fleet.ranking import FleetStatus, Standing
from beardyn_core.fleet.sisters import partner_of
from beardyn_core.fleet.store import Stored
from beardyn_core.study.report_page.page_pictures import SMALL, draw_marked_spectrum, marked_lines

_INK, _ALARM = "0.1", "#a3123a"
_CALLED = ("cup", "cone", "roller", "hot_box", "unexplained")
_RIDES = 30  # of the latest, in the picture of sisters


def draw_health(axes: Axes, points: Sequence[HealthPoint]) -> None:
    """Draw the state over time, and the verdict of each recording."""
    time = _dates(points)
    place = np.array([SCALE.index(each.state) for each in points])
    axes.step(time, place, where="post", color=_INK, linewidth=1.0)
    called = np.array([each.verdict in _CALLED for each in points])
    blind = np.array([each.verdict in ("not_diagnosable", "waiting") for each in points])
    for chosen, marker, colour, label in (
        (~called & ~blind, "o", "white", "no fault found"),
        (called, "s", _ALARM, "a part, heat or strikes"),
        (blind, "x", _INK, "cannot tell"),
    ):
        if chosen.any():
            edge: Any = {} if marker == "x" else {"edgecolors": _INK}
            at = time[chosen]
            axes.scatter(
                at,
                place[chosen],
                s=11,
                marker=marker,
                color=colour,
                linewidths=0.6,
                zorder=3,
                label=label,
                **edge,
            )
    axes.set_yticks(range(len(SCALE)), [each.replace("_", "\n") for each in SCALE])
    axes.set_ylim(-0.4, len(SCALE) + 0.3)
    axes.legend(loc="upper left", fontsize=SMALL, ncols=3, frameon=False, handletextpad=0.2)
    _label_dates(axes)


def draw_widths(axes: Axes, standing: Standing) -> None:
    """Draw the measured widths with 95 % intervals over mileage, or over time where no mileage is known."""
    known = [
        each
        for each in standing.history
        if each.analysis.verdict == standing.health.part and isfinite(each.analysis.width)
    ]
    if not known:
        _say(axes, "no width was measured")
        axes.set(xlabel="mileage, 1000 km", ylabel="width of the spall, mm")
        return
    width = np.array([1e3 * each.analysis.width for each in known])
    ends = np.array([[1e3 * end for end in each.analysis.width_ends] for each in known]).T
    mileage = np.array([each.mileage for each in known])
    has_mileage = bool(np.isfinite(mileage).all())
    place: Any = mileage / 1e6 if has_mileage else _dates(known)
    error = np.maximum(np.abs(ends - width), 0.0)
    axes.errorbar(place, width, error, fmt="o", color=_INK, markersize=2.5, linewidth=0.6)
    axes.axhline(20.0, color=_ALARM, linewidth=0.8, linestyle="--")
    axes.set(ylim=(0.0, max(24.0, 1.15 * float(ends[1].max()))), ylabel="width of the spall, mm")
    if has_mileage:
        axes.set(xlabel="mileage, 1000 km")
    else:
        _label_dates(axes)


def draw_evidence_spectrum(axes: Axes, evidence: Evidence) -> None:
    """Draw the spectrum of the envelope with labelled lines."""
    lines = marked_lines(
        evidence.orders, evidence.verdict, evidence.fault_order, evidence.comb_order, evidence.also_fits
    )
    draw_marked_spectrum(axes, evidence.order, evidence.level, lines)


def draw_evidence_record(axes: Axes, evidence: Evidence) -> None:
    """Draw the whole record, lowest and highest of each piece."""
    low, high = evidence.record
    time = np.linspace(0.0, evidence.duration, len(low))
    axes.fill_between(time, low, high, color=_INK, linewidth=0.3)
    axes.set(xlabel="time, s", ylabel="acceleration, m/s²", xlim=(0.0, evidence.duration))
    axes.set_title(f"whole record, axis {evidence.axis}", fontsize=SMALL + 0.5, loc="left", pad=3)


def draw_evidence_excerpt(axes: Axes, evidence: Evidence) -> None:
    """Draw three turns of the shaft in the band that was judged."""
    time = 1e3 * np.arange(len(evidence.excerpt)) / evidence.rate
    axes.plot(time, evidence.excerpt, color=_INK, linewidth=0.5)
    low, high = evidence.band
    axes.set(xlabel="time, ms", ylabel="m/s²", xlim=(0.0, float(time[-1])))
    axes.set_title(
        f"three turns of the shaft, {low:.0f} to {high:.0f} Hz", fontsize=SMALL + 0.5, loc="left", pad=3
    )


def draw_sisters(axes: Axes, status: FleetStatus, box: Axlebox) -> None:
    """Draw the loudest band of all axleboxes over the median of their rides; this one thick."""
    own = next(each for each in status.standings if each.axlebox == box)
    since = own.history[-_RIDES:][0].time if own.history else -np.inf
    trains = {each.train for each in own.history}
    for each in status.standings:
        if each.axlebox != box and not trains & {one.train for one in each.history[-1:]}:
            continue
        shown = [r for r in each.history if r.time >= since and r.number in status.comparisons]
        if not shown:
            continue
        time = _dates(shown)
        level = [_middle(status.comparisons[r.number].levels) for r in shown]
        if each.axlebox == box:
            axes.plot(
                time,
                level,
                color=_ALARM,
                linewidth=1.4,
                marker="o",
                markersize=2,
                zorder=3,
                label="this axlebox",
            )
        elif each.axlebox == partner_of(box):
            axes.plot(
                time,
                level,
                color=_INK,
                linewidth=0.9,
                linestyle="--",
                zorder=2,
                label="other end of the axle",
            )
        else:
            axes.plot(time, level, color="0.7", linewidth=0.6, zorder=1)
    axes.set(ylabel="over the others, dB")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.3 * (high - low))  # room for the names
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper left", fontsize=SMALL, ncols=2, frameon=False)
    if not axes.lines:
        _say(axes, "no ride has this axlebox and three others")
        return
    _label_dates(axes)


def _dates(several: Sequence[HealthPoint] | Sequence[Stored]) -> Any:
    """Give the times as dates, shape [recording]."""
    return np.array([each.time for each in several]).astype("datetime64[s]")


def _middle(levels: Any) -> float:
    """Give the second highest level: two bands must agree."""
    known = np.sort(levels[np.isfinite(levels)])
    return float(known[-min(2, len(known))]) if len(known) else np.nan


def _label_dates(axes: Axes) -> None:
    from matplotlib.dates import AutoDateLocator, ConciseDateFormatter

    locator = AutoDateLocator(minticks=3, maxticks=8)
    axes.xaxis.set_major_locator(locator)
    axes.xaxis.set_major_formatter(ConciseDateFormatter(locator))


def _say(axes: Axes, sentence: str) -> None:
    axes.text(0.5, 0.5, sentence, transform=axes.transAxes, ha="center", va="center", fontsize=SMALL + 1.0)
    axes.set(xticks=[], yticks=[])
