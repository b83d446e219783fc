"""Static equilibria that are solved once: a choice of effects and step asks for the same ones many times.

All time steps with the same laminae have one equilibrium, and choices of one scene for other accuracies or
quantities share theirs.
"""

from __future__ import annotations

from contextlib import suppress
from functools import lru_cache
from typing import Any

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import ValidityError
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.physics.statics.static import StaticSolution, solve

_MOST = 512  # about 10 MB


def equilibrium(
    bearing: RollerBearing,
    force: tuple[float, float, float],
    moment: tuple[float, float, float] = (0.0, 0.0, 0.0),
    *,
    oversize: Float | None = None,
    crown: Float | None = None,
    **conditions: Any,
) -> StaticSolution:
    """Find the static equilibrium under a load, from memory where it was solved before.

    Parameters
    ----------
    force, moment : tuple of float
        On the cone at the bearing centre, axlebox frame, [N], [N m].
    oversize, crown : float64 array, optional
        See `beardyn_core.physics.statics.static.solve`.
    **conditions
        The other arguments of `solve`, lists among them as tuples.

    Returns
    -------
    StaticSolution
        Its arrays are shared and cannot be written to.

    Raises
    ------
    InputError, ValidityError
        As `solve`; errors are not remembered.
    """
    if conditions.get("coupling") is not None and conditions.get("near") is None:
        alone = {**conditions, "coupling": None}  # found much faster
        with suppress(ValidityError):
            uncoupled = equilibrium(bearing, force, moment, oversize=oversize, crown=crown, **alone)
            conditions["near"] = uncoupled.place
    bumps = tuple(None if each is None else (each.shape, each.tobytes()) for each in (oversize, crown))
    return _solve_equilibrium(bearing, force, moment, bumps, **conditions)


@lru_cache(maxsize=_MOST)
def _solve_equilibrium(
    bearing: RollerBearing,
    force: tuple[float, float, float],
    moment: tuple[float, float, float],
    bumps: tuple[tuple[tuple[int, ...], bytes] | None, ...],
    **conditions: Any,
) -> StaticSolution:
    oversize, crown = (None if each is None else np.frombuffer(each[1]).reshape(each[0]) for each in bumps)
    found = solve(bearing, force, moment, oversize=oversize, crown=crown, **conditions)
    for value in vars(found).values():
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
    return found
