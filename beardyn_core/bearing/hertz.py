"""Hertz point contact with complete elliptic integrals, and the contact ellipse of the rib."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.bearing.contact_law import PointContact, rib_contact
from beardyn_core.bearing.geometry import Bearing


def complete_elliptic(modulus_squared: float) -> tuple[float, float]:
    """Complete elliptic integrals of the first and second kind, K(m) and E(m), for 0 <= m < 1, [-].

    References
    ----------
    Abramowitz, M. and Stegun, I. (1964), 17.6: arithmetic-geometric mean.
    """
    a, b, power, lost = 1.0, math.sqrt(1.0 - modulus_squared), 0.5, 0.5 * modulus_squared
    while abs(a - b) > 1e-15 * a:
        a, b, difference = 0.5 * (a + b), math.sqrt(a * b), 0.5 * (a - b)
        power *= 2.0
        lost += power * difference * difference
    first = 0.5 * math.pi / a
    return first, first * (1.0 - lost)


@dataclass(frozen=True)
class ExactPointContact(PointContact):
    """Elliptical point contact with complete elliptic integrals.

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, Eqs. 4.25 to 4.28.
    """

    @property
    def ellipticity(self) -> float:
        """Semi-axis ratio a/b >= 1: root of Ry/Rx = (k^2 E - K)/(K - E), [-]."""
        wanted, low, high = math.log(self._ratio), 0.0, math.log(1e6)
        for _ in range(100):
            middle = 0.5 * (low + high)
            if _log_radius_ratio(math.exp(middle)) < wanted:
                low = middle
            else:
                high = middle
        return math.exp(0.5 * (low + high))

    @property
    def integral_first(self) -> float:
        """Complete elliptic integral of the first kind, [-]."""
        return complete_elliptic(1.0 - self.ellipticity**-2)[0]

    @property
    def integral_second(self) -> float:
        """Complete elliptic integral of the second kind, [-]."""
        return complete_elliptic(1.0 - self.ellipticity**-2)[1]


def _log_radius_ratio(ellipticity: float) -> float:
    """Compute ln(Ry/Rx) of an ellipse of semi-axis ratio k; 0 for a circle."""
    if ellipticity < 1.0 + 1e-7:
        return 0.0
    first, second = complete_elliptic(1.0 - ellipticity**-2)
    return math.log((ellipticity**2 * second - first) / (first - second))


def exact_rib_contact(bearing: Bearing) -> ExactPointContact:
    """Compute `contact_law.rib_contact` with complete elliptic integrals."""
    fitted = rib_contact(bearing)
    return ExactPointContact(fitted.radius_x, fitted.radius_y, fitted.contact_modulus)


@dataclass(frozen=True)
class RibEllipse:
    """Contact ellipse of the rib at its nominal place."""

    around: A[float, "semi-axis around the ring, [m]"]
    along: A[float, "semi-axis along the face, [m]"]
    largest_pressure: A[float, "[Pa]"]


def rib_ellipse(bearing: Bearing, load: float) -> RibEllipse:
    """Compute the contact ellipse of the rib under a load [N]."""
    around, along = exact_rib_contact(bearing).semi_axes(load)
    return RibEllipse(around, along, 1.5 * load / (math.pi * around * along) if load > 0.0 else 0.0)


def rib_truncation(bearing: Bearing, load: float) -> list[str]:
    """Say where the contact ellipse under a load [N] reaches beyond the rib face or the roller end.

    The Hertz contact does not know these borders: pressure and stiffness are off where they are passed.
    """
    ellipse, height = rib_ellipse(bearing, load), bearing.rib_contact_height
    lean = math.cos(bearing.rib_polar_angle)
    top, bottom = height + ellipse.along * lean, height - ellipse.along * lean
    radius = bearing.large_end_radius
    half_chord = math.sqrt(max((radius - bearing.roller_chamfer) ** 2 - (radius - height) ** 2, 0.0))
    under = f"under {load:.0f} N the rib's contact ellipse reaches"
    found = []
    if top > bearing.rib_height:
        found.append(f"{under} {top * 1e3:.2f} mm high, above rib_height {bearing.rib_height * 1e3:g} mm.")
    if bottom < bearing.rib_undercut:
        found.append(
            f"{under} down to {bottom * 1e3:.2f} mm, below rib_undercut {bearing.rib_undercut * 1e3:g} mm."
        )
    if ellipse.around > half_chord:
        found.append(
            f"{under} {ellipse.around * 1e3:.2f} mm to each side, beyond the rim of the roller end at "
            f"{half_chord * 1e3:.2f} mm."
        )
    return found
