"""Cages as kernel parameters: pockets, their films, and lands."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.effects import Cage, KinematicCage, RotatingCage
from beardyn_core.model.layout import CONE_BODY, CUP_BODY
from beardyn_core.scene.scene import Scene


class PocketFilmParams(NamedTuple):
    """Lubricant between roller and bar at one of two abscissae; see `kernels.pocket_film.pocket_loads`."""

    wedge: float  # load over rolling speed and radius over gap [N s/m]
    squeeze: float  # load over speed of approach and (radius over gap)^1.5 [N s/m]
    shear: float  # friction over slip and (radius over gap)^0.5 [N s/m]
    thinnest: float  # [m]
    inverse_layer: float  # of the thickness of the lubricant's layer [1/m]
    share: float  # over the squeeze resistance that explicit cage and rollers can follow [m/(N s)]


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

    step: float  # [s]
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


# Of what swings from step to step for good, where all rollers press one bar of their pockets and the explicit
# cage and rollers answer a step late, and what the film has of it at least, whatever the dry wall takes.
_MOST_OF_STABLE, _LEAST_OF_FILM = 5.0 / 6.0, 1.0 / 8.0
BAR_PLACE = 0.35  # of rollers on a bar, from their middle, over their length
# A film may push back by W^2 / 4c when it opens; its friction pays for that while the bounded resistance c is
# no less than 1/39 of the physical one: 2.45^2 / (4 * 3 sqrt(2) pi * sqrt(2) pi) = 1/39.5.
_PAID = 39.0


def cage_params(scene: Scene, step: float) -> CageParams | None:
    """Lay cage pockets around the nominal rollers, for steps of `step` [s]."""
    bearing, cage = scene.bearing, scene.effects.cage
    if cage is None:
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    radial = 0.5 * bearing.pitch_diameter + bearing.roller_mass_offset * sine
    axial = bearing.roller_mass_offset * cosine
    lean = cage.bar_inclination if isinstance(cage, Cage) else 0.0
    wear = 0.0 if isinstance(cage, KinematicCage) else cage.pocket_wear
    return CageParams(
        step=step,
        stiffness=bearing.cage.stiffness,
        damping=bearing.cage.damping,
        half_clearance=0.5 * (bearing.cage.circumferential_clearance + wear),
        half_end_clearance=0.5 * bearing.cage.axial_clearance,
        bar_sine=math.sin(lean),
        bar_cosine=math.cos(lean),
        bar_place=BAR_PLACE * bearing.effective_length,
        roller_height=radial,
        roller_place=radial * sine + axial * cosine,
        axis_radial=sine,
        axis_axial=cosine,
        friction=0.0 if isinstance(cage, KinematicCage) else cage.friction,
        regularisation=1.0 if isinstance(cage, KinematicCage) else cage.regularisation_speed,
        place=0.5 * bearing.row_spacing,
        mass=bearing.cage.mass,
        polar_inertia=bearing.cage.polar_inertia,
        transverse_inertia=bearing.cage.transverse_inertia,
        film=_film(scene, step) if isinstance(cage, Cage) else None,
        land=_land(scene, step) if isinstance(cage, Cage) else None,
        rotating=RotatingCageParams(1.0) if isinstance(cage, RotatingCage) else None,
        kinematic=_kinematic(bearing, cage) if isinstance(cage, KinematicCage) else None,
    )


def _kinematic(bearing: Bearing, cage: KinematicCage) -> KinematicCageParams:
    return KinematicCageParams(
        speed_ratio=cage.speed_ratio * cage_speed(bearing, 1.0),
        stiffness=0.5 * cage.stiffness,
        damping=0.5 * cage.damping,
    )


def _least_inertia(bearing: Bearing) -> float:
    """Work out the mass of a cage as its pockets feel it along the pitch circle, [kg]."""
    return min(bearing.cage.mass, bearing.cage.polar_inertia / (0.5 * bearing.pitch_diameter) ** 2)


def _yielding(bearing: Bearing) -> float:
    """Sum what rollers and cage yield to one force at each end of a bar of every pocket, [1/kg]."""
    arm = BAR_PLACE * bearing.effective_length
    of_roller = max(1.0 / bearing.roller_mass, arm**2 / bearing.roller_transverse_inertia)
    return 2.0 * (of_roller + bearing.roller_count / _least_inertia(bearing))


def _share(bearing: Bearing, lean: float, step: float) -> float:
    """Work out what bounds the film, so that it, damper and spring of the wall do not swing together.

    Steps h that move with the new velocity are stable up to h c Y + h^2 k Y / 2 of 2, for dampers c and
    springs k that act on what yields by Y. Bars that lean push along the pitch circle with the cosine, and
    the cage across, where it yields by half at any lean.
    """
    cage, yields = bearing.cage, _yielding(bearing) * max(math.cos(lean) ** 2, 0.5)
    dry = step * (cage.damping + 0.5 * step * cage.stiffness) * yields
    return step * yields / (2.0 * max(_MOST_OF_STABLE - 0.5 * dry, _LEAST_OF_FILM))


def _film(scene: Scene, step: float) -> PocketFilmParams | None:
    """Work out the film of half a bar; all pockets together resist no more than the inertias allow."""
    if not isinstance(scene.effects.cage, Cage) or scene.effects.cage.lubrication is None:
        return None
    options, bearing = scene.effects.cage.lubrication, scene.bearing
    per_length = scene.lubricant.dynamic_viscosity(scene.temperature) * 0.5 * bearing.effective_length
    share = _share(bearing, scene.effects.cage.bar_inclination, step)
    squeeze = 3.0 * math.sqrt(2.0) * math.pi * per_length
    radius = 0.5 * bearing.roller_diameter
    bounded = radius * (squeeze * share / (_PAID - 1.0)) ** (2.0 / 3.0)
    return PocketFilmParams(
        wedge=0.5 * 4.9 * per_length,
        squeeze=squeeze,
        shear=math.sqrt(2.0) * math.pi * per_length,
        thinnest=max(options.switch_thickness, bounded),
        inverse_layer=1.0 / options.layer,
        share=share,
    )


def _land(scene: Scene, step: float) -> LandParams | None:
    if not isinstance(scene.effects.cage, Cage) or scene.effects.cage.guidance is None:
        return None
    options, bearing = scene.effects.cage.guidance, scene.bearing
    outside = 1.0 if options.on == "cup" else -1.0
    diameter = options.land_diameter
    if diameter is None:
        diameter = bearing.pitch_diameter + 0.5 * outside * bearing.roller_diameter
    offset = options.land_offset
    if offset is None:
        offset = 0.5 * bearing.roller_length * math.cos(bearing.contact_angle)
    radius, width, clearance = 0.5 * diameter, options.land_width, options.clearance
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    # the cage is explicit: a film of cold lubricant may not resist more than it can follow within a step
    largest = 0.25 * _least_inertia(bearing) / step
    film = min(viscosity * radius * width**3 / (2.0 * clearance**2), 0.5 * largest * clearance / math.pi)
    drag = 2.0 * math.pi * viscosity * radius**3 * width / clearance
    return LandParams(
        body=float(CUP_BODY if options.on == "cup" else CONE_BODY),
        outside=outside,
        radius=radius,
        clearance=clearance,
        half_width=0.5 * width,
        place=offset,
        film=film,
        drag=min(drag, 0.25 * bearing.cage.polar_inertia / step),
        most_eccentric=most_eccentric(film / clearance, largest),
        stiffness=bearing.cage.stiffness,
        damping=bearing.cage.damping,
        friction=options.friction,
        regularisation=options.regularisation_speed,
    )


def most_eccentric(film: float, largest: float) -> float:
    """Find the eccentricity ratio where a land film resists less than `largest` [N s/m], at most 0.99."""
    low, high = 0.0, 0.99
    for _ in range(60):
        ratio = 0.5 * (low + high)
        flat = 1.0 - ratio**2
        resistance = film * (math.pi * (1.0 + 2.0 * ratio**2) / flat**2.5 + 8.0 * ratio / flat**2)
        low, high = (ratio, high) if resistance < largest else (low, ratio)
    return low
