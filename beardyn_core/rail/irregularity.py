"""Irregularity of the rail over the distance: random-phase or measured profiles, vertical and lateral."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import ArrayLike, NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.rail.patch import patch_gain
from beardyn_core.rail.spectra import spectrum_band, target_density
from beardyn_core.rail.table import Column, Layout, read_table
from beardyn_core.scene.chord_polynomials import refine_series
from beardyn_core.scene.excitation import Irregularity
from beardyn_core.scene.load import LOOK_AHEAD, UNEVENNESS

_SHORTEST_PERIOD = 4096.0
_SAMPLES_PER_WAVE = 16  # of the shortest wave: images of the grid are 95 dB down
_STREAM = 0x7261696C  # keeps the rail's random numbers apart from those of the sensors
_LATERAL = 1  # which the alignment adds to the stream of the same seed

RAIL_LAYOUT = Layout(
    what="rail irregularity over the distance",
    columns=(
        Column("distance_m", "m"),
        Column("vertical_mm", "mm"),
        Column("lateral_mm", "mm", needed=False),
    ),
    ascending="distance_m",
    gap=(5.0, 0.2),
)
_MOST_POINTS = 2**23
_FINER = 16  # grid of an evenly measured rail: images of its own spacing are 80 dB down


@dataclass(frozen=True)
class RailProfile:
    """A periodic profile of the rail on a uniform grid, with its exact first derivative."""

    spacing: A[float, "between grid points, [m]"]
    height: A[Float, "shape [point], upwards, [m]"]
    slope: A[Float, "shape [point], first derivative along the track, [-]"]

    @property
    def period(self) -> float:
        """Length after which the profile repeats, [m]."""
        return self.spacing * len(self.height)

    def height_at(self, position: ArrayLike) -> Float:
        """Interpolate the height at positions [m] by cubic Hermite polynomials, slope continuous, [m]."""
        scaled = np.asarray(position, dtype=np.float64) / self.spacing
        cell = np.floor(scaled)
        s = scaled - cell
        left = cell.astype(np.int64) % len(self.height)
        right = (left + 1) % len(self.height)
        rise = self.height[right] - self.height[left]
        entry = self.slope[left] * self.spacing - rise
        leave = rise - self.slope[right] * self.spacing
        return self.height[left] + s * (rise + (1.0 - s) * ((1.0 - s) * entry + s * leave))


def rail_profile(
    irregularity: Irregularity, distance: float, seed: int, direction: str = "vertical", patch: float = 0.0
) -> RailProfile:
    """Build a profile at least as long as the run: with random phases, or as measured.

    Every spectral line in the wavelength band gets the amplitude sqrt(2 S dOmega) and a random phase.
    The period is 4096 m times a power of two, so all runs shorter than that see the same rail for
    the same seed, however long they last.

    Parameters
    ----------
    distance : float
        Length of the run, [m].
    direction : str
        ``vertical``, upwards, or ``lateral``, the alignment, along +y; zero where the source has none.
    patch : float
        Length of the contact patch, over which the vertical profile is smoothed, [m]; 0: a point.

    Raises
    ------
    InputError
        When a file is bad, or shorter than the run.
    """
    if irregularity.kind == "csv":
        return _measured_profile(irregularity, distance, direction, patch)
    return _draw_profile(irregularity, distance, seed, direction, patch)


def irregular_height(irregularity: Irregularity, position: Float, seed: int, patch: float) -> Float:
    """Compute the vertical irregularity under the wheel at positions from the start, upwards, all in [m]."""
    if irregularity.kind == "csv" and float(np.min(position)) < 0.0:
        raise InputError(
            f"{irregularity.path}: the run goes back {-float(np.min(position)):g} m behind its start, where "
            "the file has no rail: start forwards"
        )
    # a run that turns back needs the way between its ends
    return rail_profile(irregularity, float(np.ptp(position)), seed, patch=patch).height_at(position)


def _draw_profile(
    irregularity: Irregularity, distance: float, seed: int, direction: str, patch: float
) -> RailProfile:
    period = _SHORTEST_PERIOD
    while period < distance:
        period *= 2.0
    shortest, longest = spectrum_band(irregularity)
    points = grid_points(period, shortest, _SAMPLES_PER_WAVE)
    if irregularity.kind == "none":
        return RailProfile(period / points, np.zeros(points), np.zeros(points))
    line, wavenumber = spectral_lines(period, shortest, longest)
    density = target_density(irregularity, wavenumber, direction)
    stream = [_STREAM, seed] if direction == "vertical" else [_STREAM, seed, _LATERAL]
    if direction == "vertical":
        density = density * patch_gain(wavenumber, patch) ** 2
    return random_phases(period, points, line, wavenumber, density, stream)


def grid_points(period: float, shortest: float, samples_per_wave: int) -> int:
    """Count the points of a grid with so many points on the shortest wave, a power of two."""
    return int(2 ** int(np.ceil(np.log2(period * samples_per_wave / shortest))))


def spectral_lines(period: float, shortest: float, longest: float) -> tuple[NDArray[np.int64], Float]:
    """List the spectral lines of a period within a band of wavelengths, and their angular wavenumbers."""
    line = np.arange(int(np.ceil(period / longest)), int(np.floor(period / shortest)) + 1)
    return line, np.asarray(line * (2.0 * np.pi / period), dtype=np.float64)


def random_phases(
    period: float, points: int, line: NDArray[np.int64], wavenumber: Float, density: Float, stream: list[int]
) -> RailProfile:
    """Draw a profile whose lines have a density [m^2 / (rad/m)], with random phases.

    Parameters
    ----------
    period : float
        Length after which it repeats, [m].
    points : int
        Of its grid.
    line, wavenumber, density : arrays
        See `spectral_lines`; one-sided density at each line.
    stream : list of int
        Seed.
    """
    amplitude = np.sqrt(2.0 * density * (2.0 * np.pi / period))
    random = np.random.Generator(np.random.PCG64(np.random.SeedSequence(stream)))
    phase = random.uniform(0.0, 2.0 * np.pi, len(line))
    spectrum = np.zeros(points // 2 + 1, dtype=np.complex128)
    spectrum[line] = 0.5 * points * amplitude * np.exp(1j * phase)
    height = np.fft.irfft(spectrum, points)
    spectrum[line] *= 1j * wavenumber
    return RailProfile(period / points, height, np.fft.irfft(spectrum, points))


def _measured_profile(
    irregularity: Irregularity, distance: float, direction: str, patch: float
) -> RailProfile:
    assert irregularity.path is not None
    table = read_table(irregularity.path, RAIL_LAYOUT)  # its first row is where the run starts
    along = table["distance_m"] - table["distance_m"][0]
    if along[-1] < distance - 1e-6:
        raise InputError(
            f"{irregularity.path}: covers {along[-1]:g} m; the run needs {distance:g} m: shorten the "
            "duration, go slower or give a longer file"
        )
    # the usual step, or finer where the file is
    spacing = float(max(np.min(np.diff(along)), along[-1] / _MOST_POINTS))
    grid = np.arange(int(np.floor(along[-1] / spacing + 1e-6)) + 1) * spacing
    column = f"{direction}_mm"
    if column not in table:
        return RailProfile(spacing, np.zeros(len(grid)), np.zeros(len(grid)))
    height = 1e-3 * np.interp(grid, along, table[column])
    even = np.ptp(np.diff(along)) < UNEVENNESS * spacing and len(height) > LOOK_AHEAD
    if even and _FINER * len(height) <= _MOST_POINTS:
        height, spacing = refine_series(height, _FINER), spacing / _FINER
    reach = int(0.5 * patch / spacing)
    if direction == "vertical" and reach > 0:
        weight = 1.0 - (np.arange(-reach, reach + 1) * spacing / (0.5 * patch)) ** 2
        height = np.convolve(np.pad(height, reach, mode="edge"), weight / weight.sum(), mode="valid")
    return RailProfile(spacing, height, np.gradient(height, spacing))
