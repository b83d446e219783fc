"""Bending of the axlebox in the tiers with kinematic rollers, along the normals of the cups alone.

Rollers without friction press along the cup's normal, so of the three displacements of a raceway they see
the radial one times the cosine of the cup's angle less the axial one times its sine. Once a step the modes
give this opening as series around both raceways, which are turned into the frame of the cages: there the
waves at the pockets never change.

The stiffness of many rollers on a mode is as large as its own. The step takes it as `kinematic_rings` does
for rigid rings, with the same motion of all: ``(M + B) a = F`` for rings and modes together, where
``B = (h C/2 + h^2 K/12)`` acts on the series of the approach. With the compliance D of rings and modes,
``R = (1 + B D)^-1 B`` turns the acceleration of the approach without it into forces on the series. R is built
up roller by roller: another spring k at the waves b adds ``k u u^T / (1 + k b^T D u)`` with
``u = (1 - R D) b``, a positive pivot whatever the rollers are.
"""

from __future__ import annotations

from functools import partial

from beardyn_core.jit import FASTMATH, entry, inline
from beardyn_core.kernels.bodies import row_of
from beardyn_core.kernels.box import SUSPENSION
from beardyn_core.kernels.structure import show_seats
from beardyn_core.model.layout import SIGNAL_CHANNELS, SUM_FIELDS

PLACE, SPEED, DRAW = range(3)

# sums may be taken in any order here, so that they go into vectors
_sums_in_any_order = partial(entry, flags=(*FASTMATH, "reassoc"))


@_sums_in_any_order
def _see(flex, shapes, stiffness, damping, inertia, seen):
    """Write openings, their speeds and what the modes' own springs and dampers take from those."""
    for k in range(shapes.shape[1]):
        seen[PLACE, k], seen[SPEED, k], seen[DRAW, k] = 0.0, 0.0, 0.0
    for m in range(shapes.shape[0]):
        place, speed = flex[PLACE, m], flex[SPEED, m]
        draw = (stiffness[m] * place + damping[m] * speed) / inertia[m]
        for k in range(shapes.shape[1]):
            seen[PLACE, k] += place * shapes[m, k]
            seen[SPEED, k] += speed * shapes[m, k]
            seen[DRAW, k] += draw * shapes[m, k]


@_sums_in_any_order
def _multiply(matrix, vector, product):
    """Write the product of a matrix and a vector."""
    for i in range(matrix.shape[0]):
        total = 0.0
        for j in range(matrix.shape[1]):
            total += matrix[i, j] * vector[j]
        product[i] = total


@inline
def show_openings(lanes, flex, direction, box, bending):
    """Write the openings of both raceways for every lane, and the motion of the suspension's seats."""
    if bending is None:
        return
    show_seats(flex, box, bending)
    _see(flex, bending.shapes, bending.stiffness, bending.damping, bending.inertia, bending.seen)
    seen, shown = bending.seen, bending.shown
    series, width = shown.shape[1] // 2, shown.shape[2]
    waves, rows = series // 2, seen.shape[1] // series
    for kind in range(2):
        for lane in range(width):
            shown[0, kind * series, lane] = seen[kind, series * row_of(0, lane, width, rows)]
        turn = (1.0, 0.0)
        for n in range(1, waves + 1):
            turn = turned_by(turn, direction)
            for lane in range(width):
                first = series * row_of(0, lane, width, rows) + n
                a, b = seen[kind, first], seen[kind, first + waves]
                shown[0, kind * series + n, lane] = a * turn[0] + b * turn[1]
                shown[0, kind * series + waves + n, lane] = b * turn[0] - a * turn[1]


@inline
def less_opening(lanes, block, kind, value, bending):
    """Take the opening, or its speed, at a block of pockets off the approach, or its rate."""
    if bending is None:
        return value
    series = bending.basis.shape[1]
    waves, first = series // 2, kind * series
    even, odd = value - lanes.load(bending.shown, 0, first), lanes.constant(0.0)
    for n in range(1, waves + 1):
        even = even - lanes.load(bending.shown, 0, first + n) * lanes.load(bending.basis, block, n)
        with_sine = lanes.load(bending.basis, block, waves + n)
        odd = odd - lanes.load(bending.shown, 0, first + waves + n) * with_sine
    return even + odd


@inline
def clear_reaction(lanes, sums, bending):
    """Start the sums of the forces on the openings."""
    if bending is None:
        return
    for k in range(bending.basis.shape[1]):
        lanes.store(sums, 0, SUM_FIELDS + k, lanes.constant(0.0))


@inline
def add_reaction(lanes, sums, block, load, bending):
    """Add the loads of a block of rollers, 0 where there are none, to the forces on the openings."""
    if bending is None:
        return
    for k in range(bending.basis.shape[1]):
        before = lanes.load(sums, 0, SUM_FIELDS + k)
        lanes.store(sums, 0, SUM_FIELDS + k, before + load * lanes.load(bending.basis, block, k))


@inline
def keep_tangent(lanes, block, tangent, bending):
    """Keep the stiffness of a block of rollers along the cup's normal for `hold_bending`."""
    if bending is None:
        return
    lanes.store(bending.tangents, block, 0, tangent)


