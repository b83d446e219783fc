"""A spherical (barrel) roller bearing through the same contact search, at rest under a radial load.

Outer raceway: sphere; inner raceways and rollers: arcs swept about their axes. The gaps of each roller come
from two surface-surface searches; Hertz's point contact turns them into forces, and every roller is put in
balance in its meridian plane (radial, axial, tilt). The check is the closed form of the load distribution.

The frame of a roller: x outwards at its azimuth, y around, z along the bearing axis.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated as A

import numpy as np
from scipy.optimize import brentq, root

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import ExactPointContact
from beardyn_core.bearing.geometry import Material
from beardyn_core.laboratory.compiled import batch
from beardyn_core.laboratory.search import SURFACES, Pair
from beardyn_core.laboratory.shapes import Arc, place_along

POINT_EXPONENT = 1.5
ROWS = 2
_MANY = 20_000
_UNIT = 1e-6  # roller coordinates are solved in this unit, [m]


@dataclass(frozen=True)
class BarrelBearing:
    """A double-row spherical roller bearing with symmetric rollers."""

    name: str
    source: str
    roller_count: A[int, "per row"]
    pitch_diameter: A[float, "[m]"]
    roller_diameter: A[float, "[m]"]
    roller_length: A[float, "[m]"]
    contact_angle: A[float, "[rad]"]
    roller_contour: A[float, "radius of the roller's profile, [m]"]
    inner_contour: A[float, "radius of the inner raceway's profile, [m]"]
    outer_sphere: A[float, "radius of the outer raceway, [m]"]
    material: Material

    @property
    def centre_distance(self) -> float:
        """Of a roller's centre from the bearing centre when it touches the inner raceway, [m]."""
        return 0.5 * self.pitch_diameter / math.cos(self.contact_angle)

    @property
    def clearance(self) -> float:
        """Free travel of the rollers along the contact line, [m]."""
        return self.outer_sphere - self.centre_distance - 0.5 * self.roller_diameter

    @cached_property
    def factors(self) -> Float:
        """K of the outer and of the inner contact, Q = K delta^1.5, [N/m^1.5]."""
        r, sphere, modulus = 0.5 * self.roller_diameter, self.outer_sphere, self.material.contact_modulus
        raceway, contour = self.centre_distance - r, self.roller_contour
        outer = 1.0 / (1.0 / r - 1.0 / sphere), 1.0 / (1.0 / contour - 1.0 / sphere)
        inner = 1.0 / (1.0 / r + 1.0 / raceway), 1.0 / (1.0 / contour - 1.0 / self.inner_contour)
        return np.array([ExactPointContact(*radii, modulus).factor for radii in (outer, inner)])

    @cached_property
    def pair_factor(self) -> float:
        """K of both contacts of a roller in series, [N/m^1.5]."""
        return float((self.factors ** (-1.0 / POINT_EXPONENT)).sum() ** -POINT_EXPONENT)

    def roller(self, position: Float) -> Arc:
        """Displace the roller by ``position``: radial, axial [m], tilt [rad]."""
        radial, axial, tilt = position
        distance = self.centre_distance + 0.5 * self.clearance
        angle = self.contact_angle
        centre = (distance * math.cos(angle) + radial, 0.0, distance * math.sin(angle) + axial)
        lean = angle - tilt
        axis = (-math.sin(lean), 0.0, math.cos(lean))
        east = (math.cos(lean), 0.0, math.sin(lean))
        half = 0.5 * self.roller_diameter
        return Arc(place_along(centre, axis, east), half - self.roller_contour, self.roller_contour)

    def outer_raceway(self) -> Arc:
        """Build the sphere around the bearing centre."""
        return Arc(place_along((0, 0, 0), (0, 0, 1)), 0.0, self.outer_sphere, -1.0)

    def inner_raceway(self, shift: Float) -> Arc:
        """Build the groove of one row, displaced by ``shift`` [3]."""
        reach = self.centre_distance - 0.5 * self.roller_diameter + self.inner_contour
        place = place_along(shift + np.array([0.0, 0.0, reach * math.sin(self.contact_angle)]), (0, 0, 1))
        return Arc(place, reach * math.cos(self.contact_angle), self.inner_contour, -1.0)

    def pairs(self, position: Float, shift: Float) -> list[Pair]:
        """Pair the roller with outer and inner raceway."""
        roller = self.roller(position)
        return [
            Pair(roller, self.outer_raceway(), SURFACES),
            Pair(roller, self.inner_raceway(shift), SURFACES),
        ]

    def starts(self) -> list[Float]:
        """Return parameters of the centred roller: outer contact at its angle 0, inner contact opposite."""
        angle = self.contact_angle
        return [np.array([0.0, 0.0, angle, 0.0]), np.array([0.0, math.pi, math.pi + angle, 0.0])]


