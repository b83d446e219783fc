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

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies.layout import SIGNAL_CHANNELS, SUM_FIELDS
from beardyn_core.physics.bodies.rigid_bodies import row_of
from beardyn_core.physics.suspension import SEAT_PLACE, SEAT_SPEED, SUSPENSION
from beardyn_core.physics.tiers.joint_bending import add_joint_spring, clear_springs, hold_joint, kick_joint

PLACE, SPEED = range(2)
GIVEN, APPROACH, EXTRA, HELD = range(4)  # pages of the vectors


@inline
def turned_by(one, other):
    """Turn a direction by another: cosine and sine of the sum of their angles."""
    return one[0] * other[0] - one[1] * other[1], one[1] * other[0] + one[0] * other[1]


@inline
def _multiply(lanes, matrix, blocks, first, vector, product, page):
    """Write so many blocks of a matrix [block, column, lane], from a column on, times a vector.

    Four blocks at once share the look at each number of the vector: loads, and not sums, take the time.
    """
    zero, pairs = lanes.constant(0.0), vector.shape[0] - vector.shape[0] % 2
    for block in range(0, blocks - 3, 4):
        even, odd = (zero, zero, zero, zero), (zero, zero, zero, zero)
        for i in range(0, pairs, 2):
            even = _add_four(lanes, matrix, block, first + i, vector[i], even)
            odd = _add_four(lanes, matrix, block, first + i + 1, vector[i + 1], odd)
        for i in range(pairs, vector.shape[0]):
            even = _add_four(lanes, matrix, block, first + i, vector[i], even)
        for k in range(4):
            lanes.store(product, page, block + k, even[k] + odd[k])
    for block in range(blocks - blocks % 4, blocks):
        one, other = zero, zero
        for i in range(0, pairs, 2):
            one = one + lanes.load(matrix, block, first + i) * vector[i]
            other = other + lanes.load(matrix, block, first + i + 1) * vector[i + 1]
        for i in range(pairs, vector.shape[0]):
            one = one + lanes.load(matrix, block, first + i) * vector[i]
        lanes.store(product, page, block, one + other)


@inline
def _add_four(lanes, matrix, block, column, weight, sums):
    """Add a column of four blocks of a matrix."""
    weight = lanes.constant(weight)
    return (
        sums[0] + weight * lanes.load(matrix, block, column),
        sums[1] + weight * lanes.load(matrix, block + 1, column),
        sums[2] + weight * lanes.load(matrix, block + 2, column),
        sums[3] + weight * lanes.load(matrix, block + 3, column),
    )


@inline
def show_openings(lanes, flex, direction, box, step, due, bending):
    """Move the modes, and write the openings of both raceways for every lane and the suspension's seats.

    ``due``: whether the places are read of the modes, and not of the places and speeds of the step before.
    """
    if bending is None:
        return
    _see(lanes, flex, step, due, bending)
    seen, shown = bending.seen_row, bending.shown
    openings = bending.rigid.shape[0]
    for i in range(bending.forces.shape[0] - openings):
        box[SEAT_PLACE + i] = seen[PLACE, openings + i]
        box[SEAT_SPEED + i] = seen[SPEED, openings + i]
    series = shown.shape[1] // 2
    waves, rows = series // 2, openings // series
    for kind in range(2):
        lanes.store(shown, 0, kind * series, _in_rows(lanes, seen[kind], 0, series, rows, bending))
    turn = (1.0, 0.0)
    for n in range(1, waves + 1):
        turn = turned_by(turn, direction)
        for kind in range(2):
            a = _in_rows(lanes, seen[kind], n, series, rows, bending)
            b = _in_rows(lanes, seen[kind], n + waves, series, rows, bending)
            lanes.store(shown, 0, kind * series + n, a * turn[0] + b * turn[1])
            lanes.store(shown, 0, kind * series + waves + n, b * turn[0] - a * turn[1])


@inline
def _see(lanes, flex, step, due, bending):
    """Move the modes, work out what their springs and dampers take, and read places and speeds of them.

    Places move along with the speeds, which are read at every step; so they are read of the modes only 400
    times a second, and differ by rounding until then.
    """
    shapes, seen, draw = bending.shapes, bending.seen, bending.draw
    for m in range(draw.shape[0]):
        flex[PLACE, m] += step * flex[SPEED, m]
        draw[m] = bending.stiffness[m] * flex[PLACE, m] + bending.damping[m] * flex[SPEED, m]
    blocks = (bending.forces.shape[0] + lanes.width - 1) // lanes.width
    _multiply(lanes, shapes, blocks, 0, flex[SPEED], seen, SPEED)
    if due:
        _multiply(lanes, shapes, blocks, 0, flex[PLACE], seen, PLACE)
        return
    for block in range(blocks):
        moved = step * lanes.load(seen, SPEED, block)
        lanes.store(seen, PLACE, block, lanes.load(seen, PLACE, block) + moved)


