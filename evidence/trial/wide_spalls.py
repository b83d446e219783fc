"""Wide spalls of the cone, which look like strikes of the wheel: ``python -m evidence.trial.wide_spalls``.

Spalls of the trial `default` on a round wheel, each as wide as told: how much of the way between two rollers
on the cone that is, how many of the wheel's sectors are taken for strikes, what the monitor says of the whole
run, and the harmonics of BPFI in the chain's spectrum when no sector is left out. Entry and exit that strike
alike would cancel where width times harmonic over that way is a half and a whole number.
"""

from __future__ import annotations

import math
import sys
from dataclasses import replace

import numpy as np

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_trial
from beardyn_core.choice.trial import trial_scene, with_choices
from beardyn_core.monitor.chain import REFERENCE, MonitorSettings, Stretch
from beardyn_core.monitor.chain.wheel import SECTORS, struck_sectors
from beardyn_core.monitor.chain.whitening import by_cepstrum, whole_band
from beardyn_core.monitor.features import line_at, order_spectrum, resample_by_angle
from beardyn_core.run import blocks
from beardyn_core.scene.patch import Patch, raceway_diameter
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.trial import Trial
from evidence.trial.pockets import RATE, TREND

SPEEDS = (160.0, 250.0)  # [km/h]
WIDTHS = (8e-3, 12e-3)  # [m]
HARMONICS = range(1, 6)
REACH = 0.1  # around a harmonic, [orders]


def scene_of(trial: Trial, speed: float, width: float) -> Scene:
    """Make the scene of the widest spall of the cone at a speed [km/h], as wide as told [m]."""
    cell = next(
        cell
        for cell in trial.cells()
        if (cell.fault, cell.size, cell.track, cell.wheel) == ("cone", WIDTHS[-1], "german_low", "round")
        and math.isclose(3.6 * cell.speed, speed)
    )
    scene = trial_scene(trial, cell)
    (spall,) = scene.defects
    if not isinstance(spall, Patch):
        raise TypeError(f"{cell.key}: the fault is no spall")
    length, depth = trial.spall.length_per_width * width, trial.spall.depth(width)
    return replace(scene, defects=(replace(spall, width=width, length=length, depth=depth),))


def received(scene: Scene) -> Stretch:
    """Run a scene and take the whole of it."""
    done = list(blocks(scene, scene.duration))
    turned = np.unwrap(np.concatenate([each.shaft_angle for each in done]))
    signal = np.concatenate([each.vibration[0].acceleration for each in done])
    angle = np.interp(np.arange(len(signal)) / RATE, np.arange(len(turned)) / TREND, turned)
    return Stretch(RATE, signal, angle, math.nan, 0)


def harmonics(stretch: Stretch, bpfi: float, settings: MonitorSettings) -> list[float]:
    """Measure `HARMONICS` of BPFI over the background in the spectrum of the whitened envelope, [dB]."""
    band = whole_band(stretch, settings)
    power = by_cepstrum(stretch, settings).squared_envelope((band.low, band.high))
    steps = resample_by_angle(power, stretch.shaft_angle, settings.samples_per_revolution)
    highest = (HARMONICS[-1] + 0.5) * bpfi
    spectrum = order_spectrum(steps, settings.samples_per_revolution, highest, settings.background_width)
    return [line_at(spectrum, k * bpfi, REACH)[1] for k in HARMONICS]


def main() -> int:
    """Run and print."""
    trial, settings = with_choices(load_trial("default")), MonitorSettings()
    names = " | ".join(f"{k} BPFI dB" for k in HARMONICS)
    print(f"| km/h | width mm | of the way | sectors of {SECTORS} | verdict | {names} |")
    print("|--:|--:|--:|--:|---|" + "--:|" * len(HARMONICS))
    for speed in SPEEDS:
        for width in WIDTHS:
            scene = scene_of(trial, speed, width)
            bearing = scene.bearing
            way = math.pi * raceway_diameter("cone", bearing) / bearing.roller_count
            orders, stretch = fault_frequencies(bearing), received(scene)
            verdict = REFERENCE(stretch, orders, bearing.roller_count, settings).verdict
            levels = " | ".join(f"{each:.0f}" for each in harmonics(stretch, orders.bpfi, settings))
            sectors = int(struck_sectors(stretch, settings).sum())
            size = f"{1e3 * width:g} | {width / way:.2f}"
            print(f"| {speed:g} | {size} | {sectors} | {verdict} | {levels} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
