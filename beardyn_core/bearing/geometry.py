"""Geometry of the double-row tapered roller bearing, closed on a common apex.

Given are pitch diameter, mean roller diameter and mean contact angle; cup angle, cone angle and roller
half-angle follow from the condition that roller, cup raceway and cone raceway share one apex on the
bearing axis. Sphere radius and contact height give the rib angle. Nothing that follows is stored.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.base.arrays import Float
from beardyn_core.base.edge import INTERNAL, At, Vector
from beardyn_core.bearing.profile import Profile
from beardyn_core.bearing.roller_bearing import RollerBearing

MOST_END_PLAY = 5.0e-3  # either way, [m]; rollers keep their raceways and ribs within it


@dataclass(frozen=True)
class Material:
    """Steel of rings and rollers."""

    youngs_modulus: A[float, At("GPa", gt=0.0, ge=10.0, le=1000.0), "of the steel"] = 206.0e9
    poisson_ratio: A[float, At(ge=0.0, lt=0.5), "of the steel"] = 0.3
    density: A[float, At("kg_per_m3", gt=0.0, ge=500.0, le=25000.0), "of the steel"] = 7830.0

    @property
    def contact_modulus(self) -> float:
        """E' = 2 / ((1 - nu^2)/E + (1 - nu^2)/E), twice the Hertz modulus E*, [Pa]."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)


@dataclass(frozen=True)
class CageData:
    """The cage of one row."""

    mass: A[float, At("kg", gt=0.0), "of the cage of one row"]
    polar_inertia: A[float, At("kg_m2", gt=0.0), "about the bearing axis"]
    transverse_inertia: A[float, At("kg_m2", gt=0.0), "about x or z through its centre"]
    circumferential_clearance: A[float, At("mm", gt=0.0), "total, of a roller in its pocket"]
    axial_clearance: A[float, At("mm", gt=0.0), "total, of a roller in its pocket"]
    stiffness: A[float, At("MN_per_m", gt=0.0), "of one pocket contact"]
    damping: A[float, At("N_s_per_m", ge=0.0), "of one pocket contact"]


