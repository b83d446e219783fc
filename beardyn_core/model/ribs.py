"""Rib contacts of both roller ends as kernel parameters."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.bearing.contact_law import PointContact, exact_rib_contact, rib_contact
from beardyn_core.bearing.film_thickness import LOAD_EXPONENT, SPEED_EXPONENT, log2_rib_film_factor
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.effects import EffectSet, Rib, RibShearedFilm
from beardyn_core.model.parameters import DampingParams
from beardyn_core.scene.scene import Scene


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
    both: float | None  # whether both sides of the rim bear: the sphere is too flat for its apex distance


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


# Sliding and spin dissipate mu Q sqrt(u^2 + 0.18 a^2 w^2), Zhao et al. (2026).
_SPIN_SHARE = 0.18
# Floor of the second derivative in the search along the rim, as part of the sine of the rib's polar angle.
_SMALLEST_BEND = 0.01


def rib_params(scene: Scene) -> RibParams | None:
    """Describe the rib contact in the cone's coordinates; the nominal roller just touches it."""
    bearing, rib = scene.bearing, scene.effects.rib
    if rib is None:
        return None
    lean = bearing.contact_angle - bearing.rib_polar_angle
    normal_axial, normal_radial = math.cos(lean), math.sin(lean)
    centre_axial = 0.5 * bearing.row_spacing + bearing.sphere_centre * math.cos(bearing.contact_angle)
    centre_radial = 0.5 * bearing.pitch_diameter + bearing.sphere_centre * math.sin(bearing.contact_angle)
    contact = exact_rib_contact(bearing) if rib.stiffness == "exact" else rib_contact(bearing)
    nominal = centre_radial * normal_axial - centre_axial * normal_radial
    return RibParams(
        stiffness=contact.factor,
        sphere_radius=bearing.sphere_radius,
        sphere_place=bearing.sphere_centre - bearing.roller_mass_offset,
        normal_axial=normal_axial,
        normal_radial=normal_radial,
        distance=centre_axial * normal_axial + centre_radial * normal_radial + bearing.sphere_radius,
        friction=rib.friction,
        regularisation=rib.regularisation_speed,
        window=_window(bearing, nominal, rib),
        end=_roller_end(bearing) if rib.roller_end else None,
        film=_film(scene, rib, contact),
        drilling=RibDrillingParams(_SPIN_SHARE * _around_squared(contact)) if rib.drilling else None,
    )


def _window(bearing: Bearing, nominal: float, rib: Rib) -> RibWindowParams | None:
    """Lay the edges of the face on its generator; rounding takes at most the whole face."""
    if not rib.window:
        return None
    along = 1.0 / math.cos(bearing.rib_polar_angle)
    low = nominal + (bearing.rib_undercut - bearing.rib_contact_height) * along
    high = nominal + (bearing.rib_height - bearing.rib_contact_height) * along
    rounding = min(rib.edge_radius, 0.5 * (high - low))
    return RibWindowParams(low + rounding, high - rounding, rounding)


def _roller_end(bearing: Bearing) -> RibEndParams:
    """Work out the rim where the spherical face of the roller end meets the chamfer."""
    radius = bearing.large_end_radius - bearing.roller_chamfer
    ahead = math.sqrt(bearing.sphere_radius**2 - radius**2)
    return RibEndParams(
        radius=radius,
        place=bearing.sphere_centre - bearing.roller_mass_offset + ahead,
        cosine=ahead / bearing.sphere_radius,
        smallest_bend=_SMALLEST_BEND * math.sin(bearing.rib_polar_angle),
        both=1.0 if bearing.sphere_ratio >= 1.0 else None,
    )


def _film(scene: Scene, rib: Rib, contact: PointContact) -> RibFilmParams | None:
    """Work out film thickness at the inlet temperature of the scene, and its friction."""
    lubrication = rib.lubrication
    if lubrication is None:
        return None
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    pressure_viscosity = scene.lubricant.pressure_viscosity_at(scene.temperature)
    sheared = None
    if isinstance(lubrication, RibShearedFilm):
        larger, smaller = contact.semi_axes(1.0)
        approach = contact.factor ** (-2.0 / 3.0)
        pressure = 1.0 / (math.pi * larger * smaller) / math.sqrt(approach)
        sheared = RibShearParams(viscosity, pressure_viscosity, lubrication.limiting_shear, pressure)
    return RibFilmParams(
        log2_factor=log2_rib_film_factor(
            scene.bearing, viscosity, pressure_viscosity, lubrication.starvation
        ),
        speed_exponent=SPEED_EXPONENT,
        load_exponent=LOAD_EXPONENT,
        log2_roughness=math.log2(scene.bearing.rib_roughness),
        boundary_friction=lubrication.boundary_friction,
        film_friction=0.0 if isinstance(lubrication, RibShearedFilm) else lubrication.film_friction,
        sheared=sheared,
    )


def _around_squared(contact: PointContact) -> float:
    """Compute the square of the ellipse's semi-axis around the ring over the approach, [m]."""
    larger, _ = contact.semi_axes(1.0)
    return float(larger**2 * contact.factor ** (2.0 / 3.0))


def small_rib_params(bearing: Bearing, effects: EffectSet) -> SmallRibParams | None:
    """Describe the small rib in cone coordinates; its clearance opens with the roller on the large rib."""
    effect = effects.small_rib
    if effect is None:
        return None
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    along = -0.5 * bearing.roller_length - bearing.small_rib_clearance
    below = bearing.small_end_radius - 0.5 * bearing.small_rib_height
    return SmallRibParams(
        radius=0.5 * bearing.pitch_diameter + along * sine - below * cosine,
        place=0.5 * bearing.row_spacing + along * cosine + below * sine,
        end_place=-0.5 * bearing.roller_length - bearing.roller_mass_offset,
        stiffness=effect.stiffness,
        damping=DampingParams(effect.damping / effect.stiffness),
        friction=effect.friction,
        regularisation=effect.regularisation_speed,
    )
