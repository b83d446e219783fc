"""A monitor of vibration, shaft and load alone finds spalls, and stays quiet on a healthy bearing."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.signal import butter, hilbert, sosfiltfilt

from beardyn_core.bearing.kinematics import FaultFrequencies, fault_frequencies
from beardyn_core.choice import load_scene, load_trial
from beardyn_core.monitor.chain import MonitorResult
from beardyn_core.monitor.streaming import Monitor, MonitorInput
from beardyn_core.run import blocks
from beardyn_core.study.trial import conduct_run

DURATION = 2.2
SETTLED = 0.1
WAVEFORM_RATE = 25_600.0


@dataclass(frozen=True)
class Measurement:
    """What a train has of a run, and what the monitor said."""

    vibration: NDArray[np.float64]
    shaft_frequency: float
    orders: FaultFrequencies
    roller_count: int
    results: tuple[MonitorResult, ...]


@cache
def received(scene_name: str, healthy: bool, seed: int | None = None, tier: str = "full") -> Measurement:
    """Run a scene, with or without its defects, and let the monitor listen."""
    scene = load_scene(scene_name, seed=seed, tier=tier)
    scene = replace(scene, defects=()) if healthy else scene
    orders = fault_frequencies(scene.bearing)
    monitor = Monitor(orders, scene.bearing.roller_count)
    vibration, speed, results = [], [], []
    for block in blocks(scene, DURATION):
        result = monitor.take(MonitorInput.of_block(block))
        results += [result] if result is not None and result.verdict != "waiting" else []
        vibration.append(block.acceleration[0])
        speed.append(block.shaft_speed)
    settled = np.concatenate(vibration)[int(SETTLED * WAVEFORM_RATE) :]
    shaft_frequency = float(np.mean(np.concatenate(speed))) / (2.0 * np.pi)
    return Measurement(settled, shaft_frequency, orders, scene.bearing.roller_count, tuple(results))


def envelope_spectrum(run: Measurement) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Shaft orders and envelope amplitude of the vertical axis, 2 to 10 kHz, independent of the monitor."""
    band = butter(4, [2000.0, 10_000.0], "bandpass", fs=WAVEFORM_RATE, output="sos")
    envelope = np.abs(hilbert(sosfiltfilt(band, run.vibration[:, 2])))
    window = np.hanning(len(envelope))
    amplitude = np.abs(np.fft.rfft((envelope - envelope.mean()) * window)) * 2.0 / window.sum()
    frequency = np.fft.rfftfreq(len(envelope), 1.0 / WAVEFORM_RATE)
    return np.asarray(frequency / run.shaft_frequency, dtype=np.float64), amplitude


def line(orders: NDArray[np.float64], amplitude: NDArray[np.float64], order: float) -> float:
    """Largest amplitude within 1 % of an order."""
    return float(amplitude[np.abs(orders - order) < 0.01 * order].max())


def test_strongest_envelope_line_and_a_harmonic_of_a_cup_spall_are_bpfo() -> None:
    run = received("cup_spall", healthy=False)
    orders, amplitude = envelope_spectrum(run)
    searched = (orders > 0.3 * run.roller_count) & (orders < 12.0 * run.roller_count)
    strongest = orders[searched][amplitude[searched].argmax()]
    assert strongest == pytest.approx(run.orders.bpfo, rel=0.01)
    rest = searched & (np.abs(orders - strongest) > 0.01 * strongest)
    second = orders[rest][amplitude[rest].argmax()]
    assert second / run.orders.bpfo == pytest.approx(round(second / run.orders.bpfo), rel=0.01)


def test_bpfo_stands_ten_decibels_above_the_identical_healthy_run() -> None:
    faulty, healthy = received("cup_spall", healthy=False), received("cup_spall", healthy=True)
    for harmonic in (1, 2):
        order = harmonic * faulty.orders.bpfo
        gain = line(*envelope_spectrum(faulty), order) / line(*envelope_spectrum(healthy), order)
        assert 20.0 * np.log10(gain) >= 10.0


def test_monitor_names_a_cup_spall_within_one_percent_of_bpfo() -> None:
    results = received("cup_spall", healthy=False).results
    assert results
    for result in results:
        assert result.verdict == "cup"
        assert result.fault_frequency == pytest.approx(result.expected_frequency, rel=0.01)


def test_monitor_is_quiet_on_the_identical_healthy_run() -> None:
    results = received("cup_spall", healthy=True).results
    assert results
    assert {result.verdict for result in results} == {"healthy"}


@pytest.mark.parametrize("tier", [pytest.param("full", marks=pytest.mark.slow), "quasistatic"])
def test_cone_spall_gives_bpfi_with_shaft_sidebands(tier: str) -> None:
    run = received("cone_spall", healthy=False, tier=tier)
    assert {result.verdict for result in run.results} == {"cone"}
    orders, amplitude = envelope_spectrum(run)
    background = float(np.median(amplitude[(orders > 5.0) & (orders < 50.0)]))
    for side in (-1.0, 0.0, 1.0):
        assert line(orders, amplitude, run.orders.bpfi + side) > 4.0 * background


# The alarm threshold of the monitor was set on synthetic noise; these seeds had no part in it.
@pytest.mark.slow
@pytest.mark.parametrize("seed", [101, 102, 103, 104, 105])
def test_monitor_raises_no_alarm_on_healthy_runs_of_other_seeds(seed: int) -> None:
    results = received("smooth_run", healthy=True, seed=seed).results
    assert {result.verdict for result in results} == {"healthy"}


@pytest.mark.slow
@pytest.mark.parametrize("seed", [201, 202, 203])
def test_monitor_finds_the_cup_spall_on_other_seeds(seed: int) -> None:
    assert {result.verdict for result in received("cup_spall", healthy=False, seed=seed).results} == {"cup"}


# Of `beardyn trial healthy`: one whose second stretch ends in a strike of its flat, the deepest lines of a
# healthy bearing, and runs that alarmed while a bearing's waves ended at order 300.
SOUND = [(200, "german_high", "flat"), (200, "german_high", "round"), (250, "german_high", "flat")]
SOUND += [(80, "german_low", "round"), (80, "german_low", "polygon"), (160, "german_low", "round")]


@pytest.mark.parametrize(
    ("tier", "kmh", "track", "wheel"),
    [
        ("quasistatic", *SOUND[0]),
        *(pytest.param("quasistatic", *each, marks=pytest.mark.slow) for each in SOUND[1:]),
        *(pytest.param("full", *each, marks=pytest.mark.slow) for each in SOUND),
    ],
)
def test_a_sound_bearing_under_a_quiet_sensor_is_left_alone(
    tier: str, kmh: float, track: str, wheel: str, request: pytest.FixtureRequest
) -> None:
    if tier == "full":  # as a user has it, in a box that rings: docs/limits.md has a rigid one
        request.getfixturevalue("shipped_configuration")
    trial = load_trial("healthy")
    assert trial.noise_density == pytest.approx(3e-4)
    cell = next(
        cell
        for cell in trial.cells()
        if (cell.tier, round(3.6 * cell.speed), cell.track, cell.wheel) == (tier, kmh, track, wheel)
    )
    run = conduct_run(trial, cell, "", "")
    assert run.complete
    assert run.analyses > 1
    assert run.called == ()
