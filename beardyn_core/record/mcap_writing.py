"""Crash-safe MCAP files of raw CDR messages that rosbag2, Foxglove and rerun read."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from mcap.well_known import MessageEncoding, SchemaEncoding
from numpy.typing import NDArray

from beardyn_core.base.arrays import Int
from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import open_to_write
from beardyn_core.base.versions import versions
from beardyn_core.record.background_file import BackgroundFile
from beardyn_core.record.bag_metadata import FileFacts, bag_metadata, qos_text, type_hash, yaml_text
from beardyn_core.record.chunk_writing import LEVEL, MESSAGE_BYTES, ChunkWriter
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_scanning import END_RECORD, trim
from beardyn_core.record.messages import typestore
from beardyn_core.record.topics import NAMESPACE, Topic, topic

CHUNK_BYTES = 1024 * 1024
FLUSH_SECONDS = 0.5
DESCRIPTION_FILE = "run.json"
SCENE_FILE = "scene.yaml"
SUMMARY_RECORD = "beardyn"
MEASURED_FILE = "measured.json"
COMPLETE = "complete"

_VERSION = versions()["beardyn"]
_RECORD_BYTES = MESSAGE_BYTES + 16  # around a message in a chunk, and of it in the index


class McapWriter:
    """MCAP file, profile ``ros2``, that a kill leaves readable up to the last flush.

    Messages are gathered into zstd chunks of about `CHUNK_BYTES`; `flush_if_due`, which every
    `add` calls, hands the chunk in progress to the operating system twice a second. A caller that
    can fall silent calls it from a timer too. A disk that refuses is an `InputError` that says what the
    file holds, up to its last whole chunk; further writing raises the same and `close` does nothing.
    The file is locked while it is open, so that no other process writes it too.

    Parameters
    ----------
    namespace : str
        Of the topics with relative names.
    replace : bool
        Whether an existing file is replaced; otherwise it is an `InputError`.
    background : bool
        Whether a thread writes, so that a slow disk does not hold up the caller.
    level : int
        Of zstd.
    """

    def __init__(
        self,
        path: Path | str,
        namespace: str = NAMESPACE,
        *,
        replace: bool = False,
        background: bool = False,
        level: int = LEVEL,
    ) -> None:
        self.path = Path(path)
        self._namespace = namespace
        try:
            file = open_to_write(self.path, replace=replace)
        except OSError as error:
            raise InputError(
                f"{self.path}: cannot write the recording ({error.strerror}); "
                "choose a file in a folder that exists and is writable"
            ) from error
        self._file: Any = file
        if background:
            self._file = BackgroundFile(file)
        self._writer = ChunkWriter(self._file, level)  # chunks end where `add_rows` and `flush_if_due` say
        self._chunk_bytes = 0
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._counts: dict[str, int] = {}
        self._first_ns: int | None = None
        self._last_ns = 0
        self._flushed = monotonic()
        self._failure: InputError | None = None
        self._closed = False
        with self._disk():
            self._writer.start(profile="ros2", library=f"beardyn {_VERSION}")

    def describe(self, run: RunDescription) -> None:
        """Store the resolved scene and the description as attachments, the main facts as metadata."""
        facts = {"scene": run.scene, "bearing": run.shape.name, "beardyn": _VERSION}
        facts.update(
            {key: value if isinstance(value, str) else json.dumps(value) for key, value in run.truth.items()}
        )
        with self._disk():
            self._writer.add_attachment(0, 0, SCENE_FILE, "application/yaml", run.scene_text.encode())
            self._writer.add_attachment(0, 0, DESCRIPTION_FILE, "application/json", run.to_json().encode())
            self._writer.add_metadata(SUMMARY_RECORD, facts)
            self._writer.flush()

    def describe_measured(self, facts: Mapping[str, Any]) -> None:
        """Mark the recording as measured: what is known of it as an attachment, and no truth."""
        text = json.dumps(facts, default=str)
        with self._disk():
            self._writer.add_attachment(0, 0, MEASURED_FILE, "application/json", text.encode())
            self._writer.add_metadata(SUMMARY_RECORD, {"origin": "measured", "beardyn": _VERSION})
            self._writer.flush()

    def add(self, name: str, stamp_ns: int, cdr: bytes) -> None:
        """Append a message of the topic table; see `add_rows`."""
        self.add_rows(name, np.array([stamp_ns], np.int64), np.frombuffer(cdr, np.uint8)[None])

    def add_rows(self, name: str, stamps_ns: Int, rows: NDArray[np.uint8]) -> None:
        """Append messages of one topic and one length.

        Parameters
        ----------
        name : str
            Name in the topic table.
        stamps_ns : int64 array, shape [message]
            Stamps of their headers, which become the log times, [ns]. Times before zero are logged as 0:
            MCAP does not know them; the header keeps the true one.
        rows : uint8 array, shape [message, byte]
            CDR.
        """
        count = len(rows)
        if not count:
            return
        times = np.maximum(stamps_ns, 0)
        with self._disk():
            channel = self._channels.get(name)
            if channel is None:
                channel = self._open_channel(topic(name))
            self._writer.add_rows(channel, times, self._counts[name] + 1, rows)
            self._counts[name] += count
        self._chunk_bytes += count * (rows.shape[1] + _RECORD_BYTES)
        first = int(times.min())
        self._first_ns = first if self._first_ns is None else min(self._first_ns, first)
        self._last_ns = max(self._last_ns, int(times.max()))
        self.flush_if_due()

    def flush_if_due(self) -> None:
        """Write the chunk in progress to the file when it is full or `FLUSH_SECONDS` have passed."""
        now = monotonic()
        if self._chunk_bytes >= CHUNK_BYTES or now - self._flushed >= FLUSH_SECONDS:
            self._flushed = now
            self.flush()

    def flush(self) -> None:
        """Write the chunk in progress to the file."""
        self._chunk_bytes = 0
        with self._disk():
            self._writer.flush()

    def close(self, status: str = "") -> None:
        """Write the summary and close the file; a second call does nothing.

        Parameters
        ----------
        status : str
            How the run ended, a sentence; empty for a run that ended as asked, which the file calls
            `COMPLETE`.

        Raises
        ------
        InputError
            The disk refused; the file is closed all the same.
        """
        if self._closed:
            return
        facts = bag_metadata([self.facts], self._namespace)
        with self._disk():
            self._closed = True
            self._writer.flush()  # the last chunk first: a file that lacks it must not say how it ended
            self._writer.add_metadata(END_RECORD, {"status": status or COMPLETE})
            self._writer.add_metadata("rosbag2", {"serialized_metadata": yaml_text(facts)})
            self._writer.finish()
            self._file.close()

    @property
    def message_count(self) -> int:
        """Messages written so far."""
        return sum(self._counts.values())

    @property
    def counts(self) -> Mapping[str, int]:
        """Messages written so far by name in the topic table."""
        return self._counts

    @property
    def size(self) -> int:
        """Bytes of the file so far, the chunk in progress as large as if it could not be compressed."""
        return int(self._file.tell()) + self._chunk_bytes

    @property
    def facts(self) -> FileFacts:
        """What the metadata of rosbag2 says about the file."""
        return FileFacts(self.path.name, self._first_ns or 0, self._last_ns, dict(self._counts))

    @contextmanager
    def _disk(self) -> Iterator[None]:
        if self._failure is not None:
            raise self._failure
        try:
            yield
        except OSError as error:
            self._closed = True
            with suppress(OSError):  # it tries once more to write what the disk has refused
                self._file.close()
            reason = error.strerror or str(error)
            self._failure = InputError(
                f"cannot write on {self.path}: {reason}; {trim(self.path)}; "
                "free space or choose a file on another disk"
            )
            raise self._failure from error

    def _open_channel(self, entry: Topic) -> int:
        schema = self._schemas.get(entry.type)
        if schema is None:
            definition, _ = typestore().generate_msgdef(entry.type, ros_version=2)
            schema = self._writer.register_schema(
                entry.type, SchemaEncoding.ROS2, definition.rstrip().encode() + b"\n"
            )
            self._schemas[entry.type] = schema
        channel = self._writer.register_channel(
            entry.path(self._namespace),
            MessageEncoding.CDR,
            schema,
            {
                "offered_qos_profiles": qos_text(entry),
                "topic_type_hash": type_hash(entry.type),
            },
        )
        self._channels[entry.name], self._counts[entry.name] = channel, 0
        return channel
