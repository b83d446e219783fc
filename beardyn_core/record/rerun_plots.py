"""Curves beside the bearing: force, vibration, speeds, roller loads and the envelope spectrum."""

from __future__ import annotations

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from beardyn_core.observe.features import OrderSpectrum
from beardyn_core.record.envelope import envelope_order_spectrum
from beardyn_core.record.rerun_bearing import roller_loads, send
from beardyn_core.record.rerun_spectrum import log_spectrum
from beardyn_core.record.run import Run

Colour = tuple[int, int, int]

FORCE = "plots/force"
VIBRATION = "plots/vibration"
SPEED_RATIO = "plots/speed_ratio"
SHAFT_SPEED = "plots/shaft_speed"
ROLLER_LOAD = "plots/roller_load"

AXIS_COLOURS: tuple[Colour, ...] = ((235, 92, 84), (92, 200, 110), (96, 156, 255))
ROW_COLOURS: tuple[Colour, ...] = ((255, 180, 70), (90, 205, 230))
HIGHEST_ORDER_OF_BPFI = 3.1


def log_plots(stream: rr.RecordingStream, run: Run) -> None:
    """Log every curve that the recording has data for, and the spectrum."""
    log_styles(stream, run.described().sensor_names)
    log_curves(stream, run)
    spectrum = order_spectrum(run)
    if spectrum is not None:
        log_spectrum(stream, spectrum, run.described().shape.fault_frequencies)


def vibration_entity(name: str) -> str:
    """Name the entity of the curves of a vibration topic."""
    return f"plots/{name.replace('/', '_')}"


def log_styles(stream: rr.RecordingStream, sensors: tuple[str, ...] = ()) -> None:
    """Log names and colours of the curves; `sensors` are all accelerometers."""
    dark = tuple(tuple(int(0.6 * part) for part in colour) for colour in ROW_COLOURS)
    rows = (*ROW_COLOURS, *dark)
    for entity, names, colours in (
        (FORCE, ("fx", "fy", "fz"), AXIS_COLOURS),
        (VIBRATION, ("ax", "ay", "az"), AXIS_COLOURS),
        *((vibration_entity(f"vibration/{name}"), ("ax", "ay", "az"), AXIS_COLOURS) for name in sensors[1:]),
        (SPEED_RATIO, ("cage 0", "cage 1", "rollers 0, mean", "rollers 1, mean"), rows),
        (
            ROLLER_LOAD,
            tuple(f"{what} of row {row}" for what in ("roller 0", "largest") for row in (0, 1)),
            rows,
        ),
        (SHAFT_SPEED, ("shaft",), ((200, 200, 210),)),
    ):
        # Averaging, the default, would hide impulses when zoomed out.
        lines = rr.SeriesLines(
            names=list(names), colors=list(colours), widths=[1.2] * len(names), aggregation_policy="MinMax"
        )
        stream.log(entity, lines, static=True)


def log_curves(stream: rr.RecordingStream, run: Run) -> None:
    """Log the samples of every curve."""
    _send(stream, FORCE, run.force.time_ns, run.force.values[:, :3] * 1e-3)
    for topic, vibration in run.sensor_topics.items():
        _send(stream, vibration_entity(topic), vibration.time_ns, vibration.values)
    _send_speeds(stream, run)
    if len(run.contacts) and len(run.bodies):
        load = roller_loads(run) * 1e-3
        values = np.concatenate((load[:, :, 0], load.max(axis=2)), axis=1)
        _send(stream, ROLLER_LOAD, run.bodies.time_ns, values)


def order_spectrum(run: Run) -> OrderSpectrum | None:
    """Compute the envelope order spectrum of the first accelerometer, to just over three times BPFI."""
    highest = HIGHEST_ORDER_OF_BPFI * run.described().shape.fault_frequencies["BPFI"]
    return envelope_order_spectrum(run.vibration, run.shaft, highest)


def _send_speeds(stream: rr.RecordingStream, run: Run) -> None:
    if len(run.shaft):
        _send(stream, SHAFT_SPEED, run.shaft.time_ns, run.shaft.speed[:, None] * 30.0 / np.pi)
    if not len(run.cages) or not len(run.shaft):
        return
    shaft = np.interp(run.cages.time_ns, run.shaft.time_ns, run.shaft.speed)
    nominal = run.described().shape.fault_frequencies["FTF"] * shaft
    nominal = np.where(np.abs(nominal) > 1e-6, nominal, np.nan)
    speeds = np.concatenate((run.cages.speed, run.rollers.speed.mean(axis=2)), axis=1)
    _send(stream, SPEED_RATIO, run.cages.time_ns, speeds / nominal[:, None])


def _send(
    stream: rr.RecordingStream, entity: str, time_ns: NDArray[np.int64], values: NDArray[np.float64]
) -> None:
    if len(time_ns):
        send(stream, entity, time_ns, rr.Scalars.columns(scalars=values))
