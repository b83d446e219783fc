"""Numbers of the monitor next to the bearing: curves over time, each with its interval."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import rerun as rr
import rerun.blueprint as rrb

from beardyn_core.record.arrays import Signal
from beardyn_core.record.messages import decode, header_stamp
from beardyn_core.record.plot_values import BY_TOPIC, MONITOR, VALUES, VECTOR
from beardyn_core.record.rerun_bearing import send

ENTITY = "monitor/values"
DRAWN = tuple(each for each in VALUES if each.source == MONITOR)
"""Those of the follower are on its own page, with more intervals."""
_COLOURS = ((80, 145, 255), (120, 170, 235), (120, 170, 235))


def log_values(stream: rr.RecordingStream, values: Mapping[str, Signal]) -> None:
    """Draw the numbers of the monitor in a recording, by name."""
    for each in DRAWN:
        if each.name in values:
            signal = values[each.name]
            _send(stream, each.name, signal.time_ns, signal.values)


def log_value(stream: rr.RecordingStream, topic: str, cdr: bytes) -> None:
    """Draw one message of ``values/<name>`` of the monitor as it comes."""
    vector = decode(VECTOR, cdr).vector
    numbers = np.array([[vector.x, vector.y, vector.z]])
    _send(stream, BY_TOPIC[topic].name, np.array([header_stamp(cdr)], np.int64), numbers)


def _send(stream: rr.RecordingStream, name: str, time_ns: np.ndarray, numbers: np.ndarray) -> None:
    level = BY_TOPIC[f"values/{name}"].level
    width = len(_COLOURS) if level else 1
    names = [name, f"{level} % interval, from", "to"][:width]
    style = rr.SeriesLines(names=names, colors=list(_COLOURS[:width]), widths=[1.5] * width)
    stream.log(f"{ENTITY}/{name}", style, static=True)
    send(stream, f"{ENTITY}/{name}", time_ns, rr.Scalars.columns(scalars=numbers[:, :width]))


def values_view() -> rrb.Container:
    """Lay out the curves, a view a number."""
    legend = rrb.PlotLegend(visible=False)  # it would hide half of a small plot
    views = [
        rrb.TimeSeriesView(
            origin=f"{ENTITY}/{each.name}",
            name=each.name.replace("_", " ") + (f", {each.unit}" if each.unit != "-" else ""),
            plot_legend=legend,
        )
        for each in DRAWN
    ]
    return rrb.Grid(*views, grid_columns=3, name="monitor")
