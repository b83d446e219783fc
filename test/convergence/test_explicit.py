"""The explicit step, which references are made with: the implicit one tends to it, and its trap shows."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from beardyn_core.physics.bodies.layout import (
    MOMENTUM,
    SIGNAL_FORCE,
    SIGNAL_TORQUE,
    VELOCITY,
)
from beardyn_core.physics.lanes.solve import inertia_matrix
from beardyn_core.physics.tiers.parameters import ExplicitParams
from beardyn_core.physics.tiers.roller import velocity_change
from beardyn_core.physics.tiers.status import LARGEST_CHATTER_INDEX, chatter_index
from beardyn_core.sensors.block import EnergyAudit
from test.kernels.momentum import assert_momentum_is_exchanged
from test.kernels.rig import Float, Rig
from test.kernels.states import shaken
from test.kernels.test_step import assert_step_is_that_of_dense_algebra
from test.scenes import SPEED, scene_with

SHORT, TINY = 2.0e-4, 1.0e-12


def rig_of(integrator: str, steps: int, load: float = 6.0e4, speed: float = SPEED) -> Rig:
    scene = scene_with(steps_per_sample=steps)
    scene = replace(scene, numerics=replace(scene.numerics, integrator=integrator))
    return Rig.at_equilibrium(scene, (0.0, 0.0, load), speed)


def explicit_and_shaken(seed: int, steps: int = 4) -> Rig:
    scene = scene_with(steps_per_sample=steps)
    return shaken(seed, scene=replace(scene, numerics=replace(scene.numerics, integrator="explicit")))


def test_explicit_contacts_keep_the_force_of_the_beginning() -> None:
    """No change of velocity is handed to the contacts; the implicit step solves for one."""
    matrix = inertia_matrix(2.0, 3.0, 5.0, (0.0, 0.0, 1.0), 0.0)
    right = (4.0, 6.0, 8.0, 5.0, 10.0, 9.0)
    assert velocity_change(matrix, right, 0.0, ExplicitParams(391.0)) == ((0.0,) * 3, (0.0,) * 3)
    assert velocity_change(matrix, right, 0.0, None) == ((2.0, 3.0, 4.0), (1.0, 2.0, 3.0))


@cache
def end_of_short_run(integrator: str, steps: int) -> dict[str, Float]:
    """0.2 ms from equilibrium: forces on the rings averaged, velocities at the end."""
    rig = rig_of(integrator, steps)
    signals, _, _ = rig.run(round(SHORT / rig.parameters.step))
    rollers = rig.state.rollers
    return {
        "velocity": rollers[:, VELOCITY : VELOCITY + 3].copy(),
        "momentum": rollers[:, MOMENTUM : MOMENTUM + 3].copy(),
        "torque": signals[:, SIGNAL_TORQUE].mean(keepdims=True),
        "force": signals[:, SIGNAL_FORCE : SIGNAL_FORCE + 3].mean(axis=0),
    }


@pytest.mark.slow
@pytest.mark.parametrize("quantity", ["velocity", "momentum", "torque", "force"])
def test_explicit_and_implicit_steps_meet_as_the_step_goes_to_zero(quantity: str) -> None:
    """Both are of first order: at 0.1, 0.05 and 0.025 us the difference halves every time."""
    gaps = []
    for steps in (400, 800, 1600):
        explicit, implicit = (end_of_short_run(kind, steps) for kind in ("explicit", "implicit"))
        gaps.append(float(np.abs(explicit[quantity] - implicit[quantity]).max()))
    size = float(np.abs(end_of_short_run("implicit", 1600)[quantity]).max())
    assert gaps[0] < 1e-3 * size
    for coarse, fine in pairwise(gaps):
        assert fine == pytest.approx(0.5 * coarse, rel=0.15, abs=TINY * size)


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_explicit_step_of_every_roller_is_that_of_dense_algebra(seed: int) -> None:
    assert_step_is_that_of_dense_algebra(explicit_and_shaken(seed))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [11, 12])
def test_explicit_forces_on_rollers_and_rings_vanish_in_sum(seed: int) -> None:
    assert_momentum_is_exchanged(explicit_and_shaken(seed))


@cache
def heavy_run(integrator: str, steps: int) -> tuple[Float, float, EnergyAudit]:
    """5 ms at 150 kN after as many from equilibrium: torque at every step, chatter index, energy audit."""
    rig = rig_of(integrator, steps, 1.5e5, 180.0)
    count = round(5e-3 / rig.parameters.step)
    rig.run(count)
    signals, _, _ = rig.run(count)
    begun = rig.audit.copy()  # of the first step of a run
    chatter = float(chatter_index(rig.state, count).max())
    rig.run(1)
    return signals[:, SIGNAL_TORQUE], chatter, EnergyAudit.of(rig.audit - begun)


@pytest.mark.slow
def test_energy_of_an_explicit_reference_is_accounted_for() -> None:
    _, _, audit = heavy_run("explicit", 391)
    assert abs(audit.residual) < 1e-3


@pytest.mark.slow
def test_an_explicit_step_as_long_as_the_production_one_is_finite_right_in_the_mean_and_flips() -> None:
    """9.8 us at 150 kN: whoever looks at every second step misses it, the monitor looks at every one."""
    calm, quiet, _ = heavy_run("explicit", 391)
    wild, chatter, _ = heavy_run("explicit", 4)
    assert wild.mean() == pytest.approx(calm.mean(), rel=0.02)
    assert wild.std() > 20.0 * calm.std()
    assert wild[::2].std() < 0.1 * wild.std()
    assert quiet < LARGEST_CHATTER_INDEX < chatter


@pytest.mark.slow
def test_the_implicit_step_of_that_length_does_not() -> None:
    calm, _, _ = heavy_run("explicit", 391)
    implicit, chatter, _ = heavy_run("implicit", 4)
    assert implicit.mean() == pytest.approx(calm.mean(), rel=5e-3)
    assert implicit.std() == pytest.approx(calm.std(), rel=0.2)
    assert chatter < LARGEST_CHATTER_INDEX