@inline
def _in_rows(lanes, series_of_rows, term, series, rows, bending):
    """Give every lane the term of its row."""
    value = lanes.load(bending.row_lanes, 0, 0) * series_of_rows[term]
    if rows > 1:
        value = value + lanes.load(bending.row_lanes, 0, 1) * series_of_rows[series + term]
    return value


@inline
def less_opening(lanes, block, kind, value, bending, ahead):
    """Take the opening, or its speed, at a block of pockets off the approach, or its rate.

    ``ahead``: small angle by which rollers are ahead of the places of the series, to first order, or ``None``
    [rad].
    """
    if bending is None:
        return value
    series = bending.basis.shape[1]
    waves, first = series // 2, kind * series
    even, odd = value - lanes.load(bending.shown, 0, first), lanes.constant(0.0)
    for n in range(1, waves + 1):
        cosine, sine = _wave_at(lanes, block, n, waves, bending.basis, ahead)
        even = even - lanes.load(bending.shown, 0, first + n) * cosine
        odd = odd - lanes.load(bending.shown, 0, first + waves + n) * sine
    return even + odd


@inline
def _wave_at(lanes, block, n, waves, basis, ahead):
    cosine, sine = lanes.load(basis, block, n), lanes.load(basis, block, waves + n)
    if ahead is None:
        return cosine, sine
    angle = n * ahead
    return cosine - angle * sine, sine + angle * cosine


@inline
def clear_reaction(lanes, sums, bending):
    """Start the sums of the forces on the openings."""
    if bending is None:
        return
    for k in range(bending.basis.shape[1]):
        lanes.store(sums, 0, SUM_FIELDS + k, lanes.constant(0.0))


@inline
def add_reaction(lanes, sums, block, load, bending, ahead):
    """Add the loads of a block of rollers, 0 where there are none, to the forces on the openings.

    ``ahead``: as of `less_opening`.
    """
    if bending is None:
        return
    _react(lanes, sums, block, load, bending.basis, ahead)


@inline
def _react(lanes, sums, block, load, basis, ahead):
    if ahead is None:
        for k in range(basis.shape[1]):
            before = lanes.load(sums, 0, SUM_FIELDS + k)
            lanes.store(sums, 0, SUM_FIELDS + k, before + load * lanes.load(basis, block, k))
        return
    waves = basis.shape[1] // 2
    lanes.store(sums, 0, SUM_FIELDS, lanes.load(sums, 0, SUM_FIELDS) + load)
    for n in range(1, waves + 1):
        cosine, sine = _wave_at(lanes, block, n, waves, basis, ahead)
        before = lanes.load(sums, 0, SUM_FIELDS + n)
        lanes.store(sums, 0, SUM_FIELDS + n, before + load * cosine)
        before = lanes.load(sums, 0, SUM_FIELDS + waves + n)
        lanes.store(sums, 0, SUM_FIELDS + waves + n, before + load * sine)


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
    waves, rows = series // 2, bending.rigid.shape[0] // series
    for row in range(rows):
        first, start, end = series * row, row * width // rows, (row + 1) * width // rows
        forces[first] = _lane_sum(sums, SUM_FIELDS, start, end)
        turn = (1.0, 0.0)
        for n in range(1, waves + 1):
            turn = turned_by(turn, direction)
            a = _lane_sum(sums, SUM_FIELDS + n, start, end)
            b = _lane_sum(sums, SUM_FIELDS + waves + n, start, end)
            forces[first + n] = a * turn[0] - b * turn[1]
            forces[first + waves + n] = a * turn[1] + b * turn[0]


@inline
def _lane_sum(sums, field, start, end):
    if end - start == 4:  # two rows in eight lanes, without a loop
        one = sums[0, 0, field, start] + sums[0, 0, field, start + 1]
        return one + (sums[0, 0, field, start + 2] + sums[0, 0, field, start + 3])
    total = 0.0
    for lane in range(start, end):
        total += sums[0, 0, field, lane]
    return total


@inline
def hold_bending(lanes, direction, bending, joint):
    """Work out what an acceleration of the approach adds to the forces on the openings, and keep it."""
    tangents = bending.tangents
    _clear_response(lanes, bending.response, joint)
    for block in range(tangents.shape[0]):
        for lane in range(tangents.shape[2]):
            if tangents[block, 0, lane] > 0.0:
                _add_spring(lanes, block, lane, direction, bending, joint)
    if joint is not None:
        hold_joint(lanes, joint)


@inline
def _clear_response(lanes, response, joint):
    if joint is not None:
        clear_springs(lanes, joint)
        return
    for block in range(response.shape[0]):
        for i in range(response.shape[1]):
            lanes.store(response, block, i, lanes.constant(0.0))


@inline
def _add_spring(lanes, block, lane, direction, bending, joint):
    """Add a roller to what is held, see the head of this file, or `joint_bending`."""
    spring = bending.lag * bending.tangents[block, 0, lane]
    openings, series = bending.rigid.shape[0], bending.basis.shape[1]
    waves, rows = series // 2, openings // series
    first = series * row_of(0, lane, bending.basis.shape[2], rows)
    here = bending.rows[GIVEN]
    for k in range(here.shape[0]):
        here[k] = 0.0
    here[first] = 1.0
    place = turned_by((bending.basis[block, 1, lane], bending.basis[block, waves + 1, lane]), direction)
    turn = place
    for n in range(1, waves + 1):
        here[first + n], here[first + waves + n] = turn
        turn = turned_by(turn, place)
    if joint is not None:
        add_joint_spring(lanes, spring, here[first : first + series], first, joint)
        return
    _respond(lanes, spring, first, bending)


