"""Short waves of wheel and rail from published levels, over the distance."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.rail.irregularity import (
    RailProfile,
    grid_points,
    lacking_density,
    random_phases,
    spectral_lines,
)
from beardyn_core.rail.spectra import patch_gain, roughness_density
from beardyn_core.scene.background import Roughness
from beardyn_core.scene.excitation import Irregularity
from beardyn_core.scene.operation import QuarterVehicleOperation

BAND = (0.004, 0.5)  # wavelengths, [m]
_PERIOD = 512.0
_SAMPLES_PER_WAVE = 8
_STREAMS = {"rail": 0x726F7567, "wheel": 0x74726561}


def roughness_height(
    roughness: Roughness, operation: QuarterVehicleOperation, position: Float, seed: int
) -> Float:
    """Compute the height that the roughness of rail and wheel adds under the wheel at positions [m], [m].

    The rail repeats after 512 m, the wheel after each turn; their phases are random and independent. Of the
    rail's level counts what the irregularity does not have already.
    """
    height = np.zeros_like(position)
    patch, turn = operation.contact_patch, np.pi * operation.wheel_diameter
    if roughness.rail != "none":
        profile = _profile(roughness.rail, _PERIOD, [_STREAMS["rail"], seed], patch, operation.irregularity)
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
        density = lacking_density(besides, wavenumber, density)
    density = density * patch_gain(wavenumber, patch) ** 2
    points = grid_points(period, BAND[0], _SAMPLES_PER_WAVE)
    return random_phases(period, points, line, wavenumber, density, stream)
