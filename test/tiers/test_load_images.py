"""A healthy run on a track has no lines at the multiples of the rate at which its load is sampled."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import welch

from beardyn_core.run import blocks
from beardyn_core.scene.operation import Irregularity, QuarterVehicleOperation
from test.scenes import rigid_scene

SAMPLE_RATE = 2000.0
SETTLED_S = 0.3


@pytest.mark.parametrize(
    ("tier", "multiples", "duration"),
    [
        ("lumped", 3, 3.0),  # with long steps its waveforms end at 6.4 kHz
        ("quasistatic", 5, 3.0),
        pytest.param("full", 5, 1.5, marks=pytest.mark.slow),
    ],
)
def test_a_healthy_run_without_noise_has_no_lines_at_the_rate_of_its_load(
    tier: str, multiples: int, duration: float
) -> None:
    """Straight lines between the samples raise the first five by 18 to 29 dB, single lines by 27 to 39 dB.

    Of rollers by the drawing: waves of rollers as made have lines of their own, which would hide some.
    """
    scene = rigid_scene("healthy_80", tier=tier, duration_s=duration)
    assert isinstance(scene.operation, QuarterVehicleOperation)
    rail = Irregularity("fra_4", shortest_wavelength=0.1, short_waves="none")  # a load at 2 kHz
    scene = replace(scene, operation=replace(scene.operation, irregularity=rail))
    silent = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    readings = [block.vibration[0] for block in blocks(replace(scene, sensors=silent, scatter=None))]
    vertical = np.concatenate([reading.acceleration[:, 2] for reading in readings])
    rate = readings[0].rate
    frequency, density = welch(vertical[round(SETTLED_S * rate) :], rate, nperseg=8192)
    level = 10.0 * np.log10(density)
    for multiple in range(1, multiples + 1):
        off = np.abs(frequency - multiple * SAMPLE_RATE)
        beside = np.median(level[(off > 200.0) & (off < 600.0)])
        assert np.median(level[off < 40.0]) - beside < 3.0, multiple
        # of some seventy places and twenty averages
        assert level[off < 110.0].max() - beside < 7.0, multiple
