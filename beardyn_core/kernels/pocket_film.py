"""Lubricant between a roller and the bar of its pocket."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, magnitude, sqrt
from beardyn_core.kernels.lanes import any_positive
from beardyn_core.kernels.vectors import cross, dot


@inline
def is_reached(depth, film):
    """Tell whether the wall acts on any lane; a film acts within the thickness of its layer."""
    if film is None:
        return any_positive(depth)
    return any_positive(1.0 + film.inverse_layer * depth)


@inline
def pocket_loads(depth, pressed, rate, slip, direction, shape, film):
    """Split the load of a wall into that of its film, that which rubs solid on solid, and viscous friction.

    An isoviscous film between rigid faces carries the bar until the gap has closed to `film.thinnest`, where
    roughness keeps it; what is pressed further is carried by spring and damper on top of the film. Squeezing
    adds to the load and opening takes from it, down to zero: the film cavitates instead of pulling. A gap
    wider than the lubricant's layer is not bridged. Neglects side leakage and the heating of the film.

    ``depth``: approach beyond touching, negative for a gap [m]; ``pressed``: spring and damper of the dry
    wall [N]; ``rate``: speed of approach [m/s]; ``slip``: of the roller's surface against the bar [m/s];
    ``direction``: normal of the wall, towards it; ``shape``: axis of the
    roller, and its radius here [m]. Returns ``load``, ``solid`` [N]; ``shear``: friction force of the film
    over slip [N s/m].

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
    axis, radius = shape
    gap = at_least(-depth, film.thinnest)
    bridged = at_least(1.0 - film.inverse_layer * gap, 0.0)
    ratio = radius / gap
    root = sqrt(ratio)
    rolling = magnitude(dot(slip, cross(axis, direction)))
    squeeze = film.squeeze * bridged * ratio * root
    # the cage is explicit: a pocket may not resist more than its share of the cage can follow within a step
    squeeze = squeeze / (1.0 + film.share * squeeze)
    load = at_least(pressed + film.wedge * bridged * ratio * rolling + squeeze * rate, 0.0)
    solid = at_most(at_least(pressed, 0.0), load)
    return load, solid, film.shear * bridged * root
