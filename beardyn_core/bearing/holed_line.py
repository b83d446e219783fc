"""Load of a line contact over holes in the raceway, from an elastic half-space.

Next to a hole the surface sinks with its neighbours, and the ends of the contact next to it carry more than
their length of the load: a hole of a twelfth of the line takes a twenty-fifth of the load. Here the line is a
row of strips, each a line contact of its own width that is pressed into the half-space together with all
others.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from functools import lru_cache
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.lamina_coupling import rectangle_influence

Interval = tuple[float, float]  # along the line, from its middle [m]

PRESSURE = 0.8e9  # of the intact contact [Pa]: 9 kN on a roller of HS130x230
_GROWTH = 1.4  # of a strip over the one nearer to an end of the line or of a hole
_NARROWEST = 1.0  # strip or hole, over the half width of the contact
_WIDTHS = 4  # times that the widths of the strips are found from their loads
# Half width over which a uniform pressure has the mean sink of Hertz's, weighted by Hertz's: exp(3/4) / 2
_UNIFORM = 0.5 * math.exp(0.75)


def lost_share(
    holes: Sequence[Interval],
    length: float,
    radius: float,
    contact_modulus: float,
    pressure: float = PRESSURE,
) -> A[float, "[-]"]:
    """Compute the share of the load that a held cylinder loses where it lies over holes.

    The holes are so deep that nothing presses in them, and wide in rolling direction next to the contact.
    Holes may overlap.

    Parameters
    ----------
    holes : sequence of (low, high)
        Along the line, from its middle, [m].
    length, radius : float
        Of the line; of a cylinder on a plane in place of roller and ring, [m].
    contact_modulus : float
        E', [Pa].
    pressure : float, optional
        Largest Hertz pressure of the intact contact, [Pa]. Between 0.4 and 1.6 GPa the share of a hole of
        4 mm in a line of 50 mm falls from 0.041 to 0.032.

    Notes
    -----
    Next to a conjugate-gradient solution on a grid of the half-space (`test/kernels/naive_half_space.py`) the
    share is right to 2 % from 4 mm and to 12 % from 0.5 mm on.

    References
    ----------
    Love (1929) for the sink next to a pressed rectangle; Johnson (1985), Contact Mechanics, section 4.2, for
    the width and the approach of a line contact.
    """
    least = _NARROWEST * _half_width(radius, contact_modulus, pressure)
    found = merge_holes(holes, length, least)
    if not found:
        return 0.0
    if found == ((-0.5 * length, 0.5 * length),):
        return 1.0
    return _lost_share(found, length, radius, contact_modulus, pressure)


def merge_holes(holes: Sequence[Interval], length: float, least: float) -> tuple[Interval, ...]:
    """Merge holes of a line in ascending order; what is shorter than a least length [m] does not count.

    Neither a hole nor what is left between two of them, or between one and an end of the line: so narrow a
    ridge gives way under its load, and strips of a half-space leave it out.
    """
    half = 0.5 * length
    merged: list[Interval] = []
    for low, high in sorted((max(low, -half), min(high, half)) for low, high in holes):
        low, high = (-half if low < least - half else low), (half if high > half - least else high)
        if high - low <= 0.0:
            continue
        if merged and low < merged[-1][1] + least:
            merged[-1] = (merged[-1][0], max(merged[-1][1], high))
        else:
            merged.append((low, high))
    return tuple(each for each in merged if each[1] - each[0] >= least)


def _half_width(radius: float, contact_modulus: float, pressure: float) -> float:
    return 4.0 * radius * pressure / contact_modulus


@lru_cache(maxsize=4096)
def _lost_share(
    holes: tuple[Interval, ...], length: float, radius: float, contact_modulus: float, pressure: float
) -> float:
    half_width = _half_width(radius, contact_modulus, pressure)
    ends = [-0.5 * length, *(end for hole in holes for end in hole), 0.5 * length]
    edges = _graded(np.unique(ends), half_width)
    low, high = edges[:-1], edges[1:]
    middle = 0.5 * (low + high)
    open_ = np.zeros(len(middle), bool)
    for hole in holes:
        open_ |= (middle > hole[0]) & (middle < hole[1])
    per_length = math.pi * contact_modulus * half_width**2 / (8.0 * radius)
    every = np.ones(len(middle), bool)
    # the approach at which the middle of the intact line has the pressure that is asked for
    matrix = _sinks(low, high, np.full(len(middle), half_width), contact_modulus)
    approach = float(np.max(matrix @ (per_length * (high - low)))) + half_width**2 / (8.0 * radius)
    intact = _loads(low, high, every, approach, half_width, radius, contact_modulus)
    holed = _loads(low, high, ~open_, approach, half_width, radius, contact_modulus)
    return float(1.0 - holed.sum() / intact.sum())


def _graded(ends: Float, smallest: float) -> Float:
    """Divide lengths between ends into strips that grow away from both, shape [strip + 1], [m]."""
    edges = [ends[:1]]
    for low, high in itertools.pairwise(ends):
        half, sizes = 0.5 * (high - low), [smallest]
        while sum(sizes) + _GROWTH * sizes[-1] < half:
            sizes.append(_GROWTH * sizes[-1])
        grown = np.cumsum(sizes) * half / sum(sizes)
        edges += [low + grown, high - grown[-2::-1], np.array([high])]
    return np.concatenate(edges)


def _sinks(low: Float, high: Float, half_width: Float, contact_modulus: float) -> Float:
    """Compute the sink of strip i by the load of strip j, [i, j], [m/N]."""
    distance = 0.5 * (low + high)[:, None] - 0.5 * (low + high)
    return rectangle_influence(distance, high - low, _UNIFORM * half_width, contact_modulus)


def _loads(
    low: Float,
    high: Float,
    pressed: Float,
    approach: float,
    half_width: float,
    radius: float,
    contact_modulus: float,
) -> Float:
    """Find the loads of the pressed strips at an approach [m], [N]."""
    low, high = low[pressed], high[pressed]
    width: Float = np.full(len(low), half_width)
    load: Float = np.zeros(len(low))
    for _ in range(_WIDTHS):
        sinks = _sinks(low, high, width, contact_modulus)
        load = np.asarray(np.linalg.solve(sinks, approach - width**2 / (8.0 * radius)))
        per_length = np.maximum(load, 0.0) / (high - low)
        found = np.sqrt(8.0 * per_length * radius / (math.pi * contact_modulus))
        width = np.asarray(np.maximum(found, 0.1 * half_width))
    return np.maximum(load, 0.0)
