"""What plots are drawn of: runs, recordings, measured files and static solutions."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from beardyn_core.base.errors import InputError

if TYPE_CHECKING:
    from beardyn_core.base.arrays import Float
    from beardyn_core.bearing.kinematics import FaultFrequencies
    from beardyn_core.bearing.name_plate import NamePlate
    from beardyn_core.bearing.roller_bearing import RollerBearing
    from beardyn_core.physics.statics.static import StaticSolution
    from beardyn_core.record.arrays import Signal
    from beardyn_core.record.run import Run


class BearingSignal(NamedTuple):
    """Vibration of a run and the frequencies of its bearing."""

    run: Run
    signal: Signal
    frequencies: FaultFrequencies


def run_from(source: Run | Path | str) -> Run:
    """Give a run, or read that of a recording or of a measured file which states its rate and unit."""
    from beardyn_core.api.run_sources import is_measured_file, read_source

    try:
        return read_source(source)
    except InputError as error:
        if not isinstance(source, str | Path) or not is_measured_file(Path(source)):
            raise
        call = f"bd.read_measured({str(source)!r}, unit=..., rate_Hz=..., ...)"
        raise InputError(
            [*error.problems, f"{source}: {call} reads a file that does not state them; give its run"]
        ) from None


def vibration_of(run: Run, sensor: str) -> Signal:
    """Give the vibration of an accelerometer, of the first where none is named."""
    if sensor and sensor not in run.sensors:
        raise InputError(f"{run.label}: has no sensor {sensor!r}; it has {', '.join(run.sensors)}")
    signal = run.sensors[sensor] if sensor else run.vibration
    if len(signal) < 16:
        raise InputError(f"{run.label}: has no vibration")
    return signal


def bearing_signal(run: Run, bearing: RollerBearing | NamePlate | str | None, sensor: str) -> BearingSignal:
    """Give vibration and fault frequencies of a bearing: without one, of that of the run."""
    from beardyn_core.api.run_sources import resolve_source

    run, plate, sensor = resolve_source(run, bearing, sensor)
    return BearingSignal(run, vibration_of(run, sensor), plate.frequencies)


def rollers_on_cup(source: Run | StaticSolution | Path | str, at: float | None) -> tuple[Float, Float, Float]:
    """Take azimuth [rad], load [N] and pressure [Pa] of rollers on the cup, shape [moment, row, roller]."""
    from beardyn_core.physics.statics.static import StaticSolution
    from beardyn_core.sensors.summary import SETTLING_S

    if isinstance(source, StaticSolution):
        if at is not None:
            raise InputError("at is given; a static solution has no time")
        rows, count = source.cup_load.shape
        azimuth = np.tile(2.0 * np.pi * np.arange(count) / count, (rows, 1))
        return azimuth[None], source.cup_load[None], source.cup_pressure[None]
    run = run_from(source)
    contacts, bodies = run.contacts, run.bodies
    if not len(contacts) or not len(bodies):
        raise InputError(f"{run.label}: has no contacts of rollers; simulated runs have them")
    time = contacts.time
    if at is None:
        shown = time >= min(SETTLING_S, 0.5 * time[-1])
    elif time[0] <= at <= time[-1] or np.isclose(at, 0.0):
        shown = np.arange(len(time)) == np.abs(time - at).argmin()
    else:
        raise InputError(f"at is {at:g}; the run has {time[0]:g} to {time[-1]:g} s")
    rows, count = contacts.slip.shape[1:3]
    names = [f"roller_{row}_{k}" for row in range(rows) for k in range(count)]
    places = [bodies.names.index(name) for name in names]
    centre = bodies.pose[shown][:, places, :3].reshape(-1, rows, count, 3)
    cup = contacts.of("cup")
    azimuth = np.arctan2(centre[..., 0], centre[..., 2])
    return azimuth, contacts.load[shown][..., cup], contacts.pressure[shown][..., cup]
