"""Roughness of wheel and rail from published levels, over the distance: waves of 4 mm to 2 m."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.rail.irregularity import RailProfile, grid_points, random_phases, spectral_lines
from beardyn_core.rail.patch import patch_gain
from beardyn_core.rail.spectra import SHORTEST_WAVE, roughness_density, spectrum_band, target_density
from beardyn_core.scene.background import Background, Roughness
from beardyn_core.scene.excitation import Irregularity

BAND = (SHORTEST_WAVE, 2.0)  # wavelengths, [m]: to the longest of the levels
_PERIOD = 512.0
_SAMPLES_PER_WAVE = 8  # images of the grid are 70 dB down where the contact patch swallows the shortest wave
_STREAMS = {"rail": 0x726F7567, "wheel": 0x74726561}


def select_roughness(irregularity: Irregularity, background: Background | None) -> tuple[Roughness, float]:
    """Select the roughness of a run, and the factor on its amplitude.

    That of the background where it has one, else that of the line under a wheel without waves.
    """
    if background is not None and background.roughness is not None:
        return background.roughness, background.amplitude_factor
    return Roughness(rail=irregularity.roughness, wheel="none"), 1.0


def roughness_height(
    roughness: Roughness, irregularity: Irregularity, turn: float, position: Float, seed: int, patch: float
) -> Float:
    """Compute the height that the roughness of rail and wheel adds under the wheel at positions [m], [m].

    The rail repeats after 512 m, the wheel after each turn; their phases are random and independent.

    Parameters
    ----------
    irregularity : Irregularity
        Of the same rail: of the rail's level counts what its spectrum lacks.
    turn : float
        Circumference of the wheel, [m].
    position : float64 array, shape [step]
        Along the track, [m].
    seed : int
        Of the phases.
    patch : float
        Length of the contact patch, [m].
    """
    height = np.zeros_like(position)
    if roughness.rail != "none":
        profile = _profile(roughness.rail, _PERIOD, [_STREAMS["rail"], seed], patch, irregularity)
        height += profile.height_at(position)
    if roughness.wheel != "none":
        height += _profile(roughness.wheel, turn, [_STREAMS["wheel"], seed], patch).height_at(position)
    return height


def _profile(
    level: str, period: float, stream: list[int], patch: float, besides: Irregularity | None = None
) -> RailProfile:
    line, wavenumber = spectral_lines(period, *BAND)
    density = roughness_density(level, wavenumber)
    if besides is not None:
        density = _lacking_density(besides, wavenumber, density)
    density = density * patch_gain(wavenumber, patch) ** 2
    points = grid_points(period, BAND[0], _SAMPLES_PER_WAVE)
    return random_phases(period, points, line, wavenumber, density, stream)


def _lacking_density(irregularity: Irregularity, wavenumber: Float, density: Float) -> Float:
    """Compute what the spectrum of an irregularity lacks against a density of roughness."""
    found = density.copy()
    if irregularity.kind not in ("csv", "none"):
        wavelength = 2.0 * np.pi / wavenumber
        shortest, longest = spectrum_band(irregularity)
        there = (wavelength >= shortest) & (wavelength <= longest)
        found[there] -= target_density(irregularity, wavenumber[there])
    return np.maximum(found, 0.0)
