"""Rollers that touch nothing fly as rigid bodies of revolution do, and symmetries of the bearing hold."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.effects import Gravity
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    AXIS,
    CAGE_BODY,
    CUP_BODY,
    MOMENTUM,
    RATE,
    ROLLER_STATES,
    SIGNAL_FORCE,
    TILT,
    VELOCITY,
)
from test.kernels import naive_step
from test.kernels.rig import Rig
from test.kernels.states import cartesian, shaken
from test.scenes import scene_with, standard_scene

Float = NDArray[np.float64]
FAR = 10.0


def untouched(gravity: float = 0.0) -> Rig:
    """Every ring, rib and pocket out of reach, rollers tumbling."""
    rig = shaken(5)
    p = rig.parameters
    assert p.effects.rib is not None
    assert p.effects.cage is not None
    assert p.effects.gravity is not None
    rig.parameters = p._replace(
        cup=p.cup._replace(gap=FAR),
        cone=p.cone._replace(gap=FAR),
        effects=p.effects._replace(
            rib=p.effects.rib._replace(distance=FAR),
            cage=p.effects.cage._replace(half_clearance=FAR, half_end_clearance=FAR),
            gravity=p.effects.gravity._replace(acceleration=gravity),
        ),
    )
    fields = rig.fields()[:ROLLER_STATES]
    rng = np.random.default_rng(6)
    fields[MOMENTUM : MOMENTUM + 3] += rng.normal(0.0, 2e-3, (3, *fields.shape[1:]))
    rig.set_fields(fields)
    return rig


def states(rig: Rig) -> list[naive_step.RollerState]:
    fields = rig.fields()[:ROLLER_STATES]
    return [cartesian(fields[:, row, k]) for row in (0, 1) for k in range(fields.shape[2])]


def energy(state: naive_step.RollerState, rig: Rig) -> float:
    roller = rig.parameters.roller
    along = float(state.momentum @ state.axis)
    across = float(state.momentum @ state.momentum) - along**2
    spin = along**2 / roller.axial_inertia + across / roller.transverse_inertia
    return 0.5 * (roller.mass * float(state.velocity @ state.velocity) + spin)


def test_free_roller_keeps_velocity_momentum_and_energy() -> None:
    """1000 steps of 10 us in turning frames: rounding, and 1e-9 of the axis's second order."""
    rig = untouched()
    before = states(rig)
    rig.run(1000)
    for old, new in zip(before, states(rig), strict=True):
        flown = old.centre + 1000 * rig.parameters.step * old.velocity
        assert np.linalg.norm(new.centre - flown) < 1e-12
        assert np.linalg.norm(new.velocity - old.velocity) < 1e-12 * np.linalg.norm(old.velocity)
        assert np.linalg.norm(new.momentum - old.momentum) < 1e-12 * np.linalg.norm(old.momentum)
        assert energy(new, rig) == pytest.approx(energy(old, rig), rel=1e-8)


def test_axis_of_a_free_roller_precesses_about_its_angular_momentum() -> None:
    """Rate |L| / I_t, exactly; the second-order turn of a step of angle a is ahead by a^2 / 6 of itself."""
    rig = untouched()
    before = states(rig)
    rig.run(1000)
    for old, new in zip(before, states(rig), strict=True):
        turn = 1000 * rig.parameters.step * old.momentum / rig.parameters.roller.transverse_inertia
        angle = float(np.linalg.norm(turn))
        step_angle = angle / 1000
        assert angle > 0.2
        expected = naive_step.rotated(turn, old.axis)
        assert np.linalg.norm(new.axis - expected) < angle * step_angle**2 / 6.0 * 1.1 + 1e-12
        assert np.linalg.norm(new.axis) == pytest.approx(1.0, abs=1e-14)


def test_falling_roller_falls() -> None:
    rig = untouched(gravity=9.80665)
    before = states(rig)
    rig.run(500)
    time = 500 * rig.parameters.step
    fall = np.array([-9.80665 * time, 0.0, 0.0])
    for old, new in zip(before, states(rig), strict=True):
        np.testing.assert_allclose(new.velocity - old.velocity, fall, atol=1e-12)


def weightless(angle: float) -> Rig:
    """Load of 80 kN at an azimuth, no gravity, start from equilibrium."""
    scene = scene_with(replace(standard_scene().effects, gravity=Gravity(0.0)))
    return Rig.at_equilibrium(scene, (8e4 * math.sin(angle), 0.0, 8e4 * math.cos(angle)))


