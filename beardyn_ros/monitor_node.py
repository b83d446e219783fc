"""A monitoring algorithm as a node: it reads what a train has, and knows the data of the bearing.

Inputs are ``vibration``, ``shaft``, the load (``load/blocks`` or ``load/wrench``) and ``temperature`` of
the axlebox. It never reads ``truth``, ``contacts``, ``bodies`` or ``joint_states``. The fault orders come
from the parameter ``bearing``. The algorithm is the chain of `beardyn_core.monitor.chain`, or yours by the
parameter ``algorithm``.
"""

from __future__ import annotations

import time
from collections.abc import Sequence

import numpy as np
from rclpy.node import Node

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import ZERO_CELSIUS
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.config import load_plate
from beardyn_core.monitor.chain import MonitorSettings, algorithm_named
from beardyn_core.monitor.chain.explanations import PART_NAMES
from beardyn_core.monitor.streaming import Monitor
from beardyn_core.record.cloud_layout import cloud_points
from beardyn_core.record.clouds import cloud_times
from beardyn_core.record.messages import (
    Diagnostic,
    decode,
    encode_diagnostics,
    header_stamp,
)
from beardyn_core.record.plot_samples import encode_samples
from beardyn_core.record.topics import WRENCH
from beardyn_core.study.monitored_recording import HOT_BOX, UNEXPLAINED, WAITING, Finding, Tally
from beardyn_ros.diagnostics import MONITOR, OK, WARN, diagnostic_name
from beardyn_ros.frames import frame_of
from beardyn_ros.node_parameters import FACTORS, PARAMETERS
from beardyn_ros.parameters import ParameterValues
from beardyn_ros.runtime import run_node, wall_timer
from beardyn_ros.train_signals import Hearer, TrainSignals
from beardyn_ros.typed_topics import TypedTopics
from beardyn_ros.value_topics import ValueTopics
from beardyn_ros.wire import TopicPublishers

TICK_S = 0.05
REPORT_PERIOD_S = 0.5
LAST_VALUES_S = 1.0
_UNJUDGED = (
    0.25  # of the interval: when a run ends, more than that since the last analysis has one of its own
)


def _bearing_of(values: ParameterValues) -> NamePlate:
    """Take the factors that are given, else the bearing of the name."""
    given = {each.name: value for each in FACTORS if (value := getattr(values, each.name))}
    return NamePlate(**given) if given else load_plate(values.bearing)


