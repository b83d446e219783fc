"""Rolling resistance and drag in the whole step of every roller, against dense algebra."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.effects import Drag, EffectSet, RollingResistance, Seal
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    LINEAR,
    POSITION,
    RATE,
    ROLLER_STATES,
    TILT,
    TURN,
)
from beardyn_core.physics.drag import AIR_DENSITY, CYLINDER_EXPONENT, CYLINDER_FRICTION
from beardyn_core.physics.rolling_resistance import oil_supply
from test.kernels import naive_step
from test.kernels.naive import Motion, Wrench
from test.kernels.naive_losses import drag_wrench, rolling_couple, rolling_wrench
from test.kernels.naive_traction import lamina_friction
from test.kernels.rig import Rig
from test.kernels.states import cartesian, ring_of, shaken
from test.kernels.test_losses import contact, reduction
from test.scenes import scene_with

Float = NDArray[np.float64]
LOSSY = replace(EffectSet(), rolling_resistance=RollingResistance(), drag=Drag(), seal=Seal())


def laws_of(rig: Rig) -> tuple[tuple[int, Any], ...]:
    """Rolling on cup and cone, and drag against the cup, as further contacts of the naive step."""
    scene, p = rig.scene, rig.parameters
    bearing, oil = scene.bearing, scene.lubricant
    density = Drag.fill * oil.density + (1.0 - Drag.fill) * AIR_DENSITY
    radius, length = 0.5 * bearing.roller_diameter, bearing.roller_length

    def churning(spin: float) -> float:
        reynolds = spin * radius**2 / oil.kinematic_viscosity(scene.temperature)
        wall = CYLINDER_FRICTION * reynolds**-CYLINDER_EXPONENT
        cylinder = 0.5 * wall * density * (spin * radius) ** 2 * 2.0 * math.pi * radius**2 * length
        return cylinder + 0.5 * density * spin**2 * radius**5 * 3.87 / math.sqrt(reynolds)

    def rolling(ring: int) -> Any:
        def couple(load: float, speed: float) -> float:
            full = rolling_couple(
                "zhou_hoeprich",
                contact(scene, ring, max(load, 1.0), speed + 1e-3),
                oil_supply(scene.effects.film),
            )
            return min(load, 1.0) * full * reduction(scene, speed + 1e-3)

        def law(motion: Motion, orbit_rate: float) -> Wrench:
            radius, slowest = contact(scene, ring, 1.0, 1.0).radius, RollingResistance.regularisation_speed
            return rolling_wrench(motion, (p.cup, p.cone)[ring], p, couple, radius, slowest, orbit_rate)

        return law

    def drag(motion: Motion, _orbit_rate: float) -> Wrench:
        return drag_wrench(motion, Drag.drag_coefficient * length * 2.0 * radius, churning, density)

    return ((0, rolling(0)), (1, rolling(1)), (0, drag))


def test_what_the_losses_change_in_a_step_is_that_of_dense_algebra() -> None:
    """Difference of a step with and without, so that the contacts' own errors cancel; 0.5 % of the largest.

    The abscissa of the load and the finite arm of the laminae make up that difference.
    """
    quiet, rig = shaken(1), Rig.at_equilibrium(scene_with(LOSSY))
    rig.state.rollers[:] = quiet.state.rollers
    rig.state.bodies[:] = quiet.state.bodies
    scene, p = rig.scene, rig.parameters
    before = rig.fields()[:ROLLER_STATES]
    bodies = rig.state.bodies.copy()
    bodies[:, POSITION : POSITION + 3] += p.step * bodies[:, LINEAR : LINEAR + 3]
    bodies[:, TILT : TILT + 3] += p.step * bodies[:, ANGULAR : ANGULAR + 3]
    bodies[:, TURN] += p.step * bodies[:, RATE]
    quiet.run(1)
    rig.run(1)
    with_, without = rig.fields()[:ROLLER_STATES], quiet.fields()[:ROLLER_STATES]
    assert p.effects.cage is not None
    laws = laws_of(rig)

    def friction(ring: int) -> Any:
        return lambda speed: lambda k, load, slip: lamina_friction(scene, p, ring, k, load, slip, speed)

    found, expected = [], []
    for row in (0, 1):
        rings = (
            ring_of(bodies, CUP_BODY, row, 0.0),
            ring_of(bodies, CONE_BODY, row, 0.0),
            ring_of(bodies, CAGE_BODY + row, row, p.effects.cage.place),
        )
        for k in range(0, scene.bearing.roller_count, 2):
            pocket = 2.0 * math.pi * k / scene.bearing.roller_count
            state = cartesian(before[:, row, k])
            steps = [
                naive_step.step_roller(state, rings, pocket, (friction(0), friction(1)), p, losses)[0]
                for losses in (laws, ())
            ]
            expected.append(
                [*(steps[0].velocity - steps[1].velocity), *(steps[0].momentum - steps[1].momentum)]
            )
            ours, bare = cartesian(with_[:, row, k]), cartesian(without[:, row, k])
            found.append([*(ours.velocity - bare.velocity), *(ours.momentum - bare.momentum)])
    for part, least in ((slice(0, 3), 1e-7), (slice(3, 6), 0.02 * p.step)):
        got, dense = np.array(found)[:, part], np.array(expected)[:, part]
        size = np.linalg.norm(dense, axis=1).max()
        assert size > least  # a moment of 0.045 N m about the centre, a drag of 0.35 N
        assert np.linalg.norm(got - dense, axis=1).max() < 5e-3 * size
