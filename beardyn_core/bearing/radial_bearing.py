"""What cylindrical and spherical roller bearings have in common: like roller ends, radial clearance."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import INTERNAL, At, Vector
from beardyn_core.bearing.geometry import CageData, Material
from beardyn_core.bearing.roller_bearing import RollerBearing

MOST_PRELOAD, MOST_CLEARANCE = 1.0e-4, 1.0e-3  # of the diameter [m]


@dataclass(frozen=True, kw_only=True)
class RadialBearing(RollerBearing):
    """A double-row bearing with symmetric rollers, whose play is a radial clearance."""

    usual_laminae: ClassVar[int] = 30
    play_words: ClassVar[str] = "radial clearance"

    name: A[str, At(longest=80), "of the bearing"]
    description: A[str, "what it is, in a few words"] = ""
    roller_count: A[int, At(ge=4, le=60), "per row"]
    pitch_diameter: A[float, At("mm", gt=0.0), "through the middles of the rollers"]
    roller_diameter: A[float, At("mm", gt=0.0), "at mid-length"]
    effective_length: A[float, At("mm", gt=0.0), "of the roller, without the rounding of its ends"]
    roller_length: A[float, At("mm", gt=0.0), "whole length of a roller"]
    bore: A[float, At("mm", gt=0.0), "of the inner rings"]
    outer_diameter: A[float, At("mm", gt=0.0), "of the outer ring"]
    width: A[float, At("mm", gt=0.0), "over both rows, along the bearing axis"]
    radial_clearance: A[
        float,
        At("mm", ge=-1e3 * MOST_PRELOAD, le=1e3 * MOST_CLEARANCE),
        "total radial travel when mounted, negative for preload",
    ]
    raceway_roughness: A[float, At("um", gt=0.0), "composite rms"]
    material: A[Material, "of rings and rollers"] = Material()
    cage: A[CageData, "of one row"]
    cup_mass: A[float, At("kg", gt=0.0), "of the outer rings of both rows"]
    cup_inertia: A[Vector, At("kg_m2", gt=0.0), "about x, y, z through the bearing centre"]
    cone_mass: A[float, At("kg", gt=0.0), "of the inner rings and the spacer"]
    sources: tuple[tuple[str, str], ...] = ()
    forced: A[bool, INTERNAL, "take it although `consistency.check` refuses it: for experiments"] = False

    def __repr__(self) -> str:
        """Give the main dimensions, and how many numbers are assumed or derived."""
        weak = sum(source.startswith(("assumed", "derived")) for _, source in self.sources)
        return (
            f"{type(self).__name__} {self.name}: 2 x {self.roller_count} rollers of "
            f"{self.roller_diameter * 1e3:.4g} x {self.roller_length * 1e3:.4g} mm on "
            f"{self.pitch_diameter * 1e3:.5g} mm, radial clearance {self.radial_clearance * 1e3:.3g} mm; "
            f"{weak} numbers assumed or derived, see .sources"
        )

    @property
    def half_angle(self) -> float:
        """0: both ends of a roller are alike, [rad]."""
        return 0.0

    @property
    def cup_angle(self) -> float:
        """Angle of the outer contact line to the radial plane, [rad]."""
        return self.contact_angle

    @property
    def cone_angle(self) -> float:
        """The same of the inner one, [rad]."""
        return self.contact_angle

    @property
    def centre_distance(self) -> float:
        """From the bearing axis to the roller's middle along the contact line, [m]."""
        return 0.5 * self.pitch_diameter / math.cos(self.contact_angle)

    @property
    def cup_radius(self) -> float:
        """Radius of the outer raceway at mid-length of the rollers, [m]."""
        return 0.5 * (self.pitch_diameter + self.roller_diameter * math.cos(self.contact_angle))

    @property
    def cone_radius(self) -> float:
        """Radius of the inner raceway there, [m]."""
        return 0.5 * (self.pitch_diameter - self.roller_diameter * math.cos(self.contact_angle))

    def rolling_radius(self, ring: str) -> float:
        """Compute the radius in rolling direction of a cylinder on a plane in place of a contact, [m].

        Parameters
        ----------
        ring : str
            ``cup`` or ``cone``.
        """
        roller = 0.5 * self.roller_diameter
        side = 1.0 if ring == "cup" else -1.0
        return 1.0 / (1.0 / roller - side / (self.centre_distance + side * roller))

    def normal_gap(self, end_play: float = 0.0) -> float:
        """Compute the gap between roller and cup along the contact line, all parts in the middle, [m].

        The end play, that of the ribs, opens no raceway.
        """
        return 0.5 * self.radial_clearance * math.cos(self.contact_angle)

    def radius_at(self, place: Float) -> Float:
        """Compute the radius of the rollers at places along them from mid-length, less the profile, [m]."""
        return np.asarray(0.5 * self.roller_diameter + 0.0 * place)

    @property
    def cage_ratio(self) -> float:
        """Speed of the cage over that of the shaft in pure rolling, [-]."""
        return 0.5 * (1.0 - self.gamma)

    @property
    def rolling_radii(self) -> tuple[float, float]:
        """Radii of outer raceway and roller that roll on each other, [m]."""
        return self.cup_radius, 0.5 * self.roller_diameter

    @property
    def cone_spin_radii(self) -> tuple[float, float]:
        """Radii of the orbit of the roller's axis and of the roller, [m]."""
        return 0.5 * self.pitch_diameter, 0.5 * self.roller_diameter

    @property
    def cup_line(self) -> tuple[float, float]:
        """Radius and axial place of a point of the outer raceway of a row, [m]."""
        return self.cup_radius, 0.5 * self.row_spacing

    @property
    def cup_place(self) -> tuple[float, float]:
        """Radius and axial place of the middle of the contact with the outer raceway, [m]."""
        return self.cup_line

    @property
    def large_end_radius(self) -> float:
        """Radius of a roller at both ends, [m]."""
        return 0.5 * self.roller_diameter

    @property
    def roller_mass(self) -> float:
        """Mass of a roller as a cylinder over its whole length, [kg]."""
        return 0.25 * math.pi * self.material.density * self.roller_diameter**2 * self.roller_length

    @property
    def roller_axial_inertia(self) -> float:
        """Jx: about the roller axis, [kg m^2]."""
        return 0.125 * self.roller_mass * self.roller_diameter**2

    @property
    def roller_transverse_inertia(self) -> float:
        """Jy: square to the roller axis through its middle, [kg m^2]."""
        return 0.5 * self.roller_axial_inertia + self.roller_mass * self.roller_length**2 / 12.0

    @property
    def roller_mass_offset(self) -> float:
        """0: the centre of mass lies at mid-length, [m]."""
        return 0.0

    @property
    def roller_orbit_radius(self) -> float:
        """Radius on which the centres of mass orbit, [m]."""
        return 0.5 * self.pitch_diameter
