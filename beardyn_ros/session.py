"""The twin in its own thread: compile, wait for load, advance block by block, pace.

The executor's thread talks to the session through thread-safe calls and collects what is to be
published; the simulation itself runs without the interpreter lock. Pacing only decides when a block is
handed over, never what is in it.
"""

from __future__ import annotations

import gc
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable
from dataclasses import replace

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.record.description import RunDescription
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.messages import encode_string
from beardyn_core.sensors.block import Block
from beardyn_ros.live_load import SHAFT_TOPIC, WRENCH_TOPIC
from beardyn_ros.load_feed import LoadFeed, StoppedError, missing_background
from beardyn_ros.pacer import Pacer
from beardyn_ros.rig import Rig
from beardyn_ros.run_state import (
    COMPILING,
    END_STATES,
    EQUILIBRIUM,
    FINISHED,
    IDLE,
    INTERRUPTED,
    PAUSED,
    READY,
    RUNNING,
    STOPPED,
    Outgoing,
    SessionOptions,
    SessionReport,
)
from beardyn_ros.runtime import EXIT_BAD_INPUT, EXIT_DONE, EXIT_INVALID_MODEL
from beardyn_ros.source_time import (
    FAR_APART_S,
    LONGEST_ANNOUNCEMENT_S,
    LONGEST_HOLD_S,
    Offset,
    SourceStamps,
    encode_time_reference,
)

BLOCKS_WAITING_TO_BE_PUBLISHED = 32
# one sample a message: spread over the block, while a waveform is one message a block
REFERENCE_EVERY = 10  # blocks
LONGEST_NAP_S = 0.1  # of a run that is held for a clock
TREND_TOPICS = ("force", "imu", "shaft", "joint_states")


