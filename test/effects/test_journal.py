"""A wheelset that bends in the twin: beam theory at rest, frequencies, balances, tiers side by side."""

from __future__ import annotations

from dataclasses import replace
from functools import cache, partial

import numpy as np
import pytest
from scipy.linalg import eigh

from beardyn_core.base.errors import InputError
from beardyn_core.base.jit import entry
from beardyn_core.choice import scene_from_text
from beardyn_core.choice.fast_step import fast_steps, fastest_mode
from beardyn_core.choice.ringing import bounce, levels
from beardyn_core.config.nouns import load_vehicle
from beardyn_core.effects import EffectSet
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    BODY_STATES,
    CONE_BODY,
    CUP_BODY,
    ENERGY_EXTERNAL,
    ENERGY_LOST,
    LINEAR,
    LOSS_SUSPENSION,
    POSITION,
    SIGNAL_ACCELERATION,
    TILT,
)
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.journal import (
    ALONG,
    PLACE,
    SPEED,
    UPRIGHT,
    JournalParams,
    bending_give,
    journal_params,
    kick_journal,
    modes_of,
)
from beardyn_core.physics.roller_spring import lever_of_cup, roller_tangent
from beardyn_core.physics.statics.equilibria import equilibrium
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.suspension import mounting_params
from beardyn_core.physics.tiers.step_choice import choose_steps
from beardyn_core.rail.build import load_history
from beardyn_core.rail.wheelset import HALF_GAUGE, SHEAR, YOUNG, bending, shaft
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.wheelset import Wheelset
from beardyn_core.twin import Twin
from test.kernels.momentum import assert_momentum_is_exchanged
from test.kernels.rig import Float, Rig
from test.kernels.states import shaken
from test.runs import constant_load, started, stepped_load
from test.scenes import rigid_scene

LOAD = (0.0, 0.0, 6.7e4)
SPEED_OF_SHAFT = 120.0
LONG_STEPS = """
scene: long
bearing: HS130x230
lubricant: L055
operation:
  kind: quarter_vehicle
  vehicle: emu_300
  speed_profile: [{time_s: 0, speed_kmh: 200}]
  wheelset: coupled
tier: lumped
numerics: {steps_per_sample: 0.5}
"""


@cache
def scene_on(wheelset: str, tier: str = "full") -> Scene:
    """The smooth run, its wheelset as said, its bearing as drawn, without what a step does not need."""
    scene = rigid_scene("smooth_run", tier=tier)
    operation = scene.operation
    assert isinstance(operation, QuarterVehicleOperation)
    steps = max(scene.numerics.steps_per_sample, 1)  # a coupled wheelset is refused longer ones
    numerics = replace(scene.numerics, steps_per_sample=steps)
    return replace(
        scene,
        effects=EffectSet(),
        operation=replace(operation, wheelset=wheelset),
        numerics=numerics,
        scatter=None,
    )


def axle_of(step: float = 1e-6, rest: Float | None = None) -> JournalParams:
    found = journal_params(scene_on("coupled"), step, np.zeros(6) if rest is None else rest)
    assert found is not None
    return found


def compliance(place: Float, slope: Float, square: Float) -> Float:
    """Displacement and tilt by force and moment, shape [2, 2]."""
    shapes = np.stack([place, slope])
    return np.asarray((shapes / square) @ shapes.T)


def test_force_and_moment_at_the_journal_bend_an_even_axle_as_in_the_textbook() -> None:
    """Gere and Timoshenko: a cantilever, at whose root the axle between heavy wheels turns by M b / E I.

    With the shear of a cantilever; a consistent beam has no other error at its nodes than that of leaving out
    modes, which the further shapes make up for.
    """
    diameter, arm = 0.16, 1.0
    even = Wheelset(diameter, diameter, diameter, diameter)
    half = shaft(even, 1.0e6, 0.46, arm)
    modes = bending(half, 1.0e6, symmetric=True)
    few = modes.condense(1500.0, ("wheel", "journal", "journal_slope"))
    assert len(few) < 12
    rigidity = YOUNG * np.pi / 64.0 * diameter**4
    area, share = 0.25 * np.pi * diameter**2, 6.0 * 1.3 / (7.0 + 6.0 * 0.3)
    a, b = arm - HALF_GAUGE, HALF_GAUGE
    expected = (
        np.array([[a**3 / 3.0 + a * a * b, a * a / 2.0 + a * b], [a * a / 2.0 + a * b, a + b]]) / rigidity
    )
    expected[0, 0] += a / (share * SHEAR * area)
    square = few.mass * (2.0 * np.pi * few.frequency) ** 2
    found = compliance(few.journal, few.journal_slope, square)
    np.testing.assert_allclose(found, expected, rtol=0.01)


