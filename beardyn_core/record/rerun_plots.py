"""Curves next to the bearing: force, vibration, speeds, roller loads and the envelope spectrum."""

from __future__ import annotations

import numpy as np
import rerun as rr
import rerun.blueprint as rrb
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.monitor.features import OrderSpectrum
from beardyn_core.record.envelope_spectrum import envelope_order_spectrum
from beardyn_core.record.rerun_bearing import roller_loads, send
from beardyn_core.record.rerun_scale import nice_ticks, round_range
from beardyn_core.record.run import Run

Colour = tuple[int, int, int]

ENTITY = "plots/envelope"
WIDTH, HEIGHT = 1000.0, 240.0
SPECTRUM_COLOUR: Colour = (80, 145, 255)
FRAME_COLOUR: Colour = (128, 134, 148)
GRID_COLOUR = (128, 134, 148, 70)
# colour, harmonics and row of the label of each marker
MARKERS: dict[str, tuple[Colour, int, int]] = {
    "BPFO": ((240, 70, 90), 3, 2),
    "BPFI": ((230, 155, 30), 3, 1),
    "2 BSF": ((70, 185, 90), 2, 0),
    "FTF": ((175, 110, 240), 1, 1),
}
ROW_HEIGHT = 25.0


def log_spectrum(stream: rr.RecordingStream, spectrum: OrderSpectrum, frequencies: dict[str, float]) -> None:
    """Draw the spectrum with axes and the orders of every fault, BPFO and the like, per shaft revolution."""
    last = float(spectrum.order[-1])
    # The lowest orders hold the slow change of load, not faults; they must not set the scale.
    searched = spectrum.order > 0.5 * frequencies["FTF"]
    top = max(float(spectrum.amplitude[searched].max()), 1e-12) * 1.08
    _frame(stream, last, top)
    for name in MARKERS:  # a roller fault shows at twice its frequency first
        order = 2.0 * frequencies["BSF"] if name == "2 BSF" else frequencies[name]
        _marker(stream, name, order, last)
    shown = np.minimum(spectrum.amplitude, top)
    line = np.stack((spectrum.order / last * WIDTH, HEIGHT * (1.0 - shown / top)), axis=1)
    stream.log(
        f"{ENTITY}/spectrum",
        rr.LineStrips2D([line], colors=[SPECTRUM_COLOUR], radii=rr.Radius.ui_points(0.8), draw_order=20.0),
        static=True,
    )


def bounds() -> rrb.VisualBounds2D:
    """Compute the part of the drawing plane that the plot fills."""
    return rrb.VisualBounds2D(x_range=[-50.0, WIDTH + 20.0], y_range=[-3.2 * ROW_HEIGHT, HEIGHT + 30.0])


def _frame(stream: rr.RecordingStream, last: float, top: float) -> None:
    box = np.array([(0.0, 0.0), (0.0, HEIGHT), (WIDTH, HEIGHT)])
    orders, levels = nice_ticks(last, 8), nice_ticks(top, 4)
    grid = [np.array([(x, 0.0), (x, HEIGHT)]) for x in orders / last * WIDTH]
    grid += [np.array([(0.0, y), (WIDTH, y)]) for y in HEIGHT * (1.0 - levels / top)]
    colours = [GRID_COLOUR] * len(grid) + [(*FRAME_COLOUR, 255)]
    width = rr.Radius.ui_points(0.6)
    shown = rr.LineStrips2D([*grid, box], colors=colours, radii=width, draw_order=1.0)
    stream.log(f"{ENTITY}/grid", shown, static=True)
    below = np.stack((orders / last * WIDTH, np.full(len(orders), HEIGHT + 4.0)), axis=1)
    beside = np.stack((np.full(len(levels), -30.0), HEIGHT * (1.0 - levels / top) - 13.0), axis=1)
    _labels(stream, "order", below, [f"{order:g}" for order in orders], FRAME_COLOUR)
    _labels(stream, "level", beside, [f"{level:.3g}" for level in levels], FRAME_COLOUR)