BARREL_22317 = BarrelBearing(
    name="22317",
    source="Harris, T. A. (2001), Rolling Bearing Analysis, 4th ed., worked examples on the 22317 spherical "
    "roller bearing, recalled",
    roller_count=14,
    pitch_diameter=135.077e-3,
    roller_diameter=25.0e-3,
    roller_length=20.762e-3,
    contact_angle=math.radians(12.0),
    roller_contour=79.959e-3,
    inner_contour=81.585e-3,
    outer_sphere=81.585e-3,
    material=Material(),
)


@dataclass(frozen=True)
class BarrelLoads:
    """Loads of one row under a radial load, and those of the closed form."""

    force: A[float, "radial load on the bearing, [N]"]
    displacement: A[float, "of the inner ring, [m]"]
    azimuth: A[Float, "shape [roller], [rad]"]
    load: A[Float, "shape [roller], [N]"]
    formula: A[Float, "shape [roller], by the closed form, [N]"]
    formula_displacement: A[float, "[m]"]
    integral_largest: A[float, "largest load by the load-zone integral instead of the sum over rollers, [N]"]
    contact_angle: A[Float, "shape [roller], loaded, at the outer raceway; nominal where free, [rad]"]
    balance: A[float, "largest force that a roller's balance leaves over its load, [-]"]
    searches: A[int, "general searches it took"]


