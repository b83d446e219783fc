"""What bearings of every kind of roller have in common: cones, cylinders and barrels in two rows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Self

if TYPE_CHECKING:
    from beardyn_core.base.arrays import Float
    from beardyn_core.bearing.geometry import CageData, Material
    from beardyn_core.bearing.kinematics import FaultFrequencies

KINDS = ("tapered", "cylindrical", "spherical")
ROW_COUNT = 2


class RollerBearing:
    """A double-row roller bearing of any kind.

    Ratings, kinematics, load distribution and the monitor read these members and no others; what is derived
    follows from the numbers of the file of each kind.
    """

    kind: ClassVar[str] = KINDS[0]
    element: ClassVar[str] = "cone"
    words: ClassVar[str] = "tapered roller bearing"
    self_aligning: ClassVar[bool] = False
    # b_m of ISO 281: 1.1 for cylindrical and tapered rollers, 1.15 for barrels
    steel_factor: ClassVar[float] = 1.1
    # axial force over the radial one that catalogues allow at most
    largest_thrust: ClassVar[float] = math.inf
    # what a search that finds no equilibrium names: the play, and what holds one row along the axle
    play_words: ClassVar[str] = "end play"
    single_row_hint: ClassVar[str] = (
        "a single row needs an axial load or a prop against its own thrust "
        "(mounting.axial_prop_stiffness_MN_per_m)"
    )
    # laminae that a static answer takes when no count is given
    usual_laminae: ClassVar[int] = 1

    if TYPE_CHECKING:

        @property
        def name(self) -> str:
            """Name of the bearing."""

        @property
        def description(self) -> str:
            """What it is, in a few words."""

        @property
        def roller_count(self) -> int:
            """Rollers of one row."""

        @property
        def pitch_diameter(self) -> float:
            """Through the middles of the rollers, [m]."""

        @property
        def roller_diameter(self) -> float:
            """Of the rollers at mid-length, [m]."""

        @property
        def effective_length(self) -> float:
            """Length of the raceway contact at most, [m]."""

        @property
        def roller_length(self) -> float:
            """Whole length of a roller, [m]."""

        @property
        def contact_angle(self) -> float:
            """Angle of the roller axis to the bearing axis, [rad]."""

        @property
        def row_spacing(self) -> float:
            """Distance of the mid-lengths of both rows, [m]."""

        @property
        def bore(self) -> float:
            """Of the inner rings, [m]."""

        @property
        def outer_diameter(self) -> float:
            """Of the outer ring, [m]."""

        @property
        def width(self) -> float:
            """Over both rows, [m]."""

        @property
        def material(self) -> Material:
            """Steel of rings and rollers."""

        @property
        def cage(self) -> CageData:
            """Cage of one row."""

        @property
        def cup_mass(self) -> float:
            """Of the outer ring or rings, [kg]."""

        @property
        def sources(self) -> tuple[tuple[str, str], ...]:
            """Where each number comes from."""

        @property
        def forced(self) -> bool:
            """Whether it is run although `consistency.check` refuses it."""

        @property
        def half_angle(self) -> float:
            """Half-angle of the roller, 0 where both of its ends are alike, [rad]."""

        @property
        def cup_angle(self) -> float:
            """Angle of the outer contact line, the contact angle of the standards, [rad]."""

        @property
        def cone_angle(self) -> float:
            """The same of the inner one, [rad]."""

        @property
        def cup_radius(self) -> float:
            """Radius of the outer raceway at mid-length of the rollers, [m]."""

        @property
        def cone_radius(self) -> float:
            """Radius of the inner raceway there, [m]."""

        @property
        def cage_ratio(self) -> float:
            """Speed of the cage over that of the shaft in pure rolling, [-]."""

        @property
        def rolling_radii(self) -> tuple[float, float]:
            """Radii of cup and roller that roll on each other, to one scale."""

        @property
        def cup_inertia(self) -> tuple[float, float, float]:
            """Of the outer ring or rings about x, y, z through the bearing centre, [kg m^2]."""

        @property
        def cone_mass(self) -> float:
            """Of the inner rings, [kg]."""

        @property
        def raceway_roughness(self) -> float:
            """Composite rms, [m]."""

        @property
        def cone_line(self) -> tuple[float, float]:
            """Radius and axial place, outwards, of a point of the inner raceway's generator, [m]."""

        @property
        def cup_line(self) -> tuple[float, float]:
            """The same of the outer raceway, at the same axial place, [m]."""

        @property
        def cup_place(self) -> tuple[float, float]:
            """Radius and axial place, outwards, of the middle of the contact with the outer raceway, [m]."""

        @property
        def cone_spin_radii(self) -> tuple[float, float]:
            """Radii of the orbit of the roller's axis and of the roller, to one scale."""

        def normal_gap(self, end_play: float) -> float:
            """Compute the gap between roller and cup along its normal, all parts in the middle, [m]."""

        def radius_at(self, place: Float) -> Float:
            """Compute the radius of the rollers at places along them from mid-length, [m]."""

        def lamina_drop(self, count: int) -> Float:
            """Compute the drop of each of `count` equal laminae of the generator, [m]."""

        @property
        def pressure_centre_spread(self) -> float:
            """Distance of the two pressure centres along the bearing axis, [m]."""

        @property
        def tilt_lever(self) -> float:
            """Lever by which statics measure a tilt as a motion, [m]."""

        @property
        def large_end_radius(self) -> float:
            """Radius of a roller at its larger end, [m]."""

        @property
        def roller_mass(self) -> float:
            """Of one roller, [kg]."""

        @property
        def roller_axial_inertia(self) -> float:
            """About the roller axis, [kg m^2]."""

        @property
        def roller_transverse_inertia(self) -> float:
            """Square to it, [kg m^2]."""

        @property
        def roller_mass_offset(self) -> float:
            """Centre of mass from mid-length, [m]."""

        @property
        def roller_orbit_radius(self) -> float:
            """Radius on which the centres of mass orbit, [m]."""

    @property
    def cup_slant(self) -> float:
        """Angle of the outer raceway to the bearing axis, positive where it opens outwards, [rad]."""
        return self.cup_angle

    @property
    def cone_slant(self) -> float:
        """The same of the inner raceway, [rad]."""
        return self.cone_angle

    @property
    def roller_slant(self) -> float:
        """The same of the rollers' axes, [rad]."""
        return self.contact_angle

    @property
    def roller_profile_radius(self) -> float:
        """Radius of the arc of barrels, 0 where rollers are straight, [m]."""
        return 0.0

    @property
    def clamped(self) -> Self:
        """The bearing with its rollers just touching, where its play is a dimension of its rings."""
        return self

    def mounted(self, end_play: float) -> Self:
        """Give the bearing with the end play of its mounting, where that is a dimension of its ribs."""
        return self

    @property
    def frequencies(self) -> FaultFrequencies:
        """Fault frequencies of one row per shaft revolution."""
        from beardyn_core.bearing.kinematics import fault_frequencies

        return fault_frequencies(self)

    @property
    def gamma(self) -> float:
        """Dm cos(alpha_m) / Dpw, [-]."""
        return self.roller_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def roller_web(self) -> float:
        """Free distance between neighbouring rollers on the pitch circle, [m]."""
        return self.pitch_diameter * math.sin(math.pi / self.roller_count) - self.roller_diameter
