"""A monitor beside a recording that is being made, or over one that is finished."""

from __future__ import annotations

from collections.abc import Callable

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.errors import InputError
from beardyn_core.observe.block import Block
from beardyn_core.observe.chain import REFERENCE, Algorithm, MonitorSettings
from beardyn_core.observe.monitoring import Monitor, MonitorInput, listen
from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import encode_diagnostics
from beardyn_core.record.run import Run
from beardyn_core.record.sinks import McapSink
from beardyn_core.record.topics import FRAME, NAMESPACE
from beardyn_core.study.finding import Finding

MONITOR_STATUS = "axlebox/monitor"


class MonitoredRecording(McapSink):
    """MCAP sink that passes vibration, shaft and load to a monitor and records its results.

    Parameters
    ----------
    path : Path
    bearing : Bearing
        What the name plate says; the monitor gets nothing else of the scene.
    on_finding : callable, optional
        Told of every result.
    algorithm : function, optional
        In place of the reference chain.
    replace : bool
        Whether an existing file is replaced.
    """

    def __init__(
        self,
        path: object,
        bearing: Bearing,
        on_finding: Callable[[Finding], None] | None = None,
        algorithm: Algorithm = REFERENCE,
        *,
        replace: bool = False,
    ) -> None:
        super().__init__(str(path), NAMESPACE, FRAME, replace=replace)
        self._bearing = bearing
        self._on_finding = on_finding
        self._algorithm = algorithm
        self.findings: list[Finding] = []

    def open(self, run: RunDescription) -> None:
        """Create the file and a fresh monitor."""
        super().open(run)
        orders, count = fault_frequencies(self._bearing), self._bearing.roller_count
        self._monitor = Monitor(orders, count, run.sensor_rates[0], algorithm=self._algorithm)
        self.findings = []

    def write(self, block: Block) -> None:
        """Append a block, and a result when one is due."""
        super().write(block)
        result = self._monitor.take(MonitorInput.of_block(block))
        if result is None:
            return
        finding = Finding.of(result)
        self.findings.append(finding)
        message = encode_diagnostics(result.end_ns, FRAME, [finding.to_diagnostic(MONITOR_STATUS)])
        self._opened().add("monitor/result", result.end_ns, message)
        if self._on_finding is not None:
            self._on_finding(finding)


def findings_of(
    run: Run,
    bearing: Bearing,
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
) -> list[Finding]:
    """Let a monitor, ours or another, analyse a finished run, as it would have done beside it.

    The bearing is what the name plate says.

    Raises
    ------
    InputError
        When there is no vibration or no shaft in the recording.
    """
    if not len(run.vibration) or not len(run.shaft):
        raise InputError(f"{run.label}: has no vibration with a shaft angle to listen to")
    orders, count = fault_frequencies(bearing), bearing.roller_count
    monitor = Monitor(orders, count, settings=settings, algorithm=algorithm)
    return [Finding.of(result) for result in listen(monitor, run.monitor_inputs())]
