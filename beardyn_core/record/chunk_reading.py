"""Chunks of an MCAP file, unpacked within bounds: a few kilobytes can claim to hold gigabytes."""

from __future__ import annotations

import io
import struct
from dataclasses import replace
from importlib import import_module

import zstandard
from mcap.exceptions import McapError
from mcap.records import Chunk, McapRecord
from mcap.stream_reader import breakup_chunk

LARGEST_CHUNK = 32 * 1024 * 1024  # bytes unpacked; writers of recordings use 1 to 4 MB
LARGEST_RATIO = 300  # bytes unpacked for each byte of the file, beyond `ALWAYS_UNPACKED`
ALWAYS_UNPACKED = 16 * 1024 * 1024
ALWAYS_READ = 100_000  # records
BYTES_PER_RECORD = 4  # of the file, for each record beyond `ALWAYS_READ`; ours take 30 and more
_RECORD = struct.Struct("<BQ")  # kind, length


class ChunkReader:
    """Unpacks the chunks of one file.

    Parameters
    ----------
    file_bytes : int
        Size of the file, which bounds what its chunks may hold together.
    """

    def __init__(self, file_bytes: int) -> None:
        self._left = ALWAYS_UNPACKED + LARGEST_RATIO * file_bytes
        self._records_left = ALWAYS_READ + file_bytes // BYTES_PER_RECORD

    def records(self, chunk: Chunk) -> list[McapRecord]:
        """Read the records in a chunk.

        Raises
        ------
        McapError
            The chunk holds more than is allowed, or something else than it states.
        """
        limit = min(LARGEST_CHUNK, self._left)
        data = self._unpack_chunk(chunk, limit)
        if len(data) > limit:
            raise McapError(
                f"a chunk of {len(chunk.data)} bytes holds more than {limit} bytes: {_write_limit(limit)}"
            )
        if len(data) != chunk.uncompressed_size:
            raise McapError(f"a chunk states {chunk.uncompressed_size} bytes and holds {len(data)}")
        self._left -= len(data)
        self._count_records(data)
        return list(breakup_chunk(replace(chunk, compression="", data=data), validate_crc=True))

    def _count_records(self, data: bytes) -> None:
        """Count before anything is made of them: an empty record takes nine bytes and much more time."""
        at = 0
        while at < len(data):
            self._records_left -= 1
            if self._records_left < 0:
                raise McapError(
                    "the file holds more records than one of its size can: reading them would exhaust time "
                    "and memory; record again without empty messages"
                )
            _, length = _RECORD.unpack_from(data, at)
            at += _RECORD.size + length

    def _unpack_chunk(self, chunk: Chunk, limit: int) -> bytes:
        """Unpack at most one byte more than the limit, whatever the chunk states."""
        if chunk.uncompressed_size > limit:
            raise McapError(
                f"a chunk of {len(chunk.data)} bytes states {chunk.uncompressed_size} bytes: "
                f"{_write_limit(limit)}"
            )
        if chunk.compression == "zstd":
            with zstandard.ZstdDecompressor().stream_reader(io.BytesIO(chunk.data)) as stream:
                return bytes(stream.read(limit + 1))
        if chunk.compression == "lz4":
            lz4 = import_module("lz4.frame")
            return bytes(lz4.LZ4FrameDecompressor().decompress(chunk.data, limit + 1))
        if chunk.compression:
            raise McapError(f"a chunk is packed by '{chunk.compression[:20]}'; known are zstd and lz4")
        return chunk.data


def _write_limit(limit: int) -> str:
    return f"allowed here are {limit} (it would exhaust time and memory); record again with smaller chunks"
