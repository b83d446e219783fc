"""Bending of the axle at the journal: modes of half a wheelset, and their motion.

The modes are free ones of half a wheelset whose other half mirrors it, of unit modal mass; ``axle``
[2, plane, mode] holds their places [m sqrt(kg)] and speeds in two planes, upright and along the track, in
which a round axle has the same modes. They move and tilt the cone; the rollers push them there, the load
pushes them at the wheel. What stands in ``bodies`` is the cone itself: the half wheelset as a rigid body and
what bending adds. The modes are orthogonal to rigid motion, so the rigid body moves as it does without them.

Places are measured from those at the first load, as the springs of the suspension are.

Neglects the turning of the wheelset, which couples both planes, and bending by a moment of the load.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import inline
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.bodies import layout
from beardyn_core.physics.bodies.rigid_bodies import X, Z, kick_cone
from beardyn_core.physics.oscillators import exact_oscillators
from beardyn_core.rail.wheelset import Modes, bending_modes
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene


class JournalParams(NamedTuple):
    """Modes of unit modal mass, the same upright and along the track; see `physics.journal`."""

    place: Any  # [mode], displacement of the bearing's centre [1/sqrt(kg)]
    slope: Any  # [mode], tilt of the journal there, its end outwards [1/(m sqrt(kg))]
    wheel: Any  # [mode], displacement of the wheel, where the load acts [1/sqrt(kg)]
    stiffness: Any  # [mode], square of the rate [1/s^2]
    damping: Any  # [mode], [1/s]
    inertia: Any  # [mode], of the step, with the damper's half step [-]
    mass: Any  # [mode], inertia without the damper [-]
    rest: Any  # [plane, mode], force on each mode at rest [N/sqrt(kg)]


def modes_of(scene: Scene) -> Modes | None:
    """Give the modes of the half wheelset of a scene; ``None`` where it is rigid in the twin."""
    operation = scene.operation
    if not isinstance(operation, QuarterVehicleOperation) or not operation.bends_in_the_twin:
        return None
    modes = _modes(operation, scene.mounting, scene.bearing)
    if modes is None or scene.mounting.side == "left":
        return modes
    return replace(modes, journal_slope=-modes.journal_slope)  # the axle goes on towards +y


@lru_cache(maxsize=8)  # a warming bearing asks again and again
def _modes(operation: QuarterVehicleOperation, mounting: Mounting, bearing: RollerBearing) -> Modes | None:
    return bending_modes(operation, mounting, bearing)


def journal_shapes(modes: Modes) -> Float:
    """Give motion and tilt of the bearing's centre in the modes, [6, mode] upright, then as many along.

    Of unit modal mass, [1/sqrt(kg)], [1/(m sqrt(kg))].
    """
    place, slope = modes.journal / np.sqrt(modes.mass), modes.journal_slope / np.sqrt(modes.mass)
    count = len(modes)
    shapes = np.zeros((6, 2 * count))
    shapes[2, :count], shapes[3, :count] = place, slope
    shapes[0, count:], shapes[5, count:] = place, -slope
    return shapes


def bending_give(scene: Scene, step: float) -> Float:
    """Work out what bending of the axle adds to the inverse mass of the journal in a step, shape [6, 6].

    Modes are as heavy as the step makes them (`exact_oscillators`), for it takes their own springs exactly,
    and only those of the rollers may be too fast for it. Zero for a rigid half wheelset.

    Parameters
    ----------
    step : float
        [s].
    """
    modes = modes_of(scene)
    if modes is None:
        return np.zeros((6, 6))
    rate = 2.0 * np.pi * modes.frequency
    inertia = exact_oscillators(rate, np.full(len(rate), modes.damping_ratio), step)[2]
    shapes = journal_shapes(modes)
    return np.asarray((shapes / np.tile(inertia, 2)) @ shapes.T)


def journal_params(scene: Scene, step: float, rest: ArrayLike) -> JournalParams | None:
    """Work out the modes for a time step [s].

    ``rest`` [6]: force and moment of the rollers on the cone at rest, which the load balances [N, N m].
    """
    modes = modes_of(scene)
    if modes is None:
        return None
    scale = 1.0 / np.sqrt(modes.mass)
    place, slope, wheel = scale * modes.journal, scale * modes.journal_slope, scale * modes.wheel
    rate = 2.0 * np.pi * modes.frequency
    mass, damping, inertia = exact_oscillators(rate, np.full(len(rate), modes.damping_ratio), step)
    force = np.asarray(rest, dtype=np.float64)
    upright = (place - wheel) * force[2] + slope * force[3]
    along = (place - wheel) * force[0] - slope * force[5]
    return JournalParams(place, slope, wheel, rate**2, damping, inertia, mass, np.stack([upright, along]))


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

    The motion of a free damped oscillator is exact, see `oscillators.exact_oscillators`. ``wrench`` (6):
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
