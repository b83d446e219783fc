"""The path of a roller over a patch: rigid, and how its sharp edges give way under load."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.scene.patch import Patch

PATH_CELLS = 256
# kinds whose floor falls away from their edge as a wall
SHARP_KINDS = ("spall", "rectangular", "elliptic", "brinelling")
# of the intact contact, over which the softness is taken, [Pa]: 2 to 21 kN a roller of HS130x230 on its cup
EDGE_PRESSURES = (0.3e9, 0.5e9, 0.7e9, 1.0e9)


def floor_of(kind: str, arc: Float, half_width: float, depth: float) -> Float:
    """Work out the depth of the bare surface at arcs from the centre, 0 outside of the patch, [m]."""
    u = np.clip(np.abs(arc) / half_width, 0.0, 1.0)
    shape = {
        "spall": np.ones_like(u),
        "rectangular": np.ones_like(u),
        "half_sine": np.cos(0.5 * math.pi * u),
        "elliptic": np.sqrt(1.0 - u * u),
        "brinelling": np.sqrt(1.0 - u * u),
        "dent": np.cos(0.5 * math.pi * u) ** 2,
    }[kind]
    return np.asarray(np.where(np.abs(arc) < half_width, depth * shape, 0.0))


def rim_of(arc: Float, half_width: float, height: float, width: float) -> Float:
    """Work out the height of the raised shoulder at arcs from the centre, [m]."""
    if height == 0.0:
        return np.zeros_like(arc)
    along = (np.abs(arc) - half_width) / width
    return np.where((along > 0.0) & (along < 1.0), height * np.sin(math.pi * along) ** 2, 0.0)


def sharp(patch: Patch) -> bool:
    """Check whether a patch has edges that give way under a roller; the slopes of a rim have not."""
    return patch.kind in SHARP_KINDS and patch.rim_height == 0.0


def reach_of(patch: Patch, size: tuple[float, float, float], radius: float, bearing: RollerBearing) -> float:
    """Work out the arc from the centre beyond which a roller does not feel the patch, [m].

    ``size``: width, depth and rim height [m]; ``radius``: of the contact [m].
    """
    half_width, rim_height, rim_width = half_of(size), size[2], patch.rim_width
    if sharp(patch):
        return half_width + contact_half_width(EDGE_PRESSURES[-1], radius, bearing)
    if rim_height == 0.0:
        return half_width
    skirt = math.sqrt(2.0 * radius * rim_height)
    return half_width + 0.5 * rim_width + max(0.5 * rim_width, skirt)


def half_of(size: tuple[float, float, float]) -> float:
    """Take half of the width of a patch, not quite zero, [m]."""
    return max(0.5 * size[0], 1e-9)


def roller_path(patch: Patch, size: tuple[float, float, float], radius: float, reach: float) -> Float:
    """Take the gap under a rigid roller at even arcs from 0 to `reach` off the centre, [PATH_CELLS + 1], [m].

    A rigid roller at arc s rests on the surface point t that holds it highest: its gap is the least of
    ``z(t) + r - sqrt(r^2 - (s - t)^2)``, z the depth of the surface. Over a flat floor with sharp edges that
    is about e^2 / (2 r) at distance e inside of the nearer edge, and never more than the depth.

    ``size``: width, depth and rim height [m]; ``radius``: r of a cylinder on a plane in place of roller and
    ring [m]; ``reach``: from `reach_of` or more [m].

    References
    ----------
    Geometric bridging h = r - sqrt(r^2 - x^2): Sawalhi and Randall (2008).
    """
    depth, rim_height = size[1:]
    half = half_of(size)
    place = np.linspace(0.0, reach, PATH_CELLS + 1)
    # half is symmetric: no point on the far side holds the roller higher than its mirror image
    touched = np.union1d(place, [half])
    bare = floor_of(patch.kind, touched, half, depth) - rim_of(touched, half, rim_height, patch.rim_width)
    aside = np.minimum(np.abs(place[:, None] - touched), radius)
    path = (bare + radius - np.sqrt(radius**2 - aside**2)).min(axis=1)
    path[-1] = 0.0
    return np.asarray(path)


# --- sharp edges under load


def contact_half_width(pressure: float, radius: float, bearing: RollerBearing) -> float:
    """Work out half of the width of an intact line contact of a largest pressure [Pa], [m]."""
    return 4.0 * radius * pressure / bearing.material.contact_modulus


def edge_sink(inside: Float, half_width: float, radius: float) -> Float:
    """Work out how much deeper a roller goes at the edge of a half-space that falls away, [m].

    Parameters
    ----------
    inside : float64 array
        How far the middle of the roller is beyond the edge, [m]; negative on the intact side.
    half_width : float
        b of the intact contact under the same load, [m].
    radius : float
        Of a cylinder on a plane in place of roller and ring, [m].

    Returns
    -------
    float64 array
        [m], shape of `inside`; zero where the edge is beyond the intact contact.

    Notes
    -----
    The edge is as stiff as the rest of the half-space. The contact lies from the edge, at c from the middle
    of the roller, to c + 2 l. Its pressure (E / 2 R) sqrt((l - x) / (l + x)) (2 l + c + x), x from the middle
    of the contact, falls to zero at the far end, with singular pressure at the edge; its load is that of the
    intact contact, 3 l^2 + 2 c l = b^2. The approach at x = 0 less that of the intact contact is
    ((c + l)^2 + b^2 ln(b / l) + (l^2 - b^2) / 2) / 2 R.

    References
    ----------
    Johnson (1985), Contact mechanics, section 2.7: pressure under a given profile in plane strain, here one
    with a single corner.
    """
    c = np.maximum(inside, -half_width)
    square = half_width * half_width
    # the root without a difference of nearly equal numbers
    length = square / (c + np.sqrt(c * c + 3.0 * square))
    sink = (c + length) ** 2 + square * np.log(half_width / length) + 0.5 * (length * length - square)
    return np.asarray(sink / (2.0 * radius))


def edge_softness(
    patch: Patch,
    size: tuple[float, float, float],
    radius: float,
    reach: float,
    path: Float,
    bearing: RollerBearing,
) -> Float:
    """Work out how much softer a contact is near sharp edges, at the arcs of a `path`, [PATH_CELLS + 1], [-].

    A roller with its middle over or near an edge sinks deeper under load than a rigid one, about in
    proportion: by y times the penetration e that an intact contact has under the same load. The sink is the
    path and y e, and the contact is a spring of 1 / (1 + s) of the intact stiffness from the path on, with
    s = (1 + y)^(10/9) - 1. For s = 0 its edges are rigid; other kinds and rims have it everywhere.

    ``size``: width, depth and rim height [m]; ``radius``: of a cylinder on a plane [m]; ``reach``: of the
    path [m].

    Notes
    -----
    y is the mean over `EDGE_PRESSURES` of the sink beyond the path over e. The sink is that at the nearer
    edge alone, see `edge_sink`, and at most the greatest depth of the path and that of the floor below: over
    the middle of a slot both edges bear, and the sink is that of the rigid roller whatever the load. Next to
    strips of a half-space, slots of 0.3 to 6 mm and 2 to 20 kN a roller, the force on a held roller is right
    to 11 % of that of an intact contact, the sink to a fifth and a tenth of e (`evidence/impact/edges.py`).
    Neglects that floor and edge bear together; an edge is as stiff as the rest of the half-space.
    """
    if not sharp(patch) or size[1] <= 0.0:
        return np.zeros(PATH_CELLS + 1)
    arc, half = np.linspace(0.0, reach, PATH_CELLS + 1), half_of(size)
    inside = half - arc
    bottom = np.full(PATH_CELLS + 1, path.max())
    below = arc < half
    bottom[below] = np.minimum(floor_of(patch.kind, arc[below], half, size[1]), path.max())
    modulus, length = bearing.material.contact_modulus, bearing.effective_length
    more = np.zeros(PATH_CELLS + 1)
    for pressure in EDGE_PRESSURES:
        half_width = contact_half_width(pressure, radius, bearing)
        load = math.pi * 0.5 * modulus * half_width**2 / (4.0 * radius) * length
        depth = (load / line_contact_factor(bearing.material, length)) ** 0.9
        sink = np.minimum(edge_sink(inside, half_width, radius), bottom)
        more += np.maximum(sink - path, 0.0) / depth
    softness = (1.0 + more / len(EDGE_PRESSURES)) ** (10.0 / 9.0) - 1.0
    softness[-1] = 0.0
    return np.asarray(softness)
