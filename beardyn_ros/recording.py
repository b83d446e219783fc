"""Messages of one axlebox into files: one file a run, with proof of what was lost."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from beardyn_core.errors import InputError
from beardyn_core.record.bag_scanning import INDEX
from beardyn_core.record.bag_writing import BagWriter, Splitting
from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import Diagnostic, decode_diagnostics, decode_string, header_stamp
from beardyn_core.record.published import MissingMessages, missing_messages, published_counts
from beardyn_core.record.topics import STRING, Topic
from beardyn_ros.run_state import LEFT
from beardyn_ros.shared_file import BoxWriter

RunWriter = McapWriter | BagWriter | BoxWriter
WHOLE = Splitting()
MESSAGES_BEFORE_TRUTH = 20_000
COUNTED_CLOUDS = ("force_waveform", "bodies", "load/blocks")
STAMP_STEPS_NS = {"force": 2_500_000, "imu": 2_500_000, "shaft": 2_500_000, "joint_states": 5_000_000}
UNSTAMPED = (STRING,)
LIVE_LOAD = ("load/wrench", "load/shaft")  # stamped by the clock of their source, whichever that is
SIMULATED = ("force", "force_waveform", "vibration", "imu", "shaft", "joint_states")
DRAWN = ("bodies", "contacts")
TEMPERATURE = "temperature"  # one message for each part, all of one stamp
OF_ONE_RUN = (*SIMULATED, *DRAWN, TEMPERATURE)  # their stamps begin anew with each run


class LossWatch:
    """Finds holes in the running indices (clouds) and in the stamps (trends) of each topic."""

    def __init__(self) -> None:
        self.lost: dict[str, int] = {}
        self.received: dict[str, int] = {}
        self.missed_at_start = 0
        self._next_sample: dict[str, int] = {}
        self._last_ns: dict[str, int] = {}

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
        elif name in STAMP_STEPS_NS:
            stamp, step = header_stamp(cdr), STAMP_STEPS_NS[name]
            self._count(name, round((stamp - self._last_ns.get(name, stamp - step)) / step) - 1, 1)
            self._last_ns[name] = stamp

    def _count(self, name: str, missing: int, here: int) -> None:
        self.received[name] = self.received.get(name, 0) + here
        if missing > 0:
            self.lost[name] = self.lost.get(name, 0) + missing

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
        self._parts: set[bytes] = set()  # whose temperature of the last stamp has come
        self._simulated_ns = 0
        self._writer = writer
        if truth is None:
            self.problem = "no truth has come: the file does not say which scene it holds"
            return
        self.run_id = run_id_of(truth)
        try:
            self.description = RunDescription.from_json(truth)
        except InputError as error:
            self.problem = str(error)
        else:
            self._writer.describe(self.description)

    def add(self, entry: Topic, cdr: bytes) -> None:
        """Append one message; live load stands at the last simulated time seen, its header as it came."""
        stamp = 0 if entry.type in UNSTAMPED else header_stamp(cdr)
        if entry.name in LIVE_LOAD or entry.name == "load/truth":
            stamp = self._simulated_ns
        elif entry.name in SIMULATED:
            self._simulated_ns = max(self._simulated_ns, stamp)
        if entry.name == TEMPERATURE:
            if stamp != self.last_ns.get(entry.name):
                self._parts.clear()
            self._parts.add(_frame(cdr))
        last = self.last_ns.get(entry.name, 0)
        if entry.name == "load/blocks" and stamp < last:
            stamp = last  # the empty block that ends the stream carries no time
        self.last_ns[entry.name] = stamp
        self._writer.add(entry.name, stamp, cdr)
        self.loss.count_message(entry, cdr)

    def goes_on(self, name: str, cdr: bytes) -> bool:
        """Tell whether a message can be of this run: its stamp has not jumped back."""
        stamp, last = header_stamp(cdr), self.last_ns[name]
        return stamp > last or (stamp == last and name == TEMPERATURE and _frame(cdr) not in self._parts)

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
        return missing_messages(published, self.counts) if published else None


class Recording:
    """Sorts messages into one file per run.

    Parameters
    ----------
    path_of : callable
        ``path_of(scene, number)`` gives the path of the next file; `number` counts from 1.
    namespace : str
        Of the topics.
    replace : bool
        Whether existing files are replaced.
    splitting : Splitting
    open_writer : callable, optional
        ``open_writer(path)`` opens what a run is written with, in place of a file of its own.

    Notes
    -----
    Topics are not ordered among each other: where the stamps of a topic jump back its part of the new run
    begins. What comes before the truth of that run waits for it, even its last word; what comes of the old
    run after that truth still belongs to the old one.
    """

    def __init__(
        self,
        path_of: Callable[[str, int], Path],
        namespace: str,
        *,
        replace: bool = False,
        splitting: Splitting = WHOLE,
        open_writer: Callable[[Path], RunWriter] | None = None,
    ) -> None:
        self._path_of = path_of
        self._open_writer = open_writer or partial(own_file, namespace, replace, splitting)
        self._namespace = namespace
        self._early: list[tuple[Topic, bytes]] = []
        self._ahead: set[str] = set()
        self._recorded: set[str] = set()  # runs that have a file, or had one
        self._last_words: dict[str, Diagnostic] = {}  # of runs that have no file yet, by run id
        self._old: RunFile | None = None
        self._switched: set[str] = set()
        self._old_since = 0.0
        self._left: list[RunFile] = []
        self.current: RunFile | None = None
        self.paths: list[Path] = []

    def add(self, entry: Topic, cdr: bytes) -> None:
        """Take one message of the table."""
        if entry.name == "truth":
            self._on_truth(entry, cdr)
            return
        if self.current is None or self._is_ahead(entry, cdr):
            self._early.append((entry, cdr))
            if len(self._early) > MESSAGES_BEFORE_TRUTH:
                self._leave_current()
                self._open(None)
            return
        self._file_for(entry, cdr).add(entry, cdr)

    def _is_ahead(self, entry: Topic, cdr: bytes) -> bool:
        """Tell whether a message is of a run whose truth has not come: its stamp has jumped back."""
        assert self.current is not None
        name = entry.name
        if name == "/diagnostics":
            return any(_speaks_of(run_id, cdr) for run_id in self._last_words)
        if name in self._ahead:
            return True
        if not (name in OF_ONE_RUN or name.startswith("vibration/")):
            return False
        if name not in self.current.last_ns or self.current.goes_on(name, cdr):
            return False
        self._ahead.add(name)
        return True

    def _on_truth(self, entry: Topic, cdr: bytes) -> None:
        text = decode_string(cdr)
        if self.current is not None and self.current.run_id == run_id_of(text):
            return
        self._leave_current()
        self._open(text)
        assert self.current is not None
        self.current.add(entry, cdr)

    def _leave_current(self) -> None:
        """Keep the present run, if there is one, for its stragglers."""
        self._close_old()
        if self.current is not None:
            self._old, self._switched, self._old_since = self.current, self._ahead, time.monotonic()
        self._ahead = set()

    def _open(self, truth: str | None) -> None:
        scene = "run"
        if truth is not None:
            scene = str(parsed_truth(truth).get("scene", "run"))
        path = self._path_of(scene, len(self.paths) + 1)
        self.current = RunFile(path, self._namespace, truth, self._open_writer(path))
        self.paths.append(path)
        self._recorded.add(self.current.run_id)
        self.current.last_word = self._last_words.get(self.current.run_id)
        self._last_words.clear()
        early, self._early = self._early, []
        for entry, cdr in early:
            self.current.add(entry, cdr)

    def _file_for(self, entry: Topic, cdr: bytes) -> RunFile:
        assert self.current is not None
        if self._old is None or entry.type in UNSTAMPED:
            return self.current
        if entry.name in LIVE_LOAD:
            return self.current  # its clock may run on through a reset
        if entry.name == "/diagnostics" and _speaks_of(self._old.run_id, cdr):
            return self._old  # its last word
        if entry.name in self._switched:
            return self.current
        if entry.name in self._old.last_ns and self._old.goes_on(entry.name, cdr):
            return self._old
        self._switched.add(entry.name)
        return self.current

    def hear(self, status: Diagnostic) -> None:
        """Note the last word of a twin with the file of the run that it is about, or for the one to come.

        To be called before the message that carries it is added.
        """
        run_id = status.value("run_id")
        if not run_id:
            return
        files = [each for each in (self.current, self._old) if each is not None and each.run_id == run_id]
        for file in files:
            file.last_word = status
        without_truth = self.current is not None and not self.current.run_id
        if run_id not in self._recorded and not without_truth:
            self._last_words[run_id] = status

    def flush_and_close_old(self, old_run_timeout: float, tail_timeout: float) -> None:
        """Flush, and close the old run when its stragglers have had their time.

        Parameters
        ----------
        old_run_timeout : float
            What they get in any case, [s].
        tail_timeout : float
            What they get when the file is known to lack some, [s].
        """
        if self.current is not None:
            self.current.flush_if_due()
        if self._old is not None:
            timeout = tail_timeout if self._old.missing() else old_run_timeout
            if time.monotonic() - self._old_since > timeout:
                self._close_old()

    def _close_old(self) -> None:
        if self._old is not None:
            self._old.close(LEFT)
            self._left.append(self._old)
            self._old = None

    def take_left(self) -> list[RunFile]:
        """Take the closed files of runs that were left by a reset, each once."""
        left, self._left = self._left, []
        return left

    def close(self, status: str) -> None:
        """Finish the present run; messages of the next wait for its truth."""
        self._close_old()
        if self.current is None and self._early:
            self._open(None)
        if self.current is not None:
            self.current.close(status)
            self.current = None

    @property
    def lost_samples(self) -> int:
        """Of the present run."""
        return self.current.loss.total if self.current else 0


def own_file(namespace: str, replace: bool, splitting: Splitting, path: Path) -> McapWriter | BagWriter:
    """Open a file, or a folder where files are split, for one run of one box."""
    if splitting:
        return BagWriter(path, namespace, splitting, replace=replace, background=True)
    return McapWriter(path, namespace, replace=replace, background=True)


def free_name(path: Path, number: int) -> Path:
    """Name the file of a run: ``run.mcap``, ``run_2.mcap`` and so on, the first that does not exist.

    A run that has begun cannot be refused any more, so an earlier file makes it take a later number.

    Parameters
    ----------
    path : Path
        Of the first run.
    number : int
        Of the run, from 1.
    """
    named = path if number == 1 else path.with_name(f"{path.stem}_{number}{path.suffix}")
    return free_name(path, number + 1) if named.is_file() or is_recorded(named) else named


def is_recorded(folder: Path) -> bool:
    """Tell whether a folder holds a recording in several files."""
    return folder.is_dir() and ((folder / INDEX).exists() or any(folder.glob("*.mcap")))


def _frame(cdr: bytes) -> bytes:
    """Take the frame of a message that begins with a header: its length stands behind the stamp."""
    length = int.from_bytes(cdr[12:16], "little")
    return cdr[16 : 16 + length]


def _speaks_of(run_id: str, diagnostics: bytes) -> bool:
    return any(status.value("run_id") == run_id for status in decode_diagnostics(diagnostics)[1])


def run_id_of(truth: str) -> str:
    """Run id in the content of ``truth``; '' when it has none."""
    return str(parsed_truth(truth).get("run_id", ""))


def parsed_truth(truth: str) -> dict[str, object]:
    """Read the content of ``truth`` as an object; empty when it is none."""
    try:
        content = json.loads(truth)
    except ValueError:
        return {}
    return content if isinstance(content, dict) else {}
