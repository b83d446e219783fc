"""How one slice of a roller presses: along a line after Palmgren, along a barrel's ellipse after Hertz.

The slices of a barrel are springs of their own, as stiff however deep they are: over the whole ellipse they
have Hertz's load at Hertz's approach, see `bearing.contact_law.SlicedEllipse`.
"""

from __future__ import annotations

from typing import NamedTuple

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.layout import LAMINA_STIFFNESS
from beardyn_core.physics.lanes.lane_math import ninth_root, quick_ninth_root

# over tangent stiffness times depth: force; over that times the squared depth: energy
_LINE_FORCE, _LINE_STORED = 0.9, 0.9 * 9.0 / 19.0


class EllipseParams(NamedTuple):
    """Slices of the contact ellipse of a barrel with one ring."""

    stiffness: float  # of a slice [N/m]


@inline
def slice_tangent(touching, k, laminae, ellipse):
    """Work out the tangent stiffness of slice ``k`` at a penetration that is not negative, [N/m]."""
    if ellipse is None:
        return (10.0 / 9.0) * laminae[LAMINA_STIFFNESS, k] * ninth_root(touching)
    return ellipse.stiffness + 0.0 * touching


@inline
def quick_secant(touching, k, laminae, ellipse):
    """Work out force over penetration of slice ``k``, to what the quick root has of digits, [N/m]."""
    if ellipse is None:
        return laminae[LAMINA_STIFFNESS, k] * quick_ninth_root(touching)
    return ellipse.stiffness + 0.0 * touching


@inline
def tangent_share(ellipse):
    """Take tangent stiffness times penetration over force, [-]."""
    if ellipse is None:
        return 10.0 / 9.0
    return 1.0


@inline
def force_share(ellipse):
    """Take force over tangent stiffness times penetration, [-]."""
    if ellipse is None:
        return _LINE_FORCE
    return 1.0


@inline
def stored_share(ellipse):
    """Take energy over tangent stiffness times the squared penetration, [-]."""
    if ellipse is None:
        return _LINE_STORED
    return 0.5
