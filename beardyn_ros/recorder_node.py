"""Records every topic of the table into crash-safe MCAP files, one a run or several."""

from __future__ import annotations

import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from rclpy.node import Node

from beardyn_core.base.errors import InputError
from beardyn_core.record.bag_writing import SMALLEST_BYTES, Splitting
from beardyn_core.record.messages import (
    Diagnostic,
    decode_diagnostics,
    decode_string,
    decode_told,
    encode_diagnostics,
)
from beardyn_core.record.published import MissingMessages, missing_sentence
from beardyn_core.record.topics import TOPICS, Topic, topic
from beardyn_ros.diagnostics import OK, RECORDER, TWIN, WARN, TwinWatch, diagnostic_name, run_instance
from beardyn_ros.frames import frame_of
from beardyn_ros.message_guard import MessageGuard
from beardyn_ros.node_parameters import PARAMETERS
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.recording import Recording, free_name, is_recorded
from beardyn_ros.run_file import RunFile, SharedFiles, run_id_of
from beardyn_ros.run_state import END_STATES, LEFT
from beardyn_ros.runtime import EXIT_INCOMPLETE, EXIT_LOAD_LOST, run_node, wall_timer
from beardyn_ros.wire import RawIntake, SourcedHandler, TopicPublishers

TICK_S = 0.05
REPORT_PERIOD_S = 0.5
# Fast DDS by itself sends again what was lost up to 3 s later; a twin that is gone sends nothing any more.
TAIL_TIMEOUT_S = 8.0
GONE_TIMEOUT_S = 1.0
COUNTS_TIMEOUT_S = 2.0
JUDGES_TIMEOUT_S = 20.0
OLD_RUN_TIMEOUT_S = 1.0
LAST_WORDS_TIMEOUT_S = 0.5
MOST_OTHER_TRUTHS = 4
JUDGES = ("monitor/result", "follower/estimate")  # whose last word comes after the end of the twin
TWIN_TOPICS = (
    "truth",
    "force",
    "force_waveform",
    "vibration",
    "imu",
    "shaft",
    "joint_states",
    "bodies",
    "contacts",
)


