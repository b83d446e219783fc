"""A barrel over patches in the lumped tier: what its whole contact carries in balance with the damaged one.

The roller is one spring, but over a patch the slices of both ellipses are summed one by one. The depth e of
the damaged contact and the depth D - e of the whole one have the same load; two secants find e, which is
exact where the damaged load is that of an ellipse over some depth less, or some share of it. The middle of
the ellipse is taken in the middle of the roller.

References
----------
Hertz's ellipse in independent slices, see `bearing.contact_law.SlicedEllipse`.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.layout import LAMINA_PLACE
from beardyn_core.physics.defect import gap_moments
from beardyn_core.physics.lanes.lane_math import at_least, at_most, exp2, log2, magnitude, sqrt, where_greater

_NOTHING = 1e-18  # of a length, so that quotients stay finite [m]
_LEAST_POWER = 1e-30  # of a depth to the power 1.5
_TWO_THIRDS = 2.0 / 3.0


@inline
def over_barrel_patches(lanes, approach, near, faults, laminae, barrels):
    """Work out the approach at which an intact barrel has the load of one over patches, and its slope.

    ``approach``: of cone and cup [m]; ``near`` (2 flags): of cup and cone, from `find_damage`; ``barrels``:
    `BarrelParams` of cup and cone.
    """
    half = 0.5 * approach
    first = _whole_depth(lanes, half, near, faults, laminae, barrels)
    # the balance lies between half the approach and what a whole contact of that load leaves of it
    other = approach - first
    second = _whole_depth(lanes, other, near, faults, laminae, barrels)
    step = other - half
    share = (magnitude(step) + _NOTHING) / (magnitude(step) + magnitude(second - first) + 2.0 * _NOTHING)
    depth = half + share * step
    third = _whole_depth(lanes, depth, near, faults, laminae, barrels)
    left = third + depth - approach
    at_half = first + half - approach
    # the end of the bracket on the other side of the balance
    same = left * at_half
    end, at_end = where_greater(same, 0.0, other, half), where_greater(same, 0.0, second, first)
    step = end - depth
    last = (magnitude(left) + _NOTHING) / (magnitude(step) + magnitude(at_end - third) + 2.0 * _NOTHING)
    depth = depth + at_most(last, 1.0) * step
    return at_least(2.0 * (approach - depth), 0.0), 2.0 * (1.0 - share)


@inline
def _whole_depth(lanes, depth, near, faults, laminae, barrels):
    """Work out how deep a whole contact has the load that a damaged one has at a depth, [m]."""
    pressed = at_least(depth, 0.0)
    whole = pressed * sqrt(pressed)
    changed = _change(lanes, depth, whole, near[0], faults.cup_damage, laminae, barrels[0])
    changed = changed + _change(lanes, depth, whole, near[1], faults.cone_damage, laminae, barrels[1])
    return exp2(_TWO_THIRDS * log2(at_least(whole + changed, _LEAST_POWER)))


@inline
def _change(lanes, depth, whole, near, damage, laminae, barrel):
    """Work out what patches change of the load of a contact, as a power 1.5 of a depth, [m^1.5].

    Lost load is a share of what the slices carry, however coarse they are for the ellipse; what a raised rim
    adds is Hertz's.
    """
    zero = 0.0 * depth
    if not near:
        return zero
    intact, damaged, count = zero, zero, laminae.shape[1]
    for k in range(count):
        x = laminae[LAMINA_PLACE, k]
        sunk = depth - barrel.sharpness * (x * x)
        share, lost, gap = gap_moments(lanes, near, k, count, damage)
        pressed = at_least(sunk, 0.0)
        intact = intact + pressed
        damaged = damaged + ((1.0 - share) * pressed + at_least((share - lost) * sunk - gap, 0.0))
    width = laminae[LAMINA_PLACE, 1] - laminae[LAMINA_PLACE, 0]
    added = damaged - intact
    hertz = added * (0.75 * width * sqrt(barrel.sharpness + zero))
    return where_greater(added, 0.0, hertz, whole * added / at_least(intact, _NOTHING))