def test_few_modes_of_a_wheelset_yield_as_all_of_them() -> None:
    """What the twin carries, beside all 94 of the beam, under force and moment at the journal."""
    scene = scene_on("coupled")
    few = modes_of(scene)
    operation = scene.operation
    assert few is not None
    assert isinstance(operation, QuarterVehicleOperation)
    vehicle, mounting = operation.vehicle, scene.mounting
    assert vehicle.wheelset is not None
    arm = 0.5 * vehicle.guidance.axlebox_spacing
    half = shaft(vehicle.wheelset, mounting.journal_mass, 0.46, arm, scene.bearing.cone_mass)
    every = bending(half, mounting.journal_mass + scene.bearing.cone_mass, symmetric=True)
    here, there = (
        compliance(each.journal, each.journal_slope, each.mass * (2.0 * np.pi * each.frequency) ** 2)
        for each in (few, every)
    )
    np.testing.assert_allclose(here, there, rtol=1e-6)


@entry
def _kick(bodies, axle, wrenches, loads, energy, step, mounting, stored):
    for n in range(wrenches.shape[0]):
        for i in range(3):
            bodies[CONE_BODY, POSITION + i] += step * bodies[CONE_BODY, LINEAR + i]
            bodies[CONE_BODY, TILT + i] += step * bodies[CONE_BODY, ANGULAR + i]
        _, stored[n] = kick_journal(
            bodies, axle, wrenches[n], loads[n], energy, step, mounting, mounting.journal
        )


def naive(
    p: JournalParams, mass: float, wrenches: Float, loads: Float, step: float
) -> tuple[Float, Float, float]:
    """Rigid body and modes apart, dense: pose of the cone, works, elastic energy at last."""
    count = len(p.place)
    place, velocity = np.zeros((2, count)), np.zeros((2, count))
    rigid, speed = np.zeros(3), np.zeros(3)
    external, lost, stored = 0.0, 0.0, 0.0
    for wrench, load in zip(wrenches, loads, strict=True):
        rigid += step * speed
        place += step * velocity
        stored = 0.5 * float((p.stiffness * place**2).sum()) + float((p.rest * place).sum())
        # upright: along z, about x; along the track: along x, about z, where a tilt takes the end backwards
        pushed = np.outer([wrench[2], wrench[0]], p.place) + np.outer([wrench[3], -wrench[5]], p.slope)
        driven = np.outer([load[2], load[0]], p.wheel)
        change = step * (pushed + driven - p.rest - p.stiffness * place - p.damping * velocity) / p.inertia
        middle = velocity + 0.5 * change
        external += step * float((driven * middle).sum())
        lost += step * float((p.damping * middle**2).sum())
        velocity = velocity + change
        gained = step * (wrench[:3] + load[:3]) / mass
        external += step * float(load[:3] @ (speed + 0.5 * gained))
        speed = speed + gained
    moved = rigid + np.array([p.place @ place[ALONG], 0.0, p.place @ place[UPRIGHT]])
    tilted = np.array([p.slope @ place[UPRIGHT], 0.0, -p.slope @ place[ALONG]])
    return np.concatenate([moved, tilted]), np.array([external, lost]), stored


def test_the_cone_moves_as_rigid_body_and_modes_apart() -> None:
    """400 steps under random forces: to rounding."""
    scene, step, rng = scene_on("coupled"), 2e-6, np.random.default_rng(4)
    rest = rng.normal(0.0, 1e3, 6)
    p = axle_of(step, rest)
    mounting = mounting_params(scene.bearing, scene.mounting, np.zeros(6), None, p)
    wrenches, loads = rng.normal(0.0, 1e4, (400, 6)), rng.normal(0.0, 1e4, (400, 10))
    wrenches[:, 3:] *= 0.05
    bodies, energy, stored = np.zeros((4, BODY_STATES)), np.zeros(ENERGY_TERMS), np.zeros(len(loads))
    loads[:, 6] = 0.0
    axle = np.zeros((2, 2, len(p.place)))
    _kick(bodies, axle, wrenches, loads, energy, step, mounting, stored)
    pose, works, elastic = naive(p, mounting.journal_mass, wrenches, loads, step)
    found = bodies[CONE_BODY, POSITION : POSITION + 6]
    np.testing.assert_allclose(found, pose, rtol=1e-9, atol=1e-9 * np.abs(pose).max())
    assert energy[ENERGY_EXTERNAL] == pytest.approx(works[0], rel=1e-9)
    assert energy[ENERGY_LOST + LOSS_SUSPENSION] == pytest.approx(works[1], rel=1e-9)
    assert stored[-1] == pytest.approx(elastic, rel=1e-9)


