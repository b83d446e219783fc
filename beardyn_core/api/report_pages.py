"""A page for each axlebox: verdict, evidence, assumptions and what to do, to read on screen and paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.monitor.chain import Algorithm, MonitorSettings
    from beardyn_core.record.run import Run
    from beardyn_core.study.inspection import Inspection


def report(
    run: Run | Path | str | Sequence[Run | Path | str],
    *,
    html: Path | str | None = None,
    pdf: Path | str | None = None,
    train: str = "",
    axlebox: str = "",
    box: str | None = None,
    bearing: RollerBearing | NamePlate | str | None = None,
    sensor: str = "",
    algorithm: Algorithm | None = None,
    settings: MonitorSettings | None = None,
    force: bool = False,
    **options: Any,
) -> tuple[str, ...]:
    """Write a page for each axlebox: the verdict, why, what was assumed and what to do next.

    Parameters
    ----------
    run : Run, Path or a sequence of them
        Recordings or measured files, each judged by itself, the latest last; a run does as well.
    html : Path, optional
        Write a page for each bearing of the files, to read in a browser and to print: verdict, spectrum,
        waveform, assumptions, what to do next; default none. One file, with its pictures in it.
    pdf : Path, optional
        Write the same page as PDF; default none.
    train : str
        Train or vehicle, as it stands on the page; default as in the files.
    axlebox : str
        Axlebox, as it stands on the page; default as in the files.
    box : str, optional
        Axlebox of a recording of several; default every one.
    bearing, sensor, algorithm, settings
        See `monitor`.
    force : bool
        Replace pages that exist; default refuse.
    **options
        How measured files are to be read, ``speed_rpm``, ``unit`` and others: see `read_measured`.

    Returns
    -------
    tuple of str
        What the pages could not show, in sentences; usually nothing.

    Raises
    ------
    InputError
        With every mistake; then nothing is written.
    """
    from beardyn_core.study.report_page.page_writing import page_problems, write_pages

    runs = [run] if isinstance(run, str | Path) or not isinstance(run, Sequence) else list(run)
    page, paper = (None if each is None else Path(each) for each in (html, pdf))
    inputs = [path for each in runs if (path := _path_of(each)) is not None]
    problems = [] if page or paper else ["give html, pdf or both: files to write the page to"]
    problems += [] if runs else ["give a recording"]
    problems += page_problems(page, paper, inputs, force=force)
    if problems:
        raise InputError(problems)
    records = [_inspections_of(each, box, bearing, sensor, algorithm, settings, options) for each in runs]
    return write_pages(records, html=page, pdf=paper, train=train, axlebox=axlebox, force=force)


def _path_of(run: Run | Path | str) -> Path | None:
    return Path(run) if isinstance(run, str | Path) else run.path


def _inspections_of(
    run: Run | Path | str,
    box: str | None,
    bearing: RollerBearing | NamePlate | str | None,
    sensor: str,
    algorithm: Algorithm | None,
    settings: MonitorSettings | None,
    options: Mapping[str, Any],
) -> list[Inspection]:
    """Let the monitor judge every bearing of a run, of one axlebox or of all."""
    from beardyn_core.api.run_sources import read_source
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.config import load_plate
    from beardyn_core.measured.about import USUAL_LABEL, Mounted
    from beardyn_core.monitor.chain import REFERENCE
    from beardyn_core.study.inspection import inspect_boxes, inspect_run

    plate = load_plate(bearing) if isinstance(bearing, str) else bearing
    if isinstance(plate, RollerBearing):
        from beardyn_core.bearing.name_plate import NamePlate

        plate = NamePlate.of(plate)
    given = () if plate is None else (Mounted(USUAL_LABEL, plate, sensor),)
    recording = read_source(run, options, bearing=plate, box=box)
    if box is not None and recording.box != box:
        if box not in recording.boxes:
            raise InputError(f"{recording.label}: has no axlebox {box}; it has {', '.join(recording.boxes)}")
        recording = recording.boxes[box]
    return inspect_boxes(
        recording,
        lambda each: inspect_run(each, given, algorithm or REFERENCE, settings, sensor=sensor),
        alone=box is not None,
    )
