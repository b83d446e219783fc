"""Reports of the nodes as diagnostics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from beardyn_core.record.messages import Diagnostic
from beardyn_core.record.published import published_values
from beardyn_ros.load_gate import RefusalReport
from beardyn_ros.replay import Replay
from beardyn_ros.run_state import (
    COMPILING,
    END_STATES,
    FINISHED,
    STOPPED,
    WAITING_FOR_LOAD,
    SessionReport,
)

if TYPE_CHECKING:
    from beardyn_ros.message_guard import MessageGuard

OK, WARN, ERROR = 0, 1, 2
TWIN = "twin"
RECORDER = "recorder"
MONITOR = "monitor"
LAG = "lag"
LONGEST_LIVE_LAG_S = 0.5
LARGEST_LAG_S = 0.1


def diagnostic_name(namespace: str, part: str) -> str:
    """Make the name of a status, unique among several axleboxes: ``axlebox/twin``."""
    return f"{namespace.strip('/')}/{part}" if namespace.strip("/") else part


@dataclass(frozen=True)
class NodeStanding:
    """What a twin's node knows of itself beside the run.

    Parameters
    ----------
    instance, since_ns : str, int
        Which of several twins of one name it is, and since when on the wall clock, [ns].
    mode : str
    speed_factor : float
    load_publishers : int
    sent : mapping of str to int
        Messages of the run so far, by topic.
    lost_messages : int
        Given up by the middleware.
    warnings : tuple of str
        Sentences about what is wrong now.
    """

    instance: str
    since_ns: int
    mode: str
    speed_factor: float
    load_publishers: int
    sent: Mapping[str, int]
    lost_messages: int
    warnings: tuple[str, ...]


def twin_diagnostic(
    name: str, report: SessionReport, refused: RefusalReport, standing: NodeStanding
) -> Diagnostic:
    """Report the state of the twin: progress, pace, load, validity; the last word counts its messages."""
    level, sentence = OK, report.sentence
    ended = report.state in END_STATES
    if report.state == STOPPED:
        level = ERROR
    else:
        told = [*standing.warnings, *filter(None, [report.load_lacks])]
        lags = standing.mode == "live" and report.lag_s > LONGEST_LIVE_LAG_S
        if lags and not ended:
            told.append(f"the run is {report.lag_s:.2f} s behind the wall clock")
        if refused.recent:
            told.append(f"{refused.count} load message(s) refused, the last: {refused.last_sentence}")
        if ended and standing.lost_messages:
            told.append(f"{standing.lost_messages} message(s) could not be published")
        level = WARN if told or lags else OK
        sentence = "; ".join([sentence, *told])
    values = [
        ("state", report.state),
        ("run_id", report.run_id),
        ("instance", standing.instance),
        ("since", str(standing.since_ns)),
        ("mode", standing.mode),
        ("speed_factor", f"{standing.speed_factor:g}"),
        ("simulated_time", f"{report.simulated_s:.3f}"),
        ("blocks", str(report.blocks)),
        ("waveform_samples", str(report.waveform_samples)),
        ("late_blocks", str(report.late_blocks)),
        ("load_publishers", str(standing.load_publishers)),
        ("lost_messages", str(standing.lost_messages)),
        ("status", str(report.status)),
    ]
    if report.blocks:
        total = report.simulated_s / max(report.wall_s, 1e-9)
        simulated = max(report.simulated_s, 1e-9)
        values += [
            ("real_time_factor", f"{report.simulated_s / max(report.busy_s, 1e-9):.4g}"),
            ("kernel_real_time_factor", f"{report.simulated_s / max(report.compute_s, 1e-9):.4g}"),
            ("processor_time_per_simulated_time", f"{report.processor_s / simulated:.4g}"),
            ("pace", f"{(total if ended else report.window_rtf):.4g}"),
            ("wall_time", f"{report.wall_s:.3f}"),
            ("waited_for_load", f"{report.waited_for_load_s:.3f}"),
        ]
    if report.energy_residual is not None:
        values.append(("energy_residual", f"{report.energy_residual:.3e}"))
    if standing.mode == "live":
        values.append(("load_age", f"{report.load_age:.3f}"))
    else:
        values += [
            ("load_queue", str(report.load_waiting)),
            ("load_queue_time", f"{report.load_waiting_s:.3f}"),
        ]
    if standing.speed_factor > 0.0:
        values += [("lag", f"{report.lag_s:.3f}"), ("worst_lag", f"{report.worst_lag_s:.4f}")]
    values.append(("refused_messages", str(refused.count)))
    values += [(f"refused: {reason}", str(count)) for reason, count in refused.by_reason]
    if ended:
        values += published_values(standing.sent)
    return Diagnostic(name, level, sentence, tuple(values))


def lag_diagnostic(name: str, report: SessionReport, speed_factor: float) -> Diagnostic:
    """Report by how much simulated time is behind the pace that was asked for, [s] of simulated time."""
    lag = report.lag_s * speed_factor
    level, sentence = OK, "simulated time keeps its pace"
    if speed_factor == 0.0:
        sentence = "no pace is asked for"
    elif report.state in END_STATES:
        sentence = f"the run was at most {report.worst_lag_s * speed_factor:.3f} s behind its pace"
    elif report.lag_s > LARGEST_LAG_S:
        level, sentence = WARN, f"simulated time is {lag:.2f} s behind its pace"
    values = [
        ("run_id", report.run_id),
        ("lag", f"{lag:.4f}"),
        ("worst_lag", f"{report.worst_lag_s * speed_factor:.4f}"),
        ("late_blocks", str(report.late_blocks)),
        ("pace", f"{report.window_rtf:.4g}"),
    ]
    return Diagnostic(name, level, sentence, tuple(values))


def load_diagnostic(
    name: str,
    state: str,
    replay: Replay,
    lead: float,
    lost_messages: int,
    sent: Mapping[str, int],
    guard: MessageGuard,
) -> Diagnostic:
    """Report the load node: where the stream stands in the scenario, how far ahead of the credit, [s]."""
    values = (
        ("state", state),
        ("position", f"{replay.position_s:.4f}"),
        ("sample", str(replay.next_sample)),
        ("stamp", f"{replay.next_ns * 1e-9:.4f}"),
        ("lead", f"{lead:.3f}"),
        ("passages", str(len(replay.passages))),
        ("loop", str(replay.loop).lower()),
        ("lost_messages", str(lost_messages)),
        *published_values(sent),
        *guard.values(),
    )
    said = "; ".join(filter(None, (f"the load is {state}", guard.sentence())))
    return Diagnostic(name, WARN if lost_messages or guard.total else OK, said, values)


def needs_attention(report: SessionReport) -> bool:
    """Check whether a person would want to know this state at once."""
    return report.state in (COMPILING, WAITING_FOR_LOAD, FINISHED, STOPPED)
