"""Torques and temperatures of axlebox bearings as others printed them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

GRAVITY = 9.80665
WHEELSET = 1.4e3  # [kg], of a freight car; its weight is not on the bearings

RUSSIAN = (
    "resistance of the axlebox bearings of Russian freight cars (cylindrical rollers) at the wheel rim, "
    'quoted by Wikipedia, "Rolling resistance", Railroads: components of rolling resistance'
)
SHARE = (
    'theengineeringblog.com, "Train resistance": wheelsets resist with 2 to 2.5 N/kN, of which modern '
    "axlebox bearings normally make 10 %"
)
NTN = (
    "NTN Technical Review, Development of new RCT bearing for axleboxes, tables 4 to 6: double row tapered, "
    "120 x 220 x 155/160, light contact seals, 68.3 kN radial, 13.6 kN axial, 2216 rpm as at 330 km/h, in "
    "about 10 m/s of cooling air, outer ring of row A, mean"
)
SEALS = (
    'SKF Evolution, "Compact taper roller bearing lives up to its name": low-friction seals instead of '
    "garter seals, friction torque less by up to 75 %, operating temperature by 20 K"
)


@dataclass(frozen=True)
class Resistance:
    """Resistance of the bearings of a car, at the rim of its wheels over the weight."""

    axle_load: A[float, "[t]"]
    speed_kmh: float
    coefficient: A[float, "[-]"]
    wheel_diameter: A[float, "[m]"] = 0.95

    @property
    def torque(self) -> float:
        """Convert to the torque of one bearing, [N m]."""
        return self.coefficient * 0.5e3 * self.axle_load * GRAVITY * 0.5 * self.wheel_diameter

    @property
    def load(self) -> float:
        """Load on one bearing, [N]."""
        return 0.5 * GRAVITY * (1e3 * self.axle_load - WHEELSET)


# The wheel diameter is that of Russian cars, 0.95 m, not part of the quotation; 70 stands for 60 to 80 km/h.
RUSSIAN_CARS = (
    Resistance(21.0, 70.0, 1.3e-4),
    Resistance(5.5, 20.0, 2.4e-4),
    Resistance(5.5, 60.0, 2.0e-4),
    Resistance(5.5, 120.0, 2.8e-4),
)
# 10 % of 2 to 2.5 N/kN, at the rim of a wheel of 0.92 m, of a bearing under 80 kN.
MODERN_TORQUE = 0.1 * 2.25e-3 * 80e3 * 0.46
NTN_RISE = 41.3 - 20.0  # [K]
NTN_LARGEST_RISE = 44.2 - 20.0
