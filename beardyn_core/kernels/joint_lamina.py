"""A lamina that lies partly over a patch, as one spring among laminae that sink with each other.

The law is in `beardyn_core.bearing.joint_lamina`.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, log2, magnitude, ninth_root, where_greater
from beardyn_core.model.layout import (
    SPRING_FIELDS,
    SPRING_GAP,
    SPRING_RING_SLOPE,
    SPRING_ROLLER_SLOPE,
    SPRING_SHARE,
)

_SPRINGS = 0  # the work space has one page
_SMALLEST = 1e-15
_NO_ENERGY = 1e-40  # of a depth of 1e-19 m
_SMALLEST_PART = 1e-30
_SMALLEST_LOOSE = 1e-12


@inline
def joint_depth(lanes: Any, depth: Any, lamina: Any, count: Any, damage: Any, exponent: Any) -> Any:
    """Work out the depth at which a lamina joins the others, [m].

    Parameters
    ----------
    depth : lane value
        Of its sound part, [m].
    lamina, count : int
    damage : DamageParams or None
        Springs of the contact from `find_damage`. The share of the sound part becomes the slope of the joint
        depth, with which the lamina presses; that of the damaged part how far it gives way with the gap.
    exponent : float
        Of the part that stands higher, [-].
    """
    if damage is None:
        return depth
    springs = damage.springs
    sound = SPRING_FIELDS * lamina + SPRING_SHARE
    damaged = SPRING_FIELDS * (count + lamina)
    cover = lanes.load(springs, _SPRINGS, damaged + SPRING_SHARE)
    gap = lanes.load(springs, _SPRINGS, damaged + SPRING_GAP)
    kept = at_most(at_least(where_greater(0.0 * gap, gap, cover, 1.0 - cover), _SMALLEST_PART), 1.0)
    held = exp2(exponent * log2(kept))
    loose = at_least(1.0 - held, _SMALLEST_LOOSE)
    reach = (1.0 - kept) / loose
    higher = depth - at_most(gap, 0.0)
    lower = at_least(higher - reach * magnitude(gap), 0.0)
    higher = at_least(higher, 0.0)
    higher_force = held * higher * ninth_root(at_least(higher, _SMALLEST))
    lower_force = loose * lower * ninth_root(at_least(lower, _SMALLEST))
    energy = higher_force * higher + lower_force * lower
    pressed = at_least(energy, _NO_ENERGY)
    force = higher_force + lower_force
    joint = exp2((9.0 / 19.0) * log2(pressed))
    with_gap = reach * lower_force / at_least(force, _NO_ENERGY)
    with_gap = where_greater(0.0 * gap, gap, 1.0 - with_gap, with_gap)
    partly = where_greater(cover, 0.0, energy, 0.0 * energy)
    share = where_greater(partly, _NO_ENERGY, force * joint / pressed, 1.0)
    lanes.store(springs, _SPRINGS, sound, share)
    lanes.store(springs, _SPRINGS, damaged + SPRING_SHARE, where_greater(partly, _NO_ENERGY, with_gap, cover))
    apart = at_most(depth - cover * gap, 0.0)
    joint = where_greater(energy, _NO_ENERGY, joint, apart)
    return where_greater(cover, 0.0, joint, depth)


@inline
def joint_share(lanes: Any, lamina: Any, damage: Any) -> Any:
    """Work out the part of its load that a lamina presses with: slope of its joint depth, [-]."""
    if damage is None:
        return 1.0
    return lanes.load(damage.springs, _SPRINGS, SPRING_FIELDS * lamina + SPRING_SHARE)


@inline
def joint_slopes(lanes: Any, lamina: Any, count: Any, damage: Any) -> Any:
    """Work out by how much a lamina gives way with the ring's and the roller's azimuth, [m/rad]."""
    field = SPRING_FIELDS * (count + lamina)
    share = lanes.load(damage.springs, _SPRINGS, field + SPRING_SHARE)
    return (
        share * lanes.load(damage.springs, _SPRINGS, field + SPRING_RING_SLOPE),
        share * lanes.load(damage.springs, _SPRINGS, field + SPRING_ROLLER_SLOPE),
    )
