"""Measured files as a recording: the topics and bytes of a simulated one, marked as measured."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.base.interrupts import hold_interrupts
from beardyn_core.base.outputs import recording_problems
from beardyn_core.measured.about import Mounted, about
from beardyn_core.measured.stream import SensorBlock, Stream
from beardyn_core.measured.survey import Survey
from beardyn_core.record.clouds import CloudTemplate, fill, points_of
from beardyn_core.record.encoding import ACCELERATION_AXES, SHAFT_JOINT, VIBRATION, joint_template
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.topics import FRAME, vibration_topic


@dataclass(frozen=True)
class Imported:
    """A recording that was made of measured files."""

    path: Path
    duration: A[float, "[s]"]
    survey: Survey
    warnings: tuple[str, ...]


def write_measured(
    survey: Survey,
    path: Path | str,
    bearings: Sequence[Mounted] = (),
    *,
    force: bool = False,
    progress: Callable[[float], None] | None = None,
) -> Imported:
    """Write measured files to a recording, block by block.

    Parameters
    ----------
    path : Path
        MCAP file.
    bearings : sequence of Mounted
        Bearing data, stored with it.
    force : bool
        Whether an existing file is replaced; one of those that are read never is.
    progress : callable, optional
        Called with the time [s] up to which the recording goes.

    Raises
    ------
    InputError
        It cannot be written; what an interruption leaves is closed and readable.
    """
    path = Path(path)
    inputs = [each.chosen.path for each in survey.files]
    if problems := recording_problems("", path, inputs=inputs, force=force):
        raise InputError(problems)
    stream, names, status = Stream(survey), survey.sensors, "interrupted while it was imported"
    writer = McapWriter(path, replace=force)
    vibration = {name: CloudTemplate(VIBRATION, f"{FRAME}/{name}") for name in names}
    shaft = joint_template(SHAFT_JOINT, FRAME, effort=False)
    try:
        writer.describe_measured(about(survey, bearings))
        for part in stream:
            stamp = int(part.time_ns[0])
            with hold_interrupts():
                if isinstance(part, SensorBlock):
                    points = points_of(VIBRATION, part.sample, part.time_ns, stamp)
                    fill(points, ACCELERATION_AXES, part.acceleration)
                    topic = vibration_topic(names.index(part.sensor), names)
                    writer.add(topic, stamp, vibration[part.sensor].encode(points, stamp))
                else:
                    turned, turning = part.angle[:, None], part.speed[:, None]
                    messages = shaft.encode(part.time_ns, position=turned, velocity=turning)
                    for time, cdr in zip(part.time_ns.tolist(), messages, strict=True):
                        writer.add("shaft", time, cdr)
            if progress is not None and isinstance(part, SensorBlock):
                progress(float(part.time_ns[-1]) * 1e-9)
        status = ""
    except InputError as error:
        status = error.problems[0]
        raise
    finally:
        with hold_interrupts():
            writer.close(status)
    return Imported(path, survey.duration, survey, tuple(dict.fromkeys(stream.warnings)))
