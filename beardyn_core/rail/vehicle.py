"""An axlebox share of a vehicle on its track, vertical, through a wheel-rail contact that can open."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.base.low_pass import first_order
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.rail.track import RailWaves, rail_waves
from beardyn_core.rail.wheelset import Modes, bending_modes
from beardyn_core.scene.mounting import Mounting, ProgressiveSuspension
from beardyn_core.scene.operation import QuarterVehicleOperation

# members of the row of numbers the kernel takes
SOFT, STIFF, MEET, AT_REST, STATIC, FRICTION, CREEP, LINEAR, VISCOUS = range(9)


def law(suspension: ProgressiveSuspension | None, mounting: Mounting, static: float) -> Float:
    """Gather in one row the numbers that `excess_force` needs, with the load on the suspension at rest [N].

    The row is empty without a suspension: the law of the mounting is linear, without excess.
    """
    if suspension is None:
        return np.zeros(0)
    return np.array(
        [
            suspension.soft_stiffness,
            suspension.stiff_stiffness,
            suspension.meeting_load / suspension.soft_stiffness,
            suspension.compression(static),
            static,
            suspension.friction_ratio,
            suspension.friction_speed,
            mounting.stiffness[2],
            mounting.damping[2],
        ]
    )


@inline
def excess_force(row: Any, squeeze: Any, squeeze_speed: Any) -> Any:
    """Compute the suspension's force beyond its static load and beyond the mounting's linear law, [N].

    From the row of `law` and the compression beyond that at rest, [m], with its speed, [m/s]. The springs do
    not pull. Friction is proportional to their load, with the hyperbolic tangent of the speed: it creeps
    where dry friction would stick. Its own elasticity (of a Lenoir link) is neglected.
    """
    compression = row[AT_REST] + squeeze
    load = row[SOFT] * compression + (row[STIFF] - row[SOFT]) * max(compression - row[MEET], 0.0)
    load = max(load, 0.0)
    load += row[FRICTION] * load * np.tanh(squeeze_speed / row[CREEP])
    return load - row[STATIC] - row[LINEAR] * squeeze - row[VISCOUS] * squeeze_speed


def equivalent_displacement(force: Float, mounting: Mounting, axis: int, step: float) -> Float:
    """Compute the motion of the bogie end of a linear suspension that gives an additional force.

    The twin holds its axlebox by the linear law of the mounting. With the bogie moved by this as well
    the box feels what the rail model's suspension does beyond that law: the solution [m] of
    damping x speed + stiffness x displacement = force, for the force [N] on the axlebox along an axis, 0 to 2
    for x, y, z, at steps [s].
    """
    stiffness, damping = mounting.stiffness[axis], mounting.damping[axis]
    if stiffness == 0.0 or not force.any():
        return np.zeros_like(force)
    return first_order(force / stiffness, damping / stiffness / step)


GRAVITY = STANDARD_GRAVITY
BODY, BOGIE, WHEEL, BOX = range(4)

# of a 130 mm axlebox bearing, radial, under 5 to 80 kN: 4.8 to 6.4 GN/m; share of critical damping
_BEARING_STIFFNESS = 5.0e9
_BEARING_DAMPING_RATIO = 0.03
# the same against tilt, at an end play of 0.1 mm under 50 to 100 kN: 1.3e6 to 2.9e6 N m/rad
_BEARING_TILT_STIFFNESS = 2.0e6

# flexibility of the Hertz contact, G = factor R^exponent [m / N^(2/3)], R in m (Zhai, Vehicle-track
# coupled dynamics)
_CONTACT_FIT = {"worn": (3.86e-8, -0.115), "cone": (4.57e-8, -0.149)}


@dataclass(frozen=True)
class QuarterVehicle:
    """Body and bogie share, half wheelset, axlebox and the rail: displacements from static.

    Where the wheelset bends, `WHEEL` is its motion as a rigid body.
    """

    mass: A[
        Float,
        "shape [4 + mode], `BODY`, `BOGIE`, `WHEEL`, `BOX`, bending modes, tilt of the box, [kg], [kg m^2]",
    ]
    stiffness: A[Float, "shape [4 + mode, 4 + mode], without the wheel-rail contact, [N/m]"]
    damping: A[Float, "shape [4 + mode, 4 + mode], the same, [N s/m]"]
    bending: A[Modes | None, "of the wheelset, both wheels alike; ``None``: rigid"]
    rail: A[RailWaves, "track under the wheel"]
    primary: A[Float, "shape [9] or [0], row of `law`; empty while the primary suspension is linear"]
    static_force: A[float, "wheel-rail force at rest, [N]"]
    journal_weight: A[float, "weight of the half wheelset, [N]"]
    contact_flexibility: A[float, "G in P = (compression / G)^1.5, [m/N^(2/3)]"]


@dataclass(frozen=True)
class Ride:
    """Response of the quarter vehicle on a uniform time grid."""

    contact_force: A[Float, "shape [step], wheel-rail force, upwards on the wheel, never negative, [N]"]
    bogie: A[Float, "shape [step], displacement of the bogie from its static place, upwards, [m]"]
    wheel: A[Float, "shape [step], displacement of the wheel from its static place, upwards, [m]"]
    journal: A[Float, "shape [step], the same of the journal at the bearing's centre, [m]"]
    box: A[Float, "shape [step], the same of the axlebox, [m]"]
    excess: A[
        Float,
        "shape [step], upward force of the primary suspension on the bogie beyond its static load and the "
        "linear law of the mounting, [N]",
    ]
    flexing: A[
        Float,
        "shape [step], upward force that lets a rigid half wheelset move its journal as the bending one "
        "does, [N]",
    ]
    tilt: A[Float, "shape [step], of the journal by bending, the end upwards, [rad]"]


def quarter_vehicle(
    operation: QuarterVehicleOperation, mounting: Mounting, bearing: RollerBearing | None = None
) -> QuarterVehicle:
    """Build one axlebox's share: an eighth of the body, a quarter of a bogie, half a wheelset, one rail.

    The mounting gives wheelset, axlebox and, unless the vehicle has a progressive one, the primary
    suspension; the bearing is a spring here. A wheelset that bends adds the coordinates of its free modes.
    Where it is coupled, masses and modes are those of the twin with its bearing, and the box tilts with the
    journal: the wheel moves as in the twin, whose first bending the wheel-rail force must not excite.
    """
    vehicle = operation.vehicle
    journal, box = mounting.journal_mass, mounting.box_mass
    if not operation.bends_in_the_twin:
        bearing = None
    if bearing is not None:
        journal, box = journal + bearing.cone_mass, box + bearing.cup_mass
    mass = np.array([operation.body_mass / 8.0, vehicle.bogie_mass / 4.0, journal, box])
    rattling = 2.0 * np.sqrt(_BEARING_STIFFNESS * journal * box / (journal + box))
    # one side of a bogie has two axleboxes
    rollers = _BEARING_STIFFNESS, _BEARING_DAMPING_RATIO * rattling
    links = (
        (BODY, BOGIE, 0.5 * vehicle.secondary_stiffness, 0.5 * vehicle.secondary_damping),
        (BOGIE, BOX, mounting.stiffness[2], mounting.damping[2]),
        (BOX, WHEEL, *rollers),
    )
    stiffness = link_masses((upper, lower, spring) for upper, lower, spring, _ in links)
    damping = link_masses((upper, lower, damper) for upper, lower, _, damper in links)
    static_force = float(mass.sum()) * GRAVITY
    modes = bending_modes(operation, mounting, bearing)
    if modes is not None:
        mass = np.concatenate([mass, np.full(len(modes), modes.mass)])
        stiffness = _bent(stiffness, modes, modes.stiffness, rollers[0])
        damping = _bent(damping, modes, modes.damping, rollers[1])
        if bearing is not None:
            mass = np.append(mass, mounting.box_inertia[0] + bearing.cup_inertia[0])
            tilting = _BEARING_TILT_STIFFNESS / rollers[0]
            stiffness = _add_tilt(stiffness, modes, tilting * rollers[0], mounting.rotational_stiffness[0])
            damping = _add_tilt(damping, modes, tilting * rollers[1], mounting.rotational_damping[0])
    factor, exponent = _CONTACT_FIT[vehicle.wheel_profile]
    return QuarterVehicle(
        mass=mass,
        stiffness=stiffness,
        damping=damping,
        bending=modes,
        rail=rail_waves(operation.track),
        primary=law(vehicle.primary_suspension, mounting, float(mass[[BODY, BOGIE]].sum()) * GRAVITY),
        static_force=static_force,
        journal_weight=journal * GRAVITY,
        contact_flexibility=factor * (0.5 * operation.wheel_diameter) ** exponent,
    )


def _bent(matrix: Float, modes: Modes, own: Float, bearing: float) -> Float:
    """Add the modes of the wheelset to a matrix: their own terms, and the bearing that they stretch."""
    whole = np.zeros((4 + len(modes),) * 2)
    whole[:4, :4] = matrix
    whole[4:, 4:] = np.diag(own) + bearing * np.outer(modes.journal, modes.journal)
    for body, side in ((WHEEL, 1.0), (BOX, -1.0)):
        whole[body, 4:] = whole[4:, body] = side * bearing * modes.journal
    return whole


def _add_tilt(matrix: Float, modes: Modes, bearing: float, held: float) -> Float:
    """Add the tilt of a box that its springs hold and that the journal tilts through the bearing."""
    whole = np.pad(matrix, (0, 1))
    pull = np.concatenate([np.zeros(4), modes.journal_slope, [-1.0]])
    whole += bearing * np.outer(pull, pull)
    whole[-1, -1] += held
    return whole


def link_masses(links: Iterable[tuple[int, int, float]]) -> Float:
    """Build the matrix of four masses from links (upper, lower, stiffness or damping) between them."""
    matrix = np.zeros((4, 4))
    for upper, lower, link in links:
        pull = np.zeros(4)
        pull[upper], pull[lower] = 1.0, -1.0
        matrix += link * np.outer(pull, pull)
    return matrix


def ride(vehicle: QuarterVehicle, height: Float, step: float, push: Float | None = None) -> Ride:
    """Run over a profile, from static equilibrium.

    The linear part moves exactly over a step (matrix exponential); the contact force and what the
    suspension has beyond its linear law act as impulses between steps: second order, symplectic for the
    contact, stable while the contact resonance (about 1 kHz against the rail) takes more than pi steps.

    Parameters
    ----------
    height : float64 array, shape [step]
        Profile under the wheel at each step, upwards, [m]; should begin at 0.
    step : float
        [s].
    push : float64 array, shape [step, 4], or None
        Further upward forces on body, bogie, wheel and axlebox, [N].

    References
    ----------
    Hertz wheel-rail contact P = (compression / G)^1.5 with loss of contact: Zhai (2020),
    Vehicle-Track Coupled Dynamics, chapter 2. Impulse method: Hairer, Lubich, Wanner (2006),
    Geometric Numerical Integration, section VIII.4.
    """
    count = len(vehicle.mass)
    rates = np.zeros((2 * count, 2 * count))
    rates[:count, count:] = np.eye(count)
    rates[count:, :count] = -vehicle.stiffness / vehicle.mass[:, None]
    rates[count:, count:] = -vehicle.damping / vehicle.mass[:, None]
    from scipy.linalg import expm  # takes a while, and only a ride needs it

    rail = vehicle.rail
    # the shortest waves, exact for a force that is linear within a step: what stays of what was, and
    # what the forces at its beginning and end add
    keep = float(np.exp(-step / rail.residual_time))
    mean = rail.residual_time / step * (1.0 - keep)
    residue = np.array(
        [keep, rail.residual_flexibility * (mean - keep), rail.residual_flexibility * (1.0 - mean)]
    )
    modes = vehicle.bending
    shapes = (
        np.zeros((3, 0)) if modes is None else np.stack([modes.wheel, modes.journal, modes.journal_slope])
    )
    shapes = np.pad(
        shapes, ((0, 0), (0, count - 4 - shapes.shape[1]))
    )  # a box that tilts moves none of these
    contact_force, bogie, wheel, box, excess, bent = _run(
        expm(rates * step),
        # waves side by side: the compiler moves several at once
        np.ascontiguousarray(np.moveaxis(expm(rail.rates() * step), 0, -1)),
        np.ascontiguousarray(height, dtype=np.float64),
        np.zeros((1, 4)) if push is None else np.ascontiguousarray(push, dtype=np.float64),
        float(step),
        1.0 / vehicle.mass,
        shapes,
        rail.inverse_mass,
        residue,
        vehicle.primary,
        float(vehicle.static_force),
        float(vehicle.contact_flexibility),
    )
    if modes is None:
        none = np.zeros(len(wheel))
        return Ride(contact_force, bogie, wheel, wheel, box, excess, none, none)
    # between impulses the motion is exact: second differences are the mean acceleration of two steps
    flexing = np.zeros(len(wheel))
    flexing[1:-1] = modes.mass * np.diff(bent[:, 1], 2) / step**2
    return Ride(
        contact_force, bogie, wheel + bent[:, 0], wheel + bent[:, 1], box, excess, flexing, bent[:, 2]
    )


@inline
def _hertz_force(room, flexibility, give):
    """Compute the force of the Hertz contact in series with a spring, 0 while open, by Newton's method."""
    if room <= 0.0:
        return 0.0
    compression = room  # a NaN profile stays visible
    for _ in range(3):
        force = _hertz(compression, flexibility)
        excess_room = compression + give * force - room
        compression -= excess_room / (1.0 + 1.5 * give * force / compression)
    return _hertz(max(compression, 0.0), flexibility)


