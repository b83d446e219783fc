"""Options of a twin session, the messages it hands over, and its report."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    pass

IDLE = "idle"
COMPILING = "compiling"
READY = "ready"
WAITING_FOR_LOAD = "waiting for load"
EQUILIBRIUM = "static equilibrium"
RUNNING = "running"
PAUSED = "paused"
FINISHED = "finished"
STOPPED = "stopped"
INTERRUPTED = "interrupted"
END_STATES = (FINISHED, STOPPED, INTERRUPTED)
LEFT = "the run was left by a reset"  # begins the last word of such a run


@dataclass(frozen=True)
class SessionOptions:
    """How a session is fed and when it gives up.

    Parameters
    ----------
    mode : str
        ``lockstep`` or ``live``.
    load_timeout : float
        Longest wait for load in a running lockstep, 0 for ever, [s].
    start_timeout : float
        Longest wait for the first load, 0 for ever, [s].
    max_age : float
        Oldest load that `live` may hold, [s].
    queue_ns : int
        Longest stretch of load that may wait, [ns].
    queue_bytes : int
        Most memory that it may take.
    join : bool
        Whether a stream of load may be joined after its sample 0.
    live_bandwidth : float
        Of the filter of live load, [Hz].
    frame : str
        Frame of every header.
    instance : str
        Marks this twin among others of the same name; run ids begin with it.
    of_source : bool
        Whether stamps are those of the source of the load, in place of simulated time.
    """

    mode: str
    load_timeout: float
    start_timeout: float
    max_age: float
    queue_ns: int
    queue_bytes: int
    join: bool
    live_bandwidth: float
    frame: str
    instance: str
    of_source: bool = False


@dataclass(frozen=True)
class Outgoing:
    """Something to publish, in order.

    Parameters
    ----------
    messages : tuple of (topic, bytes)
    trends : tuple of (offset, topic, bytes)
        Single samples, with their time since the first of them, [s]: to be spread over the block.
    clock_ns : int or None
        Simulated time after it; ``None``: not part of the run.
    stamp_ns : int
        The same on the clock of the stamps, [ns].
    consumed_ns : int
        The same in the time of the load, whose first sample may stand anywhere.
    ordered : bool
        Whether the service `step` has ordered this block.
    due_at : float or None
        When it was to be published, [s] of `time.monotonic`; ``None``: no pace is asked for.
    """

    messages: tuple[tuple[str, bytes], ...]
    trends: tuple[tuple[float, str, bytes], ...] = ()
    clock_ns: int | None = None
    stamp_ns: int = 0
    consumed_ns: int = 0
    ordered: bool = False
    due_at: float | None = None


@dataclass
class SessionReport:
    """State of a session for diagnostics; a copy, free to read.

    Parameters
    ----------
    state, sentence : str
    run_id : str
        Changes with every reset.
    blocks, late_blocks : int
    simulated_s, wall_s, waited_for_load_s : float
        Since the start of the run; pauses are not counted.
    compute_s : float
        Time spent inside the twin.
    busy_s : float
        Time from load to a block that is handed over, waiting for the pace left out.
    processor_s : float
        Processor time of the whole process since the start of the run, all threads, [s].
    window_rtf : float
        Real-time factor of the last second or so.
    status : int
        Status bits of the last block.
    energy_residual : float or None
        ``None`` where the effects have no audit.
    load_waiting : int
        Samples in the queue (lockstep).
    load_waiting_s : float
        The stretch that they cover, [s].
    load_age : float
        Age of the held load (live), [s].
    lag_s : float
        How late the last block was on the wall clock, [s].
    worst_lag_s : float
        The same of the latest of all blocks, [s].
    last_late_s : float
        Simulated time of the last late block; 0 without one, [s].
    waveform_samples : int
        Waveform samples delivered since the start of the run.
    load_lacks : str
        What the load of this run has not, though the scene speaks of it; a sentence, or empty.
    tier_note : str
        Why the tier is not the best one, and what is given up, see `real_time`; or empty.
    offset_ns : int or None
        Of stamps over simulated time; ``None`` where they are the same, [ns].
    clock_note : str
        What the clock of the source has done last, in a sentence; or empty.
    """

    state: str = IDLE
    sentence: str = "not configured"
    run_id: str = ""
    blocks: int = 0
    late_blocks: int = 0
    simulated_s: float = 0.0
    wall_s: float = 0.0
    waited_for_load_s: float = 0.0
    compute_s: float = 0.0
    busy_s: float = 0.0
    processor_s: float = 0.0
    window_rtf: float = 0.0
    status: int = 0
    energy_residual: float | None = None
    load_waiting: int = 0
    load_waiting_s: float = 0.0
    load_age: float = 0.0
    lag_s: float = 0.0
    worst_lag_s: float = 0.0
    last_late_s: float = 0.0
    waveform_samples: int = 0
    load_lacks: str = ""
    tier_note: str = ""
    offset_ns: int | None = None
    clock_note: str = ""
    recent: deque[tuple[float, float]] = field(default_factory=lambda: deque(maxlen=50))
