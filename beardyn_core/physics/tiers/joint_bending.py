"""Few modes of the axlebox and the motion of rigid rings together: what a step adds for springs of rollers.

`kinematic_bending` takes these springs by the series of the openings, whatever the modes are. Where the modes
are fewer than the terms of the series, and nothing but raceways feels them, the same is had by modes and
motions of the rings, q: the approach of the rollers is ``b^T W q`` with the motions W of the series. With
``B = (h C/2 + h^2 K/12)``, now of W^T K W, and the compliance D of modes and rings, the response to an
acceleration without it is ``(1 + B D)^-1 B``.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline


@inline
def combine(lanes, rows, weights, product, page):
    """Write a sum of rows [row, block, lane] with one weight each to a page of a product."""
    for block in range(rows.shape[1]):
        total = lanes.constant(0.0)
        for k in range(weights.shape[0]):
            total = total + weights[k] * lanes.load(rows, k, block)
        lanes.store(product, page, block, total)


@inline
def clear_springs(lanes, joint):
    """Start the sums over the rollers."""
    for i in range(joint.springs.shape[0]):
        for block in range(joint.springs.shape[1]):
            lanes.store(joint.springs, i, block, lanes.constant(0.0))


@inline
def add_joint_spring(lanes, spring, waves, first, joint):
    """Add a roller to the sums; ``waves``: at the roller, of the series from row `first` on."""
    for block in range(joint.springs.shape[1]):
        total = lanes.constant(0.0)
        for k in range(waves.shape[0]):
            total = total + waves[k] * lanes.load(joint.motions, first + k, block)
        lanes.store(joint.vectors, 0, block, total)
    for i in range(joint.springs.shape[0]):
        share = spring * joint.rows[0, i]
        for block in range(joint.springs.shape[1]):
            before = lanes.load(joint.springs, i, block)
            lanes.store(joint.springs, i, block, before + share * lanes.load(joint.vectors, 0, block))


@inline
def hold_joint(lanes, joint):
    """Work out the response from the sums over the rollers, and keep it."""
    count = joint.springs.shape[0]
    for i in range(count):
        for block in range(joint.response.shape[1]):
            lanes.store(joint.response, i, block, lanes.load(joint.springs, i, block))
        combine(lanes, joint.give, joint.springs_rows[i, :count], joint.system, i)
        joint.system_rows[i, i] += 1.0
    # elimination without pivots: the matrix has the eigenvalues of a symmetric one, none below 1
    for column in range(count):
        for i in range(column + 1, count):
            share = joint.system_rows[i, column] / joint.system_rows[column, column]
            _less(lanes, joint.system, i, column, share)
            _less(lanes, joint.response, i, column, share)
    for back in range(count):
        i = count - 1 - back
        for k in range(i + 1, count):
            _less(lanes, joint.response, i, k, joint.system_rows[i, k])
        inverse = 1.0 / joint.system_rows[i, i]
        for block in range(joint.response.shape[1]):
            lanes.store(joint.response, i, block, inverse * lanes.load(joint.response, i, block))


@inline
def _less(lanes, rows, i, k, share):
    """Take a share of a row off another one."""
    for block in range(rows.shape[1]):
        left = lanes.load(rows, i, block) - share * lanes.load(rows, k, block)
        lanes.store(rows, i, block, left)


@inline
def kick_joint(lanes, flex_speed, pushed, draw, inverse, more, step, joint):
    """Accelerate the modes, and return the wrench on the cup that the held stiffness adds, 5 numbers.

    ``flex_speed``, ``pushed``, ``draw``, ``inverse`` [mode]: speeds, forces on the modes, what these draw
    back with and one over their inertia; ``more`` (5 numbers): acceleration of the cone against the cup
    without it.
    """
    modes, count = draw.shape[0], joint.springs.shape[0]
    given, extra = joint.rows[0], joint.rows[1]
    for m in range(modes):
        given[m] = pushed[m] * inverse[m] - draw[m]
    for i in range(5):
        given[modes + i] = more[i]
    combine(lanes, joint.response, given[:count], joint.vectors, 1)
    for m in range(modes):
        flex_speed[m] += step * (given[m] - extra[m] * inverse[m])
    return extra[modes], extra[modes + 1], extra[modes + 2], extra[modes + 3], extra[modes + 4]
