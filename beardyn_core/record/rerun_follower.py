"""Reports of a follower next to the bearing: estimates over time with intervals, measured next to twin."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from beardyn_core.base.arrays import Float
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.record.arrays import Told
from beardyn_core.record.rerun_bearing import send
from beardyn_core.record.viewer import TIMELINE

ESTIMATES = "follower/estimates"
RESIDUAL = "follower/residual"
HEALTH = "follower/health"
WIDTH, HEIGHT, BETWEEN = 1000.0, 220.0, 60.0
_CURVES = ("estimate", "50 % interval, from", "to", "90 % interval, from", "to ")
_COLOURS = ((80, 145, 255), *2 * ((120, 170, 235),), *2 * ((150, 165, 190),))
_HEARD, _TWIN, _TOLERANCE, _FRAME = (80, 145, 255), (230, 155, 30), (230, 155, 30, 110), (128, 134, 148)
# ending of a key -> unit that is shown, factor from SI to it, and what is taken away before
_SHOWN = {"N": ("kN", 1e-3, 0.0), "m": ("mm", 1e3, 0.0), "K": ("°C", 1.0, ZERO_CELSIUS)}
_SHOWN_OF = {"depth_m": ("µm", 1e6, 0.0)}
_DECADES = (100.0, 1000.0, 10_000.0)
_LEVEL_STEP = 20.0  # of the labels, [dB]


def log_follower(stream: rr.RecordingStream, steps: Told, residuals: Told) -> None:
    """Draw all that a follower has said."""
    log_estimates(stream, steps)
    for each in residuals:
        log_residual(stream, each)


def quantities_of(steps: Told) -> tuple[str, ...]:
    """List the keys of the estimates, such as ``end_play_m``; none before the first one."""
    return next((tuple(each["estimates"]) for each in steps if "estimates" in each), ())


def log_estimates(stream: rr.RecordingStream, steps: Told) -> None:
    """Draw every number with its intervals after every stretch, and the health."""
    known = [each for each in steps if "estimates" in each]
    if not known:
        return
    time_ns = np.array([round(1e9 * each["time_s"]) for each in known], np.int64)
    for key in quantities_of(steps):
        _style(stream, key)
        _, factor, offset = _shown_quantity(key)
        told = np.array([key in each["estimates"] for each in known])  # another estimator may have taken over
        rows = [_row(each["estimates"][key]) for each in known if key in each["estimates"]]
        columns = rr.Scalars.columns(scalars=(np.array(rows) - offset) * factor)
        send(stream, f"{ESTIMATES}/{key}", time_ns[told], columns)
    for stamp, each in zip(time_ns, known, strict=True):
        stream.set_time(TIMELINE, duration=np.timedelta64(int(stamp), "ns"))
        stream.log(HEALTH, rr.TextLog("; ".join([each["health"], *each["doubts"]])))
    stream.reset_time()


def log_residual(stream: rr.RecordingStream, told: Mapping[str, Any]) -> None:
    """Draw measured third octaves next to those of the twin and its tolerance, an axis below the other."""
    middles = np.array(told["frequency_Hz"], float)
    received, twin, tolerance = (
        np.array(told[f"{name}_dB"], float) for name in ("measured", "twin", "tolerance")
    )
    every = np.concatenate([received, twin])
    if not np.isfinite(every).any():
        return
    low = _LEVEL_STEP * math.floor(np.nanmin(every) / _LEVEL_STEP)
    high = _LEVEL_STEP * math.ceil(np.nanmax(every) / _LEVEL_STEP + 1e-9)
    across = WIDTH * np.log(middles / middles[0]) / math.log(middles[-1] / middles[0])
    stream.set_time(TIMELINE, duration=float(told["time_s"]))
    strips, places, words = [], [], []
    colours: list[tuple[int, ...]] = []
    for k, axis in enumerate(told["axes"]):
        top = k * (HEIGHT + BETWEEN)

        def down(levels: Float, top: float = top) -> Float:
            return top + HEIGHT * (high - levels) / (high - low)

        strips.append(np.array([(0.0, top), (0.0, top + HEIGHT), (WIDTH, top + HEIGHT)]))
        colours.append(_FRAME)
        for level in np.arange(low, high + 1.0, _LEVEL_STEP):
            places.append((-40.0, float(down(np.array(level)))))
            words.append(f"{level:.0f}")
        for each in _DECADES:
            place = WIDTH * math.log(each / middles[0]) / math.log(middles[-1] / middles[0])
            places.append((place, top + HEIGHT + 14.0))
            words.append(f"{each:g} Hz")
        places.append((0.5 * WIDTH, top - 12.0))
        words.append(f"{axis}, dB re 1 m/s²: measured blue, twin orange with its tolerance")
        for levels, colour in (
            (twin[k] - tolerance[k], _TOLERANCE),
            (twin[k] + tolerance[k], _TOLERANCE),
            (twin[k], _TWIN),
            (received[k], _HEARD),
        ):
            known = np.isfinite(levels)
            strips.append(np.stack((across[known], down(levels[known])), axis=1))
            colours.append(colour)
    drawn = rr.LineStrips2D(strips, colors=colours, radii=rr.Radius.ui_points(0.8))
    stream.log(f"{RESIDUAL}/curves", drawn)
    size = rr.Radius.ui_points(0.01)
    stream.log(
        f"{RESIDUAL}/text", rr.Points2D(places, labels=words, colors=[_FRAME], radii=size, show_labels=True)
    )
    stream.reset_time()


def follower_view(quantities: Sequence[str]) -> rrb.Container:
    """Lay out the estimates, the health and the third octaves."""
    legend = rrb.PlotLegend(visible=False)  # it would hide half of a small plot
    curves = [
        rrb.TimeSeriesView(
            origin=f"{ESTIMATES}/{key}",
            name=f"{key.rpartition('_')[0].replace('_', ' ')}, {_shown_quantity(key)[0]}",
            plot_legend=legend,
        )
        for key in quantities
    ]
    bounds = rrb.VisualBounds2D(x_range=[-80.0, WIDTH + 20.0], y_range=[-30.0, 3.0 * (HEIGHT + BETWEEN)])
    beside = rrb.Vertical(
        rrb.Spatial2DView(origin=RESIDUAL, name="measured and twin", visual_bounds=bounds),
        rrb.TextLogView(origin=HEALTH, name="health"),
        row_shares=[3.0, 1.0],
    )
    return rrb.Horizontal(rrb.Grid(*curves), beside, column_shares=[1.2, 1.0], name="follower")


def _shown_quantity(key: str) -> tuple[str, float, float]:
    return _SHOWN_OF.get(key) or _SHOWN[key.rpartition("_")[2]]


def _row(told: Mapping[str, Any]) -> list[float]:
    """Give value and ends of the intervals, NaN where nothing is reported."""
    ends = [told[f"interval_{level}"] or (None, None) for level in ("50", "90")]
    return [math.nan if each is None else float(each) for each in (told["value"], *ends[0], *ends[1])]


def _style(stream: rr.RecordingStream, key: str) -> None:
    lines = rr.SeriesLines(names=list(_CURVES), colors=list(_COLOURS), widths=[2.0, *4 * (1.0,)])
    stream.log(f"{ESTIMATES}/{key}", lines, static=True)
