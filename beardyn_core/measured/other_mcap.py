"""MCAP of other tools: ROS 2 messages with their definitions, and JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.measured.options import Reading
from beardyn_core.measured.source import Channel, Held
from beardyn_core.record.other_messages import TIME, Topics, is_recording

_LATENCY_NS = 500_000_000  # from a sample to its message in the log, compared with the length of one


class _Topics(Held):
    topics: Topics

    def blocks(self, names: Sequence[str]) -> Iterator[Float]:
        """Give the samples of channels of one topic from the beginning, shape [sample, channel]."""
        topic = self.columns[names[0]][0]
        yield from self.topics.blocks(topic, [self.columns[name][1] for name in names])


def open_file(path: Path, reading: Reading) -> Held:
    """List every number of the messages: ``/imu.linear_acceleration.x``, and the time of each topic.

    Raises
    ------
    InputError
        It is a recording of an axlebox, and no channel is named: its `imu` alone looks like a file of another
        tool, and is not its vibration.
    """
    if not reading.channels and is_recording(path):
        raise InputError(
            f"{path}: is a recording of an axlebox; report, monitor, export and beardyn_core.read take it as "
            "it is; to make another one of a part of it give --channels"
        )
    topics = Topics(path)
    channels, columns = [], {}
    origins: dict[str, int] = {}
    delays: dict[str, int] = {}
    notes: list[str] = []
    for topic, found in topics.found.items():
        for member in (TIME, *found.members):
            name = f"{topic}.{member}"
            unit = "s" if member == TIME else found.unit(member)
            axis = found.axis(member)
            channels.append(Channel(name, topic, None, unit, is_time=member == TIME, axis=axis))
            columns[name] = (topic, member)
        origins[f"{topic}.{TIME}"] = found.first_ns
        delays[topic] = found.log_delay_ns
        notes += [
            f"each message of {topic} has {count} numbers in {member}, and no layout: they are taken as "
            "samples"
            for member, count in found.lists.items()
        ]
    spans = [found.span_ns for found in topics.found.values() if found.has_blocks]
    made = _Topics(
        tuple(channels), columns, {}, {}, (*topics.notes, *notes), origins=origins, log_delays=delays,
        longest_delay=max(spans, default=0) + _LATENCY_NS,
    )  # fmt: skip
    made.topics = topics
    made.problems += topics.problems
    return made