@inline
def _respond(lanes, spring, first, bending):
    """Add a roller, whose waves stand in the first row, to the response."""
    openings, series = bending.rigid.shape[0], bending.basis.shape[1]
    here, yielded, added = bending.rows[GIVEN], bending.rows[APPROACH], bending.rows[EXTRA]
    give, response, vectors = bending.give, bending.response, bending.vectors
    _multiply(lanes, give, give.shape[0], first, here[first : first + series], vectors, APPROACH)
    _multiply(lanes, response, response.shape[0], 0, yielded[:openings], vectors, EXTRA)
    pivot = 1.0
    for k in range(openings):
        added[k] = here[k] - added[k]
        pivot += spring * yielded[k] * added[k]
    for column in range(openings):
        share = spring / pivot * added[column]
        for row_block in range(bending.response.shape[0]):
            before = lanes.load(bending.response, row_block, column)
            more = share * lanes.load(bending.vectors, EXTRA, row_block)
            lanes.store(bending.response, row_block, column, before + more)


@inline
def kick_modes(lanes, flex, more, box, signal, step, bending, joint):
    """Accelerate the modes, and return the wrench on the cup that the held stiffness adds, 5 numbers.

    ``more`` (5 numbers): acceleration of the cone against the cup without it; ``signal``: written behind
    `SIGNAL_CHANNELS`: acceleration of the sensors' seats, of the instant itself.
    """
    if joint is not None:
        _multiply(lanes, bending.pushes, bending.pushes.shape[0], 0, bending.forces, bending.pushed, 0)
        return kick_joint(
            lanes, flex[SPEED], bending.pushed_row, bending.draw, bending.inverse, more, step, joint
        )
    return _kick_series(lanes, flex, more, box, signal, step, bending)


@inline
def _kick_series(lanes, flex, more, box, signal, step, bending):
    forces, draw, rigid, vectors = bending.forces, bending.draw, bending.rigid, bending.vectors
    given, approach, extra = bending.rows[GIVEN], bending.rows[APPROACH], bending.rows[EXTRA]
    shapes, pushes, pushed = bending.shapes, bending.pushes, bending.pushed_row
    openings, series, modes = rigid.shape[0], bending.basis.shape[1], draw.shape[0]
    for i in range(forces.shape[0] - openings):
        forces[openings + i] = box[SUSPENSION + i]
    _multiply(lanes, pushes, pushes.shape[0], 0, forces, bending.pushed, 0)
    for m in range(modes):
        pushed[m] = pushed[m] * bending.inverse[m] - draw[m]
        flex[SPEED, m] += step * pushed[m]
    _multiply(lanes, shapes, shapes.shape[0], 0, pushed[:modes], vectors, GIVEN)
    for k in range(openings):
        approach[k] = -given[k]
    for first in range(0, openings, series):
        upright, sideways = first + 1, first + 1 + series // 2
        approach[first] += rigid[first, 1] * more[1]
        approach[upright] += rigid[upright, 2] * more[2] + rigid[upright, 3] * more[3]
        approach[sideways] += rigid[sideways, 0] * more[0] + rigid[sideways, 4] * more[4]
    _multiply(lanes, bending.response, bending.response.shape[0], 0, approach[:openings], vectors, EXTRA)
    _multiply(lanes, pushes, pushes.shape[0], 0, extra[:openings], bending.pushed, 0)
    for m in range(modes):
        flex[SPEED, m] += step * (pushed[m] * bending.inverse[m])
    _shake_sensors(lanes, given, extra[:openings], signal, bending, bending.sensor_give)
    x, y, z, about_x, about_z = 0.0, 0.0, 0.0, 0.0, 0.0
    for first in range(0, openings, series):
        upright, sideways = first + 1, first + 1 + series // 2
        y += rigid[first, 1] * extra[first]
        z += rigid[upright, 2] * extra[upright]
        about_x += rigid[upright, 3] * extra[upright]
        x += rigid[sideways, 0] * extra[sideways]
        about_z += rigid[sideways, 4] * extra[sideways]
    return x, y, z, about_x, about_z


@inline
def _shake_sensors(lanes, given, extra, signal, bending, sensor_give):
    """Write the seats' acceleration; of what is held the part that `add_response` shows too."""
    if sensor_give is None:
        return
    first, held = bending.forces.shape[0], bending.rows[HELD]
    _multiply(lanes, sensor_give, sensor_give.shape[0], 0, extra, bending.vectors, HELD)
    for i in range(signal.shape[0] - SIGNAL_CHANNELS):
        signal[SIGNAL_CHANNELS + i] = given[first + i] + held[i]
