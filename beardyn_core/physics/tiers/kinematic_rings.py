"""Rings of the fast tiers on the springs of all rollers: what makes a long step as good as a short one."""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.contact_output import store_vector
from beardyn_core.physics.bodies.rigid_bodies import body_vector, row_totals
from beardyn_core.physics.journal import hold_axle
from beardyn_core.physics.tiers.kinematic_bending import hold_bending, kick_modes

# Sums of the tangent stiffness over the rollers, times cosine and sine of the pocket angle.
STIFF_SUM, STIFF_COSINE, STIFF_SINE, STIFF_CC, STIFF_SS, STIFF_CS = range(
    layout.REACTION + 8, layout.REACTION + 14
)
STIFFNESS, RESPONSE, WORK, SLIDING = 0, 1, 2, 3  # matrices in the work space


@inline
def add_stiffness(stiff, tangent, cosine, sine):
    """Add a block of rollers to the sums of the tangent stiffness.

    ``stiff`` (6 numbers): sums so far; zeros at first; ``tangent``: of the rollers along the cup's normal, 0
    for those that carry nothing [N/m]; ``cosine``, ``sine``: of the pocket angle.
    """
    with_c, with_s = tangent * cosine, tangent * sine
    return (
        stiff[0] + tangent,
        stiff[1] + with_c,
        stiff[2] + with_s,
        stiff[3] + with_c * cosine,
        stiff[4] + with_s * sine,
        stiff[5] + with_c * sine,
    )


@inline
def store_stiffness(lanes, sums, stiff):
    """Keep the sums of `add_stiffness`."""
    store_vector(lanes, sums, 0, STIFF_SUM, stiff)
    store_vector(lanes, sums, 0, STIFF_CC, stiff[3:])


@inline
def spring_matrix(sums, direction, work, p):
    """Work out the tangent stiffness of all rollers against displacement and tilt of the cone, world axes.

    ``sums`` [1, 1, SUM_FIELDS, lane]: with what `store_stiffness` has stored; ``work`` [4, 5, 5]
    gets the matrix of x, y, z, tilt about x and about z at ``STIFFNESS``.
    """
    plain, with_c = row_totals(sums, STIFF_SUM), row_totals(sums, STIFF_COSINE)
    with_s = row_totals(sums, STIFF_SINE)
    cc, ss, cs = row_totals(sums, STIFF_CC), row_totals(sums, STIFF_SS), row_totals(sums, STIFF_CS)
    along = (p.base.cup.cosine, p.base.cup.sine, p.response.lever)
    sum_matrix(work, STIFFNESS, (plain, with_c, with_s, cc, ss, cs), along, direction, p.sides)


@inline
def sum_matrix(work, page, totals, along, direction, sides):
    """Put the products of a direction of every roller together, weighted by what has been summed by rows.

    ``along`` (3 numbers): cosine and sine of the direction's angle from the radius, towards the inside, and
    its arm about the bearing centre.
    """
    for i in range(5):
        for j in range(5):
            work[page, i, j] = 0.0
    plain, with_c, with_s, cc, ss, cs = totals
    cosine, sine, lever = along
    for row in range(2):
        side = sides[0, 0, row * (sides.shape[2] - 1)]
        arm = side * lever
        # approach of a roller: first times cosine, second times sine of its pocket angle, and third
        first = (cosine * direction[1], 0.0, cosine * direction[0], arm * direction[0], -arm * direction[1])
        second = (first[2], 0.0, -first[0], first[4], -first[3])
        third = (0.0, -side * sine, 0.0, 0.0, 0.0)
        for i in range(5):
            on_first = cc[row] * first[i] + cs[row] * second[i] + with_c[row] * third[i]
            on_second = cs[row] * first[i] + ss[row] * second[i] + with_s[row] * third[i]
            on_third = with_c[row] * first[i] + with_s[row] * second[i] + plain[row] * third[i]
            for j in range(5):
                work[page, i, j] += on_first * first[j] + on_second * second[j] + on_third * third[j]


@inline
def hold_response(sums, direction, work, p):
    """Work out what a relative acceleration of the rings adds to the rollers' wrench, and keep it until due.

    With the tangent stiffness K, the damping C = tau K and the step h, the explicit step becomes
    ``(M + h C/2 + h^2 K/12) a = F``. The second term takes the dampers' forces with the velocity of the
    forces' own instant, of which only that of half a step before is known. The third one makes the second
    difference over ``h^2`` of an oscillation what it is to fourth order: a mode turning by w h a step is at
    ``1 + (w h)^4/480`` of its frequency instead of ``1 + (w h)^2/24``. K enters as a correction of a few
    percent of the masses, so a K that lags by a trend sample and takes every roller for a 10/9 law is
    enough: at w h = 0.64 and 1.3 the frequency is 0.2 % and 1 % off (1.7 % and 6.9 % without).

    With the relative acceleration by a unit wrench D and ``B = (h C/2 + h^2 K/12)`` the wrench that is to be
    added is ``(1 + B D)^-1 B`` times the relative acceleration without it.

    References
    ----------
    Hairer, Norsett, Wanner (1993), Solving Ordinary Differential Equations I, III.10: Cowell's (Numerov's)
    method, of which this is a linearly implicit form.
    """
    spring_matrix(sums, direction, work, p)
    lag, give = p.response.lag, p.response.give
    for i in range(5):
        for j in range(5):
            work[RESPONSE, i, j] = lag * work[STIFFNESS, i, j]
    for i in range(5):
        for j in range(5):
            total = 0.0
            for k in range(5):
                total += work[RESPONSE, i, k] * give[k, j]
            work[WORK, i, j] = total
        work[WORK, i, i] += 1.0
    # elimination without pivots: the matrix has the eigenvalues of a symmetric one, none below 1
    for column in range(5):
        for i in range(column + 1, 5):
            share = work[WORK, i, column] / work[WORK, column, column]
            for j in range(column, 5):
                work[WORK, i, j] -= share * work[WORK, column, j]
            for j in range(5):
                work[RESPONSE, i, j] -= share * work[RESPONSE, column, j]
    for back in range(5):
        i = 4 - back
        for j in range(5):
            total = work[RESPONSE, i, j]
            for k in range(i + 1, 5):
                total -= work[WORK, i, k] * work[RESPONSE, k, j]
            work[RESPONSE, i, j] = total / work[WORK, i, i]


