"""A recording in several files: a folder as rosbag2 makes it, each file whole in itself."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.base.outputs import write_whole
from beardyn_core.record.bag_metadata import FileFacts, bag_metadata, yaml_text
from beardyn_core.record.bag_scanning import CONTINUED, INDEX, files_of, part_name
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_writing import McapWriter

# Kept free in a file for what is written when it ends: schemas, channels, indexes, metadata.
_SUMMARY_BYTES = 128 * 1024
_WORTHWHILE = 0.05  # share of a file that still has to be free after a chunk, else a new one begins
# Stamped by others, ahead, or not at all: the length of a file is that of the twin's signals.
_NOT_TIMED = ("load/", "monitor/", "truth", "/")
SMALLEST_BYTES = 1_000_000


@dataclass(frozen=True)
class Splitting:
    """When a new file begins; 0: never for that reason."""

    most_bytes: A[int, "size of a file"] = 0
    longest_ns: A[int, "simulated time in a file, [ns]"] = 0

    def __bool__(self) -> bool:
        """Tell whether files are split at all."""
        return bool(self.most_bytes or self.longest_ns)


class BagWriter:
    """Files ``<folder>_0.mcap``, ``<folder>_1.mcap`` ... in a folder, and their index ``metadata.yaml``.

    The index is written when a file begins and when the last one ends. Each file has scene and description,
    says where it goes on, and survives a kill as a `McapWriter` does.

    Parameters
    ----------
    folder : Path
        Made when it is missing.
    namespace : str
        Of the topics.
    splitting : Splitting
    replace : bool
        Whether the files of an earlier recording in the folder are removed; otherwise they are an
        `InputError`.
    background : bool
        As of `McapWriter`.

    Raises
    ------
    InputError
        The folder cannot be made or holds a recording.
    """

    def __init__(
        self,
        folder: Path,
        namespace: str,
        splitting: Splitting,
        *,
        replace: bool = False,
        background: bool = False,
    ) -> None:
        self.path = folder
        self._namespace = namespace
        self._splitting = splitting
        self._background = background
        self._run: RunDescription | None = None
        self._done: list[FileFacts] = []
        self._done_counts: Counter[str] = Counter()
        self._begin_ns: int | None = None
        try:
            folder.mkdir(exist_ok=True)
            _clear(folder, replace)
        except OSError as error:
            raise InputError(
                f"{folder}: cannot be made a folder for the recording ({error.strerror}); choose another name"
            ) from error
        self._writer = self._open()

    def describe(self, run: RunDescription) -> None:
        """Store scene and description in this file and in those that follow."""
        self._run = run
        self._writer.describe(run)

    def add(self, name: str, stamp_ns: int, cdr: bytes) -> None:
        """Append a message of the topic table, in a new file when this one is full."""
        if self._is_full(name, stamp_ns, cdr):
            self._begin_next()
        if self._begin_ns is None and not name.startswith(_NOT_TIMED):
            self._begin_ns = stamp_ns
        self._writer.add(name, stamp_ns, cdr)

    def flush_if_due(self) -> None:
        """Hand what has come to the operating system."""
        self._writer.flush_if_due()

    def close(self, status: str = "") -> None:
        """Finish the last file and the index."""
        self._writer.close(status)
        self._write_index()

    @property
    def message_count(self) -> int:
        """Messages written so far."""
        return self._done_counts.total() + self._writer.message_count

    @property
    def counts(self) -> Mapping[str, int]:
        """Messages written so far by name in the topic table."""
        return self._done_counts + Counter(self._writer.counts)

    def _is_full(self, name: str, stamp_ns: int, cdr: bytes) -> bool:
        if not self._writer.message_count:
            return False
        most, longest = self._splitting.most_bytes, self._splitting.longest_ns
        if most:
            free = most - _SUMMARY_BYTES - len(cdr)
            if self._writer.size > free:
                self._writer.flush()  # compressed it is smaller than was feared
                if self._writer.size > free - _WORTHWHILE * most:
                    return True
        if not longest or self._begin_ns is None or name.startswith(_NOT_TIMED):
            return False
        return stamp_ns - self._begin_ns >= longest

    def _begin_next(self) -> None:
        self._writer.close(f"{CONTINUED}{part_name(self.path, len(self._done) + 1)}")
        self._done.append(self._writer.facts)
        self._done_counts.update(self._writer.counts)
        self._begin_ns = None
        self._writer = self._open()
        if self._run is not None:
            self._writer.describe(self._run)

    def _open(self) -> McapWriter:
        path = self.path / part_name(self.path, len(self._done))
        self._writer = McapWriter(path, self._namespace, background=self._background)
        self._write_index()
        return self._writer

    def _write_index(self) -> None:
        content = bag_metadata([*self._done, self._writer.facts], self._namespace)
        try:
            write_whole(self.path / INDEX, yaml_text({"rosbag2_bagfile_information": content}))
        except OSError as error:
            raise InputError(
                f"{self.path / INDEX}: cannot be written ({error.strerror}); the files next to it are whole, "
                "free space for more"
            ) from error


def _clear(folder: Path, replace: bool) -> None:
    """Remove an earlier recording from a folder, or refuse to."""
    there = files_of(folder) if (folder / INDEX).is_file() else sorted(folder.glob("*.mcap"))
    if there and not replace:
        raise InputError(f"{folder}: holds a recording already; give another name, or replace it")
    for path in there:
        with suppress(FileNotFoundError):
            path.unlink()
