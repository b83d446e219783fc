"""Kernel parameters: named tuples of numbers and arrays; an absent effect is ``None``.

Kernels are specialised by the types of these members, so ``None`` compiles to nothing. Every number is a
``float`` and every array is writable and C-contiguous: anything else would be a new specialisation.
"""

from __future__ import annotations

from typing import Any, NamedTuple

# rows of the lamina table
LAMINA_PLACE, LAMINA_DROP, LAMINA_STIFFNESS, LAMINA_RADIUS = range(4)
LAMINA_FILM, LAMINA_PRESSURE = 4, 6  # one row each for cup and cone
LAMINA_ROWS = 8


class RacewayParams(NamedTuple):
    """One raceway: cone angle as sine and cosine, +1 for the cup and -1 for the cone, normal gap [m]."""

    sine: float
    cosine: float
    side: float
    gap: float


class RollerParams(NamedTuple):
    """Rigid roller: mass [kg], inertia about and across the axis [kg m^2], shape [m]."""

    mass: float
    axial_inertia: float
    transverse_inertia: float
    radius: float  # of the cone at the centre of mass
    taper: float  # tangent of the half angle
    apex: float  # axial place of the raceway apex
    half_length: float
    mass_offset: float


class ThermalFilmParams(NamedTuple):
    """Film reduction by inlet shear heating, 1 / (1 + coefficient L^exponent)."""

    log2_loading: float  # of L at 1 m/s
    coefficient: float
    exponent: float


class RigidFilmParams(NamedTuple):
    """Film of rigid surfaces, H = 4.9 U / W."""

    log2_factor: Any  # of the film at 1 N on the lamina and 1 m/s, [ring, lamina], [log2 m]


class RoelandsParams(NamedTuple):
    """Viscosity at pressure: log2(eta / eta_0) = log2_level ((1 + 5.1e-9 p)^exponent - 1)."""

    log2_level: float
    exponent: float


class FilmParams(NamedTuple):
    """Line-contact film; the rest of its formula is in the lamina table."""

    viscosity: float  # [Pa s]
    pressure_viscosity: float  # [1/Pa]
    roughness: float  # composite rms [m]
    speed_exponent: float
    load_exponent: float
    thermal: ThermalFilmParams | None
    rigid: RigidFilmParams | None
    roelands: RoelandsParams | None


class SlipLawParams(NamedTuple):
    """Which law rounds the corner of dry friction: the member that is not ``None``."""

    threlfall: float | None  # steepness, 3
    ambrosio_start: float | None  # [m/s]
    arctangent: float | None  # steepness, 1


class CoulombParams(NamedTuple):
    """Dry friction."""

    friction: float
    regularisation: float  # [m/s]
    law: SlipLawParams | None = None


class ShearedFilmParams(NamedTuple):
    """Film that shears up to a limit."""

    limiting_shear: float


class MixedParams(NamedTuple):
    """Boundary and full-film friction blended over the film parameter."""

    friction: float
    regularisation: float  # [m/s]
    film_friction: float
    boundary_film: float
    full_film: float
    sheared_film: ShearedFilmParams | None
    law: SlipLawParams | None = None


class AiharaParams(NamedTuple):
    """Aihara's traction: parts of its logarithms that only the oil decides."""

    log2_slide: float
    log2_friction: float
    largest_slide: float


class EyringParams(NamedTuple):
    """Film with Eyring's sinh law."""

    stress: float  # [Pa]


class LoadSharingParams(NamedTuple):
    """Asperities and film share the load; the film has the law of the member that is not ``None``."""

    friction: float
    slope: float
    log2_roughness: float  # [log2 m]
    aihara: AiharaParams | None
    eyring: EyringParams | None
    bair_winer: ShearedFilmParams | None
    inlet: float | None  # shear of the gap around the contact [N s/m Pa^0.5/N^0.5 m^0.5]


class DampingParams(NamedTuple):
    """Contact damping."""

    time_constant: float  # [s]


class PowerLawRollingParams(NamedTuple):
    """Rolling couple as powers of speed and load."""

    log2_couple: Any  # [ring], at 1 N and 1 m/s [log2 N m]
    speed_exponent: float
    load_exponent: float


class BibouletHoupertParams(NamedTuple):
    """Rolling couple between the rigid and the elastic regime."""

    log2_rigid: Any  # [ring], at 1 N and 1 m/s [log2 N m]
    log2_elastic: Any  # [ring], at 1 m/s [log2 N m]


class ThermalRollingParams(NamedTuple):
    """Heating of the inlet."""

    log2_loading: float  # thermal loading parameter at 1 m/s


class HysteresisParams(NamedTuple):
    """Elastic hysteresis."""

    couple: Any  # [ring], at 1 N [N m]


class RollingParams(NamedTuple):
    """Couple of the raceway contacts against rolling."""

    power_law: PowerLawRollingParams | None
    biboulet_houpert: BibouletHoupertParams | None
    thermal: ThermalRollingParams | None
    hysteresis: HysteresisParams | None
    supply: float
    regularisation: Any  # [ring] [rad/s]