@inline
def turn_reaction(sums, direction, bending):
    """Sum the lanes and turn the forces on the openings out of the frame of the cages."""
    if bending is None:
        return
    forces, width, series = bending.forces, sums.shape[3], bending.basis.shape[1]
    waves, rows = series // 2, bending.forces.shape[1] // series
    for row in range(rows):
        first, start, end = series * row, row * width // rows, (row + 1) * width // rows
        forces[0, first] = _lane_sum(sums, SUM_FIELDS, start, end)
        turn = (1.0, 0.0)
        for n in range(1, waves + 1):
            turn = turned_by(turn, direction)
            a = _lane_sum(sums, SUM_FIELDS + n, start, end)
            b = _lane_sum(sums, SUM_FIELDS + waves + n, start, end)
            forces[0, first + n] = a * turn[0] - b * turn[1]
            forces[0, first + waves + n] = a * turn[1] + b * turn[0]


@inline
def _lane_sum(sums, field, start, end):
    total = 0.0
    for lane in range(start, end):
        total += sums[0, 0, field, lane]
    return total


@inline
def hold_bending(direction, bending):
    """Work out what an acceleration of the approach adds to the forces on the openings, and keep it."""
    tangents, response = bending.tangents, bending.response
    for i in range(response.shape[0]):
        for j in range(response.shape[1]):
            response[i, j] = 0.0
    for block in range(tangents.shape[0]):
        for lane in range(tangents.shape[2]):
            if tangents[block, 0, lane] > 0.0:
                _add_spring(block, lane, direction, bending)


@inline
def _add_spring(block, lane, direction, bending):
    """Add a roller to the response, see the head of this file."""
    spring = bending.lag * bending.tangents[block, 0, lane]
    series = bending.basis.shape[1]
    waves, rows = series // 2, bending.give.shape[0] // series
    first = series * row_of(0, lane, bending.basis.shape[2], rows)
    here, yielded, added = bending.approach[0], bending.approach[1], bending.approach[2]
    for k in range(here.shape[0]):
        here[k] = 0.0
    here[first] = 1.0
    place = turned_by((bending.basis[block, 1, lane], bending.basis[block, waves + 1, lane]), direction)
    turn = place
    for n in range(1, waves + 1):
        here[first + n], here[first + waves + n] = turn
        turn = turned_by(turn, place)
    _multiply(bending.give, here, yielded)
    _multiply(bending.response, yielded, added)
    for k in range(here.shape[0]):
        added[k] = here[k] - added[k]
    pivot = 1.0
    for k in range(here.shape[0]):
        pivot += spring * yielded[k] * added[k]
    for i in range(here.shape[0]):
        share = spring / pivot * added[i]
        for j in range(here.shape[0]):
            bending.response[i, j] += share * added[j]


@inline
def turned_by(one, other):
    """Turn a direction by another: cosine and sine of the sum of their angles."""
    return one[0] * other[0] - one[1] * other[1], one[1] * other[0] + one[0] * other[1]


@inline
def kick_modes(flex, more, box, signal, step, bending):
    """Accelerate the modes, and return the wrench on the cup that the held stiffness adds, 5 numbers.

    ``more`` (5 numbers): acceleration of the cone against the cup without it; ``signal``: written behind
    `SIGNAL_CHANNELS`: acceleration of the sensors' seats, of the instant itself.
    """
    forces, extra, approach, seen = bending.forces[0], bending.forces[1], bending.approach, bending.seen
    _multiply(bending.modal_give, forces, approach[0])
    for k in range(extra.shape[0]):
        total = seen[DRAW, k] - approach[0, k]
        for i in range(5):
            total += bending.rigid[k, i] * more[i]
        for i in range(6):
            total -= bending.seat_give[k, i] * box[SUSPENSION + i]
        approach[1, k] = total
    _multiply(bending.response, approach[1], extra)
    for k in range(extra.shape[0]):
        forces[k] += extra[k]
    _multiply(bending.shapes, forces, bending.push)
    _push_at_seats(box, bending.push, bending.suspension)
    for m in range(bending.push.shape[0]):
        push = bending.push[m] - bending.stiffness[m] * flex[PLACE, m] - bending.damping[m] * flex[SPEED, m]
        bending.push[m] = push / bending.inertia[m]
        flex[SPEED, m] += step * bending.push[m]
    _shake_sensors(extra, signal, bending, bending.sensors)
    wrench = (0.0, 0.0, 0.0, 0.0, 0.0)
    for k in range(extra.shape[0]):
        r, f = bending.rigid, extra[k]
        wrench = (
            wrench[0] + r[k, 0] * f, wrench[1] + r[k, 1] * f, wrench[2] + r[k, 2] * f,
            wrench[3] + r[k, 3] * f, wrench[4] + r[k, 4] * f,
        )  # fmt: skip
    return wrench


@inline
def _push_at_seats(box, push, suspension):
    if suspension is None:
        return
    for i in range(6):
        for m in range(push.shape[0]):
            push[m] += suspension[i, m] * box[SUSPENSION + i]


@inline
def _shake_sensors(extra, signal, bending, sensors):
    """Write the seats' acceleration, without what the held springs add: see `add_response`."""
    if sensors is None:
        return
    for i in range(sensors.shape[0]):
        total = 0.0
        for m in range(sensors.shape[1]):
            total += sensors[i, m] * bending.push[m]
        for k in range(extra.shape[0]):
            total -= (1.0 - bending.damper_share) * bending.sensor_give[i, k] * extra[k]
        signal[SIGNAL_CHANNELS + i] = total
