"""One run of the study, and what is measured of its signal."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Annotated as A

import numpy as np
from scipy import stats
from scipy.signal import butter, sosfiltfilt

from beardyn_core.base.arrays import Float, Int
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.monitor.chain.inputs import MonitorSettings, Stretch
from beardyn_core.monitor.chain.kurtogram import by_kurtogram
from beardyn_core.physics.bodies.layout import SIGNAL_CHANNELS, SIGNAL_FORCE
from beardyn_core.physics.tiers.status import describe
from beardyn_core.rail.build import load_history
from beardyn_core.scene.sensor import RATES
from beardyn_core.twin import Twin
from evidence.impact.cases import Case

SPANS_KHZ = ((0.0, 2.0), (2.0, 5.0), (5.0, 10.0), (10.0, 20.0))
RINGING = (5000.0, 16_000.0)  # where race faults of real axleboxes ring mostly, [Hz]
SETTLED = 0.1  # first part of a run that is not looked at, [s]
STRIKES = 20  # at least, of a cup spall in a run
CAGE_TURNS = 8  # at least, with a spall elsewhere
RATE = RATES[1]
STEP_RATE = 8 * int(RATES[0])  # of all cases but one
VERTICAL = 2
BESIDE = 0.3  # lines of the background lie within this part of a fault line's frequency
FAULTS = {"cup": ("bpfo", 1), "cone": ("bpfi", 1), "roller": ("bsf", 2)}


@dataclass(frozen=True, eq=False)
class Run:
    """Signals of one run after it has settled."""

    case: Case
    signal: A[Float, "vertical acceleration of the sensor at 51.2 kHz, without its mean, [m/s^2]"]
    shaft_angle: A[Float, "at the same times, [rad]"]
    motion: A[Float, "vertical acceleration of the sensor's seat at every step, [m/s^2]"]
    force: A[Float, "vertical force of the rollers on the cup at every step, [N]"]
    orbit: A[Float, "shape [step, roller], azimuth of the rollers of the spalled row, [rad]"]
    status: str


@lru_cache(maxsize=4)
def run(case: Case) -> Run:
    """Run a case; the last few are kept."""
    scene = case.scene()
    orders = fault_frequencies(scene.bearing)
    rate = scene.operation.speed / (2.0 * math.pi)  # type: ignore[union-attr]
    # a spall of a roller or the cone passes the load zone once a turn of the cage or the shaft
    least = STRIKES / orders.bpfo if case.on == "cup" else CAGE_TURNS / orders.ftf
    blocks = math.ceil((SETTLED + max(0.5, least / rate)) / 0.02)
    twin = Twin(scene)
    twin.start(load_history(scene.operation, scene.mounting, 0.02 * blocks, scene.seed))
    signal, motion, force, orbit, times, status = [], [], [], [], [], 0
    speed = 2.0 * math.pi * rate
    for _ in range(blocks):
        block = twin.advance()
        status |= int(block.status)
        orbit.append(block.roller_angle[:, 0])
        times.append(block.trend_time_ns)
        if block.start_ns < SETTLED * 1e9 - 1.0:
            continue
        signal.append(block.vibration[0].acceleration[:, VERTICAL])
        steps = twin.step_signals
        motion.append(steps[:, SIGNAL_CHANNELS + VERTICAL].copy())
        force.append(steps[:, SIGNAL_FORCE + VERTICAL].copy())
    received = np.concatenate(signal)
    angle = np.asarray(speed * np.arange(len(received)) / RATE, np.float64)
    moved = np.concatenate(motion)
    azimuths = _azimuths(np.concatenate(orbit), np.concatenate(times), len(moved), case.steps * int(RATES[0]))
    return Run(
        case, received - received.mean(), angle, moved,
        np.concatenate(force), azimuths, describe(status),
    )  # fmt: skip


def _azimuths(angles: Float, times_ns: Int, count: int, rate: int) -> Float:
    """Take azimuths of rollers [trend, roller] to steps; after the last known one they stand still."""
    wanted = 1e9 * (SETTLED + (np.arange(count) + 1.0) / rate)
    turned = np.unwrap(angles, axis=0)
    return np.stack([np.interp(wanted, times_ns, each) for each in turned.T], axis=1)


@dataclass(frozen=True)
class Measurement:
    """What is measured of the vertical acceleration of the sensor in one run."""

    peak: A[float, "largest, median over tenths of the run, [m/s^2]"]
    levels: A[tuple[float, ...], "rms in `SPANS_KHZ`, [m/s^2]"]
    kurtosis: A[float, "3 for Gaussian noise"]
    ringing: A[float, "kurtosis in the band `RINGING`"]
    ringing_rms: A[float, "rms in the band `RINGING`, [m/s^2]"]
    band: A[tuple[float, float], "what the shipped kurtogram chooses, [Hz]"]
    stands_out: A[bool, "the kurtogram found a band, and did not fall back on its default"]
    line: A[float, "fault line in the spectrum of the squared envelope over its background there, [dB]"]
    raw: A[float, "the same line in the spectrum of the signal itself, [dB]"]
    status: str

    @property
    def rms(self) -> float:
        """Root mean square of all bands, [m/s^2]."""
        return math.sqrt(sum(level**2 for level in self.levels))

    @property
    def shares(self) -> tuple[float, ...]:
        """Part of the power in each of `SPANS_KHZ`."""
        return tuple((level / self.rms) ** 2 for level in self.levels)


@cache
def received(case: Case) -> Measurement:
    """Measure one run."""
    made = run(case)
    signal = made.signal
    power = np.abs(np.fft.rfft(signal)) ** 2 * 2.0 / len(signal) ** 2
    frequency = np.fft.rfftfreq(len(signal), 1.0 / RATE)
    levels = tuple(
        math.sqrt(float(power[(frequency >= 1e3 * low) & (frequency < 1e3 * high)].sum()))
        for low, high in SPANS_KHZ
    )
    stretch = Stretch(RATE, signal[:, None], made.shaft_angle, case.load, 0)
    chosen = by_kurtogram(stretch, MonitorSettings())
    rings = passed(signal, RINGING)
    envelope = stretch.squared_envelope((chosen.low, chosen.high))[stretch.inner]
    name, times = FAULTS[case.on]
    order = times * getattr(fault_frequencies(case.scene().bearing), name)
    fault = order * stretch.shaft_frequency
    return Measurement(
        float(np.median([np.abs(part).max() for part in np.array_split(signal, 10)])), levels,
        float(stats.kurtosis(signal) + 3.0), float(stats.kurtosis(rings) + 3.0), float(rings.std()),
        (chosen.low, chosen.high), math.isfinite(chosen.kurtosis), over_noise(envelope, fault),
        over_noise(signal, fault), made.status,
    )  # fmt: skip


@dataclass(frozen=True)
class Loudness:
    """Levels of one spall, geometric means over several speeds, and what they grow with."""

    peak: A[float, "[m/s^2]"]
    rms: A[float, "[m/s^2]"]
    ringing: A[float, "rms in the band `RINGING`, [m/s^2]"]
    kurtosis: A[float, "the smallest of all speeds, 3 for Gaussian noise"]
    with_speed: A[float, "power of the speed with which the peak grows"]


def loudness(cases: Sequence[Case]) -> Loudness:
    """Take the levels of cases that differ by their speed."""
    found = [received(case) for case in cases]

    def mean(values: list[float]) -> float:
        return float(np.exp(np.mean(np.log(values))))

    peaks = [each.peak for each in found]
    return Loudness(
        mean(peaks), mean([each.rms for each in found]), mean([each.ringing_rms for each in found]),
        min(each.kurtosis for each in found),
        float(np.polyfit(np.log([case.speed for case in cases]), np.log(peaks), 1)[0]),
    )  # fmt: skip


def passed(signal: Float, band: tuple[float, float], rate: float = RATE) -> Float:
    """Pass a band [Hz] of a signal, without delay."""
    return np.asarray(sosfiltfilt(butter(4, band, "bandpass", fs=rate, output="sos"), signal))


def over_noise(signal: Float, line: float) -> float:
    """Work out how far the largest line within 1 % of a frequency [Hz] is above those around it, [dB]."""
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal)))) ** 2
    frequency = np.fft.rfftfreq(len(signal), 1.0 / RATE)
    off = np.abs(frequency - line)
    spacing = frequency[1]
    near = off <= max(0.01 * line, 1.5 * spacing)
    around = (off <= BESIDE * line) & (off > max(0.05 * line, 3.0 * spacing))
    return 10.0 * math.log10(float(spectrum[near].max() / np.median(spectrum[around])))
