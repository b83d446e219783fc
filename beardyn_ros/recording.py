"""Messages of one axlebox into files: one file a run, with proof of what was lost."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path

from beardyn_core.errors import InputError
from beardyn_core.plain_json import read_object
from beardyn_core.record.bag_scanning import INDEX
from beardyn_core.record.bag_writing import BagWriter, Splitting
from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.clouds import CLOUD
from beardyn_core.record.description import RunDescription
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import Diagnostic, decode_diagnostics, decode_string, header_stamp
from beardyn_core.record.published import (
    BLOCKS,
    MissingMessages,
    missing_messages,
    published_before,
    published_counts,
)
from beardyn_core.record.topics import STRING, Topic
from beardyn_ros.run_state import LEFT
from beardyn_ros.shared_file import BoxWriter
from beardyn_ros.strands import STEP_NS, TEMPERATURE, TopicStrands, Waiting, frame_bytes

RunWriter = McapWriter | BagWriter | BoxWriter
WHOLE = Splitting()
MESSAGES_BEFORE_TRUTH = 20_000
COUNTED_CLOUDS = ("force_waveform", "bodies", "load/blocks")
LONGEST_NAME = 60
UNSTAMPED = (STRING,)
LIVE_LOAD = ("load/wrench", "load/shaft")  # stamped by the clock of their source, whichever that is
SIMULATED = ("force", "force_waveform", "vibration", "imu", "shaft", "joint_states")
DRAWN = ("bodies", "contacts")
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
        elif name in STEP_NS:
            stamp, step = header_stamp(cdr), STEP_NS[name]
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
        self._first_ns: dict[str, int] = {}
        self._parts: set[bytes] = set()  # that have a temperature
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
            self._parts.add(frame_bytes(cdr))
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
        return published_before(self._first_ns, len(self._parts))

    @property
    def begin_s(self) -> float:
        """Simulated time from which on every topic is recorded, 0 when the whole run is, [s]."""
        if not self.before():
            return 0.0
        return max(self._first_ns[name] for name in BLOCKS if name in self._first_ns) * 1e-9


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
    refuse : callable, optional
        ``refuse(name, sentence)`` counts a message that belongs to no run.
    belongs : callable, optional
        ``belongs(name, source)`` checks whether a message that came before the truth is of its sender.

    Notes
    -----
    Topics are not ordered among each other. A message belongs to the run whose stamps it goes on from
    (`strands`); what begins anew waits for the truth of the next run, even its last word; what comes of the
    old run after that truth still belongs to the old one.
    """

    def __init__(
        self,
        path_of: Callable[[str, int], Path],
        namespace: str,
        *,
        replace: bool = False,
        splitting: Splitting = WHOLE,
        open_writer: Callable[[Path], RunWriter] | None = None,
        refuse: Callable[[str, str], None] = lambda _name, _sentence: None,
        belongs: Callable[[str, bytes], bool] = lambda _name, _source: True,
    ) -> None:
        self._path_of = path_of
        self._open_writer = open_writer or partial(own_file, namespace, replace, splitting)
        self._namespace = namespace
        self._tell_refused = refuse
        self._belongs = belongs
        self._serial = self._waiting = 0
        self._early: list[Waiting] = []  # of topics without an order
        self._strands: dict[str, TopicStrands] = {}
        self._recorded: set[str] = set()  # runs that have a file, or had one
        self._last_words: dict[str, Diagnostic] = {}  # of runs that have no file yet, by run id
        self._old: RunFile | None = None
        self._old_since = 0.0
        self._left: list[RunFile] = []
        self.current: RunFile | None = None
        self.paths: list[Path] = []

    def add(self, entry: Topic, cdr: bytes, source: bytes = b"") -> None:
        """Take one message of the table."""
        if entry.name == "truth":
            self._on_truth(entry, cdr)
            return
        self._serial += 1
        message = Waiting(self._serial, entry, cdr, source)
        if entry.name in OF_ONE_RUN or entry.name.startswith("vibration/"):
            self._add_in_order(message)
        elif self.current is None or self._is_last_word_of_the_next_run(message):
            self._early.append(message)
            self._waiting += 1
        else:
            self._file_for(message).add(entry, cdr)
        if self._waiting > MESSAGES_BEFORE_TRUTH:
            self._give_up_waiting()

    def _add_in_order(self, message: Waiting) -> None:
        name = message.entry.name
        strands = self._strands.get(name)
        if strands is None:
            strands = self._strands[name] = TopicStrands(name)
        strand = strands.take(message, self.current is not None, self._refuse)
        if strand is strands.main and self.current is not None:
            self.current.add(message.entry, message.cdr)
        elif strand is strands.old and self._old is not None:
            self._old.add(message.entry, message.cdr)
        else:
            strand.waiting.append(message)
            self._waiting += 1
            if self.current is not None and strands.believed(strand):
                self._write(strands.believe(strand))

    def _write(self, messages: list[Waiting]) -> None:
        """Write what has waited into the present file."""
        assert self.current is not None
        self._waiting -= len(messages)
        for each in messages:
            self.current.add(each.entry, each.cdr)

    def _refuse(self, message: Waiting) -> None:
        self._waiting -= 1
        self._tell_refused(
            message.entry.name,
            f"its stamp {header_stamp(message.cdr) / 1e9:.6f} s goes on from none of its run",
        )

    def _is_last_word_of_the_next_run(self, message: Waiting) -> bool:
        if message.entry.name != "/diagnostics":
            return False
        return any(_speaks_of(run_id, message.cdr) for run_id in self._last_words)

    def _give_up_waiting(self) -> None:
        """Write what has waited for a truth in vain, unless the present run goes on."""
        if self.current is None:
            self._open(None)
            return
        for strands in self._strands.values():
            for message in strands.end(self._refuse):
                self._refuse(message)
        self._waiting -= len(self._early)
        self._early.clear()

    def _on_truth(self, entry: Topic, cdr: bytes) -> None:
        text = decode_string(cdr)
        if self.current is not None and self.current.run_id == run_id_of(text):
            return
        self._open(text)
        assert self.current is not None
        self.current.add(entry, cdr)

    def _open(self, truth: str | None) -> None:
        """Begin the file of a run; the present one is kept for its stragglers."""
        self._close_old()
        was_open = self.current is not None
        self._old, self._old_since = self.current, time.monotonic()
        scene = "run"
        if truth is not None:
            scene = str(parsed_truth(truth).get("scene", "run"))
        path = self._path_of(plain_name(scene), len(self.paths) + 1)
        self.current = RunFile(path, self._namespace, truth, self._open_writer(path))
        self.paths.append(path)
        self._recorded.add(self.current.run_id)
        self.current.last_word = self._last_words.get(self.current.run_id)
        self._last_words.clear()
        early, self._early = self._early, []
        for strands in self._strands.values():
            early += strands.begin_run(self._refuse, was_open)
        early.sort(key=lambda each: each.serial)
        others = [each for each in early if not self._belongs(each.entry.name, each.source)]
        self._write([each for each in early if self._belongs(each.entry.name, each.source)])
        self._waiting -= len(others)
        for each in others:
            self._tell_refused(each.entry.name, "it came from another sender than the truth")

    def _file_for(self, message: Waiting) -> RunFile:
        assert self.current is not None
        name, cdr = message.entry.name, message.cdr
        if self._old is not None and name == "/diagnostics" and _speaks_of(self._old.run_id, cdr):
            return self._old  # its last word
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
        """Flush, decide about strays, and close the old run when its stragglers have had their time.

        Parameters
        ----------
        old_run_timeout : float
            What they get in any case, [s].
        tail_timeout : float
            What they get when the file is known to lack some, [s].
        """
        if self.current is not None:
            self._settle()
            self.current.flush_if_due()
        if self._old is not None:
            timeout = tail_timeout if self._old.missing() else old_run_timeout
            if time.monotonic() - self._old_since > timeout:
                self._close_old()

    def _settle(self) -> None:
        for strands in self._strands.values():
            for strand in [each for each in strands.waiting if strands.believed(each)]:
                if strand in strands.waiting and strands.believed(strand):
                    self._write(strands.believe(strand))
            strands.forget_strays(self._refuse)

    def _close_old(self) -> None:
        if self._old is not None:
            self._old.close(LEFT)
            self._left.append(self._old)
            self._old = None
        for strands in self._strands.values():
            strands.old = None

    def take_left(self) -> list[RunFile]:
        """Take the closed files of runs that were left by a reset, each once."""
        left, self._left = self._left, []
        return left

    def decide(self) -> None:
        """Write what waits and can be the tail of the present run, refuse the rest."""
        if self.current is not None:
            tail = [each for strands in self._strands.values() for each in strands.end(self._refuse)]
            self._write(sorted(tail, key=lambda each: each.serial))

    def close(self, status: str) -> None:
        """Finish the present run; messages of the next wait for its truth."""
        if self.current is None and (self._early or self._waiting):
            self._open(None)
        self._close_old()
        self.decide()
        if self.current is not None:
            self.current.close(status)
            self.current = None
        self._strands.clear()

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


def _speaks_of(run_id: str, diagnostics: bytes) -> bool:
    return any(status.value("run_id") == run_id for status in decode_diagnostics(diagnostics)[1])


def run_id_of(truth: str) -> str:
    """Run id in the content of ``truth``; '' when it has none."""
    return str(parsed_truth(truth).get("run_id", ""))


def parsed_truth(truth: str) -> dict[str, object]:
    """Read the content of ``truth`` as an object; empty when it is none."""
    try:
        return read_object(truth)
    except InputError:
        return {}


def plain_name(scene: str) -> str:
    """Make a part of a file name of what a truth calls its scene: no folder, nothing hidden, not long."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", scene).strip("_-")[:LONGEST_NAME] or "run"
