"""Read a recording, let a monitor judge a run: no kernel is needed, and no compiler imported."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
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
    run: Run | Path | str,
    algorithm: Algorithm | None = None,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    settings: MonitorSettings | None = None,
) -> Conclusion:
    """Run a monitor, ours or yours, over a recording or measured files.

    Pass vibration, shaft and load of a recording, or of measured files as `import` reads them, to a monitor,
    and give its verdicts; one for each bearing on the shaft.

    Parameters
    ----------
    run : Run or Path
        Recording to analyse, or measured files in the order of time. A run does as well; of measured files
        Python takes what `read_measured` gives. Vibration of one accelerometer, shaft, load and temperature
        are used, and nothing else.
    algorithm : function, optional
        Your algorithm, its module may be in this folder; default the reference chain. In Python a `Chain`,
        or a function like it.
    bearing : Bearing, NamePlate or str, optional
        Bearing data, or the name or file of a bearing; by default that of the scene, of a measured
        run the one it was read with.
    sensor : str, optional
        Accelerometer to take; by default the first, or the one that measures the bearing of a measured run.
    settings : MonitorSettings, optional

    Returns
    -------
    Conclusion
        The most frequent verdict, how many analyses agree, and one of them.

    Raises
    ------
    InputError
        The run has no vibration with a shaft angle, or does not name its bearing.
    """
    from beardyn_core.monitor.chain import REFERENCE
    from beardyn_core.study.monitored_recording import conclude, findings_of

    heard, plate, sensor = heard_of(run, bearing, sensor)
    return conclude(findings_of(heard, plate, algorithm or REFERENCE, settings, sensor))


def severity(
    run: Run | Path | str,
    conclusion: Conclusion | None = None,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
) -> Severity | None:
    """Measure how wide the spall is that a monitor has found: not every fault matters.

    Parameters
    ----------
    run, bearing, sensor
        See `monitor`.
    conclusion : Conclusion, optional
        Result of `monitor`; by default it is computed.

    Returns
    -------
    Severity or None
        ``None`` where no part was called; ``not measurable`` with the reason where entry and exit of the
        rollers are not two clear events.
    """
    from beardyn_core.study.measured_severity import severity_in
    from beardyn_core.study.monitored_recording import conclude, findings_of

    heard, plate, sensor = heard_of(run, bearing, sensor)
    found = conclusion or conclude(findings_of(heard, plate, sensor=sensor))
    return severity_in(heard, found, plate, sensor)


def heard_of(
    run: Run | Path | str, bearing: RollerBearing | NamePlate | str | None, sensor: str
) -> tuple[Run, RollerBearing | NamePlate, str]:
    """Find run, bearing and accelerometer."""
    from beardyn_core.choice import scene_from_text
    from beardyn_core.config import load_plate
    from beardyn_core.measured.about import mounted_in
    from beardyn_core.record.reading import read_run
    from beardyn_core.record.run import Run

    run = run if isinstance(run, Run) else read_run(run)
    if isinstance(bearing, str):
        bearing = load_plate(bearing)
    elif bearing is None and run.scene_text:
        bearing = scene_from_text(run.scene_text, run.label).bearing
    elif bearing is None:
        known = mounted_in(run.measured, run.label)
        if len(known) != 1:
            several = (
                f"has the bearings {', '.join(each.label for each in known)}"
                if known
                else "does not name its bearing"
            )
            raise InputError(f"{run.label}: {several}; give bearing")
        bearing, sensor = known[0].plate, sensor or known[0].sensor
    return run, bearing, sensor
