"""Reading MCAP from the front, up to the first damaged record.

Ordinary readers begin at the summary in the end of a file and reject one that was cut off. Here the
records are read in the order they were written, so everything up to the last complete chunk is found.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Annotated as A
from typing import BinaryIO

import zstandard
from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, Chunk, McapRecord, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer

from beardyn_core.base.errors import InputError
from beardyn_core.base.inputs import size_of_file
from beardyn_core.base.outputs import is_being_written, open_to_write
from beardyn_core.record.chunk_reading import ChunkReader

END_RECORD = "beardyn_end"
LONGEST_RECORD = 256 * 1024 * 1024
MAGIC = b"\x89MCAP0\r\n"

# What the mcap library and the decompressor raise on bytes that were cut or damaged.
_DAMAGE = (
    *(McapError, zstandard.ZstdError, struct.error),
    *(ValueError, KeyError, IndexError, EOFError, MemoryError, ImportError, RuntimeError),
)


@dataclass(frozen=True)
class RecordedMessage:
    """One message of a file."""

    topic: str
    type: str
    log_time: A[int, "[ns]"]
    cdr: bytes


class McapScan:
    """A pass over a file from the front; iterate `messages`, then read the attributes.

    Attributes
    ----------
    size_bytes, usable_bytes : int
        Of the file, and up to the end of the last record that could be used.
    complete : bool
        The file was closed properly; known after the pass.
    problem : str
        Where and why reading stopped, a sentence; empty when complete.

    Raises
    ------
    InputError
        The file is absent or is not MCAP at all.
    """

    def __init__(self, path: Path | str) -> None:
        self.path = Path(path)
        try:
            self.size_bytes = size_of_file(self.path)
            with self.path.open("rb") as file:
                start = file.read(len(MAGIC))
        except OSError as error:
            raise InputError(
                f"{self.path}: cannot read the recording ({error.strerror}); give the path of an .mcap file"
            ) from error
        if start != MAGIC[: len(start)] or not start:
            what = "is empty" if not start else "is not an MCAP file"
            raise InputError(
                f"{self.path}: the file {what}; give a recording made by beardyn or rosbag2; of a measured "
                "file `beardyn import` makes one, and `beardyn monitor` takes it as it is"
            )
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.channels: dict[int, Channel] = {}
        self.schemas: dict[int, Schema] = {}
        self.usable_bytes = 0
        self.complete = False
        self.problem = ""

    def messages(self) -> Iterator[RecordedMessage]:
        """Read the messages in the order of the file."""
        for message in self.raw_messages():
            channel = self.channels[message.channel_id]
            yield RecordedMessage(
                channel.topic, self.schemas[channel.schema_id].name, message.log_time, message.data
            )

    def raw_messages(self) -> Iterator[Message]:
        """Read the messages as MCAP records; their channels and schemas are in the attributes by then."""
        with self.path.open("rb") as file:
            reader = StreamReader(file, emit_chunks=True, record_size_limit=LONGEST_RECORD)
            records, chunks = iter(reader.records), ChunkReader(self.size_bytes)
            while True:
                try:
                    record = next(records)
                    inside = chunks.records(record) if isinstance(record, Chunk) else [record]
                    found = self._sort(inside)
                except StopIteration:
                    # The reader ends without an error only behind the footer and the closing magic.
                    self.complete = True
                    return
                except _DAMAGE as error:
                    self._stop_at(error)
                    return
                self.usable_bytes = file.tell()
                yield from found

    def _sort(self, records: Sequence[McapRecord]) -> list[Message]:
        messages = []
        for record in records:
            if isinstance(record, Message):
                if self.channels[record.channel_id].schema_id not in self.schemas:
                    raise KeyError(f"channel {record.channel_id} has no schema")
                messages.append(record)
            elif isinstance(record, Schema):
                self.schemas[record.id] = record
            elif isinstance(record, Channel):
                self.channels[record.id] = record
            elif isinstance(record, Attachment):
                self.attachments[record.name] = record.data
            elif isinstance(record, Metadata):
                self.metadata[record.name] = dict(record.metadata)
        return messages

    def _stop_at(self, error: Exception) -> None:
        reason = f" ({error})" if str(error) else ""
        self.problem = (
            f"{self.path}: the file was not closed properly; usable up to byte {self.usable_bytes} "
            f"of {self.size_bytes}{reason}"
        )


@dataclass(frozen=True)
class Recovery:
    """Result of recovering a cut-off file."""

    path: A[Path, "the cut file"]
    target: A[Path, "the repaired one"]
    size_bytes: int
    usable_bytes: int
    message_count: int
    seconds: A[float, "from the first to the last message found"]

    def sentence(self) -> str:
        """Describe the recovery in a sentence."""
        return (
            f"{self.path} was cut off: recovered {self.message_count} messages, {self.seconds:.3f} s, from "
            f"{self.usable_bytes} of {self.size_bytes} bytes into {self.target}"
        )


class EmptyRecordingError(InputError):
    """A file that was cut off before its first chunk was complete."""


def recovered_name(path: Path | str) -> Path:
    """Name the file that a cut-off one is recovered into, ``<name>.recovered.mcap`` next to it."""
    return Path(path).with_suffix(".recovered.mcap")


def recover(path: Path | str, target: Path | str | None = None, *, replace: bool = False) -> Recovery:
    """Copy everything that is readable in a cut-off file into a properly closed one.

    Parameters
    ----------
    target : Path, optional
        `recovered_name` by default.
    replace : bool
        Whether an existing target is replaced.

    Raises
    ------
    InputError
        Nothing is recoverable, the file is still being written, or the target exists or cannot be written;
        then there is no new target.
    """
    source = Path(path)
    target = Path(target) if target is not None else recovered_name(source)
    if is_being_written(source):
        raise InputError(f"{source}: another process is writing this file; it will be closed at its end")
    scan = McapScan(source)
    messages = iter(scan.raw_messages())
    first = next(messages, None)
    if first is None:
        raise EmptyRecordingError(
            f"{source}: the file holds no complete chunk, nothing can be recovered from its "
            f"{scan.size_bytes} bytes"
        )
    try:
        file = open_to_write(target, replace=replace)
    except OSError as error:
        raise InputError(f"{target}: cannot write the recovered recording ({error.strerror})") from error
    try:
        with file:
            count, begin, end = _copy(scan, chain([first], messages), file)
    except BaseException as error:
        with suppress(OSError):
            target.unlink()
        if isinstance(error, OSError):
            raise InputError(
                f"{target}: cannot write the recovered recording ({error.strerror}); {source} is as it was, "
                "copy it to a disk with space and report it there"
            ) from error
        raise
    return Recovery(source, target, scan.size_bytes, scan.usable_bytes, count, (end - begin) * 1e-9)


def _copy(scan: McapScan, messages: Iterator[Message], file: BinaryIO) -> tuple[int, int, int]:
    """Write the messages of a scan to a file; return their count, first and last log time [ns]."""
    count, begin, end = 0, 1 << 63, 0
    writer = Writer(file, compression=CompressionType.ZSTD)
    writer.start(profile="ros2", library="beardyn recover")
    schemas: dict[int, int] = {}
    channels: dict[int, int] = {}
    for message in messages:
        channel = scan.channels[message.channel_id]
        if channel.id not in channels:
            schema = scan.schemas[channel.schema_id]
            if schema.id not in schemas:
                schemas[schema.id] = writer.register_schema(schema.name, schema.encoding, schema.data)
            channels[channel.id] = writer.register_channel(
                channel.topic, channel.message_encoding, schemas[schema.id], dict(channel.metadata)
            )
        writer.add_message(
            channels[channel.id], message.log_time, message.data, message.publish_time, message.sequence
        )
        count, begin, end = count + 1, min(begin, message.log_time), max(end, message.log_time)
    for name, data in scan.attachments.items():
        writer.add_attachment(0, 0, name, "application/octet-stream", data)
    for name, facts in scan.metadata.items():
        writer.add_metadata(name, facts)
    if END_RECORD not in scan.metadata:
        writer.add_metadata(END_RECORD, {"status": f"cut off; recovered from {scan.path.name}"})
    writer.finish()
    return count, begin, end


def trim(path: Path) -> str:
    """Cut a file whose writer failed behind its last whole record, and report its content.

    Its index would need space that is not there, so it stays a cut-off file, which everything here reads. A
    file without any message goes altogether.
    """
    if not path.is_file():
        return "nothing of the run has been kept"
    try:
        scan = McapScan(path)
        count, last = 0, 0
        for message in scan.raw_messages():
            count, last = count + 1, max(last, message.log_time)
        if count:
            os.truncate(path, scan.usable_bytes)
    except (InputError, OSError):
        count = 0
    if not count:
        with suppress(OSError):
            path.unlink()
        return "nothing of the run could be kept, and the file has been removed"
    return (
        f"the file holds the run until {last * 1e-9:.3f} s, {count} messages, without an index: "
        "`beardyn report` makes a copy with one"
    )
