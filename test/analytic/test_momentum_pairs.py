"""Every contact acts on roller and ring with one and the same force, and no force makes energy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    CAGE_BODY,
    CHANGE,
    CONE_BODY,
    CUP_BODY,
    ENERGY_LOST,
    LINEAR,
    RATE,
    TILT,
    TURN,
)
from beardyn_core.physics.bodies.losses import LOSSES
from test.kernels.momentum import assert_momentum_is_exchanged
from test.kernels.naive_step import rotated
from test.kernels.rig import Rig
from test.kernels.states import shaken

Float = NDArray[np.float64]
FAR = 1.0
CONTACTS = ("all", "cup", "cone", "rib", "pocket")


def only_contact(rig: Rig, name: str) -> None:
    """Take the other contacts so far away that they never touch; same kernel, other numbers."""
    p = rig.parameters
    assert p.effects.rib is not None
    assert p.effects.cage is not None
    rib, cage = p.effects.rib, p.effects.cage
    if name not in ("cup", "all"):
        p = p._replace(cup=p.cup._replace(gap=FAR))
    if name not in ("cone", "all"):
        p = p._replace(cone=p.cone._replace(gap=FAR))
    if name not in ("rib", "all"):
        rib = rib._replace(distance=rib.distance + FAR)
    if name not in ("pocket", "all"):
        cage = cage._replace(half_clearance=FAR, half_end_clearance=FAR)
    rig.parameters = p._replace(effects=p.effects._replace(rib=rib, cage=cage))


@pytest.mark.parametrize("contact", CONTACTS)
@pytest.mark.parametrize("seed", [11, 12, 13])
def test_force_and_moment_on_rollers_and_rings_vanish_in_sum(contact: str, seed: int) -> None:
    """Momentum won by the rollers in a step is what the rings lost, less the weight, to rounding."""
    rig = shaken(seed)
    only_contact(rig, contact)
    assert_momentum_is_exchanged(rig)


@pytest.mark.parametrize("seed", [21, 22])
def test_rings_move_by_the_force_they_are_said_to_get(seed: int) -> None:
    """Cone: rollers and load over the journal's mass; cages: pockets and weight; the cup is held."""
    rig = shaken(seed)
    bodies = rig.state.bodies
    before = bodies.copy()
    rig.run(1)
    p, h = rig.parameters, rig.parameters.step
    assert p.effects.cage is not None
    change = (bodies - before)[:, LINEAR : LINEAR + 3]
    force = rig.work.wrenches[:, :3]
    expected = h * (force[CONE_BODY] + rig.load[:3]) / p.mounting.journal_mass
    np.testing.assert_allclose(change[CONE_BODY], expected, rtol=1e-9, atol=1e-15)
    pull = np.array([0.0, 0.0, -p.effects.cage.mass * 9.80665])
    for body in (CAGE_BODY, CAGE_BODY + 1):
        np.testing.assert_allclose(
            change[body], h * (force[body] + pull) / p.effects.cage.mass, rtol=1e-9, atol=1e-14
        )
    spun = (bodies - before)[:, RATE]
    cage = p.effects.cage
    for body in (CAGE_BODY, CAGE_BODY + 1):
        axis = rotated(bodies[body, TILT : TILT + 3], np.array([0.0, 1.0, 0.0]))
        moment = rig.work.wrenches[body, 3:]
        about = float(moment @ axis)
        assert spun[body] == pytest.approx(h * about / cage.polar_inertia, rel=1e-5, abs=1e-15)
        # Euler: I_t w' = M - about axis - w x (I_p rate y)
        spin = np.array([0.0, cage.polar_inertia * before[body, RATE], 0.0])
        # one axis after the other: z meets the turn about x that the step has just given
        met = before[body, ANGULAR : ANGULAR + 3].copy()
        met[0] = bodies[body, ANGULAR]
        gyroscopic = np.cross(met, spin)
        expected = h * (moment - about * axis - gyroscopic) / cage.transverse_inertia
        turned = bodies[body, ANGULAR : ANGULAR + 3] - before[body, ANGULAR : ANGULAR + 3]
        np.testing.assert_allclose(turned[[0, 2]], expected[[0, 2]], rtol=1e-5, atol=1e-9)
    np.testing.assert_array_equal(bodies[CUP_BODY, :CHANGE], 0.0)
    assert bodies[CONE_BODY, RATE] == rig.load[6]
    assert bodies[CONE_BODY, TURN] == pytest.approx(before[CONE_BODY, TURN] + h * before[CONE_BODY, RATE])


def losses(rig: Rig, steps: int) -> Float:
    """Energy dissipated in each step, [J]."""
    spent = []
    for _ in range(steps):
        before = rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].sum()
        rig.run(1)
        spent.append(rig.state.energy[ENERGY_LOST : ENERGY_LOST + LOSSES].sum() - before)
    return np.array(spent)


@pytest.mark.parametrize("contact", ["cup", "cone", "rib"])
@pytest.mark.parametrize("seed", [31, 32, 33])
def test_raceways_and_rib_lose_energy_in_every_step(contact: str, seed: int) -> None:
    """Linearly implicit: the loss of a step is a sum of squares."""
    rig = shaken(seed)
    only_contact(rig, contact)
    rig.state.energy[:] = 0.0
    spent = losses(rig, 20)
    assert np.all(spent >= 0.0)
    assert spent[0] > 0.0


@pytest.mark.parametrize("seed", [41, 42])
def test_pockets_lose_energy_in_the_long_run_and_nearly_always(seed: int) -> None:
    """Explicit: a step that turns a velocity round may book a small gain, never more than it loses around."""
    rig = shaken(seed)
    only_contact(rig, "pocket")
    rig.state.energy[:] = 0.0
    spent = losses(rig, 200)
    assert spent.sum() > 0.0
    assert -spent[spent < 0.0].sum() < 0.01 * spent.sum()


def test_whole_bearing_loses_energy_in_every_step() -> None:
    rig = Rig.at_equilibrium(shaken(1).scene)
    spent: Any = losses(rig, 300)
    assert np.all(spent > 0.0)