@dataclass(frozen=True, kw_only=True)
class Bearing(RollerBearing):
    """A double-row tapered roller bearing, O arrangement.

    The large roller ends are on the outer sides. Heights above the cone raceway are measured square to the
    roller axis. `sources` has the source of each number, or ``assumed``.
    """

    name: A[str, At(longest=80), "of the bearing"]
    description: A[str, "what it is, in a few words"] = ""
    roller_count: A[int, At(ge=4, le=60), "per row"]
    pitch_diameter: A[float, At("mm", gt=0.0), "through the roller axes at mid-length"]
    roller_diameter: A[float, At("mm", gt=0.0), "mean, at mid-length"]
    effective_length: A[float, At("mm", gt=0.0), "of the raceway contact"]
    roller_length: A[float, At("mm", gt=0.0), "whole length of a roller"]
    contact_angle: A[float, At("deg", gt=0.0, lt=45.0), "roller axis to bearing axis"]
    row_spacing: A[float, At("mm", gt=0.0), "between the roller mid-lengths of both rows"]
    sphere_ratio: A[float, At(gt=0.0), "radius of the roller's large end over the apex distance"]
    rib_contact_height: A[float, At("mm", gt=0.0), "above the cone raceway"]
    bore: A[float, At("mm", gt=0.0), "of the cones"]
    outer_diameter: A[float, At("mm", gt=0.0), "of the cup"]
    width: A[float, At("mm", gt=0.0), "over both rows, along the bearing axis"]
    end_play: A[float, At("mm", ge=-0.5, le=2.0), "total axial travel when mounted"]
    raceway_roughness: A[float, At("um", gt=0.0), "composite rms"]
    rib_roughness: A[float, At("um", gt=0.0), "composite rms"]
    profile: A[Profile, "of the roller generator"] = Profile()
    material: A[Material, "of rings and rollers"] = Material()
    cage: A[CageData, "of one row"]
    cup_mass: A[float, At("kg", gt=0.0), "of the whole cup"]
    cup_inertia: A[Vector, At("kg_m2", gt=0.0), "about x, y, z through the bearing centre"]
    cone_mass: A[float, At("kg", gt=0.0), "both cones and the spacer"]
    sources: tuple[tuple[str, str], ...] = ()
    nominal_cup_angle: A[
        float | None, At("deg", gt=0.0, key="cup_angle"), "catalogue value, only compared with the closed one"
    ] = None
    nominal_cone_angle: A[
        float | None,
        At("deg", gt=0.0, key="cone_angle"),
        "catalogue value, only compared with the closed one",
    ] = None
    angle_tolerance: A[float, At("deg", gt=0.0), "allowed difference of catalogue and closed angles"] = (
        math.radians(0.25)
    )
    rib_height: A[float, At("mm", gt=0.0), "upper end of the rib face above the cone raceway"] = 5.0e-3
    rib_undercut: A[float, At("mm", gt=0.0), "lower end of the rib face above the cone raceway"] = 1.0e-3
    roller_chamfer: A[float, At("mm", gt=0.0), "radius of the large end less that of its spherical face"] = (
        0.5e-3
    )
    small_rib_height: A[float, At("mm", gt=0.0), "above the cone raceway"] = 2.0e-3
    small_rib_clearance: A[
        float, At("mm", ge=0.0), "free travel of a roller along its axis between the ribs"
    ] = 0.4e-3
    forced: A[bool, INTERNAL, "run it although `consistency.check` refuses it: for experiments"] = False

    def __repr__(self) -> str:
        """Give the main dimensions, and how many numbers are assumed or derived."""
        weak = sum(source.startswith(("assumed", "derived")) for _, source in self.sources)
        return (
            f"Bearing {self.name}: 2 x {self.roller_count} rollers of "
            f"{self.roller_diameter * 1e3:.4g} x {self.roller_length * 1e3:.4g} mm on "
            f"{self.pitch_diameter * 1e3:.5g} mm at {math.degrees(self.contact_angle):.4g} deg, end play "
            f"{self.end_play * 1e3:.3g} mm; {weak} numbers assumed or derived, see .sources"
        )

    @property
    def apex_distance(self) -> float:
        """A: from the common apex to the roller mid-length along the roller axis, [m]."""
        return self.pitch_diameter / (2.0 * math.sin(self.contact_angle))

    @property
    def half_angle(self) -> float:
        """phi: half-angle of the roller cone, [rad]."""
        return math.atan(self.roller_diameter / (2.0 * self.apex_distance))

    @property
    def cup_angle(self) -> float:
        """alpha_o: half-angle of the cup raceway, [rad]."""
        return self.contact_angle + self.half_angle

    @property
    def cone_angle(self) -> float:
        """alpha_i: half-angle of the cone raceway, [rad]."""
        return self.contact_angle - self.half_angle

    @property
    def contact_distance(self) -> float:
        """From the common apex to the roller mid-length along the raceways, [m]."""
        return self.apex_distance / math.cos(self.half_angle)

    @property
    def cup_radius(self) -> float:
        """Radius of the cup raceway at the mid-length of the rollers, [m]."""
        return self.contact_distance * math.sin(self.cup_angle)

    @property
    def cone_radius(self) -> float:
        """Radius of the cone raceway at the mid-length of the rollers, [m]."""
        return self.contact_distance * math.sin(self.cone_angle)

    @property
    def roller_orbit_radius(self) -> float:
        """Radius on which the centres of mass of the rollers orbit, [m]."""
        return 0.5 * self.pitch_diameter + self.roller_mass_offset * math.sin(self.contact_angle)

    @property
    def cone_line(self) -> tuple[float, float]:
        """Radius and axial place of a point of the cone raceway's generator: its apex, [m]."""
        return 0.0, self.apex_place

    @property
    def cup_line(self) -> tuple[float, float]:
        """The same of the cup raceway, [m]."""
        return 0.0, self.apex_place

    @property
    def cup_place(self) -> tuple[float, float]:
        """Radius and axial place of the middle of the contact with the cup, [m]."""
        return self.cup_radius, self.apex_place + self.contact_distance * math.cos(self.cup_angle)

    def radius_at(self, place: Float) -> Float:
        """Compute the radius of the rollers at places along them from mid-length, [m]."""
        return (self.apex_distance + place) * math.tan(self.half_angle)

    def lamina_drop(self, count: int) -> Float:
        """Compute the drop of each of `count` equal laminae of the generator, [m]."""
        return self.profile.lamina_drop(
            count, self.effective_length, self.roller_diameter, self.material.contact_modulus
        )

    def normal_gap(self, end_play: float) -> float:
        """Compute the gap between roller and cup along the cup's normal, all parts in the middle, [m].

        Parameters
        ----------
        end_play : float
            Total axial travel, [m].
        """
        return 0.5 * end_play * math.sin(self.cup_angle)

    @property
    def large_end_radius(self) -> float:
        """r_L: roller radius at its large end, [m]."""
        return (self.apex_distance + 0.5 * self.roller_length) * math.tan(self.half_angle)

    @property
    def small_end_radius(self) -> float:
        """r_S: roller radius at its small end, [m]."""
        return (self.apex_distance - 0.5 * self.roller_length) * math.tan(self.half_angle)

    @property
    def sphere_radius(self) -> float:
        """R_s: radius of the spherical large end, [m]."""
        distance_to_large_end = self.apex_distance + 0.5 * self.roller_length
        return self.sphere_ratio * distance_to_large_end / math.cos(self.half_angle)

    @property
    def sphere_centre(self) -> float:
        """x_s: centre of the end sphere on the roller axis from mid-length, + to the large end, [m].

        The sphere passes through the edge of the large end, so a sphere ratio of 1 puts its centre on
        the apex.
        """
        return 0.5 * self.roller_length - math.sqrt(self.sphere_radius**2 - self.large_end_radius**2)

    @property
    def rib_polar_angle(self) -> float:
        """theta_c: angle between roller axis and rib normal, seen from the sphere centre, [rad]."""
        return math.asin((self.large_end_radius - self.rib_contact_height) / self.sphere_radius)

    @property
    def rib_angle(self) -> float:
        """alpha_f: angle of the rib normal to the radial direction, 90 deg - (alpha_m - theta_c), [rad]."""
        return 0.5 * math.pi - (self.contact_angle - self.rib_polar_angle)

    @property
    def rib_lean(self) -> float:
        """Angle of the rib normal to the bearing axis, alpha_m - theta_c, [rad]."""
        return self.contact_angle - self.rib_polar_angle

    @property
    def rib_face(self) -> tuple[float, float]:
        """Edges of the rib face along its generator from the nominal contact, undercut and corner, [m]."""
        along = 1.0 / math.cos(self.rib_polar_angle)
        low, high = self.rib_undercut - self.rib_contact_height, self.rib_height - self.rib_contact_height
        return low * along, high * along

    @property
    def end_sphere(self) -> tuple[float, float]:
        """Radius and axial place, outwards from the bearing centre, of the end sphere's centre, [m]."""
        return (
            0.5 * self.pitch_diameter + self.sphere_centre * math.sin(self.contact_angle),
            0.5 * self.row_spacing + self.sphere_centre * math.cos(self.contact_angle),
        )

    @property
    def apex_place(self) -> float:
        """Axial place of the apex of a row, outwards from the bearing centre, [m]."""
        return 0.5 * self.row_spacing - self.apex_distance * math.cos(self.contact_angle)

    @property
    def pressure_centre_spread(self) -> float:
        """Distance of the two pressure centres along the bearing axis, [m]."""
        return self.row_spacing + self.pitch_diameter * math.tan(self.cup_angle)

    @property
    def tilt_lever(self) -> float:
        """Lever by which statics measure a tilt as a motion: that of the pressure centres, [m]."""
        return 0.5 * self.pressure_centre_spread

    @property
    def cage_ratio(self) -> float:
        """Speed of the cage over that of the shaft in pure rolling, sin(ai)/(sin(ai) + sin(ao)), [-]."""
        cone, cup = math.sin(self.cone_angle), math.sin(self.cup_angle)
        return cone / (cone + cup)

    @property
    def rolling_radii(self) -> tuple[float, float]:
        """Radii of cup and roller that roll on each other, over their distance from the apex, [-]."""
        return math.sin(self.cup_angle), math.sin(self.half_angle)

    @property
    def cone_spin_radii(self) -> tuple[float, float]:
        """Radii of the orbit of the roller's axis and of the roller, over the distance from the apex, [-]."""
        return math.sin(self.contact_angle), math.sin(self.half_angle)

    @property
    def roller_mass(self) -> float:
        """Mass of a roller as a truncated cone over its overall length, [kg]."""
        return math.pi * self.material.density * math.tan(self.half_angle) ** 2 * self._power_difference(3)

    @property
    def roller_axial_inertia(self) -> float:
        """Jx: about the roller axis, [kg m^2]."""
        slope = math.tan(self.half_angle)
        return 0.5 * math.pi * self.material.density * slope**4 * self._power_difference(5)

    @property
    def roller_mass_offset(self) -> float:
        """zc: centre of mass from mid-length, + to the large end, [m]."""
        return self._power_difference(4) / self._power_difference(3) - self.apex_distance

    @property
    def roller_transverse_inertia(self) -> float:
        """Jy: square to the roller axis through the centre of mass, [kg m^2]."""
        slope = math.tan(self.half_angle)
        about_apex = 0.5 * self.roller_axial_inertia + math.pi * self.material.density * slope**2 * (
            self._power_difference(5)
        )
        return about_apex - self.roller_mass * (self.apex_distance + self.roller_mass_offset) ** 2

    def _power_difference(self, power: int) -> float:
        """Compute the integral of s^(power - 1) over the roller, s from the apex, [m^power]."""
        near = self.apex_distance - 0.5 * self.roller_length
        far = self.apex_distance + 0.5 * self.roller_length
        return float(far**power - near**power) / power
