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

FCALC = (
    "FCalc 2.0 by J. T. Realmuto, table of its parameters, freight cars with standard and with low-torque "
    "roller bearings: 80.6 and 48.9 N an axle, whatever its load, after variants of the formula of Davis"
)
ALTRIOS = (
    "ALTRIOS of the National Renewable Energy Laboratory, rail_vehicles.csv, bearing resistance of a "
    "manifest car: 40.26 N an axle, whatever its load"
)
CONSTANT = (
    "SKF, Rolling bearings, constant coefficient of friction of tapered roller bearings, 0.0018, from memory"
)
LIESER = (
    "Lieser and West 1969, ASME 69-Lub-31, abstract: grease-lubricated tapered bearings for 160 mph; rubbing "
    "lip seals heat too much above 100 mph, and so does too much grease"
)
KESLER = (
    "Kesler and Tinto 1989, Performance of degraded roller bearings, Federal Railroad Administration, "
    "abstract: failing bearings warmed by up to 12.8 degrees a minute, Fahrenheit by the rest of its text"
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
RUSSIAN_BORE = 0.13


@dataclass(frozen=True)
class AxleResistance:
    """Resistance of the two bearings of an axle at the rim of its wheels, the same whatever the load."""

    name: str
    force: A[float, "[N]"]
    axle_load: A[float, "[t]"]
    seal_torque: A[float, "of one of our seals, [N m]"]
    speed_kmh: float = 80.0
    wheel_diameter: A[float, "[m]"] = 0.9144

    @property
    def torque(self) -> float:
        """Convert to the torque of one bearing, [N m]."""
        return 0.5 * self.force * 0.5 * self.wheel_diameter

    @property
    def load(self) -> float:
        """Load on one bearing, [N]."""
        return 0.5 * GRAVITY * (1e3 * self.axle_load - WHEELSET)


# Loaded: 286,000 lb on four axles; empty: 30 t. Low-torque seals have the 0.3 N m that are assumed of ours,
# standard ones the 1.2 N m of garter seals.
LOW_TORQUE = AxleResistance("low-torque seals, loaded", 48.9305, 32.4, 0.3)
STANDARD = AxleResistance("standard seals, loaded", 80.625, 32.4, 1.2)
EMPTY = AxleResistance("low-torque seals, empty", 48.9305, 7.5, 0.3)
MANIFEST = AxleResistance("manifest car, loaded", 40.26, 32.4, 0.3)
# What the two kinds of seal differ by, on one seal of two, above our own.
LIP_SEAL = LOW_TORQUE.seal_torque + 0.5 * (STANDARD.torque - LOW_TORQUE.torque)
# 10 % of 2 to 2.5 N/kN, at the rim of a wheel of 0.92 m, of a bearing under 80 kN.
MODERN_TORQUE = 0.1 * 2.25e-3 * 80e3 * 0.46
CONSTANT_FRICTION = 0.0018
CLASS_K_BORE = 0.15715


def friction_coefficient(torque: float, load: float, bore: float) -> float:
    """Refer a torque [N m] to the load [N] at the bore [m], as catalogues do."""
    return torque / (load * 0.5 * bore)


# Of loaded axleboxes at service temperature.
COEFFICIENTS = (
    friction_coefficient(RUSSIAN_CARS[0].torque, RUSSIAN_CARS[0].load, RUSSIAN_BORE),
    friction_coefficient(MODERN_TORQUE, 80e3, 0.13),
    *(
        friction_coefficient(axle.torque, axle.load, CLASS_K_BORE)
        for axle in (LOW_TORQUE, STANDARD, MANIFEST)
    ),
    CONSTANT_FRICTION,
)
NTN_RISE = 41.3 - 20.0  # [K]
NTN_LARGEST_RISE = 44.2 - 20.0
