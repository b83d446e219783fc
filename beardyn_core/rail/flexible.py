"""A wheelset that rolls on its rails, bends and twists while it moves sideways."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.rail.course import Course
from beardyn_core.rail.lateral import (
    CAR,
    FRAME,
    SIDEWAYS,
    YAW,
    Flexing,
    LateralMotion,
    LateralVehicle,
    lateral_vehicle,
    wheel_grip,
)
from beardyn_core.rail.vehicle import quarter_vehicle
from beardyn_core.rail.wheelset import HALF_GAUGE, Modes, Shaft, bending, half_shaft, torsion
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.operation import QuarterVehicleOperation

ROLL = 4

# modes below this are kept; frequency at which the track is what it is under the wheels, [Hz]
_HIGHEST, _TRACK_AT = 1500.0, 100.0


@dataclass(frozen=True)
class FlexibleVehicle:
    """The four coordinates of the lateral model, roll, bending upright and along the track, torsion.

    In all that is added both wheels move against each other. Of the half wheelset, as the lateral model.
    """

    rigid: A[LateralVehicle, "contact, and masses of the first four coordinates"]
    mass: A[Float, "shape [coordinate], [kg], in yaw, roll and torsion [kg m^2]"]
    stiffness: A[Float, "shape [coordinate, coordinate], suspension, track under the wheels and modes"]
    damping: A[Float, "shape [coordinate, coordinate], the same"]
    aside: A[Float, "shape [coordinate], how far the left wheel's contact goes to the left per unit"]
    along: A[Float, "shape [coordinate], the same backwards; the right wheel's goes forwards"]
    rise: A[Float, "shape [coordinate], the same of the left journal upwards"]
    tilt: A[Float, "shape [coordinate], tilt of the left journal, its end upwards"]
    back: A[Float, "shape [coordinate], how far bending moves the left journal backwards"]


def flexible_vehicle(operation: QuarterVehicleOperation, mounting: Mounting) -> FlexibleVehicle | None:
    """Build the lateral model of a vehicle whose wheelset bends; ``None`` when it is rigid.

    The modes are those with the axlebox on the journal, for the bearing is rigid here. The track is a spring
    and a dashpot under each wheel, those of contact and rail at 100 Hz. The turning of the wheelset,
    which couples bending upright with bending along the track, is neglected.
    """
    half = half_shaft(operation, mounting, mounting.box_mass)
    if half is None:
        return None
    return with_modes(
        operation,
        mounting,
        half,
        bending(half, mounting.journal_mass, symmetric=False).below(_HIGHEST),
        torsion(half).below(_HIGHEST),
    )


def with_modes(
    operation: QuarterVehicleOperation, mounting: Mounting, half: Shaft, bent: Modes, twisted: Modes
) -> FlexibleVehicle:
    """Build the lateral model with given modes of half the wheelset, both wheels against each other."""
    share = lateral_vehicle(operation, mounting)
    radius, arm = 0.5 * operation.wheel_diameter, 0.5 * operation.vehicle.guidance.axlebox_spacing
    count, twists = len(bent), len(twisted)
    places = np.cumsum([5, count, count, twists])
    upright, flat, turned = (slice(*pair) for pair in pairwise(places.tolist()))
    # of the left wheel's contact, the wheel and the journal; `sink` presses the wheel onto its rail
    aside, along, sink, rise, tilt, back = np.zeros((6, places[-1]))
    aside[SIDEWAYS], aside[ROLL], aside[upright] = 1.0, radius, radius * bent.wheel_slope
    along[YAW], along[flat], along[turned] = HALF_GAUGE, bent.wheel, radius * twisted.wheel
    sink[ROLL], sink[upright] = HALF_GAUGE, bent.wheel
    rise[ROLL], rise[upright] = arm, bent.journal
    tilt[ROLL], tilt[upright] = 1.0, bent.journal_slope
    back[flat] = bent.journal
    pulled = back.copy()
    pulled[YAW] = arm
    vertical = quarter_vehicle(operation, mounting)
    pressed = 1.5 * vertical.static_force ** (1.0 / 3.0) / vertical.contact_flexibility
    track = 1.0 / (1.0 / pressed + vertical.rail.receptance(_TRACK_AT))

    def larger(matrix: Float, of_modes: list[Float], under: float, primary: float) -> Float:
        grown = np.diag(np.concatenate([np.zeros(5), *of_modes]))
        grown += under * np.outer(sink, sink) + primary * np.outer(pulled, pulled)
        grown[:4, :4] = matrix
        return grown

    own = [np.full(count, bent.mass), np.full(count, bent.mass), np.full(twists, twisted.mass)]
    springs = [bent.stiffness, bent.stiffness, twisted.stiffness]
    dampers = [bent.damping, bent.damping, twisted.damping]
    seat = track.imag / (2.0 * np.pi * _TRACK_AT)
    return FlexibleVehicle(
        rigid=share,
        mass=np.concatenate([share.mass, [bent.rigid], *own]),
        stiffness=larger(share.stiffness, springs, track.real, mounting.stiffness[0]),
        damping=larger(share.damping, dampers, seat, mounting.damping[0]),
        aside=aside,
        along=along,
        rise=rise,
        tilt=tilt,
        back=back,
    )


def flexible_motion(
    vehicle: FlexibleVehicle, speed: Float, plan: Course, alignment: Float, step: float
) -> LateralMotion:
    """Simulate the lateral motion with a flexible wheelset; else as `lateral.lateral_motion`.

    Creep and flanges act at the contacts, which roll, bending and torsion move as well.

    References
    ----------
    Knothe, Grassie (1993), Vehicle System Dynamics 22: free modes of the wheelset between contacts and
    suspension.
    """
    share = vehicle.rigid
    contact = np.array(
        [
            share.creep,
            share.creep_limit,
            share.steering,
            share.clearance,
            share.flange_stiffness,
            share.flange_damping,
            share.journal_yaw,
        ]
    )
    motion, rail_force, yaw_moment = _run(
        vehicle.mass,
        vehicle.stiffness,
        vehicle.damping,
        vehicle.aside,
        vehicle.along,
        contact,
        np.ascontiguousarray(speed),
        plan.curvature,
        plan.lean,
        np.ascontiguousarray(alignment),
        float(step),
    )
    rise, tilt, back = np.stack([vehicle.rise, vehicle.tilt, vehicle.back]) @ motion.T
    return LateralMotion(motion[:, :4], rail_force, yaw_moment, Flexing(rise, tilt, back))


@inline
def _eliminate(matrix, vector):
    """Solve by Gauss elimination in place; the masses keep the diagonal the largest."""
    count = len(vector)
    for column in range(count):
        inverse = 1.0 / matrix[column, column]
        for row in range(column + 1, count):
            factor = matrix[row, column] * inverse
            if factor != 0.0:
                for k in range(column, count):
                    matrix[row, k] -= factor * matrix[column, k]
                vector[row] -= factor * vector[column]
    for row in range(count - 1, -1, -1):
        for k in range(row + 1, count):
            vector[row] -= matrix[row, k] * vector[k]
        vector[row] /= matrix[row, row]


@partial(entry, allocates=True, flags=("contract",))
def _run(mass, stiffness, damping, aside, along, contact, speed, curvature, lean, alignment, step):
    count, size = len(speed), len(mass)
    motion, rail_force, yaw_moment = np.empty((count, size)), np.empty(count), np.empty(count)
    place, rate = np.zeros(size), np.zeros(size)
    matrix, change, load = np.empty((size, size)), np.empty(size), np.empty(size)
    for n in range(count):
        motion[n] = place
        shift = (alignment[n] - alignment[max(n - 1, 0)]) / step
        off, off_rate, back_rate = -alignment[n], 0.0, 0.0
        for i in range(size):
            off += aside[i] * place[i]
            off_rate += aside[i] * rate[i]
            back_rate += along[i] * rate[i]
        rolling, sign, share = wheel_grip(
            contact, speed[n], curvature[n], off, off_rate, place[YAW], back_rate / HALF_GAUGE
        )
        grip = contact[0] * share
        # forces on both contacts: sideways and backwards, each with what it is per place and per speed
        steered = grip * sign * contact[2]
        back_force = -grip * sign * HALF_GAUGE * curvature[n] + steered * alignment[n]
        side_force, side_spring, side_damper = 0.0, 0.0, grip / rolling
        if abs(off) > contact[3]:
            edge = contact[3] if off > 0.0 else -contact[3]
            side_spring = contact[4]
            side_force = contact[4] * (alignment[n] + edge)
            pressing = contact[4] * (off - edge) + contact[5] * (off_rate - shift)
            if pressing * edge > 0.0:  # a rail does not pull
                side_damper += contact[5]
                side_force += contact[5] * shift
        for i in range(size):
            load[i] = aside[i] * side_force + along[i] * back_force
        for i in (SIDEWAYS, FRAME, CAR):
            load[i] += mass[i] * lean[n]
        for i in range(size):
            change[i] = load[i]
            for j in range(size):
                spring = stiffness[i, j] + (aside[i] * side_spring + along[i] * steered) * aside[j]
                if j == YAW:
                    spring -= aside[i] * grip * sign
                damper = damping[i, j] + side_damper * aside[i] * aside[j]
                damper += grip / rolling * along[i] * along[j]
                matrix[i, j] = 0.5 * step * (damper + 0.5 * step * spring)
                change[i] -= damper * rate[j] + spring * (place[j] + 0.5 * step * rate[j])
            matrix[i, i] += mass[i]
            change[i] *= step
        _eliminate(matrix, change)
        for i in range(size):
            place[i] += step * (rate[i] + 0.5 * change[i])
            rate[i] += change[i]
        # the rails' part, from the balance of the wheelset at mid-step
        sideways = mass[SIDEWAYS] * (change[SIDEWAYS] / step - lean[n])
        turning = contact[6] * change[YAW] / step
        for j in range(4):
            middle, pace = 0.5 * (place[j] + motion[n, j]), rate[j] - 0.5 * change[j]
            sideways += stiffness[SIDEWAYS, j] * middle + damping[SIDEWAYS, j] * pace
            turning += stiffness[YAW, j] * middle + damping[YAW, j] * pace
        rail_force[n], yaw_moment[n] = sideways, turning
    return motion, rail_force, yaw_moment
