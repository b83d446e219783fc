"""The twin in its own thread: compile, wait for load, advance block by block, pace.

The executor's thread talks to the session through thread-safe calls and collects what is to be
published; the simulation itself runs without the interpreter lock. Pacing only decides when a block is
handed over, never what is in it: where the load is known beforehand, some blocks are computed before they
are due.
"""

from __future__ import annotations

import gc
import threading
import time
import traceback
from collections import deque
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from beardyn_core.base.errors import InputError, ValidityError
from beardyn_core.record.description import RunDescription
from beardyn_core.sensors.block import Block
from beardyn_ros.block_messages import BlockMessages, truth_message
from beardyn_ros.blocks_ahead import BlocksAhead, ComputedBlock
from beardyn_ros.live_load import SHAFT_TOPIC, WRENCH_TOPIC
from beardyn_ros.load_feed import HELD, LoadFeed, StoppedError, missing_background
from beardyn_ros.pacer import Pacer
from beardyn_ros.rig import Rig
from beardyn_ros.run_control import RunControl, RunLeftError
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
    LONGEST_ANNOUNCEMENT_S,
    LONGEST_HOLD_S,
    Offset,
    SourceStamps,
)

BLOCKS_WAITING_TO_BE_PUBLISHED = 32
MOST_AHEAD = 15  # computed blocks that may wait until they are due, where the load is known beforehand
LONGEST_NAP_S = 0.1  # of a run that is held for a clock


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
        self._control = RunControl(self._condition)
        self.activate, self.pause = self._control.activate, self._control.pause
        self._wait = self._control.wait
        self.pacer = Pacer(speed_factor)
        self.stamps = SourceStamps(self._condition, self.pacer.simulated_at)
        self.feed = LoadFeed(
            options,
            self._condition,
            self._wait,
            self._set_state,
            on_stamp=self.stamps.receive,
            # a live run is held before a block is begun, and uses no load then
            is_held=lambda: self._control.is_held and not self._is_live,
            is_ahead=lambda: self._ahead is not None and self._ahead.is_waiting,
        )
        self.exit_code = EXIT_DONE
        self._is_announced = False
        self.new_run_wanted = ""  # why the node is to reset the run, in a sentence
        self._outgoing: deque[Outgoing] = deque()
        self._run_count = 0
        self._ahead: BlocksAhead | None = None
        self._began = self._processor_began = 0.0  # of a run
        self._waited_s = 0.0  # of it: held, announcing, or its load was paused
        self._last_due: float | None = None
        self._report = SessionReport()
        self._thread = threading.Thread(target=self._thread_main, name="twin", daemon=True)

    @property
    def _is_live(self) -> bool:
        return self.options.mode == "live"

    # --- called from the executor's thread -------------------------------------------------------

    def compile(self) -> None:
        """Build and compile the twin in the background."""
        self._set_state(COMPILING, "compiling the kernels of this scene (kept for the next start)")
        self._thread.start()

    @property
    def paused(self) -> bool:
        """Whether the run is asked to hold."""
        return self._control.paused

    def step(self) -> str | None:
        """Advance one block while paused; a sentence when that is not possible."""
        with self._condition:
            if self._report.state in END_STATES:
                return f"the run is {self._report.state}: call reset first"
            if not self._control.paused:
                return "the twin is running: call pause with true first"
            self._control.step()
        return None

    def reset(self) -> str | None:
        """Start the scene again at t = 0; a sentence when that is not possible."""
        with self._condition:
            if self._report.state in (IDLE, COMPILING):
                return f"the twin is {self._report.state}: there is nothing to reset yet"
            self._control.reset()
        return None

    def end(self, timeout: float) -> bool:
        """Ask the thread to end; whether it is still alive after `timeout` seconds."""
        self._control.end()
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
        held = self.feed.live.held() if self._is_live else None
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
            while not self._control.is_ending:
                try:
                    self._one_run(rig)
                except RunLeftError:
                    pass
                except StoppedError as stop:
                    self.exit_code = stop.exit_code
                    self._set_state(STOPPED, str(stop))
                except ValidityError as error:
                    self.exit_code = EXIT_INVALID_MODEL
                    self._hand_over_last_block(error)
                    self._set_state(STOPPED, str(error))
                if self._control.wait_for_reset():
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
            self._control.is_reset = False
            self.exit_code, self.new_run_wanted = EXIT_DONE, ""
            note = self._report.tier_note
            self._report = SessionReport(state=READY, sentence="reset", tier_note=note)
        self.feed.restart()
        self.pacer.begin()

    def _one_run(self, rig: Rig) -> None:
        twin, description = rig.twin, rig.description
        self._messages = BlockMessages(description, rig.pictures, self.options, self.feed)
        self._wait(lambda: self._control.active)
        run_id = f"{self.options.instance}-{self._run_count}"
        self._run_count += 1
        with self._condition:
            self._report.run_id = run_id
        description = replace(description, truth={**description.truth, "run_id": run_id})
        self.stamps.begin()
        self._is_announced = False
        if not self.options.of_source:
            self._put(truth_message(description))
        first = self.feed.first(twin.block_ns)
        lacks = missing_background(rig.background, first, self._is_live)
        with self._condition:
            self._report.load_lacks = lacks
        self._set_state(EQUILIBRIUM, "solving the static equilibrium under the first load")
        twin.start(first)
        self._set_state(RUNNING, "running")
        self.pacer.begin()
        self._began, self._processor_began = time.monotonic(), time.process_time()
        self._waited_s, self._last_due = 0.0, None
        most = 0 if self._is_live else MOST_AHEAD
        ahead = BlocksAhead(most, self._condition, self._wait, self._hand_over, self._control.leave)
        self._ahead = ahead
        try:
            self._advance(twin, description, ahead)
            ahead.drain()
        except RunLeftError:
            if ahead.failure is not None:
                raise ahead.failure from None
            raise
        except Exception:
            ahead.drain()
            raise
        finally:
            self._control.leave()
            ahead.join()
            self._ahead = None
            self._control.begin()
        sentence = "the load stream has ended, every block that it covers is published"
        if self._is_live:
            lag = 0.0 if self._last_due is None else max(time.monotonic() - self._last_due, 0.0)
            sentence = (
                f"the live load has ended at simulated t = {self._report.simulated_s:.3f} s, "
                f"{lag:.2f} s behind the wall clock"
            )
        self._set_state(FINISHED, sentence)

    def _advance(self, twin: Any, description: RunDescription, ahead: BlocksAhead) -> None:
        """Compute block after block until the load ends."""
        computed, ordered = 0, False
        while True:
            ahead.wait_for_room()
            if self._is_live:
                held, ordered = self._wait_while_paused()
                if held:
                    self.stamps.expect_leap()
            starved = self.feed.cover(twin)
            if self.feed.slept_s:
                self.stamps.expect_leap()
            if starved is None:
                return
            self._leave_out_waiting(starved, computed * twin.block_ns)
            if self.options.of_source and not computed:
                self._announce_source(description)
            offset = self._offset_of_block(computed * twin.block_ns, twin.block_ns)
            covered_at = time.monotonic()
            block = twin.advance()
            outgoing = self._messages.of(block, offset, ordered)
            ahead.append(ComputedBlock(outgoing, block, time.monotonic() - covered_at))
            computed += 1

    def _leave_out_waiting(self, starved: float, begin_ns: int) -> None:
        """Shift the pace by the time that a block could not begin for want of load, [s].

        While earlier blocks were not due nothing was late for it, and a hold of theirs is left out by who
        hands them over.
        """
        slept = self.feed.slept_s
        if self._ahead is not None and self._ahead.is_waiting:
            return
        if self.pacer.speed_factor > 0.0:
            late = max(-self.pacer.delay(begin_ns), 0.0)
            slept = min(slept, late)
            starved = min(starved, late - slept)
        self.pacer.shift(starved + slept)
        with self._condition:
            self._waited_s += slept
            self._report.waited_for_load_s += starved

    def _hand_over(self, computed: ComputedBlock) -> None:
        """Hand a block over when it is due, and not while the run is held; its own thread."""
        outgoing, block = computed.outgoing, computed.block
        if not self._is_live:
            _, ordered = self._wait_while_paused()
            outgoing = replace(outgoing, ordered=ordered)
        while (delay := self.pacer.delay(block.end_ns)) > 0.0:
            self._wait(lambda: False, delay)
        due_at = time.monotonic()
        self._last_due = self.pacer.hand_over(block.end_ns)
        self._put(replace(outgoing, due_at=self._last_due), block)
        now = time.monotonic()
        with self._condition:
            report = self._report
            report.simulated_s = block.end_ns * 1e-9
            report.wall_s = now - self._began - self._waited_s
            report.processor_s = time.process_time() - self._processor_began
            report.busy_s += computed.busy_s + (now - due_at)
            report.recent.append((now, report.simulated_s))

    def _hand_over_last_block(self, error: ValidityError) -> None:
        block = getattr(error, "block", None)
        if block is not None:
            self._put(self._messages.of(block, Offset(self.stamps.offset_ns)), block)

    def _announce_source(self, description: RunDescription) -> None:
        """Publish the truth with the earliest stamp of the run, and wait until its readers have it.

        By that they know which run the stamps behind it are of.
        """
        begin, earliest_ns = time.monotonic(), self.feed.begin_ns
        if self._is_live:
            earliest_ns = self.stamps.preview(WRENCH_TOPIC, self.feed.live_delay_ns(0))
        self._put(truth_message(description, begin_ns=earliest_ns))
        self._wait(lambda: self._is_announced, LONGEST_ANNOUNCEMENT_S)
        self._leave_out(time.monotonic() - begin)

    def confirm_truth(self) -> None:
        """Note that the truth of the present run has been published."""
        with self._condition:
            self._is_announced = True
            self._condition.notify_all()

    def _leave_out(self, seconds: float) -> None:
        """Leave the time that a run was held out of its pace."""
        self.pacer.shift(seconds)
        with self._condition:
            self._waited_s += seconds

    def _offset_of_block(self, begin_ns: int, block_ns: int) -> Offset:
        """Find the offset of the stamps of the next block; holds the run for it where it must."""
        if not self.options.of_source:
            return Offset(0)
        if not self._is_live:
            self._report.offset_ns = self.feed.begin_ns
            return self.stamps.set_constant(self.feed.begin_ns)
        delay_ns, is_held = self.feed.live_delay_ns(begin_ns), False
        while True:
            offset, behind = self.stamps.follow(WRENCH_TOPIC, begin_ns, block_ns, delay_ns)
            if behind <= 0.0:
                break
            self._hold_for_clock(behind)
            is_held = True
        if is_held:
            self._set_state(RUNNING, "running")
        with self._condition:
            self._report.offset_ns = offset.ahead_ns
            self._report.clock_note = self.stamps.note(SHAFT_TOPIC, WRENCH_TOPIC, self.pacer.speed_factor)
        return offset

    def _hold_for_clock(self, behind: float) -> None:
        """Hold the run for a moment, for the clock of the source is behind its stamps."""
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
        self._leave_out(time.monotonic() - begin)

    def _wait_while_paused(self) -> tuple[float, bool]:
        """Wait while paused or inactive; seconds held, and whether the next block is ordered by a step."""
        if not self._control.is_held:
            return 0.0, self._control.take_turn()
        begin = time.monotonic()
        self._set_state(PAUSED, HELD)
        self._wait(lambda: not self._control.is_held)
        ordered, held = self._control.take_turn(), time.monotonic() - begin
        self._leave_out(held)
        if not self._control.paused:
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


def _waveform_samples(block: Block) -> int:
    """Return the samples of the first accelerometer."""
    return len(block.vibration[0].time_ns) if block.vibration else 0
