"""A whole step of every roller against dense algebra in Cartesian coordinates; lanes against scalars."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    LINEAR,
    POSITION,
    RADIUS,
    RATE,
    ROLLER_STATES,
    TILT,
    TURN,
)
from beardyn_core.physics.tiers.status import Status, assess
from test.kernels import naive_step
from test.kernels.naive_traction import lamina_friction
from test.kernels.rig import Rig
from test.kernels.states import cartesian, ring_of, shaken
from test.scenes import standard_scene

Float = NDArray[np.float64]


@pytest.mark.parametrize("width", [8, 1])
@pytest.mark.parametrize("seed", [1, 2])
def test_step_of_every_roller_is_that_of_dense_algebra(width: int, seed: int) -> None:
    """34 rollers in all contacts; what differs is the generator line, 5e-5 of a contact force at 1 mrad."""
    assert_step_is_that_of_dense_algebra(shaken(seed, width))


def assert_step_is_that_of_dense_algebra(rig: Rig) -> None:
    """One step of the rig against the slow reference, roller by roller."""
    scene, p = rig.scene, rig.parameters
    before = rig.fields()[:ROLLER_STATES]
    bodies = rig.state.bodies.copy()
    bodies[:, POSITION : POSITION + 3] += p.step * bodies[:, LINEAR : LINEAR + 3]
    bodies[:, TILT : TILT + 3] += p.step * bodies[:, ANGULAR : ANGULAR + 3]
    bodies[:, TURN] += p.step * bodies[:, RATE]
    rig.run(1)
    after = rig.fields()[:ROLLER_STATES]
    assert p.effects.cage is not None

    def law(ring: int) -> Any:
        return lambda speed: lambda k, load, slip: lamina_friction(scene, p, ring, k, load, slip, speed)

    wrenches = np.zeros((4, 6))
    touched = np.zeros(3, dtype=int)
    largest = 0.0
    for row in (0, 1):
        rings = (
            ring_of(bodies, CUP_BODY, row, 0.0),
            ring_of(bodies, CONE_BODY, row, 0.0),
            ring_of(bodies, CAGE_BODY + row, row, p.effects.cage.place),
        )
        for k in range(scene.bearing.roller_count):
            pocket = 2.0 * math.pi * k / scene.bearing.roller_count
            state = cartesian(before[:, row, k])
            expected, reactions = naive_step.step_roller(state, rings, pocket, (law(0), law(1)), p)
            found = cartesian(after[:, row, k])
            impulse = p.step * (max(float(np.linalg.norm(r[:3])) for r in reactions) + 10.0)
            largest = max(largest, impulse)
            assert np.linalg.norm(found.centre - expected.centre) < 1e-15
            assert np.linalg.norm(found.axis - expected.axis) < 1e-10
            assert np.linalg.norm(found.velocity - expected.velocity) < 1e-4 * impulse / p.roller.mass
            assert np.linalg.norm(found.momentum - expected.momentum) < 1e-4 * impulse * 0.025
            for ring, reaction in enumerate(reactions):
                touched[ring] += np.linalg.norm(reaction[:3]) > 1.0
                body = ring + row if ring == CAGE_BODY else ring
                side = 2 * row - 1
                force, moment = reaction[:3], reaction[3:]
                wrenches[body] += [
                    force[1], side * force[2], force[0], side * moment[1], moment[2], side * moment[0],
                ]  # fmt: skip
    assert np.all(touched > [10, 10, 3])
    np.testing.assert_allclose(rig.work.wrenches[:, :3], wrenches[:, :3], atol=1e-4 * 8e4)
    np.testing.assert_allclose(rig.work.wrenches[:, 3:], wrenches[:, 3:], atol=1e-4 * 8e4 * 0.1)


@pytest.mark.parametrize(
    ("steps", "state", "force"),
    [
        (50, 1e-13, 1e-9),
        # Within 200 steps a roller makes contact. The slope of delta^(10/9) has no bound on its own slope at
        # zero, so a difference in the last place becomes one of 1e-9 there.
        (200, 1e-8, 1e-5),
    ],
)
def test_vectors_and_scalars_agree_over_steps_of_the_whole_bearing(
    steps: int, state: float, force: float
) -> None:
    """Smooth start from equilibrium: velocities of 5 m/s, loads of 80 kN."""
    wide, narrow = Rig.at_equilibrium(standard_scene()), Rig.at_equilibrium(standard_scene(), width=1)
    first, _, _ = wide.run(steps)
    second, _, _ = narrow.run(steps)
    a, b = wide.fields()[:ROLLER_STATES], narrow.fields()[:ROLLER_STATES]
    scale = np.abs(b).max(axis=(1, 2), keepdims=True) + 1e-3
    assert np.max(np.abs(a - b) / scale) < state
    assert np.abs(wide.state.bodies - narrow.state.bodies).max() < state
    assert np.abs(first[:, :3] - second[:, :3]).max() < force


def test_filler_lanes_shadow_a_roller_and_weigh_nothing() -> None:
    """17 rollers in rows of four lanes leave three fillers a row; sums must not see them."""
    rig = shaken(3)
    assert rig.arrangement.mask.sum() == 34
    rig.run(50)
    other = shaken(3, width=1)
    other.run(50)
    np.testing.assert_allclose(rig.work.wrenches, other.work.wrenches, rtol=1e-7, atol=1e-4)
    fillers = rig.arrangement.unbounded_roller >= 17
    last = rig.state.rollers[-1, :ROLLER_STATES]
    for row_lanes in (slice(0, 4), slice(4, 8)):
        lanes = last[:, row_lanes]
        assert fillers[-1, row_lanes].sum() == 3
        np.testing.assert_array_equal(lanes, np.repeat(lanes[:, :1], 4, axis=1))


@pytest.mark.parametrize("field", range(ROLLER_STATES))
def test_a_nan_in_the_state_of_one_roller_is_reported(field: int) -> None:
    """Whatever number goes wrong, the run says NOT_FINITE after the block and does not hide it."""
    rig = Rig.at_equilibrium(standard_scene())
    rig.state.rollers[2, field, 1] = np.nan
    rig.run(8)
    assert assess(rig.state, 8, rig.scene.bearing.large_end_radius) & Status.NOT_FINITE


def test_a_nan_of_one_roller_reaches_the_signals() -> None:
    rig = Rig.at_equilibrium(standard_scene())
    rig.state.rollers[0, RADIUS, 0] = np.nan
    signals, _, _ = rig.run(4)
    assert np.isnan(signals[:, :3]).any()