def bent(seed: int) -> Rig:
    """A disturbed bearing on an axle that rings."""
    rig = shaken(seed, 8, scene_on("coupled"))
    rng = np.random.default_rng(seed)
    rig.state.axle[SPEED] = rng.normal(0.0, 0.01, rig.state.axle[SPEED].shape)
    rig.state.axle[PLACE] = rng.normal(0.0, 1e-6, rig.state.axle[PLACE].shape)
    return rig


def rigid_speed(rig: Rig) -> Float:
    """Velocity of the half wheelset without what bending adds to that of the cone."""
    p = rig.parameters.mounting.journal
    assert p is not None
    speeds = rig.state.axle[SPEED] @ p.place
    linear = rig.state.bodies[CONE_BODY, LINEAR : LINEAR + 3]
    return np.asarray(linear - np.array([speeds[ALONG], 0.0, speeds[UPRIGHT]]))


@pytest.mark.parametrize("seed", [11, 12])
def test_momentum_is_exact_on_an_axle_that_rings(seed: int) -> None:
    """Rollers win what the rings lose; modes have no momentum, so the rigid half wheelset takes all of it."""
    rig = bent(seed)
    before = rigid_speed(rig)
    assert_momentum_is_exchanged(rig)
    p = rig.parameters
    force = rig.work.wrenches[CONE_BODY, :3] + rig.load[:3]
    expected = p.step * force / p.mounting.journal_mass
    np.testing.assert_allclose(rigid_speed(rig) - before, expected, rtol=1e-9, atol=1e-15)


def test_energy_balance_closes_on_an_axle_that_rings() -> None:
    """A fifth of a second with a load that swings: 3e-5 of the losses, as with the modes of a box."""
    points = [
        (0.005 * n, (2e3 * (-1.0) ** n, 0.0, 6.7e4 + 1e4 * (-1.0) ** n), SPEED_OF_SHAFT) for n in range(60)
    ]
    twin = started(scene_on("coupled"), stepped_load(points))
    for _ in range(10):
        block = twin.advance()
    assert block.audit is not None
    assert block.status == 0
    state = twin._state
    assert state is not None
    assert np.abs(state.axle[SPEED]).max() > 1e-3
    assert block.audit.residual < 3e-5


def deflected(tier: str) -> tuple[Float, Float]:
    """How far cone and cup move and tilt when the load grows by 20 kN upright and 5 kN along, shape [6]."""
    points = [
        (0.0, LOAD, SPEED_OF_SHAFT),
        (0.05, LOAD, SPEED_OF_SHAFT),
        (0.15, (5e3, 0.0, 8.7e4), SPEED_OF_SHAFT),
        (1.0, (5e3, 0.0, 8.7e4), SPEED_OF_SHAFT),
    ]
    scene = scene_on("coupled", tier)
    twin = started(
        replace(scene, mounting=replace(scene.mounting, damping=(2e5, 2e5, 2e5))), stepped_load(points)
    )
    first = None
    poses = []
    for index in range(40):
        twin.advance()
        state = twin._state
        assert state is not None
        if index == 1:
            first = state.axle[PLACE].copy()
        if index >= 30:
            poses.append(state.axle[PLACE].copy())
    p = axle_of()
    assert first is not None
    change = np.mean(poses, axis=0) - first
    return change @ p.place, change @ p.slope


@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
def test_the_journal_yields_in_fast_tiers_as_in_full(tier: str) -> None:
    """Within 1 % of how far it bends when the load changes, upright and along the track."""
    np.testing.assert_allclose(deflected(tier), deflected("full"), rtol=0.01, atol=2e-8)


