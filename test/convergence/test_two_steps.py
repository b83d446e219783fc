"""Third octaves next to tier full at eight steps a sample: of two steps, and of tier quasistatic."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

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


def powers(name: str, tier: str, steps: int, seed: int) -> Float:
    """Of third octaves from 250 Hz to 10 kHz of a run without the noise of its sensor, [band, axis].

    Below, where no step matters, 1 s of a chaotic run is too short to tell.
    """
    scene = load_scene(name, effects="all", tier=tier)
    scene = replace(
        scene,
        seed=seed,
        sensors=tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors),
        numerics=replace(scene.numerics, steps_per_sample=steps),
    )
    received = [block.acceleration[0] for block in blocks(scene, DURATION) if block.start_ns >= SETTLED * 1e9]
    return bands(np.concatenate(received))[1][FIRST:] ** 2


def changed(name: str, tier: str, steps: int) -> tuple[Float, Float, NDArray[np.bool_]]:
    """Compare with the full tier at eight steps, each [band, axis].

    Returns the difference, the doubt of its mean over beginnings, which tell chance from the step, [dB]; and
    whether the band is louder than a sensor's noise.
    """
    mine = np.array([powers(name, tier, steps, seed) for seed in BEGINNINGS])
    fine = np.array([powers(name, "full", 8, seed) for seed in BEGINNINGS])
    difference = 10.0 * np.log10(mine / fine)
    noise = NOISE * np.sqrt(CENTRE * (10.0**0.05 - 10.0**-0.05))
    loud = np.sqrt(fine.mean(axis=0)) > noise[:, None]
    assert loud[-8:].any(axis=0).all()  # of each axis something above 2 kHz
    return difference.mean(axis=0), difference.std(axis=0, ddof=1) / np.sqrt(len(BEGINNINGS)), loud


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["smooth_run", "healthy_300", "wheel_flat", "cup_spall", "cone_spall", "roller_spall"]
)
def test_what_is_louder_than_a_sensors_noise_is_right_to_10_khz_at_two_steps(name: str) -> None:
    """Within 1.5 dB and twice the doubt."""
    difference, doubt, loud = changed(name, "full", 2)
    assert (np.abs(difference) < 1.5 + 2.0 * doubt)[loud].all()
    assert np.median(np.abs(difference)[loud]) < 0.5


@pytest.mark.slow
@pytest.mark.parametrize("steps", [2, 4])
@pytest.mark.parametrize("name", ["smooth_run", "cup_spall", "cone_spall", "roller_spall"])
def test_quasistatic_with_coupled_laminae_is_right_to_6_khz(name: str, steps: int) -> None:
    """Within 2 dB and twice the doubt, to 6.3 kHz, with exceptions.

    The resonance along the axle at 500 Hz is up to 3.1 dB too quiet (2.5 too loud with dry pockets). At two
    steps the quiet band at 2 kHz is up to 3.1 dB too quiet vertically (1.0 at sixteen), and 8 kHz, where
    short waves of a typical surface excite, up to 4.1 dB (3.0 at four). `roller_spall` is a run of lines
    without chance: the lines at 316 Hz are up to 4 dB too loud.
    """
    difference, doubt, loud = changed(name, "quasistatic", steps)
    most = np.full(difference.shape, 2.0)
    most[np.isclose(CENTRE, 500.0, rtol=0.01), 1] = 3.1
    if steps == 2:
        most[np.isclose(CENTRE, 2000.0, rtol=0.01), 2] = 3.1
    lowest = 350.0 if name == "roller_spall" else 0.0
    counted = loud & ((lowest < CENTRE) & (CENTRE < 7e3))[:, None]
    assert (np.abs(difference) < most + 2.0 * doubt)[counted].all()
    assert np.median(np.abs(difference)[counted]) < 0.4
    highest = ((CENTRE > 7e3) & (CENTRE < 9e3))[:, None] & loud
    assert (np.abs(difference) < (4.1 if steps == 2 else 3.0) + 2.0 * doubt)[highest].all()


@pytest.mark.slow
def test_a_chosen_fast_tier_is_right_along_the_axle_where_the_box_rings_on_its_bearing() -> None:
    """From 500 to 1000 Hz within 3 dB of the chosen `full`: the creep of the rollers damps that motion."""

    def levels(tier: str) -> Float:
        scene = load_scene("healthy_80", effects="auto", tier=tier)
        quiet = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
        received = [block.acceleration[0] for block in blocks(replace(scene, sensors=quiet), 2.3)]
        return 20.0 * np.log10(bands(np.concatenate(received)[7680:])[1][FIRST:, 1])

    around = (CENTRE > 480.0) & (CENTRE < 1050.0)
    assert np.abs(levels("quasistatic") - levels("full"))[around].max() < 3.0
