"""Every contact acts on roller and ring with one and the same force, and no force makes energy."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.config import load_any_bearing
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    AXIAL,
    CAGE_BODY,
    CHANGE,
    CONE_BODY,
    CUP_BODY,
    ENERGY_LOST,
    LINEAR,
    RATE,
    ROLLER_STATES,
    TILT,
    TURN,
)
from beardyn_core.physics.bodies.losses import LOSSES
from beardyn_core.scene.scene import Scene
from test.kernels.momentum import assert_momentum_is_exchanged
from test.kernels.naive_step import rotated
from test.kernels.rig import Rig
from test.kernels.states import shaken
from test.scenes import standard_scene

Float = NDArray[np.float64]
FAR = 1.0
CONTACTS = ("all", "cup", "cone", "rib", "pocket")
RIBS = ("cone_outer", "cone_inner", "cup_outer", "cup_inner")


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


@cache
def cylinders() -> Scene:
    """A pair with ribs on both sides of both rings, and little play, so that shaken rollers touch all."""
    bearing = load_any_bearing("WJ130x240")
    assert isinstance(bearing, CylindricalBearing)
    bearing = replace(bearing, cone_ribs="both", roller_play=2e-5, end_play=4e-5)
    return replace(standard_scene(), bearing=bearing, end_play=bearing.end_play)


def only_contact_of_cylinders(rig: Rig, name: str) -> None:
    """Take the other contacts far away, and each rib but the named one."""
    p = rig.parameters
    flanges, cage = p.effects.flanges, p.effects.cage
    assert flanges is not None
    assert cage is not None
    if name not in ("cup", "all"):
        p = p._replace(cup=p.cup._replace(gap=FAR))
    if name not in ("cone", "all"):
        p = p._replace(cone=p.cone._replace(gap=FAR))
    for each in RIBS:
        if name not in (each, "all"):
            flange = getattr(flanges, each)
            rib = flange.rib._replace(distance=flange.rib.distance + FAR)
            flanges = flanges._replace(**{each: flange._replace(rib=rib)})
    if name not in ("pocket", "all"):
        cage = cage._replace(half_clearance=FAR, half_end_clearance=FAR)
    rig.parameters = p._replace(effects=p.effects._replace(flanges=flanges, cage=cage))


@pytest.mark.parametrize("contact", ["all", "cup", "cone", *RIBS, "pocket"])
@pytest.mark.parametrize("seed", [51, 52, 53])
def test_force_and_moment_on_cylinders_and_rings_vanish_in_sum(contact: str, seed: int) -> None:
    """The same of each rib of each ring, about the world's origin, raceways and pockets."""
    rig = shaken(seed, scene=cylinders())
    fields = rig.fields()[:ROLLER_STATES]
    shape = fields.shape[1:]
    fields[AXIAL] += np.random.default_rng(seed).normal(0.0, 3e-5, shape)
    rig.set_fields(fields)
    only_contact_of_cylinders(rig, contact)
    assert_momentum_is_exchanged(rig)
    if contact in RIBS:  # the ring that has the rib is pushed along, the other is left alone
        pushed, idle = (CONE_BODY, CUP_BODY) if contact.startswith("cone") else (CUP_BODY, CONE_BODY)
        assert np.linalg.norm(rig.work.wrenches[pushed, :3]) > 10.0
        assert np.linalg.norm(rig.work.wrenches[idle, :3]) < 1e-9


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
