"""Levels of measured files over their records, against the bearing's own baseline."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import write_whole
from beardyn_core.measured.sensor_choice import AXES
from beardyn_core.measured.stream import SensorBlock, Stream
from beardyn_core.measured.survey import Survey
from beardyn_core.monitor.trend import Trend, TrendPoint, record_levels

LONGEST_RECORD_S = 10.0  # a longer measurement is cut into records of this
SHORTEST_RECORD_S = 0.05  # what is shorter has too few lines in the lowest band


def trend_of(survey: Survey, sensor: str = "", trend: Trend | None = None) -> Iterator[TrendPoint]:
    """Give what the trend says after every record of one accelerometer, by default the first.

    A record ends where a gap begins, such as between files with ``file_interval``. A trend that was given
    goes on from where it is.

    Raises
    ------
    InputError
        A file cannot be read, or has other axes than the trend.
    """
    sensor = sensor or survey.sensors[0]
    rate = survey.rate(sensor)
    measured = next(s.axes for s in survey.files[0].chosen.sensors if s.name == sensor)
    axes = tuple(axis for axis in AXES if axis in measured)
    trend = Trend(axes) if trend is None else trend
    if trend.axes != axes:
        raise InputError(
            f"{survey.files[0].chosen.path}: has the axes {', '.join(axes)}; the trend so far is of "
            f"{', '.join(trend.axes)}"
        )
    columns = [AXES.index(axis) for axis in axes]
    parts: list[SensorBlock] = []
    length = 0

    def ended() -> Iterator[TrendPoint]:
        if length >= SHORTEST_RECORD_S * rate:
            received = np.concatenate([part.acceleration[:, columns] for part in parts])
            yield trend.take(
                record_levels(received, rate, trend.settings), float(parts[-1].time_ns[-1]) * 1e-9
            )

    for part in Stream(survey):
        if not isinstance(part, SensorBlock) or part.sensor != sensor:
            continue
        gap = bool(parts) and part.sample != parts[-1].sample + len(parts[-1].time_ns)
        if gap or length >= LONGEST_RECORD_S * rate:
            yield from ended()
            parts, length = [], 0
        parts.append(part)
        length += len(part.time_ns)
    yield from ended()


def read_memory(path: Path) -> Trend | None:
    """Read the memory of a trend; ``None`` where there is no such file yet."""
    if not path.exists():
        return None
    try:
        return Trend.of_memory(json.loads(path.read_text(encoding="utf-8")))
    except InputError as error:
        raise InputError([f"{path}: {each}" for each in error.problems]) from None
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: is no memory of a trend: {error}") from None


def remember(trend: Trend, path: Path) -> None:
    """Write the memory of a trend, for the records to come."""
    write_whole(path, json.dumps(trend.memory(), indent=1) + "\n")


def trend_with_memory(survey: Survey, memory: Path | None) -> tuple[list[TrendPoint], Trend]:
    """Give what the trend says after every record, and the trend, which a file keeps for the next time."""
    measured = next(s.axes for s in survey.files[0].chosen.sensors if s.name == survey.sensors[0])
    axes = tuple(axis for axis in AXES if axis in measured)
    trend = (read_memory(memory) if memory else None) or Trend(axes)
    points = list(trend_of(survey, trend=trend))
    if memory:
        remember(trend, memory)
    return points, trend
