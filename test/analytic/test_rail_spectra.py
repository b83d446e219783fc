"""Named spectra of the rail, their synthesis line by line over the band, short waves, measured rails."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.signal import welch

from beardyn_core.base.errors import InputError
from beardyn_core.rail.irregularity import RAIL_LAYOUT, irregular_height, rail_profile
from beardyn_core.rail.patch import patch_gain, wave_gain
from beardyn_core.rail.roughness import roughness_height
from beardyn_core.rail.spectra import (
    THIRD_OCTAVE,
    roughness_density,
    spectral_density,
    spectrum_band,
)
from beardyn_core.rail.table import read_table
from beardyn_core.scene.background import Roughness
from beardyn_core.scene.excitation import SPECTRA, VERTICAL_ONLY, Irregularity
from test.analytic.density_estimate import band_ratios, estimate

BOTH = [(kind, direction) for kind in SPECTRA for direction in ("vertical", "lateral")]
HAVE = [pair for pair in BOTH if pair[1] == "vertical" or pair[0] not in VERTICAL_ONLY]


def test_the_estimate_is_that_of_scipy():
    height = np.random.default_rng(1).normal(size=5000)
    wavenumber, density = estimate(height, 0.25, 512)
    cycles, expected = welch(height, fs=4.0, nperseg=512, detrend=False, window="hann")
    assert np.allclose(wavenumber, 2 * np.pi * cycles)
    assert np.allclose(2 * np.pi * density[1:-1], expected[1:-1], rtol=1e-10)


def test_the_estimate_finds_the_variance_of_waves_and_of_a_steep_spectrum():
    x = np.arange(2**16) * 0.1
    wavenumber, density = estimate(3.0 * np.sin(2 * np.pi * x / 4.0), 0.1, 2048)
    assert density.sum() * wavenumber[1] == pytest.approx(4.5, rel=1e-3)
    # noise summed up twice falls with the fourth power: the window must not leak the long waves up
    line = np.arange(2**17 + 1)
    white = np.fft.rfft(np.random.default_rng(2).normal(size=2**18))
    steep = np.fft.irfft(np.where(line >= 128, white / np.maximum(line, 1) ** 2, 0.0))
    wavenumber, density = estimate(steep, 1.0, 4096)
    inside = slice(10, 1500)
    target = wavenumber[inside] ** -4.0
    ratios = band_ratios(wavenumber[inside], density[inside], target, wavenumber[[10, 100, 400, 1400]])
    assert ratios / ratios[1] == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize(("kind", "direction"), HAVE)
def test_the_synthesised_rail_has_its_density_within_three_percent_over_the_band(kind, direction):
    profile = rail_profile(Irregularity(kind, 2.0, 150.0), 2.6e5, 3, direction)
    # the grid is twice as fine as this estimate needs
    wavenumber, density = estimate(profile.height[::2], 2.0 * profile.spacing, 2**12)
    edges = 2 * np.pi / np.array([120.0, 60.0, 30.0, 15.0, 8.0, 4.0, 2.1])
    target = spectral_density(kind, np.maximum(wavenumber, 1e-9), direction)
    assert band_ratios(wavenumber, density, target, edges) == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize(("kind", "direction"), HAVE)
def test_densities_fall_with_the_wavenumber_without_a_step(kind, direction):
    wavenumber = np.geomspace(2 * np.pi / 200, 2 * np.pi / 0.1, 4001)
    density = spectral_density(kind, wavenumber, direction)
    fall = np.diff(np.log(density)) / np.diff(np.log(wavenumber))
    # the pieces of China meet within 0.5 % of the density
    assert (fall < 0.0).all()
    assert fall.min() > -5.5


def test_worse_track_has_more_of_every_wave():
    wavenumber = np.geomspace(0.03, 6.0, 50)
    grades = [spectral_density(f"fra_{grade}", wavenumber, "lateral") for grade in range(1, 7)]
    assert all((worse > better).all() for worse, better in itertools.pairwise(grades))
    assert (spectral_density("sncf_bad", wavenumber) > spectral_density("sncf_good", wavenumber)).all()
    slab = spectral_density("china_ballastless", wavenumber)
    assert (slab < spectral_density("german_low", wavenumber)).all()


def test_alignment_is_another_profile_of_the_same_seed():
    irregularity = Irregularity("german_low", 1.0, 150.0)
    vertical, lateral = (rail_profile(irregularity, 100.0, 4, way) for way in ("vertical", "lateral"))
    assert abs(np.corrcoef(vertical.height, lateral.height)[0, 1]) < 0.1
    again = rail_profile(irregularity, 3000.0, 4, "lateral")
    assert np.array_equal(lateral.height, again.height)
    for kind in VERTICAL_ONLY:
        assert not rail_profile(Irregularity(kind), 100.0, 4, "lateral").height.any()


def test_the_roughness_limit_has_its_level_in_each_third_octave():
    for wavelength, level in ((0.2, 11.0), (0.1, 4.9), (0.05, -1.1), (0.025, -5.6), (0.0125, -7.4)):
        centre = 0.4 * 10 ** (0.1 * np.round(10 * np.log10(wavelength / 0.4)))
        low, high = 2 * np.pi / centre * 10 ** np.array([-0.05, 0.05])
        square, _ = quad(lambda k: float(roughness_density("iso_3095", np.array(k))), low, high)
        assert 10 * np.log10(square / 1e-12) == pytest.approx(level, abs=0.15)
    assert pytest.approx(0.2307, abs=1e-4) == THIRD_OCTAVE


def test_short_waves_fill_the_rail_up_to_the_limit_and_no_further():
    irregularity = Irregularity("german_low", 0.1, 150.0)
    spacing = 512.0 / 2**20
    position = np.asarray(np.arange(2**20) * spacing, dtype=np.float64)
    longer = rail_profile(irregularity, 100.0, 5).height_at(position)
    finer = roughness_height(Roughness("iso_3095", "none"), irregularity, 2.9, position, 5, 0.0)
    wavenumber, density = estimate(longer + finer, spacing, 2**15)
    edges = 2 * np.pi / np.array([0.45, 0.25, 0.12, 0.06, 0.03, 0.0125])
    within = np.where(
        wavenumber <= 2 * np.pi / 0.1, spectral_density("german_low", np.maximum(wavenumber, 1)), 0
    )
    target = np.maximum(within, roughness_density("iso_3095", np.maximum(wavenumber, 1e-3)))
    # interpolation between the points of the long waves adds less than a percent
    assert band_ratios(wavenumber, density, target, edges) == pytest.approx(1.0, abs=0.05)


def test_the_patch_smooths_waves_that_are_not_much_longer():
    # a wave as long as the patch is all but lost, one of ten patches all but kept
    assert abs(wave_gain(2 * np.pi / 0.012, 0.012)) < 0.35
    assert wave_gain(2 * np.pi / 0.12, 0.012) == pytest.approx(0.99, abs=0.005)
    assert wave_gain(1e-3, 0.012) == pytest.approx(wave_gain(2e-3 / 0.012, 0.012), abs=1e-6)
    assert wave_gain(100.0, 0.0) == 1.0
    # against the mean of a wave over the patch
    x = np.linspace(-0.006, 0.006, 20_001)
    weight = 1.0 - (x / 0.006) ** 2
    mean = np.sum(weight * np.cos(2 * np.pi * x / 0.03)) / weight.sum()
    assert wave_gain(2 * np.pi / 0.03, 0.012) == pytest.approx(mean, rel=1e-4)
    # random roughness: half the power where k a = (4 / pi)^(1/3)
    half = (4 / np.pi) ** (1 / 3) / 0.006
    assert patch_gain(np.array([half]), 0.012)[0] ** 2 == pytest.approx(0.5, rel=1e-9)
    position = np.asarray(np.arange(2**20) * (512.0 / 2**20), dtype=np.float64)
    rough = Roughness("iso_3095", "none")
    heights = [
        roughness_height(rough, Irregularity("none"), 2.9, position, 1, patch) for patch in (0.0, 0.012)
    ]
    before, after = (np.abs(np.fft.rfft(height))[1100:50_000:1000] for height in heights)
    ratio = after / before
    wavenumber = np.asarray(np.arange(1100, 50_000, 1000) * (2 * np.pi / 512.0), np.float64)
    assert ratio == pytest.approx(patch_gain(wavenumber, 0.012), rel=1e-9)


def written(folder: Path, text: str) -> Path:
    path = folder / "rail.csv"
    path.write_text(text)
    return path


def test_a_measured_rail_is_met_where_it_was_measured(tmp_path):
    x = np.arange(0, 60.001, 0.25)
    vertical, lateral = 2.0 * np.sin(2 * np.pi * x / 12.0), np.cos(2 * np.pi * x / 20.0)
    rows = "\n".join(f"{100 + a:.2f},{v:.6f},{w:.6f}" for a, v, w in zip(x, vertical, lateral, strict=True))
    path = written(tmp_path, f"# measured\ndistance_m,vertical_mm,lateral_mm\nm,mm,mm\n{rows}\n")
    irregularity = Irregularity("csv", path=path)
    position = np.linspace(0.3, 59.7, 500)
    height = irregular_height(irregularity, position, 1, 0.012)
    assert np.allclose(height, 2e-3 * np.sin(2 * np.pi * position / 12.0), rtol=0, atol=2e-5)
    aside = rail_profile(irregularity, 59.0, 1, "lateral").height_at(position)
    assert np.allclose(aside, 1e-3 * np.cos(2 * np.pi * position / 20.0), rtol=0, atol=2e-5)
    assert irregularity.roughness == "none"
    with pytest.raises(InputError, match=r"covers 60 m; the run needs 200 m"):
        rail_profile(irregularity, 200.0, 1)
    with pytest.raises(InputError, match="goes back 3 m behind its start"):
        irregular_height(irregularity, np.array([0.0, 5.0, -3.0]), 1, 0.0)


def test_a_fine_measured_rail_is_averaged_over_the_patch(tmp_path):
    x = np.arange(0, 2.0001, 0.001)
    rows = "\n".join(f"{a:.3f},{0.05 * np.sin(2 * np.pi * a / 0.03):.8f}" for a in x)
    irregularity = Irregularity("csv", path=written(tmp_path, f"distance_m,vertical_mm\n{rows}\n"))
    position = np.linspace(0.5, 1.5, 3000)
    ratio = irregular_height(irregularity, position, 1, 0.012).std() / 0.05e-3 * np.sqrt(2)
    assert ratio == pytest.approx(wave_gain(2 * np.pi / 0.03, 0.012), rel=0.01)


def test_a_density_of_a_table_is_met(tmp_path):
    wavelength = np.geomspace(1.0, 200.0, 40)
    density = 1e6 * 2 * np.pi * spectral_density("german_high", 2 * np.pi / wavelength)
    rows = "\n".join(f"{a:.8g},{s:.8g}" for a, s in zip(wavelength, density, strict=True))
    path = written(tmp_path, f"wavelength_m,vertical_mm2_m\n{rows}\n")
    drawn = rail_profile(Irregularity("density_csv", 2.0, 100.0, path=path), 100.0, 1)
    named = rail_profile(Irregularity("german_high", 2.0, 100.0), 100.0, 1)
    assert np.std(drawn.height) == pytest.approx(np.std(named.height), rel=0.01)
    assert np.corrcoef(drawn.height, named.height)[0, 1] > 0.999
    assert not rail_profile(
        Irregularity("density_csv", 2.0, 100.0, path=path), 100.0, 1, "lateral"
    ).height.any()
    with pytest.raises(InputError, match=r"covers 1 to 200 m; the irregularity goes from 0\.1"):
        rail_profile(Irregularity("density_csv", 0.1, 100.0, path=path), 100.0, 1)


def test_a_density_of_a_table_is_taken_to_its_own_ends(tmp_path):
    path = written(tmp_path, "wavelength_m,vertical_mm2_m\n0.1,1e-3\n1,0.1\n40,10\n")
    whole = Irregularity("density_csv", path=path)
    assert spectrum_band(whole) == (0.1, 40.0)
    assert spectrum_band(Irregularity("density_csv", 0.5, path=path)) == (0.5, 40.0)
    profile = rail_profile(whole, 100.0, 1)
    amplitude = np.abs(np.fft.rfft(profile.height))
    wavelength = profile.period / np.maximum(np.arange(len(amplitude)), 1)
    there = (wavelength >= 0.1) & (wavelength <= 40.0)
    assert amplitude[there].min() > 1e6 * amplitude[~there].max()
    # what the file has is not added once more by the roughness of the line
    rough = Roughness(rail="average_network", wheel="none")
    position = np.linspace(0.0, 400.0, 200_001)
    height = roughness_height(rough, whole, 2.9, position, 1, 0.0)
    power = np.abs(np.fft.rfft(height * np.hanning(len(height)))) ** 2
    cycles = np.fft.rfftfreq(len(height), position[1])
    inside, below = (cycles > 0.6) & (cycles < 9.0), (cycles > 11.0) & (cycles < 20.0)
    assert power[inside].max() < 1e-3 * power[below].max()


@pytest.mark.parametrize("band", [{"shortest_wavelength": 45.0}, {"longest_wavelength": 1.0}])
def test_a_band_that_the_ends_of_a_file_turn_round_is_refused(tmp_path, band):
    path = written(tmp_path, "wavelength_m,vertical_mm2_m\n3,1\n40,10\n")
    with pytest.raises(InputError, match="covers 3 to 40 m; it would be taken from"):
        rail_profile(Irregularity("density_csv", path=path, **band), 100.0, 1)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["the file is empty", "distance_m, vertical_mm, lateral_mm"]),
        ("distance_m,vertical_mm\n", ["no rows"]),
        ("distance_m,vertical_mm\n0,1\n", ["only one row"]),
        ("distance_m,vertical_m\n0,0\n1,0\n", ["unknown column 'vertical_m'; did you mean vertical_mm?"]),
        ("distance_m,vertical_mm\n0,0\n1,nan\n", ["line 3: vertical_mm is nan"]),
        (
            "distance_m,vertical_mm\nm,um\n0,0\n1,1\n",
            ["line 2: the row of units has 'um' for vertical_mm", "'mm'"],
        ),
        ("distance_m,vertical_mm\n0,0\n2,0\n1,0\n", ["line 4: distance_m does not increase"]),
        (
            "distance_m,vertical_mm\n" + "".join(f"{x / 4},0\n" for x in (*range(20), 60, 61)),
            ["line 22: distance_m jumps by 10.25 m", "usual step is 0.25 m"],
        ),
    ],
)
def test_a_bad_measured_rail_is_refused_in_a_sentence(tmp_path, text, words):
    with pytest.raises(InputError) as caught:
        read_table(written(tmp_path, text), RAIL_LAYOUT)
    for word in ["rail.csv", *words]:
        assert word in str(caught.value)


def test_everything_wrong_with_a_measured_rail_is_told_at_once(tmp_path):
    text = "distance_m,vertical_mm,gauge_mm\nm,um,mm\n0,0,0\n1,x,0\n1,0,0\n2,inf,0\n3,0\n"
    with pytest.raises(InputError) as caught:
        read_table(written(tmp_path, text), RAIL_LAYOUT)
    found = "\n".join(caught.value.problems)
    for words in ("'gauge_mm'", "has 'um'", "line 4: vertical_mm is 'x'", "line 5: distance_m does not",
                  "line 6: vertical_mm is inf", "line 7: not 3 values"):  # fmt: skip
        assert words in found
    assert len(caught.value.problems) == 6


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"kind": "csv"}, "needs the path"),
        ({"kind": "fra_7"}, "allowed are german_low"),
        ({"path": Path("rail.csv")}, "it goes with kind 'csv' or 'density_csv'"),
        ({"short_waves": "smooth"}, "allowed are good, iso_3095"),
    ],
)
def test_an_irregularity_that_cannot_be_is_refused(options, words):
    with pytest.raises(InputError, match=words):
        Irregularity(**options)
    with pytest.raises(InputError, match="direction is 'along'"):
        spectral_density("fra_6", np.ones(1), "along")