def springs_of_rollers(scene: Scene) -> Float:
    """Stiffness of the bearing at rest from the load of each roller, x, y, z, about x, about z."""
    bearing = scene.bearing
    static = solve(
        bearing,
        LOAD,
        end_play=scene.end_play,
        tilt="free",
        laminae=scene.numerics.laminae,
        speed=SPEED_OF_SHAFT,
    )
    sine, cosine, lever = np.sin(bearing.cup_angle), np.cos(bearing.cup_angle), lever_of_cup(bearing)
    total = np.zeros((5, 5))
    for row, side in enumerate((-1.0, 1.0)):
        for k, load in enumerate(static.cone_load[row]):
            psi = 2.0 * np.pi * k / bearing.roller_count
            s, c = np.sin(psi), np.cos(psi)
            pull = np.array([cosine * s, -side * sine, cosine * c, side * lever * c, -side * lever * s])
            total += roller_tangent(bearing) * load**0.1 * (load > 0.0) * np.outer(pull, pull)
    return total


def frequencies(scene: Scene) -> tuple[Float, Float]:
    """Of the box upright on bearing and axle, undamped, [Hz]; and how far the box takes part, [1/kg]."""
    p = axle_of()
    bearing, mounting = scene.bearing, scene.mounting
    count = len(p.place)
    box = [*[mounting.box_mass + bearing.cup_mass] * 3]
    box += [
        mounting.box_inertia[0] + bearing.cup_inertia[0],
        mounting.box_inertia[2] + bearing.cup_inertia[2],
    ]
    wheelset = [mounting.journal_mass + bearing.cone_mass] * 3
    motion = np.zeros((5, 8 + 2 * count))  # of the cone against the cup
    motion[:, :5] = -np.eye(5)
    motion[:3, 5:8] = np.eye(3)
    upright, along = slice(8, 8 + count), slice(8 + count, None)
    motion[2, upright], motion[3, upright] = p.place, p.slope
    motion[0, along], motion[4, along] = p.place, -p.slope
    stiffness = motion.T @ springs_of_rollers(scene) @ motion
    stiffness[upright, upright] += np.diag(p.stiffness)
    stiffness[along, along] += np.diag(p.stiffness)
    held = [*mounting.stiffness, mounting.rotational_stiffness[0], mounting.rotational_stiffness[2]]
    stiffness[:5, :5] += np.diag(held)
    square, shapes = eigh(stiffness, np.diag(np.concatenate([box, wheelset, np.ones(2 * count)])))
    return np.sqrt(np.maximum(square, 0.0)) / (2.0 * np.pi), shapes[2] ** 2


