"""One run in one file: what was written, what is missing, how it began.

The file is of the run alone, or shared by several axleboxes, each under its namespace, as `beardyn simulate`
writes it.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from beardyn_core.base.errors import InputError
from beardyn_core.base.plain_json import read_object
from beardyn_core.record.bag_writing import BagWriter
from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import (
    Diagnostic,
    decode_diagnostics,
    header_frame,
    header_stamp,
    time_reference,
)
from beardyn_core.record.published import (
    BLOCKS,
    MissingMessages,
    missing_messages,
    published_before,
    published_counts,
)
from beardyn_core.record.stamp_offset import StampOffset, earliest_stamp
from beardyn_core.record.topics import STRING, Topic
from beardyn_ros.strands import STEP_NS, TEMPERATURE

COUNTED_CLOUDS = ("force_waveform", "bodies", "load/blocks")
DIAGNOSTICS = "/diagnostics"
UNSTAMPED = (STRING,)
LIVE_LOAD = ("load/wrench", "load/shaft")  # stamped by the clock of their source, whichever that is
SIMULATED = ("force", "force_waveform", "vibration", "imu", "shaft", "joint_states")
DRAWN = ("bodies", "contacts")
OF_ONE_RUN = (*SIMULATED, *DRAWN, TEMPERATURE)  # their stamps begin anew with each run


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
        """Append a message; of the topics that all boxes receive, what is of this one."""
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


RunWriter = McapWriter | BagWriter | BoxWriter


class LossWatch:
    """Finds holes in the running indices (clouds) and in the stamps (trends) of each topic.

    Stamps of a source leap where its clock is set; `source_time` says when, and nothing is lost there.
    """

    def __init__(self) -> None:
        self.received: dict[str, int] = {}
        self.missed_at_start = 0
        self._next_sample: dict[str, int] = {}
        self._last_ns: dict[str, int] = {}
        self._missing: Counter[str] = Counter()  # of clouds
        self._gaps: list[tuple[str, int, int]] = []  # of trends: topic, stamps on either side
        self.offset = StampOffset()

    def count_message(self, entry: Topic, cdr: bytes) -> None:
        """Note one message."""
        name = entry.name
        if entry.type == CLOUD and (name in COUNTED_CLOUDS or name.startswith("vibration")):
            samples = cloud_points(cdr)["sample"]
            if len(samples):
                first, last = int(samples[0]), int(samples[-1])
                if name == "vibration" and name not in self.received:
                    self.missed_at_start = first
                self._count(name, first - self._next_sample.get(name, first), last + 1 - first)
                self._next_sample[name] = last + 1
        elif name in STEP_NS:
            stamp, step = header_stamp(cdr), STEP_NS[name]
            last = self._last_ns.get(name, stamp - step)
            if stamp - last > 1.5 * step:
                self._gaps.append((name, last, stamp))
            self._count(name, 0, 1)
            self._last_ns[name] = stamp
        elif name == "source_time":
            self.offset.add(header_stamp(cdr), time_reference(cdr))

    def _count(self, name: str, missing: int, here: int) -> None:
        self.received[name] = self.received.get(name, 0) + here
        if missing > 0:
            self._missing[name] += missing

    @property
    def lost(self) -> dict[str, int]:
        """Samples that were published but never came, by topic."""
        found = Counter(self._missing)
        for name, last, stamp in self._gaps:
            found[name] += self.offset.count_missing(last, stamp, STEP_NS[name])
        return {name: count for name, count in found.items() if count}

    @property
    def total(self) -> int:
        """Samples that were published but never came."""
        return sum(self.lost.values())


class RunFile:
    """One run in one MCAP file, in a folder of several, or in a file that it shares.

    Parameters
    ----------
    path : Path
        Of the folder when files are split.
    namespace : str
    truth : str or None
        Content of the topic; ``None`` when none has come.
    writer : RunWriter
        Of the file.
    """

    def __init__(self, path: Path, namespace: str, truth: str | None, writer: RunWriter) -> None:
        self.path = path
        self._namespace = namespace
        self.run_id = ""
        self.last_word: Diagnostic | None = None
        self.problem = ""
        self.description: RunDescription | None = None
        self.loss = LossWatch()
        self.last_ns: dict[str, int] = {}
        self._first_ns: dict[str, int] = {}
        self._parts: set[str] = set()  # that have a temperature
        self._simulated_ns = 0
        self.origin_ns = 0  # earliest stamp of the run
        self._writer = writer
        if truth is None:
            self.problem = "no truth has come: the file does not name its scene"
            return
        self.run_id = run_id_of(truth)
        self.origin_ns = self._simulated_ns = earliest_stamp(parsed_truth(truth))
        self.loss.offset = StampOffset(earliest_ns=self.origin_ns)
        try:
            self.description = RunDescription.from_json(truth)
        except InputError as error:
            self.problem = str(error)
        else:
            self._writer.describe(self.description)

    def add(self, entry: Topic, cdr: bytes) -> None:
        """Append one message; live load stands at the last stamp of the twin, its header as it came.

        What was said before the run stands at its beginning.
        """
        stamp = max(0 if entry.type in UNSTAMPED else header_stamp(cdr), self.origin_ns)
        if entry.name in LIVE_LOAD or entry.name == "load/truth":
            stamp = self._simulated_ns
        elif entry.name in SIMULATED:
            self._simulated_ns = max(self._simulated_ns, stamp)
        if entry.name == TEMPERATURE:
            self._parts.add(header_frame(cdr))
        last = self.last_ns.get(entry.name, 0)
        if entry.name == "load/blocks" and stamp < last:
            stamp = last  # the empty block that ends the stream carries no time
        self.last_ns[entry.name] = stamp
        first = self._first_ns.get(entry.name, stamp)
        self._first_ns[entry.name] = min(first, stamp)
        self._writer.add(entry.name, stamp, cdr)
        self.loss.count_message(entry, cdr)

    def flush_if_due(self) -> None:
        """Bring what has come to the operating system; also needed when nothing comes any more."""
        self._writer.flush_if_due()

    def close(self, status: str) -> None:
        """Finish the file; `status` is empty when the run ended as asked."""
        self._writer.close(status)

    @property
    def message_count(self) -> int:
        """Messages written so far."""
        return self._writer.message_count

    @property
    def counts(self) -> Mapping[str, int]:
        """Messages written so far by name in the topic table."""
        return self._writer.counts

    def missing(self) -> list[MissingMessages] | None:
        """List the topics that the twin has published more of; ``None`` when it has had no last word."""
        published = published_counts(self.last_word, self._namespace) if self.last_word else {}
        return missing_messages(published, self.counts, self.before()) if published else None

    def before(self) -> dict[str, int]:
        """Count the messages of the run that were published before the recorder was there, by topic."""
        first_ns = self.loss.offset.first_ns
        ahead_ns = self.origin_ns if first_ns is None else first_ns
        simulated_ns = {name: stamp - ahead_ns for name, stamp in self._first_ns.items()}
        return published_before(simulated_ns, len(self._parts))

    @property
    def begin_s(self) -> float:
        """Stamp from which on every topic is recorded, 0 when the whole run is, [s]."""
        if not self.before():
            return 0.0
        blocks = [stamp for name, stamp in self._first_ns.items() if name in BLOCKS]
        return max(blocks or self._first_ns.values()) * 1e-9


def run_id_of(truth: str) -> str:
    """Run id in the content of ``truth``; '' when it has none."""
    return str(parsed_truth(truth).get("run_id", ""))


def parsed_truth(truth: str) -> dict[str, object]:
    """Read the content of ``truth`` as an object; empty when it is none."""
    try:
        return read_object(truth)
    except InputError:
        return {}
