"""Cylindrical and spherical roller bearings solved apart from the equilibrium of this code.

Springs of whole rollers for barrels and for the slices of the standard, small motions for rollers between
ribs.
"""

from __future__ import annotations

import math
from functools import lru_cache, partial
from typing import Any

import numpy as np
from scipy.optimize import brentq, fsolve, root

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import ExactPointContact, barrel_ellipse
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.bearing.life import dynamic_rating
from beardyn_core.bearing.rib_face import rib_faces
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config import load_any_bearing
from beardyn_core.physics.statics.static import StaticSolution, solve
from test.kernels.naive_half_space import HalfSpace

LAMINAE = 30
ISO_ROLLER = 35948.0  # c_L of a roller between both raceways, N/mm^(10/9)/mm^(8/9)


@lru_cache
def cylindrical(name: str = "WJ130x240") -> CylindricalBearing:
    """Load a shipped cylindrical roller bearing."""
    bearing = load_any_bearing(name)
    assert isinstance(bearing, CylindricalBearing)
    return bearing


@lru_cache
def spherical(name: str = "SRB120x260") -> SphericalBearing:
    """Load a shipped spherical roller bearing."""
    bearing = load_any_bearing(name)
    assert isinstance(bearing, SphericalBearing)
    return bearing


def rest(bearing: CylindricalBearing | SphericalBearing, *force: float, **conditions: Any) -> StaticSolution:
    """Solve the static equilibrium with rigid rings."""
    return solve(bearing, force, **{"end_play": None, "laminae": LAMINAE, **conditions})


def standard_slices(
    bearing: CylindricalBearing, radial: float, constant: float = ISO_ROLLER, phase: float = 0.0
) -> Float:
    """Compute the slice loads [roller, slice] of one row by ISO/TS 16281, roller between both raceways."""
    place = (np.arange(LAMINAE) + 0.5) / LAMINAE - 0.5
    drop = 0.00035 * bearing.roller_diameter * -np.log(1.0 - (2.0 * place) ** 2)
    factor = constant * (1e3 * bearing.effective_length) ** (8.0 / 9.0) / LAMINAE
    cosine = np.cos(phase + 2.0 * math.pi * np.arange(bearing.roller_count) / bearing.roller_count)

    def loads(shift: float) -> Float:
        approach = shift * cosine - 0.5 * bearing.radial_clearance
        pressed = np.maximum(approach[:, None] - 2.0 * drop, 0.0)
        return np.asarray(factor * (1e3 * pressed) ** (10.0 / 9.0))

    def lacking(shift: float) -> float:
        return float(loads(shift).sum(axis=1) @ cosine) - 0.5 * radial

    return loads(brentq(lacking, 0.0, 1e-3, xtol=1e-15))


def standard_loads(bearing: CylindricalBearing, radial: float, phase: float = 0.0) -> Float:
    """Add up the slices of `standard_slices`, [roller]."""
    return np.asarray(standard_slices(bearing, radial, phase=phase).sum(axis=1))


def written_out_life(bearing: CylindricalBearing | SphericalBearing, inner: Float, outer: Float) -> float:
    """Compute L_10r by ISO/TS 16281, written out from the standard, [10^6 revolutions].

    Parameters
    ----------
    inner, outer : float64 arrays, shape [row, roller, slice]
        Loads on inner and outer raceway, [N]; the inner ring turns.
    """
    cosine = math.cos(bearing.contact_angle)
    gamma, count = bearing.roller_diameter * cosine / bearing.pitch_diameter, bearing.roller_count
    rings = (1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)) ** 4.5
    share = dynamic_rating(bearing).radial / (0.83 * count * 2.0 ** (7.0 / 9.0) * cosine)
    of_slice = share * (1.0 / LAMINAE) ** (7.0 / 9.0)
    number = np.arange(1, LAMINAE + 1)
    riser = 1.0 - 0.01 / np.log(1.985 * np.abs(2 * number - LAMINAE - 1) / (2 * LAMINAE - 2))
    turning = np.mean((riser * inner) ** 4.0, axis=1) ** (1.0 / 4.0)
    standing = np.mean((riser * outer) ** 4.5, axis=1) ** (1.0 / 4.5)
    damage = (turning * 0.378 / (of_slice * (1.0 + rings) ** (2.0 / 9.0))) ** 4.5
    damage += (standing * 0.364 / (of_slice * (1.0 + 1.0 / rings) ** (2.0 / 9.0))) ** 4.5
    return float(damage.sum() ** (-8.0 / 9.0))


def hertz_of(bearing: SphericalBearing, ring: str) -> ExactPointContact:
    """Give Hertz's contact of a barrel with ``cup`` or ``cone``."""
    radii = bearing.rolling_radius(ring), bearing.profile_radius(ring)
    return ExactPointContact(*radii, bearing.material.contact_modulus)


