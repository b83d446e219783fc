"""Wheelset, bogie and body share moving sideways: creep, conicity, flanges."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.rail.course import Course
from beardyn_core.rail.vehicle import GRAVITY, link_masses
from beardyn_core.rail.wheelset import HALF_GAUGE
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation

SIDEWAYS, YAW, FRAME, CAR = range(4)

# creep coefficient of one wheel, [N], under a wheel load of 85 kN; as the contact patch's area, it goes
# with the 2/3 power of the load
_CREEP, _CREEP_LOAD = 1.0e7, 85e3
# below this speed creep acts as friction on a rolling wheel no more, [m/s]
_WALK = 0.5


@dataclass(frozen=True)
class LateralVehicle:
    """Half a wheelset with its axlebox, a quarter of a bogie, an eighth of the body."""

    mass: A[
        Float, "shape [4], of `SIDEWAYS`, `YAW` (of the half wheelset, [kg m^2]), `FRAME` and `CAR`, [kg]"
    ]
    stiffness: A[Float, "shape [4, 4], of primary and secondary suspension, [N/m], in yaw [N m/rad]"]
    damping: A[Float, "shape [4, 4], the same, [N s/m], in yaw [N m s/rad]"]
    creep: A[float, "creep coefficient of one wheel, longitudinal and lateral, [N]"]
    creep_limit: A[float, "friction force of one wheel, [N]"]
    steering: A[float, "conicity over the wheel radius, [1/m]"]
    clearance: A[float, "from the middle of the track to the flange contact, [m]"]
    flange_stiffness: A[float, "half of one rail's, [N/m]"]
    flange_damping: A[float, "half of one rail's, [N s/m]"]
    journal_yaw: A[
        float, "moment of inertia of the half wheelset and the axlebox as masses at the bearing, [kg m^2]"
    ]


@dataclass(frozen=True)
class Flexing:
    """What roll and bending of a wheelset add to the motion of the left journal."""

    rise: A[Float, "shape [step], upwards, beyond the vertical model, [m]"]
    tilt: A[Float, "shape [step], its end upwards, [rad]"]
    back: A[Float, "shape [step], backwards, beyond yaw, [m]"]


@dataclass(frozen=True)
class LateralMotion:
    """Lateral response on a uniform time grid; positive to the left."""

    motion: A[
        Float,
        "shape [step, 4], of wheelset, its yaw, bogie and body from the middle of the track, [m], [rad]",
    ]
    rail_force: A[Float, "shape [step], of both rails on the half wheelset: half of the axle's, [N]"]
    yaw_moment: A[
        Float,
        "shape [step], about z, that would yaw the half wheelset likewise if its mass were at the bearing, "
        "[N m]",
    ]
    flexing: A[Flexing | None, "``None``: a rigid wheelset that does not roll"] = None


def lateral_vehicle(operation: QuarterVehicleOperation, mounting: Mounting) -> LateralVehicle:
    """Build the lateral model of one axlebox's share of the vehicle.

    References
    ----------
    Creep coefficients in proportion to the contact area: Kalker (1967), as in Wickens (2003), Fundamentals
    of Rail Vehicle Dynamics, chapter 2.
    """
    guidance, vehicle = operation.vehicle.guidance, operation.vehicle
    arm = 0.5 * guidance.axlebox_spacing
    wheelset = mounting.journal_mass + mounting.box_mass
    body, bogie = operation.body_mass / 8.0, vehicle.bogie_mass / 4.0
    # the wheels carry the mass of a wheelset
    yaw = mounting.journal_mass * HALF_GAUGE**2 + mounting.box_mass * arm**2
    load = (wheelset + body + bogie) * GRAVITY

    def links(longitudinal: float, primary: float, secondary: float) -> Float:
        matrix = link_masses([(FRAME, SIDEWAYS, primary), (CAR, FRAME, 0.5 * secondary)])
        matrix[YAW, YAW] = longitudinal * arm**2
        return matrix

    return LateralVehicle(
        mass=np.array([wheelset, yaw, bogie, body]),
        stiffness=links(mounting.stiffness[0], mounting.stiffness[1], guidance.secondary_stiffness),
        damping=links(mounting.damping[0], mounting.damping[1], guidance.secondary_damping),
        creep=_CREEP * (load / _CREEP_LOAD) ** (2.0 / 3.0),
        creep_limit=guidance.friction * load,
        steering=guidance.conicity / (0.5 * operation.wheel_diameter),
        clearance=guidance.flange_clearance,
        flange_stiffness=0.5 * guidance.flange_stiffness,
        flange_damping=0.5 * guidance.flange_damping,
        journal_yaw=wheelset * arm**2,
    )


def lateral_motion(
    vehicle: LateralVehicle, speed: Float, plan: Course, alignment: Float, step: float
) -> LateralMotion:
    """Simulate the lateral motion along the course of the track, starting at its middle.

    By the trapezoidal rule, each step linear: creep is reduced where the resultant comes near the friction
    limit, and flanges touch, as at the step's beginning. Stable at any speed, through standstill and
    backwards. At each step [s] stand the speed [m/s] and the alignment of the track's middle under the axle,
    to the left [m].

    Notes
    -----
    Linear creep, F / (1 + (F / mu Q)^2)^(1/2) against its limit; conicity as one number; the bogie does not
    yaw, it points along the track at the axle: what an angle of attack makes the flanges and the creep
    of one axle do against each other is absent, their sum is not. Both axleboxes carry half. Spin
    creep, gravitational stiffness and the changes of the wheel load are neglected.

    References
    ----------
    Wickens (2003), Fundamentals of Rail Vehicle Dynamics, chapters 2 and 3: creepages of a wheelset on
    a curve. Shen, Hedrick, Elkins (1983), A comparison of alternative creep force models: reduction at the
    limit, here in a smooth form.
    """
    motion, rail_force, yaw_moment = _run(
        np.diag(vehicle.mass),
        vehicle.stiffness,
        vehicle.damping,
        np.array(
            [
                vehicle.creep,
                vehicle.creep_limit,
                vehicle.steering,
                vehicle.clearance,
                vehicle.flange_stiffness,
                vehicle.flange_damping,
                vehicle.journal_yaw,
            ]
        ),
        np.ascontiguousarray(speed),
        plan.curvature,
        plan.lean,
        np.ascontiguousarray(alignment),
        float(step),
    )
    return LateralMotion(motion, rail_force, yaw_moment)


@inline
def wheel_grip(contact, speed, curvature, aside, aside_speed, yaw, yaw_speed):
    """Find the share of linear creep that friction allows, and the regularised sign and speed of rolling."""
    rolling = np.sqrt(speed * speed + _WALK * _WALK)
    sign = speed / rolling
    lateral = contact[0] * (aside_speed / rolling - sign * yaw)
    along = contact[0] * (HALF_GAUGE * (yaw_speed / rolling + sign * curvature) + sign * contact[2] * aside)
    share = 1.0 / np.sqrt(1.0 + (lateral * lateral + along * along) / (contact[1] * contact[1]))
    return rolling, sign, share


@inline
def _solve(matrix, vector):
    """Solve by Gauss elimination in place; the masses keep the diagonal the largest."""
    for column in range(4):
        for row in range(column + 1, 4):
            factor = matrix[row, column] / matrix[column, column]
            for k in range(column, 4):
                matrix[row, k] -= factor * matrix[column, k]
            vector[row] -= factor * vector[column]
    for row in range(3, -1, -1):
        for k in range(row + 1, 4):
            vector[row] -= matrix[row, k] * vector[k]
        vector[row] /= matrix[row, row]


@partial(entry, allocates=True, flags=("contract",))
def _run(mass, stiffness, damping, contact, speed, curvature, lean, alignment, step):
    count = len(speed)
    motion, rail_force, yaw_moment = np.empty((count, 4)), np.empty(count), np.empty(count)
    place, rate = np.zeros(4), np.zeros(4)
    matrix, change = np.empty((4, 4)), np.empty(4)
    spring, damper, load = np.empty((4, 4)), np.empty((4, 4)), np.empty(4)
    creep, steering, clearance = contact[0], contact[2], contact[3]
    for n in range(count):
        motion[n] = place
        shift = (alignment[n] - alignment[max(n - 1, 0)]) / step
        aside = place[SIDEWAYS] - alignment[n]
        rolling, sign, share = wheel_grip(
            contact, speed[n], curvature[n], aside, rate[SIDEWAYS], place[YAW], rate[YAW]
        )
        for i in range(4):
            for j in range(4):
                spring[i, j], damper[i, j] = stiffness[i, j], damping[i, j]
            load[i] = mass[i, i] * lean[n]
        load[YAW] = 0.0
        grip = creep * share
        damper[SIDEWAYS, SIDEWAYS] += grip / rolling
        spring[SIDEWAYS, YAW] -= grip * sign
        damper[YAW, YAW] += grip * HALF_GAUGE * HALF_GAUGE / rolling
        spring[YAW, SIDEWAYS] += grip * HALF_GAUGE * sign * steering
        load[YAW] -= grip * HALF_GAUGE * sign * (HALF_GAUGE * curvature[n] - steering * alignment[n])
        if abs(aside) > clearance:
            edge = clearance if aside > 0.0 else -clearance
            spring[SIDEWAYS, SIDEWAYS] += contact[4]
            load[SIDEWAYS] += contact[4] * (alignment[n] + edge)
            pressing = contact[4] * (aside - edge) + contact[5] * (rate[SIDEWAYS] - shift)
            if pressing * edge > 0.0:  # a rail does not pull
                damper[SIDEWAYS, SIDEWAYS] += contact[5]
                load[SIDEWAYS] += contact[5] * shift
        for i in range(4):
            change[i] = load[i]
            for j in range(4):
                matrix[i, j] = mass[i, j] + 0.5 * step * (damper[i, j] + 0.5 * step * spring[i, j])
                change[i] -= damper[i, j] * rate[j] + spring[i, j] * (place[j] + 0.5 * step * rate[j])
            change[i] *= step
        _solve(matrix, change)
        for i in range(4):
            place[i] += step * (rate[i] + 0.5 * change[i])
            rate[i] += change[i]
        # the rails' part, from the balance of the wheelset at mid-step
        sideways = mass[SIDEWAYS, SIDEWAYS] * (change[SIDEWAYS] / step - lean[n])
        turning = contact[6] * change[YAW] / step
        for j in range(4):
            middle, pace = 0.5 * (place[j] + motion[n, j]), rate[j] - 0.5 * change[j]
            sideways += stiffness[SIDEWAYS, j] * middle + damping[SIDEWAYS, j] * pace
            turning += stiffness[YAW, j] * middle + damping[YAW, j] * pace
        rail_force[n], yaw_moment[n] = sideways, turning
    return motion, rail_force, yaw_moment
