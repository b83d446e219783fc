"""Momentum of the rolling parts in the quasistatic tier, where rollers and cages have mass."""

from __future__ import annotations

import numpy as np

from beardyn_core.physics.bodies import layout
from beardyn_core.twin import Twin
from test.tiers.runs import Float


def momentum_of_rolling_parts(twin: Twin) -> Float:
    """Momentum of rollers and cages in the world, shape [3], [N s]; none in the lumped tier."""
    assert twin._state is not None
    if twin.scene.tier != "quasistatic":
        return np.zeros(3)
    bearing, bodies = twin.scene.bearing, twin._state.bodies
    fields = twin._arrangement.to_rollers(np.moveaxis(twin._state.rollers, 1, 0))
    radial, onward, axial = (fields[layout.VELOCITY + k] for k in range(3))
    angle, side = fields[layout.ANGLE], np.array([-1.0, 1.0])[:, None]
    against_cup = np.array(
        [
            (radial * np.sin(angle) + onward * np.cos(angle)).sum(),
            (side * axial).sum(),
            (radial * np.cos(angle) - onward * np.sin(angle)).sum(),
        ]
    )
    rollers = against_cup + angle.size * bodies[layout.CUP_BODY, layout.LINEAR : layout.LINEAR + 3]
    cages = bodies[layout.CAGE_BODY :, layout.LINEAR : layout.LINEAR + 3].sum(axis=0)
    return np.asarray(bearing.roller_mass * rollers + bearing.cage.mass * cages)
