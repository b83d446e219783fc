"""Kernel parameters of the raceway contacts: geometry, laminae, film, traction, losses."""

from __future__ import annotations

from typing import Any, NamedTuple

# rows of the lamina table
LAMINA_PLACE, LAMINA_DROP, LAMINA_STIFFNESS, LAMINA_RADIUS = range(4)


LAMINA_FILM, LAMINA_PRESSURE = 4, 6  # one row each for cup and cone


LAMINA_ROWS = 8

# rows of the work space of coupled laminae
COUPLING_ROWS = 5


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

    log2_factor: Any  # of the film at 1 N on the lamina and 1 m/s, [ring, spring], [log2 m]


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
    log2_largest_slide: float
    log2_pressure: Any  # largest Hertz pressure at 1 N on the lamina, [ring, spring], [log2 kgf/mm^2]


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


class CouplingParams(NamedTuple):
    """Laminae coupled through the half-space; `work` holds nothing from one contact to the next."""

    root: Any  # [lamina, lamina]
    follow: Any  # [lamina, lamina], where one lamina is in balance, given the others
    own_stiffness: Any  # [lamina]
    part_exponent: float  # of the part of a lamina that stands higher than the rest
    work: Any  # [COUPLING_ROWS, lamina, lane]
