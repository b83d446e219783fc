"""A spalled roller strikes at twice its spin against the cage: that of pure rolling, in every tier."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.signal import butter, hilbert, sosfiltfilt

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.run import start
from test.arrays import first_axis

SETTLED_S = 0.3
BAND = (700.0, 2500.0)
FINE = 2**21  # places of the padded spectrum: 0.01 Hz at 25.6 kHz


def strongest_order(vertical: Float, rate: float, shaft_speed: float, low: float, high: float) -> float:
    """Strongest line of the squared envelope between two orders of the shaft."""
    envelope = np.abs(hilbert(sosfiltfilt(butter(4, BAND, "bandpass", fs=rate, output="sos"), vertical))) ** 2
    spectrum = np.abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(len(envelope)), FINE))
    order = np.fft.rfftfreq(FINE, 1.0 / rate) * 2.0 * np.pi / shaft_speed
    inside = (order > low) & (order < high)
    return float(order[inside][spectrum[inside].argmax()])


@pytest.mark.parametrize("tier", ["lumped", "quasistatic", pytest.param("full", marks=pytest.mark.slow)])
def test_a_spalled_roller_strikes_at_twice_the_spin_of_pure_rolling(tier: str) -> None:
    """It spins so wherever it is loaded; drag slows it where it is not, but in the lumped tier.

    The line lies at twice the spin of the truth over whole turns of the cage.
    """
    scene = load_scene("roller_spall", tier=tier, duration=1.5)
    silent = tuple(replace(sensor, noise_density=0.0) for sensor in scene.sensors)
    run = start(replace(scene, sensors=silent))
    roller = run.twin.body_names.index("roller_0_0")
    orders = fault_frequencies(scene.bearing)
    readings, spins, loads = [], [], []
    for block in run.blocks():
        readings.append(block.vibration[0])
        if block.start_ns * 1e-9 >= SETTLED_S:
            # on its own axis, against the cage; trends are twice as dense as snapshots
            cage = block.cage_speed[1::2, 0]
            pose, twist = block.body_pose[:, roller], block.body_twist[:, roller]
            axis = first_axis(pose[:, 3:])
            spins.append(np.abs(np.sum(twist[:, 3:] * axis, axis=1) - cage * axis[:, 1]))
            loads.append(np.linalg.norm(block.contacts[:, 0, 0, 0, 3:6], axis=1))
    shaft_speed = float(np.mean(block.shaft_speed))
    spin, load = np.concatenate(spins) / shaft_speed / orders.bsf, np.concatenate(loads)
    # a roller whose traction is limited slips a little more than one on films
    most, mean = (1e-2, 3e-3) if tier == "quasistatic" else (5e-3, 1e-3)
    assert np.allclose(spin[load > 2e3], 1.0, rtol=0.0, atol=most)
    assert spin[load > 2e3].mean() == pytest.approx(1.0, abs=mean)
    assert spin.mean() == pytest.approx(1.0, abs=1e-9 if tier == "lumped" else 5e-3)
    vertical = np.concatenate([each.acceleration[:, 2] for each in readings])
    settled = vertical[round(SETTLED_S * readings[0].rate) :]
    found = strongest_order(settled, readings[0].rate, shaft_speed, 6.5, 7.1)
    assert found == pytest.approx(2.0 * orders.bsf * spin.mean(), rel=1e-3)