def _marker(stream: rr.RecordingStream, name: str, order: float, last: float) -> None:
    colour, harmonics, row = MARKERS[name]
    multiples = np.arange(1, harmonics + 1)
    multiples = multiples[multiples * order <= last]
    place = multiples * order / last * WIDTH
    if not len(place):
        return
    heights = np.full(len(place), -ROW_HEIGHT * (0.8 + row))
    lines = [np.array([(x, heights[0]), (x, HEIGHT)]) for x in place]
    width = rr.Radius.ui_points(0.9)
    shown = rr.LineStrips2D(lines, colors=[(*colour, 190)], radii=width, draw_order=10.0)
    stream.log(f"{ENTITY}/{name.replace(' ', '')}", shown, static=True)
    labels = [f"{name} {order:.2f}" if multiple == 1 else f"{multiple}x" for multiple in multiples]
    _labels(stream, name.replace(" ", ""), np.stack((place, heights), axis=1), labels, colour)


def _labels(
    stream: rr.RecordingStream, name: str, at: NDArray[np.float64], texts: list[str], colour: Colour
) -> None:
    size = rr.Radius.ui_points(0.01)
    shown = rr.Points2D(at, labels=texts, colors=[colour], radii=size, show_labels=True, draw_order=30.0)
    stream.log(f"{ENTITY}/text/{name}", shown, static=True)


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


Curves = dict[str, tuple[NDArray[np.int64], Float]]


def curves_of(run: Run) -> Curves:
    """Gather the samples of every curve that the recording has data for: by entity, times [ns] and values."""
    found: Curves = {FORCE: (run.force.time_ns, run.force.values[:, :3] * 1e-3)}
    for topic, vibration in run.sensor_topics.items():
        found[vibration_entity(topic)] = vibration.time_ns, vibration.values
    if len(run.shaft):
        found[SHAFT_SPEED] = run.shaft.time_ns, run.shaft.speed[:, None] * 30.0 / np.pi
    if len(run.cages) and len(run.shaft):
        found[SPEED_RATIO] = run.cages.time_ns, _speed_ratios(run)
    if len(run.contacts) and len(run.bodies):
        load = roller_loads(run) * 1e-3
        values = np.concatenate((load[:, :, 0], load.max(axis=2)), axis=1)
        found[ROLLER_LOAD] = run.bodies.time_ns, values
    return {entity: (time_ns, values) for entity, (time_ns, values) in found.items() if len(time_ns)}


def log_curves(stream: rr.RecordingStream, run: Run) -> None:
    """Log the samples of every curve."""
    for entity, (time_ns, values) in curves_of(run).items():
        send(stream, entity, time_ns, rr.Scalars.columns(scalars=values))


def ranges_of(run: Run) -> dict[str, tuple[float, float]]:
    """Choose a round range of every curve, by entity."""
    ranges = {entity: round_range(values) for entity, (_, values) in curves_of(run).items()}
    return {entity: each for entity, each in ranges.items() if each is not None}


def order_spectrum(run: Run) -> OrderSpectrum | None:
    """Compute the envelope order spectrum of the first accelerometer, to just over three times BPFI."""
    highest = HIGHEST_ORDER_OF_BPFI * run.described().shape.fault_frequencies["BPFI"]
    return envelope_order_spectrum(run.vibration, run.shaft, highest)


def _speed_ratios(run: Run) -> Float:
    """Compute the speeds of cages and of the mean roller of each row over those of pure rolling."""
    shaft = np.interp(run.cages.time_ns, run.shaft.time_ns, run.shaft.speed)
    nominal = run.described().shape.fault_frequencies["FTF"] * shaft
    nominal = np.where(np.abs(nominal) > 1e-6, nominal, np.nan)
    ratios: Float = np.concatenate((run.cages.speed, run.rollers.speed.mean(axis=2)), axis=1)
    return ratios / nominal[:, None]