class MonitorNode(Node):
    """Shows vibration, shaft and load to a `Monitor` and publishes what it says."""

    def __init__(self) -> None:
        super().__init__("monitor", namespace="axlebox")
        self.finished = False
        self.exit_code = 0
        self._values = ParameterValues(self, PARAMETERS["monitor"])
        problems = []
        try:
            self._bearing = _bearing_of(self._values)
        except InputError as error:
            problems += [f"node monitor, parameter 'bearing': {each}" for each in error.problems]
        try:
            self._algorithm = algorithm_named(self._values.algorithm)
        except InputError as error:
            problems += [f"node monitor, parameter 'algorithm': {each}" for each in error.problems]
        if problems:
            raise InputError(problems)
        self._orders = self._bearing.frequencies
        frame = frame_of(self.get_namespace())
        typed = TypedTopics.wanted(self, self._values.typed, frame)
        self._out = TopicPublishers(self, "monitor/result", "/diagnostics", typed=typed)
        self._numbers = ValueTopics(self._out, MONITOR, frame, self._values.values)
        hearer = Hearer(self._begin, self._push_vibration, self._push_shaft, self._push_temperature)
        self._signals = TrainSignals(
            self,
            hearer,
            {"load/blocks": self._on_load, "load/wrench": self._on_wrench},
            self._publish_samples if self._values.waveform else None,
        )
        self._begin()
        self._reported_at = 0.0
        wall_timer(self, TICK_S, self._tick)
        self.get_logger().info(
            f"{self._bearing.name}: BPFO {self._orders.bpfo:.4f}, BPFI {self._orders.bpfi:.4f}, "
            f"BSF {self._orders.bsf:.4f}, FTF {self._orders.ftf:.4f} per shaft revolution"
        )
        for part, why in self._bearing.cannot_tell.items():
            self.get_logger().warning(f"not judged, {PART_NAMES[part]}: {why}")

    def _begin(self) -> None:
        values = self._values
        settings = MonitorSettings(
            interval=values.interval, warm=values.warm + ZERO_CELSIUS, hot=values.hot + ZERO_CELSIUS
        )
        self._monitor = Monitor(
            self._orders,
            self._bearing.roller_count,
            settings=settings,
            algorithm=self._algorithm,
            bearing=self._bearing,
        )
        self._tally = Tally()
        self._summed_up = False

    # --- what a train has --------------------------------------------------------------------------

    def _push_vibration(self, time_ns: Int, acceleration: Float) -> None:
        self._monitor.push_vibration(time_ns, acceleration)

    def _push_shaft(self, time_ns: Int, angle: Float) -> None:
        self._monitor.push_shaft(time_ns, angle)

    def _push_temperature(self, stamp_ns: int, celsius: float) -> None:
        self._monitor.push_temperature(stamp_ns, celsius + ZERO_CELSIUS)

    def _on_load(self, cdr: bytes) -> None:
        points = cloud_points(cdr)
        if len(points):
            self._monitor.push_load(cloud_times(cdr, points), points["fz"].astype(float))

    def _on_wrench(self, cdr: bytes) -> None:
        vertical = float(decode(WRENCH, cdr).wrench.force.z)
        self._monitor.push_load(np.array([header_stamp(cdr)]), np.array([vertical]))

    # --- what it says ------------------------------------------------------------------------------

    def _tick(self) -> None:
        self._signals.sweep()
        result = self._monitor.update()
        if result is not None:
            self._report_finding(Finding.of(result))
        if time.monotonic() - self._reported_at > REPORT_PERIOD_S:
            self._report()
        if self._signals.ended and not self._summed_up:
            self._sum_up()
        if self._summed_up or self._signals.vanished:
            self.finished = bool(self._values.exit_when_done)

    def _report_finding(self, finding: Finding) -> None:
        earlier = self._tally.latest.verdict if self._tally.latest else ""
        self._tally.add(finding)
        self._numbers.publish(finding.time, finding.to_values())
        self._publish(finding)
        if finding.verdict != earlier:
            if finding.is_fault or finding.verdict in (UNEXPLAINED, HOT_BOX):
                self.get_logger().warning(finding.reason)
            else:
                self.get_logger().info(finding.reason)

    def _publish_samples(self, cloud: bytes) -> None:
        self._out.publish("vibration_samples", encode_samples(cloud))

    def _publish(self, finding: Finding, *extra: tuple[str, str]) -> None:
        status = finding.to_diagnostic(diagnostic_name(self.get_namespace(), MONITOR), extra)
        stamp = round(finding.time * 1e9)
        self._out.publish(
            "monitor/result", encode_diagnostics(stamp, frame_of(self.get_namespace()), [status])
        )

    def _sum_up(self) -> None:
        """Log the last word about the run: the most frequent verdict."""
        self._summed_up = True
        latest = self._tally.latest
        if latest is None or self._monitor.behind(latest.time) > _UNJUDGED * self._values.interval:
            self._report_finding(Finding.of(self._monitor.result()))
        conclusion = self._tally.conclusion()
        finding = conclusion.finding or Finding(WAITING, "not enough signal for a verdict", 0.0)
        counts = (("agreeing", str(conclusion.agreeing)), ("analyses", str(conclusion.analyses)))
        self._numbers.wait_until_received(LAST_VALUES_S)
        self._publish(finding, ("final", "true"), *counts)
        self._report()
        self._out.wait_until_received("monitor/result", 1.0)

    def _report(self) -> None:
        self._reported_at = time.monotonic()
        namespace = self.get_namespace()
        latest = self._tally.latest or Finding(WAITING, "no verdict yet", 0.0)
        note = self._signals.clock_note
        warned = note or self._monitor.lost or self._monitor.refused or self._signals.guard.total
        status = Diagnostic(
            diagnostic_name(namespace, MONITOR),
            WARN if warned else OK,
            "; ".join(filter(None, (note, latest.reason))),
            (
                ("connected", "true" if self._signals.connected else "false"),
                ("verdict", latest.verdict),
                ("analyses", str(self._tally.analyses)),
                ("gaps_in_vibration", str(self._monitor.lost)),
                ("refused_blocks", str(self._monitor.refused)),
                *self._signals.guard.values(),
            ),
        )
        stamp = round(latest.time * 1e9)
        self._out.publish("/diagnostics", encode_diagnostics(stamp, frame_of(self.get_namespace()), [status]))

    def close(self) -> bool:
        """Do nothing: there is nothing to save and no thread to end."""
        return False


def main(argv: Sequence[str]) -> int:
    """Run the node until the twin has ended."""
    return run_node(MonitorNode, argv)
