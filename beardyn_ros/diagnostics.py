"""Reports of the nodes as diagnostics."""

from __future__ import annotations

from beardyn_core.record.messages import Diagnostic
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

OK, WARN, ERROR = 0, 1, 2
TWIN = "twin"
RECORDER = "recorder"
MONITOR = "monitor"
LONGEST_LIVE_LAG_S = 0.5


def diagnostic_name(namespace: str, part: str) -> str:
    """Make the name of a status, unique among several axleboxes: ``axlebox/twin``."""
    return f"{namespace.strip('/')}/{part}" if namespace.strip("/") else part


def is_from(diagnostic: Diagnostic, part: str) -> bool:
    """Check whether a status comes from that part of any axlebox."""
    return diagnostic.name == part or diagnostic.name.endswith(f"/{part}")


def twin_diagnostic(
    name: str,
    report: SessionReport,
    refused: RefusalReport,
    lost_messages: int,
    mode: str,
    speed_factor: float,
    load_publishers: int,
) -> Diagnostic:
    """Report the state of the twin: progress, pace, load, validity."""
    level, sentence = OK, report.sentence
    if report.state == STOPPED:
        level = ERROR
    else:
        lags = mode == "live" and report.lag_s > LONGEST_LIVE_LAG_S
        if refused.count or lost_messages or lags:
            level = WARN
        if lags and report.state not in END_STATES:
            sentence += f"; the run is {report.lag_s:.2f} s behind the wall clock"
        if refused.count:
            sentence += f"; {refused.count} load message(s) refused, the last: {refused.last_sentence}"
        if lost_messages:
            sentence += f"; {lost_messages} message(s) could not be published"
    values = [
        ("state", report.state),
        ("run_id", report.run_id),
        ("mode", mode),
        ("speed_factor", f"{speed_factor:g}"),
        ("simulated_time", f"{report.simulated_s:.3f}"),
        ("blocks", str(report.blocks)),
        ("waveform_samples", str(report.waveform_samples)),
        ("late_blocks", str(report.late_blocks)),
        ("load_publishers", str(load_publishers)),
        ("lost_messages", str(lost_messages)),
        ("status", str(report.status)),
    ]
    if report.blocks:
        total = report.simulated_s / max(report.wall_s, 1e-9)
        values += [
            ("real_time_factor", f"{report.simulated_s / max(report.compute_s, 1e-9):.4g}"),
            ("pace", f"{(total if report.state in END_STATES else report.window_rtf):.4g}"),
            ("wall_time", f"{report.wall_s:.3f}"),
            ("waited_for_load", f"{report.waited_for_load_s:.3f}"),
            ("energy_residual", f"{report.energy_residual:.3e}"),
        ]
    if mode == "live":
        values.append(("load_age", f"{report.load_age:.3f}"))
    else:
        values += [
            ("load_queue", str(report.load_waiting)),
            ("load_queue_time", f"{report.load_waiting_s:.3f}"),
        ]
    if speed_factor > 0.0:
        values += [("lag", f"{report.lag_s:.3f}"), ("worst_lag", f"{report.worst_lag_s:.4f}")]
    values.append(("refused_messages", str(refused.count)))
    values += [(f"refused: {reason}", str(count)) for reason, count in refused.by_reason]
    return Diagnostic(name, level, sentence, tuple(values))


def load_diagnostic(name: str, state: str, replay: Replay, lead: float, lost_messages: int) -> Diagnostic:
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
    )
    return Diagnostic(name, WARN if lost_messages else OK, f"the load is {state}", values)


def needs_attention(report: SessionReport) -> bool:
    """Check whether a person would want to know this state at once."""
    return report.state in (COMPILING, WAITING_FOR_LOAD, FINISHED, STOPPED)
