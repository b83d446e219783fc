"""Spalls as a gap: how far a lamina sinks where the raceway or its own surface is missing."""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, magnitude, wrap

SPALL_AZIMUTH, SPALL_HALF_WIDTH, SPALL_RADIUS, SPALL_DEPTH = 0, 1, 2, 3  # fields of a patch


@inline
def spall_gap(lanes: Any, block: Any, azimuth: Any, lamina: Any, roller_radius: Any, spall: Any) -> Any:
    """Gap of one lamina over the spalls of one surface, [m].

    A rigid roller of radius r that bridges a patch rests on the nearer edge, at distance e inside of which
    it sinks by e^2 / (2 r), and never deeper than the floor. Neglects the tilt of the edge contact's
    normal and the elastic flattening of the edge.

    References
    ----------
    Geometric bridging h = r - sqrt(r^2 - x^2), to second order in x; Sawalhi and Randall (2008).
    """
    if spall is None:
        return 0.0
    patches = spall.patches
    gap = lanes.constant(0.0)
    for patch in range(block, patches.shape[0], spall.block_count):
        arc = magnitude(wrap(azimuth - lanes.load(patches, patch, SPALL_AZIMUTH)))
        arc = arc * lanes.load(patches, patch, SPALL_RADIUS)
        inside = at_least(lanes.load(patches, patch, SPALL_HALF_WIDTH) - arc, 0.0)
        sink = inside * inside / (2.0 * roller_radius)
        gap = gap + at_most(sink, lanes.load(patches, patch, SPALL_DEPTH + lamina))
    return gap
