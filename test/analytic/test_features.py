"""Envelope, order tracking, spectrum and line search against signals whose answer is known."""

import numpy as np
import pytest

from beardyn_core.monitor.features import (
    analytic_band,
    envelope,
    kurtosis,
    line_at,
    local_background,
    order_spectrum,
    resample_by_angle,
)

RATE = 25_600.0
TIME = np.arange(25_600) / RATE


def test_band_pass_keeps_the_inside_and_removes_the_outside():
    inside = np.cos(2 * np.pi * 4000 * TIME)
    outside = np.cos(2 * np.pi * 1900 * TIME) + np.cos(2 * np.pi * 10_100 * TIME) + 9.81
    passed = analytic_band(inside + outside, RATE, (2000.0, 10_000.0))
    assert np.allclose(passed.real, inside, atol=1e-10)
    assert np.allclose(passed.imag, np.sin(2 * np.pi * 4000 * TIME), atol=1e-10)


def test_envelope_is_the_modulation_of_the_carrier():
    modulation = 1.0 + 0.5 * np.cos(2 * np.pi * 140 * TIME)
    one = envelope(3.0 * modulation * np.cos(2 * np.pi * 5000 * TIME), RATE, (2000.0, 10_000.0))
    assert np.allclose(one, 3.0 * modulation, atol=1e-9)


def test_envelope_of_several_axes_is_the_root_of_the_sum_of_squares():
    carrier = np.cos(2 * np.pi * 5000 * TIME)
    axes = np.column_stack([3.0 * carrier, np.zeros_like(carrier), 4.0 * carrier])
    assert np.allclose(envelope(axes, RATE, (2000.0, 10_000.0)), 5.0, atol=1e-9)


def test_order_tracking_turns_a_chirp_into_one_line():
    speed = 15.0 + 10.0 * TIME  # shaft, revolutions per second
    revolutions = 15.0 * TIME + 5.0 * TIME**2
    signal = 2.0 * np.cos(2 * np.pi * 7.29 * revolutions)
    tracked = resample_by_angle(signal, 2 * np.pi * revolutions, 512)
    spectrum = order_spectrum(tracked, 512, 60.0, 3.0)
    order, level = line_at(spectrum, 7.3, 0.1)
    assert order == pytest.approx(7.29, abs=0.002)
    assert level > 60.0
    # mean over an angle step: sinc(7.29 / 512) is 0.9997
    assert spectrum.amplitude.max() == pytest.approx(2.0, rel=0.01)
    fixed = order_spectrum(signal, int(RATE / speed.mean()), 60.0, 3.0)
    assert fixed.amplitude.max() < 0.5


def test_resampling_keeps_the_mean_over_angle():
    angle = 2 * np.pi * (3.0 * TIME + TIME**2)
    signal = np.sin(40 * TIME) + 2.0
    tracked = resample_by_angle(signal, angle, 64)
    whole = int(np.floor(angle[-1] / (2 * np.pi / 64)))
    assert len(tracked) == whole
    inside = angle <= whole * 2 * np.pi / 64
    mean = (
        np.sum(0.5 * (signal[1:] + signal[:-1])[inside[1:]] * np.diff(angle)[inside[1:]]) / angle[inside][-1]
    )
    assert tracked.mean() == pytest.approx(mean, rel=1e-3)


def test_amplitude_spectrum_is_one_sided_and_the_mean_does_not_leak():
    angle = np.arange(64 * 100) / 64
    spectrum = order_spectrum(1e4 + 3.0 * np.cos(2 * np.pi * 5.0 * angle), 64, 20.0, 3.0)
    assert line_at(spectrum, 5.0, 0.05)[0] == pytest.approx(5.0, abs=1e-3)
    assert spectrum.amplitude.max() == pytest.approx(3.0, rel=1e-3)
    assert spectrum.amplitude[0] < 1e-6
    assert spectrum.resolution == pytest.approx(0.01)


def test_background_is_not_lifted_by_lines_and_follows_a_slope():
    random = np.random.default_rng(1)
    slope = np.linspace(1.0, 3.0, 5000)
    amplitude = slope * random.rayleigh(1.0, 5000)
    lines = amplitude.copy()
    lines[100::250] += 100.0
    clean, dirty = local_background(amplitude, 400.0), local_background(lines, 400.0)
    # median of a Rayleigh distribution: sqrt(2 ln 2)
    assert np.allclose(clean[300:-300] / slope[300:-300], np.sqrt(2 * np.log(2)), rtol=0.2)
    assert np.allclose(dirty, clean, rtol=0.1)


def test_flank_of_a_stronger_line_outside_the_tolerance_is_no_line():
    angle = np.arange(64 * 50) / 64
    noise = np.random.default_rng(2).normal(size=len(angle))
    spectrum = order_spectrum(100 * np.cos(2 * np.pi * 7.0 * angle) + 0 * noise + 1e-3 * noise, 64, 20.0, 3.0)
    # the main lobe is two bins of 0.02 wide on both sides
    assert line_at(spectrum, 7.025, 0.015)[1] == -np.inf
    assert line_at(spectrum, 7.025, 0.03)[1] > 60.0


def test_line_outside_the_spectrum_is_not_found():
    spectrum = order_spectrum(np.random.default_rng(3).normal(size=6400), 64, 20.0, 3.0)
    assert line_at(spectrum, 30.0, 0.1) == (30.0, -np.inf)


def test_kurtosis_of_noise_is_three_and_of_impulses_is_more():
    noise = np.random.default_rng(4).normal(size=200_000)
    assert kurtosis(noise) == pytest.approx(3.0, abs=4 * np.sqrt(24 / 2e5))
    impulses = noise.copy()
    impulses[::1000] += 20.0
    assert kurtosis(impulses) > 30.0
    assert kurtosis(np.full(10, 9.81)) == 0.0
