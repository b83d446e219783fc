"""The path of a rigid roller over a patch."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from beardyn_core.scene.defect import Patch

Float = NDArray[np.float64]

PATH_CELLS = 256


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


def reach_of(half_width: float, rim_height: float, rim_width: float, radius: float) -> float:
    """Work out the arc from the centre beyond which a roller of a radius does not feel the patch, [m]."""
    if rim_height == 0.0:
        return half_width
    skirt = math.sqrt(2.0 * radius * rim_height)
    return half_width + 0.5 * rim_width + max(0.5 * rim_width, skirt)


def roller_path(patch: Patch, size: tuple[float, float, float], radius: float, reach: float) -> Float:
    """Take the gap under a roller at even arcs from 0 to `reach` off the centre, shape [PATH_CELLS + 1], [m].

    A rigid roller of radius r at arc s rests on the surface point t that holds it highest: its gap is the
    least of ``z(t) + r - sqrt(r^2 - (s - t)^2)``, z the depth of the surface. Over a flat floor with sharp
    edges that is about e^2 / (2 r) at distance e inside of the nearer edge, and never more than the depth.

    Parameters
    ----------
    size : tuple of float
        Width, depth and rim height, [m].
    radius : float
        Of the roller, [m].
    reach : float
        From `reach_of` or more, [m].

    Notes
    -----
    Neglects the curvature of the raceway, which makes the sink 13 % less on the cup and as much more on
    the cone, and the elastic flattening of edges and rims.

    References
    ----------
    Geometric bridging h = r - sqrt(r^2 - x^2): Sawalhi and Randall (2008).
    """
    width, depth, rim_height = size
    half = max(0.5 * width, 1e-9)
    place = np.linspace(0.0, reach, PATH_CELLS + 1)
    # half is symmetric: no point on the far side holds the roller higher than its mirror image
    touched = np.union1d(place, [half])
    bare = floor_of(patch.kind, touched, half, depth) - rim_of(touched, half, rim_height, patch.rim_width)
    aside = np.minimum(np.abs(place[:, None] - touched), radius)
    path = (bare + radius - np.sqrt(radius**2 - aside**2)).min(axis=1)
    path[-1] = 0.0
    return np.asarray(path)
