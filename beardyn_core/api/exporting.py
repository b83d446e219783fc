"""Write signals of a recording for other programs."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from beardyn_core.record.run import Run


def export(
    recording: Run | Path | str,
    output: Path | str,
    *,
    signals: Sequence[str] = (),
    box: str | None = None,
    force: bool = False,
) -> list[Path]:
    """Write signals of a recording as Parquet, CSV, NPZ, HDF5 or WAV.

    Write signals of a recording to a file of another format, SI units. Parquet, NPZ and HDF5 carry the truth
    of the run; CSV and WAV get a JSON file with it next to them. Parquet, CSV and WAV hold one table: with
    several signals each goes to NAME_SIGNAL.ENDING. A set of runs that `sweep` has made goes to one file,
    .h5, .npz or .parquet, with signals and labels.

    Parameters
    ----------
    recording : Run, Path or str
        Recording to read, or folder of a set. A run does as well.
    output : Path or str
        File to write; its ending is the format: .parquet, .csv, .npz, .h5 or .wav.
    signals : sequence of str, optional
        Signals: vibration, force, force_waveform, shaft, torque, cages, rollers, bodies, contacts, load,
        temperature, ...; default every vibration, for .npz and .h5 all.
    box : str, optional
        Axlebox of a recording of several, such as axle_1_left; default the first one.
    force : bool
        Replace files that exist; default refuse.

    Returns
    -------
    list of Path
        The files that were written.

    Raises
    ------
    InputError
        The format or a signal is not known, a file exists, a library is missing, or the disk refused; all
        mistakes at once and nothing written but in the last case.
    """
    from beardyn_core.record.exporting import export as export_run
    from beardyn_core.record.reading import read_run
    from beardyn_core.record.run import Run

    if isinstance(recording, Run):
        return export_run(recording, output, signals=signals, force=force)
    if is_set(recording):
        from beardyn_core.population.exporting import export_set
        from beardyn_core.population.labelled_set import LabelledSet

        return export_set(LabelledSet(recording), output, signals, force)
    return export_run(read_run(recording, box), output, signals=signals, force=force)


def is_set(path: Path | str) -> bool:
    """Tell whether a path is the folder of a set of runs."""
    return (Path(path) / "set.json").is_file()
