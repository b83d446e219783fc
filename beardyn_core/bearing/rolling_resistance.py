"""Rolling resistance of one lubricated contact: plain formulas, references of the kernel.

A hydrodynamic film is thicker and its pressure higher on the inlet side. Both surfaces feel a tangential
force F_R against their motion, and the pressure balances both: seen from the contact point that is the couple
2 F_R R about the contact line, and a pair of forces (2 R / R_1 - 1) F_R between the bodies, R_1 the radius of
one of them. All line forms here give that couple; in pure rolling its power is couple times relative angular
speed, 2 F_R u. The fits of Aihara and of Zhou and Hoeprich are for elastic contacts; where the load is so
light that they exceed the couple of rigid surfaces, that is the right one. `pressure_viscosity` is the
coefficient of the lubricant, not an angle. The thermal factor reduces the couple, and only here: no film
thickness enters these formulas.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

AIHARA_FACTOR, AIHARA_SPEED, AIHARA_LOAD = 176.0, 0.658, 0.31
ZHOU_HOEPRICH_FACTOR, ZHOU_HOEPRICH_SPEED, ZHOU_HOEPRICH_LOAD = 58.4, 0.648, 0.246
BIBOULET_HOUPERT_FACTOR, BIBOULET_HOUPERT_REGIME = 1.42, 1.4 / 1.45
THERMAL_FACTOR, THERMAL_EXPONENT = 0.29, 0.78


@dataclass(frozen=True)
class RollingContact:
    """A contact that rolls."""

    load: A[float, "[N]"]
    entrainment_speed: A[float, "mean surface speed in the contact-fixed frame, [m/s]"]
    radius: A[float, "equivalent radius in rolling direction, [m]"]
    length: A[float, "length of a line contact; semi-major axis of a point contact, [m]"]
    contact_modulus: A[float, "E' = 2 / sum((1 - nu^2) / E), [Pa]"]
    viscosity: A[float, "dynamic viscosity at inlet temperature, [Pa s]"]
    pressure_viscosity: A[float, "[1/Pa]"]

    @property
    def speed_parameter(self) -> float:
        """U = eta u / (E' R), [-]."""
        return self.viscosity * self.entrainment_speed / (self.contact_modulus * self.radius)

    @property
    def material_parameter(self) -> float:
        """G = alpha E', [-]."""
        return self.pressure_viscosity * self.contact_modulus

    @property
    def line_load_parameter(self) -> float:
        """W = Q / (l E' R), [-]."""
        return self.load / (self.length * self.contact_modulus * self.radius)


def thermal_reduction(loading: float) -> float:
    """Compute the share of the isothermal rolling couple that heating of the inlet leaves, [-].

    References
    ----------
    Aihara (1987), ASME J. Tribol. 109, 471: 1 / (1 + 0.29 L^0.78).
    """
    return 1.0 / (1.0 + THERMAL_FACTOR * loading**THERMAL_EXPONENT)


def aihara_line(contact: RollingContact) -> float:
    """Compute the rolling couple of a line contact, isothermal and fully flooded, [N m].

    References
    ----------
    Aihara (1987), ASME J. Tribol. 109, 471: M = 176/alpha (G U)^0.658 W^0.31 R^2 l.
    """
    return _power_law(contact, AIHARA_FACTOR, AIHARA_SPEED, AIHARA_LOAD)


def zhou_hoeprich_line(contact: RollingContact) -> float:
    """Compute the rolling couple of a line contact, isothermal and fully flooded, [N m].

    References
    ----------
    Zhou and Hoeprich (1991), ASME J. Tribol. 113, 590: M = 58.4/alpha (G U)^0.648 W^0.246 R^2 l, which is
    twice their rolling force times R.
    """
    return _power_law(contact, ZHOU_HOEPRICH_FACTOR, ZHOU_HOEPRICH_SPEED, ZHOU_HOEPRICH_LOAD)


def rigid_line(contact: RollingContact) -> float:
    """Compute the rolling couple of a line contact whose surfaces stay rigid, [N m].

    References
    ----------
    Biboulet and Houpert (2010), the rigid isoviscous limit of `biboulet_houpert_force`.
    """
    speed, load = 2.0 * contact.speed_parameter, contact.line_load_parameter
    scale = contact.contact_modulus * contact.radius**2 * contact.length
    return 2.0 * BIBOULET_HOUPERT_FACTOR * math.sqrt(speed * load) * scale


def biboulet_houpert_force(
    contact: RollingContact, rigid_share: float = 1.0, elastic_share: float = 1.0
) -> float:
    """Compute the rolling force on either surface of a line contact, [N].

    From the rigid isoviscous to the elastic regime; the rigid limit is Martin's solution within 4 %. Where
    oil is missing a share is left of each regime's force.

    References
    ----------
    Biboulet and Houpert (2010), Proc. IMechE J 224, 777: T = 1.42 sqrt(U W) / (1 + r^10)^0.1 with
    r = (1.4/1.45) sqrt(M), M = W / sqrt(U), U = 2 eta u / (E' R), W = w / (E' R).
    """
    speed, load = 2.0 * contact.speed_parameter, contact.line_load_parameter
    if speed <= 0.0 or load <= 0.0:
        return 0.0
    regime = BIBOULET_HOUPERT_REGIME * math.sqrt(load / math.sqrt(speed)) * rigid_share / elastic_share
    force = rigid_share * BIBOULET_HOUPERT_FACTOR * math.sqrt(speed * load) / (1.0 + regime**10) ** 0.1
    return force * contact.contact_modulus * contact.radius * contact.length


def biboulet_houpert_line(
    contact: RollingContact, rigid_share: float = 1.0, elastic_share: float = 1.0
) -> float:
    """Compute the rolling couple 2 F_R R of a line contact, [N m]; see `biboulet_houpert_force`."""
    return 2.0 * contact.radius * biboulet_houpert_force(contact, rigid_share, elastic_share)


def hysteresis_line(load: float, half_width: float, loss_factor: float) -> float:
    """Compute the couple from the elastic hysteresis of a line contact under a load [N], [N m].

    With the Hertz half width b [m] and alpha_v, the share of the elastic energy lost in a cycle; 0.005 to
    0.01 for bearing steel.

    References
    ----------
    Johnson (1985), Contact Mechanics, Section 9.4: M = 2 alpha_v b Q / (3 pi).
    """
    return 2.0 * loss_factor * half_width * load / (3.0 * math.pi)


def hertz_half_width(load_per_length: float, radius: float, contact_modulus: float) -> float:
    """Compute the half width of a Hertz line contact, b = sqrt(4 q R / (pi E*)), E* = E'/2, [m]."""
    return math.sqrt(8.0 * load_per_length * radius / (math.pi * contact_modulus))


def _power_law(contact: RollingContact, factor: float, speed_exponent: float, load_exponent: float) -> float:
    """Compute the couple factor/alpha (G U)^s W^w R^2 l, [N m]."""
    film = (contact.material_parameter * contact.speed_parameter) ** speed_exponent
    scale = contact.radius**2 * contact.length / contact.pressure_viscosity
    return factor * film * contact.line_load_parameter**load_exponent * scale
