"""Boxes that bend in every tier: ``python -m evidence.structure.tiers``, one process of the engine at a time.

Deflection and largest roller load under 80 kN, processor time of a step, and third octaves and kurtosis of
`cup_spall` against tier full with the same box.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace

import numpy as np
from scipy.stats import kurtosis

from beardyn_core.effects import ModalStructure, RingStructure
from beardyn_core.experiments.loop import all_of
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of
from beardyn_core.study.measures import BAND_CENTRES, third_octave_levels
from evidence.standard import standard_scene

KINDS = {"rigid": None, "rings": RingStructure(), "modes": ModalStructure("high_speed")}
STEPS = {"full": 4.0, "quasistatic": 1.0, "lumped": 1.0}
BANDS_HZ = (400, 800, 1250, 2000, 3150, 5000, 6300, 8000)


def scene_of(name: str, tier: str, kind: str) -> Scene:
    """Make a shipped scene in a tier with a box of a kind; next to no noise."""
    scene = standard_scene(name, tier=tier)
    effects = replace(scene.effects, structure=KINDS[kind])
    modes, mounting = modes_of_effects(effects), scene.mounting
    if modes is not None:
        mounting = mounting_of(modes, mounting, scene.bearing)
    sensors = tuple(replace(each, noise_density=1e-6) for each in scene.sensors)
    numerics = replace(scene.numerics, steps_per_sample=STEPS[tier])
    return replace(scene, effects=effects, mounting=mounting, sensors=sensors, numerics=numerics)


def carried(scene: Scene) -> tuple[float, float, float]:
    """Measure mean deflection [m], mean of the largest cup load [N], and processor time of a step [s]."""
    run = start(scene, 0.4)
    places, loads, spent = [], [], []
    for block in run.blocks():
        places.append(block.body_pose[:, 1, 2] - block.body_pose[:, 0, 2])
        loads.append(np.linalg.norm(block.contacts[..., 0, 3:6], axis=-1).max(axis=(1, 2)))
        spent.append(block.wall_s)
    half = len(places) // 2
    steps = 0.02 * 25_600 * scene.numerics.steps_per_sample
    return (
        float(np.concatenate(places[half:]).mean()),
        float(np.concatenate(loads[half:]).mean()),
        float(np.median(spent[half:])) / steps,
    )


def received(scene: Scene) -> tuple[np.ndarray, float]:
    """Compute third octaves [dB] of the vertical acceleration over 1.1 s, and its kurtosis."""
    began = [block.vibration[0].acceleration[:, 2] for block in start(scene, 1.2).blocks()]
    signal = np.concatenate(began)[2560:]
    return third_octave_levels(signal[:, None]), float(kurtosis(signal, fisher=False))


def main() -> int:
    """Run and print both tables."""
    begin = time.monotonic()
    print("| tier | box | deflection um | largest load N | step us |\n|---|---|--:|--:|--:|")
    cases = [(tier, kind) for tier in STEPS for kind in KINDS]
    bearing = all_of(carried, [scene_of("static_80kN", *case) for case in cases])  # its steps are timed
    for (tier, kind), (deflection, load, step) in zip(cases, bearing, strict=True):
        print(f"| {tier} | {kind} | {1e6 * deflection:.2f} | {load:.0f} | {1e6 * step:.2f} |", flush=True)
    names = [int(np.argmin(np.abs(BAND_CENTRES - band))) for band in BANDS_HZ]
    print(f"\n| against full, dB at Hz | {' | '.join(map(str, BANDS_HZ))} | kurtosis (full) |")
    print("|---|" + "--:|" * (len(BANDS_HZ) + 1))
    spalled = [(tier, kind) for kind in ("rigid", "modes") for tier in STEPS]
    sound = dict(
        zip(spalled, all_of(received, [scene_of("cup_spall", *each) for each in spalled]), strict=True)
    )
    for kind in ("rigid", "modes"):
        whole, pulses = sound["full", kind]
        for tier in ("quasistatic", "lumped"):
            levels, sharp = sound[tier, kind]
            row = " | ".join(f"{levels[i] - whole[i]:+.1f}" for i in names)
            print(f"| {tier}, {kind} | {row} | {sharp:.1f} ({pulses:.1f}) |", flush=True)
    print(f"\n{time.monotonic() - begin:.0f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
