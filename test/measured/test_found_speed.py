"""The speed of the shaft is found in the vibration itself, or refused."""

from typing import Any

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.measured.found_speed import PIECE_S
from beardyn_core.monitor.speed import speed_from_vibration

PLATE = bd.name_plate("6205")
RATE = 12_000.0


def _vibration(speed, seconds=4.0, seed=1, fault=True):
    """Whole orders of a shaft and a spalled cup in noise; speed [Hz] at the begin and at the end."""
    random = np.random.default_rng(seed)
    time = np.arange(int(seconds * RATE)) / RATE
    turned = speed[0] * time + 0.5 * (speed[1] - speed[0]) * time**2 / seconds
    signal = random.normal(size=len(time))
    for order in (1, 2, 3, 5, 6):
        signal += 0.5 * np.sin(2 * np.pi * order * turned + random.uniform(0, 6))
    if fault:
        strikes = np.diff(np.floor(turned * PLATE.frequencies.bpfo * 0.995), prepend=0.0)
        decay = np.arange(200) / RATE
        signal += np.convolve(strikes, 12.0 * np.exp(-900 * decay) * np.sin(2 * np.pi * 3500 * decay))[
            : len(time)
        ]
    return time, signal, turned, speed[0] + (speed[1] - speed[0]) * time / seconds


@pytest.mark.parametrize("speed", [pytest.param((29.2, 29.2), marks=pytest.mark.slow), (25.0, 29.0)])
def test_speed_is_found_within_its_interval(speed):
    time, signal, turned, true = _vibration(speed)
    track = speed_from_vibration(signal, RATE, 22.0, 36.0, (PLATE.frequencies,))
    assert track.certain, track.reason
    low, high = track.interval
    at = np.interp(track.time, time, true)
    assert ((low < at) & (at < high)).all()
    inner = (time > track.time[0]) & (time < track.time[-1])
    found = track.angle(time[inner]) / (2 * np.pi)
    assert np.ptp(found - turned[inner]) < 0.01 * np.ptp(turned)
    assert (np.diff(found) > 0.0).all()


def test_noise_and_too_wide_a_range_are_not_certain():
    noise = np.random.default_rng(2).normal(size=(24_000, 1))
    track = speed_from_vibration(noise, RATE, 24.0, 36.0, (PLATE.frequencies,))
    assert not track.certain
    assert "too few lines" in track.reason or "several speeds" in track.reason
    assert "too wide" in speed_from_vibration(noise, RATE, 10.0, 36.0).reason
    assert "too short" in speed_from_vibration(noise[:500], RATE, 24.0, 36.0).reason


def test_a_file_without_speed_is_monitored_by_its_own_lines(tmp_path):
    assert PIECE_S > 4.0
    _, signal, _, _ = _vibration((28.0, 29.5), seed=3)
    np.savetxt(tmp_path / "motor.csv", signal, fmt="%.5f")
    options: dict[str, Any] = {"unit": "m/s2", "rate_Hz": RATE, "speed_range_rpm": "1500:2000"}
    run = bd.read_measured(tmp_path / "motor.csv", bearing=PLATE, **options)
    assert run.measured["speed"]["from"] == "vibration"
    assert any("by the vibration the shaft turns" in told for told in run.measured["understood"])
    assert bd.monitor(run).verdict == "cup"


def test_speed_is_refused_without_a_bearing_or_without_lines(tmp_path):
    np.savetxt(tmp_path / "noise.csv", np.random.default_rng(4).normal(size=24_000), fmt="%.5f")
    options: dict[str, Any] = {"unit": "m/s2", "rate_Hz": RATE}
    with pytest.raises(InputError, match="needs the bearing"):
        bd.read_measured(tmp_path / "noise.csv", speed_range_rpm="1500:2000", **options)
    with pytest.raises(InputError, match=r"noise\.csv: the speed of the shaft is not known, and from 0 s on"):
        bd.read_measured(tmp_path / "noise.csv", bearing=PLATE, speed_range_rpm="1500:2000", **options)
    with pytest.raises(InputError, match="must be LOW:HIGH"):
        bd.read_measured(tmp_path / "noise.csv", bearing=PLATE, speed_range_rpm="1000:2500", **options)
