"""Bending of the box in the fast tiers: naive sums, static solution and full tier beside it."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from beardyn_core.base.jit import LANE_WIDTH
from beardyn_core.choice.fast_step import fast_steps
from beardyn_core.physics.bodies.layout import (
    CAGE_BODY,
    CONE_BODY,
    CUP_BODY,
    LINEAR,
    POSITION,
    SIGNAL_CHANNELS,
    SIGNAL_FORCE,
    TURN,
)
from beardyn_core.physics.modal_body import body_of
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.suspension import FORCE
from beardyn_core.physics.tiers.tier_bending import step_body
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import contradictions
from beardyn_core.twin import Twin
from test.runs import blocks_of
from test.tiers.bent_box import KINDS, Float, bent_scene, shapes_at, started, stepped, suspended
from test.tiers.momentum import momentum_of_rolling_parts
from test.tiers.runs import FAST, scene_of


@pytest.mark.parametrize("kind", KINDS)
def test_rollers_and_modes_push_each_other_through_the_same_shapes(kind: str) -> None:
    """One step of the lumped tier, roller by roller: approach, load, and what it does to every mode."""
    twin = started(suspended("lumped", kind))
    assert twin._state is not None
    p, state = twin._kernel_parameters, twin._state
    state.flex[1] = np.random.default_rng(1).normal(0.0, 1e-3, state.flex.shape[1])
    stepped(twin, 8)  # turned on, and bent by some more
    before = state.copy()
    bearing = twin.scene.bearing
    _, rollers = stepped(twin, 1)
    flex = before.flex[0] + p.step * before.flex[1]
    azimuth = 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
    azimuth = azimuth + state.bodies[CAGE_BODY, TURN]
    # fine waves that the tier leaves out weigh 2e-4 of the compliance, a hundredth of an amplitude
    shapes = shapes_at(twin, azimuth)
    seen = np.einsum("rpm,m->rp", shapes, flex)
    series, width = p.bending.basis.shape[1], LANE_WIDTH
    found = np.zeros_like(seen)
    cup_load = np.zeros_like(seen)
    for block in range(p.bending.basis.shape[0]):
        for lane in range(width):
            row, place = lane * 2 // width, block * width // 2 + lane % (width // 2)
            if place < bearing.roller_count:
                found[row, place] = p.bending.shown[0, :series, lane] @ p.bending.basis[block, :, lane]
                cup_load[row, place] = rollers[0, block, 0, lane]
    assert np.abs(found - seen).max() < 0.02 * np.abs(seen).max()
    assert np.abs(seen).max() > 1e-6
    push = np.einsum("rpm,rp->m", shapes, cup_load)
    forces = p.bending.forces.copy()
    openings = len(p.bending.rigid)
    forces[:openings] -= p.bending.rows[2, :openings]  # what is held for the step comes on top
    matrix = np.moveaxis(p.bending.pushes, 1, 2).reshape(-1, len(forces))[: len(flex), :openings]
    kernel = matrix @ forces[:openings]
    assert np.abs(kernel - push).max() < 0.02 * np.abs(push).max()


@pytest.mark.parametrize("kind", KINDS)
def test_held_response_is_the_direct_solution(kind: str) -> None:
    """Built up roller by roller as ``(1 + B D)^-1 B`` with a linear solver, B from all rollers at once."""
    twin = started(suspended("lumped", kind))
    stepped(twin, 1, 0.0)  # nothing turns: the pockets are where they began
    bending = twin._kernel_parameters.bending
    openings, series = len(bending.rigid), bending.basis.shape[1]
    springs = np.zeros((openings, openings))
    for block, _, lane in np.argwhere(bending.tangents > 0.0):
        waves, row = np.zeros(openings), lane * 2 // LANE_WIDTH
        waves[row * series : (row + 1) * series] = bending.basis[block, :, lane]
        springs += bending.lag * bending.tangents[block, 0, lane] * np.outer(waves, waves)
    give = np.moveaxis(bending.give, 1, 2).reshape(-1, openings)[:openings]
    expected = np.linalg.solve(np.eye(openings) + springs @ give, springs)
    if bending.joint is None:
        found = np.moveaxis(bending.response, 1, 2).reshape(-1, openings)[:openings]
    else:  # by modes and motions of the rings: what they do to the series, and these to them
        joint = bending.joint
        count = len(joint.give)
        motions = joint.motions.reshape(openings, -1)[:, :count]
        expected = motions.T @ expected @ motions
        found = joint.response.reshape(count, -1)[:, :count]
        np.testing.assert_allclose(
            motions @ joint.give.reshape(count, -1)[:, :count] @ motions.T, give, atol=1e-12 * give.max()
        )
    assert (bending.joint is None) == (kind == "modes")
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * np.abs(expected).max())
    assert np.linalg.eigvals(springs @ give).real.max() > 0.1  # it does matter


def test_few_modes_and_rings_together_move_as_by_the_series_of_the_openings() -> None:
    """The same steps with and without `joint_bending`: forces and modes to rounding."""
    signals, modes = [], []
    for together in (True, False):
        twin = started(suspended("lumped", "rings"))
        assert twin._state is not None
        twin._state.flex[1] = np.random.default_rng(1).normal(0.0, 1e-3, twin._state.flex.shape[1])
        p = twin._kernel_parameters
        if not together:
            twin._kernel_parameters = p._replace(bending=p.bending._replace(joint=None))
        signals.append(stepped(twin, 200)[0])
        modes.append(twin._state.flex.copy())
    scale = np.abs(signals[1]).max(axis=0) + 1e-3
    assert np.abs((signals[0] - signals[1]) / scale).max() < 1e-7
    np.testing.assert_allclose(modes[0], modes[1], atol=1e-7 * np.abs(modes[1]).max())
    assert np.ptp(signals[1][:, SIGNAL_FORCE + 2]) > 100.0  # they did move


@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize("kind", KINDS)
def test_box_and_journal_exchange_their_momentum(tier: str, kind: str) -> None:
    """The modes take none: together both change by what springs, load and weight push them with.

    In the quasistatic tier rollers and cages have their share, in frames that turn with the rollers: of what
    80 kN give in the step, 3e-4 are not found again.
    """
    twin = started(suspended(tier, kind))
    assert twin._state is not None
    twin._state.flex[1] = np.random.default_rng(2).normal(0.0, 1e-3, twin._state.flex.shape[1])
    stepped(twin, 8)
    before, rolling = twin._state.copy(), momentum_of_rolling_parts(twin)
    p, bodies = twin._kernel_parameters, twin._state.bodies
    stepped(twin, 1)
    rolling = momentum_of_rolling_parts(twin) - rolling
    load = twin._loads(0, 20_000_000, 512)[0]
    mounting = p.base.mounting
    change = (bodies - before.bodies)[:2, LINEAR : LINEAR + 6]
    journal = mounting.journal_mass * change[CONE_BODY, :3]
    if mounting.coupling is None:
        box = mounting.box_mass * change[CUP_BODY, :3]
        spring = mounting.stiffness[:3] * bodies[CUP_BODY, POSITION : POSITION + 3]
        spring = spring + mounting.damping[:3] * before.bodies[CUP_BODY, LINEAR : LINEAR + 3]
        # the free box takes half a step of its dampers implicitly
        box = box + 0.5 * p.step * mounting.damping[:3] * change[CUP_BODY, :3]
        outside = p.motion.steady[:3] - spring
    else:
        box = mounting.coupling.mass[:3] @ change[CUP_BODY]
        outside = twin._work.box[FORCE : FORCE + 3] - signals_wrench(twin)
    outside = outside + load[:3] - [0.0, 0.0, p.kinematic.rolling_weight]
    scale = p.step * 8e4
    allowed = 1e-9 if tier == "lumped" else 3e-4
    changed = (box + journal + rolling)[[0, 2]]
    np.testing.assert_allclose(changed, p.step * outside[[0, 2]], atol=allowed * scale)


def signals_wrench(twin: Twin) -> Float:
    """The rollers' force on the box in the last step, [N]."""
    return np.asarray(twin._work.wrenches[CUP_BODY, :3])


