"""Slow, obvious references of damaged raceways: how a roller sinks into a patch, how soft its edges are."""

from __future__ import annotations

import math

import numpy as np
from scipy.optimize import brentq

from beardyn_core.bearing.geometry import Bearing
from beardyn_core.scene.patch import Patch
from test.kernels.naive import Float


def rolling_radii(bearing: Bearing, places: Float) -> Float:
    """Radius of a cylinder on a plane for each place along the contact of roller and cup, by curvatures.

    Curvature of a cone in its normal section: cosine of its half angle over its radius there.
    """
    from_apex = bearing.apex_distance + places
    roller = from_apex * math.tan(bearing.half_angle)
    # the line of contact is the roller's generator, longer than its axis by the cosine
    along = from_apex / math.cos(bearing.half_angle)
    curvature = math.cos(bearing.half_angle) / roller
    radii: Float = 1.0 / (curvature - math.cos(bearing.cup_angle) / (along * math.sin(bearing.cup_angle)))
    return radii


def spall_sink(arc: float, half_width: float, depth: float, roller_radius: float) -> float:
    """How far a roller sinks into a patch with sharp edges: it rests on the nearer edge or on the floor."""
    inside = half_width - abs(arc)
    if inside <= 0.0:
        return 0.0
    return min(roller_radius - math.sqrt(roller_radius**2 - inside**2), depth)


def edge_softness(arc: float, patch: Patch, radius: float, bearing: Bearing) -> float:
    """What a contact is softer by near the sharp edges of a spall, with the contact at one edge by a search.

    The contact reaches from the edge, c from the middle, over 2 l; its load is that of a sound one of half
    width b, its approach beyond the sound one's is the sink.
    """
    inside = 0.5 * patch.width - abs(arc)
    rigid = spall_sink(arc, 0.5 * patch.width, patch.depth, radius)
    deepest = spall_sink(0.0, 0.5 * patch.width, patch.depth, radius)
    modulus, length = bearing.material.contact_modulus, bearing.effective_length
    ratios = []
    for pressure in (0.3e9, 0.5e9, 0.7e9, 1e9):
        b = 2.0 * radius * pressure / (0.5 * modulus)
        load = 0.5 * math.pi * pressure * b * length
        sound = (load / (0.356 * modulus * length ** (8.0 / 9.0))) ** 0.9
        sink = 0.0
        if inside > -b:
            half = float(brentq(lambda at, b=b: 3.0 * at**2 + 2.0 * inside * at - b**2, 1e-9 * b, 3.0 * b))
            sink = (inside + half) ** 2 - 0.5 * (b**2 - half**2) + b**2 * math.log(b / half)
        ratios.append(max(min(sink / (2.0 * radius), deepest) - rigid, 0.0) / sound)
    return float((1.0 + np.mean(ratios)) ** (10.0 / 9.0) - 1.0)


def path_of_roller(
    arc: float, half: float, depth: float, kind: str, rim: float, rim_width: float, radius: float
) -> float:
    """Gap of a disc rolled over a patch: no point of the surface may be inside of it."""
    least = 0.0 if abs(arc) > half + rim_width + math.sqrt(2.0 * radius * rim) else math.inf
    for t in np.append(np.linspace(-2.5 * half, 2.5 * half, 4001), [-half, half]):
        if abs(t - arc) < radius:
            surface = 0.0
            if abs(t) < half:
                u = t / half
                surface = (
                    depth
                    * {
                        "spall": 1.0,
                        "rectangular": 1.0,
                        "half_sine": math.sin(0.5 * math.pi * (u + 1.0)),
                        "elliptic": math.sqrt(1.0 - u**2),
                        "brinelling": math.sqrt(1.0 - u**2),
                        "dent": 0.5 * (1.0 + math.cos(math.pi * u)),
                    }[kind]
                )
            elif abs(t) < half + rim_width:
                surface = -0.5 * rim * (1.0 - math.cos(2.0 * math.pi * (abs(t) - half) / rim_width))
            least = min(least, surface + radius - math.sqrt(radius**2 - (t - arc) ** 2))
    return least
