"""Surface of raceways and rollers as made: the spectrum of its waves, and what of them moves a roller."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.roller_bearing import RollerBearing

# Amplitudes over those of a typical surface. That the spread is 10 dB each way is assumed.
FACTORS = {"none": 0.0, "fine": 0.3, "typical": 1.0, "coarse": 3.0}

# Power of the wavenumber with which the power of the heights falls. Assumed, between 2 (stainless steel as
# machined: Majumdar, Tien 1990, Wear 136, 313) and 3 (equal limits of vibration in three bands that are as
# wide: from memory). The pivot is a wavelength of 10 mm.
EXPONENT = 2.5
PIVOT = 100.0  # [1/m]

FIRST_ORDER = 2  # the first is no wave but a surface off its axis
SHORTEST_WAVE = 2e-4  # a tenth of it moves a roller, from 95 km/h on beyond the band of the waveforms [m]

# Wheel work of a grinding machine leaves crests along the whole width, the shorter the wave the less of it: a
# correlation length of eight wavelengths (assumed, 3 to 20 are possible), and 2 mm at least.
ALIKE_PER_WAVELENGTH = 8.0
LEAST_ALIKE = 2e-3  # [m]

HALF_CONTACT = 1.5e-4  # of a raceway contact under 9 kN [m]


@dataclass(frozen=True)
class Ground:
    """How one kind of surface leaves its machine."""

    density: A[float, "power spectral density of the heights at the pivot, one-sided, [m^3]"]
    most_alike: A[float, "correlation length along the contact that no wave exceeds, in contact lengths"]
    last_order: A[int, "up to which, from order 2, the rms of an own key is stated"]


# The densities are assumed. In a bearing of 130 mm they give a roundness of 2.9, 2.2 and 0.4 um, peak to
# valley being about four rms: 0.5 to 2 um are called good practice without a source, SKF allows needle
# rollers of grade G2 1 um.
GROUND = {
    "cup": Ground(3.0e-17, 10.0, 300),
    "cone": Ground(2.5e-17, 10.0, 300),
    # through a centreless machine, in which the phase of a wave may slip along the roller
    "roller": Ground(1.5e-17, 3.0, 60),
}


def circumference(on: str, bearing: RollerBearing) -> float:
    """Compute the mean circumference of a surface, [m]."""
    diameter = {
        "cup": bearing.pitch_diameter + bearing.roller_diameter,
        "cone": bearing.pitch_diameter - bearing.roller_diameter,
        "roller": bearing.roller_diameter,
    }[on]
    return math.pi * diameter


def height_density(on: str, wavenumber: Float) -> Float:
    """Compute the one-sided power spectral density of the heights of a typical surface as made.

    Parameters
    ----------
    on : str
        Surface, a key of `GROUND`.
    wavenumber : array
        Waves per length in the rolling direction, [1/m].

    Returns
    -------
    array
        [m^3]; its integral over the wavenumber is the mean square of the heights.

    References
    ----------
    Sayles, Thomas (1978), Surface topography as a nonstationary random process, Nature 271, 431; Majumdar,
    Tien (1990), Fractal characterization and simulation of rough surfaces, Wear 136, 313: a power law over
    all wavelengths.
    """
    return np.asarray(GROUND[on].density * (wavenumber / PIVOT) ** -EXPONENT)


def order_amplitudes(on: str, around: float, orders: Float) -> Float:
    """Compute the amplitudes of the orders of a typical surface as made, [m].

    Parameters
    ----------
    around : float
        Circumference of the surface, [m].
    orders : array
        Waves per circumference.

    Notes
    -----
    An order has the power of its band of wavenumbers, which is 1 over the circumference wide.
    """
    return np.asarray(np.sqrt(2.0 * height_density(on, orders / around) / around))


def stated_rms(on: str, around: float) -> float:
    """Compute the rms of a typical surface as made over the orders of which that of an own key is, [m]."""
    orders = np.arange(FIRST_ORDER, GROUND[on].last_order + 1, dtype=float)
    heights = order_amplitudes(on, around, orders)
    return math.sqrt(0.5 * float(heights @ heights))


def correlation_length(on: str, wavelength: Float, line: float) -> Float:
    """Compute over which length along the contact the waves of a surface are alike.

    Parameters
    ----------
    wavelength : array
        In the rolling direction, [m].
    line : float
        Length of the contact, [m].

    Returns
    -------
    array
        Length over which the correlation of the heights falls to 1/e, exponentially, [m].
    """
    return np.clip(ALIKE_PER_WAVELENGTH * wavelength, LEAST_ALIKE, GROUND[on].most_alike * line)


def mean_along(ratio: Float) -> Float:
    """Compute the rms of the mean of a random height along a line, over that of the height in a point.

    Parameters
    ----------
    ratio : array
        Correlation length over the length of the line; the correlation is exponential.

    Returns
    -------
    array
        1 for a height that is the same all along, the root of ``2 ratio`` for one that changes much quicker.
    """
    return np.asarray(np.sqrt(2.0 * ratio * (1.0 - ratio * -np.expm1(-1.0 / ratio))))


def passed_on(wavelength: Float, half_contact: float = HALF_CONTACT) -> Float:
    """Compute which part of a wave's amplitude moves the bodies of a contact of finite width.

    Parameters
    ----------
    wavelength : array
        [m].
    half_contact : float
        Half width of the contact, [m].

    Returns
    -------
    array
        1 for long waves; for short ones the envelope of a Bessel function, ``sqrt(2 / (pi k b))``.

    Notes
    -----
    Of an elastic contact that carries a given load, a small gap moves the bodies by its mean, weighted by the
    pressure under a flat rigid punch as wide as the contact (by reciprocity): for a wave that is ``J0(k b)``.
    Its zeros are at other wavelengths under every roller, therefore the envelope.

    References
    ----------
    Johnson (1985), Contact mechanics, equation 2.64: the pressure under a flat rigid punch.
    """
    turns = 2.0 * np.pi * half_contact / wavelength
    return np.asarray((1.0 + (0.5 * np.pi * turns) ** 2) ** -0.25)


def share_felt(on: str, wavelength: Float, line: float) -> Float:
    """Compute which part of a wave's amplitude moves a straight roller: its mean over the contact.

    Parameters
    ----------
    wavelength : array
        In the rolling direction, [m].
    line : float
        Length of the contact, [m].

    Returns
    -------
    array
        The share along the contact, of a wave that is not alike all along, times the share across it.
    """
    return mean_along(correlation_length(on, wavelength, line) / line) * passed_on(wavelength)
