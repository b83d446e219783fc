"""Lubricant between rollers and bars of the pockets: its parameters, and what a wall carries with it."""

from __future__ import annotations

import math
from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.effects import Cage
from beardyn_core.physics.cage.step_bounds import film_share
from beardyn_core.physics.lanes.lane_math import at_least, at_most, magnitude, sqrt
from beardyn_core.physics.lanes.lanes import any_positive
from beardyn_core.physics.lanes.vectors import cross, dot
from beardyn_core.scene.scene import Scene


class PocketFilmParams(NamedTuple):
    """Lubricant between roller and bar; at one of two abscissae, see `pocket_loads`."""

    wedge: float  # load over rolling speed and radius over gap [N s/m]
    squeeze: float  # load over speed of approach and (radius over gap)^1.5 [N s/m]
    shear: float  # friction over slip and (radius over gap)^0.5 [N s/m]
    thinnest: float  # [m]
    inverse_layer: float  # of the thickness of the lubricant's layer [1/m]
    share: float  # over the squeeze resistance that explicit cage and rollers can follow [m/(N s)]


# A film may push back by W^2 / 4c when it opens; its friction pays for that while the bounded resistance c is
# no less than 1/39 of the physical one: 2.45^2 / (4 * 3 sqrt(2) pi * sqrt(2) pi) = 1/39.5.
_PAID = 39.0


def pocket_film_params(scene: Scene, step: float) -> PocketFilmParams | None:
    """Work out the film of half a bar; all pockets together resist no more than the inertias allow."""
    if not isinstance(scene.effects.cage, Cage) or scene.effects.cage.lubrication is None:
        return None
    options, bearing = scene.effects.cage.lubrication, scene.bearing
    per_length = scene.lubricant.dynamic_viscosity(scene.temperature) * 0.5 * bearing.effective_length
    share = film_share(bearing, scene.effects.cage.bar_inclination, step)
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


def along_bar(film: PocketFilmParams | None) -> PocketFilmParams | None:
    """Take the films of both abscissae as one, for a roller that does not skew."""
    if film is None:
        return None
    return film._replace(
        wedge=2.0 * film.wedge,
        squeeze=2.0 * film.squeeze,
        shear=2.0 * film.shear,
        share=0.5 * film.share,
    )


@inline
def rolling_speed(slip, direction, axis, film):
    """Work out the speed of the roller's surface along a wall, which feeds the film, [m/s]; 0 without one."""
    if film is None:
        return 0.0
    return magnitude(dot(slip, cross(axis, direction)))


@inline
def is_reached(depth, film):
    """Check whether the wall acts on any lane; a film acts within the thickness of its layer."""
    if film is None:
        return any_positive(depth)
    return any_positive(1.0 + film.inverse_layer * depth)


@inline
def pocket_loads(depth, pressed, rate, rolling, radius, film):
    """Split the load of a wall into that of its film, that which rubs solid on solid, and viscous friction.

    An isoviscous film between rigid faces carries the bar until the gap has closed to `film.thinnest`, where
    roughness keeps it; what is pressed further is carried by spring and damper on top of the film. Squeezing
    adds to the load and opening takes from it, down to zero: the film cavitates instead of pulling. A gap
    wider than the lubricant's layer is not bridged. Neglects side leakage and the heating of the film.

    ``depth``: approach beyond touching, negative for a gap [m]; ``pressed``: spring and damper of the dry
    wall [N]; ``rate``: speed of approach [m/s]; ``rolling``: speed of the roller's surface along the wall
    [m/s]; ``radius``: of the roller here [m]. Returns ``load``, ``solid`` [N]; ``shear``: friction force of
    the film over slip [N s/m].

    References
    ----------
    Martin, H. M. (1916): w = 4.9 eta u R l / h with the mean surface speed u, half of the roller's here.
    Squeezing from Reynolds' equation with h + x^2 / 2R: h^3 p' = 12 eta h' x gives p = -6 eta R h' / h^2 and
    w = -3 sqrt(2) pi eta l h' (R / h)^1.5; shearing: eta u l times the integral of dx / h over all x, which
    is sqrt(2) pi eta u l (R / h)^0.5.
    """
    if film is None:
        load = at_least(pressed, 0.0)
        return load, load, 0.0
    gap = at_least(-depth, film.thinnest)
    bridged = at_least(1.0 - film.inverse_layer * gap, 0.0)
    ratio = radius / gap
    root = sqrt(ratio)
    squeeze = film.squeeze * bridged * ratio * root
    # the cage is explicit: a pocket may not resist more than its share of the cage can follow within a step
    squeeze = squeeze / (1.0 + film.share * squeeze)
    load = at_least(pressed + film.wedge * bridged * ratio * rolling + squeeze * rate, 0.0)
    solid = at_most(at_least(pressed, 0.0), load)
    return load, solid, film.shear * bridged * root
