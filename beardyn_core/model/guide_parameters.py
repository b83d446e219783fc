"""Kernel parameters of ribs and cages."""

from __future__ import annotations

from typing import NamedTuple

from beardyn_core.model.contact_parameters import DampingParams


class RibWindowParams(NamedTuple):
    """Edges of the rib face."""

    low: float  # coordinate along the generator of the face [m]
    high: float
    rounding: float  # radius of the edges [m]


class RibEndParams(NamedTuple):
    """Rim of the spherical roller end."""

    radius: float  # [m]
    place: float  # on the axis from the centre of mass [m]
    cosine: float  # of the angle under which the sphere's centre sees it
    smallest_bend: float  # floor of the second derivative in the search along the rim


class RibShearParams(NamedTuple):
    """Film that shears up to a limit."""

    viscosity: float  # [Pa s]
    pressure_viscosity: float  # [1/Pa]
    limiting_shear: float
    pressure: float  # mean pressure over the root of the approach [Pa/m^0.5]


class RibFilmParams(NamedTuple):
    """Point-contact film of the rib and the friction that goes with it."""

    log2_factor: float  # film thickness at 1 N and 1 m/s [log2 m]
    speed_exponent: float
    load_exponent: float
    log2_roughness: float  # composite rms [log2 m]
    boundary_friction: float
    film_friction: float
    sheared: RibShearParams | None


class RibDrillingParams(NamedTuple):
    """Friction of the spin inside the contact ellipse."""

    reach: float  # 0.18 a^2 over the approach [m]


class RibParams(NamedTuple):
    """Large roller end on the cone rib."""

    stiffness: float  # [N/m^1.5]
    sphere_radius: float  # [m]
    sphere_place: float  # of the sphere centre on the axis from the centre of mass [m]
    normal_axial: float
    normal_radial: float
    distance: float  # of the nominal contact along the normal [m]
    friction: float
    regularisation: float  # [m/s]
    window: RibWindowParams | None
    end: RibEndParams | None
    film: RibFilmParams | None
    drilling: RibDrillingParams | None


class SmallRibParams(NamedTuple):
    """Small roller end at the cone's small rib."""

    radius: float  # of the rib's contact circle [m]
    place: float  # of that circle, axial from the cone's origin [m]
    end_place: float  # of the flat end on the axis from the centre of mass [m]
    stiffness: float  # [N/m]
    damping: DampingParams
    friction: float
    regularisation: float  # [m/s]


class PocketFilmParams(NamedTuple):
    """Lubricant between roller and bar at one of the two abscissae; see `kernels.pocket_film`."""

    wedge: float  # load over rolling speed and radius over gap [N s/m]
    squeeze: float  # load over speed of approach and (radius over gap)^1.5 [N s/m]
    shear: float  # friction over slip and (radius over gap)^0.5 [N s/m]
    thinnest: float  # [m]
    inverse_layer: float  # of the thickness of the lubricant's layer [1/m]
    share: float  # over the squeeze resistance that the explicit cage can follow [m/(N s)]


class LandParams(NamedTuple):
    """Land of a cage in a cylinder of cup or cone; see `kernels.land`."""

    body: float  # row of the ring in the array of bodies
    outside: float  # +1 when the cage runs inside the ring, -1 around it
    radius: float  # [m]
    clearance: float  # radial [m]
    half_width: float  # [m]
    place: float  # outward from the cage's centre of mass [m]
    film: float  # eta R L^3 / (2 C^2) [N s]
    drag: float  # Petroff's torque over speed [N m s]
    most_eccentric: float  # bound of the eccentricity ratio in the film's formulas
    stiffness: float  # of an edge [N/m]
    damping: float  # [N s/m]
    friction: float
    regularisation: float  # [m/s]


class RotatingCageParams(NamedTuple):
    """The cage follows the rings but for its spin."""

    follows: float


class KinematicCageParams(NamedTuple):
    """The cage follows the rings, its spin is prescribed."""

    speed_ratio: float  # over the shaft
    stiffness: float  # of each of two springs [N/m]
    damping: float  # [N s/m]


class CageParams(NamedTuple):
    """Pockets of a cage."""

    stiffness: float  # [N/m]
    damping: float  # [N s/m]
    half_clearance: float  # along the pitch circle [m]
    half_end_clearance: float  # along the roller [m]
    bar_sine: float  # inclination of the bar faces
    bar_cosine: float
    bar_place: float  # contact points on the bars, from the centre of mass [m]
    roller_height: float  # nominal roller centre from the cage axis [m]
    roller_place: float  # nominal roller centre along the pocket axis, from the cage's centre of mass [m]
    axis_radial: float
    axis_axial: float
    friction: float
    regularisation: float  # [m/s]
    place: float  # axial place of its centre of mass from the middle plane [m]
    mass: float  # [kg]
    polar_inertia: float  # [kg m^2]
    transverse_inertia: float
    film: PocketFilmParams | None = None
    land: LandParams | None = None
    rotating: RotatingCageParams | None = None  # six degrees of freedom without this and the next
    kinematic: KinematicCageParams | None = None