class TwinSession:
    """Drives one twin from a thread of its own.

    Parameters
    ----------
    make_rig : callable
        Builds a fresh twin with the description of its run.
    options : SessionOptions
    speed_factor : float
        0: as fast as it goes.
    wake : callable
        Called from the thread whenever there is something to publish or the state has changed.
    """

    def __init__(
        self,
        make_rig: Callable[[], Rig],
        options: SessionOptions,
        speed_factor: float,
        wake: Callable[[], None],
    ) -> None:
        self._make_rig = make_rig
        self.options = options
        self._wake = wake
        self._condition = threading.Condition()  # guards load, commands and what is to be published
        self.pacer = Pacer(speed_factor)
        self.stamps = SourceStamps(self._condition, self.pacer.simulated_at)
        self.feed = LoadFeed(
            options, self._condition, self._wait, self._set_state, on_stamp=self.stamps.receive
        )
        self.exit_code = EXIT_DONE
        self._is_announced = False
        self.new_run_wanted = ""  # why the node is to reset the run, in a sentence
        self._outgoing: deque[Outgoing] = deque()
        self._active = False
        self._paused = False
        self._steps = 0
        self._reset = False
        self._ending = False
        self._run_count = 0
        self._report = SessionReport()
        self._thread = threading.Thread(target=self._thread_main, name="twin", daemon=True)

    # --- called from the executor's thread -------------------------------------------------------

    def compile(self) -> None:
        """Build and compile the twin in the background."""
        self._set_state(COMPILING, "compiling the kernels of this scene (kept for the next start)")
        self._thread.start()

    def activate(self, active: bool) -> None:
        """Run, or hold still without losing anything."""
        with self._condition:
            self._active = active
            self._condition.notify_all()

    def pause(self, paused: bool) -> None:
        """Hold before the next block, or go on."""
        with self._condition:
            self._paused = paused
            self._steps = 0
            self._condition.notify_all()

    @property
    def paused(self) -> bool:
        """Whether the run is asked to hold."""
        return self._paused

    def step(self) -> str | None:
        """Advance one block while paused; a sentence when that is not possible."""
        with self._condition:
            if self._report.state in END_STATES:
                return f"the run is {self._report.state}: call reset first"
            if not self._paused:
                return "the twin is running: call pause with true first"
            self._steps += 1
            self._condition.notify_all()
        return None

    def reset(self) -> str | None:
        """Start the scene again at t = 0; a sentence when that is not possible."""
        with self._condition:
            if self._report.state in (IDLE, COMPILING):
                return f"the twin is {self._report.state}: there is nothing to reset yet"
            self._reset = True
            self._condition.notify_all()
        return None

    def end(self, timeout: float) -> bool:
        """Ask the thread to end; whether it is still alive after `timeout` seconds."""
        with self._condition:
            self._ending = True
            self._condition.notify_all()
        if self._thread.is_alive():
            self._thread.join(timeout)
        return self._thread.is_alive()

    def interrupt(self, why: str) -> None:
        """Say why a run was left; after `end`, when nothing else is said any more."""
        if self._report.state not in END_STATES:
            simulated = f"simulated t = {self._report.simulated_s:.3f} s"
            self._set_state(INTERRUPTED, f"{why} at {simulated}")

    def collect(self) -> list[Outgoing]:
        """Collect everything that waits to be published, oldest first."""
        with self._condition:
            waiting = list(self._outgoing)
            self._outgoing.clear()
            self._condition.notify_all()
        return waiting

    def report(self) -> SessionReport:
        """Copy the present state."""
        with self._condition:
            report = SessionReport(**vars(self._report))
            recent = list(self._report.recent)
        report.load_waiting, report.load_waiting_s = self.feed.gate.waiting, self.feed.gate.waiting_s
        held = self.feed.live.held() if self.options.mode == "live" else None
        report.load_age = held.age if held else 0.0
        report.late_blocks, report.lag_s = self.pacer.late_blocks, self.pacer.lag_s
        report.worst_lag_s, report.last_late_s = self.pacer.worst_lag_s, self.pacer.last_late_s
        if len(recent) > 1:
            (wall_0, simulated_0), (wall_1, simulated_1) = recent[0], recent[-1]
            report.window_rtf = (simulated_1 - simulated_0) / max(wall_1 - wall_0, 1e-9)
        return report

    # --- the twin's thread -----------------------------------------------------------------------

    def _thread_main(self) -> None:
        try:
            rig = self._make_rig()
            with self._condition:
                self._report.tier_note = rig.tier_note
            rig.twin.warm()
            gc.collect()
            gc.freeze()  # compiler and kernels stay, see `run_node`
            self._set_state(READY, "compiled, waiting for activation")
            while not self._ending:
                try:
                    self._one_run(rig)
                except _InterruptedError:
                    pass
                except StoppedError as stop:
                    self.exit_code = stop.exit_code
                    self._set_state(STOPPED, str(stop))
                except ValidityError as error:
                    self.exit_code = EXIT_INVALID_MODEL
                    self._hand_over_last_block(error)
                    self._set_state(STOPPED, str(error))
                self._wait(lambda: self._reset, interruptible=False)
                if self._reset:
                    self._begin_again()
                    rig = self._make_rig()
        except InputError as error:
            self.exit_code = EXIT_BAD_INPUT
            self._set_state(STOPPED, "; ".join(error.problems))
        except Exception as error:
            # A defect of the twin must reach the user through the diagnostics, not die in a thread.
            traceback.print_exc()
            self.exit_code = EXIT_INVALID_MODEL
            self._set_state(STOPPED, f"the twin failed: {type(error).__name__}: {error}")

    def _begin_again(self) -> None:
        with self._condition:
            self._reset = False
            self.exit_code, self.new_run_wanted = EXIT_DONE, ""
            note = self._report.tier_note
            self._report = SessionReport(state=READY, sentence="reset", tier_note=note)
        self.feed.restart()
        self.pacer.begin()

    def _one_run(self, rig: Rig) -> None:
        twin, description = rig.twin, rig.description
        self._encoder = BlockEncoder(description.roller_count, description.sensor_names, self.options.frame)
        self._pictures = rig.pictures
        self._wait(lambda: self._active)
        run_id = f"{self.options.instance}-{self._run_count}"
        self._run_count += 1
        with self._condition:
            self._report.run_id = run_id
        description = replace(description, truth={**description.truth, "run_id": run_id})
        self.stamps.begin()
        self._is_announced = False
        if not self.options.of_source:
            self._put(_truth_of(description))
        first = self.feed.first(twin.block_ns)
        lacks = missing_background(rig.background, first, self.options.mode == "live")
        with self._condition:
            self._report.load_lacks = lacks
        self._set_state(EQUILIBRIUM, "solving the static equilibrium under the first load")
        twin.start(first)
        self._set_state(RUNNING, "running")
        self.pacer.begin()
        begin, processor_begin, waited = time.monotonic(), time.process_time(), 0.0
        planned: float | None = None
        while True:
            held, ordered = self._wait_while_paused()
            waited += held
            if held:
                self.stamps.expect_leap()
            starved = self.feed.cover(twin)
            waited += self.feed.slept_s
            if self.feed.slept_s:
                self.stamps.expect_leap()
            if starved is None:
                break
            self.pacer.shift(starved + self.feed.slept_s)
            if self.options.of_source and not self._report.blocks:
                waited += self._announce_source(description)
            offset, held = self._offset_of_block(self._report.blocks * twin.block_ns, twin.block_ns)
            waited += held
            covered_at = time.monotonic()
            outgoing, block = self._outgoing_of(twin.advance(), offset, ordered)
            ready_at = time.monotonic()
            while (delay := self.pacer.delay(block.end_ns)) > 0.0:
                self._wait(lambda: False, delay)
            due_at = time.monotonic()
            planned = self.pacer.hand_over(block.end_ns)
            self._put(replace(outgoing, due_at=planned), block)
            now = time.monotonic()
            with self._condition:
                report = self._report
                report.simulated_s = (block.index + 1) * twin.block_ns * 1e-9
                report.wall_s = now - begin - waited
                report.waited_for_load_s += starved
                report.processor_s = time.process_time() - processor_begin
                report.busy_s += (ready_at - covered_at) + (now - due_at)
                report.recent.append((now, report.simulated_s))
        sentence = "the load stream has ended, every block that it covers is published"
        if self.options.mode == "live":
            lag = 0.0 if planned is None else max(time.monotonic() - planned, 0.0)
            sentence = (
                f"the live load has ended at simulated t = {self._report.simulated_s:.3f} s, "
                f"{lag:.2f} s behind the wall clock"
            )
        self._set_state(FINISHED, sentence)

    def _hand_over_last_block(self, error: ValidityError) -> None:
        block = getattr(error, "block", None)
        if block is not None:
            self._put(*self._outgoing_of(block, Offset(self.stamps.offset_ns)))

    def _announce_source(self, description: RunDescription) -> float:
        """Publish the truth with the earliest stamp of the run, and wait until its readers have it.

        By that they know which run the stamps behind it are of. Returns the seconds that took.
        """
        begin, earliest_ns = time.monotonic(), self.feed.begin_ns
        if self.options.mode == "live":
            earliest_ns = self.stamps.preview(WRENCH_TOPIC, self.feed.live_delay_ns(0))
        self._put(_truth_of(description, begin_ns=earliest_ns))
        self._wait(lambda: self._is_announced, LONGEST_ANNOUNCEMENT_S)
        waited = time.monotonic() - begin
        self.pacer.shift(waited)
        return waited

    def confirm_truth(self) -> None:
        """Note that the truth of the present run has been published."""
        with self._condition:
            self._is_announced = True
            self._condition.notify_all()

    def _offset_of_block(self, begin_ns: int, block_ns: int) -> tuple[Offset, float]:
        """Find the offset of the stamps of the next block, and for how long the run was held for it, [s]."""
        if not self.options.of_source:
            return Offset(0), 0.0
        if self.options.mode != "live":
            self._report.offset_ns = self.feed.begin_ns
            return self.stamps.set_constant(self.feed.begin_ns), 0.0
        delay_ns, waited = self.feed.live_delay_ns(begin_ns), 0.0
        while True:
            offset, behind = self.stamps.follow(WRENCH_TOPIC, begin_ns, block_ns, delay_ns)
            if behind <= 0.0:
                break
            waited += self._hold_for_clock(behind)
        if waited:
            self._set_state(RUNNING, "running")
        with self._condition:
            self._report.offset_ns = offset.ahead_ns
            self._report.clock_note = self._clock_note()
        return offset, waited

    def _hold_for_clock(self, behind: float) -> float:
        """Hold the run for a moment, for the clock of the source is behind its stamps; seconds held."""
        sentence = f"the clock of the source is {behind:.3f} s behind the stamps, as when it was set back"
        if behind > LONGEST_HOLD_S:
            self._set_state(RUNNING, f"{sentence}: a new run begins")
            with self._condition:
                self.new_run_wanted = sentence
            self._wake()
            self._wait(lambda: False)  # until the node resets
        self._set_state(RUNNING, f"{sentence}: no stamp comes twice, the run waits until it has caught up")
        begin = time.monotonic()
        self._wait(lambda: False, min(behind / self.pacer.speed_factor, LONGEST_NAP_S))
        held = time.monotonic() - begin
        self.pacer.shift(held)
        return held

    def _clock_note(self) -> str:
        """Report a leap of the stamps, and two clocks where one is expected."""
        apart = self.stamps.apart_s(SHAFT_TOPIC, WRENCH_TOPIC)
        notes = [self.stamps.recent_leap] if self.stamps.recent_leap else []
        if self.stamps.is_at_another_pace:
            notes = [
                f"{WRENCH_TOPIC} is stamped at another pace than speed_factor = {self.pacer.speed_factor:g}: "
                "stamps follow it no longer"
            ]
        if abs(apart) > FAR_APART_S:
            notes.append(
                f"{SHAFT_TOPIC} is stamped {abs(apart):.3f} s {'ahead of' if apart > 0.0 else 'behind'} "
                f"{WRENCH_TOPIC}: they have two clocks; stamps are those of {WRENCH_TOPIC}"
            )
        return "; ".join(notes)

    def _outgoing_of(self, block: Block, offset: Offset, ordered: bool = False) -> tuple[Outgoing, Block]:
        messages, trends, stamped = [], [], block.later(offset.ahead_ns)
        first_ns = int(stamped.trend_time_ns[0]) if len(stamped.trend_time_ns) else 0
        for name, stamp_ns, cdr in self._encoder.encode(stamped, self._pictures):
            if name in TREND_TOPICS:
                trends.append(((stamp_ns - first_ns) * 1e-9, name, cdr))
            else:
                messages.append((name, cdr))
        trends.sort(key=lambda trend: trend[0])
        if self.options.of_source and (offset.is_new or block.index % REFERENCE_EVERY == 0):
            reference = encode_time_reference(stamped.end_ns, block.end_ns, self.options.frame)
            messages.append(("source_time", reference))
        live = self.options.mode == "live"
        consumed_ns = stamped.end_ns if live else block.end_ns + self.feed.begin_ns
        sent = Outgoing(tuple(messages), tuple(trends), block.end_ns, stamped.end_ns, consumed_ns, ordered)
        return sent, block

    def _wait_while_paused(self) -> tuple[float, bool]:
        """Wait while paused or inactive; seconds held, and whether the next block is ordered by a step."""
        with self._condition:
            if self._steps and self._active:
                self._steps -= 1
                return 0.0, True
            if self._active and not self._paused:
                return 0.0, False
        begin = time.monotonic()
        self._set_state(PAUSED, "paused: the service step advances one block, pause with false goes on")
        self._wait(lambda: self._active and (not self._paused or self._steps > 0))
        with self._condition:
            ordered = self._steps > 0
            self._steps -= ordered
        held = time.monotonic() - begin
        self.pacer.shift(held)
        if not self._paused:
            self._set_state(RUNNING, "running")
        return held, ordered

    def _put(self, outgoing: Outgoing, block: Block | None = None) -> None:
        """Hand over what is to be published, and count the block that it comes from."""
        self._wait(lambda: len(self._outgoing) < BLOCKS_WAITING_TO_BE_PUBLISHED)
        with self._condition:
            self._outgoing.append(outgoing)
            if block is not None:
                self._report.blocks += 1
                self._report.status = block.status
                self._report.compute_s += block.wall_s
                self._report.waveform_samples += _waveform_samples(block)
                if block.audit is not None:
                    self._report.energy_residual = block.audit.residual
        self._wake()

    def _set_state(self, state: str, sentence: str) -> None:
        with self._condition:
            self._report.state = state
            self._report.sentence = sentence
        self._wake()

    def _wait(self, ready: Callable[[], bool], timeout: float = 0.0, interruptible: bool = True) -> bool:
        """Wait until `ready`; False after `timeout` seconds (0: for ever)."""

        def done() -> bool:
            return self._ending or (interruptible and self._reset) or ready()

        with self._condition:
            self._condition.wait_for(done, timeout or None)
            if self._ending or (interruptible and self._reset):
                if interruptible:
                    raise _InterruptedError
                return True
            return ready()


class _InterruptedError(Exception):
    """The run is left because of a reset or the end of the process."""


def _truth_of(description: RunDescription, **more: int) -> Outgoing:
    """Make the message that begins a run."""
    described = replace(description, truth={**description.truth, **more})
    return Outgoing((("truth", encode_string(described.to_json())),))


def _waveform_samples(block: Block) -> int:
    """Return the samples of the first accelerometer."""
    return len(block.vibration[0].time_ns) if block.vibration else 0
