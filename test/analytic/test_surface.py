"""Surfaces as made: their spectrum, what a contact feels of them, and what their words scale."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.choice import load_scene
from beardyn_core.scene.scatter import Scatter
from beardyn_core.scene.surface import (
    FACTORS,
    GROUND,
    circumference,
    correlation_length,
    height_density,
    mean_along,
    order_amplitudes,
    passed_on,
    share_felt,
    stated_rms,
)

BEARING = load_scene("static_80kN").bearing
LINE = BEARING.effective_length


def spectrum(gap: Float, length: float) -> tuple[Float, Float]:
    """One-sided power spectral density [m^3] of one turn from order 2 on, and its wavenumbers [1/m]."""
    lines = np.abs(np.fft.rfft(gap))[2:-1] / len(gap)
    return np.arange(2, len(lines) + 2) / length, 2.0 * lines**2 * length


@pytest.mark.parametrize("on", GROUND)
def test_the_density_of_a_made_surface_is_the_law_times_the_share_that_is_felt(on: str) -> None:
    around = circumference(on, BEARING)
    wave = next(wave for wave in Scatter("G2", 9).waves(BEARING) if wave.on == on)
    azimuth = np.linspace(0.0, 2.0 * np.pi, 3 * wave.orders[-1], endpoint=False)
    wavenumber, density = spectrum(wave.gap(azimuth), around)
    made = slice(0, len(wave.orders))
    felt = share_felt(on, 1.0 / wavenumber[made], LINE)
    np.testing.assert_allclose(density[made], height_density(on, wavenumber[made]) * felt**2, rtol=1e-6)
    # nothing beyond
    assert density[made.stop :].max() < 1e-6 * density[made][-1]
    assert 1.0 / wavenumber[made.stop - 1] == pytest.approx(2e-4, rel=3e-3)


@pytest.mark.parametrize("on", GROUND)
def test_the_orders_have_the_mean_square_that_the_density_integrates_to(on: str) -> None:
    """Orders stand in the middle of their bands; the density bends by 0.1 % over one from order 20 on."""
    around, orders = circumference(on, BEARING), np.arange(20.0, 300.0)
    edges = (np.array([orders[0], orders[-1] + 1.0]) - 0.5) / around
    fine = np.geomspace(edges[0], edges[1], 10_001)
    power = np.trapezoid(height_density(on, fine), fine)
    assert 0.5 * np.sum(order_amplitudes(on, around, orders) ** 2) == pytest.approx(power, rel=2e-3)


@pytest.mark.parametrize("ratio", [0.04, 0.3, 1.0, 10.0])
def test_the_mean_along_a_line_is_that_of_random_heights_on_a_grid(ratio: float) -> None:
    """A field whose correlation falls exponentially is a walk that forgets; 20 000 lines are good to 1 %."""
    points, lines = 800, 20_000
    chance = np.random.default_rng(5)
    kept = np.exp(-1.0 / (ratio * points))
    height = chance.standard_normal(lines)
    total = np.zeros(lines)
    for _ in range(points):
        total += height
        height = kept * height + np.sqrt(1.0 - kept**2) * chance.standard_normal(lines)
    rms = np.sqrt(np.mean((total / points) ** 2))
    assert mean_along(np.array(ratio)) == pytest.approx(rms, rel=0.02)


def test_waves_are_alike_over_eight_of_their_lengths_between_two_limits() -> None:
    lengths = np.array([1e-4, 2.5e-4, 1e-3, 1.0])
    for on, longest in (("cup", 10.0 * LINE), ("cone", 10.0 * LINE), ("roller", 3.0 * LINE)):
        np.testing.assert_allclose(correlation_length(on, lengths, LINE), [2e-3, 2e-3, 8e-3, longest])
    along = mean_along(np.array([0.04, 0.16, 3.0, 10.0]))
    for on, longest in (("cup", along[3]), ("roller", along[2])):
        shares = np.array([along[0], along[0], along[1], longest])
        np.testing.assert_allclose(share_felt(on, lengths, LINE), shares * passed_on(lengths))


def test_a_contact_passes_on_the_mean_of_a_wave_under_the_pressure_of_a_flat_punch() -> None:
    """The envelope lies on the Bessel function where that is largest, and on 1 where waves are long."""
    half, place = 1.5e-4, np.cos((np.arange(4000) + 0.5) / 4000 * np.pi)  # even under that pressure
    lengths = 2.0 * np.pi * half / np.linspace(0.05, 40.0, 4000)
    means = np.abs(np.cos(np.outer(2.0 * np.pi * half / lengths, place)).mean(axis=1))
    envelope = passed_on(lengths, half)
    peaks = np.flatnonzero((means[1:-1] > means[:-2]) & (means[1:-1] > means[2:])) + 1
    np.testing.assert_allclose(envelope[peaks[1:]], means[peaks[1:]], rtol=0.02)
    assert envelope[0] == pytest.approx(means[0], rel=2e-3)


@pytest.mark.parametrize("surface", ["fine", "coarse"])
def test_a_surface_scales_every_wave_and_moves_no_phase(surface: str) -> None:
    found, typical = (Scatter("G1", 9, each).waves(BEARING) for each in (surface, "typical"))
    for one, other in zip(found, typical, strict=True):
        np.testing.assert_allclose(one.amplitudes, FACTORS[surface] * np.array(other.amplitudes), rtol=1e-12)
        assert replace(one, amplitudes=other.amplitudes) == other


@pytest.mark.parametrize("grade", ["G1", "G2", "G3", "G5"])
def test_the_surface_is_typical_with_any_grade_and_none_without(grade: str) -> None:
    typical = Scatter("none", 9, "typical").waves(BEARING)
    assert Scatter(grade, 9).waves(BEARING) == typical
    assert Scatter(grade, 9, "none").waves(BEARING) == ()
    assert Scatter(seed=9).absent
    assert not Scatter(seed=9, surface="fine").absent
    assert Scatter(seed=9, surface="none").absent


def test_an_own_rms_is_that_of_the_surface_as_made() -> None:
    """Over the orders that the words of its key name, before the contact takes its mean."""
    scatter = Scatter("G1", 9, "coarse", raceway_waviness=2e-7, roller_waviness=0.0)
    waves = scatter.waves(BEARING)
    assert {wave.on for wave in waves} == {"cup", "cone"}
    for wave in waves:
        around, orders = circumference(wave.on, BEARING), np.array(wave.orders[:299], dtype=float)
        heights = np.array(wave.amplitudes[:299]) / share_felt(wave.on, around / orders, LINE)
        assert orders[-1] == GROUND[wave.on].last_order == 300
        assert np.sqrt(0.5 * heights @ heights) == pytest.approx(2e-7, rel=1e-9)
        assert scatter.surface_factor(wave.on, BEARING) == pytest.approx(2e-7 / stated_rms(wave.on, around))
