"""Momentum of the rollers of a rig in the world, and what they exchange with the rings in a step."""

from __future__ import annotations

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.physics.bodies.layout import CAGE_BODY, CUP_BODY, POSITION, ROLLER_STATES
from test.kernels.rig import Rig
from test.kernels.states import cartesian


def world(vector: Float, row: int, *, axial: bool = False) -> Float:
    """Row frame z, x, outward to world x, y, z; row 0 is a mirror image."""
    side = 2 * row - 1
    z, x, y = vector
    return np.array([side * x, y, side * z]) if axial else np.array([x, side * y, z])


def momenta(rig: Rig) -> tuple[Float, Float, float]:
    """Linear and angular momentum of all rollers about the world's origin, and their sum of sizes."""
    fields = rig.fields()[:ROLLER_STATES]
    mass = rig.parameters.roller.mass
    linear, angular, size = np.zeros(3), np.zeros(3), 0.0
    for row, k in np.argwhere(rig.arrangement.present):
        state = cartesian(fields[:, row, k])
        velocity = world(state.velocity, row)
        place = world(state.centre, row) + rig.state.bodies[CUP_BODY, POSITION : POSITION + 3]
        linear += mass * velocity
        angular += mass * np.cross(place, velocity) + world(state.momentum, row, axial=True)
        size += mass * float(np.linalg.norm(velocity))
    return linear, angular, size


def assert_momentum_is_exchanged(rig: Rig) -> None:
    """One step: what the rollers win the rings lose, less the weight, to rounding."""
    p = rig.parameters
    assert p.effects.cage is not None
    assert p.effects.gravity is not None
    linear_before, angular_before, size = momenta(rig)
    rig.run(1)
    linear_after, angular_after, _ = momenta(rig)
    # reactions act at the places of the end of the drift, where the bodies still stand
    wrenches, bodies = rig.work.wrenches, rig.state.bodies
    force, moment, pushed = np.zeros(3), np.zeros(3), 0.0
    for body in range(len(bodies)):
        lift = np.array([0.0, p.effects.cage.place * (1.0 if body == 3 else -1.0), 0.0])
        place = bodies[body, POSITION : POSITION + 3] + (lift if body >= CAGE_BODY else 0.0)
        force += wrenches[body, :3]
        moment += wrenches[body, 3:] + np.cross(place, wrenches[body, :3])
        pushed += float(np.linalg.norm(wrenches[body, :3]))
    weight = -p.roller.mass * p.effects.gravity.acceleration
    fields = rig.fields()
    gravity, torque = np.zeros(3), np.zeros(3)
    for row, k in np.argwhere(rig.arrangement.present):
        pull = np.array([0.0, 0.0, weight])
        gravity += pull
        place = world(cartesian(fields[:ROLLER_STATES, row, k]).centre, row)
        torque += np.cross(place + bodies[CUP_BODY, POSITION : POSITION + 3], pull)
    assert pushed > 10.0
    rounding = 1e-12 * size
    won = linear_after - linear_before - p.step * gravity
    assert np.abs(won + p.step * force).max() < rounding
    # the inertial angular momentum moves with the drift only by rounding: r_new x v = r_old x v
    won = angular_after - angular_before - p.step * torque
    assert np.abs(won + p.step * moment).max() < rounding * 0.1
