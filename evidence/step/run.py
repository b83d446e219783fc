"""One run of the study, reduced to what is compared."""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.errors import ValidityError
from beardyn_core.physics.bodies.layout import SIGNAL_TORQUE
from beardyn_core.physics.bodies.rates import SAMPLES_PER_BLOCK, WAVEFORM_RATE
from beardyn_core.physics.tiers.status import chatter_index, describe
from beardyn_core.rail.build import load_of_scene
from beardyn_core.sensors.resampling import Decimator
from beardyn_core.study.measures import third_octave_levels
from beardyn_core.twin import Twin
from evidence.step.cases import Method, Point, scene_of

Float = NDArray[np.float64]

SEGMENT = 512
LINE_WIDTH = WAVEFORM_RATE / SEGMENT
HIGHEST = 10_000.0
LINES = LINE_WIDTH * np.arange(1, round(HIGHEST / LINE_WIDTH) + 1)
PARTS = 5
BEGIN = 5.0e-3
_ZERO_LEVEL = 1.0e-6  # ISO 1683, [m/s^2]


@dataclass(frozen=True)
class StepRun:
    """What a run came to; the parts of a run are equal stretches of it.

    Parameters
    ----------
    mean : float64 array, shape [1 + part]
        Torque of the whole run and of each part, [N m].
    scatter, filtered_scatter : float64 array, shape [1 + part]
        Standard deviation of the torque at every step, and behind the anti-alias filter at 25.6 kHz, [N m].
    bands : float64 array, shape [1 + part, band]
        Third octaves of the housing acceleration, re 1 um/s^2, [dB].
    lines : float64 array, shape [1 + part, line]
        Power of the housing acceleration in `LINES`, all axes together, re 1 um/s^2, [dB].
    begun : float
        Mean torque of the first `BEGIN` seconds, in which runs that begin alike still follow one another at
        any step, [N m].
    chatter : float
        Largest chatter index of a block, [-].
    status : str
        ``fine``, or what the monitor says.
    wall : float
        Wall time per simulated second, [-].
    """

    mean: Float
    scatter: Float
    filtered_scatter: Float
    bands: Float
    lines: Float
    begun: float
    chatter: float
    status: str
    wall: float


def run_once(point: Point, method: Method, number: int, settling: float, duration: float) -> StepRun:
    """Run from equilibrium, leave the settling out, and keep what is compared.

    Parameters
    ----------
    point : Point
    method : Method
    number : int
        Of the repetition; each begins a hair apart.
    settling, duration : float
        [s].

    Raises
    ------
    ValidityError
        It left the model's validity.
    """
    twin = Twin(scene_of(point, method, number))
    block_s = 1e-9 * twin.block_ns
    settled, blocks = round(settling / block_s), PARTS * max(1, round(duration / block_s / PARTS))
    twin.warm()
    scene = twin.scene
    twin.start(load_of_scene(scene, (settled + blocks + 1) * block_s))
    filtered = Decimator(method.steps, 1)
    moments, torque, housing = [], [], []
    begun, chatter, status = 0.0, 0.0, 0
    began = time.perf_counter()
    for index in range(settled + blocks):
        block = twin.advance()
        every = twin.step_signals[:, SIGNAL_TORQUE]
        wave = filtered.push(every[:, None])[:, 0]
        if index == 0:
            begun = float(every[: round(BEGIN / block_s * len(every))].mean())
        if index >= settled:
            status |= block.status
            moments.append((every.mean(), np.mean(every**2)))
            torque.append(wave)
            housing.append(block.acceleration[0])
            state = twin.snapshot().state
            chatter = max(chatter, float(chatter_index(state, len(every)).max()))
    wall = (time.perf_counter() - began) / ((settled + blocks) * block_s)
    sums, signal, accelerations = np.array(moments), np.concatenate(torque), np.concatenate(housing)
    pieces = [slice(0, blocks), *_pieces(blocks)]
    stretches = [slice(piece.start * SAMPLES_PER_BLOCK, piece.stop * SAMPLES_PER_BLOCK) for piece in pieces]
    return StepRun(
        mean=np.array([sums[piece, 0].mean() for piece in pieces]),
        scatter=np.array([_deviation(sums[piece]) for piece in pieces]),
        filtered_scatter=np.array([signal[stretch].std() for stretch in stretches]),
        bands=np.array([third_octave_levels(accelerations[stretch]) for stretch in stretches]),
        lines=np.array([line_levels(accelerations[stretch]) for stretch in stretches]),
        begun=begun,
        chatter=chatter,
        status=describe(status),
        wall=wall,
    )


def attempt(point: Point, method: Method, number: int, settling: float, duration: float) -> StepRun | str:
    """Return the result of `run_once`, or the sentence with which the run ended."""
    try:
        return run_once(point, method, number, settling, duration)
    except ValidityError as error:
        return str(error)


def _pieces(blocks: int) -> list[slice]:
    each = blocks // PARTS
    return [slice(part * each, (part + 1) * each) for part in range(PARTS)]


def _deviation(sums: Float) -> float:
    """Compute the standard deviation from the means and mean squares of equal blocks."""
    mean, square = sums.mean(axis=0)
    return float(np.sqrt(max(square - mean**2, 0.0)))


def line_levels(acceleration: Float) -> Float:
    """Return the power in each of `LINES`, all axes together, re 1 um/s^2, [dB].

    Parameters
    ----------
    acceleration : float64 array, shape [sample, axis]
        [m/s^2].

    References
    ----------
    Welch (1967), with Hann windows that overlap by half.
    """
    window = np.hanning(SEGMENT + 1)[:-1]
    centred = acceleration - acceleration.mean(axis=0)
    parts = np.lib.stride_tricks.sliding_window_view(centred, SEGMENT, axis=0)[:: SEGMENT // 2]
    spectrum = np.abs(np.fft.rfft(parts * window, axis=-1)) ** 2
    power = 2.0 * spectrum.sum(axis=1).mean(axis=0) / (SEGMENT * np.sum(window**2))
    return np.asarray(10.0 * np.log10(np.maximum(power[1 : len(LINES) + 1], 1e-300) / _ZERO_LEVEL**2))
