"""An axlebox share of a vehicle on a lumped track, through a wheel-rail contact that can open."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from beardyn_core.jit import entry
from beardyn_core.rail.track import lump
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation

Float = NDArray[np.float64]

GRAVITY = 9.80665
BODY, BOGIE, WHEEL, RAIL, SLEEPER, BALLAST = range(6)

# flexibility of the Hertz contact, G = factor R^exponent [m / N^(2/3)], R in m (Zhai, Vehicle-track
# coupled dynamics)
_CONTACT_FIT = {"worn": (3.86e-8, -0.115), "cone": (4.57e-8, -0.149)}


@dataclass(frozen=True)
class QuarterVehicle:
    """Body and bogie share, wheel with axlebox, rail, sleepers, ballast: displacements from static.

    Parameters
    ----------
    mass : float64 array, shape [6]
        In the order `BODY`, `BOGIE`, `WHEEL`, `RAIL`, `SLEEPER`, `BALLAST`, [kg].
    stiffness, damping : float64 array, shape [6, 6]
        Without the wheel-rail contact, [N/m], [N s/m].
    static_force : float
        Wheel-rail force at rest, [N].
    journal_weight : float
        Weight of the half wheelset, [N].
    contact_flexibility : float
        G in P = (compression / G)^1.5, [m/N^(2/3)].
    """

    mass: Float
    stiffness: Float
    damping: Float
    static_force: float
    journal_weight: float
    contact_flexibility: float


@dataclass(frozen=True)
class Ride:
    """Response of the quarter vehicle on a uniform time grid.

    Parameters
    ----------
    contact_force : float64 array, shape [step]
        Wheel-rail force, upwards on the wheel, never negative, [N].
    bogie : float64 array, shape [step]
        Displacement of the bogie from its static place, upwards, [m].
    wheel : float64 array, shape [step]
        Displacement of wheel, journal and axlebox from their static place, upwards, [m].
    """

    contact_force: Float
    bogie: Float
    wheel: Float


def quarter_vehicle(operation: QuarterVehicleOperation, mounting: Mounting) -> QuarterVehicle:
    """Share of one axlebox: an eighth of the body, a quarter of a bogie, half a wheelset, one rail.

    Parameters
    ----------
    operation : QuarterVehicleOperation
    mounting : Mounting
        Gives wheelset, axlebox and primary suspension; the bearing is rigid here.

    Returns
    -------
    QuarterVehicle
    """
    vehicle = operation.vehicle
    track = lump(operation.track)
    wheel_mass = mounting.journal_mass + mounting.box_mass
    mass = np.array([vehicle.body_mass / 8.0, vehicle.bogie_mass / 4.0, wheel_mass, *track.mass])
    # one side of a bogie has two axleboxes
    links = (
        (BODY, BOGIE, 0.5 * vehicle.secondary_stiffness, 0.5 * vehicle.secondary_damping),
        (BOGIE, WHEEL, mounting.stiffness[2], mounting.damping[2]),
        (RAIL, SLEEPER, track.stiffness[0], track.damping[0]),
        (SLEEPER, BALLAST, track.stiffness[1], track.damping[1]),
        (BALLAST, None, track.stiffness[2], track.damping[2]),
    )
    stiffness = np.zeros((6, 6))
    damping = np.zeros((6, 6))
    for upper, lower, spring, damper in links:
        pull = np.zeros(6)
        pull[upper] = 1.0
        if lower is not None:
            pull[lower] = -1.0
        stiffness += spring * np.outer(pull, pull)
        damping += damper * np.outer(pull, pull)
    factor, exponent = _CONTACT_FIT[vehicle.wheel_profile]
    return QuarterVehicle(
        mass=mass,
        stiffness=stiffness,
        damping=damping,
        static_force=float(mass[: WHEEL + 1].sum()) * GRAVITY,
        journal_weight=mounting.journal_mass * GRAVITY,
        contact_flexibility=factor * (0.5 * operation.wheel_diameter) ** exponent,
    )


def ride(vehicle: QuarterVehicle, height: Float, step: float) -> Ride:
    """Run over a profile, from static equilibrium.

    The linear part moves exactly over a step (matrix exponential), the contact force acts as an
    impulse between steps: second order, symplectic for the contact, stable while the contact
    resonance (about 0.8 kHz against the rail) takes more than pi steps.

    Parameters
    ----------
    vehicle : QuarterVehicle
    height : float64 array, shape [step]
        Profile under the wheel at each step, upwards, [m]; should begin at 0.
    step : float
        Time step, [s].

    Returns
    -------
    Ride

    References
    ----------
    Hertz wheel-rail contact P = (compression / G)^1.5 with loss of contact: Zhai (2020),
    Vehicle-Track Coupled Dynamics, chapter 2. Impulse method: Hairer, Lubich, Wanner (2006),
    Geometric Numerical Integration, section VIII.4.
    """
    inverse_mass = 1.0 / vehicle.mass
    rates = np.zeros((12, 12))
    rates[:6, 6:] = np.eye(6)
    rates[6:, :6] = -inverse_mass[:, None] * vehicle.stiffness
    rates[6:, 6:] = -inverse_mass[:, None] * vehicle.damping
    from scipy.linalg import expm  # takes a while, and only a ride needs it

    contact_force, bogie, wheel = _run(
        expm(rates * step),
        np.ascontiguousarray(height, dtype=np.float64),
        float(step),
        float(inverse_mass[WHEEL]),
        float(inverse_mass[RAIL]),
        float(vehicle.static_force),
        float(vehicle.contact_flexibility),
    )
    return Ride(contact_force, bogie, wheel)


@partial(entry, flags=())
def _run(flow, height, step, inverse_wheel, inverse_rail, static_force, flexibility):
    contact_force = np.empty(len(height))
    bogie = np.empty(len(height))
    wheel = np.empty(len(height))
    state = np.zeros(12)
    moved = np.zeros(12)
    static_compression = flexibility * static_force ** (2.0 / 3.0)
    for n in range(len(height)):
        compression = static_compression + height[n] + state[RAIL] - state[WHEEL]
        force = 0.0
        if not compression <= 0.0:  # a NaN profile stays visible
            force = (compression / flexibility) ** 1.5
        contact_force[n] = force
        bogie[n] = state[BOGIE]
        wheel[n] = state[WHEEL]
        impulse = step * (force - static_force)
        state[6 + WHEEL] += impulse * inverse_wheel
        state[6 + RAIL] -= impulse * inverse_rail
        for i in range(12):
            total = 0.0
            for j in range(12):
                total += flow[i, j] * state[j]
            moved[i] = total
        state, moved = moved, state
    return contact_force, bogie, wheel
