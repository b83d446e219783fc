"""The wheel-rail contact patch: its length, and what it leaves of short waves."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float

_RAIL_HEAD = 0.3  # radius of the crown of a rail 60E1, across, [m]
_STEEL = 206e9 / (1.0 - 0.3**2)  # [Pa]


def patch_length(wheel_radius: float, load: float) -> float:
    """Compute the length along the rail of the Hertz contact of a wheel on a rail, [m].

    Parameters
    ----------
    wheel_radius : float
        [m].
    load : float
        Of the wheel at rest, [N].

    References
    ----------
    Hamrock, Dowson (1981), Ball Bearing Lubrication, chapter 3: fit of the elliptic contact.
    """
    longer, shorter = max(wheel_radius, _RAIL_HEAD), min(wheel_radius, _RAIL_HEAD)
    ellipticity = (longer / shorter) ** (2.0 / np.pi)
    integral = 1.0 + (0.5 * np.pi - 1.0) * shorter / longer
    curvature = 1.0 / wheel_radius + 1.0 / _RAIL_HEAD
    length = 2.0 * np.cbrt(6.0 * ellipticity**2 * integral * load / (np.pi * _STEEL * curvature))
    return float(length if wheel_radius >= _RAIL_HEAD else length / ellipticity)


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
