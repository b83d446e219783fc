"""The MCAP writer of the library with chunks of our own: many messages at once, packed indexes."""

from __future__ import annotations

import zlib
from typing import Any, BinaryIO

import numpy as np
import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import Chunk, ChunkIndex
from mcap.writer import CompressionType, Writer
from numpy.typing import NDArray

from beardyn_core.base.arrays import Int

# as small as that of the library's level, 3, in a third of the time: samples of noise do not pack
LEVEL = 1
# for many axleboxes at once: a seventh larger, in three fifths of the time of that
QUICK_LEVEL = -2
_MESSAGE = np.dtype(
    [
        ("opcode", "u1"),
        ("length", "<u8"),
        ("channel", "<u2"),
        ("sequence", "<u4"),
        ("log", "<u8"),
        ("at", "<u8"),
    ]
)
MESSAGE_BYTES = _MESSAGE.itemsize
_INDEX = np.dtype([("time", "<u8"), ("offset", "<u8")])


class ChunkWriter(Writer):
    """Writer whose chunks end where `flush` is called, and nowhere else.

    The indexes of messages and chunks are kept as bytes: the library's objects take ten times the memory.
    """

    def __init__(self, file: BinaryIO | Any, level: int = LEVEL) -> None:
        super().__init__(file, chunk_size=1 << 62, compression=CompressionType.ZSTD)
        self._level = level
        self._chunks = _PackedIndexes()
        self._Writer__chunk_indices = self._chunks
        self._indexes: dict[int, list[NDArray[Any]]] = {}
        self._first_ns, self._last_ns = 1 << 63, 0

    def add_rows(self, channel: int, times_ns: Int, sequence: int, rows: NDArray[np.uint8]) -> None:
        """Append messages of one channel.

        Parameters
        ----------
        times_ns : int64 array, shape [message]
            Log time of each, at least 0, [ns].
        sequence : int
            Of the first message.
        rows : uint8 array, shape [message, byte]
            CDR.
        """
        count, size = rows.shape
        if not count:
            return
        records = np.empty((count, MESSAGE_BYTES + size), np.uint8)
        records[:, MESSAGE_BYTES:] = rows
        head = records[:, :MESSAGE_BYTES].view(_MESSAGE)[:, 0]
        head["opcode"], head["length"] = Opcode.MESSAGE, MESSAGE_BYTES - 9 + size
        head["channel"], head["log"], head["at"] = channel, times_ns, times_ns
        head["sequence"] = (sequence + np.arange(count)) & 0xFFFFFFFF
        index = np.empty(count, _INDEX)
        index["time"] = times_ns
        index["offset"] = self._chunk.count + np.arange(count) * records.shape[1]
        self._indexes.setdefault(channel, []).append(index)
        self._chunk.write(records.data)
        first, last = int(times_ns.min()), int(times_ns.max())
        self._first_ns, self._last_ns = min(self._first_ns, first), max(self._last_ns, last)
        statistics: Any = self._Writer__statistics  # type: ignore[attr-defined]
        begin = statistics.message_start_time if statistics.message_count else first
        statistics.message_start_time = min(begin, first)
        statistics.message_end_time = max(statistics.message_end_time, last)
        statistics.channel_message_counts[channel] += count
        statistics.message_count += count

    @property
    def _chunk(self) -> RecordBuilder:
        """The records of the chunk in progress."""
        builder: RecordBuilder = self._Writer__chunk_builder.record_writer  # type: ignore[attr-defined]
        return builder

    def _Writer__finalize_chunk(self) -> None:
        """Write the chunk in progress, if it has a message, and the index of each of its channels."""
        if not self._indexes:
            return
        records = self._chunk.end()
        packed = zstandard.ZstdCompressor(level=self._level).compress(records)
        begin, end = self._first_ns, self._last_ns
        chunk = Chunk(
            compression="zstd", data=packed, message_start_time=begin, message_end_time=end,
            uncompressed_crc=zlib.crc32(records), uncompressed_size=len(records),
        )  # fmt: skip
        builder, stream = self._Writer__record_builder, self._Writer__stream  # type: ignore[attr-defined]
        stream.write(builder.end())
        at = stream.tell()
        chunk.write(builder)
        length = builder.count
        stream.write(builder.end())
        index_at, offsets = stream.tell(), {}
        for channel, parts in self._indexes.items():
            offsets[channel] = index_at + builder.count
            entries = np.concatenate(parts).tobytes()
            builder.start_record(Opcode.MESSAGE_INDEX)
            builder.write2(channel)
            builder.write4(len(entries))
            builder.write(entries)
            builder.finish_record()
        self._chunks.append(
            ChunkIndex(
                message_start_time=begin, message_end_time=end, chunk_start_offset=at, chunk_length=length,
                message_index_offsets=offsets, message_index_length=builder.count, compression="zstd",
                compressed_size=len(packed), uncompressed_size=len(records),
            )
        )  # fmt: skip
        stream.write(builder.end())
        self._Writer__statistics.chunk_count += 1  # type: ignore[attr-defined]
        self._indexes.clear()
        self._first_ns, self._last_ns = 1 << 63, 0


class _PackedIndexes:
    """Indexes of the chunks of a file as bytes; the library keeps ten times as much until the end."""

    def __init__(self) -> None:
        self._records = bytearray()

    def append(self, index: ChunkIndex) -> None:
        builder = RecordBuilder()
        index.write(builder)
        self._records += builder.end()

    def __iter__(self) -> Any:
        return iter((self,))

    def write(self, builder: RecordBuilder) -> None:
        builder.write(self._records)
