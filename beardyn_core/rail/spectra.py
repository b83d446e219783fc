"""Power spectral densities of rail irregularity, one-sided, over the angular wavenumber."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.rail.table import Column, Layout, read_table
from beardyn_core.scene.excitation import DIRECTIONS, SPECTRA, VERTICAL_ONLY, Irregularity

# ERRI B176: break wavenumbers [rad/m] and roughness constants [m^2 rad/m], vertical and alignment
_GERMAN_CUTOFF = 0.8246
_GERMAN_REFERENCE = 0.0206
_GERMAN_ROUGHNESS = {"german_low": (4.032e-7, 2.119e-7), "german_high": (1.08e-6, 6.125e-7)}
# FRA line grades 1 to 6: roughness constants [cm^2 rad/m], vertical and alignment
_FRA_CUTOFF = 0.8245
_FRA_SHARE = 0.25
_FRA_ROUGHNESS = (
    (1.2107, 3.3634),
    (1.0181, 1.2107),
    (0.6816, 0.4128),
    (0.5376, 0.3027),
    (0.2095, 0.0762),
    (0.0339, 0.0339),
)
# SNCF: A / (1 + n / n0)^3 over cycles per metre, [m^3], [1/m]
_SNCF_ROUGHNESS = {"sncf_good": 308e-6 * 0.509, "sncf_bad": 308e-6 * 1.790}
_SNCF_BREAK = 0.0489
# TB/T 3352: A / f^k [mm^2 m] over cycles per metre f, one (A, k) between two breaks [1/m]
_CHINA_BREAKS = {"vertical": (0.0187, 0.0474, 0.1533), "lateral": (0.0450, 0.1234)}
_CHINA_PIECES = {
    "vertical": ((1.0544e-5, 3.3891), (3.5588e-3, 1.9271), (1.9784e-2, 1.3643), (3.9488e-4, 3.4516)),
    "lateral": ((3.9513e-3, 1.8670), (1.1047e-2, 1.5354), (7.5633e-4, 2.8171)),
}
# CNOSSOS-EU (Directive (EU) 2015/996), table G-1: roughness in third octaves of the wavelength from 2 m to
# 0.8 mm, [dB re 1 um]; those of the wheels to 0.01 dB, as in the tables of NoiseModelling 4 (Rail, 2020)
_WAVELENGTH = 0.4 * 10.0 ** (-0.1 * np.arange(-7, 28))
_LEVELS = {
    "iso_3095": (
        *(
            17.1,
            17.1,
            17.1,
            17.1,
            17.1,
            17.1,
            17.1,
            17.1,
            15.0,
            13.0,
            11.0,
            9.0,
            7.0,
            4.9,
            2.9,
            0.9,
            -1.1,
            -3.2,
        ),
        *(
            -5.0,
            -5.6,
            -6.2,
            -6.8,
            -7.4,
            -8.0,
            -8.6,
            -9.2,
            -9.8,
            -10.4,
            -11.0,
            -11.6,
            -12.2,
            -12.8,
            -13.4,
            -14.0,
        ),
        -14.0,
    ),
    "average_network": (
        *(
            35.0,
            31.0,
            28.0,
            25.0,
            23.0,
            20.0,
            17.0,
            13.5,
            10.5,
            9.0,
            6.5,
            5.5,
            5.0,
            3.5,
            2.0,
            0.1,
            -0.2,
            -0.3,
        ),
        *(-0.8, -3.0, -5.0, -7.0, -8.0, -9.0, -10.0, -12.0, -13.0, -14.0, -15.0, -16.0, -17.0, -18.0, -19.0),
        *(-19.0, -19.0),
    ),
    "cast_iron": (
        *(2.17,) * 11,
        *(
            2.37,
            0.61,
            2.61,
            5.76,
            8.78,
            11.11,
            10.96,
            9.79,
            7.49,
            5.15,
            3.02,
            1.29,
            0.17,
            -0.70,
            -1.17,
            -1.02,
        ),
        *(0.27, 0.24, 1.32, 3.10, 3.10, 3.10, 3.10, 3.10),
    ),
    "composite": (
        *(-3.95,) * 14,
        *(
            -4.34,
            -4.62,
            -4.90,
            -5.22,
            -6.31,
            -6.80,
            -7.24,
            -7.27,
            -7.27,
            -7.14,
            -6.94,
            -6.68,
            -5.99,
            -3.75,
            -2.38,
        ),
        *(-2.59, -2.46, -2.46, -2.46, -2.46, -2.46),
    ),
    "disc_brake": (
        *(-5.93,) * 9,
        *(2.32, 2.82, 2.56, 1.22, 2.06, 0.92, -0.25, -1.57, -2.85, -4.94, -7.00, -8.58, -9.32, -9.51, -10.12),
        *(-10.25, -10.33, -10.81, -10.91, -9.52, -9.52, -9.52, -9.52, -9.52, -9.52, -9.52),
    ),
}
THIRD_OCTAVE = 10.0**0.05 - 10.0**-0.05
SHORT_WAVE_BAND = (0.01, 0.5)

DENSITY_LAYOUT = Layout(
    what="a density of rail irregularity over the wavelength",
    columns=(
        Column("wavelength_m", "m"),
        Column("vertical_mm2_m", "mm2 m"),
        Column("lateral_mm2_m", "mm2 m", needed=False),
    ),
    ascending="wavelength_m",
    positive=True,
)


def spectral_density(kind: str, wavenumber: Float, direction: str = "vertical") -> Float:
    """Compute the one-sided power spectral density of a spectrum by name at wavenumbers [rad/m].

    In [m^2 / (rad/m)]: its integral over positive angular wavenumbers is the variance. The direction is
    ``vertical`` (longitudinal level) or ``lateral`` (alignment); zero where the source has none. The sources
    hold between some 2 and 200 m (SNCF 2 to 40 m); outside, their formulas go on.

    References
    ----------
    German low and high disturbance: ERRI B176. FRA line grades: Federal Railroad Administration, and
    SNCF: both as in the TTB-2D irregularity library (D. Cantero, NTNU); alignment of the FRA grades after
    Garg, Dukkipati (1984), Dynamics of railway vehicle systems. China: TB/T 3352, ballastless high-speed
    track. Taken one-sided, German low, high and FRA 6 have standard deviations of 2.86, 4.69 and 4.32 mm
    over 3 to 150 m.
    """
    if direction not in DIRECTIONS:
        raise InputError(f"irregularity: direction is {direction!r}; allowed are {', '.join(DIRECTIONS)}")
    lateral = direction == "lateral"
    wavenumber = np.asarray(wavenumber, dtype=np.float64)
    square = wavenumber**2
    if kind == "none" or (lateral and kind in VERTICAL_ONLY):
        return np.zeros_like(square)
    if kind in _GERMAN_ROUGHNESS:
        return np.asarray(
            _GERMAN_ROUGHNESS[kind][lateral]
            * _GERMAN_CUTOFF**2
            / ((square + _GERMAN_REFERENCE**2) * (square + _GERMAN_CUTOFF**2))
        )
    if kind in _SNCF_ROUGHNESS:
        cycles = wavenumber / (2.0 * np.pi)
        return np.asarray(_SNCF_ROUGHNESS[kind] / (1.0 + cycles / _SNCF_BREAK) ** 3 / (2.0 * np.pi))
    if kind == "china_ballastless":
        return _china(wavenumber / (2.0 * np.pi), direction) / (2.0 * np.pi)
    if kind in SPECTRA:
        roughness = 1e-4 * _FRA_ROUGHNESS[int(kind[-1]) - 1][lateral]
        return np.asarray(_FRA_SHARE * roughness * _FRA_CUTOFF**2 / (square * (square + _FRA_CUTOFF**2)))
    raise InputError(f"irregularity: kind is {kind!r}; spectra by name are {', '.join(SPECTRA)}")


def _china(cycles: Float, direction: str) -> Float:
    """Compute the density over cycles per metre, [m^3]."""
    pieces = np.array(_CHINA_PIECES[direction])
    piece = np.searchsorted(_CHINA_BREAKS[direction], cycles, side="right")
    return np.asarray(1e-6 * pieces[piece, 0] / cycles ** pieces[piece, 1])


def target_density(irregularity: Irregularity, wavenumber: Float, direction: str = "vertical") -> Float:
    """Compute the density of a drawn irregularity at wavenumbers [rad/m] of its band, [m^2 / (rad/m)]."""
    if irregularity.kind != "density_csv":
        return spectral_density(irregularity.kind, wavenumber, direction)
    assert irregularity.path is not None
    table = _density_table(irregularity.path)
    column = f"{direction}_mm2_m"
    if column not in table:
        return np.zeros_like(wavenumber)
    wavelength = table["wavelength_m"]
    ends = 2.0 * np.pi / wavenumber[[0, -1]] if len(wavenumber) else wavelength[[0]]
    if ends.max() > wavelength[-1] * (1 + 1e-9) or ends.min() < wavelength[0] * (1 - 1e-9):
        raise InputError(
            f"{irregularity.path}: covers {wavelength[0]:g} to {wavelength[-1]:g} m; the irregularity goes "
            f"from {ends.min():g} to {ends.max():g} m: narrow shortest and longest wavelength or extend it"
        )
    level = np.interp(np.log(2.0 * np.pi / wavenumber), np.log(wavelength), np.log(table[column]))
    return np.asarray(1e-6 * np.exp(level) / (2.0 * np.pi))


@lru_cache(maxsize=4)
def _density_table(path: Path) -> dict[str, Float]:
    return read_table(path, DENSITY_LAYOUT)


def roughness_density(level: str, wavenumber: Float) -> Float:
    """Compute the density at wavenumbers [rad/m] of a wheel or rail with a roughness level by name.

    In [m^2 / (rad/m)]. A level is a mean square per third octave of the wavelength; here its density is
    continuous, the level linear over the logarithm of the wavelength, and held beyond its ends.

    References
    ----------
    Directive (EU) 2015/996 (CNOSSOS-EU), table G-1. `iso_3095` is the upper limit of the acoustic rail
    roughness of a reference track in ISO 3095:2013.
    """
    wavenumber = np.asarray(wavenumber, dtype=np.float64)
    wavelength = 2.0 * np.pi / wavenumber
    found = np.interp(-np.log(wavelength), -np.log(_WAVELENGTH), np.array(_LEVELS[level]))
    return np.asarray(1e-12 * 10.0 ** (0.1 * found) / (THIRD_OCTAVE * wavenumber))


def iso_3095_density(wavenumber: Float) -> Float:
    """Compute the density at wavenumbers [rad/m] of a rail at the limit of ISO 3095, as `roughness_density`.

    Zero outside `SHORT_WAVE_BAND`.
    """
    wavelength = 2.0 * np.pi / np.asarray(wavenumber, dtype=np.float64)
    inside = (wavelength >= SHORT_WAVE_BAND[0] * (1 - 1e-9)) & (wavelength <= SHORT_WAVE_BAND[1] * (1 + 1e-9))
    return np.asarray(np.where(inside, roughness_density("iso_3095", wavenumber), 0.0))


def patch_gain(wavenumber: Float, patch: float) -> Float:
    """Compute the share of the amplitude of random roughness that the contact patch passes on.

    At wavenumbers [rad/m] and a length of the patch [m], 0 for a point.

    References
    ----------
    Remington (1987), Wheel/rail rolling noise I, J. Acoust. Soc. Am. 81: |H|^2 = 1 / (1 + pi/4 (k a)^3)
    with half the length a.
    """
    return np.asarray(1.0 / np.sqrt(1.0 + 0.25 * np.pi * (0.5 * patch * wavenumber) ** 3))


def wave_gain(wavenumber: float, patch: float) -> float:
    """Compute the share of a wave, its crests straight across the rail, that the contact patch passes on.

    The mean of the wave [rad/m] over the patch of the length 2 a [m], 0 for a point, weighted with the
    pressure along it, 1 - (x / a)^2.

    References
    ----------
    Johnson (1985), Contact Mechanics, section 4.2, for the pressure over an elliptic contact, here
    summed across it.
    """
    ka = 0.5 * patch * wavenumber
    if ka < 1e-3:
        return 1.0 - 0.1 * ka**2
    return float(3.0 * (np.sin(ka) - ka * np.cos(ka)) / ka**3)
