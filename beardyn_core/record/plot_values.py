"""Results of monitor and follower as numbers that any tool plots: one topic a quantity.

Each is a ``geometry_msgs/Vector3Stamped`` on ``values/<name>``: x is the value, y and z are the ends of its
interval, with the stamp of the result that the value is of. What is not known is NaN. Every result brings a
message on every topic of its source.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import nan
from typing import Annotated as A
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.record.messages import Template, header, make

VECTOR = "geometry_msgs/msg/Vector3Stamped"
FAMILY = "values/"
BOUNDS = ("value", "low", "high")
MONITOR, FOLLOWER = "monitor", "follower"
CODES = {
    "healthy": 0,
    "waiting": 1,
    "not_diagnosable": 2,
    "unexplained": 3,
    "spalled": 10,
    "cup": 11,
    "cone": 12,
    "roller": 13,
    "take_out": 20,
    "hot_box": 21,
}
"""Numbers of verdicts, healths and conditions; from 10 on a fault."""


@dataclass(frozen=True)
class PlotValue:
    """One quantity that is published as a number."""

    name: A[str, "behind ``values/``"]
    source: A[str, "``monitor`` or ``follower``"]
    words: A[str, "meaning"]
    unit: A[str, "SI; '-' of a pure number, 'code' of a number of `CODES`"]
    level: A[int, "of the interval in y and z, per cent; 0: without an interval"] = 0

    @property
    def topic(self) -> str:
        """Name in the topic table."""
        return FAMILY + self.name

    @property
    def content(self) -> str:
        """Describe the message for the topic table."""
        interval = f"; y, z: its {self.level} % interval" if self.level else ""
        unit = {"code": " as a code", "-": ""}.get(self.unit, f", {self.unit}")
        return f"{self.words}{unit}{interval}"


VALUES = (
    PlotValue("verdict", MONITOR, "verdict", "code"),
    PlotValue("confidence", MONITOR, "probability that the verdict is right", "-"),
    PlotValue("fault_frequency", MONITOR, "frequency of the fault that is found", "Hz"),
    PlotValue("signal_to_background", MONITOR, "level of the line of the fault, else the strongest", "dB"),
    PlotValue("score", MONITOR, "score of the strongest candidate", "dB"),
    PlotValue("threshold", MONITOR, "score from which a fault is called", "dB"),
    PlotValue("shaft_frequency", MONITOR, "mean speed of the shaft", "Hz"),
    PlotValue("rms", MONITOR, "RMS of the band-passed vibration", "m/s^2"),
    PlotValue("kurtosis", MONITOR, "kurtosis of the band-passed vibration", "-"),
    PlotValue("crest", MONITOR, "crest factor of the band-passed vibration", "-"),
    PlotValue("spall_width", MONITOR, "width of the spall in rolling direction", "m", 95),
    PlotValue("health", FOLLOWER, "health", "code"),
    PlotValue("condition", FOLLOWER, "most probable condition", "code"),
    PlotValue("condition_probability", FOLLOWER, "probability of this condition", "-"),
    PlotValue("vertical_load", FOLLOWER, "mean vertical load on the journal", "N", 90),
    PlotValue("lateral_load", FOLLOWER, "mean lateral load on the journal", "N", 90),
    PlotValue("end_play", FOLLOWER, "end play of the bearing as mounted", "m", 90),
    PlotValue("bearing_temperature", FOLLOWER, "temperature of the bearing", "K", 90),
    PlotValue("estimated_spall_width", FOLLOWER, "width of the spall along the raceway", "m", 90),
    PlotValue("estimated_spall_length", FOLLOWER, "length of the spall across the raceway", "m", 90),
    PlotValue("estimated_spall_depth", FOLLOWER, "depth of the spall", "m", 90),
    PlotValue("strangeness", FOLLOWER, "distance from the runs learnt from, familiar up to 1", "-"),
    PlotValue("remaining_mileage", FOLLOWER, "mileage until the spall must come out", "m", 90),
)
BY_TOPIC = {each.topic: each for each in VALUES}


class Bounded(NamedTuple):
    """A value and its interval, NaN where it is not known."""

    value: float = nan
    low: float = nan
    high: float = nan


def value_topics(source: str) -> tuple[str, ...]:
    """List the topics of the values of a source, ``monitor`` or ``follower``."""
    return tuple(each.topic for each in VALUES if each.source == source)


def code_of(name: str) -> float:
    """Give the number of a verdict, health or condition; NaN of an unknown one."""
    return float(CODES.get(name, nan))


class ValueEncoder:
    """Values of one source as CDR messages.

    Parameters
    ----------
    source : str
        ``monitor`` or ``follower``.
    frame : str
        Frame of the axlebox.
    """

    def __init__(self, source: str, frame: str) -> None:
        self._names = {each.name: each.topic for each in VALUES if each.source == source}
        self._template = vector_template(frame)

    def encode(self, stamp_ns: int, values: Mapping[str, Bounded]) -> Iterator[tuple[str, bytes]]:
        """Encode the values of one result: topic and bytes of every value of the source.

        Parameters
        ----------
        stamp_ns : int
            Stamp of the result, [ns].
        values : mapping of str to Bounded
            By name; one that is absent is not known.
        """
        stamps = np.array([stamp_ns], np.int64)
        for name, topic in self._names.items():
            vector = np.array([values.get(name, Bounded())], np.float64)
            yield topic, self._template.encode(stamps, vector=vector)[0]


def vector_template(frame: str) -> Template:
    """Prepare messages of ``values/<name>``: slot ``vector`` of value, lower and upper end."""

    def build(vector: NDArray[np.float64]) -> Any:
        content = make("geometry_msgs/msg/Vector3", x=vector[0], y=vector[1], z=vector[2])
        return make(VECTOR, header=header(0, frame), vector=content)

    return Template(build, {"vector": 3})
