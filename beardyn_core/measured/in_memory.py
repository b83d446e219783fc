"""Measured files as a `Run` in memory: the arrays of a simulated one as far as they were measured."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from beardyn_core.measured.about import Mounted, about
from beardyn_core.measured.stream import SensorBlock, Stream
from beardyn_core.measured.survey import Survey
from beardyn_core.record import arrays
from beardyn_core.record.encoding import ACCELERATION_AXES
from beardyn_core.record.mcap_writing import COMPLETE
from beardyn_core.record.message_source import MessageSource
from beardyn_core.record.run import Run


class _Source(MessageSource):
    """Vibration and shaft; whatever else a run has is there with no samples."""

    def __init__(self, sensors: dict[str, arrays.Signal], shaft: arrays.Turning, seconds: float) -> None:
        super().__init__({}, None)
        self._sensors, self._shaft, self._seconds = sensors, shaft, seconds

    def sensors(self) -> dict[str, arrays.Signal]:
        return self._sensors

    def shaft(self) -> arrays.Turning:
        return self._shaft

    def duration(self) -> float:
        return self._seconds


def run_of(survey: Survey, bearings: Sequence[Mounted] = ()) -> Run:
    """Read measured files as a whole into memory."""
    stream = Stream(survey)
    received: dict[str, list[SensorBlock]] = {name: [] for name in survey.sensors}
    turned = []
    for part in stream:
        if isinstance(part, SensorBlock):
            received[part.sensor].append(part)
        else:
            turned.append(part)
    sensors = {
        name: arrays.Signal(
            np.concatenate([part.time_ns for part in parts]),
            np.concatenate([part.acceleration for part in parts]),
            ACCELERATION_AXES,
            "m/s^2",
            np.concatenate([part.sample + np.arange(len(part.time_ns)) for part in parts]),
        )
        for name, parts in received.items()
    }
    nothing = np.empty(0)
    shaft = arrays.Turning(
        np.concatenate([np.empty(0, np.int64), *(part.time_ns for part in turned)]),
        np.concatenate([nothing, *(part.angle for part in turned)]),
        np.concatenate([nothing, *(part.speed for part in turned)]),
    )
    facts = about(survey, bearings)
    facts["warnings"] += stream.warnings
    paths = [each.chosen.path for each in survey.files]
    return Run(_Source(sensors, shaft, survey.duration), None, path=paths[0], status=COMPLETE, measured=facts)
