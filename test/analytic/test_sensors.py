"""An accelerometer's own chain: mounting resonance as of theory, both rates, any cut into blocks."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene
from beardyn_core.physics.bodies.layout import SIGNAL_ACCELERATION, SIGNAL_CHANNELS
from beardyn_core.rail.transfer_path import TransferPath, read_transfer_path
from beardyn_core.scene.background import Background, Pickup, PickupLine
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import Accelerometer, MeasuredPath
from beardyn_core.sensors.accelerometer import (
    GRAVITY,
    LOOKAHEAD,
    filter_coefficients,
    low_pass_gain,
    resonance_gain,
)
from beardyn_core.sensors.path_filter import response_of
from beardyn_core.sensors.resampling import DELAY, Decimator
from beardyn_core.sensors.sensor_set import Sensors, box_force

SAMPLES = 512  # of 25.6 kHz in a block
BLOCKS = 30
SPEED = 100.0  # of the shaft, [rad/s]
QUIET = Accelerometer(noise_density=0.0, range=1e9)


def scene_with(steps: int, *sensors: Accelerometer) -> Scene:
    scene = load_scene("static_80kN")
    return replace(scene, sensors=sensors, numerics=replace(scene.numerics, steps_per_sample=steps))


def signals_of(vertical: np.ndarray) -> np.ndarray:
    signals = np.zeros((len(vertical), SIGNAL_CHANNELS))
    signals[:, SIGNAL_ACCELERATION + 2] = vertical
    return signals


def received(scene: Scene, vertical: np.ndarray, blocks_at_once: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Time [s] and vertical reading of the first sensor; the box only shakes along z."""
    steps = round(scene.numerics.steps_per_sample)
    sensors = Sensors(scene, DELAY if steps > 1 else 0)
    size = SAMPLES * steps * blocks_at_once
    decimator = Decimator(steps, SIGNAL_CHANNELS, held_back=1)
    parts = []
    for begin in range(0, len(vertical), size):
        signals = signals_of(vertical[begin : begin + size])
        index = begin // (SAMPLES * steps)
        waves = decimator.push(signals)
        speed = np.full(len(signals) + 1, SPEED)
        motion = np.zeros((8 * len(signals) // (SAMPLES * steps) + 2, 6))
        parts.append(sensors.vibration(index, sensors.read(index, waves, signals, motion, speed))[0])
    time = np.concatenate([part.time_ns for part in parts]) * 1e-9
    sample = np.concatenate([part.sample + np.arange(len(part.time_ns)) for part in parts])
    assert np.array_equal(sample, np.arange(len(sample)))
    return time, np.concatenate([part.acceleration[:, 2] for part in parts]) - GRAVITY


@pytest.mark.parametrize(
    ("rate", "steps"), [(25_600.0, 1), (25_600.0, 4), (25_600.0, 8), (51_200.0, 8), (51_200.0, 16)]
)
@pytest.mark.parametrize(("resonance", "damping"), [(2_000.0, 0.05), (9_000.0, 0.02), (30_000.0, 0.01)])
def test_the_gain_is_that_of_a_mass_on_a_spring(
    rate: float, steps: int, resonance: float, damping: float
) -> None:
    """Amplitude within 0.1 dB and phase within 1 %, through the anti-alias filter's flat band.

    The time of the samples has the delay of every filter taken out, so the phase is that of the mounting.
    """
    sensor = replace(QUIET, mounting_resonance=resonance, mounting_damping_ratio=damping, rate=rate)
    scene = scene_with(steps, sensor)
    count = SAMPLES * steps * BLOCKS
    time = (np.arange(count) + 1) / (25_600.0 * steps)
    span = 0.3
    # whole periods in the last 0.3 s, so that the tones do not leak into each other
    tones = np.array([300.0, 1_800.0, 2_000.0, 4_500.0, 8_800.0, 9_000.0, 0.39 * rate])
    tones = np.round(tones * span) / span
    at, reading = received(scene, np.cos(2.0 * np.pi * np.outer(tones, time)).sum(axis=0))
    last = slice(len(at) - round(span * rate), None)
    found = 2.0 * np.exp(-2j * np.pi * np.outer(tones, at[last])) @ reading[last] / (span * rate)
    expected = resonance_gain(tones, resonance, damping)
    assert np.abs(20.0 * np.log10(np.abs(found / expected))).max() < 0.1
    assert np.abs(np.angle(found / expected)).max() < 0.01


def test_the_gain_has_the_values_of_the_textbook() -> None:
    """Gain 1 at rest, 1 over twice the damping ratio at the resonance, 12.5 % high at a third of it."""
    gain = resonance_gain(np.array([0.0, 3_000.0, 9_000.0]), 9_000.0, 0.02)
    assert abs(gain[0]) == 1.0
    assert abs(gain[1]) == pytest.approx(1.125, rel=1e-3)
    assert abs(gain[2]) == pytest.approx(25.0)
    assert np.angle(gain[2]) == pytest.approx(-np.pi / 2)


@pytest.mark.parametrize("rate", [25_600.0, 51_200.0])
@pytest.mark.parametrize("damping", [0.005, 0.1, 0.7])
@pytest.mark.parametrize("low_pass", [None, 10_000.0, 30_000.0])
@pytest.mark.parametrize("resonance", [None, 500.0, 12_000.0, 12_800.0, 28_000.0, 100_000.0])
def test_the_filter_matches_the_theory_over_the_whole_band(
    resonance: float | None, damping: float, low_pass: float | None, rate: float
) -> None:
    """Poles beyond the band and beyond the rate included."""
    band = 0.4 * rate
    poles, taps = filter_coefficients(resonance, damping, rate, band, low_pass)
    frequency = np.linspace(0.0, band, 500)
    late = np.exp(-2j * np.pi * frequency / rate)
    found = (
        late[:, None] ** np.arange(2 * LOOKAHEAD, -1, -1)
        @ taps
        / (1.0 - poles[0] * late - poles[1] * late**2)
    )
    gain = resonance_gain(frequency, resonance or np.inf, damping) * low_pass_gain(frequency, low_pass)
    error = np.abs(found / (gain * late**LOOKAHEAD) - 1.0)
    assert error.max() < 2e-3  # 0.02 dB
    assert abs(found[0] - 1.0) < 1e-9


def test_at_rest_it_reads_gravity_from_the_first_sample_on() -> None:
    sensor = replace(QUIET, mounting_resonance=9_000.0, rate=51_200.0)
    _, reading = received(scene_with(8, sensor), np.zeros(SAMPLES * 8 * 2))
    assert np.abs(reading).max() < 1e-10


@pytest.mark.parametrize("rate", [25_600.0, 51_200.0])
def test_any_cut_into_blocks_gives_the_same_bits(rate: float) -> None:
    sensor = replace(QUIET, noise_density=0.02, mounting_resonance=9_000.0, rate=rate)
    shaking = np.random.default_rng(3).normal(size=SAMPLES * 8 * 12)
    one = received(scene_with(8, sensor), shaking)
    for at_once in (3, 12):
        several = received(scene_with(8, sensor), shaking, at_once)
        assert all(np.array_equal(a, b) for a, b in zip(one, several, strict=True))


def test_the_anti_alias_filter_keeps_out_what_the_rate_cannot_show() -> None:
    """A tone at 0.7 of the rate, which would show at 0.3 of it, is 70 dB down."""
    for rate in (25_600.0, 51_200.0):
        time = (np.arange(SAMPLES * 8 * 8) + 1) / (25_600.0 * 8)
        _, reading = received(scene_with(8, replace(QUIET, rate=rate, mounting_resonance=1e5)), np.sin(
            2.0 * np.pi * 0.7 * rate * time
        ))  # fmt: skip
        assert np.abs(reading[200:]).max() < 10.0 ** (-70.0 / 20.0) * abs(
            resonance_gain(np.array([0.7 * rate]), 1e5, 0.02)[0]
        )


def test_noise_has_its_density_at_the_faster_rate_too() -> None:
    sensor = replace(QUIET, noise_density=0.02, rate=51_200.0)
    _, reading = received(scene_with(8, sensor), np.zeros(SAMPLES * 8 * BLOCKS))
    assert reading.std() == pytest.approx(0.02 * np.sqrt(25_600.0), rel=0.02)


def test_the_motion_between_rows_is_linear_and_late_as_the_signals() -> None:
    """Angular velocity that grows with time shows as the centripetal acceleration of its square."""
    signals = np.zeros((SAMPLES, SIGNAL_CHANNELS))
    motion = np.zeros((10, 6))
    motion[:, 4] = np.arange(-1, 9) * 64.0  # about y, in samples
    force = box_force((0.0, 0.0, 1.0), signals, motion, delay=24)
    speed = np.arange(SAMPLES) - 24.0
    np.testing.assert_allclose(force[:, 2], GRAVITY - speed**2, rtol=1e-12)


def test_a_fast_sensor_needs_steps_that_resolve_its_band() -> None:
    with pytest.raises(ValueError, match="steps_per_sample of at least 8 and even, not 4"):
        Sensors(scene_with(4, replace(QUIET, rate=51_200.0)), DELAY)


def ringing(frequency: np.ndarray) -> np.ndarray:
    """Ratio of a sensor on a box with two modes to the rigid box: physical, no response before its cause."""
    found = np.ones(len(frequency), dtype=complex)
    for mode, damping, share in ((1_900.0, 0.02, 0.8), (5_200.0, 0.015, -1.5)):
        found += (
            share
            * (frequency / mode) ** 2
            / (1.0 - (frequency / mode) ** 2 + 2j * damping * frequency / mode)
        )
    return found


def path_file(folder: Path, ending: str = "csv") -> Path:
    frequency = np.arange(20.0, 11_000.0, 2.0)
    ratio = ringing(frequency)
    path = folder / f"path.{ending}"
    if ending == "uff":
        pyuff = pytest.importorskip("pyuff", reason="Universal files need pyuff")
        response = pyuff.prepare_58(
            func_type=4, binary=0, rsp_node=1, rsp_dir=3, ref_node=1, ref_dir=3, data=ratio, x=frequency,
            id1="ratio", abscissa_spec_data_type=18, ordinate_spec_data_type=12, orddenom_spec_data_type=12,
        )  # fmt: skip
        pyuff.UFF(str(path)).write_sets(response, mode="overwrite")
        return path
    rows = [
        f"{f},{20 * np.log10(abs(r))},{np.degrees(np.angle(r))}"
        for f, r in zip(frequency, ratio, strict=True)
    ]
    path.write_text("\n".join(["frequency_Hz,magnitude_dB,phase_deg", *rows]) + "\n")
    return path


@pytest.mark.parametrize(
    ("rate", "steps", "ending"), [(25_600.0, 4, "csv"), (25_600.0, 1, "uff"), (51_200.0, 8, "csv")]
)
def test_a_measured_path_goes_in_and_comes_out(rate: float, steps: int, ending: str, tmp_path: Path) -> None:
    """Within 0.1 dB and 0.01 rad: the grid of the file is 2 Hz, a mode's half width 38 Hz."""
    sensor = replace(QUIET, rate=rate, measured_paths=(MeasuredPath(path_file(tmp_path, ending)),))
    count, span = SAMPLES * steps * 60, 0.5
    time = (np.arange(count) + 1) / (25_600.0 * steps)
    tones = np.array([50.0, 900.0, 1_860.0, 1_900.0, 3_300.0, 5_150.0, 5_200.0, 9_000.0, 10_000.0])
    at, reading = received(scene_with(steps, sensor), np.cos(2.0 * np.pi * np.outer(tones, time)).sum(axis=0))
    last = slice(len(at) - round(span * rate), None)
    found = 2.0 * np.exp(-2j * np.pi * np.outer(tones, at[last])) @ reading[last] / (span * rate)
    expected = ringing(tones)
    assert np.abs(20.0 * np.log10(np.abs(found / expected))).max() < 0.1
    assert np.abs(np.angle(found / expected)).max() < 0.01


def test_a_path_on_one_axis_leaves_gravity_and_the_others_alone(tmp_path: Path) -> None:
    sensor = replace(QUIET, measured_paths=(MeasuredPath(path_file(tmp_path), ("x",)),))
    shaking = np.random.default_rng(5).normal(size=SAMPLES * 4 * 8)
    _, filtered = received(scene_with(4, sensor), shaking)
    _, plain = received(scene_with(4, QUIET), shaking)
    assert np.abs(filtered - plain[: len(filtered)]).max() < 1e-12 * 100
    _, still = received(
        scene_with(4, replace(sensor, measured_paths=(MeasuredPath(path_file(tmp_path)),))), 0.0 * shaking
    )
    assert np.abs(still).max() < 1e-9  # gravity passes with gain 1


@pytest.mark.parametrize("at_rest", [0.0, 3.0, -1.0j])
def test_a_row_at_rest_changes_nothing(at_rest: complex) -> None:
    """Most measurements have none or a zero there; taken as it stands it removed gravity."""
    frequency = np.arange(0.0, 11_000.0, 5.0)
    ratio = ringing(frequency)
    ratio[0] = at_rest
    found = response_of(TransferPath(frequency, ratio), 25_600.0)
    assert found.sum() == pytest.approx(1.0, abs=1e-12)
    without = response_of(TransferPath(frequency[1:], ratio[1:]), 25_600.0)
    np.testing.assert_array_equal(found, without)


def test_paths_and_pickup_give_the_same_bits_however_blocks_are_cut(tmp_path: Path) -> None:
    sensor = replace(
        QUIET,
        noise_density=0.02,
        mounting_resonance=9_000.0,
        measured_paths=(MeasuredPath(path_file(tmp_path)),),
    )
    scene = replace(scene_with(4, sensor), background=HUM)
    shaking = np.random.default_rng(3).normal(size=SAMPLES * 4 * 12)
    one = received(scene, shaking)
    for at_once in (3, 12):
        several = received(scene, shaking, at_once)
        assert all(np.array_equal(a, b) for a, b in zip(one, several, strict=True))


def test_a_path_that_cannot_be_a_filter_is_refused(tmp_path: Path) -> None:
    frequency = np.arange(0.0, 11_000.0, 5.0)
    early = np.exp(2j * np.pi * frequency * 0.02)  # 20 ms before its cause
    with pytest.raises(InputError, match="before its cause"):
        response_of(TransferPath(frequency, early), 25_600.0)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("frequency_Hz,real\n1,1\n2,1\n", "real and imaginary, or"),
        ("frequency_Hz,real,imaginary\n5,1,0\n2,1,0\n", "frequency_Hz"),
        ("frequency_Hz,real,imaginary\n5,1,0\n200,1,0\n", "reach at least 1000 Hz"),
        ("hertz,real,imaginary\n5,1,0\n", "frequency_Hz"),
    ],
)
def test_a_wrong_file_of_a_path_is_answered_with_a_sentence(text: str, sentence: str, tmp_path: Path) -> None:
    path = tmp_path / "wrong.csv"
    path.write_text(text)
    with pytest.raises(InputError, match=sentence):
        read_transfer_path(path)


HUM = Background(
    "hum", "", pickup=Pickup(1_000.0, 10.0, (PickupLine(2, 1, 0.5e-3), PickupLine(11, 2, 0.5e-3)))
)


def test_pickup_is_volts_over_sensitivity_at_the_side_bands() -> None:
    """Around 2 kHz, 10 electrical periods a turn; 11 kHz lies beyond 0.4 of the rate and is held back."""
    scene = replace(scene_with(4, replace(QUIET, sensitivity=0.005)), background=HUM)
    at, reading = received(scene, np.zeros(SAMPLES * 4 * 54))
    last = slice(len(at) - 25_600, None)
    electrical = 10.0 * SPEED / (2.0 * np.pi)
    for side in (-1.0, 1.0):
        tone = 2_000.0 + side * electrical
        window = np.hanning(25_600)
        found = (
            2.0 * abs(np.sum(window * reading[last] * np.exp(-2j * np.pi * tone * at[last]))) / window.sum()
        )
        assert found == pytest.approx(0.1, rel=1e-3)
    assert reading[last].std() == pytest.approx(0.1, rel=1e-3)  # two lines of 0.1 and nothing else
