"""Parameters of a cage: its pockets, and what there is of films, lands and simpler motion."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.bearing.kinematics import cage_speed
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.effects import Cage, KinematicCage, RotatingCage
from beardyn_core.physics.cage.land import LandParams, land_params
from beardyn_core.physics.cage.pocket_film import PocketFilmParams, pocket_film_params
from beardyn_core.physics.cage.step_bounds import BAR_PLACE
from beardyn_core.scene.scene import Scene


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


def cage_params(scene: Scene, step: float) -> CageParams | None:
    """Lay cage pockets around the nominal rollers, for steps of `step` [s]."""
    bearing, cage = scene.bearing, scene.effects.cage
    if cage is None:
        return None
    sine, cosine = math.sin(bearing.roller_slant), math.cos(bearing.roller_slant)
    radial = bearing.roller_orbit_radius
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
        film=pocket_film_params(scene, step) if isinstance(cage, Cage) else None,
        land=land_params(scene, step) if isinstance(cage, Cage) else None,
        rotating=RotatingCageParams(1.0) if isinstance(cage, RotatingCage) else None,
        kinematic=_kinematic(bearing, cage) if isinstance(cage, KinematicCage) else None,
    )


def _kinematic(bearing: RollerBearing, cage: KinematicCage) -> KinematicCageParams:
    return KinematicCageParams(
        speed_ratio=cage.speed_ratio * cage_speed(bearing, 1.0),
        stiffness=0.5 * cage.stiffness,
        damping=0.5 * cage.damping,
    )
