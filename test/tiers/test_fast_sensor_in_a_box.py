"""A sensor at 51.2 kHz in a box with modes to 20 kHz: the step resolves them, the sensor measures them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.choice.usual_step import STEPS_PER_TURN, refine_for_outputs
from beardyn_core.effects import ModalStructure
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
from beardyn_core.physics.tiers.friction_steps import StepChoice
from beardyn_core.physics.tiers.tier_bending import step_body
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import PASSBAND, RATES, Accelerometer
from beardyn_core.structure.modes import Modes
from beardyn_core.structure.mounted_box import modes_of_effects, mounting_of
from test.runs import blocks_of
from test.tiers.runs import scene_of

TIERS = ("full", "quasistatic", "lumped")
RECEPTION = PASSBAND * RATES[1]  # [Hz]
HIGHER = 20_000.0 / 12_773.0  # brings the highest free mode of the shipped box to 20 kHz


def modes_of(scene: Scene) -> Modes:
    modes = modes_of_effects(scene.effects)
    assert modes is not None
    return modes


def ringing(tier: str, highest: float | None = None) -> Scene:
    """A spall in a box with modes to 20 kHz, or fewer, under a sensor of the faster rate."""
    scene = scene_of("cup_spall", tier)
    box = ModalStructure("high_speed", highest=highest, stiffness_factor=HIGHER**2)
    scene = replace(scene, effects=replace(scene.effects, structure=box))
    sensor = replace(Accelerometer(), position=(0.0, 0.0, 0.17), rate=RATES[1], noise_density=0.0)
    scene = replace(scene, sensors=(sensor,))
    steps = refine_for_outputs(StepChoice(1, "coarsest"), scene).steps_per_sample
    mounting = mounting_of(modes_of(scene), replace(scene.mounting, cup="suspended"), scene.bearing)
    numerics = replace(scene.numerics, steps_per_sample=steps)
    return replace(scene, mounting=mounting, numerics=numerics)


@pytest.mark.parametrize("tier", TIERS)
def test_the_steps_of_a_fast_sensor_resolve_all_that_it_measures(tier: str) -> None:
    scene = ringing(tier)
    modes = modes_of(scene)
    assert modes.frequency[: modes.free_count].max() == pytest.approx(20_000.0, rel=1e-4)
    assert scene.numerics.steps_per_sample * WAVEFORM_RATE > STEPS_PER_TURN * RECEPTION
    if tier == "full":
        return
    fitted = step_body(scene, 1.0 / (scene.numerics.steps_per_sample * WAVEFORM_RATE))
    assert fitted is not None
    kept = fitted.body.rate[: modes.free_count] / (2.0 * np.pi)
    assert kept == pytest.approx(modes.frequency[: modes.free_count])


@pytest.mark.slow
@pytest.mark.parametrize("tier", TIERS)
def test_a_fast_sensor_measures_the_modes_above_12_8_kHz(tier: str) -> None:
    """Against the same run with these modes condensed, which then ring elsewhere: 3 dB or more (found).

    With all free modes and other residual ones it was within 0.04 dB.
    """
    level = {}
    for highest in (None, 12_800.0 / HIGHER):  # modes are left out before they are made stiffer
        blocks = blocks_of(ringing(tier, highest), 0.16)
        signal = np.concatenate([block.vibration[0].acceleration[:, 2] for block in blocks])[4096:]
        assert np.isfinite(signal).all()
        power = np.abs(np.fft.rfft(signal * np.hanning(len(signal)))) ** 2
        line = np.fft.rfftfreq(len(signal), 1.0 / RATES[1])
        bands = ((200.0, 8_000.0), (13_000.0, 20_000.0))
        level[highest] = [10.0 * np.log10(power[(line > low) & (line < high)].sum()) for low, high in bands]
    (low, high), (low_without, high_without) = level.values()
    assert low == pytest.approx(low_without, abs=1.0)
    assert high > high_without + 2.0
