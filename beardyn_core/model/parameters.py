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


class FilmParams(NamedTuple):
    """Line-contact film; the load and speed exponents of Dowson and Higginson are in the kernel."""

    viscosity: float  # [Pa s]
    pressure_viscosity: float  # [1/Pa]
    roughness: float  # composite rms [m]


class CoulombParams(NamedTuple):
    """Dry friction."""

    friction: float
    regularisation: float  # [m/s]


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


class DampingParams(NamedTuple):
    """Contact damping."""

    time_constant: float  # [s]


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


class FlexibilityParams(NamedTuple):
    """Bending modes of the cup, from two waves upwards, each in two directions."""

    mass: Any  # [mode], [kg]
    stiffness: Any  # [mode], [N/m]
    damping: Any  # [mode], [N s/m]


class SpallParams(NamedTuple):
    """Spalls of one surface; the patch of spall s for rollers of block b is at index s * block_count + b.

    Fields of a patch: azimuth [rad], half width [m], radius of the surface [m], then depth by lamina [m].
    """

    patches: Any  # float64 [spall x block, 3 + lamina, lane]
    block_count: int


class FaultParams(NamedTuple):
    """Spalls by surface."""

    cup: SpallParams | None
    cone: SpallParams | None
    roller: SpallParams | None


class GravityParams(NamedTuple):
    """Free fall."""

    acceleration: float


class AuditParams(NamedTuple):
    """Energy balance is kept."""

    kept: float


class EffectParams(NamedTuple):
    """All switchable effects; ``None`` is absent."""

    damping: DampingParams | None
    film: FilmParams | None
    coulomb: CoulombParams | None
    mixed: MixedParams | None
    rib: RibParams | None
    cage: CageParams | None
    ring_flexibility: FlexibilityParams | None
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
