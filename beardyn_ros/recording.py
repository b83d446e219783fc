"""Messages of one axlebox into files: one file a run, with proof of what was lost."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from beardyn_core.record.bag_scanning import INDEX
from beardyn_core.record.bag_writing import BagWriter, Splitting
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import Diagnostic, decode_diagnostics, decode_string, header_stamp
from beardyn_core.record.topics import Topic
from beardyn_ros.run_file import LIVE_LOAD, OF_ONE_RUN, UNSTAMPED, RunFile, RunWriter, parsed_truth, run_id_of
from beardyn_ros.run_state import LEFT
from beardyn_ros.strands import TopicStrands, Waiting

WHOLE = Splitting()
MESSAGES_BEFORE_TRUTH = 20_000
LONGEST_NAME = 60
NOT_OF_A_RUN = (*LIVE_LOAD, "/diagnostics", "/clock", "load/consumed")  # they go on from run to run


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
            origin_ns = 0 if self.current is None else self.current.origin_ns
            strands = self._strands[name] = TopicStrands(name, origin_ns)
        strand = strands.take(message, self.current is not None, self._refuse)
        if strand is strands.main and self.current is not None:
            self.current.add(message.entry, message.cdr)
        elif strand is strands.old and self._old is not None:
            self._old.add(message.entry, message.cdr)
        else:
            strand.waiting.append(message)
            self._waiting += 1
            if self.current is not None and strands.is_believed(strand):
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
        """Write what has waited for a truth in vain, unless a run goes on or the last one is over."""
        if self.current is None:
            if self._is_between_runs():
                self._early = self._early[len(self._early) // 2 :]  # the next run may begin with the rest
                self._waiting = len(self._early)
            else:
                self._open(None)
            return
        for strands in self._strands.values():
            for message in strands.end(self._refuse):
                self._refuse(message)
        self._waiting -= len(self._early)
        self._early.clear()

    def _is_between_runs(self) -> bool:
        """Check whether all that waits goes on behind a run that is over, and so is of none."""
        idle = sum(each.entry.name in NOT_OF_A_RUN for each in self._early)
        return bool(self.paths) and idle == self._waiting

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
            early += strands.begin_run(self._refuse, was_open, self.current.origin_ns)
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
        stamped = message.entry.type not in UNSTAMPED and name not in NOT_OF_A_RUN
        if self._old is not None and stamped and 0 < header_stamp(cdr) < self.current.origin_ns:
            return self._old
        return self.current

    def receive(self, status: Diagnostic) -> None:
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
            for strand in [each for each in strands.waiting if strands.is_believed(each)]:
                if strand in strands.waiting and strands.is_believed(strand):
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
        if self.current is None and (self._early or self._waiting) and not self._is_between_runs():
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


def plain_name(scene: str) -> str:
    """Make a part of a file name of what a truth calls its scene: no folder, nothing hidden, not long."""
    return re.sub(r"[^A-Za-z0-9_-]+", "_", scene).strip("_-")[:LONGEST_NAME] or "run"