@inline
def hold_stiffness(lanes, sums, direction, work, p, bending):
    """Work out and keep the response of rigid rings, `hold_response`, or of all modes, `hold_bending`."""
    if bending is None:
        hold_response(sums, direction, work, p)
        return
    hold_bending(lanes, direction, bending, bending.joint)


@inline
def journal_velocity(bodies):
    """Take the velocity and tilt rate of the journal, 5 floats."""
    x, y, z = body_vector(bodies, layout.CONE_BODY, layout.LINEAR)
    return x, y, z, bodies[layout.CONE_BODY, layout.ANGULAR], bodies[layout.CONE_BODY, layout.ANGULAR + 2]


@inline
def add_response(lanes, bodies, flex, axle, before, signal, box, work, p):
    """Add the wrench of `hold_response` to a step that has been taken without it, and move the modes.

    Cup and cone get opposite wrenches. The channels get the dampers' part only: what they give is force and
    acceleration of the instant itself.

    ``before`` (5 numbers): `journal_velocity` before the step; ``signal`` [SIGNAL_CHANNELS]: changed: force
    and acceleration; ``flex``, ``box``: see `kick_modes`; ``axle``: modes of the axle.
    """
    motion, response = p.motion, p.response
    after = journal_velocity(bodies)
    x = (after[0] - before[0]) * motion.rate - signal[layout.SIGNAL_ACCELERATION]
    y = (after[1] - before[1]) * motion.rate - signal[layout.SIGNAL_ACCELERATION + 1]
    z = (after[2] - before[2]) * motion.rate - signal[layout.SIGNAL_ACCELERATION + 2]
    about_x = (after[3] - before[3]) * motion.rate - signal[layout.SIGNAL_ACCELERATION + 3]
    about_z = (after[4] - before[4]) * motion.rate - signal[layout.SIGNAL_ACCELERATION + 5]
    more = (x, y, z, about_x, about_z)
    force_x, force_y, force_z, moment_x, moment_z = _held_wrench(
        lanes, flex, more, signal, box, work, p, p.bending
    )
    wrench = (force_x, force_y, force_z, moment_x, 0.0, moment_z)
    push, turn = p.step * motion.journal_push, p.step * motion.journal_turn
    bodies[layout.CONE_BODY, layout.LINEAR] = after[0] - push * wrench[0]
    bodies[layout.CONE_BODY, layout.LINEAR + 1] = after[1] - push * wrench[1]
    bodies[layout.CONE_BODY, layout.LINEAR + 2] = after[2] - push * wrench[2]
    bodies[layout.CONE_BODY, layout.ANGULAR] = after[3] - turn * wrench[3]
    bodies[layout.CONE_BODY, layout.ANGULAR + 2] = after[4] - turn * wrench[5]
    on_cone = (-force_x, -force_y, -force_z, -moment_x, 0.0, -moment_z)
    hold_axle(bodies, axle, on_cone, p.step, p.base.mounting.journal)
    share = _damper_share(response, p.bending)
    for i in range(6):
        signal[layout.SIGNAL_FORCE + i] += share * wrench[i]
    _push_box(bodies, wrench, signal, share, p, p.base.mounting.coupling)


@inline
def _held_wrench(lanes, flex, more, signal, box, work, p, bending):
    if bending is None:
        return (
            row_times(work, RESPONSE, 0, more),
            row_times(work, RESPONSE, 1, more),
            row_times(work, RESPONSE, 2, more),
            row_times(work, RESPONSE, 3, more),
            row_times(work, RESPONSE, 4, more),
        )
    return kick_modes(lanes, flex, more, box, signal, p.step, bending, bending.joint)


@inline
def _damper_share(response, bending):
    if bending is None:
        return response.damper_share
    return bending.damper_share


@inline
def row_times(work, page, i, more):
    """Multiply a row of a matrix of the work space with 5 numbers."""
    x, y, z, about_x, about_z = more
    linear = work[page, i, 0] * x + work[page, i, 1] * y + work[page, i, 2] * z
    return linear + (work[page, i, 3] * about_x + work[page, i, 4] * about_z)


@inline
def _push_box(bodies, wrench, signal, share, p, coupling):
    for i in range(3):
        linear = _box_acceleration(wrench, i, p, coupling)
        angular = _box_acceleration(wrench, 3 + i, p, coupling)
        bodies[layout.CUP_BODY, layout.LINEAR + i] += p.step * linear
        bodies[layout.CUP_BODY, layout.ANGULAR + i] += p.step * angular
        signal[layout.SIGNAL_ACCELERATION + i] += share * linear
        signal[layout.SIGNAL_ACCELERATION + 3 + i] += share * angular


@inline
def _box_acceleration(wrench, i, p, coupling):
    if coupling is None:
        return p.motion.box_push[i] * wrench[i]
    total = 0.0
    for j in range(6):
        total += coupling.inverse_mass[i, j] * wrench[j]
    return p.base.mounting.cup_moves * total
