"""Read a recording, let a monitor judge a run: no kernel is needed, and no compiler imported."""

from __future__ import annotations

from pathlib import Path

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.choice import scene_from_text
from beardyn_core.errors import InputError
from beardyn_core.observe.chain import REFERENCE, Algorithm, MonitorSettings
from beardyn_core.record.reading import read_run
from beardyn_core.record.run import Run
from beardyn_core.study.monitored_recording import Conclusion, conclude, findings_of


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
    return read_run(path, namespace)


def monitor(
    run: Run | Path | str,
    algorithm: Algorithm = REFERENCE,
    *,
    bearing: Bearing | None = None,
    settings: MonitorSettings | None = None,
) -> Conclusion:
    """Let a monitor judge a run, as ``beardyn monitor`` does.

    Parameters
    ----------
    run : Run or Path
        A run or a recording: vibration of its first accelerometer, shaft, load and temperature are used,
        and nothing else.
    algorithm : function, optional
        In place of the reference chain: a `Chain`, or a function like it.
    bearing : Bearing, optional
        What the name plate says; by default the bearing of the scene.
    settings : MonitorSettings, optional

    Returns
    -------
    Conclusion
        The most frequent verdict, how many analyses agree, and one of them.

    Raises
    ------
    InputError
        The run has no vibration with a shaft angle, or does not say which bearing it is of.
    """
    run = run if isinstance(run, Run) else read_run(run)
    if bearing is None and not run.scene_text:
        raise InputError(f"{run.label}: does not say which bearing it is of; give bearing")
    plate = bearing or scene_from_text(run.scene_text, run.label).bearing
    return conclude(findings_of(run, plate, algorithm, settings))
