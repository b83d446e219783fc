"""Read a recording, let a monitor judge it or measured files; no compiler is imported."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from beardyn_core.api.run_sources import Source
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.monitor.chain import Algorithm, MonitorSettings
    from beardyn_core.monitor.severity import Severity
    from beardyn_core.record.run import Run
    from beardyn_core.study.monitored_recording import Conclusion


def read(path: Path | str, namespace: str | None = None) -> Run:
    """Read a recording; of a cut-off one everything up to the last complete chunk.

    Parameters
    ----------
    path : Path
        MCAP file of ``beardyn simulate``, of the recorder node, or of ``simulate(..., record=...)``.
    namespace : str, optional
        Of the axlebox to read; by default the first one in the file.

    Raises
    ------
    InputError
        The file is absent, not MCAP, or holds not one usable message.
    """
    from beardyn_core.record.reading import read_run

    return read_run(path, namespace)


def monitor(
    run: Source,
    algorithm: Algorithm | None = None,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    settings: MonitorSettings | None = None,
    **options: Any,
) -> Conclusion:
    """Run a monitor, ours or yours, over a recording or measured files.

    Pass vibration, shaft and load of a recording, or of measured files as `import` reads them, to a monitor,
    and give its verdicts; one for each bearing on the shaft.

    Parameters
    ----------
    run : Run, Path or sequence of Path
        Recording to analyse, or measured files in the order of time. A run does as well. Vibration of one
        accelerometer, shaft, load and temperature are used, and nothing else.
    algorithm : function, optional
        Your algorithm, its module may be in this folder; default the reference chain. In Python a `Chain`,
        or a function like it.
    bearing : Bearing, NamePlate or str, optional
        Bearing data, or the name or file of a bearing; by default that of the scene, of a measured
        run the one it was read with.
    sensor : str, optional
        Accelerometer to take; by default the first, or the one that measures the bearing of a measured run.
    settings : MonitorSettings, optional
    **options
        How measured files are to be read, ``speed_rpm``, ``unit`` and others: see `read_measured`.

    Returns
    -------
    Conclusion
        The most frequent verdict, how many analyses agree, and one of them.

    Raises
    ------
    InputError
        The run has no vibration with a shaft angle, or does not name its bearing.
    """
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.monitor.chain import REFERENCE
    from beardyn_core.study.monitored_recording import conclude, findings_of

    record, plate, sensor = resolve_source(run, bearing, sensor, options)
    return conclude(findings_of(record, plate, algorithm or REFERENCE, settings, sensor))


def severity(
    run: Source,
    conclusion: Conclusion | None = None,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    **options: Any,
) -> Severity | None:
    """Measure how wide the spall is that a monitor has found: not every fault matters.

    Parameters
    ----------
    run, bearing, sensor, options
        See `monitor`.
    conclusion : Conclusion, optional
        Result of `monitor`; by default it is computed.

    Returns
    -------
    Severity or None
        ``None`` where no part was called; ``not measurable`` with the reason where entry and exit of the
        rollers are not two clear events.
    """
    from beardyn_core.api.run_sources import resolve_source
    from beardyn_core.study.measured_severity import severity_in
    from beardyn_core.study.monitored_recording import conclude, findings_of

    record, plate, sensor = resolve_source(run, bearing, sensor, options)
    found = conclusion or conclude(findings_of(record, plate, sensor=sensor))
    return severity_in(record, found, plate, sensor)
