"""A recording with the monitor beside it: the desk's counterpart of recorder node and monitor node."""

from __future__ import annotations

from collections.abc import Callable

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.observe.block import Block
from beardyn_core.observe.monitoring import Monitor
from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import encode_diagnostics
from beardyn_core.record.sinks import McapSink
from beardyn_core.record.topics import FRAME, NAMESPACE
from beardyn_core.study.finding import Finding

MONITOR_STATUS = "axlebox/monitor"


class MonitoredRecording(McapSink):
    """MCAP sink that shows vibration, shaft and load to a monitor and records what it says.

    Parameters
    ----------
    path : Path
    bearing : Bearing
        What the name plate says; the monitor gets nothing else of the scene.
    on_finding : callable, optional
        Told of every result.
    """

    def __init__(
        self, path: object, bearing: Bearing, on_finding: Callable[[Finding], None] | None = None
    ) -> None:
        super().__init__(str(path), NAMESPACE, FRAME)
        self._bearing = bearing
        self._on_finding = on_finding
        self.findings: list[Finding] = []

    def open(self, run: RunDescription) -> None:
        """Create the file and a fresh monitor."""
        super().open(run)
        self._monitor = Monitor(
            fault_frequencies(self._bearing), self._bearing.roller_count, run.sensor_rates[0]
        )
        self.findings = []

    def write(self, block: Block) -> None:
        """Append a block, and a result when one is due."""
        super().write(block)
        self._monitor.push_vibration(block.vibration[0].time_ns, block.vibration[0].acceleration)
        self._monitor.push_shaft(block.trend_time_ns, block.shaft_angle)
        self._monitor.push_load(block.trend_time_ns, block.load[:, 2])
        result = self._monitor.update()
        if result is None:
            return
        finding = Finding.of(result)
        self.findings.append(finding)
        status = finding.to_diagnostic(MONITOR_STATUS)
        self._opened().add(
            "monitor/result", result.end_ns, encode_diagnostics(result.end_ns, FRAME, [status])
        )
        if self._on_finding is not None:
            self._on_finding(finding)
