"""What the twin says about its runs on ``/diagnostics``: the present one, and one that a reset has left."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from beardyn_core.record.messages import encode_diagnostics
from beardyn_ros.diagnostics import (
    LAG,
    TWIN,
    NodeStanding,
    diagnostic_name,
    lag_diagnostic,
    twin_diagnostic,
)
from beardyn_ros.frames import frame_of
from beardyn_ros.identity import Namesakes
from beardyn_ros.load_intake import LoadIntake
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.run_state import END_STATES, INTERRUPTED, LEFT, SessionReport
from beardyn_ros.session import TwinSession
from beardyn_ros.wire import TopicPublishers

UNCOUNTED_TOPICS = ("load/consumed", "/clock", "/diagnostics")  # they go on when the run is over


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

    def leave(self, report: SessionReport) -> None:
        """Keep the report of a run that a reset leaves, unless that run has had its last word."""
        if report.run_id and report.state not in END_STATES:
            self._left = replace(report, state=INTERRUPTED, sentence=LEFT)

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
        if self._values.publish_clock and self._node.count_publishers("/clock") > 1:
            found.append("somebody else publishes /clock too: only one twin may (parameter publish_clock)")
        if self._out.lost_recently:
            found.append(f"{self._out.lost_messages} message(s) could not be published")
        return tuple(found)
