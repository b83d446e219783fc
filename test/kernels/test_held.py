"""Friction that is held: the coefficient of each lamina from one state, its load and slip from another."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.jit import entry
from beardyn_core.effects import CoulombTraction, LoadSharingTraction
from beardyn_core.physics.bodies.contact_output import store_vector
from beardyn_core.physics.bodies.friction_substeps import Held, hold_contact, is_fresh, remember
from beardyn_core.physics.film import log2_entrainment
from beardyn_core.physics.generator_line import generator_line, line_slip
from beardyn_core.physics.laminae import Raceway, lamina_sums
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.lanes.vectors import Wrench
from beardyn_core.physics.raceway import RacewayContact, push_raceway
from beardyn_core.physics.tiers.build import HELD_SAMPLES
from beardyn_core.physics.tiers.parameters import HeldParams, Parameters
from test.kernels import naive, naive_traction
from test.kernels.casting import through
from test.kernels.entries import body_and_view
from test.kernels.naive_traction import SIDES
from test.kernels.rig import parameters_of
from test.kernels.states import packed, random_motion
from test.kernels.test_raceway import DEEP
from test.kernels.test_traction_laws import ENOUGH, lamina
from test.scenes import standard_scene

SPEED = 6.0
TRACTION = LoadSharingTraction()


@entry
def in_pairs(lanes: Any, states: Any, out: Any, raceway: Any, ring: Any, speed: Any, p: Any) -> None:
    """Work out the friction of even cases, and recall it in the odd ones behind them: force and moment."""
    for case in range(states.shape[0]):
        zero = lanes.constant(0.0)
        body, view = body_and_view(lanes, states, case, zero)
        line = generator_line(body.place, body.axis, view.axis, zero, raceway, p.roller)
        slip = line_slip(line, body.place, body, view, None)
        log2_speed = log2_entrainment(lanes.constant(speed), p.effects.film)
        held = Held(lanes, p.held, ring, case % 2 == 1)
        instant = (1e-12, 0.0)  # in so short a step no contact begins or ends
        shared = Raceway(
            lanes, ring, p.laminae, p.lamina_loads, 1.0, p.effects, (zero, zero), instant, held, None
        )  # fmt: skip
        sums = lamina_sums(shared, line, slip, log2_speed, False, None)
        level = Wrench((zero, zero, zero), (zero, zero, zero))
        contact = RacewayContact(line, slip, sums, level, log2_speed, body.place, body, None, held, None)
        wrench = push_raceway(contact, p.effects.damping)
        store_vector(lanes, out, case, 0, wrench.force)
        store_vector(lanes, out, case, 3, wrench.moment)


@entry
def asked_again(lanes: Any, cases: Any, out: Any, held: Any) -> None:
    """Remember loads, and ask for approaches of later steps: one answer a block."""
    for block in range(cases.shape[0]):
        remember(Held(lanes, held, 0, False), lanes.load(cases, block, 0), held)
        again = hold_contact(lanes, 0, 0, False, lanes.load(cases, block, 1), held)
        lanes.store(out, block, 0, lanes.constant(1.0 if again.recalled else 0.0))


def parameters(traction: Any, integrator: str = "implicit") -> Parameters:
    scene = standard_scene()
    changed = replace(
        scene,
        effects=replace(scene.effects, traction=traction, film=ENOUGH),
        numerics=replace(scene.numerics, integrator=integrator),
    )
    return parameters_of(changed)


@pytest.mark.parametrize("side", SIDES)
def test_recalled_friction_is_the_coefficient_of_the_first_state_with_load_and_slip_of_the_second(
    side: str,
) -> None:
    p = parameters(TRACTION)
    ring, rng = SIDES.index(side), np.random.default_rng(7)
    firsts, seconds = (
        [random_motion(standard_scene(), rng, lift=DEEP[side], skew=1e-4) for _ in range(8)] for _ in range(2)
    )
    cases = np.array([packed(motion) for motion in (*firsts, *seconds)])
    found = through(Lanes(8), in_pairs, cases, 6, getattr(p, side), ring, SPEED, p)[8:]
    assert p.effects.damping is not None
    for first, second, result in zip(firsts, seconds, found, strict=True):
        coefficient: dict[int, float] = {}

        def worked_out(k: int, load: float, slip: float, kept: dict[int, float] = coefficient) -> float:
            speed = SPEED + 1e-3
            force = naive_traction.shared_friction(load, slip, speed, lamina(k, ring), TRACTION, ENOUGH)
            kept[k] = force / (load * slip)
            return force

        def recalled(k: int, load: float, slip: float, kept: dict[int, float] = coefficient) -> float:
            return kept[k] * load * slip

        wrenches = [
            naive.raceway_wrench(
                motion, getattr(p, side), p.roller, p.laminae, friction=friction,
                damping_time=p.effects.damping.time_constant,
            )
            for motion, friction in ((first, worked_out), (second, recalled))
        ]  # fmt: skip
        assert len(coefficient) == p.laminae.shape[1]
        size = np.linalg.norm(wrenches[1].force)
        assert np.linalg.norm(result[:3] - wrenches[1].force) < 5e-5 * size
        assert np.linalg.norm(result[3:] - wrenches[1].moment) < 5e-5 * size * 0.025


def test_only_the_dear_law_is_held_and_no_explicit_step() -> None:
    held = parameters(TRACTION).held
    assert held is not None
    assert held.steps == HELD_SAMPLES * standard_scene().numerics.steps_per_sample
    assert parameters(CoulombTraction()).held is None
    assert parameters(TRACTION, integrator="explicit").held is None


def test_friction_is_worked_out_in_every_step_where_nothing_is_held_and_in_the_first_of_each_block() -> None:
    assert not any(bool(is_fresh(step, None)) for step in range(4))  # then it is not asked
    held = HeldParams(3.0, np.zeros((1, 3, 8)))
    assert [bool(is_fresh(step, held)) for step in range(5)] == [True, False, False, True, False]


def test_friction_is_recalled_only_where_every_lane_that_presses_pressed_when_it_was_worked_out() -> None:
    held = HeldParams(3.0, np.zeros((2, 3, 8)))
    pressing, idle, begun, ended = (100.0, 1e-6), (0.0, -1e-6), (0.0, 1e-6), (100.0, -1e-6)
    blocks = [[pressing] * 7 + [last] for last in (pressing, idle, begun, ended)] + [[idle] * 8]
    found = through(Lanes(8), asked_again, np.array(blocks).reshape(-1, 2), 1, held)
    assert found.reshape(-1, 8)[:, 0].tolist() == [1.0, 1.0, 0.0, 1.0, 0.0]
