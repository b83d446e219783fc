"""From nouns to kernel parameters."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.contact_law import line_contact_factor, rib_contact_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import CoulombTraction, EffectSet, ShearedFilmTraction
from beardyn_core.model.arrangement import Arrangement
from beardyn_core.model.film_factor import log2_film_factor
from beardyn_core.model.layout import MASK, OVERSIZE, POCKET_ANGLE, ROLLER_CONSTANTS
from beardyn_core.model.parameters import (
    LAMINA_DROP,
    LAMINA_FILM,
    LAMINA_PLACE,
    LAMINA_PRESSURE,
    LAMINA_RADIUS,
    LAMINA_ROWS,
    LAMINA_STIFFNESS,
    AuditParams,
    CageParams,
    CoulombParams,
    DampingParams,
    EffectParams,
    FaultParams,
    FilmParams,
    GravityParams,
    MixedParams,
    MountingParams,
    Parameters,
    RacewayParams,
    RibParams,
    RollerParams,
    ShearedFilmParams,
    SpallParams,
)
from beardyn_core.scene.defect import Spall
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.scene import Scene

WAVEFORM_RATE = 25_600
BLOCK_NS = 20_000_000
SAMPLES_PER_BLOCK = 512


def lamina_places(bearing: Bearing, count: int) -> NDArray[np.float64]:
    """Abscissae of the laminae from mid-length, towards the large end, shape [lamina], [m]."""
    return ((np.arange(count) + 0.5) / count - 0.5) * bearing.effective_length


def equivalent_radius(bearing: Bearing, place: NDArray[np.float64], ring: str) -> NDArray[np.float64]:
    """Radius of the equivalent cylinder in rolling direction, roller against ring, shape [lamina], [m]."""
    cone_distance = bearing.apex_distance + place
    roller = cone_distance * math.tan(bearing.half_angle) / math.cos(bearing.half_angle)
    angle = bearing.cup_angle if ring == "cup" else bearing.cone_angle
    raceway = cone_distance / math.cos(bearing.half_angle) * math.tan(angle)
    side = -1.0 if ring == "cup" else 1.0
    return 1.0 / (1.0 / roller + side / raceway)


def lamina_table(scene: Scene) -> NDArray[np.float64]:
    """Table of lamina constants, shape [LAMINA_ROWS, lamina]; abscissae from the centre of mass."""
    bearing, count = scene.bearing, scene.numerics.laminae
    place = lamina_places(bearing, count)
    length = bearing.effective_length / count
    modulus = bearing.material.contact_modulus
    table = np.zeros((LAMINA_ROWS, count))
    table[LAMINA_PLACE] = place - bearing.roller_mass_offset
    table[LAMINA_DROP] = bearing.profile.drop_at(
        place, 0.5 * bearing.effective_length, bearing.roller_diameter, modulus
    )
    table[LAMINA_STIFFNESS] = line_contact_factor(bearing.material, bearing.effective_length) / count
    table[LAMINA_RADIUS] = (bearing.apex_distance + place) * math.tan(bearing.half_angle)
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    pressure_viscosity = scene.lubricant.pressure_viscosity_at(scene.temperature)
    starvation = scene.effects.film.starvation if scene.effects.film else 1.0
    for ring, name in enumerate(("cup", "cone")):
        radius = equivalent_radius(bearing, place, name)
        table[LAMINA_FILM + ring] = [
            log2_film_factor(r, length, modulus, viscosity, pressure_viscosity, starvation) for r in radius
        ]
        # square of the mean Hertz pressure at 1 N: p_mean = pi/4 sqrt(q E* / (pi R)), E* = E'/2
        table[LAMINA_PRESSURE + ring] = (math.pi / 4) ** 2 * 0.5 * modulus / (math.pi * radius * length)
    return table


def rib_params(bearing: Bearing, effects: EffectSet) -> RibParams | None:
    """Rib contact in the cone's coordinates; the nominal roller just touches it."""
    if effects.rib is None:
        return None
    lean = bearing.contact_angle - bearing.rib_polar_angle
    normal_axial, normal_radial = math.cos(lean), math.sin(lean)
    centre_axial = 0.5 * bearing.row_spacing + bearing.sphere_centre * math.cos(bearing.contact_angle)
    centre_radial = 0.5 * bearing.pitch_diameter + bearing.sphere_centre * math.sin(bearing.contact_angle)
    return RibParams(
        stiffness=rib_contact_factor(bearing),
        sphere_radius=bearing.sphere_radius,
        sphere_place=bearing.sphere_centre - bearing.roller_mass_offset,
        normal_axial=normal_axial,
        normal_radial=normal_radial,
        distance=centre_axial * normal_axial + centre_radial * normal_radial + bearing.sphere_radius,
        friction=effects.rib.friction,
        regularisation=effects.rib.regularisation_speed,
    )


