"""Severity of the fault that a monitor has found in a run."""

from __future__ import annotations

import numpy as np

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.monitor.rotation_segments import turning_legs
from beardyn_core.monitor.severity import Severity, severity_near
from beardyn_core.monitor.streaming import measured_axes
from beardyn_core.record.run import Run
from beardyn_core.study.monitored_recording import Conclusion

_ENOUGH, _MOST = 20.0, 200.0  # revolutions


def severity_in(
    run: Run, conclusion: Conclusion, bearing: RollerBearing | NamePlate, sensor: str = ""
) -> Severity | None:
    """Measure the spall that was found in a run; ``None`` where no part was called or nothing turned."""
    finding = conclusion.finding
    if finding is None or not finding.is_fault:
        return None
    signal = run.sensors[sensor] if sensor else run.vibration
    angle = np.interp(signal.time_ns, run.shaft.time_ns, np.unwrap(run.shaft.angle))
    legs = turning_legs(angle, signal.rate, _ENOUGH, _MOST)
    if not len(legs.samples):
        return None
    plate = bearing if isinstance(bearing, NamePlate) else NamePlate.of(bearing)
    received = measured_axes(signal.values)[legs.samples]
    return severity_near(received, signal.rate, legs.angle, finding.verdict, finding.found_order, plate)
