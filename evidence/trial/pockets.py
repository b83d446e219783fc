"""Rollers in their pockets in two tiers: ``python -m evidence.trial.pockets``.

Slip of the cages, scatter of the rollers' spacing in the load zone, torque, and the lines of the rollers'
passing over their surroundings, of healthy bearings of the trial `healthy` on a round wheel; next to no
noise. Means of some runs: from one to the next the track, and how rollers lie in their pockets, differ by
chance, and a line by up to 4 dB (one standard deviation).
"""

from __future__ import annotations

import math
import sys
import time
from dataclasses import dataclass, fields, replace
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import cage_speed_ratio, fault_frequencies
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.choice import load_trial
from beardyn_core.choice.trial import trial_scene, with_choices
from beardyn_core.run import blocks
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import Trial
from beardyn_core.study.measures import third_octave_levels

TIERS = ("full", "quasistatic")
SPEEDS = (80.0, 200.0)  # [km/h]
DURATION, SETTLED = 4.0, 0.5  # of a run, and what of it is not looked at, [s]
RUNS = 8
RATE, TREND = 25_600.0, 400.0  # [Hz]
HARMONICS = range(5, 13)  # of the roller-passing frequency, above the track's share
BESIDE, GUARD = 0.3, 0.1  # around a line, in roller-passing frequencies: surroundings, gap


@dataclass(frozen=True, eq=False)
class Moved:
    """What runs say of their rollers and cages."""

    slip: A[float, "of the cages behind rolling, mean of both rows, [-]"]
    spacing: A[float, "scatter of the way between rollers that pass the middle of the zone, [m]"]
    torque: A[float, "mean, [N m]"]
    lines: A[Float, "`HARMONICS` of the roller-passing frequency over their surroundings, [dB]"]
    levels: A[Float, "third octaves of the vertical acceleration, [dB]"]
    cost: A[float, "processor time of a simulated second, [s]"]


def scene_of(trial: Trial, tier: str, speed: float) -> Scene:
    """Make the scene of a healthy bearing at a speed [km/h]; next to no noise."""
    cell = next(
        cell
        for cell in trial.cells()
        if cell.tier == tier
        and math.isclose(3.6 * cell.speed, speed)
        and (cell.track, cell.wheel) == ("german_low", "round")
    )
    scene = trial_scene(trial, cell)
    return replace(scene, sensors=tuple(replace(each, noise_density=1e-6) for each in scene.sensors))


def spacing_of(bearing: RollerBearing, roller_angle: Float, shaft_angle: Float) -> float:
    """Measure the scatter of the way of rolling between rollers that pass the top of a row, [m].

    Parameters
    ----------
    roller_angle : array, shape [time, roller]
        [rad].
    shaft_angle : array, shape [time]
        [rad].
    """
    passed = []
    for angle in np.unwrap(roller_angle, axis=0).T:
        whole = np.arange(math.ceil(angle[0] / (2.0 * math.pi)), angle[-1] / (2.0 * math.pi))
        passed.append(np.interp(2.0 * math.pi * whole, angle, shaft_angle))
    way = np.sort(np.concatenate(passed)) * cage_speed_ratio(bearing) * 0.5 * bearing.pitch_diameter
    return float(np.diff(way).std())


def lines_of(signal: Float, line: float) -> Float:
    """Measure the `HARMONICS` of a frequency over the median of their surroundings, [dB]."""
    power = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal)))) ** 2
    frequency = np.fft.rfftfreq(len(signal), 1.0 / RATE)
    found = []
    for k in HARMONICS:
        off = np.abs(frequency - k * line)
        beside = power[(off < BESIDE * line) & (off > GUARD * line)]
        found.append(10.0 * math.log10(power[off < max(1.2, 0.004 * k * line)].max() / np.median(beside)))
    return np.array(found)


def move(scene: Scene) -> Moved:
    """Run a scene."""
    began = time.process_time()
    done = list(blocks(scene, DURATION))
    cost = (time.process_time() - began) / DURATION
    first = round(SETTLED * TREND)
    shaft = np.concatenate([each.shaft_angle for each in done])[first:]
    cages = np.concatenate([each.cage_angle for each in done])[first:]
    rollers = np.concatenate([each.roller_angle for each in done])[first:]
    torque = np.concatenate([each.shaft_torque for each in done])[first:]
    signal = np.concatenate([each.vibration[0].acceleration[:, 2] for each in done])[round(SETTLED * RATE) :]
    turned = float(shaft[-1] - shaft[0])
    ratio = (cages[-1] - cages[0]).mean() / turned / cage_speed_ratio(scene.bearing)
    line = fault_frequencies(scene.bearing).bpfo * turned / (2.0 * math.pi) / ((len(shaft) - 1) / TREND)
    return Moved(
        slip=float(1.0 - ratio),
        spacing=float(np.mean([spacing_of(scene.bearing, rollers[:, row], shaft) for row in range(2)])),
        torque=float(torque.mean()),
        lines=lines_of(signal, line),
        levels=third_octave_levels(signal[:, None]),
        cost=cost,
    )


def move_often(scene: Scene) -> Moved:
    """Run a scene `RUNS` times, with seeds that follow each other, and take means."""
    found = [move(replace(scene, seed=scene.seed + k)) for k in range(RUNS)]
    return Moved(**{each.name: np.mean([getattr(one, each.name) for one in found], axis=0)
                    for each in fields(Moved)})  # fmt: skip


def main() -> int:
    """Run and print."""
    trial = with_choices(load_trial("healthy"))
    names = " | ".join(f"{k} BPFO" for k in HARMONICS)
    print(f"| km/h | tier | slip % | spacing um | torque N m | {names} |")
    print("|--:|---|" + "--:|" * (3 + len(HARMONICS)))
    for speed in SPEEDS:
        for tier in TIERS:
            found = move_often(scene_of(trial, tier, speed))
            lines = " | ".join(f"{level:.0f}" for level in found.lines)
            print(
                f"| {speed:g} | {tier} | {100.0 * found.slip:.2f} | {1e6 * found.spacing:.0f} "
                f"| {found.torque:.2f} | {lines} |",
                flush=True,
            )
    return 0


if __name__ == "__main__":
    sys.exit(main())