@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize("kind", KINDS)
def test_deflection_and_largest_load_are_those_of_the_static_solution(tier: str, kind: str) -> None:
    """80 kN, set beforehand: 1 % of means over the pitch of the rollers."""
    scene = bent_scene(tier, kind)
    bearing, body = scene.bearing, body_of(scene)
    carried = 9.80665 * 2 * (bearing.roller_count * bearing.roller_mass + bearing.cage.mass)
    found = [
        solve(
            bearing, (0.0, 0.0, 8e4 - carried), end_play=scene.end_play, laminae=scene.numerics.laminae,
            speed=122.0, roller_phase=2.0 * np.pi * phase / 6 / bearing.roller_count, body=body,
        )
        for phase in range(6)
    ]  # fmt: skip
    displacement = np.mean([each.displacement[2] for each in found])
    largest = np.mean([each.cup_load.max() for each in found])
    deflection, load = _means(scene)
    assert deflection == pytest.approx(displacement, rel=0.01)
    assert load == pytest.approx(largest, rel=0.01)


@cache
def _means(scene: Scene) -> tuple[float, float]:
    """Mean deflection [m] and largest cup load [N] over the second half of 0.3 s."""
    blocks = blocks_of(scene, 0.3)[7:]
    assert not any(block.status for block in blocks)
    pose = np.concatenate([block.body_pose[:, :2, 2] for block in blocks])
    cup = np.concatenate([np.linalg.norm(block.contacts[..., 0, 3:6], axis=-1) for block in blocks])
    return float((pose[:, 1] - pose[:, 0]).mean()), float(cup.max(axis=(1, 2)).mean())


@pytest.mark.slow
@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize("kind", KINDS)
def test_deflection_and_largest_load_are_those_of_the_full_tier(tier: str, kind: str) -> None:
    """80 kN with the same structure, set beforehand: 1 %."""
    np.testing.assert_allclose(_means(bent_scene(tier, kind)), _means(bent_scene("full", kind)), rtol=0.01)