class DragParams(NamedTuple):
    """Medium around the rollers."""

    orbit: float  # force at 1 m/s [N]
    cylinder: float  # couple at 1 rad/s [N m]
    cylinder_exponent: float  # of the speed in couple over speed
    disc: float  # couple at 1 rad/s, both ends [N m]


class SealParams(NamedTuple):
    """Both seals on the shaft."""

    torque: float  # [N m]
    speed_coefficient: float  # [N m s/rad]
    regularisation: float  # [rad/s]


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


class CouplingParams(NamedTuple):
    """Laminae coupled through the half-space; `work` holds nothing from one contact to the next."""

    root: Any  # [lamina, lamina]
    follow: Any  # [lamina, lamina], where one lamina is in balance, given the others
    own_stiffness: Any  # [lamina]
    work: Any  # [4, lamina, lane]


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


# fields of a patch, and of a spring (a lamina, or the sound or damaged part of one)
PLACE_AZIMUTH, PLACE_REPEATS, PLACE_RADIUS, PLACE_ARC_RADIUS, PLACE_REACH, PLACE_SCALE = range(6)
PATCH_FIELDS = 6
PATCH_POINTS = 258  # of a path: 256 cells and one point beyond
SPRING_SHARE, SPRING_GAP, SPRING_RING_SLOPE, SPRING_ROLLER_SLOPE = range(4)
SPRING_FIELDS = 4


class FlexibilityParams(NamedTuple):
    """Bending modes of the cup, from two waves upwards, each in two directions."""

    mass: Any  # [mode], [kg]
    stiffness: Any  # [mode], [N/m]
    damping: Any  # [mode], [N s/m]


class SurfaceParams(NamedTuple):
    """Patches of one surface."""

    places: Any  # [patch, PATCH_FIELDS]: centre [rad], repeats a turn, radius [m], radius by repeats, reach
    present: Any  # [block, patch, lane], 1 where the lane's roller meets the patch
    cover: Any  # [patch, lamina], share of the lamina's length
    paths: Any  # [patch x lamina x PATCH_POINTS], gap over even arcs from the centre to the reach [m]


class DamageParams(NamedTuple):
    """Springs of a contact near a patch: sound parts of all laminae, then their damaged parts."""

    laminae: Any  # the lamina table twice over [row of the table, 2 x lamina]
    springs: Any  # [far or near, spring x SPRING_FIELDS, lane]; far is constant, near is work space


class WaveParams(NamedTuple):
    """Waviness of one surface; a row of the table is one turn and two points more."""

    table: Any  # flat [m]
    first: Any  # [block, 1, lane], where the lane's row of the table begins
    points: float  # of one turn


class FaultParams(NamedTuple):
    """Faults; ``None`` is absent."""

    cup: SurfaceParams | None
    cone: SurfaceParams | None
    roller: SurfaceParams | None
    cup_damage: DamageParams | None  # present with any patch of cup or rollers
    cone_damage: DamageParams | None
    cup_waves: WaveParams | None
    cone_waves: WaveParams | None
    roller_waves: WaveParams | None
    pockets: Any  # half of the added clearance [block, 1, lane], [m]


class GravityParams(NamedTuple):
    """Free fall."""

    acceleration: float


class AuditParams(NamedTuple):
    """Energy balance is kept."""

    kept: float


class EffectParams(NamedTuple):
    """All switchable effects; ``None`` is absent."""

    damping: DampingParams | None
    coupling: CouplingParams | None
    film: FilmParams | None
    coulomb: CoulombParams | None
    mixed: MixedParams | None
    load_sharing: LoadSharingParams | None
    rolling: RollingParams | None
    drag: DragParams | None
    rib: RibParams | None
    small_rib: SmallRibParams | None
    cage: CageParams | None
    ring_flexibility: FlexibilityParams | None
    seal: SealParams | None
    gravity: GravityParams | None
    faults: FaultParams
    audit: AuditParams | None


class BoxCoupling(NamedTuple):
    """Box whose centre of mass or whose springs are not at the bearing centre: full matrices about it."""

    mass: Any  # [6, 6]
    inverse_mass: Any  # [6, 6]
    stiffness: Any  # [6, 6]
    damping: Any  # [6, 6]
    weight: Any  # [6], force and moment at 1 m/s^2 of gravity


class MountingParams(NamedTuple):
    """Rings and suspension, world axes."""

    cup_moves: float
    journal_tilts: float
    box_mass: float  # with the cup [kg]
    box_inertia: Any  # [3]
    journal_mass: float  # with the cones [kg]
    journal_inertia: float
    stiffness: Any  # [6], force then moment
    damping: Any  # [6]
    preload: Any  # [6], suspension force at rest
    coupling: BoxCoupling | None


class Parameters(NamedTuple):
    """Everything constant during a run."""

    step: float  # [s]
    roller: RollerParams
    cup: RacewayParams
    cone: RacewayParams
    laminae: Any  # [row of the table, lamina]
    rollers: Any  # [block, ROLLER_CONSTANTS, lane]
    mounting: MountingParams
    effects: EffectParams
