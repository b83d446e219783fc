"""Geometry of the spherical roller bearing: two rows of barrels on one spherical outer raceway.

The outer raceway is a sphere about the bearing centre; roller axes are square to the lines from there. The
profile of a barrel is an arc, a little smaller than those of both raceways: what is left is the osculation.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import ClassVar

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import At
from beardyn_core.bearing.radial_bearing import RadialBearing

FEWEST_OF_ELLIPSE = 10
"""Slices of a roller of which contact ellipses can be made."""


@dataclass(frozen=True, kw_only=True, repr=False)
class SphericalBearing(RadialBearing):
    """A double-row spherical roller bearing with symmetric barrels.

    Rollers without load are held by cage and guide ring, which carry nothing in statics. `sources` states
    where each number comes from, or ``assumed``.
    """

    kind: ClassVar[str] = "spherical"
    element: ClassVar[str] = "barrel"
    words: ClassVar[str] = "spherical roller bearing"
    self_aligning: ClassVar[bool] = True
    steel_factor: ClassVar[float] = 1.15
    # it has no ribs: its play is the radial clearance
    end_play: ClassVar[float] = 0.0
    rib_contact_height: ClassVar[float] = 0.0

    contact_angle: A[float, At("deg", gt=0.0, lt=45.0), "roller axis to bearing axis"]
    cup_osculation: A[
        float, At(ge=0.8, lt=1.0), "radius of the roller's profile over that of the outer raceway"
    ]
    cone_osculation: A[
        float, At(ge=0.8, lt=1.0), "radius of the roller's profile over that of the inner raceway's"
    ]

    @property
    def row_spacing(self) -> float:
        """Distance of the mid-lengths of both rows: their contact lines meet at the centre, [m]."""
        return self.pitch_diameter * math.tan(self.contact_angle)

    @property
    def sphere_radius(self) -> float:
        """Radius of the outer raceway, [m]."""
        return self.centre_distance + 0.5 * self.roller_diameter + self.normal_gap()

    @property
    def roller_profile_radius(self) -> float:
        """Radius of the arc of the barrels, [m]."""
        return self.cup_osculation * self.sphere_radius

    @property
    def cone_profile_radius(self) -> float:
        """Radius of the arc of the inner raceways, [m]."""
        return self.roller_profile_radius / self.cone_osculation

    def profile_radius(self, ring: str) -> float:
        """Compute the radius along the roller of a crowned cylinder on a plane in place of a contact, [m]."""
        raceway = self.sphere_radius if ring == "cup" else self.cone_profile_radius
        return 1.0 / (1.0 / self.roller_profile_radius - 1.0 / raceway)

    def lamina_drop(self, count: int) -> Float:
        """Give no drop: that of a barrel is part of its contact law, see `contact_law.barrel_ellipse`."""
        return np.zeros(count)

    @property
    def cone_line(self) -> tuple[float, float]:
        """Radius and axial place of the middle of the inner raceway of a row, [m]."""
        lower = self.centre_distance - 0.5 * self.roller_diameter
        return lower * math.cos(self.contact_angle), lower * math.sin(self.contact_angle)

    @property
    def cup_line(self) -> tuple[float, float]:
        """Radius and axial place of the middle of the contact with the outer raceway, [m]."""
        upper = self.centre_distance + 0.5 * self.roller_diameter
        return upper * math.cos(self.contact_angle), upper * math.sin(self.contact_angle)

    @property
    def cone_groove(self) -> tuple[float, float]:
        """Radius and axial place of the middle of the arc of an inner raceway, [m]."""
        distance = self.centre_distance + self.cone_profile_radius - 0.5 * self.roller_diameter
        return distance * math.cos(self.contact_angle), distance * math.sin(self.contact_angle)

    @property
    def cup_slant(self) -> float:
        """Angle of the outer raceway to the bearing axis: it closes outwards, [rad]."""
        return -self.contact_angle

    @property
    def cone_slant(self) -> float:
        """The same of the inner raceway, [rad]."""
        return -self.contact_angle

    @property
    def roller_slant(self) -> float:
        """The same of the rollers' axes, [rad]."""
        return -self.contact_angle

    @property
    def clamped(self) -> SphericalBearing:
        """The bearing without radial clearance."""
        return replace(self, radial_clearance=0.0)

    @property
    def pressure_centre_spread(self) -> float:
        """0: both rows press towards the bearing centre, [m]."""
        return 0.0

    @property
    def tilt_lever(self) -> float:
        """Lever by which statics measure a tilt as a motion, [m]."""
        return 0.5 * self.pitch_diameter
