"""Pure-rolling kinematics and the fault frequencies that follow from it.

The cup is at rest and the cone turns with the shaft.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING
from typing import Annotated as A

if TYPE_CHECKING:
    from beardyn_core.bearing.roller_bearing import RollerBearing


@dataclass(frozen=True)
class FaultFrequencies:
    """Kinematic frequencies per shaft revolution, [-]."""

    ftf: A[float, "cage speed"]
    bpfo: A[float, "passing of one row's rollers over a point of the cup"]
    bpfi: A[float, "the same of the cone"]
    bsf: A[float, "spin of a roller in its cage pocket; a roller fault strikes twice as often"]

    @property
    def by_name(self) -> dict[str, float]:
        """``FTF``, ``BPFO``, ``BPFI`` and ``BSF``, [-]."""
        return {name.upper(): value for name, value in vars(self).items()}


def frequencies(
    roller_count: int, pitch_diameter: float, roller_diameter: float, angle: float
) -> FaultFrequencies:
    """Compute the fault frequencies of any rolling bearing with the outer ring at rest.

    From the rolling elements of one row, both diameters in the same unit, and the angle between
    rolling-element axis and bearing axis (contact angle of a ball bearing), [rad].
    """
    gamma = roller_diameter * math.cos(angle) / pitch_diameter
    ftf = 0.5 * (1.0 - gamma)
    return FaultFrequencies(
        ftf=ftf,
        bpfo=roller_count * ftf,
        bpfi=0.5 * roller_count * (1.0 + gamma),
        bsf=0.5 * pitch_diameter / roller_diameter * (1.0 - gamma**2),
    )


def fault_frequencies(bearing: RollerBearing) -> FaultFrequencies:
    """Compute the fault frequencies of one row of `bearing` per shaft revolution.

    References
    ----------
    FTF = (1 - g)/2, BPFO = Z (1 - g)/2, BPFI = Z (1 + g)/2, BSF = Dpw/(2 Dm) (1 - g^2) with
    g = Dm cos(alpha_m)/Dpw. With a common apex (1 - g)/2 equals sin(ai)/(sin(ai) + sin(ao)) identically.
    """
    return frequencies(
        bearing.roller_count, bearing.pitch_diameter, bearing.roller_diameter, bearing.contact_angle
    )


def cage_speed_ratio(bearing: RollerBearing) -> float:
    """Compute the cage speed over shaft speed in pure rolling, [-]."""
    return bearing.cage_ratio


def cage_speed(bearing: RollerBearing, shaft_speed: float) -> float:
    """Compute the speed of cage and roller centres about the bearing axis in pure rolling, [rad/s]."""
    return cage_speed_ratio(bearing) * shaft_speed


def roller_spin(bearing: RollerBearing, shaft_speed: float) -> float:
    """Compute the spin of a roller about its own axis relative to the cage, [rad/s].

    Positive when opposite to the sense in which the shaft turns.
    """
    cup, roller = bearing.rolling_radii
    return cage_speed(bearing, shaft_speed) * cup / roller


def centrifugal_force(bearing: RollerBearing, shaft_speed: float) -> float:
    """Compute the centrifugal force of a roller in pure rolling, [N]."""
    return bearing.roller_mass * cage_speed(bearing, shaft_speed) ** 2 * bearing.roller_orbit_radius


def roller_cone_spin(bearing: RollerBearing, shaft_speed: float) -> float:
    """Compute the relative speed of roller and cone about their common generator, [rad/s].

    The rib contact slides with this speed times its height above the cone raceway.
    """
    slip = shaft_speed - cage_speed(bearing, shaft_speed)
    orbit, roller = bearing.cone_spin_radii
    return slip * orbit / roller
