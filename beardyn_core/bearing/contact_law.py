"""Contact laws: line contact after Palmgren, point contact after Hertz.

E' is the modulus in the convention E' = 2 / sum((1 - nu^2)/E) throughout; with E* = E'/2 the point
contact would come out half as stiff.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.material import Material

LINE_EXPONENT = 10.0 / 9.0
POINT_EXPONENT = 1.5


def line_contact_factor(material: Material, length: float) -> float:
    """Compute the stiffness factor K of ONE line contact, Q = K delta^(10/9).

    Parameters
    ----------
    material : Material
    length : float
        Length of the contact (the whole generator; a lamina of n carries K/n), [m].

    Returns
    -------
    float
        K, [N/m^(10/9)].

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
    large for a circular contact; `hertz.ExactPointContact` has complete elliptic integrals.

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
    normal_angle = bearing.contact_angle - bearing.rib_polar_angle
    contact_radius = distance * math.sin(bearing.contact_angle) + bearing.sphere_radius * math.sin(
        normal_angle
    )
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


def rib_contact_factor(bearing: Bearing) -> float:
    """Compute the stiffness factor K of the rib contact, Q = K delta^1.5, [N/m^1.5]."""
    return rib_contact(bearing).factor
