"""Load for the thread of the twin: of the queue in lockstep, a smooth line of held values in live mode."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.scene.background import BACKGROUND_SAMPLE_NS
from beardyn_core.scene.chord_polynomials import fitted_polynomials, interpolate_between
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.live_load import HeldLoad, LiveLoad
from beardyn_ros.load_gate import LoadGate, Refusals, shift_load
from beardyn_ros.run_state import PAUSED, RUNNING, WAITING_FOR_LOAD, SessionOptions
from beardyn_ros.runtime import EXIT_LOAD_LOST

HELD = "paused: the service step advances one block, pause with false goes on"
LOAD_IS_PAUSED = "the load is paused: the twin waits until it goes on"
SAMPLES = 40  # of a block, 2 kHz
REACH = 4  # blocks on either side; images are 85 dB down up to a fifth of the block rate
_POLYNOMIALS = fitted_polynomials(REACH, ((0.2, 1.0), (0.5, 1e-6)))


class StoppedError(Exception):
    """The run cannot go on."""

    def __init__(self, sentence: str, exit_code: int) -> None:
        super().__init__(sentence)
        self.exit_code = exit_code


def missing_background(name: str, load: LoadHistory, live: bool) -> str:
    """Say that a load cannot have the forces of a background, which only a load node of the scene adds.

    Parameters
    ----------
    name : str
        Of a background with forces; empty without one.
    load : LoadHistory
        The first load of a run.
    live : bool
        Whether it is a held and filtered value.
    """
    rate = 1e9 / float(np.diff(load.time_ns).max()) if len(load) > 1 else 0.0
    if not name or (rate > 0.9e9 / BACKGROUND_SAMPLE_NS and not live):
        return ""
    came = "live load is filtered" if live else f"this load has {rate:.0f} samples a second"
    return (
        f"the forces of the background {name!r} are not in the load: the load node of the scene adds them, "
        f"at {1e9 / BACKGROUND_SAMPLE_NS:.0f} samples a second, and {came}; "
        "of it the sensors measure at most its pickup"
    )


class LiveLine:
    """A smooth line through the values that were held at the end of each block, `REACH` - 1 blocks late.

    Parameters
    ----------
    first : HeldLoad
        Taken to have been held for ever.
    block_ns : int
        Between values, [ns].
    """

    def __init__(self, first: HeldLoad, block_ns: int) -> None:
        self._values = np.tile(_row(first), (2 * REACH, 1))
        self._block_ns = block_ns
        self._end_ns = 0

    @property
    def reaches_ns(self) -> int:
        """Time at which the line shows the value that was taken last, [ns]."""
        return self._end_ns + (REACH - 1) * self._block_ns

    def begin(self) -> LoadHistory:
        """Return the sample at time 0."""
        return _history(np.zeros(1, np.int64), self._values[:1])

    def go_on(self, held: HeldLoad) -> LoadHistory:
        """Take the value that is held now, and return the samples of the next block."""
        self._values = np.vstack((self._values[1:], _row(held)))
        u = np.arange(1, SAMPLES + 1) / SAMPLES
        time_ns = self._end_ns + np.arange(1, SAMPLES + 1) * (self._block_ns // SAMPLES)
        self._end_ns += self._block_ns
        return _history(time_ns, interpolate_between(self._values, _POLYNOMIALS, u))


def _row(held: HeldLoad) -> Float:
    return np.array([*held.wrench, held.shaft_speed], dtype=np.float64)


def _history(time_ns: np.ndarray, rows: Float) -> LoadHistory:
    wrench, speed = np.ascontiguousarray(rows[:, :6]), np.ascontiguousarray(rows[:, 6])
    return LoadHistory(time_ns, wrench, speed, np.zeros((len(rows), 3)))


class LoadFeed:
    """Load for the twin's thread, as it comes.

    Parameters
    ----------
    options : SessionOptions
    condition : threading.Condition
        Guards what comes in.
    wait : callable
        ``wait(ready, timeout)`` blocks the twin's thread; False after `timeout` seconds, 0: for ever.
    say : callable
        ``say(state, sentence)`` reports it.
    on_stamp : callable, optional
        See `LiveLoad`.
    is_held : callable, optional
        Whether the run is held, so that nobody uses load.
    is_ahead : callable, optional
        Whether computed blocks are not due yet, so that nothing is late for want of load.

    Notes
    -----
    A load that is paused knowingly (``load/truth`` says so) holds the twin in both modes: simulated time
    stands still, neither `load_timeout` nor `max_age` runs, and the age of the held value counts anew
    when the load goes on.
    """

    def __init__(
        self,
        options: SessionOptions,
        condition: threading.Condition,
        wait: Callable[[Callable[[], bool], float], bool],
        say: Callable[[str, str], None],
        on_stamp: Callable[[str, int, float, bool], None] = lambda *_stamp: None,
        is_held: Callable[[], bool] = lambda: False,
        is_ahead: Callable[[], bool] = lambda: False,
    ) -> None:
        self._is_held = is_held
        self._is_ahead = is_ahead
        self._options = options
        self._condition = condition
        self._wait = wait
        self._say = say
        self.refusals = Refusals()
        self.gate = LoadGate(options.queue_ns, options.queue_bytes, self.refusals, condition, options.join)
        self.live = LiveLoad(self.refusals, condition, options.live_bandwidth, on_stamp)
        self.begin_ns = 0
        self._line: LiveLine  # of the live mode, since the first load
        self.paused = False
        self.slept_s = 0.0
        self._running = False

    def restart(self) -> None:
        """Forget the old stream."""
        self._running = False
        self.gate.restart()
        self.live.accept_any_stamp()

    def pause(self, paused: bool) -> None:
        """Take note that the load is silent on purpose, or that it goes on."""
        with self._condition:
            if self.paused and not paused:
                self.live.restart_age()
            self.paused = paused
            self._condition.notify_all()

    def live_delay_ns(self, begin_ns: int) -> int:
        """Compute by how much a block that begins now lags the live load that comes now, [ns]."""
        return self._line.reaches_ns - begin_ns + round(1e9 * self.live.delay)

    def first(self, block_ns: int) -> LoadHistory:
        """Wait for the load of the first block and return it; its first sample is at time 0."""
        load = self._first_load(block_ns)
        self.begin_ns = int(load.time_ns[0])
        return shift_load(load, -self.begin_ns)

    def _first_load(self, block_ns: int) -> LoadHistory:
        topics = "load/wrench and load/shaft" if self._options.mode == "live" else "load/blocks"
        self._say(WAITING_FOR_LOAD, f"waiting for the first load on {topics}")

        def there() -> bool:
            if self._options.mode == "live":
                return self.live.held() is not None or self.gate.ended
            return self.gate.waiting > 0 or self.gate.ended

        self._await_first(there, topics)
        if self._options.mode == "live":
            held = self.live.held()
            if held is not None:
                self._line = LiveLine(held, block_ns)
                return self._line.begin()
        else:
            begin_ns = self.gate.first_time_ns()
            if begin_ns is not None:
                load = self.gate.take_through(begin_ns + block_ns)
                assert load is not None
                return load
        raise StoppedError(
            self.gate.failure or "the load stream has ended before its first sample", EXIT_LOAD_LOST
        )

    def _await_first(self, there: Callable[[], bool], topics: str) -> None:
        """Wait for the first load; what comes but cannot be used is waited for no longer than usual."""
        timeout = self._options.start_timeout
        if not self._load_comes(lambda: there() or bool(self.gate.lacks_its_beginning), timeout):
            raise StoppedError(
                f"no load has come within {timeout:g} s (parameter start_timeout) on {topics}"
                + self._last_refusal(),
                EXIT_LOAD_LOST,
            )
        timeout = self._options.load_timeout
        if not (there() or self._load_comes(there, timeout)):
            raise StoppedError(
                f"the load stream lacks its beginning, and {timeout:g} s (parameter load_timeout) have not "
                f"brought it: {self.gate.lacks_its_beginning}" + self._last_refusal(),
                EXIT_LOAD_LOST,
            )

    def _last_refusal(self) -> str:
        last = self.refusals.report().last_sentence
        return f"; last refusal: {last}" if last else ""

    def cover(self, twin: Any) -> float | None:
        """Feed load until the next block is covered; seconds waited, ``None`` at the end of the stream.

        `slept_s` is then how long the load was paused, or the run was held with nothing ahead, in between,
        which is not waiting for it.
        """
        self.slept_s, self._running = 0.0, True
        if self._options.mode == "live":
            self._load_comes(lambda: not self.paused or self.gate.ended, 0.0)
            if self.gate.ended:
                return None
            held = self.live.held()
            assert held is not None
            if held.age > self._options.max_age:
                refused = self.live.refused_since()
                cause = (
                    f"{refused} message(s) have come since and were refused{self._last_refusal()}"
                    if refused
                    else "its source has stopped"
                )
                raise StoppedError(
                    f"the live load is {held.age:.2f} s old, more than max_age = "
                    f"{self._options.max_age:g} s: {cause}",
                    EXIT_LOAD_LOST,
                )
            while not twin.covered():
                twin.feed(self._line.go_on(held))
            return 0.0
        waited = 0.0  # to hand over what is there is work, not waiting
        while not twin.covered():
            part = self.gate.take_through(twin.wanted_ns + self.begin_ns)
            if part is not None:
                twin.feed(shift_load(part, -self.begin_ns))
                continue
            if self.gate.failure:
                raise StoppedError(self.gate.failure, EXIT_LOAD_LOST)
            if self.gate.ended:
                twin.end_load()
                if twin.covered():
                    break
                return None
            timeout, begin = self._options.load_timeout, time.monotonic()
            if not self._load_comes(
                lambda: self.gate.waiting > 0 or self.gate.ended or bool(self.gate.failure), timeout
            ):
                raise StoppedError(
                    f"no usable load for {timeout:g} s (parameter load_timeout): load that covers "
                    f"t = {(twin.wanted_ns + self.begin_ns) / 1e9:.3f} s is missing{self._last_refusal()}",
                    EXIT_LOAD_LOST,
                )
            waited += time.monotonic() - begin
        return waited - self.slept_s

    def _load_comes(self, ready: Callable[[], bool], timeout: float) -> bool:
        """Wait for load; False after `timeout` seconds (0: for ever) that no knowing pause explains."""
        while True:
            if self._running and self._is_ahead() and not ready():
                self._wait(lambda: ready() or not self._is_ahead(), 0.0)
                continue
            if self._running and self._is_held() and not ready():
                self._sleep(lambda: ready() or not self._is_held(), HELD)
                continue
            if self.paused and not ready():
                self._sleep(lambda: ready() or not self.paused or self._is_held(), LOAD_IS_PAUSED)
                continue
            if not self._wait(lambda: ready() or self.paused or (self._running and self._is_held()), timeout):
                return False
            if ready():
                return True

    def _sleep(self, until: Callable[[], bool], why: str) -> None:
        """Wait for as long as somebody wants it, which is not waiting for load."""
        begin = time.monotonic()
        self._say(PAUSED, why)
        self._wait(until, 0.0)
        self.slept_s += time.monotonic() - begin
        if not self._is_held():
            self._say(RUNNING if self._running else WAITING_FOR_LOAD, "the run goes on")
