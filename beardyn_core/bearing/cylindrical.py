"""Geometry of the cylindrical axlebox bearing: two rows, each a single-row bearing with its ribs.

The usual pair is NJ and NJP (in DIN 5412-11 WJ and WJP): rollers run between two ribs of each outer ring; the
inner ring of either row has one rib, at the outer side of the pair, the second as a loose ring. So each row
carries axial load one way, and between both the axle floats by the end play.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import ClassVar, Self

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import INTERNAL, At
from beardyn_core.bearing.profile import Profile
from beardyn_core.bearing.radial_bearing import RadialBearing

RIBS = ("none", "inner", "outer", "both")
LOOSE_RIBS = ("none", "outboard", "both")
_SIDES = {"none": (), "inner": (-1.0,), "outer": (1.0,), "both": (-1.0, 1.0)}


@dataclass(frozen=True, kw_only=True, repr=False)
class CylindricalBearing(RadialBearing):
    """A pair of cylindrical roller bearings, such as NJ and NJP, with a spacer or none between them.

    Sides of ribs are those of a row: ``outer`` is away from the middle of the pair. `sources` states where
    each number comes from, or ``assumed``.
    """

    kind: ClassVar[str] = "cylindrical"
    element: ClassVar[str] = "cylinder"
    words: ClassVar[str] = "cylindrical roller bearing"
    largest_thrust: ClassVar[float] = 0.4  # FAG and INA, catalogue, cylindrical roller bearings
    single_row_hint: ClassVar[str] = (
        "a single row carries thrust towards a rib of its inner ring only, where the outer ring has one at "
        "the other ends of its rollers (cone_ribs, cup_ribs), or on a prop "
        "(mounting.axial_prop_stiffness_MN_per_m)"
    )

    row_spacing: A[float, At("mm", gt=0.0), "between the roller mid-lengths of both rows"]
    profile: A[Profile, "of the roller generator"] = Profile()
    cup_ribs: A[str, At(one_of=RIBS), "sides on which the outer ring of a row has a rib"] = "both"
    cone_ribs: A[str, At(one_of=RIBS), "the same of the inner ring"] = "outer"
    loose_rib: A[
        str, At(one_of=LOOSE_RIBS), "rows whose rib of the inner ring is a loose ring, as that of NJP"
    ] = "outboard"
    end_play: A[float, At("mm", ge=0.0, le=5.0), "total axial travel of the axle between the ribs"]
    roller_play: A[
        float, At("mm", ge=0.0, le=2.0), "free travel of a roller along its axis between ribs of one ring"
    ]
    cup_rib_height: A[float, At("mm", gt=0.0), "above the raceway"]
    cone_rib_height: A[float, At("mm", gt=0.0), "above the raceway"]
    rib_undercut: A[float, At("mm", gt=0.0), "lower end of the rib faces above the raceway"] = 1.0e-3
    rib_contact_height: A[float, At("mm", gt=0.0), "of the roller end on a rib, above the raceway"]
    rib_opening: A[float, At("deg", gt=0.0, le=5.0), "angle of the rib faces to the radial plane"]
    rib_roughness: A[float, At("um", gt=0.0), "composite rms"] = 0.4e-6
    roller_chamfer: A[float, At("mm", gt=0.0), "radius of a roller less that of its crowned ends"] = 0.5e-3
    contact_angle: A[float, INTERNAL] = 0.0

    @property
    def clamped(self) -> Self:
        """The bearing without radial clearance."""
        return replace(self, radial_clearance=0.0)

    def mounted(self, end_play: float) -> Self:
        """Give the bearing with ribs that leave this end play, [m]."""
        return self if end_play == self.end_play else replace(self, end_play=end_play)

    def lamina_drop(self, count: int) -> Float:
        """Compute the drop of each of `count` equal laminae of the generator, [m]."""
        return self.profile.lamina_drop(
            count, self.effective_length, self.roller_diameter, self.material.contact_modulus
        )

    @property
    def cone_line(self) -> tuple[float, float]:
        """Radius and axial place of a point of the inner raceway of a row, [m]."""
        return self.cone_radius, 0.5 * self.row_spacing

    @property
    def pressure_centre_spread(self) -> float:
        """Distance of the two pressure centres along the bearing axis, [m]."""
        return self.row_spacing

    @property
    def tilt_lever(self) -> float:
        """Lever by which statics measure a tilt as a motion, [m]."""
        return 0.5 * self.row_spacing

    @property
    def end_radius(self) -> float:
        """R_s: radius of the crowned roller ends, so that they touch at the contact height, [m]."""
        return (0.5 * self.roller_diameter - self.rib_contact_height) / math.sin(self.rib_opening)

    @property
    def thrust_rib_sides(self) -> tuple[float, ...]:
        """Sides of a row, 1 outer and -1 inner, whose rib of the inner ring passes thrust on.

        The outer ring has one at the other ends of the rollers. Row 0 carries a force on the axle of the same
        sign along y, row 1 of the other.
        """
        return tuple(side for side in self.cone_rib_sides if -side in self.cup_rib_sides)

    @property
    def carries_thrust(self) -> bool:
        """Whether a row has a rib of the inner ring and one of the outer at the other roller ends."""
        return bool(self.thrust_rib_sides)

    @property
    def row_is_held(self) -> bool:
        """Whether one row alone passes thrust on in both directions."""
        return len(self.thrust_rib_sides) == 2

    @property
    def cone_rib_sides(self) -> tuple[float, ...]:
        """Ends of the rollers at which the inner ring has a rib: 1 outer, -1 inner."""
        return _SIDES[self.cone_ribs]

    @property
    def cup_rib_sides(self) -> tuple[float, ...]:
        """The same of the outer ring."""
        return _SIDES[self.cup_ribs]
