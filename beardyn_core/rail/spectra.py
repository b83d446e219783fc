"""Power spectral densities of rail irregularity, one-sided, over the angular wavenumber."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.errors import InputError
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
# ISO 3095:2013: limit of the rail roughness in third octaves, [dB re 1 um], from 40 cm to 1 cm
_ISO_WAVELENGTH = 0.4 * 10.0 ** (-0.1 * np.arange(17))
_ISO_LEVEL = np.array(
    [17.1, 15.0, 13.0, 11.0, 9.0, 7.0, 4.9, 2.9, 0.9, -1.1, -3.2, -5.0, -5.6, -6.2, -6.8, -7.4, -8.0]
)
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


def iso_3095_density(wavenumber: Float) -> Float:
    """Compute the density at wavenumbers [rad/m] of a rail that just meets the roughness limit, vertical.

    In [m^2 / (rad/m)], zero outside `SHORT_WAVE_BAND`. The limit is a mean square per third octave of the
    wavelength; here its density is continuous, the level linear over the logarithm of the wavelength, and
    held above 40 cm.

    References
    ----------
    ISO 3095:2013, upper limit of the acoustic rail roughness of a reference track; the same figures are
    those of well-maintained rail in CNOSSOS-EU (Directive (EU) 2015/996, table G-1).
    """
    wavenumber = np.asarray(wavenumber, dtype=np.float64)
    wavelength = 2.0 * np.pi / wavenumber
    level = np.interp(-np.log(wavelength), -np.log(_ISO_WAVELENGTH), _ISO_LEVEL)
    density = 1e-12 * 10.0 ** (0.1 * level) / (THIRD_OCTAVE * wavenumber)
    inside = (wavelength >= SHORT_WAVE_BAND[0] * (1 - 1e-9)) & (wavelength <= SHORT_WAVE_BAND[1] * (1 + 1e-9))
    return np.asarray(np.where(inside, density, 0.0))


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