class RecorderNode(Node):
    """Every topic of one axlebox into files.

    Parameters
    ----------
    shared : SharedFiles, optional
        Files that it shares with the recorders of other boxes, in place of its own.
    **of_node
        Passed on to the node: another namespace, parameters.
    """

    def __init__(self, shared: SharedFiles | None = None, **of_node: Any) -> None:
        super().__init__("recorder", **{"namespace": "axlebox", **of_node})
        self._shared = shared
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS["recorder"])
        self._splitting = Splitting(
            round(self._values.max_file_size * 1e6), round(self._values.max_file_duration * 1e9)
        )
        self._check_output()
        space = self.get_namespace()
        self._recording = Recording(
            self._path_of,
            space,
            replace=self._values.replace,
            splitting=self._splitting,
            open_writer=None if shared is None else lambda path: shared.writer(path, space),
            refuse=lambda name, sentence: self._guard.refuse(name, sentence),
            belongs=lambda name, source: self._guard.sources.follows(name, source),
        )
        self._out = TopicPublishers(self, "/diagnostics")
        self._intake = RawIntake(self, polled=True)
        self._guard = MessageGuard(self)
        self._names: set[str] = set()
        self._other_truths: dict[bytes, bytes] = {}  # of twins that are not followed, by publisher
        # of a sweep the truth comes first: the messages behind it may be of the run that it begins
        for entry in sorted(TOPICS, key=lambda each: each.name != "truth"):
            self._record(entry)
        self._watch = TwinWatch(
            diagnostic_name(self.get_namespace(), TWIN),
            lambda: self._guard.sources.count("truth"),
        )
        self._ended_at: float | None = None
        self._lacking = (0, 0.0)
        self._judged: set[str] = set()  # topics that have had their last word
        self._reported_at = 0.0
        self._announced_ready = False
        wall_timer(self, TICK_S, self._tick)
        self.get_logger().info(f"recorder of {self.get_namespace()} is waiting for a twin")

    def _check_output(self) -> None:
        output, most = self._values.output, self._splitting.most_bytes
        if 0 < most < SMALLEST_BYTES:
            raise InputError(
                f"node recorder: max_file_size {most / 1e6:g} MB is too small for what a file states about "
                f"itself; give at least {SMALLEST_BYTES / 1e6:g} MB, or 0 for no limit"
            )
        if not output:
            return
        path = Path(output).expanduser()
        if not path.resolve().parent.is_dir():
            raise InputError(
                f"node recorder: output '{output}': the folder does not exist; create it or choose another"
            )
        if path.is_dir() and not self._splitting:
            raise InputError(f"node recorder: output '{output}' is a folder; a file name is needed")
        there = self._name_output(path)
        if (there.is_file() or is_recorded(there)) and not self._values.replace:
            what = "file" if there.is_file() else "folder"
            raise InputError(
                f"node recorder: output '{there}': the {what} exists; give another name, or replace:=true"
            )

    def _name_output(self, path: Path) -> Path:
        """Name what a run is written to: a file, or a folder when files are split."""
        return path.with_suffix("") if self._splitting and path.suffix == ".mcap" else path

    def _path_of(self, scene: str, number: int) -> Path:
        if self._shared is not None:
            return self._shared.path_of(number, lambda: self._new_path(scene, number))
        return self._new_path(scene, number)

    def _new_path(self, scene: str, number: int) -> Path:
        if self._values.output:
            path = Path(self._values.output).expanduser()
        else:
            path = Path(f"{scene}_{time.strftime('%Y%m%d_%H%M%S')}.mcap")
        path = self._name_output(path)
        if number > 1 or not self._values.replace:
            path = free_name(path, number)
        self.get_logger().info(f"recording into {path}")
        return path

    # --- messages ----------------------------------------------------------------------------------

    def _record(self, entry: Topic) -> None:
        if entry.name not in self._names:
            self._names.add(entry.name)
            if entry.name == "truth":
                self._intake.add_sourced(entry, self._offer_truth, complete=True)
                return
            guarded = self._guard.guarded_sourced(entry, self._handler(entry))
            self._intake.add_sourced(entry, guarded, complete=True)

    def _handler(self, entry: Topic) -> SourcedHandler:
        def take(cdr: bytes, source: bytes) -> None:
            if entry.name == "/diagnostics":
                self._on_statuses(decode_diagnostics(cdr)[1])
            self._recording.add(entry, cdr, source)
            if entry.name == "monitor/result":
                if any(status.value("final") == "true" for status in decode_diagnostics(cdr)[1]):
                    self._judged.add(entry.name)
            elif entry.name == "follower/estimate" and decode_told(cdr).get("final"):
                self._judged.add(entry.name)

        return take

    def _on_statuses(self, statuses: tuple[Diagnostic, ...]) -> None:
        self._watch.take_statuses(statuses)
        for status in statuses:
            if status.name == self._watch.name and status.value("state") in END_STATES:
                self._recording.receive(status)

    def _offer_truth(self, cdr: bytes, source: bytes) -> None:
        """Take the truth of the twin that is followed; another one is kept for when that twin has gone.

        A truth is published once a run: refused for good, the next twin would have none.
        """
        entry = topic("truth")
        problem = self._guard.problem(entry, cdr, source) or self._problem_of_run(cdr)
        if not problem:
            self._other_truths.pop(source, None)
            self._recording.add(entry, cdr, source)
            self._on_truth(cdr)
            return
        self._guard.refuse(entry.name, problem)
        if not self._guard.checker.problem(entry, cdr):
            self._other_truths[source] = cdr
            while len(self._other_truths) > MOST_OTHER_TRUTHS:
                del self._other_truths[next(iter(self._other_truths))]

    def _problem_of_run(self, cdr: bytes) -> str:
        """Describe why a truth does not begin a run: it is of another twin, and the one followed runs on."""
        current = self._recording.current
        if current is None or not current.run_id or self._watch.ended or not self._watch.speaks:
            return ""
        run_id = run_id_of(decode_string(cdr))
        if run_instance(run_id) == run_instance(current.run_id):
            return ""
        return f"it is of the run '{run_id}'; the twin of run '{current.run_id}' runs on"

    def _offer_other_truths(self) -> None:
        """Take the truth of another twin that is there when the one followed has gone."""
        for source, cdr in list(self._other_truths.items()):
            entry = topic("truth")
            if self._guard.problem(entry, cdr, source) or self._problem_of_run(cdr):
                continue
            del self._other_truths[source]
            if self._guard.sources.is_there(entry.name, source):
                self._recording.add(entry, cdr, source)
                self._on_truth(cdr)

    def _on_truth(self, cdr: bytes) -> None:
        self._ended_at = None
        self._judged.clear()
        current = self._recording.current
        self._watch.begin_run("" if current is None else current.run_id)
        run = None if current is None else current.description
        if run is not None:
            checker = self._guard.checker
            checker.body_count, checker.roller_count = len(run.body_names), run.roller_count
        for name in () if run is None else run.sensor_names[1:]:
            self._record(topic(f"vibration/{name}"))

    # --- state -------------------------------------------------------------------------------------

    def missing(self) -> list[str]:
        """List the topics of the twin that have no publisher yet."""
        counts = self._intake.publisher_counts()
        namespace = self.get_namespace()
        return [name for name in TWIN_TOPICS if not counts.get(topic(name).path(namespace), 0)]

    def _tick(self) -> None:
        self._intake.sweep()
        self._guard.sources.look()
        self._watch.look()
        self._offer_other_truths()
        self._recording.flush_and_close_old(OLD_RUN_TIMEOUT_S, TAIL_TIMEOUT_S)
        self._tell_left()
        if not self._announced_ready and not self.missing():
            self._announced_ready = True
            self.get_logger().info("connected to every topic of the twin")
        if time.monotonic() - self._reported_at > REPORT_PERIOD_S:
            self._report()
        if self._last_word() is not None:
            self._end_when_complete()
        elif self._watch.vanished() and self._recording.current is not None:
            self._end("the twin has vanished without a last word")
        if not self._recording.paths:
            self._give_up_without_twin()

    def _give_up_without_twin(self) -> None:
        timeout = self._values.start_timeout
        if 0.0 < timeout < self._watch.absent_for():
            self.get_logger().error(
                f"there has been no twin in {self.get_namespace()} for start_timeout = {timeout:g} s, "
                "nothing is recorded"
            )
            self.exit_code, self.finished = EXIT_LOAD_LOST, True

    def _last_word(self) -> Diagnostic | None:
        """Find what the twin said when the present run was over; ``None`` before that."""
        current, said = self._recording.current, self._watch.last
        if current is None or said is None or not self._watch.ended:
            return None
        return said if said.value("run_id") in (None, "", current.run_id) else None

    def _missing_messages(self) -> list[MissingMessages] | None:
        """List what the twin has published and is not in the file; ``None`` when it has not said."""
        current = self._recording.current
        return None if current is None else current.missing()

    def _end_when_complete(self) -> None:
        now = time.monotonic()
        self._ended_at = self._ended_at or now
        if self._waits_for_tail(now):
            return
        namespace = self.get_namespace()
        judges = [each for each in JUDGES if self.count_publishers(topic(each).path(namespace)) > 0]
        if not self._judged.issuperset(judges) and now - self._ended_at < JUDGES_TIMEOUT_S:
            return
        self._end(self._watch.end_sentence)

    def _waits_for_tail(self, now: float) -> bool:
        """Check whether missing messages may still come: as long as some do, and a while after."""
        assert self._ended_at is not None
        missing = self._missing_messages()
        gone = self._watch.absent_for() > GONE_TIMEOUT_S
        if missing is None:
            return not gone and now - self._ended_at < COUNTS_TIMEOUT_S
        lacking = sum(each.count for each in missing)
        if lacking != self._lacking[0]:
            self._lacking = (lacking, now)
        return lacking > 0 and not gone and now - max(self._lacking[1], self._ended_at) < TAIL_TIMEOUT_S

    def _end(self, status: str) -> None:
        self._intake.sweep_to_the_end()
        self._recording.decide()
        missing = self._missing_messages()
        self._report()
        current = self._recording.current
        lost = self._recording.lost_samples
        self._recording.close(status)
        self._tell_left()
        if current is not None:
            text = f"{current.path}: {current.message_count} messages, {lost} samples lost"
            self.get_logger().info(f"{text}. {status}" if status else text)
            self._tell_missing(missing, current)
        if self._values.exit_when_done:
            self.finished = True

    def _tell_left(self) -> None:
        """Tell of the files that a reset has ended."""
        for left in self._recording.take_left():
            self.get_logger().info(f"{left.path}: {left.message_count} messages. {LEFT}")
            self._tell_missing(left.missing(), left)

    def _tell_missing(self, missing: list[MissingMessages] | None, current: RunFile) -> None:
        if current.begin_s:
            begin, count = current.loss.missed_at_start, sum(current.before().values())
            self.get_logger().warning(
                f"{current.path}: recorded from t = {current.begin_s:.3f} s on, {count} "
                f"messages and {begin} vibration samples were before the recorder was there"
            )
        if not missing and not current.loss.total:
            return
        self.exit_code = EXIT_INCOMPLETE
        if missing:
            self.get_logger().error(f"{current.path}: {missing_sentence(missing)}")

    def _report(self) -> None:
        self._reported_at = time.monotonic()
        current = self._recording.current
        missing = self.missing()
        lost = self._recording.lost_samples
        level, sentence = OK, "recording" if current else "waiting for a run"
        if lost:
            level, sentence = WARN, f"{lost} samples have been lost on the way"
        elif current is not None and current.problem:
            level, sentence = WARN, current.problem
        if self._guard.total:
            level, sentence = WARN, f"{sentence}; {self._guard.sentence()}"
        values = [
            ("connected", "false" if missing else "true"),
            ("missing_topics", " ".join(missing)),
            ("file", str(current.path) if current else ""),
            ("messages", str(current.message_count if current else 0)),
            ("lost_samples", str(lost)),
            ("missed_at_start", str(current.loss.missed_at_start if current else 0)),
            ("recorded_from", f"{current.begin_s if current else 0.0:.3f}"),
        ]
        if current is not None:
            values += [(f"lost: {name}", str(count)) for name, count in sorted(current.loss.lost.items())]
        missing_counts = self._missing_messages()
        if missing_counts is not None:
            values.append(("missing_messages", str(sum(each.count for each in missing_counts))))
            values += [(f"missing: {each.topic}", str(each.count)) for each in missing_counts]
        values += self._guard.values()
        status = Diagnostic(diagnostic_name(self.get_namespace(), RECORDER), level, sentence, tuple(values))
        stamp = current.last_ns.get("load/consumed", 0) if current else 0
        self._out.publish("/diagnostics", encode_diagnostics(stamp, frame_of(self.get_namespace()), [status]))

    def close(self) -> bool:
        """Finish the file; there is no thread to end."""
        if self._recording.current is not None or not self.finished:
            self._intake.sweep_to_the_end()
            self._recording.close("" if self.finished else "the recorder was asked to stop")
            self._tell_left()
        self._out.wait_until_received("/diagnostics", LAST_WORDS_TIMEOUT_S)
        return False


def main(argv: Sequence[str]) -> int:
    """Run the node until the twin has ended."""
    return run_node(RecorderNode, argv)