class _Row:
    def __init__(self, bearing: BarrelBearing) -> None:
        self.bearing = bearing
        self.azimuth = 2.0 * math.pi * np.arange(bearing.roller_count) / bearing.roller_count
        self.factors = bearing.factors
        self.searches = 0
        self.balance = 0.0
        self.angles = np.full(bearing.roller_count, bearing.contact_angle)
        self._starts = bearing.starts()

    def gaps(self, position: Float, shift: Float) -> tuple[Float, list[Pair], Float]:
        """Search both contacts: gaps, pairs, and parameters."""
        pairs = self.bearing.pairs(position, shift)
        parameters, iterations, gap = batch(pairs, self._starts).solve()
        self.searches += len(pairs)
        if (iterations < 0).any():
            raise ArithmeticError("no contact point of a barrel roller was found")
        return gap, pairs, parameters

    def wrench(self, position: Float, shift: Float) -> tuple[Float, float, float, float]:
        """Return force and moment on the roller, outer load, radial force on the inner ring, angle."""
        gap, pairs, parameters = self.gaps(position, shift)
        loads = self.factors * np.maximum(-gap, 0.0) ** POINT_EXPONENT
        total = np.zeros(3)
        outer, inner = (pair.q.frame(parameters[i, 2:4]).vectors[2] for i, pair in enumerate(pairs))
        for i, (pair, normal) in enumerate(zip(pairs, (outer, inner), strict=True)):
            push = loads[i] * normal
            arm = pair.p.frame(parameters[i, :2]).point - pair.p.place.origin
            # + tilt turns the small z towards x: about -y
            total += (push[0], push[2], -(arm[2] * push[0] - arm[0] * push[2]))
        return total, float(loads[0]), float(-loads[1] * inner[0]), math.atan2(-outer[2], -outer[0])

    def roller_load(self, number: int, displacement: float) -> tuple[float, float]:
        """Return the outer load of a roller in balance, and the radial force it puts on the inner ring."""
        azimuth = float(self.azimuth[number])
        shift = displacement * np.array([math.cos(azimuth), -math.sin(azimuth), 0.0])
        gap, _, _ = self.gaps(np.zeros(3), shift)
        squeeze = -float(gap.sum())
        self.angles[number] = self.bearing.contact_angle
        if squeeze <= 0.0:
            return 0.0, 0.0
        angle = self.bearing.contact_angle
        # both contacts share the squeeze as their stiffnesses do
        power = 1.0 / POINT_EXPONENT
        share = self.factors[0] ** -power / (self.factors**-power).sum()
        along = float(gap[0]) + share * squeeze
        guess = np.array([along * math.cos(angle), along * math.sin(angle), 0.0])
        scale = np.array([_UNIT, _UNIT, _UNIT / self.bearing.roller_length])
        unit_load = self.bearing.pair_factor * squeeze**POINT_EXPONENT
        force_scale = np.array([unit_load, unit_load, unit_load * self.bearing.roller_length])
        found = root(
            lambda y: self.wrench(y * scale, shift)[0] / force_scale, guess / scale, method="hybr", tol=1e-10
        )
        left, load, inner, angle = self.wrench(found.x * scale, shift)
        self.angles[number] = angle
        self.balance = max(self.balance, float(np.abs(left[:2]).max() / unit_load))
        return load, inner * math.cos(azimuth)

    def loads(self, displacement: float) -> tuple[Float, float]:
        """Return the loads of the row, and the load the two rows carry."""
        count = self.bearing.roller_count
        found = [self.roller_load(k, displacement) for k in range(count // 2 + 1)]
        number = np.minimum(np.arange(count), count - np.arange(count))  # the other half mirrors it
        self.angles = self.angles[number]
        load = np.array([found[k][0] for k in number])
        return load, -ROWS * sum(found[k][1] for k in number)


def solve_barrel(bearing: BarrelBearing, force: float) -> BarrelLoads:
    """Balance the inner ring under a radial load [N], and give the closed form next to it.

    References
    ----------
    Harris, T. A. (2001), ch. 7, after Sjoevall: Q_j = K (delta cos psi cos alpha - c)^1.5 for point contact
    with the free travel c along the contact line.
    """
    row = _Row(bearing)
    near = float(brentq(lambda d: _formula_loads(bearing, row.azimuth, d)[1] - force, 1e-7, 1e-3, xtol=1e-12))
    displacement = float(brentq(lambda d: row.loads(d)[1] - force, 0.9 * near, 1.1 * near, xtol=1e-10))
    load, _ = row.loads(displacement)
    return BarrelLoads(
        force=force,
        displacement=displacement,
        azimuth=row.azimuth,
        load=load,
        formula=_formula_loads(bearing, row.azimuth, near)[0],
        formula_displacement=near,
        integral_largest=_integral_largest(bearing, force),
        contact_angle=row.angles.copy(),
        balance=row.balance,
        searches=row.searches,
    )


def _formula_loads(bearing: BarrelBearing, azimuth: Float, displacement: float) -> tuple[Float, float]:
    cosine = math.cos(bearing.contact_angle)
    squeeze = displacement * np.cos(azimuth) * cosine - bearing.clearance
    load = bearing.pair_factor * np.maximum(squeeze, 0.0) ** POINT_EXPONENT
    return load, ROWS * float((load * np.cos(azimuth)).sum()) * cosine


def _integral_largest(bearing: BarrelBearing, force: float) -> float:
    """Return the largest load from the continuous load zone: the sum over very many rollers, [N]."""
    cosine, share = math.cos(bearing.contact_angle), bearing.roller_count / _MANY
    azimuth = 2.0 * math.pi * np.arange(_MANY) / _MANY
    least = bearing.clearance / cosine
    found = brentq(
        lambda d: share * _formula_loads(bearing, azimuth, d)[1] - force, least, least + 1e-3, xtol=1e-13
    )
    return float(_formula_loads(bearing, azimuth, float(found))[0].max())
