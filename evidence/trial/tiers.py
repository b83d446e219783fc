"""A spall in service in two tiers, and what it has to stand out of: ``python -m evidence.trial.tiers``.

Third octaves of a healthy bearing, of the difference in power that a spall of 4 mm on the cup makes, and line
and noise of the squared envelope in three bands, on a round wheel with the background of the trial `default`.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass, replace
from typing import Annotated as A

import numpy as np
from scipy.signal import butter, sosfiltfilt

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_trial
from beardyn_core.choice.trial import trial_scene
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import HEALTHY, Trial
from beardyn_core.study.measures import BAND_CENTRES, third_octave_levels

TRACK = "german_high"
TIERS = ("full", "quasistatic")
SPEEDS = (80.0, 160.0)  # [km/h]
WIDTH = 4e-3  # [m]
DURATION, SETTLED = 2.2, 0.2  # of a run, and what of it is not looked at, [s]
BANDS_HZ = (800, 1600, 2500, 4000, 6300, 8000, 10_000)
ENVELOPES = ((1600.0, 3200.0), (3200.0, 6400.0), (6400.0, 11_000.0))  # [Hz]
RATE = 25_600.0
BESIDE, LINE, GUARD = 0.3, 0.01, 0.05  # of the frequency of a line: noise around it, line itself, gap


@dataclass(frozen=True, eq=False)
class Measurement:
    """What is measured of the vertical reading of a run."""

    levels: A[Float, "third octaves, [dB]"]
    lines: A[tuple[float, ...], "of BPFO in the squared envelope of `ENVELOPES`, [dB]"]
    noises: A[tuple[float, ...], "median around these lines, [dB]"]


def of_trial() -> Trial:
    """Load the trial with the standard effects, in the box that rings."""
    structure = {"kind": "modes", "table": "high_speed"}
    effects = {"preset": "standard", "structure": structure}
    return replace(load_trial("default"), effects=effects, tracks=(TRACK,), surfaces=())


def scene_of(trial: Trial, tier: str, speed: float, spalled: bool) -> Scene:
    """Make the scene of a run at a speed [km/h]."""
    wanted = ("cup", WIDTH) if spalled else (HEALTHY, 0.0)
    cell = next(
        cell
        for cell in trial.cells()
        if cell.fault == wanted[0]
        and math.isclose(cell.size, wanted[1], abs_tol=1e-9)
        and math.isclose(3.6 * cell.speed, speed)
        and (cell.track, cell.wheel) == (TRACK, "round")
    )
    return trial_scene(trial, replace(cell, tier=tier, checks=False))


def receive(scene: Scene, speed: float) -> Measurement:
    """Run a scene at a speed [km/h]."""
    parts = [block.vibration[0].acceleration[:, 2] for block in blocks(scene, DURATION)]
    signal = np.concatenate(parts)[int(SETTLED * RATE) :]
    radius = 0.5 * scene.operation.wheel_diameter  # type: ignore[union-attr]
    line = fault_frequencies(scene.bearing).bpfo * speed / 3.6 / radius / (2.0 * math.pi)
    lines, noises = [], []
    for band in ENVELOPES:
        envelope = sosfiltfilt(butter(4, band, "bandpass", fs=RATE, output="sos"), signal) ** 2
        spectrum = np.abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(len(envelope)))) ** 2
        off = np.abs(np.fft.rfftfreq(len(envelope), 1.0 / RATE) - line) / line
        spectrum /= len(envelope) ** 2
        lines.append(10.0 * math.log10(spectrum[off < LINE].max()))
        noises.append(10.0 * math.log10(np.median(spectrum[(off < BESIDE) & (off > GUARD)])))
    return Measurement(third_octave_levels(signal[:, None]), tuple(lines), tuple(noises))


def added(spalled: Float, sound: Float) -> Float:
    """Take the power of a healthy bearing off that of a spalled one, [dB]; NaN where nothing is left."""
    more = 10.0 ** (0.1 * spalled) - 10.0 ** (0.1 * sound)
    return np.asarray(10.0 * np.log10(np.where(more > 0.0, more, np.nan)))


def main() -> int:
    """Run and print."""
    trial = of_trial()
    at = [int(np.argmin(np.abs(BAND_CENTRES - band))) for band in BANDS_HZ]
    print(f"| km/h | {' - '.join(reversed(TIERS))}, dB at Hz | {' | '.join(map(str, BANDS_HZ))} |")
    print(f"|--:|---|{'--:|' * len(at)}")
    for speed in SPEEDS:
        sound, spalled = (
            [receive(scene_of(trial, tier, speed, there), speed) for tier in TIERS] for there in (False, True)
        )
        alone = [added(one.levels, other.levels) for one, other in zip(spalled, sound, strict=True)]
        rows = {
            "sound": sound[1].levels - sound[0].levels,
            "spalled": spalled[1].levels - spalled[0].levels,
            "what the spall adds": alone[1] - alone[0],
        }
        for name, row in rows.items():
            print(f"| {speed:g} | {name} | {' | '.join(f'{row[i]:+.1f}' for i in at)} |", flush=True)
        for tier, received in zip(TIERS, spalled, strict=True):
            cells = zip(ENVELOPES, received.lines, received.noises, strict=True)
            texts = [
                f"{1e-3 * a:g}-{1e-3 * b:g} kHz {line:.0f} / {noise:.0f}" for (a, b), line, noise in cells
            ]
            print(f"{speed:g} km/h, {tier}, line / noise dB: {', '.join(texts)}", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