def cage_params(bearing: Bearing, effects: EffectSet) -> CageParams | None:
    """Cage pockets around the nominal rollers."""
    if effects.cage is None:
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    radial = 0.5 * bearing.pitch_diameter + bearing.roller_mass_offset * sine
    axial = bearing.roller_mass_offset * cosine
    return CageParams(
        stiffness=bearing.cage.stiffness,
        damping=bearing.cage.damping,
        half_clearance=0.5 * bearing.cage.circumferential_clearance,
        half_end_clearance=0.5 * bearing.cage.axial_clearance,
        bar_sine=math.sin(effects.cage.bar_inclination),
        bar_cosine=math.cos(effects.cage.bar_inclination),
        bar_place=0.35 * bearing.effective_length,
        roller_height=radial,
        roller_place=radial * sine + axial * cosine,
        axis_radial=sine,
        axis_axial=cosine,
        friction=effects.cage.friction,
        regularisation=effects.cage.regularisation_speed,
        place=0.5 * bearing.row_spacing,
        mass=bearing.cage.mass,
        polar_inertia=bearing.cage.polar_inertia,
        transverse_inertia=bearing.cage.transverse_inertia,
    )


def traction_params(scene: Scene) -> tuple[CoulombParams | None, MixedParams | None, FilmParams | None]:
    """Traction and film; mixed traction without a film is dry friction of the asperities."""
    traction, effects = scene.effects.traction, scene.effects
    film = None
    if effects.film is not None:
        film = FilmParams(
            viscosity=scene.lubricant.dynamic_viscosity(scene.temperature),
            pressure_viscosity=scene.lubricant.pressure_viscosity_at(scene.temperature),
            roughness=scene.bearing.raceway_roughness,
        )
    if traction is None:
        return None, None, film
    if not isinstance(traction, CoulombTraction) and film is not None:
        mixed = MixedParams(
            friction=traction.boundary_friction,
            regularisation=traction.regularisation_speed,
            film_friction=0.0 if isinstance(traction, ShearedFilmTraction) else traction.full_film_friction,
            boundary_film=traction.boundary_film_parameter,
            full_film=traction.full_film_parameter,
            sheared_film=ShearedFilmParams(traction.limiting_shear)
            if isinstance(traction, ShearedFilmTraction)
            else None,
        )
        return None, mixed, film
    friction = traction.friction if isinstance(traction, CoulombTraction) else traction.boundary_friction
    return CoulombParams(friction, traction.regularisation_speed), None, film


def spall_params(scene: Scene, on: str, arrangement: Arrangement) -> SpallParams | None:
    """Spalls of one surface as gap tables by block and lane; ``None`` without any."""
    spalls = [spall for spall in scene.defects if spall.on == on]
    if not spalls:
        return None
    count = scene.numerics.laminae
    patches = np.zeros((len(spalls), arrangement.block_count, 3 + count, arrangement.width))
    for patch, spall in zip(patches, spalls, strict=True):
        present = arrangement.row == spall.row
        if on == "roller":
            present = present & (arrangement.roller == spall.roller)
        patch[:, 0] = spall.azimuth
        patch[:, 1] = 0.5 * spall.width
        patch[:, 2] = surface_radius(scene.bearing, on)
        patch[:, 3:] = present[:, None, :] * lamina_depths(scene.bearing, spall, count)[None, :, None]
    shape = (len(spalls) * arrangement.block_count, 3 + count, arrangement.width)
    return SpallParams(np.ascontiguousarray(patches.reshape(shape)), arrangement.block_count)


def surface_radius(bearing: Bearing, on: str) -> float:
    """Radius that turns an azimuth of cup, cone or roller into an arc at mid-length, [m]."""
    distance = bearing.apex_distance / math.cos(bearing.half_angle)
    angle = {"cup": bearing.cup_angle, "cone": bearing.cone_angle}
    return 0.5 * bearing.roller_diameter if on == "roller" else distance * math.sin(angle[on])


