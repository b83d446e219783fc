"""Runs as callers give them: as they are, of a recording, or of measured files; and their bearing."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.record.run import Run

    Source: TypeAlias = Run | Path | str | Sequence[Path | str]

_NOTHING: Mapping[str, Any] = {}


def read_source(
    source: Source,
    options: Mapping[str, Any] = _NOTHING,
    *,
    bearing: RollerBearing | NamePlate | str | None = None,
    box: str | None = None,
) -> Run:
    """Take a run, or read that of a recording or of measured files.

    Parameters
    ----------
    source : Run, Path or sequence of Path
        Several paths are measured files in the order of time.
    options : mapping
        Of measured files, as `read_measured` takes them.
    bearing : optional
        Of measured files; a speed that is to be found in the vibration needs it.
    box : str, optional
        Axlebox of a recording; by default the first.

    Raises
    ------
    InputError
        The files cannot be read, or options are given and nothing is to be read with them.
    """
    from beardyn_core.api.measuring import read_measured
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.record.reading import read_run
    from beardyn_core.record.run import Run

    if isinstance(source, Run):
        if options:
            raise InputError(f"{', '.join(options)}: for measured files; {source.label} is read already")
        return source
    if not isinstance(source, str | Path) or "channels" in options or is_measured_file(Path(source)):
        if bearing is not None and not isinstance(bearing, str | NamePlate):
            bearing = NamePlate.of(bearing)
        return read_measured(source, bearing=bearing, **options)
    if options and Path(source).exists():
        raise InputError(f"{', '.join(options)}: for measured files; {source} is a recording")
    return read_run(source, box)


def is_measured_file(path: Path) -> bool:
    """Check whether a file is no recording, neither by its ending nor by its first bytes."""
    from beardyn_core.record.mcap_scanning import MAGIC

    if not path.is_file() or path.suffix.lower() in (".mcap", ".yaml"):
        return False
    try:
        with path.open("rb") as file:
            return file.read(len(MAGIC)) != MAGIC
    except OSError:
        return False  # the reader of recordings states why


def resolve_source(
    source: Source,
    bearing: RollerBearing | NamePlate | str | None,
    sensor: str,
    options: Mapping[str, Any] = _NOTHING,
) -> tuple[Run, RollerBearing | NamePlate, str]:
    """Find the run, its bearing, and the accelerometer on it.

    Parameters
    ----------
    source, options
        See `read_source`.
    bearing : optional
        By default that of the scene, or the one that a measured run was read with.
    sensor : str
        Empty for the one that measures the bearing, else the first.

    Raises
    ------
    InputError
        The bearing is not known, or there are several.
    """
    from beardyn_core.choice import scene_from_text
    from beardyn_core.config import load_plate
    from beardyn_core.measured.about import mounted_in

    run = read_source(source, options, bearing=bearing)
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
            raise InputError(f"{run.label}: {several}; give --bearing")
        bearing, sensor = known[0].plate, sensor or known[0].sensor
    return run, bearing, sensor