@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize("kind", KINDS)
def test_places_that_move_along_with_speeds_are_those_of_the_modes(tier: str, kind: str) -> None:
    """A step reads the speeds of the modes; their places it reads once in a trend, here 63 steps before."""
    twin = started(replace(suspended(tier, kind), duration=0.1))
    twin.advance()
    bending, state = twin._kernel_parameters.bending, twin._state
    assert state is not None
    shapes = np.moveaxis(bending.shapes, 1, 2).reshape(-1, bending.shapes.shape[1])
    acted = len(bending.forces)
    places = shapes[:acted] @ state.flex[0]
    np.testing.assert_allclose(
        bending.seen_row[0, :acted], places, rtol=0.0, atol=1e-12 * np.abs(places).max()
    )


@pytest.mark.parametrize("tier", FAST)
@pytest.mark.parametrize("kind", KINDS)
def test_a_run_begins_bent_and_quiet(tier: str, kind: str) -> None:
    """The first millisecond of a bearing that stands still: modes stay where the static solution put them.

    Without cages, whose rollers would roll on.
    """
    scene = suspended(tier, kind)
    twin = started(replace(scene, effects=replace(scene.effects, cage=None)))
    assert twin._state is not None
    begin = twin._state.flex[0].copy()
    signals, _ = stepped(twin, 32, 0.0)
    shapes = shapes_at(twin, np.linspace(0.0, 2.0 * np.pi, 16))
    assert np.abs(shapes @ begin).max() > 2e-6
    assert np.abs(shapes @ (twin._state.flex[0] - begin)).max() < 0.02 * np.abs(shapes @ begin).max()
    assert np.abs(signals[:, SIGNAL_FORCE + 2] / 8e4 - 1.0).max() < 0.01


def test_sensors_receive_the_modes_at_their_seats() -> None:
    """The channel behind the others is the acceleration of the seat: place times squared rate, 0.2 dB."""
    scene = replace(bent_scene("quasistatic", "modes", "cup_spall"), scatter=None)  # nothing else excites it
    twin = started(scene)
    fitted = step_body(scene, 1.0 / 25600.0)
    assert twin._state is not None
    assert fitted is not None
    assert fitted.sensors is not None
    stepped(twin, 1, 0.0)
    rest = fitted.sensors[:, 2] @ twin._state.flex[0]
    twin._state.flex[1, :24] += 1e-3 * np.sign(fitted.sensors[:24, 2])
    places, found = np.zeros(1024), np.zeros(1024)
    for step in range(1024):
        # places are those that the step finds, forces and acceleration belong to them
        signals, _ = stepped(twin, 1, 0.0)
        places[step] = fitted.sensors[:, 2] @ twin._state.flex[0] - rest
        found[step] = signals[0, SIGNAL_CHANNELS + 2]
    window = np.hanning(1024)
    received, moved = np.abs(np.fft.rfft(found * window)), np.abs(np.fft.rfft(places * window))
    rate = 2.0 * np.pi * np.fft.rfftfreq(1024, 1.0 / 25600.0)
    bands = [(500.0, 1000.0), (1000.0, 2000.0), (2000.0, 4000.0)]
    for low, high in bands:
        band = (rate > 2.0 * np.pi * low) & (rate < 2.0 * np.pi * high)
        expected = np.linalg.norm((rate**2 * moved)[band])
        assert np.linalg.norm(received[band]) == pytest.approx(expected, rel=0.02), (low, high)


def test_a_box_that_bends_takes_no_step_longer_than_a_sample() -> None:
    """Springs of rollers that come and go push stiff modes over: three samples a step ended in no number."""
    rigid = scene_of("static_80kN", "lumped")
    assert fast_steps(rigid).steps_per_sample < 1.0
    assert fast_steps(bent_scene("lumped", "rings")).steps_per_sample == 1.0
    for kind, steps in (("modes", 0.5), ("rings", 0.25)):
        problems = contradictions("lumped", True, 6, steps, kind)
        assert len(problems) == 1
        assert "effects.structure" in problems[0]
    assert not contradictions("lumped", True, 6, 0.5)
    assert not contradictions("lumped", True, 6, 0.5, "rings")
    assert contradictions("quasistatic", True, 6, 0.5, "rings")


def test_rings_take_steps_of_two_samples_where_only_low_bands_are_asked_for() -> None:
    """Not so modes of a box, nor the quasistatic tier."""
    rings = bent_scene("lumped", "rings", "cup_spall")
    assert fast_steps(rings, band=1000.0).steps_per_sample == 0.5
    assert fast_steps(rings, band=4000.0).steps_per_sample == 1.0
    assert fast_steps(bent_scene("lumped", "modes", "cup_spall"), band=1000.0).steps_per_sample >= 1.0
    assert fast_steps(bent_scene("quasistatic", "rings", "cup_spall"), band=1000.0).steps_per_sample == 1.0
