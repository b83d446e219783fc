"""Bending of the axle with the wheelset, as far as it moves the cone.

The modes are free ones of half a wheelset whose other half mirrors it, of unit modal mass; ``axle``
[2, plane, mode] holds their places [m sqrt(kg)] and speeds in two planes, upright and along the track, in
which a round axle has the same modes. They move and tilt the cone; the rollers push them there, the load
pushes them at the wheel. What stands in ``bodies`` is the cone itself: the half wheelset as a rigid body and
what bending adds. The modes are orthogonal to rigid motion, so the rigid body moves as it does without them.

Places are measured from those at the first load, as the springs of the suspension are.

Neglects the turning of the wheelset, which couples both planes, and bending by a moment of the load.
"""

from __future__ import annotations

from beardyn_core.base.jit import inline
from beardyn_core.kernels.bodies import X, Z, kick_cone
from beardyn_core.model import layout

PLACE, SPEED = 0, 1
UPRIGHT, ALONG = 0, 1


@inline
def _move_cone(bodies, field, plane, place, slope):
    """Add to what stands of the cone from ``field`` on: along the axes, then about them."""
    if plane == UPRIGHT:
        bodies[layout.CONE_BODY, field + Z] += place
        bodies[layout.CONE_BODY, field + 3 + X] += slope
    else:
        bodies[layout.CONE_BODY, field + X] += place
        bodies[layout.CONE_BODY, field + 3 + Z] -= slope


@inline
def add_bending(bodies, axle, share, journal):
    """Add a share of the speeds of bending to those of the cone; with -1 the rigid half wheelset stays."""
    if journal is None:
        return
    for plane in range(2):
        place, slope = 0.0, 0.0
        for m in range(journal.place.shape[0]):
            place += journal.place[m] * axle[SPEED, plane, m]
            slope += journal.slope[m] * axle[SPEED, plane, m]
        _move_cone(bodies, layout.LINEAR, plane, share * place, share * slope)


@inline
def _bend_plane(bodies, axle, plane, push, moment, load, energy, step, journal):
    stored, place, slope = 0.0, 0.0, 0.0
    for m in range(journal.place.shape[0]):
        speed, rest = axle[SPEED, plane, m], journal.rest[plane, m]
        axle[PLACE, plane, m] += step * speed
        here = axle[PLACE, plane, m]
        spring, damper, driven = journal.stiffness[m] * here, journal.damping[m], journal.wheel[m] * load
        force = journal.place[m] * push + journal.slope[m] * moment + driven - rest
        change = step * (force - spring - damper * speed) / journal.inertia[m]
        middle = speed + 0.5 * change
        energy[layout.ENERGY_EXTERNAL] += step * driven * middle
        energy[layout.ENERGY_LOST + layout.LOSS_SUSPENSION] += step * damper * middle * middle
        stored += (0.5 * spring + rest) * here
        axle[SPEED, plane, m] = speed + change
        place += journal.place[m] * change
        slope += journal.slope[m] * change
    _move_cone(bodies, layout.LINEAR, plane, place, slope)
    _move_cone(bodies, layout.CHANGE, plane, place, slope)
    return stored


@inline
def bend_axle(bodies, axle, wrench, load, energy, step, journal):
    """Move the modes along their speeds, accelerate them, and the cone with them; gives their energy, [J].

    The motion of a free damped oscillator is exact, see `model.structure.exact_oscillators`. ``wrench`` (6):
    on the cone [N, N m]; ``load`` [10]: load row; ``journal``: a `JournalParams`.
    """
    if journal is None:
        return 0.0
    stored = _bend_plane(bodies, axle, UPRIGHT, wrench[2], wrench[3], load[2], energy, step, journal)
    return stored + _bend_plane(bodies, axle, ALONG, wrench[0], -wrench[5], load[0], energy, step, journal)


@inline
def hold_axle(bodies, axle, wrench, step, journal):
    """Accelerate modes and cone by a further wrench in a step that `bend_axle` has taken."""
    if journal is None:
        return
    for plane in range(2):
        push = wrench[2] if plane == UPRIGHT else wrench[0]
        moment = wrench[3] if plane == UPRIGHT else -wrench[5]
        place, slope = 0.0, 0.0
        for m in range(journal.place.shape[0]):
            force = journal.place[m] * push + journal.slope[m] * moment
            change = step * force / journal.inertia[m]
            axle[SPEED, plane, m] += change
            place += journal.place[m] * change
            slope += journal.slope[m] * change
        _move_cone(bodies, layout.LINEAR, plane, place, slope)


@inline
def kick_journal(bodies, axle, wrench, load, energy, step, mounting, journal):
    """Accelerate the journal; arguments and result as `kick_cone`, which takes the half wheelset as rigid."""
    if journal is None:
        return kick_cone(bodies, wrench, load, energy, step, mounting)
    for i in range(3):
        bodies[layout.CONE_BODY, layout.CHANGE + 3 + i] = 0.0  # a locked tilt leaves them alone
    add_bending(bodies, axle, -1.0, journal)
    torque, stored = kick_cone(bodies, wrench, load, energy, step, mounting)
    add_bending(bodies, axle, 1.0, journal)
    return torque, stored + bend_axle(bodies, axle, wrench, load, energy, step, journal)


@inline
def axle_energy(axle, journal):
    """Sum the kinetic energy of the modes, [J]."""
    if journal is None:
        return 0.0
    total = 0.0
    for plane in range(2):
        for m in range(journal.mass.shape[0]):
            total += 0.5 * journal.mass[m] * axle[SPEED, plane, m] ** 2
    return total
