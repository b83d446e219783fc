"""Geometry of the double-row tapered roller bearing, closed on a common apex.

Given are pitch diameter, mean roller diameter and mean contact angle; cup angle, cone angle and roller
half-angle follow from the condition that roller, cup raceway and cone raceway share one apex on the
bearing axis. Sphere radius and contact height give the rib angle. Nothing that follows is stored.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from beardyn_core.bearing.material import Material
from beardyn_core.bearing.profile import Profile

if TYPE_CHECKING:
    from beardyn_core.bearing.kinematics import FaultFrequencies


@dataclass(frozen=True)
class CageData:
    """The cage of one row.

    Parameters
    ----------
    mass : float
        [kg].
    polar_inertia : float
        About the bearing axis (y), [kg m^2].
    transverse_inertia : float
        About x or z through its centre, [kg m^2].
    circumferential_clearance : float
        Total clearance of a roller in its pocket along the pitch circle, [m].
    axial_clearance : float
        Total clearance of a roller in its pocket along the roller axis, [m].
    stiffness : float
        Of one pocket contact, [N/m].
    damping : float
        Of one pocket contact, [N s/m].
    """

    mass: float
    polar_inertia: float
    transverse_inertia: float
    circumferential_clearance: float
    axial_clearance: float
    stiffness: float
    damping: float


@dataclass(frozen=True)
class Bearing:
    """A double-row tapered roller bearing in O arrangement (large roller ends on the outer sides).

    Parameters
    ----------
    name, description : str
    roller_count : int
        Rollers per row.
    pitch_diameter : float
        At mid-length of the rollers, [m].
    roller_diameter : float
        Mean roller diameter, [m].
    effective_length : float
        Length of the raceway contact, [m].
    roller_length : float
        Overall roller length, [m].
    contact_angle : float
        Angle of the roller axis to the bearing axis, the mean of cup and cone angle, [rad].
    row_spacing : float
        Distance of the roller mid-lengths of both rows along the bearing axis, [m].
    sphere_ratio : float
        Radius of the spherical large end over the distance from the apex to the edge of that end, [-].
    rib_contact_height : float
        Height of the rib contact above the cone raceway, measured square to the roller axis, [m].
    bore, outer_diameter, width : float
        Envelope, [m].
    end_play : float
        Total axial travel when mounted, negative for preload, [m].
    raceway_roughness, rib_roughness : float
        Composite rms roughness of the contact, [m].
    profile : Profile
    material : Material
    cage : CageData
        Of one row.
    cup_mass : float
        [kg].
    cup_inertia : tuple of 3 floats
        About x, y, z through the bearing centre, [kg m^2].
    cone_mass : float
        Both cones and the spacer, [kg].
    sources : tuple of (field, source) pairs
        Where each number comes from, or ``assumed``.
    nominal_cup_angle, nominal_cone_angle : float or None
        Angles a catalogue states; only compared with the closed ones, [rad].
    angle_tolerance : float
        Allowed difference between stated and closed angles, [rad].
    rib_height, rib_undercut : float
        Upper and lower end of the rib face above the cone raceway, measured like `rib_contact_height`, [m].
    roller_chamfer : float
        Radius of the large end less that of its spherical face, [m].
    small_rib_height : float
        Height of the small rib above the cone raceway, [m].
    small_rib_clearance : float
        Free travel of a roller along its axis between the ribs, [m].
    forced : bool
        Run it although `consistency.check` refuses it: for experiments with impossible bearings.
    """

    name: str
    description: str
    roller_count: int
    pitch_diameter: float
    roller_diameter: float
    effective_length: float
    roller_length: float
    contact_angle: float
    row_spacing: float
    sphere_ratio: float
    rib_contact_height: float
    bore: float
    outer_diameter: float
    width: float
    end_play: float
    raceway_roughness: float
    rib_roughness: float
    profile: Profile
    material: Material
    cage: CageData
    cup_mass: float
    cup_inertia: tuple[float, float, float]
    cone_mass: float
    sources: tuple[tuple[str, str], ...] = field(default=())
    nominal_cup_angle: float | None = None
    nominal_cone_angle: float | None = None
    angle_tolerance: float = math.radians(0.25)
    rib_height: float = 5.0e-3
    rib_undercut: float = 1.0e-3
    roller_chamfer: float = 0.5e-3
    small_rib_height: float = 2.0e-3
    small_rib_clearance: float = 0.4e-3
    forced: bool = False

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
    def frequencies(self) -> FaultFrequencies:
        """Fault frequencies of one row per shaft revolution."""
        from beardyn_core.bearing.kinematics import fault_frequencies

        return fault_frequencies(self)

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
    def gamma(self) -> float:
        """Dm cos(alpha_m) / Dpw, [-]."""
        return self.roller_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def pressure_centre_spread(self) -> float:
        """Distance of the two pressure centres along the bearing axis, [m]."""
        return self.row_spacing + self.pitch_diameter * math.tan(self.cup_angle)

    @property
    def roller_web(self) -> float:
        """Free distance between neighbouring rollers on the pitch circle, [m]."""
        return self.pitch_diameter * math.sin(math.pi / self.roller_count) - self.roller_diameter

    @property
    def roller_mass(self) -> float:
        """Of the truncated cone over the overall length, [kg]."""
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
        """Integral of s^(power - 1) over the roller, s from the apex, [m^power]."""
        near = self.apex_distance - 0.5 * self.roller_length
        far = self.apex_distance + 0.5 * self.roller_length
        return float(far**power - near**power) / power
