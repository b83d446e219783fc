"""What the twin says on ``/diagnostics`` about its runs: the present one, and one that a reset has left."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from beardyn_core.record.messages import Diagnostic, encode_diagnostics
from beardyn_core.record.published import published_values
from beardyn_ros.diagnostics import ERROR, LAG, OK, TWIN, WARN, Namesakes, diagnostic_name
from beardyn_ros.frames import frame_of
from beardyn_ros.load_gate import RefusalReport
from beardyn_ros.load_intake import LoadIntake
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.run_state import (
    COMPILING,
    END_STATES,
    FINISHED,
    INTERRUPTED,
    LEFT,
    STOPPED,
    WAITING_FOR_LOAD,
    SessionReport,
)
from beardyn_ros.session import TwinSession
from beardyn_ros.wire import TopicPublishers

# they go on when the run is over, or only the latest message counts
UNCOUNTED_TOPICS = ("load/consumed", "/clock", "/diagnostics", "source_time")
LONGEST_LIVE_LAG_S = 0.5
LARGEST_LAG_S = 0.1


@dataclass(frozen=True)
class NodeStanding:
    """What a twin's node knows of itself besides the run.

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
        told = [*standing.warnings, *filter(None, [report.load_lacks, report.clock_note])]
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
    if report.offset_ns is not None:
        values.append(("stamps_ahead_of_simulated_time_ns", str(report.offset_ns)))
    if report.tier_note:
        values.append(("tier_note", report.tier_note))
    if report.blocks:
        total = report.simulated_s / max(report.wall_s, 1e-9)
        simulated = max(report.simulated_s, 1e-9)
        values += [
            ("real_time_factor", f"{report.simulated_s / max(report.busy_s, 1e-9):.4g}"),
            ("kernel_real_time_factor", f"{report.simulated_s / max(report.compute_s, 1e-9):.4g}"),
            ("processor_time_per_simulated_time", f"{report.processor_s / simulated:.4g}"),
            ("pace", f"{(total if ended else report.window_rtf):.5g}"),
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
        values += [
            ("lag", f"{report.lag_s:.3f}"),
            ("worst_lag", f"{report.worst_lag_s:.4f}"),
            ("last_late_time", f"{report.last_late_s:.3f}"),
        ]
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


def pace_sentence(report: SessionReport, speed_factor: float) -> str:
    """Write how a run has kept its pace; empty where no pace was asked for, or nothing was published."""
    if speed_factor <= 0.0 or not report.blocks:
        return ""
    late = "no block was late"
    if report.late_blocks:
        late = (
            f"{report.late_blocks} of {report.blocks} blocks were late, the worst by "
            f"{1e3 * report.worst_lag_s:.0f} ms, the last at simulated t = {report.last_late_s:.2f} s"
        )
    pace = report.simulated_s / max(report.wall_s, 1e-9)
    return f"pace {pace:.4f} of {speed_factor:g} asked for, waits for load left out; {late}"


def needs_attention(report: SessionReport) -> bool:
    """Check whether a person would want to know this state at once."""
    return report.state in (COMPILING, WAITING_FOR_LOAD, FINISHED, STOPPED)


class TwinReporter:
    """Publishes reports of sessions, with what the node knows of itself.

    Parameters
    ----------
    node : rclpy.node.Node
    values : ParameterValues
        Of the twin's parameters.
    namesakes : Namesakes
    load : LoadIntake
    out : TopicPublishers
        Of the twin.
    """

    def __init__(
        self,
        node: Any,
        values: ParameterValues,
        namesakes: Namesakes,
        load: LoadIntake,
        out: TopicPublishers,
    ) -> None:
        self._node = node
        self._values = values
        self._namesakes = namesakes
        self._load = load
        self._out = out
        self._name = diagnostic_name(node.get_namespace(), TWIN)
        self._left: SessionReport | None = None

    def leave(self, report: SessionReport, why: str = "") -> None:
        """Keep the report of a run that a reset leaves, unless that run has had its last word."""
        if report.run_id and report.state not in END_STATES:
            self._left = replace(report, state=INTERRUPTED, sentence=f"{LEFT}: {why}" if why else LEFT)

    def tell_left_run(self, session: TwinSession, clock_ns: int) -> None:
        """Publish the last word of a run that a reset has left, when the last of its blocks is out."""
        if self._left is not None:
            self.tell(session, self._left, clock_ns)
            self._left = None

    def tell(self, session: TwinSession, report: SessionReport, clock_ns: int) -> None:
        """Publish a report.

        Parameters
        ----------
        session : TwinSession
            Whose load may have been refused.
        report : SessionReport
        clock_ns : int
            Simulated time, [ns].
        """
        speed_factor = session.pacer.speed_factor
        standing = NodeStanding(
            instance=self._namesakes.instance,
            since_ns=self._namesakes.since_ns,
            mode=self._values.mode,
            speed_factor=speed_factor,
            load_publishers=self._load.count_senders(),
            sent={name: self._out.sent[name] for name in self._out.names if name not in UNCOUNTED_TOPICS},
            lost_messages=self._out.lost_messages,
            warnings=self._warnings(),
        )
        namespace = self._node.get_namespace()
        statuses = [
            twin_diagnostic(self._name, report, session.feed.refusals.report(), standing),
            lag_diagnostic(diagnostic_name(namespace, LAG), report, speed_factor),
        ]
        self._out.publish("/diagnostics", encode_diagnostics(clock_ns, frame_of(namespace), statuses))

    def _warnings(self) -> tuple[str, ...]:
        """Describe what is wrong with the graph or the middleware at present."""
        found = []
        if self._namesakes.younger:
            found.append(f"another twin speaks as {self._name}: it needs a namespace of its own")
        if "/clock" in self._out.names and self._node.count_publishers("/clock") > 1:
            found.append("somebody else publishes /clock too: only one twin may (parameter publish_clock)")
        if self._out.lost_recently:
            found.append(f"{self._out.lost_messages} message(s) could not be published")
        return tuple(found)
