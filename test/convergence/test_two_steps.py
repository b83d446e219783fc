"""Two steps a sample of tier full next to eight, where rings bend: third octaves to 10 kHz."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.physics.tiers.step_choice import USUAL_NOISE
from beardyn_core.run import blocks
from test.convergence.test_fast_step import bands
from test.tiers.runs import Float

SETTLED, DURATION = 0.2, 1.24
BEGINNINGS = (1, 2, 3)
FIRST = 4
CENTRE = 1000.0 * 10.0 ** (np.arange(-10, 11) / 10.0)[FIRST:]
NOISE = USUAL_NOISE


def powers(name: str, steps: int, seed: int) -> Float:
    """Of third octaves from 250 Hz to 10 kHz of a run without the noise of its sensor, [band, axis].

    Below, where no step matters, 1 s of a chaotic run is too short to tell.
    """
    scene = load_scene(name, effects="full", tier="full")
    scene = replace(
        scene,
        seed=seed,
        sensors=tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors),
        numerics=replace(scene.numerics, steps_per_sample=steps),
    )
    heard = [block.acceleration[0] for block in blocks(scene, DURATION) if block.start_ns >= SETTLED * 1e9]
    return bands(np.concatenate(heard))[1][FIRST:] ** 2


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["smooth_run", "healthy_300", "wheel_flat", "cup_spall", "cone_spall", "roller_spall"]
)
def test_what_is_louder_than_a_sensors_noise_is_right_to_10_khz_at_two_steps(name: str) -> None:
    """Within 1.5 dB and twice the doubt of the mean over beginnings, which tell chance from the step."""
    two, eight = (np.array([powers(name, steps, seed) for seed in BEGINNINGS]) for steps in (2, 8))
    difference = 10.0 * np.log10(two / eight)
    doubt = difference.std(axis=0, ddof=1) / np.sqrt(len(BEGINNINGS))
    noise = NOISE * np.sqrt(CENTRE * (10.0**0.05 - 10.0**-0.05))
    loud = np.sqrt(eight.mean(axis=0)) > noise[:, None]
    assert loud[-8:].any(axis=0).all()  # of each axis something above 2 kHz
    assert (np.abs(difference.mean(axis=0)) < 1.5 + 2.0 * doubt)[loud].all()
    assert np.median(np.abs(difference.mean(axis=0))[loud]) < 0.5
