"""Nonlinear primary suspension: springs that engage one after the other, and dry friction."""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.jit import inline
from beardyn_core.rail.low_pass import first_order
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.suspension import ProgressiveSuspension

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