def ring_down(twin: Twin) -> tuple[Float, Float]:
    """Spectrum of the box upright after it has been knocked upwards, [Hz]."""
    state = twin._state
    assert state is not None
    state.bodies[CUP_BODY, LINEAR + 2] += 2e-3
    signal = []
    for _ in range(10):
        twin.advance()
        here = twin.step_signals[: len(twin.step_signals) // twin.blocks_at_once]
        signal.append(here[:, SIGNAL_ACCELERATION + 2].copy())
    found = np.concatenate(signal)
    rate = len(found) / 0.2
    window = np.hanning(2 * len(found))[len(found) :]
    level = np.abs(np.fft.rfft(found * window, 8 * len(found)))
    return np.fft.rfftfreq(8 * len(found), 1.0 / rate).astype(np.float64), level


@pytest.mark.parametrize("tier", ["quasistatic", "lumped"])
def test_the_box_bounces_on_bearing_and_axle(tier: str) -> None:
    """Strongest peak against masses on springs, within 3 %; on a rigid axle it is far higher."""
    strongest = {}
    for wheelset in ("coupled", "rigid"):
        scene = scene_on(wheelset, tier)
        frequency, level = ring_down(started(scene, constant_load(LOAD, SPEED_OF_SHAFT)))
        judged = (frequency > 450.0) & (frequency < 2000.0)
        strongest[wheelset] = frequency[judged][np.argmax(level[judged])]
    expected, share = frequencies(scene_on("coupled", tier))
    judged = (expected > 450.0) & (expected < 2000.0)
    assert strongest["coupled"] == pytest.approx(expected[judged][np.argmax(share[judged])], rel=0.03)
    assert strongest["rigid"] > 1.6 * strongest["coupled"]


def test_a_coupled_wheelset_asks_for_its_bearing() -> None:
    scene = scene_on("coupled")
    with pytest.raises(ValueError, match="a coupled wheelset needs the bearing"):
        load_history(scene.operation, scene.mounting, 0.1, scene.seed)


def test_a_warmer_bearing_has_the_modes_it_had() -> None:
    """Working them out takes longer than a block."""
    scene = scene_on("coupled")
    assert modes_of(scene) is modes_of(replace(scene, temperature=330.0, end_play=1e-5))
    assert modes_of(scene) is not modes_of(
        replace(scene, mounting=replace(scene.mounting, journal_mass=850.0))
    )


def test_steps_are_as_short_as_bending_of_the_axle_asks() -> None:
    """A sudden force moves the end of the axle alone, and rollers on it are faster."""
    scene, rigid = scene_on("coupled", "lumped"), scene_on("rigid", "lumped")
    p, short = axle_of(), bending_give(scene, 1e-6)
    assert short[2, 2] == pytest.approx((p.place**2).sum(), rel=1e-3)
    np.testing.assert_allclose(short[[0, 5]][:, [0, 5]], short[[2, 3]][:, [2, 3]] * [[1, -1], [-1, 1]])
    assert not bending_give(rigid, 1e-6).any()
    bearing, mounting, load = scene.bearing, scene.mounting, (2e4, 6.7e4)
    for step in (1e-6, 4e-5):
        give = np.eye(3) * (1.0 / (mounting.journal_mass + bearing.cone_mass))
        give += np.eye(3) / (mounting.box_mass + bearing.cup_mass) + bending_give(scene, step)[:3, :3]
        static = equilibrium(bearing, (0.0, 0.0, 6.7e4), end_play=0.0, laminae=6, speed=120.0)
        mode = np.sqrt(np.linalg.eigvals(static.stiffness_tilt_held @ give).real.max())
        found = fastest_mode(bearing, mounting, False, bending=bending_give(scene, step))
        assert mode < found < 2.2 * mode
    heavy = replace(mounting, box_mass=30.0)
    light, stiff = (fast_steps(replace(each, mounting=heavy)).steps_per_sample for each in (scene, rigid))
    assert light > 1 >= stiff
    bent = partial(bending_give, scene)
    chosen = [
        choose_steps(bearing, load, (60.0, 120.0), EffectSet(), 1, band=0.0, mounting=mounting, **given)
        for given in ({}, {"bending": bent}, {"bending": lambda step: 30.0 * bent(step)})
    ]
    assert chosen[0].steps_per_sample <= chosen[1].steps_per_sample < chosen[2].steps_per_sample
    assert "the rings on all their contacts" in chosen[2].reason


def test_the_resonance_that_choices_know_is_that_of_the_bent_axle() -> None:
    """The box bounces, and contacts damp it, as masses on springs say."""
    scene, force = scene_on("coupled"), np.array(LOAD)
    static = equilibrium(
        scene.bearing, LOAD, end_play=scene.end_play, laminae=6, speed=120.0, tilt="locked", rows=2
    )
    found = bounce(scene, static, force)
    assert found is not None
    expected, share = frequencies(scene)
    judged = (expected > 450.0) & (expected < 2000.0)
    assert found.frequency == pytest.approx(expected[judged][np.argmax(share[judged])], rel=0.03)
    assert 0.0 < found.contacts < 0.5
    assert 0.0 < found.axle < 0.01  # of each mode
    assert bounce(scene_on("rigid"), static, force) is None
    rigid, coupled = (
        levels(replace(each, effects=replace(each.effects, contact_damping=None)), static, None, 8e3)
        for each in (scene_on("rigid"), scene)
    )
    assert np.abs(coupled - rigid).max() > 3.0


def test_a_vehicle_without_dimensions_has_a_rigid_wheelset() -> None:
    scene = scene_on("coupled")
    operation = scene.operation
    assert isinstance(operation, QuarterVehicleOperation)
    plain = replace(load_vehicle("emu_300"), wheelset=None)
    assert modes_of(replace(scene, operation=replace(operation, vehicle=plain))) is None
    assert modes_of(scene_on("elastic")) is None
    assert modes_of(scene_on("rigid")) is None


def test_steps_longer_than_a_sample_are_refused() -> None:
    with pytest.raises(InputError, match="a coupled wheelset needs at least 1"):
        scene_from_text(LONG_STEPS)


def test_sideways_motion_is_refused() -> None:
    operation = scene_on("coupled").operation
    assert isinstance(operation, QuarterVehicleOperation)
    with pytest.raises(InputError, match="wheelset is coupled, and there is sideways motion"):
        replace(operation, lateral=True)