def lamina_depths(bearing: Bearing, spall: Spall, count: int) -> NDArray[np.float64]:
    """Depth of a spall on each lamina: full where it covers more than half of it, shape [lamina], [m]."""
    place = lamina_places(bearing, count)
    half = 0.5 * bearing.effective_length / count
    low = np.maximum(place - half, spall.offset - 0.5 * spall.length)
    high = np.minimum(place + half, spall.offset + 0.5 * spall.length)
    covered = np.clip(high - low, 0.0, None) / (2.0 * half)
    return np.where(covered > 0.5, spall.depth, 0.0)


def mounting_params(bearing: Bearing, mounting: Mounting, preload: NDArray[np.float64]) -> MountingParams:
    """Rings and suspension with the cup and cone masses added."""
    return MountingParams(
        cup_moves=float(mounting.cup == "suspended"),
        journal_tilts=float(mounting.journal_tilt == "free"),
        box_mass=mounting.box_mass + bearing.cup_mass,
        box_inertia=np.array(mounting.box_inertia) + np.array(bearing.cup_inertia),
        journal_mass=mounting.journal_mass + bearing.cone_mass,
        journal_inertia=mounting.journal_inertia,
        stiffness=np.array([*mounting.stiffness, *mounting.rotational_stiffness], dtype=float),
        damping=np.array([*mounting.damping, *mounting.rotational_damping], dtype=float),
        preload=np.array(preload, dtype=float),
    )


def roller_constants(arrangement: Arrangement) -> NDArray[np.float64]:
    """Constants of each roller, shape [block, ROLLER_CONSTANTS, lane]."""
    constants = np.zeros((arrangement.block_count, ROLLER_CONSTANTS, arrangement.width))
    constants[:, MASK] = arrangement.mask
    constants[:, POCKET_ANGLE] = 2.0 * math.pi * arrangement.roller / arrangement.roller_count
    constants[:, OVERSIZE] = 0.0
    return constants


def build_parameters(scene: Scene, arrangement: Arrangement, preload: NDArray[np.float64]) -> Parameters:
    """Kernel parameters of a scene.

    Parameters
    ----------
    scene : Scene
    arrangement : Arrangement
    preload : float64 array, shape [6]
        Force and moment of the suspension on the axlebox at rest, [N, N m].

    Returns
    -------
    parameters : Parameters
    """
    bearing, effects = scene.bearing, scene.effects
    offset = bearing.roller_mass_offset
    taper = math.tan(bearing.half_angle)
    coulomb, mixed, film = traction_params(scene)
    cup_angle, cone_angle = bearing.cup_angle, bearing.cone_angle
    return Parameters(
        step=1.0 / (WAVEFORM_RATE * scene.numerics.steps_per_sample),
        roller=RollerParams(
            mass=bearing.roller_mass,
            axial_inertia=bearing.roller_axial_inertia,
            transverse_inertia=bearing.roller_transverse_inertia,
            radius=(bearing.apex_distance + offset) * taper,
            taper=taper,
            apex=0.5 * bearing.row_spacing - bearing.apex_distance * math.cos(bearing.contact_angle),
            half_length=0.5 * bearing.roller_length,
            mass_offset=offset,
        ),
        cup=RacewayParams(
            math.sin(cup_angle), math.cos(cup_angle), 1.0, 0.5 * scene.end_play * math.sin(cup_angle)
        ),
        cone=RacewayParams(math.sin(cone_angle), math.cos(cone_angle), -1.0, 0.0),
        laminae=lamina_table(scene),
        rollers=roller_constants(arrangement),
        mounting=mounting_params(bearing, scene.mounting, preload),
        effects=EffectParams(
            damping=DampingParams(effects.contact_damping.time_constant) if effects.contact_damping else None,
            film=film,
            coulomb=coulomb,
            mixed=mixed,
            rib=rib_params(bearing, effects),
            cage=cage_params(bearing, effects),
            gravity=GravityParams(effects.gravity.acceleration) if effects.gravity else None,
            faults=FaultParams(*(spall_params(scene, on, arrangement) for on in ("cup", "cone", "roller"))),
            audit=AuditParams(1.0) if effects.audit else None,
        ),
    )
