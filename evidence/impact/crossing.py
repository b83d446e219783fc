"""Entry and exit of the rollers over a cup spall, at every step: when, how hard, what rings afterwards."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks, hilbert

from beardyn_core.base.arrays import Float
from beardyn_core.physics.defect import surface_radius
from evidence.impact.cases import Case
from evidence.impact.study import RINGING, STEP_RATE, passed, run

Bool = NDArray[np.bool_]

BEFORE, AFTER = 1.5e-3, 6e-3  # of the crossing's middle, beyond half the width over the speed, [s]
EVENT = 1.5e-3  # an event is sought this far inside of its edge, [m]
OUTSIDE = 0.7e-3  # and this far outside
BURST = 0.1  # of the largest power: what lasts longer belongs to the burst
PULSE = 0.25  # of the largest change of the force: what stands out of the force by so much is a pulse


@dataclass(frozen=True, eq=False)
class Crossing:
    """Mean of all crossings of a run, in which the rollers pass the middle of the spall at time 0."""

    time: A[Float, "[s]"]
    motion: A[Float, "acceleration of the sensor's seat in the crossing of median peak, [m/s^2]"]
    force: A[Float, "of the rollers on the cup in the same crossing, less its mean, [N]"]
    power: A[Float, "squared envelope in `RINGING`, mean of all crossings, [m^2/s^4]"]
    speed: A[float, "of the contact along the cup, [m/s]"]
    entry: A[float, "place of the contact when the entry is loudest, [m]"]
    exit: A[float, "and the exit"]
    louder: A[float, "peak of the acceleration at the exit over that at the entry, median"]
    sharper: A[float, "fastest change of the force at the exit over that at the entry, median"]
    pulses: A[float, "of the force at the exit, mean number"]
    jitter: A[float, "standard deviation over mean of the times from exit to exit"]
    burst: A[float, "how long the envelope stays above `BURST` of its largest value, [s]"]

    @property
    def spacing(self) -> float:
        """Way of the contact between the two events, [m]."""
        return self.exit - self.entry


@cache
def crossing(case: Case) -> Crossing:
    """Cut the crossings out of a run over a cup spall at the top of the cup."""
    made = run(case)
    radius = surface_radius(case.scene().bearing, "cup")
    begin, end = made.orbit[[0, STEP_RATE // 4], 0]
    speed = radius * float(end - begin) / (STEP_RATE // 4 / STEP_RATE)
    turns = made.orbit / (2.0 * math.pi)
    middles = np.sort(np.nonzero(np.diff(np.floor(turns), axis=0) > 0.0)[0])
    half = int(0.5 * case.width / speed * STEP_RATE)
    before, after = half + int(BEFORE * STEP_RATE), half + int(AFTER * STEP_RATE)
    period = int(np.median(np.diff(middles)))
    after = min(after, period - before)
    middles = middles[(middles > before) & (middles < len(made.motion) - after)]
    envelope = np.abs(hilbert(passed(made.motion, RINGING, STEP_RATE))) ** 2
    time = np.arange(-before, after) / STEP_RATE
    cut = middles[:, None] + np.arange(-before, after)
    motion, force, power = made.motion[cut], made.force[cut], envelope[cut]
    mean = power.mean(axis=0)
    arc, edge = speed * time, 0.5 * case.width
    inside = min(EVENT, edge)
    begins = (arc > -edge - OUTSIDE) & (arc < -edge + inside)
    ends = (arc > edge - inside) & (arc < edge + OUTSIDE)
    peak = np.abs(motion)
    change = np.abs(np.diff(force, axis=1, append=force[:, -1:]))
    middle = int(np.argsort(peak.max(axis=1))[len(peak) // 2])
    between = np.diff(middles + np.argmax(np.where(ends, power, 0.0), axis=1))
    above = np.nonzero(mean > BURST * mean.max())[0]
    return Crossing(
        time, motion[middle], force[middle] - force[middle].mean(), mean, speed,
        float(arc[begins][np.argmax(mean[begins])]), float(arc[ends][np.argmax(mean[ends])]),
        _ratio(peak, ends, begins), _ratio(change, ends, begins),
        float(np.mean([_pulses(each, ends) for each in force])),
        float(between.std() / between.mean()), float(time[above[-1]] - time[above[0]]),
    )  # fmt: skip


def _ratio(values: Float, ends: Bool, begins: Bool) -> float:
    return float(np.median(values[:, ends].max(axis=1) / values[:, begins].max(axis=1)))


def _pulses(force: Float, ends: Bool) -> int:
    swing = float(np.abs(force - np.median(force)).max())
    return len(find_peaks(force[ends], prominence=PULSE * swing)[0])


@dataclass(frozen=True)
class Ringing:
    """What rings down after the exit."""

    frequency: A[float, "strongest above 3 kHz, [Hz]"]
    damping: A[float, "of critical"]


def ring_down(case: Case) -> Ringing:
    """Find the strongest frequency above 3 kHz after the exit, and how fast it dies in a crossing."""
    found = crossing(case)
    begin = np.searchsorted(found.time, 0.5 * case.width / found.speed + 0.2e-3)
    tail = found.motion[begin : begin + int(5e-3 * STEP_RATE)]
    spectrum = np.abs(np.fft.rfft(tail * np.hanning(2 * len(tail))[len(tail) :], 8 * len(tail)))
    lines = np.fft.rfftfreq(8 * len(tail), 1.0 / STEP_RATE)
    spectrum[(lines < 3e3) | (lines > 16e3)] = 0.0
    frequency = float(lines[np.argmax(spectrum)])
    envelope = np.abs(hilbert(passed(found.motion, (0.92 * frequency, 1.08 * frequency), STEP_RATE)))[begin:]
    peak = int(np.argmax(envelope[: int(1e-3 * STEP_RATE)]))
    low = np.nonzero(envelope[peak:] < 0.1 * envelope[peak])[0]
    stop = peak + int(low[0]) if len(low) else len(envelope)
    slope = np.polyfit(np.arange(stop - peak) / STEP_RATE, np.log(envelope[peak:stop]), 1)[0]
    return Ringing(frequency, float(-slope / (2.0 * math.pi * frequency)))
