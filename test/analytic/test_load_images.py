"""Between its samples the load has no images of their rate, and what was drawn by ruler stays straight."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.arrays import Float, Int
from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.rail.load_buffer import LoadBuffer
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.topics import NAMESPACE
from beardyn_core.scene.band_limited import interpolate_columns
from beardyn_core.scene.chord_polynomials import PASSED
from beardyn_core.scene.load import LOOK_AHEAD, LoadHistory
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation
from beardyn_ros.live_load import HeldLoad, encode_shaft, encode_wrench
from beardyn_ros.load_feed import LiveLine

BLOCK_NS = 20_000_000
STEPS = 1024
PERIOD_NS = 500_000


def history_of(force: Float, time_ns: Int | None = None) -> LoadHistory:
    """Samples of a vertical force, at 2 kHz when nothing else is said."""
    count = len(force)
    wrench = np.zeros((count, 6))
    wrench[:, 2] = force
    time_ns = np.arange(count) * PERIOD_NS if time_ns is None else time_ns
    return LoadHistory(time_ns, wrench, np.full(count, 100.0), np.zeros((count, 3)))


def force_at_steps(load: LoadHistory, blocks: range, steps: int = STEPS) -> Float:
    """Force at all steps of some blocks, computed block by block."""
    buffer = LoadBuffer()
    assert buffer.append(load)
    rows = [buffer.at_steps(k * BLOCK_NS, (k + 1) * BLOCK_NS, steps)[:-1, 2] for k in blocks]
    return np.concatenate(rows)


def line_and_image(force: Float, frequency: float) -> tuple[float, float]:
    """Amplitude of a line, and of the strongest other one, over whole periods of both."""
    amplitude = 2.0 * np.abs(np.fft.rfft(force - force.mean())) / len(force)
    line = round(frequency * len(force) / STEPS * 0.02)
    others = np.delete(amplitude, line)
    return float(amplitude[line]), float(others.max())


@pytest.mark.parametrize("frequency", [10.0, 50.0, 100.0, 300.0, 500.0, 700.0, 800.0, 2000.0 * PASSED])
def test_a_sine_has_no_images(frequency: float) -> None:
    """Straight lines between the samples leave one 19 dB down of a sine of 500 Hz."""
    time = np.arange(2400) * PERIOD_NS * 1e-9
    force = force_at_steps(history_of(8e4 + 1e3 * np.sin(2.0 * np.pi * frequency * time)), range(2, 52))
    line, image = line_and_image(force, frequency)
    down = 130.0 if frequency <= 100.0 else 85.0
    assert image < line * 10.0 ** (-down / 20.0)
    assert line == pytest.approx(1e3, rel=2e-4)  # 0.002 dB


def test_samples_come_through_as_they_are() -> None:
    force = np.random.default_rng(1).normal(8e4, 1e3, 401)
    rows = force_at_steps(history_of(force), range(10), steps=40)
    np.testing.assert_array_equal(rows, force[:400])


@pytest.mark.parametrize("value", [0.0, 80_123.456])
def test_a_constant_stays_the_same_number(value: float) -> None:
    assert set(force_at_steps(history_of(np.full(401, value)), range(10))) == {value}


def drawn_by_ruler() -> Iterator[tuple[str, Any, Any]]:
    """Loads as a person writes them down."""
    even = np.arange(801) * PERIOD_NS
    yield "step", even, np.where(even < 100_000_000, 2e4, 9e4)
    yield "impulse", even, np.where(even == 100_000_000, 9e4, 2e4)
    yield "ramp", even, np.interp(even, [0.05e9, 0.151e9, 0.2e9], [2e4, 9e4, 5e4])
    yield "stairs", even, 1e4 * (even // 25_000_000 % 7)
    yield "few points", np.array([0, 10, 11, 100, 400]) * 1_000_000, np.array([2e4, 9e4, 1e4, 8e4, 2e4])
    yield "even points far apart", np.arange(41) * 20_000_000, np.tile([2e4, 9e4], 21)[:41]


@pytest.mark.parametrize(("name", "time_ns", "force"), list(drawn_by_ruler()))
def test_what_was_drawn_by_ruler_stays_straight(name: str, time_ns: Int, force: Float) -> None:
    """A sinc overshoots a step by 9 % and rings on."""
    rows = force_at_steps(history_of(force, time_ns), range(20))
    expected = np.interp(np.arange(len(rows)) * (BLOCK_NS / STEPS), time_ns.astype(float), force)
    np.testing.assert_allclose(rows, expected, rtol=1e-12, err_msg=name)


def test_a_measured_signal_that_begins_or_ends_makes_no_jump() -> None:
    time = np.arange(401) * PERIOD_NS * 1e-9
    force = 8e4 + 1e3 * np.sin(2.0 * np.pi * 60.0 * time + 0.7)
    rows = force_at_steps(history_of(force), range(-1, 11))
    at = (np.arange(len(rows)) / STEPS - 1.0) * 0.02
    exact = 8e4 + 1e3 * np.sin(2.0 * np.pi * 60.0 * np.clip(at, 0.0, time[-1]) + 0.7)
    assert np.abs(rows - exact).max() < 2.0
    assert np.ptp(rows[at <= 0.0]) == 0.0
    assert np.ptp(rows[at >= time[-1]]) == 0.0


def test_stamps_that_are_rounded_count_as_even() -> None:
    """3 kHz in whole microseconds: the images are no longer those of straight lines, 38 dB down."""
    time_ns = np.round(np.arange(1800) * 1e6 / 3000.0).astype(np.int64) * 1000
    force = 8e4 + 1e3 * np.sin(2.0 * np.pi * 300.0 * np.arange(1800) / 3000.0)
    line, image = line_and_image(force_at_steps(history_of(force, time_ns), range(2, 27)), 300.0)
    assert image < 1.5e-3 * line  # of the rounding itself


def test_blocks_are_the_same_to_the_bit_however_they_are_cut_and_however_the_load_arrives() -> None:
    random = np.random.default_rng(2)
    load = history_of(random.normal(8e4, 1e3, 801))
    force = load.wrench[:, 2]
    force[300:420] = 7e4  # held for a while
    whole, single, pieces = LoadBuffer(), LoadBuffer(), LoadBuffer()
    assert whole.append(load)
    assert single.append(load)
    rows = whole.at_steps(0, 16 * BLOCK_NS, 300, 16)  # 300: no step but the last is at a whole nanosecond
    arrived = 0
    for k in range(16):
        start, end = k * BLOCK_NS, (k + 1) * BLOCK_NS
        while not pieces.covers(end):
            count = int(random.integers(1, 9))
            assert pieces.append(load.part(arrived, arrived + count))
            arrived += count
        assert arrived - end // PERIOD_NS <= LOOK_AHEAD + 9
        block = single.at_steps(start, end, 300)
        np.testing.assert_array_equal(pieces.at_steps(start, end, 300), block)
        np.testing.assert_array_equal(rows[300 * k : 300 * (k + 1)], block[:-1])


def test_a_stream_is_waited_for_only_as_long_as_its_samples_may_matter() -> None:
    end, even = BLOCK_NS, history_of(np.random.default_rng(3).normal(size=200))
    buffer = LoadBuffer()
    assert not buffer.covers(end)
    assert buffer.append(even.part(0, 41))
    assert not buffer.covers(end)
    assert buffer.wanted_ns(end) == end + LOOK_AHEAD * PERIOD_NS
    assert buffer.append(even.part(41, 69))
    assert not buffer.covers(end)
    waiting = buffer.copy()
    assert buffer.append(even.part(69, 70))
    assert buffer.covers(end)
    # it ends; or the even spacing does
    waiting.ended = True
    assert waiting.covers(end)
    waiting.ended = False
    late = history_of(np.zeros(1), np.array([35_200_000]))
    assert waiting.append(late)
    assert waiting.covers(end)


# --- where loads come from ----------------------------------------------------------------------------------


def strongest_image(load: LoadHistory, sample_rate: float) -> float:
    """Power around multiples of a sample rate over that below 100 Hz, [dB]."""
    force = force_at_steps(load, range(3, 48))
    window = np.blackman(len(force))
    power = np.abs(np.fft.rfft((force - force.mean()) * window)) ** 2 / window.sum() ** 2
    frequency = np.fft.rfftfreq(len(force), 0.02 / STEPS)
    near = np.abs(frequency - sample_rate * np.round(frequency / sample_rate)) < 100.0
    images = power[near & (frequency > 0.5 * sample_rate)].max()
    return float(10.0 * np.log10(images / power[frequency < 100.0].max()))


def ride(wheelset: str = "elastic") -> LoadHistory:
    scene = load_scene("healthy_80")
    assert isinstance(scene.operation, QuarterVehicleOperation)
    smooth = dataclasses.replace(scene.operation.irregularity, short_waves="none")  # at 2 kHz
    operation = dataclasses.replace(scene.operation, irregularity=smooth, wheelset=wheelset)
    return load_history(operation, scene.mounting, 1.0, scene.seed)


def test_a_scenario_has_no_images() -> None:
    """Straight lines between its samples leave them 70 dB down."""
    assert strongest_image(ride(), 2000.0) < -130.0


@pytest.mark.parametrize("rate", [1000.0, 2000.0, 5000.0])
def test_a_csv_file_has_no_images(tmp_path: Path, rate: float) -> None:
    load, time = ride(), np.arange(int(rate) + 1) / rate
    force = interpolate_columns(load.time_ns, load.columns(), 0, time * 1e9)[:, 2]
    rows = [f"{t:.6f},700,0,0,{f:.9g}" for t, f in zip(time, force, strict=True)]
    path = tmp_path / "measured.csv"
    path.write_text("\n".join(["time_s,speed_rpm,fx_N,fy_N,fz_N", *rows]) + "\n")
    again = load_history(MeasuredOperation(path), Mounting(), 1.0, 1)
    assert strongest_image(again, min(rate, 2000.0)) < -90.0


@pytest.mark.parametrize("rate", [1000.0, 2000.0])
def test_a_recording_has_no_images(tmp_path: Path, rate: float) -> None:
    """Sent as a stream of load, whose samples stay as they are, and as single messages of force and speed.

    A wheelset that bends shakes above 500 Hz, which no samples at 1 kHz can hold.
    """
    load, time = ride("rigid"), np.arange(int(rate) + 1) / rate
    columns = interpolate_columns(load.time_ns, load.columns(), 0, time * 1e9)
    time_ns = np.round(time * 1e9).astype(np.int64)
    sent = LoadHistory(time_ns, columns[:, :6].copy(), columns[:, 6].copy(), columns[:, 7:].copy())
    stream = tmp_path / "stream.mcap"
    writer = McapWriter(stream, NAMESPACE)
    for at in range(0, len(sent), 100):
        part = sent.part(at, min(at + 100, len(sent)))
        writer.add("load/blocks", int(part.time_ns[0]), encode_load(part, at))
    writer.close("")
    assert strongest_image(load_history(MeasuredOperation(stream), Mounting(), 1.0, 1), rate) < -120.0
    single = tmp_path / "single.mcap"
    writer = McapWriter(single, NAMESPACE)
    for at, stamp in enumerate(time_ns.tolist()):
        writer.add("load/wrench", stamp, encode_wrench(sent.wrench[at], stamp))
        if at % 4 == 0:
            writer.add("load/shaft", stamp, encode_shaft(float(sent.shaft_speed[at]), stamp))
    writer.close("")
    assert strongest_image(load_history(MeasuredOperation(single), Mounting(), 1.0, 1), rate) < -90.0


@pytest.mark.parametrize("frequency", [1.0, 3.0, 5.0, 8.0, 10.0])
def test_the_live_load_has_no_images_of_the_blocks(frequency: float) -> None:
    """One value each 20 ms; straight lines between them leave an image 24 dB down of 10 Hz. 60 ms late."""

    def held(block: int) -> HeldLoad:
        force = 8e4 + 1e3 * np.sin(2.0 * np.pi * frequency * 0.02 * block)
        return HeldLoad(np.array([0.0, 0.0, force, 0.0, 0.0, 0.0]), 100.0, 0.0)

    line = LiveLine(held(0), BLOCK_NS)
    parts = [line.begin(), *(line.go_on(held(block)) for block in range(1, 120))]
    load = history_of(np.concatenate([part.wrench[:, 2] for part in parts]))
    np.testing.assert_array_equal(load.time_ns, np.concatenate([part.time_ns for part in parts]))
    force = force_at_steps(load, range(10, 110))
    amplitude, image = line_and_image(force, frequency)
    assert image < 1e-4 * amplitude
    assert amplitude == pytest.approx(1e3, rel=1e-4)
    assert force[0] == pytest.approx(held(10 - 3).wrench[2], abs=0.1)


def test_a_live_load_that_is_constant_stays_the_same_number() -> None:
    held = HeldLoad(np.array([1.1, -2.3, 80_123.4, 0.0, 0.0, 0.0]), 100.1, 0.0)
    line = LiveLine(held, BLOCK_NS)
    parts = [line.begin(), line.go_on(held), line.go_on(held)]
    assert {tuple(row) for part in parts for row in part.wrench.tolist()} == {tuple(held.wrench.tolist())}
    assert {value for part in parts for value in part.shaft_speed.tolist()} == {100.1}