@inline
def _hertz(compression, flexibility):
    share = compression / flexibility
    return share * np.sqrt(share)


@partial(entry, allocates=True, flags=("contract",))
def _run(
    flow,
    waves,
    height,
    push,
    step,
    inverse_mass,
    shapes,
    inverse_wave,
    residue,
    primary,
    static_force,
    flexibility,
):
    count, half, modes = len(height), len(inverse_mass), shapes.shape[1]
    contact_force, beyond = np.empty(count), np.zeros(count)
    bogie, wheel, box = np.empty(count), np.empty(count), np.empty(count)
    bent = np.empty((count if modes > 0 else 0, 3))
    state, moved = np.zeros(2 * half), np.zeros(2 * half)
    rail, rail_moved = np.zeros((6, waves.shape[2])), np.zeros((6, waves.shape[2]))
    shortest = contact = 0.0
    static_compression = flexibility * static_force ** (2.0 / 3.0)
    for n in range(count):
        shortest = residue[0] * shortest - residue[1] * contact
        room = static_compression + height[n] + shortest - state[WHEEL] + residue[2] * static_force
        for wave in range(waves.shape[2]):
            room += rail[0, wave]
        if modes > 0:
            for part in range(3):
                bent[n, part] = 0.0
                for mode in range(modes):
                    bent[n, part] += shapes[part, mode] * state[4 + mode]
            room -= bent[n, 0]
        force = _hertz_force(room, flexibility, residue[2])
        contact = force - static_force
        shortest -= residue[2] * contact
        if len(primary) > 0:
            beyond[n] = excess_force(
                primary, state[BOX] - state[BOGIE], state[half + BOX] - state[half + BOGIE]
            )
        contact_force[n], bogie[n], wheel[n], box[n] = force, state[BOGIE], state[WHEEL], state[BOX]
        last = min(n, len(push) - 1)
        state[half + BODY] += step * inverse_mass[BODY] * push[last, BODY]
        state[half + BOGIE] += step * inverse_mass[BOGIE] * (push[last, BOGIE] + beyond[n])
        state[half + WHEEL] += step * inverse_mass[WHEEL] * (push[last, WHEEL] + contact)
        state[half + BOX] += step * inverse_mass[BOX] * (push[last, BOX] - beyond[n])
        for mode in range(modes):
            state[half + 4 + mode] += step * inverse_mass[4 + mode] * shapes[0, mode] * contact
        for i in range(2 * half):
            total = 0.0
            for j in range(2 * half):
                total += flow[i, j] * state[j]
            moved[i] = total
        state, moved = moved, state
        for wave in range(waves.shape[2]):
            rail[3, wave] -= step * inverse_wave[wave] * contact
        for i in range(6):
            for wave in range(waves.shape[2]):
                rail_moved[i, wave] = (
                    waves[i, 0, wave] * rail[0, wave]
                    + waves[i, 1, wave] * rail[1, wave]
                    + waves[i, 2, wave] * rail[2, wave]
                    + waves[i, 3, wave] * rail[3, wave]
                    + waves[i, 4, wave] * rail[4, wave]
                    + waves[i, 5, wave] * rail[5, wave]
                )
        rail, rail_moved = rail_moved, rail
    return contact_force, bogie, wheel, box, beyond, bent
