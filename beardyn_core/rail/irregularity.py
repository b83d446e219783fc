"""Vertical irregularity of the rail: power spectral densities and random-phase profiles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beardyn_core.errors import InputError
from beardyn_core.scene.operation import IRREGULARITY_KINDS, Irregularity

Float = NDArray[np.float64]

# ERRI B176: break wavenumbers [rad/m] and roughness constants [m^2 rad/m]
_GERMAN_CUTOFF = 0.8246
_GERMAN_REFERENCE = 0.0206
_GERMAN_ROUGHNESS = {"german_low": 4.032e-7, "german_high": 1.08e-6}
# FRA class 6
_FRA_CUTOFF = 0.8245
_FRA_SHARE = 0.25
_FRA_6_ROUGHNESS = 0.0339e-4
# density of the alignment over that of the vertical profile
_ALIGNMENT = {"german_low": 2.119 / 4.032, "german_high": 6.125 / 10.8, "fra_6": 1.0}

_SHORTEST_PERIOD = 4096.0
_SAMPLES_PER_WAVE = 8
_STREAM = 0x7261696C  # keeps the rail's random numbers apart from those of the sensors


def spectral_density(kind: str, wavenumber: Float) -> Float:
    """One-sided power spectral density of the vertical profile.

    Its integral over positive angular wavenumbers is the variance.

    Parameters
    ----------
    kind : str
        One of `scene.operation.IRREGULARITY_KINDS`.
    wavenumber : float64 array
        Angular wavenumber, positive, [rad/m].

    Returns
    -------
    float64 array
        [m^2 / (rad/m)].

    References
    ----------
    German low and high disturbance: ERRI B176. FRA class 6: Federal Railroad Administration, as in the
    TTB-2D irregularity library (D. Cantero, NTNU). Taken one-sided, the standard deviations over
    3 to 150 m are 2.86, 4.69 and 4.32 mm.
    """
    square = np.asarray(wavenumber, dtype=np.float64) ** 2
    if kind in _GERMAN_ROUGHNESS:
        return (
            _GERMAN_ROUGHNESS[kind]
            * _GERMAN_CUTOFF**2
            / ((square + _GERMAN_REFERENCE**2) * (square + _GERMAN_CUTOFF**2))
        )
    if kind == "fra_6":
        return _FRA_SHARE * _FRA_6_ROUGHNESS * _FRA_CUTOFF**2 / (square * (square + _FRA_CUTOFF**2))
    if kind == "none":
        return np.zeros_like(square)
    raise InputError(f"irregularity: kind is {kind!r}; allowed are {', '.join(IRREGULARITY_KINDS)}")


@dataclass(frozen=True)
class RailProfile:
    """A periodic profile of the rail on a uniform grid, with its exact first derivative.

    Parameters
    ----------
    spacing : float
        Between grid points, [m].
    height : float64 array, shape [point]
        Upwards, [m].
    slope : float64 array, shape [point]
        First derivative along the track, [-].
    """

    spacing: float
    height: Float
    slope: Float

    @property
    def period(self) -> float:
        """Length after which the profile repeats, [m]."""
        return self.spacing * len(self.height)

    def height_at(self, position: ArrayLike) -> Float:
        """Height by cubic Hermite interpolation, continuous with its slope.

        Parameters
        ----------
        position : float64 array, [m]

        Returns
        -------
        float64 array, [m]
        """
        scaled = np.asarray(position, dtype=np.float64) / self.spacing
        cell = np.floor(scaled)
        s = scaled - cell
        left = cell.astype(np.int64) % len(self.height)
        right = (left + 1) % len(self.height)
        rise = self.height[right] - self.height[left]
        entry = self.slope[left] * self.spacing - rise
        leave = rise - self.slope[right] * self.spacing
        return self.height[left] + s * (rise + (1.0 - s) * ((1.0 - s) * entry + s * leave))

    def slope_at(self, position: ArrayLike) -> Float:
        """First derivative of `height_at`.

        Parameters
        ----------
        position : float64 array, [m]

        Returns
        -------
        float64 array, [-]
        """
        scaled = np.asarray(position, dtype=np.float64) / self.spacing
        cell = np.floor(scaled)
        s = scaled - cell
        left = cell.astype(np.int64) % len(self.height)
        right = (left + 1) % len(self.height)
        rise = self.height[right] - self.height[left]
        entry = self.slope[left] * self.spacing - rise
        leave = rise - self.slope[right] * self.spacing
        return (rise + (1.0 - s) * (1.0 - 3.0 * s) * entry + s * (2.0 - 3.0 * s) * leave) / self.spacing


def rail_profile(
    irregularity: Irregularity, distance: float, seed: int, direction: str = "vertical"
) -> RailProfile:
    """Random-phase profile at least as long as the run.

    Every spectral line in the wavelength band gets the amplitude sqrt(2 S dOmega) and a random phase.
    The period is 4096 m times a power of two, so all runs shorter than that see the same rail for
    the same seed, however long they last.

    Parameters
    ----------
    irregularity : Irregularity
    distance : float
        Length of the run, [m].
    seed : int
    direction : str
        ``vertical``, upwards, or ``lateral``, the alignment, along +y.

    Returns
    -------
    RailProfile
    """
    period = _SHORTEST_PERIOD
    while period < distance:
        period *= 2.0
    points = 2 ** int(np.ceil(np.log2(period * _SAMPLES_PER_WAVE / irregularity.shortest_wavelength)))
    spacing = period / points
    if irregularity.kind == "none":
        return RailProfile(spacing, np.zeros(points), np.zeros(points))
    first = int(np.ceil(period / irregularity.longest_wavelength))
    last = int(np.floor(period / irregularity.shortest_wavelength))
    line = np.arange(first, last + 1)
    step = 2.0 * np.pi / period
    wavenumber: Float = np.asarray(line * step, dtype=np.float64)
    density = spectral_density(irregularity.kind, wavenumber)
    stream = [_STREAM, seed]
    if direction == "lateral":
        density = density * _ALIGNMENT[irregularity.kind]
        stream.append(1)
    amplitude = np.sqrt(2.0 * density * step)
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(stream)))
    phase = random.uniform(0.0, 2.0 * np.pi, len(line))
    spectrum = np.zeros(points // 2 + 1, dtype=np.complex128)
    spectrum[line] = 0.5 * points * amplitude * np.exp(1j * phase)
    height = np.fft.irfft(spectrum, points)
    spectrum[line] *= 1j * wavenumber
    return RailProfile(spacing, height, np.fft.irfft(spectrum, points))
