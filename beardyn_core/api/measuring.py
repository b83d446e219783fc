"""Read measured files as a run, or make a recording of them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from beardyn_core.base.errors import in_python

if TYPE_CHECKING:
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.measured.about import Mounted
    from beardyn_core.measured.survey import Survey
    from beardyn_core.monitor.trend import TrendPoint
    from beardyn_core.record.run import Run

    Plates: TypeAlias = NamePlate | str | Mapping[str, NamePlate | str]

Files: TypeAlias = Path | str | Sequence[Path | str]


def read_measured(files: Files, *, bearing: Plates | None = None, **options: Any) -> Run:
    """Read measured files as a run: CSV, MATLAB, HDF5, WAV, NumPy, TDMS, Universal, MDF, Parquet, MCAP.

    All samples are in memory; `import_measured` makes a recording of any size.

    Parameters
    ----------
    files : Path or sequence of Path
        In the order of time.
    bearing : NamePlate, str or mapping, optional
        Bearing data; of several bearings on the shaft a mapping of names for them.
    **options
        How the files are to be read, in the units of the names: ``channels``, ``unit``, ``rate_Hz``,
        ``speed_rpm``, ... (docs/measured.md lists them).

    Returns
    -------
    Run
        ``run.measured`` states how the files were understood, in ``understood``; its truth is empty. Of an
        axis that was not measured the vibration is NaN.

    Warns
    -----
    UserWarning
        Options and file differ.

    Raises
    ------
    InputError
        With every mistake in options and files.
    """
    from beardyn_core.measured.found_speed import with_found_speed
    from beardyn_core.measured.in_memory import run_of

    mounted = _mounted_bearings(bearing)
    found = with_found_speed(_survey_files(files, options), mounted)
    run = run_of(found, mounted)
    for sentence in run.measured["warnings"][len(found.warnings) :]:
        warnings.warn(in_python(sentence), stacklevel=2)
    return run


def import_measured(
    files: Files, recording: Path | str, *, bearing: Plates | None = None, force: bool = False, **options: Any
) -> Path:
    """Make a recording of measured files: CSV, MATLAB, HDF5, WAV, TDMS, MDF, ...

    Make a recording of measured vibration and speed, like that of a simulation and without truth. Read are
    CSV and other text, MATLAB (also 7.3), HDF5, WAV, FLAC, NumPy, TDMS, Universal files (58), MDF, Parquet
    and MCAP of other tools. Several files are one measurement in the order given.

    Parameters
    ----------
    files : Path or sequence of Path
        Measured file to read. It is read block by block.
    recording : Path
        Recording to write. It is an MCAP file; `beardyn_core.read` reads it.
    bearing, options
        See `read_measured`.
    force : bool
        Replace the recording when it exists; default refuse.

    Raises
    ------
    InputError
        With every mistake; then nothing is written.
    """
    from beardyn_core.measured.found_speed import with_found_speed
    from beardyn_core.measured.writing import write_measured

    mounted = _mounted_bearings(bearing)
    made = write_measured(
        with_found_speed(_survey_files(files, options), mounted), recording, mounted, force=force
    )
    for sentence in made.warnings:
        warnings.warn(in_python(sentence), stacklevel=2)
    return made.path


def trend(files: Files, *, memory: Path | str | None = None, **options: Any) -> list[TrendPoint]:
    """Watch the levels of many records against the baseline of the first, as ``beardyn monitor --trend``.

    Parameters
    ----------
    files, options
        See `read_measured`; neither speed nor bearing is needed, and records of a tenth of a second do.
    memory : Path, optional
        Go on from this JSON file if it is there, and write it for the records to come.

    Returns
    -------
    list of TrendPoint
        After every record; the last one has the state, and since when.

    Raises
    ------
    InputError
        With every mistake in options and files.
    """
    from beardyn_core.measured.trending import trend_with_memory

    return trend_with_memory(_survey_files(files, options), None if memory is None else Path(memory))[0]


def _survey_files(files: Files, options: Mapping[str, Any]) -> Survey:
    from beardyn_core.measured.options import Reading
    from beardyn_core.measured.survey import survey

    paths = [files] if isinstance(files, str | Path) else list(files)
    found = survey(paths, Reading.of(**options))
    for sentence in found.warnings:
        warnings.warn(in_python(sentence), stacklevel=3)
    return found


def _mounted_bearings(bearing: Plates | None) -> tuple[Mounted, ...]:
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.config import load_plate
    from beardyn_core.measured.about import Mounted

    if bearing is None:
        return ()
    several = bearing if isinstance(bearing, Mapping) else {"bearing": bearing}
    return tuple(
        Mounted(label, each if isinstance(each, NamePlate) else load_plate(each))
        for label, each in several.items()
    )
