"""A monitor beside a recording that is being made, or over one that is finished."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.errors import InputError
from beardyn_core.model.heat import NODES
from beardyn_core.observe.block import Block
from beardyn_core.observe.chain import REFERENCE, Algorithm, MonitorSettings
from beardyn_core.observe.monitoring import Monitor
from beardyn_core.record.description import RunDescription
from beardyn_core.record.messages import encode_diagnostics
from beardyn_core.record.reading import Run
from beardyn_core.record.sinks import McapSink
from beardyn_core.record.topics import FRAME, NAMESPACE
from beardyn_core.study.finding import Finding

BLOCK_SAMPLES = 512
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
        self._monitor.push_vibration(block.vibration[0].time_ns, block.vibration[0].acceleration)
        self._monitor.push_shaft(block.trend_time_ns, block.shaft_angle)
        self._monitor.push_load(block.trend_time_ns, block.load[:, 2])
        if block.temperature is not None:
            box = float(block.temperature[NODES.index("axlebox")])
            self._monitor.push_temperature(block.end_ns, box)
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


def findings_of(
    run: Run,
    bearing: Bearing,
    algorithm: Algorithm = REFERENCE,
    settings: MonitorSettings | None = None,
) -> list[Finding]:
    """What a monitor says over a finished recording, as it would have said beside it.

    Parameters
    ----------
    run : Run
        Its ``vibration``, ``shaft`` and ``load/blocks`` are heard.
    bearing : Bearing
        What the name plate says.
    algorithm : function, optional
        In place of the reference chain.
    settings : MonitorSettings, optional

    Raises
    ------
    InputError
        When there is no vibration or no shaft in the recording.
    """
    vibration = run.vibration.get("vibration")
    if vibration is None or not len(vibration) or not len(run.shaft):
        raise InputError(f"{run.path}: has no vibration with a shaft angle to listen to")
    monitor = Monitor(
        fault_frequencies(bearing), bearing.roller_count, settings=settings, algorithm=algorithm
    )
    findings = []
    shaft_time, shaft_angle = run.shaft.time_ns, run.shaft.position[:, 0]
    load_time, force = run.load.time_ns, run.load.wrench[:, 2]
    tachometer = loads = 0
    for begin in range(0, len(vibration), BLOCK_SAMPLES):
        part = slice(begin, begin + BLOCK_SAMPLES)
        last = vibration.time_ns[part][-1]
        monitor.push_vibration(vibration.time_ns[part], vibration.values[part])
        heard = slice(tachometer, tachometer := int(np.searchsorted(shaft_time, last, side="right")))
        monitor.push_shaft(shaft_time[heard], shaft_angle[heard])
        carried = slice(loads, loads := int(np.searchsorted(load_time, last, side="right")))
        monitor.push_load(load_time[carried], force[carried])
        result = monitor.update()
        findings += [] if result is None else [Finding.of(result)]
    return findings
