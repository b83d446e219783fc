"""Contact laws: line contact after Palmgren, point contact after Hertz, the contact ellipse of the rib.

E' is the modulus in the convention E' = 2 / sum((1 - nu^2)/E) throughout; with E* = E'/2 the point
contact would come out half as stiff.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.geometry import Bearing, Material

if TYPE_CHECKING:
    from beardyn_core.bearing.spherical import SphericalBearing

LINE_EXPONENT = 10.0 / 9.0
POINT_EXPONENT = 1.5


def power_law(approach: Float, factor: float, exponent: float) -> tuple[Float, Float, Float]:
    """Work out force, tangent stiffness and energy of Q = K delta^p, zero when apart."""
    pressed = np.maximum(approach, 0.0)
    force = factor * pressed**exponent
    stiffness = (
        exponent * factor * np.where(pressed > 0.0, pressed, 1.0) ** (exponent - 1.0) * (pressed > 0.0)
    )
    return force, stiffness, force * pressed / (exponent + 1.0)


def line_contact_factor(material: Material, length: float) -> float:
    """Compute the stiffness factor K of ONE line contact, Q = K delta^(10/9), [N/m^(10/9)].

    Parameters
    ----------
    length : float
        Length of the contact (the whole generator; a lamina of n carries K/n), [m].

    Notes
    -----
    `delta` is the approach of one contact. The constant c_L = 35 948 L^(8/9) of ISO/TS 16281 (N, mm)
    belongs to the two contacts of a roller in series, hence 2^(10/9) times softer; taking one for the
    other doubles the stiffness.

    References
    ----------
    Palmgren, A. (1959), Ball and Roller Bearing Engineering: delta = 3.84e-5 Q^0.9 / L^0.8 (mm, N), which is
    Q = 0.356 E' L^(8/9) delta^(10/9) for steel.
    """
    return 0.356 * material.contact_modulus * length ** (8.0 / 9.0)


@dataclass(frozen=True)
class PointContact:
    """Elliptical point contact of two bodies, simplified elliptic integrals.

    The stiffness factor is within 1 % for the elongated ellipses of ribs (Ry/Rx from 3 to 10) and 9 % too
    large for a circular contact; `ExactPointContact` has complete elliptic integrals.

    References
    ----------
    Hamrock, B. J. and Brewe, D. (1983), Simplified solution for stresses and deformations, ASME J. Lubr.
    Technol. 105: k = 1.0339 (Ry/Rx)^0.636, E = 1.0003 + 0.5968 Rx/Ry, F = 1.5277 + 0.6023 ln(Ry/Rx).
    """

    radius_x: A[float, "equivalent radius in the first principal plane, [m]"]
    radius_y: A[float, "in the second, [m]"]
    contact_modulus: A[float, "E', [Pa]"]

    @property
    def _smaller(self) -> float:
        return min(self.radius_x, self.radius_y)

    @property
    def _ratio(self) -> float:
        """Ry/Rx >= 1, [-]."""
        return max(self.radius_x, self.radius_y) / self._smaller

    @property
    def radius(self) -> float:
        """1/R = 1/Rx + 1/Ry, [m]."""
        return 1.0 / (1.0 / self.radius_x + 1.0 / self.radius_y)

    @property
    def ellipticity(self) -> float:
        """Semi-axis ratio a/b >= 1, [-]."""
        return 1.0339 * self._ratio**0.636

    @property
    def integral_second(self) -> float:
        """Elliptic integral of the second kind, [-]."""
        return 1.0003 + 0.5968 / self._ratio

    @property
    def integral_first(self) -> float:
        """Elliptic integral of the first kind, [-]."""
        return 1.5277 + 0.6023 * math.log(self._ratio)

    @property
    def factor(self) -> float:
        """K in Q = K delta^1.5, [N/m^1.5]."""
        root = math.sqrt(self.radius * self.integral_second / (4.5 * self.integral_first**3))
        return math.pi * self.ellipticity * self.contact_modulus * root

    def semi_axes(self, load: float) -> tuple[float, float]:
        """Compute the semi-axes (larger, smaller) of the contact ellipse under `load` [N], [m]."""
        k = self.ellipticity
        cubed = 6.0 * k**2 * self.integral_second * load * self.radius / (math.pi * self.contact_modulus)
        larger = cubed ** (1.0 / 3.0)
        return larger, larger / k


def rib_curvature_radius(bearing: Bearing) -> float:
    """Compute R_rib, the radius of curvature of the concave rib cone at the nominal contact, [m]."""
    distance = bearing.apex_distance + bearing.sphere_centre
    contact_radius = distance * math.sin(bearing.contact_angle)
    contact_radius += bearing.sphere_radius * math.sin(bearing.rib_lean)
    return contact_radius / math.cos(bearing.rib_angle)


# Least curvature of the rib contact around the ring, as part of the sphere's: closer surfaces touch all over.
_LEAST_CURVATURE = 1.0e-3


def rib_contact(bearing: Bearing) -> PointContact:
    """Compute the contact of the spherical roller end with the conical rib of the cone.

    Notes
    -----
    In the meridian plane the rib is straight, so Rx = R_s. Around the ring it is concave with the radius
    R_rib = rho_c / cos(alpha_f), so 1/Ry = 1/R_s - 1/R_rib. A sphere that a forced bearing makes as large as
    the rib is taken with 1/Ry = 0.001/R_s.
    """
    sphere_radius = bearing.sphere_radius
    curvature = 1.0 / sphere_radius - 1.0 / rib_curvature_radius(bearing)
    radius_y = 1.0 / max(curvature, _LEAST_CURVATURE / sphere_radius)
    return PointContact(sphere_radius, radius_y, bearing.material.contact_modulus)


# Sliding and spin of a contact ellipse dissipate mu Q sqrt(u^2 + 0.18 a^2 w^2).
SPIN_SHARE = 0.18


def rib_contact_factor(bearing: Bearing) -> float:
    """Compute the stiffness factor K of the rib contact, Q = K delta^1.5, [N/m^1.5]."""
    return rib_contact(bearing).factor


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
        return _ellipticity_of(self._ratio)

    @property
    def integral_first(self) -> float:
        """Complete elliptic integral of the first kind, [-]."""
        return complete_elliptic(1.0 - self.ellipticity**-2)[0]

    @property
    def integral_second(self) -> float:
        """Complete elliptic integral of the second kind, [-]."""
        return complete_elliptic(1.0 - self.ellipticity**-2)[1]


@cache  # an equilibrium asks thousands of times for the few of a bearing
def _ellipticity_of(radius_ratio: float) -> float:
    """Compute the semi-axis ratio of an ellipse of Ry/Rx, by halving."""
    wanted, low, high = math.log(radius_ratio), 0.0, math.log(1e6)
    for _ in range(100):
        middle = 0.5 * (low + high)
        if _log_radius_ratio(math.exp(middle)) < wanted:
            low = middle
        else:
            high = middle
    return math.exp(0.5 * (low + high))


def _log_radius_ratio(ellipticity: float) -> float:
    """Compute ln(Ry/Rx) of an ellipse of semi-axis ratio k; 0 for a circle."""
    if ellipticity < 1.0 + 1e-7:
        return 0.0
    first, second = complete_elliptic(1.0 - ellipticity**-2)
    return math.log((ellipticity**2 * second - first) / (first - second))


@dataclass(frozen=True)
class SlicedEllipse:
    """Hertz's elliptical contact as slices that are independent.

    With the approach delta at its middle, a slice at x from there has the load per length
    k (delta - (x/A)^2). Over the whole ellipse that is Hertz's load at Hertz's approach, spread along its
    long axis as he has it, at every load. At the end of a roller the ellipse is cut off.

    References
    ----------
    Johnson, K. L. (1985), Contact Mechanics, 4.2 and 4.3: Q = K delta^1.5, long semi-axis a = A delta^0.5 and
    q(x) = 3 Q/(4 a) (1 - (x/a)^2), which gives k = 3 K/(4 A).
    """

    stiffness: A[float, "k, of a slice per length, [N/m^2]"]
    reach: A[float, "A, long semi-axis over the root of the approach, [m^0.5]"]


@cache
def barrel_ellipse(bearing: SphericalBearing, ring: str) -> SlicedEllipse:
    """Compute the contact of a barrel with the raceway of ``cup`` or ``cone``."""
    radii = bearing.rolling_radius(ring), bearing.profile_radius(ring)
    contact = ExactPointContact(*radii, bearing.material.contact_modulus)
    reach = contact.semi_axes(1.0)[0] * contact.factor ** (1.0 / 3.0)
    return SlicedEllipse(0.75 * contact.factor / reach, reach)


def exact_rib_contact(bearing: Bearing) -> ExactPointContact:
    """Compute `rib_contact` with complete elliptic integrals."""
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
    """State where the contact ellipse under a load [N] reaches beyond the rib face or the roller end.

    The Hertz contact leaves these borders out: pressure and stiffness are off where they are passed.
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
