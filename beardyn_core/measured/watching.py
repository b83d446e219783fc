"""Measured files through monitors, one for each bearing on the shaft, without a recording."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from beardyn_core.measured.about import Mounted, beside_others
from beardyn_core.measured.stated_speed import uncertainty_of
from beardyn_core.measured.stream import SensorBlock, Stream
from beardyn_core.measured.survey import Survey
from beardyn_core.monitor.chain import REFERENCE, Algorithm, MonitorResult, MonitorSettings
from beardyn_core.monitor.streaming import Monitor, MonitorInput, measured_axes

_NONE, _NEVER = np.empty(0), np.empty(0, np.int64)


def watch(
    survey: Survey,
    bearings: Sequence[Mounted],
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
    warnings: list[str] | None = None,
) -> Iterator[tuple[Mounted, MonitorResult]]:
    """Give the results of all bearings as they become due, in one pass over the files.

    By default the speed is as uncertain as the way it is known. The bearings are neighbours of each other.
    What was found on the way is added to the ``warnings`` at the end.
    """
    first = survey.sensors[0]
    settings = settings or MonitorSettings(speed_uncertainty=uncertainty_of(survey))
    monitors = {
        each.label: Monitor(
            each.plate.frequencies,
            each.plate.roller_count,
            survey.rate(each.sensor or first),
            beside_others(settings, each, bearings),
            algorithm,
            each.plate,
        )
        for each in bearings
    }
    stream = Stream(survey)
    for part in stream:
        for each in bearings:
            monitor = monitors[each.label]
            if isinstance(part, SensorBlock):
                if part.sensor != (each.sensor or first):
                    continue
                given = MonitorInput(
                    part.time_ns,
                    measured_axes(part.acceleration),
                    _NEVER,
                    _NONE,
                    _NEVER,
                    _NONE,
                    _NEVER,
                    _NONE,
                )
            else:
                given = MonitorInput(
                    _NEVER, np.empty((0, 1)), part.time_ns, part.angle, _NEVER, _NONE, _NEVER, _NONE
                )
            result = monitor.take(given)
            if result is not None:
                yield each, result
    if warnings is not None:
        warnings += stream.warnings
