"""Measures of a run against signals whose numbers are known; bands that mean what they say."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.choice import load_scene
from beardyn_core.scene.excitation import WheelFlat, WheelPolygon
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.study.ladder import window_edges
from beardyn_core.study.ladder_result import QuantityError, errors
from beardyn_core.study.measures import (
    MEASURES,
    NOMINAL_BANDS,
    FaultLine,
    Outcome,
    SignalCollector,
    Signals,
    compute_measures,
    fault_line_of,
    line_level,
    load_distribution,
    outcome,
    third_octave_levels,
)
from test.record.synthetic_run import SyntheticRun

Float = NDArray[np.float64]
RATE = 25_600.0
ROLLERS = 20
SHAFT_SPEED, CAGE_SPEED = 120.0, 51.0


def steady(duration: float = 1.0, tone: float = 0.0) -> Signals:
    """A bearing under a steady load whose largest roller load is 10 kN; a 4 kHz tone on z."""
    trend, snapshot, wave = (np.arange(round(duration * rate)) / rate for rate in (400.0, 200.0, RATE))
    azimuth = CAGE_SPEED * snapshot[:, None, None] + 2.0 * np.pi / ROLLERS * np.arange(ROLLERS)
    azimuth = np.repeat(azimuth, 2, axis=1)
    acceleration = np.zeros((len(wave), 3))
    acceleration[:, 2] = 9.81 + tone * np.sin(2.0 * np.pi * 4000.0 * wave)
    return Signals(
        trend_time=trend,
        force=np.tile([0.0, 3.0e3, 40.0e3], (len(trend), 1)),
        torque=np.full(len(trend), -4.0),
        shaft_angle=SHAFT_SPEED * trend,
        cage_speed=np.full((len(trend), 2), CAGE_SPEED),
        snapshot_time=snapshot,
        deflection=np.tile([1.0e-6, 0.0, 50.0e-6], (len(snapshot), 1)),
        roller_azimuth=azimuth,
        roller_load=1.0e4 * np.maximum(np.cos(azimuth), 0.0),
        wave_time=wave,
        acceleration=acceleration,
    )


def test_a_sine_has_its_level_in_its_band_and_none_elsewhere() -> None:
    time = np.arange(25_600) / RATE
    wave = np.sin(2.0 * np.pi * 1000.0 * time)
    acceleration = np.column_stack([3.0 * wave, 0.0 * wave, 9.81 + 4.0 * wave])
    levels = third_octave_levels(acceleration, RATE)
    band = NOMINAL_BANDS.index(1000)
    assert levels[band] == pytest.approx(
        20.0 * math.log10(math.hypot(3.0, 4.0) / math.sqrt(2.0) / 1e-6), abs=0.01
    )
    others = np.delete(levels, band)
    assert np.all(others < levels[band] - 60.0)


def test_white_noise_has_the_power_of_the_band_width() -> None:
    density = 0.02
    noise = density * math.sqrt(0.5 * RATE) * np.random.default_rng(3).standard_normal((256_000, 1))
    levels = third_octave_levels(noise, RATE)
    for nominal in (1000, 4000, 10_000):
        centre = 1000.0 * 10.0 ** (round(10.0 * math.log10(nominal / 1000.0)) / 10.0)
        top = min(centre * 10.0**0.05, 0.4 * RATE)
        expected = 20.0 * math.log10(density * math.sqrt(top - centre / 10.0**0.05) / 1e-6)
        # 10 s of a band of 230 Hz and more: 2300 periods, 0.1 dB
        assert levels[NOMINAL_BANDS.index(nominal)] == pytest.approx(expected, abs=0.3)


def test_narrow_bands_of_a_short_window_share_a_sine_between_them_without_loss() -> None:
    time = np.arange(6144) / RATE
    acceleration = np.sin(2.0 * np.pi * 70.8 * time)[:, None]  # on the edge of two bands
    power = 10.0 ** (0.1 * third_octave_levels(acceleration, RATE)) * 1e-12
    assert power.sum() == pytest.approx(0.5, rel=0.02)
    assert power[NOMINAL_BANDS.index(63)] == pytest.approx(power[NOMINAL_BANDS.index(80)], rel=0.15)


def test_load_distribution_is_the_mean_over_one_pitch() -> None:
    signals = steady(duration=20.0)
    found = load_distribution(signals.roller_azimuth, signals.roller_load)
    assert found.shape == (2, ROLLERS)
    half = np.pi / ROLLERS
    assert found[0, 0] == pytest.approx(1.0e4 * math.sin(half) / half, rel=1e-3)
    assert found[1, ROLLERS // 2] == 0.0
    assert found[:, 1] == pytest.approx(found[:, -1], rel=2e-3)


def test_load_distribution_has_no_number_where_no_roller_was() -> None:
    azimuth = np.array([[[0.0, 0.1], [0.0, 0.1]]])
    assert load_distribution(azimuth, np.ones_like(azimuth)).tolist()[0] == pytest.approx(
        [1.0, math.nan], nan_ok=True
    )


@pytest.mark.parametrize("slip", [0.0, 0.004])
def test_line_level_is_the_depth_of_the_modulation(slip: float) -> None:
    signals, order, depth = steady(duration=3.0), 8.5, 0.4
    turned = SHAFT_SPEED * signals.wave_time
    carrier = 5.0 * np.sin(2.0 * np.pi * 5000.0 * signals.wave_time)
    acceleration = signals.acceleration.copy()
    acceleration[:, 0] = carrier * (1.0 + depth * np.cos((1.0 - slip) * order * turned))
    level = line_level(replace(signals, acceleration=acceleration), order)
    assert level == pytest.approx(20.0 * math.log10(5.0 * depth / 1e-6), abs=0.2)


def test_a_standing_shaft_has_no_line() -> None:
    signals = steady()
    assert math.isnan(line_level(replace(signals, shaft_angle=0.0 * signals.shaft_angle), 8.5))


def test_each_fault_has_its_line() -> None:
    for name, line in (("cup_spall", "BPFO"), ("cone_spall", "BPFI"), ("roller_spall", "2 BSF")):
        found = fault_line_of(load_scene(name))
        assert found is not None
        assert found.name == line
    frequencies = fault_frequencies(load_scene("cup_spall").bearing)
    assert fault_line_of(load_scene("oversize_roller")) == FaultLine("FTF", frequencies.ftf)
    healthy = load_scene("smooth_run")
    assert fault_line_of(healthy) is None
    assert isinstance(healthy.operation, QuarterVehicleOperation)
    flat, polygon = WheelFlat(length=0.04), WheelPolygon(order=3, amplitude=2e-5)
    for defects, order in (((flat,), 1.0), ((polygon, flat), 3.0), ((), None)):
        operation = replace(healthy.operation, wheel_defects=defects)
        found = fault_line_of(replace(healthy, operation=operation))
        assert (None if found is None else found.order) == order


def test_windows_are_whole_cage_revolutions_also_when_the_shaft_slows_down() -> None:
    times = np.linspace(0.0, 3.0, 6001)
    speed = 60.0 - 10.0 * times
    edges, revolutions = window_edges(times, speed, 0.4, 2.9)
    turned = (60.0 * np.array(edges) - 5.0 * np.array(edges) ** 2) / (2.0 * np.pi)
    assert edges[-1] == pytest.approx(2.9)
    assert edges[0] >= 0.4
    assert np.diff(turned) == pytest.approx(round(turned[1] - turned[0]), abs=1e-4)
    assert turned[-1] - turned[0] == pytest.approx(revolutions, abs=1e-3)
    # what is left out is less than a window
    assert (60.0 * 2.9 - 5.0 * 2.9**2 - 60.0 * 0.4 + 5.0 * 0.4**2) / (2.0 * np.pi) - revolutions < 3.0


def test_a_ripple_of_the_cage_leaves_no_trace_in_the_means() -> None:
    signals = steady(duration=3.0)
    edges, _ = window_edges(signals.trend_time, np.full(len(signals.trend_time), CAGE_SPEED), 0.3, 2.9)
    rippled = replace(signals, torque=-4.0 + np.sin(CAGE_SPEED * signals.trend_time + 1.0))
    found = outcome(rippled, edges, None)
    index = next(i for i, measure in enumerate(MEASURES) if measure.quantity == "torque")
    # 400 samples a second do not divide a revolution: the last sample is worth 0.01 of a window
    assert found.whole[index] == pytest.approx(-4.0, abs=0.005)
    assert [window[index][0] for window in found.windows] == pytest.approx(
        [-4.0] * len(found.windows), abs=0.02
    )


def test_without_a_whole_revolution_the_windows_are_equal() -> None:
    times = np.linspace(0.0, 1.0, 2001)
    edges, revolutions = window_edges(times, np.zeros(2001), 0.2, 1.0)
    assert edges == pytest.approx((0.2, 0.4, 0.6, 0.8, 1.0))
    assert revolutions == 0


def test_the_collector_reads_what_the_blocks_say() -> None:
    run, collector = SyntheticRun(SHAFT_SPEED), SignalCollector()
    blocks = [run.block(index) for index in range(10)]
    for block in blocks:
        collector.add(block)
    signals = collector.signals()
    assert len(signals.trend_time) == sum(len(block.trend_time_ns) for block in blocks)
    assert np.all(np.diff(signals.snapshot_time) > 0.0)
    angle = np.concatenate([block.roller_angle for block in blocks])
    _, trend, snapshot = np.intersect1d(
        np.round(1e6 * signals.trend_time), np.round(1e6 * signals.snapshot_time), return_indices=True
    )
    assert len(trend) > 5
    difference = signals.roller_azimuth[snapshot] - angle[trend]
    assert np.abs(np.angle(np.exp(1j * difference))).max() < 1e-6
    pose = blocks[3].body_pose
    inside = signals.between(3 * 0.02 + 1e-6, 4 * 0.02 + 1e-6)
    assert inside.deflection == pytest.approx(pose[:, 1, :3] - pose[:, 0, :3])


def both(signals: Signals, other: Signals) -> dict[str, QuantityError]:
    """Errors of the other one against two equal runs of the first."""
    reference = outcome(signals, (0.1, 0.5, 0.9), None)
    return {e.quantity: e for e in errors([outcome(other, (0.1, 0.5, 0.9), None)], [reference, reference])}


def part(error: QuantityError, name: str) -> float:
    return next(found.error for found in error.parts if found.name == name)


def test_errors_are_relative_to_the_reference() -> None:
    signals = steady(tone=1.0)
    other = replace(
        steady(tone=2.0),
        force=signals.force + np.array([0.0, 0.0, 400.0]),
        torque=1.1 * signals.torque,
        deflection=0.98 * signals.deflection,
        cage_speed=signals.cage_speed * [1.0, 0.99],
        roller_load=1.03 * signals.roller_load,
    )
    found = both(signals, other)
    length = math.hypot(3.0e3, 40.0e3)
    assert part(found["force"], "mean z") == pytest.approx(400.0 / length)
    assert part(found["force"], "99 %") == pytest.approx(math.hypot(3.0e3, 40.4e3) / length - 1.0)
    assert part(found["torque"], "mean") == pytest.approx(-0.1)  # more torque against the motion
    assert part(found["deflection"], "99 %") == pytest.approx(-0.02)
    assert [p.error for p in found["cage_speed"].parts] == pytest.approx([0.0, -0.01], abs=1e-12)
    assert part(found["roller_load"], "largest, mean") == pytest.approx(0.03)
    assert part(found["vibration"], "4000 Hz") == pytest.approx(20.0 * math.log10(2.0), abs=1e-3)
    assert found["fault_line"].worst is None


def test_the_distribution_error_is_the_rms_over_the_load_zone() -> None:
    signals = steady()
    offset = np.where(np.cos(signals.roller_azimuth) > 0.0, 250.0, 0.0)
    found = both(signals, replace(signals, roller_load=signals.roller_load + offset))
    half = np.pi / ROLLERS
    largest = 1.0e4 * math.sin(half) / half
    assert part(found["roller_load"], "rms over the load zone") == pytest.approx(250.0 / largest, rel=0.02)


TEMPLATE = compute_measures(steady(duration=0.3, tone=1.0), FaultLine("BPFO", 8.5))


def noisy(generator: np.random.Generator, shift: float = 0.0, windows: int = 5) -> Outcome:
    """An outcome of independent windows whose torque is shifted, in standard deviations of a window."""
    scattered = [
        tuple(
            values + 0.01 * (np.abs(values) + 1.0) * (generator.standard_normal(values.shape) + moved)
            for values, moved in zip(TEMPLATE, shifts, strict=True)
        )
        for shifts in [[shift if m.quantity == "torque" else 0.0 for m in MEASURES]] * windows
    ]
    whole = tuple(np.mean([window[i] for window in scattered], axis=0) for i in range(len(MEASURES)))
    return Outcome(whole, tuple(scattered))


def test_equal_levels_are_seldom_told_apart_and_different_ones_are() -> None:
    generator = np.random.default_rng(11)
    trials, told_apart, found = 200, {"vibration": 0, "torque": 0, "force": 0}, 0
    for _ in range(trials):
        reference = [noisy(generator) for _ in range(3)]
        for error in errors([noisy(generator)], reference):
            if error.quantity in told_apart and error.worst is not None:
                told_apart[error.quantity] += error.worst.resolved
        torque = next(e for e in errors([noisy(generator, 4.0)], reference) if e.quantity == "torque")
        found += torque.worst is not None and torque.worst.resolved
    # 5 % by definition; the larger of two variances makes it less, 200 trials leave 5 +- 3 %
    assert max(told_apart.values()) <= 0.09 * trials
    assert min(told_apart.values()) > 0
    assert found > 0.95 * trials
