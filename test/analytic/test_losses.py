"""Rolling resistance, drag and seals in the whole step: pairs, losses, signs, and the bearing sum."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from beardyn_core.effects import Drag, EffectSet, LineFilm, RollingResistance, Seal
from beardyn_core.effects.rolling_resistance import RollingKind
from beardyn_core.physics.bodies.layout import (
    CAGE_BODY,
    CONE,
    CONE_BODY,
    CONTACT_OUTPUT,
    CUP,
    CUP_BODY,
    ENERGY_LOST,
    LOSS_DRAG,
    LOSS_ROLLING,
    LOSS_SEAL,
    OUTPUT_FIELDS,
    POSITION,
    ROLLER_STATES,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
)
from beardyn_core.physics.bodies.losses import LOSSES
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.statics.torque import running_torque
from test.kernels.momentum import momenta, world
from test.kernels.rig import Rig
from test.kernels.states import cartesian, shaken
from test.scenes import LOAD_80_KN, SPEED, scene_with

Float = NDArray[np.float64]
LOSSY = replace(
    EffectSet(),
    film=LineFilm(supply="flooded"),
    rolling_resistance=RollingResistance(),
    drag=Drag(),
    seal=Seal(),
)
SOURCES = (LOSS_ROLLING, LOSS_DRAG, LOSS_SEAL)


def lossy(speed: float = SPEED, effects: EffectSet = LOSSY) -> Rig:
    return Rig.at_equilibrium(scene_with(effects), speed=speed)


def lossy_shaken(seed: int) -> Rig:
    rig, other = lossy(), shaken(seed)
    rig.state.rollers[:] = other.state.rollers
    rig.state.bodies[:] = other.state.bodies
    return rig


def lost_per_step(rig: Rig, steps: int) -> Float:
    """Energy lost by source in each step, shape [step, LOSSES], [J]."""
    spent = np.zeros((steps, LOSSES))
    for step in range(steps):
        before = rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].copy()
        rig.run(1)
        spent[step] = rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES] - before
    return spent


@pytest.mark.parametrize("seed", [11, 12, 13])
def test_force_and_moment_on_rollers_and_rings_vanish_in_sum(seed: int) -> None:
    """With the medium on the cup and the seals between cup and cone; to rounding."""
    rig = lossy_shaken(seed)
    p = rig.parameters
    assert p.effects.cage is not None
    assert p.effects.gravity is not None
    linear_before, angular_before, size = momenta(rig)
    rig.run(1)
    linear_after, angular_after, _ = momenta(rig)
    wrenches, bodies = rig.work.wrenches, rig.state.bodies
    force, moment = np.zeros(3), np.zeros(3)
    for body in range(4):
        lift = np.array([0.0, p.effects.cage.place * (1.0 if body == 3 else -1.0), 0.0])
        place = bodies[body, POSITION : POSITION + 3] + (lift if body >= CAGE_BODY else 0.0)
        force += wrenches[body, :3]
        moment += wrenches[body, 3:] + np.cross(place, wrenches[body, :3])
    pull = np.array([0.0, 0.0, -p.roller.mass * p.effects.gravity.acceleration])
    fields = rig.fields()[:ROLLER_STATES]
    gravity, torque = np.zeros(3), np.zeros(3)
    for row in (0, 1):
        for k in range(fields.shape[2]):
            gravity += pull
            place = world(cartesian(fields[:, row, k]).centre, row)
            torque += np.cross(place + bodies[CUP_BODY, POSITION : POSITION + 3], pull)
    rounding = 1e-12 * size
    assert np.abs(linear_after - linear_before - p.step * gravity + p.step * force).max() < rounding
    won = angular_after - angular_before - p.step * torque
    assert np.abs(won + p.step * moment).max() < rounding * 0.1


@given(seed=st.integers(0, 2**31 - 1))
@settings(max_examples=20, deadline=None)
def test_no_source_ever_makes_energy(seed: int) -> None:
    spent = lost_per_step(lossy_shaken(seed), 5)[:, SOURCES]
    assert np.all(spent > 0.0)


def test_losses_brake_the_shaft_in_either_sense() -> None:
    """Mirror images: the first step loses the same, the torque turns its sign."""
    forward, backward = lossy(), lossy(-SPEED)
    ahead, _, _ = forward.run(40)
    astern, _, _ = backward.run(40)
    assert ahead[:, SIGNAL_TORQUE].mean() < -10.0
    assert astern[:, SIGNAL_TORQUE].mean() == pytest.approx(-ahead[:, SIGNAL_TORQUE].mean(), rel=1e-3)
    lost = slice(ENERGY_LOST, ENERGY_LOST + LOSSES)
    for source in SOURCES:
        assert backward.state.energy[lost][source] == pytest.approx(
            forward.state.energy[lost][source], rel=1e-3
        )


def test_a_bearing_at_rest_stays_finite_and_loses_nothing_in_seals_and_drag() -> None:
    rig = lossy(0.0)
    signals, _, _ = rig.run(100)
    assert np.isfinite(signals).all()
    lost = rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES]
    assert lost[LOSS_SEAL] == 0.0
    assert 0.0 <= lost[LOSS_DRAG] < 1e-9
    assert 0.0 <= lost[LOSS_ROLLING] < 1e-3


def test_seals_take_their_torque_from_the_shaft_and_not_from_the_rollers() -> None:
    """Both seals: 2 (0.3 + 5e-4 x 122) N m; the force channel is that of rollers and medium on the cup."""
    seal = replace(LOSSY, seal=Seal(torque=30.0, speed_coefficient=0.0))
    light, heavy = lossy(), lossy(effects=seal)
    first, _, _ = light.run(1)
    second, _, _ = heavy.run(1)
    added = second[0, SIGNAL_TORQUE] - first[0, SIGNAL_TORQUE]
    stiff = Seal().stiffening(light.scene.lubricant.kinematic_viscosity(light.scene.temperature))
    assert added == pytest.approx(-stiff * (60.0 - 2.0 * (0.3 + 5e-4 * SPEED)), rel=1e-5)
    wrench = slice(SIGNAL_FORCE, SIGNAL_FORCE + 6)
    np.testing.assert_allclose(second[0, wrench], first[0, wrench], rtol=1e-12, atol=1e-9)
    pair = heavy.work.wrenches[:, 4] - light.work.wrenches[:, 4]
    assert pair[CUP_BODY] == pytest.approx(-pair[CONE_BODY], rel=1e-9)


@pytest.mark.parametrize("kind", ["aihara", "zhou_hoeprich"])
def test_rolling_loss_is_the_bearing_sum_of_the_couples(kind: RollingKind) -> None:
    """T = sum (1/Dm)(R_o T_i + R_i T_o), Zhao et al. (2026), with the loads of the step.

    0.3 %: the kernel takes the contact at the centre of mass, 0.9 mm from mid-length, and the cosine of
    the roller's half angle.
    """
    rig = lossy(effects=replace(LOSSY, rolling_resistance=RollingResistance(kind=kind)))
    spent = lost_per_step(rig, 1)[0, LOSS_ROLLING]
    scene, fields = rig.scene, rig.fields()
    loads = []
    for contact in (CUP, CONE):
        first = CONTACT_OUTPUT + contact * OUTPUT_FIELDS
        loads.append(np.linalg.norm(fields[first : first + 3], axis=0))
    static = solve(scene.bearing, LOAD_80_KN, end_play=scene.end_play, laminae=6, speed=SPEED)
    static = replace(static, cup_load=loads[0], cone_load=loads[1])
    expected = running_torque(
        scene.bearing,
        scene.lubricant,
        scene.temperature,
        static,
        SPEED,
        resistance=RollingResistance(kind=kind),
    ).rolling
    assert spent / rig.parameters.step / SPEED == pytest.approx(expected, rel=3e-3)