def test_load_turned_by_one_pitch_gives_the_same_motion_turned_by_one_pitch() -> None:
    """Roller k takes the part of roller k - 1: static start and 500 steps, to the start's tolerance."""
    pitch = 2.0 * math.pi / 17
    plain, rotated = weightless(0.0), weightless(pitch)
    first, _, _ = plain.run(500)
    second, _, _ = rotated.run(500)
    a = plain.fields()[: VELOCITY + 3]
    b = rotated.fields()[: VELOCITY + 3]
    shifted = np.roll(b, -1, axis=-1)
    scale = np.array([1e-9, 1e-8, 1e-9, 1e-5, 1e-5, 1e-5])[:, None, None]
    difference = a[:6] - shifted[:6]
    difference[1] = np.angle(np.exp(1j * (difference[1] + pitch)))
    assert np.all(np.abs(difference) < scale)
    fx, fz = first[:, SIGNAL_FORCE], first[:, SIGNAL_FORCE + 2]
    c, s = math.cos(pitch), math.sin(pitch)
    np.testing.assert_allclose(second[:, SIGNAL_FORCE + 2], c * fz - s * fx, atol=8.0)  # 1e-4 of 80 kN
    np.testing.assert_allclose(second[:, SIGNAL_FORCE], s * fz + c * fx, atol=8.0)


def test_rows_are_mirror_images_under_a_radial_load() -> None:
    """Back-to-back rows in their own frames do the same; 200 steps from equilibrium, then chaos may grow."""
    rig = Rig.at_equilibrium(standard_scene())
    signals, _, _ = rig.run(200)
    fields = rig.fields()[:ROLLER_STATES]
    scale = np.abs(fields).max(axis=(1, 2)) + 1e-3
    assert np.max(np.abs(fields[:, 0] - fields[:, 1]) / scale[:, None]) < 1e-11
    assert np.abs(signals[:, SIGNAL_FORCE + 1]).max() < 1e-6  # no axial force
    for component in (3, 5):
        assert np.abs(signals[:, SIGNAL_FORCE + component]).max() < 1e-7  # no tilting moment


def test_reversed_rotation_is_the_mirror_image() -> None:
    """Turning backwards about the vertical plane: same vertical force, opposite horizontal force and spin."""
    ahead = Rig.at_equilibrium(standard_scene(), speed=122.0)
    back = Rig.at_equilibrium(standard_scene(), speed=-122.0)
    first, _, _ = ahead.run(300)
    second, _, _ = back.run(300)
    np.testing.assert_allclose(second[:, SIGNAL_FORCE + 2], first[:, SIGNAL_FORCE + 2], rtol=1e-9)
    np.testing.assert_allclose(second[:, SIGNAL_FORCE], -first[:, SIGNAL_FORCE], atol=1e-4)
    a, b = ahead.fields()[:ROLLER_STATES], back.fields()[:ROLLER_STATES]
    mirrored = np.concatenate([b[..., :1], b[..., :0:-1]], axis=-1)
    np.testing.assert_allclose(mirrored[VELOCITY + 1], -a[VELOCITY + 1], rtol=1e-9)
    np.testing.assert_allclose(mirrored[AXIS], a[AXIS], rtol=1e-9)
    np.testing.assert_array_equal(ahead.state.bodies[CUP_BODY], 0.0)


def test_free_cage_nutates_about_its_angular_momentum() -> None:
    """A spinning ring with I_p rate y + I_t w: the vector stays, w turns by a radian.

    1000 explicit steps of 1.0e-3 rad let the transverse part grow by 0.5e-6 each, 0.05 % together.
    """
    rig = untouched()
    cage, bodies = rig.parameters.effects.cage, rig.state.bodies
    assert cage is not None
    bodies[CAGE_BODY:, TILT : TILT + 3] = 0.0
    bodies[CAGE_BODY:, ANGULAR : ANGULAR + 3] = [0.2, 0.0, -0.1]

    def angular_momentum(body: int) -> Float:
        state = bodies[body]
        axis = naive_step.rotated(state[TILT : TILT + 3], np.array([0.0, 1.0, 0.0]))
        transverse = state[ANGULAR : ANGULAR + 3]
        result: Float = cage.polar_inertia * state[RATE] * axis + cage.transverse_inertia * transverse
        return result

    before = [angular_momentum(body) for body in (2, 3)]
    first = bodies[2, ANGULAR : ANGULAR + 3].copy()
    rig.run(1000)
    size = cage.transverse_inertia * float(np.linalg.norm(first))
    turned = math.acos(
        float(first @ bodies[2, ANGULAR : ANGULAR + 3])
        / float(np.linalg.norm(first) * np.linalg.norm(bodies[2, ANGULAR : ANGULAR + 3]))
    )
    rate = cage.polar_inertia / cage.transverse_inertia * float(bodies[2, RATE])
    assert turned == pytest.approx(rate * 1000 * rig.parameters.step, rel=1e-2)
    for body, old in zip((2, 3), before, strict=True):
        assert np.linalg.norm(angular_momentum(body) - old) < 2e-3 * size
