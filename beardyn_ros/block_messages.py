"""The messages of a block, and of the truth that begins a run."""

from __future__ import annotations

from dataclasses import replace

from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.messages import encode_string
from beardyn_core.sensors.block import Block
from beardyn_ros.load_feed import LoadFeed
from beardyn_ros.run_state import Outgoing, SessionOptions
from beardyn_ros.source_time import Offset, encode_time_reference

REFERENCE_EVERY = 10  # blocks
# one sample a message: spread over the block, while a waveform is one message a block
TREND_TOPICS = ("force", "imu", "shaft", "joint_states")


class BlockMessages:
    """Encodes the blocks of one run.

    Parameters
    ----------
    description : RunDescription
    pictures : bool
        Whether bodies and contacts are sent as well.
    options : SessionOptions
    feed : LoadFeed
        Knows where in the time of its source the load begins.
    """

    def __init__(
        self, description: RunDescription, pictures: bool, options: SessionOptions, feed: LoadFeed
    ) -> None:
        self._encoder = BlockEncoder(description.roller_count, description.sensor_names, options.frame)
        self._pictures = pictures
        self._options = options
        self._feed = feed

    def of(self, block: Block, offset: Offset, ordered: bool = False) -> Outgoing:
        """Encode a block with the stamps that it is to have."""
        messages, trends, stamped = [], [], block.later(offset.ahead_ns)
        first_ns = int(stamped.trend_time_ns[0]) if len(stamped.trend_time_ns) else 0
        for name, stamp_ns, cdr in self._encoder.encode(stamped, self._pictures):
            if name in TREND_TOPICS:
                trends.append(((stamp_ns - first_ns) * 1e-9, name, cdr))
            else:
                messages.append((name, cdr))
        trends.sort(key=lambda trend: trend[0])
        if self._options.of_source and (offset.is_new or block.index % REFERENCE_EVERY == 0):
            reference = encode_time_reference(stamped.end_ns, block.end_ns, self._options.frame)
            messages.append(("source_time", reference))
        live = self._options.mode == "live"
        consumed_ns = stamped.end_ns if live else block.end_ns + self._feed.begin_ns
        return Outgoing(tuple(messages), tuple(trends), block.end_ns, stamped.end_ns, consumed_ns, ordered)


def truth_message(description: RunDescription, **more: int) -> Outgoing:
    """Make the message that begins a run."""
    described = replace(description, truth={**description.truth, **more})
    return Outgoing((("truth", encode_string(described.to_json())),))