def hertz_rows(bearing: SphericalBearing, force: Float, phase: float = 0.0) -> Float:
    """Compute the loads [row, roller] of rigid rings on springs: two Hertz contacts in series."""
    factors = np.array([hertz_of(bearing, ring).factor for ring in ("cup", "cone")])
    series = float((factors ** (-2.0 / 3.0)).sum() ** -1.5)
    azimuth = phase + 2.0 * math.pi * np.arange(bearing.roller_count) / bearing.roller_count
    sine, cosine = math.sin(bearing.contact_angle), math.cos(bearing.contact_angle)
    along = np.ones(azimuth.size)
    rows = [[cosine * np.sin(azimuth), side * sine * along, cosine * np.cos(azimuth)] for side in (-1.0, 1.0)]
    lines = np.array(rows)

    def loads(shift: Float) -> Float:
        approach = np.einsum("rxk,x->rk", lines, 1e-6 * shift) - bearing.normal_gap()
        return np.asarray(series * np.maximum(approach, 0.0) ** 1.5)

    def lacking(shift: Float) -> Float:
        return np.asarray(np.einsum("rxk,rk->x", lines, loads(shift)) - force) / 1e3

    start = 1e6 * (bearing.normal_gap() + 5e-5) * np.array(force) / np.linalg.norm(force)
    return loads(fsolve(lacking, start, xtol=1e-11))


def thrust_by_small_motions(
    bearing: CylindricalBearing, radial: float, axial: float, start: tuple[float, float]
) -> tuple[Float, Float]:
    """Solve one row under radial load and thrust [N] by small motions: raceway and rib load of every roller.

    Unknown are shift of the cone across and along [m], which ``start`` guesses, and of every roller its place
    across and along and its tilt; ribs are points at their contact height.
    """
    place = ((np.arange(LAMINAE) + 0.5) / LAMINAE - 0.5) * bearing.effective_length
    drop, gap = bearing.lamina_drop(LAMINAE), 0.5 * bearing.radial_clearance
    law = 0.356 * bearing.material.contact_modulus * bearing.effective_length ** (8.0 / 9.0) / LAMINAE
    cone_rib, cup_rib = (
        next(face for face in rib_faces(bearing) if (face.ring, face.side) == which)
        for which in (("cone", 1.0), ("cup", -1.0))
    )
    stiff = cone_rib.factor, cup_rib.factor
    lever = 0.5 * bearing.roller_diameter - bearing.rib_contact_height
    count = bearing.roller_count
    cosine = np.cos(2.0 * math.pi * np.arange(count) / count)
    places = [np.array([1e6 * gap + 10.0, -80.0, -5.0])] * count
    loads, ribs = np.zeros(count), np.zeros(count)

    def forces(shift: float, along: float, roller: Float) -> tuple[Float, Float, float, float]:
        across, way, tilt = roller * np.array([1e-6, 1e-6, 1e-5])
        cup = law * np.maximum(across + place * tilt - drop - gap, 0.0) ** (10.0 / 9.0)
        cone = law * np.maximum(shift - across - place * tilt - drop, 0.0) ** (10.0 / 9.0)
        # outwards along the row; the cone pushes inwards at the bottom, the cup outwards at the top
        push = max(along + way - lever * tilt - cone_rib.gap, 0.0) ** 1.5 * stiff[0]
        hold = max(-way - lever * tilt - cup_rib.gap, 0.0) ** 1.5 * stiff[1]
        return cup, cone, push, hold

    def lacking(unknown: Float) -> Float:
        across, along = 1e-6 * unknown

        def left(shift: float, roller: Float) -> Float:
            cup, cone, push, hold = forces(shift, along, roller)
            couple = ((cone - cup) @ place) / lever + push + hold
            return np.array([cone.sum() - cup.sum(), hold - push, couple]) - 1e-4 * roller

        for k in range(count):
            shift = across * cosine[k]
            loads[k] = ribs[k] = 0.0
            if shift > gap:
                places[k] = root(partial(left, shift), places[k], method="lm", options={"xtol": 1e-13}).x
                _, cone, push, _ = forces(shift, along, places[k])
                loads[k], ribs[k] = cone.sum(), push
        return np.array([loads @ cosine - radial, ribs.sum() - axial])

    fsolve(lacking, 1e6 * np.array(start), xtol=1e-9)
    return loads.copy(), ribs.copy()


def sliced_load(bearing: SphericalBearing, ring: str, approach: float) -> float:
    """Add up the slices of a barrel at an approach [m], [N]."""
    law, length = barrel_ellipse(bearing, ring), bearing.effective_length
    place = ((np.arange(LAMINAE) + 0.5) / LAMINAE - 0.5) * length
    pressed = np.maximum(approach - (place / law.reach) ** 2, 0.0)
    return float(law.stiffness * pressed.sum() * length / LAMINAE)


def half_space_load(bearing: SphericalBearing, ring: str, load: float, approach: float) -> float:
    """Press a barrel on the half-space, a grid wide enough for a load [N]; gives its own load, [N]."""
    width = 1.6 * hertz_of(bearing, ring).semi_axes(load)[1]
    modulus, length = bearing.material.contact_modulus, bearing.effective_length
    grid = HalfSpace(bearing.rolling_radius(ring), length, modulus, width, (40, 80))
    crown = np.asarray(grid.y[None, :] ** 2 / (2.0 * bearing.profile_radius(ring)), dtype=np.float64)
    return grid.load(grid.pressure(approach, crown))
