"""Nonlinear primary suspension: springs that engage one after the other, and dry friction."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.jit import inline
from beardyn_core.rail.low_pass import first_order
from beardyn_core.scene.mounting import Mounting
from beardyn_core.scene.suspension import ProgressiveSuspension

Float = NDArray[np.float64]

# members of the row of numbers the kernel takes
SOFT, STIFF, MEET, AT_REST, STATIC, FRICTION, CREEP, LINEAR, VISCOUS = range(9)


def law(suspension: ProgressiveSuspension | None, mounting: Mounting, static: float) -> Float:
    """Gather in one array the numbers that `excess_force` needs.

    Parameters
    ----------
    suspension : ProgressiveSuspension or None
        ``None``: the linear law of the mounting, without excess; the row is empty.
    mounting : Mounting
    static : float
        Load on the suspension at rest, [N].

    Returns
    -------
    float64 array, shape [9] or [0]
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

    Parameters
    ----------
    row : float64 array
        Of `law`.
    squeeze, squeeze_speed : float
        Compression beyond that at rest, [m], [m/s].

    Notes
    -----
    The springs do not pull. Friction is proportional to their load, with the hyperbolic tangent of the
    speed: it creeps where dry friction would stick. Its own elasticity (of a Lenoir link) is neglected.
    """
    compression = row[AT_REST] + squeeze
    load = row[SOFT] * compression + (row[STIFF] - row[SOFT]) * max(compression - row[MEET], 0.0)
    load = max(load, 0.0)
    load += row[FRICTION] * load * np.tanh(squeeze_speed / row[CREEP])
    return load - row[STATIC] - row[LINEAR] * squeeze - row[VISCOUS] * squeeze_speed


def equivalent_displacement(force: Float, mounting: Mounting, axis: int, step: float) -> Float:
    """Compute the motion of the bogie end of a linear suspension that gives an additional force.

    The twin holds its axlebox by the linear law of the mounting. With the bogie moved by this as well
    the box feels what the rail model's suspension does beyond that law.

    Parameters
    ----------
    force : float64 array, shape [step]
        On the axlebox along the axis, [N].
    mounting : Mounting
    axis : int
        0, 1, 2 for x, y, z.
    step : float
        [s].

    Returns
    -------
    float64 array, shape [step]
        Solution of damping x speed + stiffness x displacement = force, [m].
    """
    stiffness, damping = mounting.stiffness[axis], mounting.damping[axis]
    if stiffness == 0.0 or not force.any():
        return np.zeros_like(force)
    return first_order(force / stiffness, damping / stiffness / step)
