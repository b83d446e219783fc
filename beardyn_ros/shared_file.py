"""One file for the runs of several axleboxes, each under its namespace, as `beardyn simulate` writes it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import decode_diagnostics

DIAGNOSTICS = "/diagnostics"


class SharedFiles:
    """The first runs of all boxes in one file, their second runs, after a reset, in the next.

    Parameters
    ----------
    namespaces : sequence of str
        Of the boxes; the first one's recorder writes what is of no box.
    replace : bool
        Whether existing files are replaced.
    """

    def __init__(self, namespaces: Sequence[str], *, replace: bool = False) -> None:
        self._namespaces = tuple(namespaces)
        self._replace = replace
        self._paths: dict[int, Path] = {}
        self._files: dict[Path, _SharedFile] = {}

    def path_of(self, number: int, choose: Callable[[], Path]) -> Path:
        """Give the path of the file of the runs of a number; the first box that asks chooses it."""
        if number not in self._paths:
            self._paths[number] = choose()
        return self._paths[number]

    def writer(self, path: Path, namespace: str) -> BoxWriter:
        """Open the file, or join in it."""
        if path not in self._files:
            first = not self._files  # after a reset some boxes may have no run any more
            self._files[path] = _SharedFile(path, self._namespaces, replace=self._replace, whole=first)
        return BoxWriter(self._files[path], namespace)

    def close(self) -> None:
        """Finish the files in which not every box has had a run."""
        for file in self._files.values():
            file.close()


class _SharedFile:
    """A file, and how the run of each box in it has ended."""

    def __init__(self, path: Path, namespaces: Sequence[str], *, replace: bool, whole: bool) -> None:
        self.namespaces = namespaces
        self._whole = whole
        self.mcap = McapWriter(path, namespaces[0], replace=replace, background=True)
        self._ended: dict[str, str] = {}

    def end_run(self, namespace: str, status: str) -> None:
        """Note the end of the run of a box; the last one closes the file."""
        self._ended[namespace] = status
        if self._ended.keys() >= set(self.namespaces):
            self.close()

    def close(self) -> None:
        """Finish the file; a second call does nothing."""
        ends = [f"{space.strip('/')}: {status}" for space, status in self._ended.items() if status]
        if self._whole:
            ends += [f"{space.strip('/')}: no run" for space in self.namespaces if space not in self._ended]
        self.mcap.close("; ".join(ends))


class BoxWriter:
    """Writes the run of one box into a file that it shares.

    Its description is the topic ``truth``: attachments are of a file with one run.
    """

    def __init__(self, file: _SharedFile, namespace: str) -> None:
        self._file = file
        self._namespace = namespace
        self._is_first = namespace == file.namespaces[0]
        self._counts: Counter[str] = Counter()

    def describe(self, run: RunDescription) -> None:
        """Write nothing, see the class."""

    def add(self, name: str, stamp_ns: int, cdr: bytes) -> None:
        """Append a message; of the topics that all boxes hear, what is of this one."""
        self._counts[name] += 1
        if not name.startswith("/"):
            self._file.mcap.add(f"{self._namespace}/{name}", stamp_ns, cdr)
        elif self._is_of_this_box(name, cdr):
            self._file.mcap.add(name, stamp_ns, cdr)

    def _is_of_this_box(self, name: str, cdr: bytes) -> bool:
        if name != DIAGNOSTICS:
            return self._is_first
        said = [f"/{status.name}" for status in decode_diagnostics(cdr)[1]]
        spaces = [
            space for space in self._file.namespaces if any(each.startswith(f"{space}/") for each in said)
        ]
        return spaces[0] == self._namespace if spaces else self._is_first

    def flush_if_due(self) -> None:
        """Hand what has come to the operating system."""
        self._file.mcap.flush_if_due()

    def close(self, status: str = "") -> None:
        """End the run of this box."""
        self._file.end_run(self._namespace, status)

    @property
    def message_count(self) -> int:
        """Messages of this box so far."""
        return self._counts.total()

    @property
    def counts(self) -> Mapping[str, int]:
        """Messages of this box so far by name in the topic table."""
        return self._counts
