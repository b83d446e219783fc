"""Power spectral densities of rail irregularity and roughness, one-sided, over the angular wavenumber."""

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
# 0.8 mm, [dB re 1 um]; those of the wheels to 0.01 dB, as in the tables of NoiseModelling 4 (Rail, 2020).
# good, smooth: SNCF, June 2021, high-speed lines and wheels with composite blocks and discs, there as well
_WAVELENGTH = 0.4 * 10.0 ** (-0.1 * np.arange(-7, 28))
_LEVELS = {
    name: np.array(levels.split(), dtype=np.float64)
    for name, levels in {
        "good": """
            11.3 10.2 9.1 7.9 6.6 5.3 4 2.8 1.5 0.2 -1 -2.3 -3.9 -4.9 -6.1
            -7.1 -7.6 -8.1 -8.6 -9.1 -9.6 -10 -10.7 -11.1 -11.6 -12.6 -13.7 -15.4 -17.8 -20
            -22.1 -24.1 -26.4 -28.3 -30.3
        """,
        "iso_3095": """
            17.1 17.1 17.1 17.1 17.1 17.1 17.1 17.1 15 13 11 9 7 4.9 2.9
            0.9 -1.1 -3.2 -5 -5.6 -6.2 -6.8 -7.4 -8 -8.6 -9.2 -9.8 -10.4 -11 -11.6
            -12.2 -12.8 -13.4 -14 -14
        """,
        "average_network": """
            35 31 28 25 23 20 17 13.5 10.5 9 6.5 5.5 5 3.5 2
            0.1 -0.2 -0.3 -0.8 -3 -5 -7 -8 -9 -10 -12 -13 -14 -15 -16
            -17 -18 -19 -19 -19
        """,
        "cast_iron": """
            2.17 2.17 2.17 2.17 2.17 2.17 2.17 2.17 2.17 2.17 2.17 2.37 0.61 2.61 5.76
            8.78 11.11 10.96 9.79 7.49 5.15 3.02 1.29 0.17 -0.7 -1.17 -1.02 0.27 0.24 1.32
            3.1 3.1 3.1 3.1 3.1
        """,
        "composite": """
            -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -3.95 -4.34
            -4.62 -4.9 -5.22 -6.31 -6.8 -7.24 -7.27 -7.27 -7.14 -6.94 -6.68 -5.99 -3.75 -2.38 -2.59
            -2.46 -2.46 -2.46 -2.46 -2.46
        """,
        "smooth": """
            -12.5 -12.5 -12.5 -12.5 -12.5 -12.5 -12.5 -12.5 -12.5 -12.5 -14.5 -10.9 -13.3 -14.8 -13.5
            -14.3 -14.7 -15 -14.5 -15 -14.5 -14.5 -16.7 -17.5 -17.5 -17.9 -18.9 -20.7 -20.7 -20.7
            -20.6 -20.6 -20.6 -20.5 -20.5
        """,
        "disc_brake": """
            -5.93 -5.93 -5.93 -5.93 -5.93 -5.93 -5.93 -5.93 -5.93 2.32 2.82 2.56 1.22 2.06 0.92
            -0.25 -1.57 -2.85 -4.94 -7 -8.58 -9.32 -9.51 -10.12 -10.25 -10.33 -10.81 -10.91 -9.52 -9.52
            -9.52 -9.52 -9.52 -9.52 -9.52
        """,
    }.items()
}
SHORTEST_WAVE = 0.004  # a third of a contact patch, [m]
THIRD_OCTAVE = 10.0**0.05 - 10.0**-0.05

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
    hold between some 2 and 200 m (SNCF 2 to 40 m). Outside, their formulas continue: below 2 m the FRA
    grades 1 to 4 and the SNCF spectra exceed every measured roughness, by up to 14 dB.

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


def spectrum_band(irregularity: Irregularity) -> tuple[float, float]:
    """Find the shortest and longest wavelength of a drawn irregularity, [m]; a file's own by default."""
    if irregularity.kind != "density_csv":
        return irregularity.named_band
    assert irregularity.path is not None
    covered = _density_table(irregularity.path)["wavelength_m"]
    shortest, longest = irregularity.shortest_wavelength, irregularity.longest_wavelength
    shortest = max(float(covered[0]), SHORTEST_WAVE) if shortest is None else shortest
    longest = float(covered[-1]) if longest is None else longest
    if shortest >= longest:
        raise InputError(
            f"{irregularity.path}: covers {covered[0]:g} to {covered[-1]:g} m; it would be taken from "
            f"{shortest:g} to {longest:g} m: change shortest or longest wavelength, or extend it"
        )
    return shortest, longest


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
    roughness of a reference track in ISO 3095:2013. `good` and `smooth`: what SNCF gives for France, its
    high-speed lines and its wheels with composite blocks and discs, June 2021, as in the tables of
    NoiseModelling (RailwayCnossosSNCF_2022.json). An ordinary Swiss line two years after grinding lies
    within 1.3 dB of `good` from 31 to 200 mm (github.com/mic-haf/SDWirkungNi).
    """
    wavenumber = np.asarray(wavenumber, dtype=np.float64)
    wavelength = 2.0 * np.pi / wavenumber
    found = np.interp(-np.log(wavelength), -np.log(_WAVELENGTH), _LEVELS[level])
    return np.asarray(1e-12 * 10.0 ** (0.1 * found) / (THIRD_OCTAVE * wavenumber))
