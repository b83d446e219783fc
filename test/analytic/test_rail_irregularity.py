"""The synthesised rail has the spectrum, the variance and the slope it was asked for."""

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import welch

from beardyn_core.base.errors import InputError
from beardyn_core.rail.irregularity import rail_profile
from beardyn_core.rail.spectra import spectral_density
from beardyn_core.scene.operation import Irregularity


@pytest.mark.parametrize("kind", ["german_low", "german_high", "fra_6"])
def test_variance_of_the_profile_is_the_integral_of_the_density(kind):
    profile = rail_profile(Irregularity(kind, 3.0, 150.0), 1.0e5, seed=3)
    variance, _ = quad(lambda k: float(spectral_density(kind, np.array(k))), 2 * np.pi / 150, 2 * np.pi / 3)
    assert np.mean(profile.height**2) == pytest.approx(variance, rel=0.005)


def test_welch_estimate_of_the_profile_is_the_one_sided_density():
    profile = rail_profile(Irregularity("german_low", 0.5, 150.0), 2.0e5, seed=5)
    per_cycle, density = welch(
        profile.height, fs=1.0 / profile.spacing, nperseg=2**14, detrend=False, window="hann"
    )
    wavenumber = 2 * np.pi * per_cycle
    inside = (wavenumber > 2 * np.pi / 60.0) & (wavenumber < 2 * np.pi / 0.6)
    ratio = density[inside] / (2 * np.pi) / spectral_density("german_low", wavenumber[inside])
    # some 250 half-overlapping segments: 6 % scatter of a line
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.02)
    assert np.percentile(np.abs(ratio - 1.0), 95) < 0.2


def test_an_evenly_measured_rail_leaves_no_images_of_its_spacing(tmp_path):
    """Cubics through the points alone leave one 44 dB down of a wave of eight of them."""
    along, length = np.arange(1601) * 0.25, 2.0
    rows = [f"{x:.2f},{np.sin(2.0 * np.pi * x / length):.12g}" for x in along]
    path = tmp_path / "rail.csv"
    path.write_text("\n".join(["distance_m,vertical_mm", *rows]) + "\n")
    profile = rail_profile(Irregularity("csv", path=path), 390.0, seed=1)
    position = 20.0 + np.arange(180 * 512) / 512.0 * length
    height = 1e3 * profile.height_at(position)
    amplitude = 2.0 * np.abs(np.fft.rfft(height)) / len(height)
    assert amplitude[180] == pytest.approx(1.0, rel=1e-3)
    assert np.delete(amplitude, 180).max() < 1e-4


def test_nothing_is_outside_the_wavelength_band():
    profile = rail_profile(Irregularity("german_low", 1.0, 30.0), 1000.0, seed=1)
    wavelength = profile.period / np.arange(1, len(profile.height) // 2 + 1)
    amplitude = np.abs(np.fft.rfft(profile.height))[1:]
    outside = (wavelength < 0.999) | (wavelength > 30.03)
    assert amplitude[outside].max() < 1e-9 * amplitude.max()


def test_slope_is_the_derivative_of_the_height():
    profile = rail_profile(Irregularity("german_high", 0.1, 150.0), 100.0, seed=2)
    grid = np.arange(1000) * profile.spacing
    step = 1e-7
    for side in (-step, step):  # from both sides: no kinks between the cells
        difference = (profile.height_at(grid + side) - profile.height_at(grid)) / side
        assert np.max(np.abs(difference - profile.slope[:1000])) < 1e-4 * np.std(profile.slope)
    assert np.allclose(profile.height_at(grid), profile.height[:1000], rtol=0, atol=1e-12)


def test_between_grid_points_the_profile_is_the_sum_of_its_cosines():
    irregularity = Irregularity("german_low", 2.0, 20.0)
    profile = rail_profile(irregularity, 100.0, seed=7)
    spectrum = np.fft.rfft(profile.height) / len(profile.height)
    position = np.linspace(3.0, 11.0, 97)
    line = np.arange(1, 3000)
    phase = 2 * np.pi * np.outer(position, line) / profile.period
    exact = 2 * np.real(np.exp(1j * phase) @ spectrum[1:3000])
    # cubic Hermite interpolation errs by at most h^4 f'''' / 384
    curvature = 2 * np.sum(np.abs(spectrum[1:3000]) * (2 * np.pi * line / profile.period) ** 4)
    assert np.max(np.abs(profile.height_at(position) - exact)) < profile.spacing**4 * curvature / 384


def test_a_longer_run_sees_the_same_rail():
    short = rail_profile(Irregularity(), 100.0, seed=4)
    longer = rail_profile(Irregularity(), 4000.0, seed=4)
    other = rail_profile(Irregularity(), 100.0, seed=5)
    assert np.array_equal(short.height, longer.height)
    assert not np.allclose(short.height, other.height)


def test_unknown_kind_and_empty_band_are_refused_together():
    with pytest.raises(InputError) as caught:
        Irregularity("smooth", 20.0, 10.0)
    assert len(caught.value.problems) == 2
    assert "german_low" in str(caught.value)
