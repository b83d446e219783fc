"""Raceway contact against brute force, against laminae summed one by one, and against its own energy."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from beardyn_core.physics.dry_friction import CoulombParams
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels import naive, naive_step
from test.kernels.casting import through
from test.kernels.entries import RACEWAY_OUTPUTS, raceways
from test.kernels.naive_traction import SIDES, lamina_friction
from test.kernels.rig import parameters_of
from test.kernels.states import only, packed, random_motion
from test.scenes import scene_with, standard_scene

Float = NDArray[np.float64]
DEEP = {"cup": 2.5e-5, "cone": -2.5e-5}
LANES8 = Lanes(8)


@cache
def parameters(laminae: int = 6) -> Parameters:
    return parameters_of(scene_with(laminae=laminae))


def motions(side: str, count: int, seed: int, **options: Any) -> list[naive.Motion]:
    rng = np.random.default_rng(seed)
    return [random_motion(standard_scene(), rng, lift=DEEP[side], **options) for _ in range(count)]


def contacts(
    side: str, cases: list[naive.Motion], p: Parameters, lanes: Any = LANES8, speed: float = 0.0
) -> Float:
    states = np.array([packed(motion) for motion in cases])
    ring = SIDES.index(side)
    return through(lanes, raceways, states, RACEWAY_OUTPUTS, getattr(p, side), ring, speed, p)


def brute_force_gap(motion: naive.Motion, x: float, side: str, p: Parameters) -> float:
    disc = motion.centre + x * motion.axis
    radius = p.roller.radius + x * p.roller.taper
    raceway = getattr(p, side)
    return naive.deepest_rim_point(disc, motion.axis, radius, motion.ring_axis, p.roller.apex, raceway)[0]


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(("skew", "limit"), [(2e-3, 1.0e-9), (1e-2, 20e-9), (math.radians(1.0), 60e-9)])
def test_kernel_approach_along_the_generator_misses_only_the_cubic_term(
    side: str, skew: float, limit: float
) -> None:
    """A quadratic in x: what is left is skew^2 x^3 sin(alpha)/(2 rho^2), 12 nm at 10 mrad and 25 mm.

    Raceway approaches are some micrometres; a roller at work skews by less than 2 mrad, where the error is
    below 1 nm.
    """
    p = only(parameters())
    cases = motions(side, 40, 3, skew=skew, moving=False)
    a = contacts(side, cases, p)[:, 7:10]
    for x in (-0.025, 0.025):
        exact = np.array([brute_force_gap(motion, x, side, p) for motion in cases])
        assert np.abs(a[:, 0] + x * (a[:, 1] + x * a[:, 2]) - exact).max() < limit


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(("skew", "force_error"), [(2e-3, 5e-5), (1e-2, 1.2e-3)])
def test_elastic_wrench_is_the_sum_of_laminae_at_their_own_points(
    lanes: Any, side: str, skew: float, force_error: float
) -> None:
    """Each lamina at the rim point a search finds, with its own normal.

    The generator line shares one normal with a linear turn along it and a quadratic approach: relative
    error below 5e-5 at 2 mrad of skew and about 1e-3 at 10 mrad.
    """
    p = only(parameters())
    cases = motions(side, 24, 4, skew=skew, moving=False)
    found = contacts(side, cases, p, lanes)
    for motion, result in zip(cases, found, strict=True):
        summed = naive.raceway_wrench(motion, getattr(p, side), p.roller, p.laminae, exact_search=True)
        size = np.linalg.norm(summed.force)
        assert size > 1e3
        lever = 0.5 * standard_scene().bearing.effective_length
        assert np.linalg.norm(result[:3] - summed.force) < force_error * size
        assert np.linalg.norm(result[3:6] - summed.moment) < force_error * size * lever
        assert abs(result[6] - summed.energy) < 2.0 * force_error * summed.energy


@pytest.mark.parametrize("side", SIDES)
def test_moving_contact_with_film_friction_and_damping_is_the_sum_of_laminae(lanes: Any, side: str) -> None:
    p = parameters()
    ring, damping = SIDES.index(side), p.effects.damping
    assert damping is not None
    cases = motions(side, 24, 5, skew=1e-3)
    found = contacts(side, cases, p, lanes, speed=6.0)
    scene = standard_scene()

    def friction(k: int, load: float, slip: float) -> float:
        return lamina_friction(scene, p, ring, k, load, slip, 6.0)

    for motion, result in zip(cases, found, strict=True):
        summed = naive.raceway_wrench(
            motion, getattr(p, side), p.roller, p.laminae, friction=friction,
            damping_time=damping.time_constant,
        )  # fmt: skip
        size = np.linalg.norm(summed.force)
        assert np.linalg.norm(result[:3] - summed.force) < 5e-5 * size
        assert np.linalg.norm(result[3:6] - summed.moment) < 5e-5 * size * 0.025


@pytest.mark.parametrize("side", SIDES)
def test_elastic_force_is_the_gradient_of_the_elastic_energy(side: str) -> None:
    """Central differences over place and direction of the roller, loads of some kN.

    Without play of the apex: the force may only differ by the neglected turn of the normal, 1e-5 at 2 mrad.
    """
    p = only(parameters())
    cases = motions(side, 12, 6, moving=False)
    step = 1e-8
    found = contacts(side, cases, p)

    def energy(change: Any) -> Float:
        return contacts(side, [change(motion) for motion in cases], p)[:, 6]

    load = np.linalg.norm(found[:, :3], axis=1)
    for i in range(3):
        shift = step * np.eye(3)[i]
        slope = (energy(lambda m, s=shift: moved(m, s)) - energy(lambda m, s=shift: moved(m, -s))) / (
            2 * step
        )
        assert np.all(np.abs(-slope - found[:, i]) < 3e-5 * load)
        turn = step / 0.025 * np.eye(3)[i]
        slope = (energy(lambda m, t=turn: turned(m, t)) - energy(lambda m, t=turn: turned(m, -t))) / (
            2 * step
        )
        assert np.all(np.abs(-slope - found[:, 3 + i] / 0.025) < 3e-5 * load)


def moved(m: naive.Motion, shift: Float) -> naive.Motion:
    return naive.Motion(
        m.centre + shift, m.axis, m.velocity, m.omega, m.ring_axis, m.ring_velocity, m.ring_omega
    )


def turned(m: naive.Motion, rotation: Float) -> naive.Motion:
    axis = naive_step.rotated(rotation, m.axis)
    return naive.Motion(m.centre, axis, m.velocity, m.omega, m.ring_axis, m.ring_velocity, m.ring_omega)


@pytest.mark.parametrize("side", SIDES)
def test_elastic_force_does_no_work_on_the_spin(side: str) -> None:
    """A smooth roller of revolution: moment about its own axis 0; 1 um of lever at most at 2 mrad of skew."""
    p = only(parameters())
    cases = motions(side, 40, 7, moving=False)
    found = contacts(side, cases, p)
    about_axis = [abs(result[3:6] @ motion.axis) for motion, result in zip(cases, found, strict=True)]
    assert np.max(about_axis / np.linalg.norm(found[:, :3], axis=1)) < 1e-6


@pytest.mark.parametrize("side", SIDES)
def test_dry_friction_at_full_slip_is_a_tenth_of_the_normal_force(lanes: Any, side: str) -> None:
    """Santos (2017), dry friction: ratio 0.100; at 12 m/s the regularisation of 10 mm/s costs 3.5e-7."""
    p = only(parameters(), coulomb=CoulombParams(0.1, 0.01))
    plain = only(parameters())
    for motion in motions(side, 8, 8, skew=0.0, tilt=0.0, moving=False):
        around = np.cross(motion.ring_axis, motion.centre)
        velocity = 12.0 * around / np.linalg.norm(around)
        sliding = naive.Motion(
            motion.centre, motion.axis, velocity, motion.omega, motion.ring_axis,
            motion.ring_velocity, motion.ring_omega,
        )  # fmt: skip
        normal = contacts(side, [motion], plain, lanes)[0, :3]
        friction = contacts(side, [sliding], p, lanes)[0, :3] - normal
        assert np.linalg.norm(friction) / np.linalg.norm(normal) == pytest.approx(0.1, rel=1e-6)
        assert friction @ sliding.velocity < 0.0


def test_roller_that_does_not_touch_feels_nothing(lanes: Any) -> None:
    p = parameters()
    rng = np.random.default_rng(9)
    cases = [random_motion(standard_scene(), rng, lift=-2e-4) for _ in range(8)]
    found = contacts("cup", cases, p, lanes, speed=6.0)
    assert np.all(found[:, 7] < 0.0)
    np.testing.assert_array_equal(found[:, :7], 0.0)


def test_oversize_roller_is_pressed_deeper_by_its_oversize_over_the_cosine_of_the_half_angle(
    lanes: Any,
) -> None:
    p = only(parameters())
    motion = motions("cup", 1, 10, skew=0.0, tilt=0.0, moving=False)[0]
    straight = naive.Motion(
        motion.centre, motion.axis, motion.velocity, motion.omega, np.array([0.0, 0.0, 1.0]),
        motion.ring_velocity, motion.ring_omega,
    )  # fmt: skip
    states = np.array([packed(straight, 0.0), packed(straight, 1e-6)])
    found = through(lanes, raceways, states, RACEWAY_OUTPUTS, p.cup, 0, 0.0, p)[:, 7]
    deeper = 1e-6 * math.cos(standard_scene().bearing.half_angle)
    assert found[1] - found[0] == pytest.approx(deeper, rel=1e-3)


@given(seed=st.integers(0, 2**32 - 1), skew=st.floats(0.0, 5e-3), side=st.sampled_from(SIDES))
@settings(max_examples=40, deadline=None)
def test_contact_pushes_the_roller_out_and_friction_takes_energy(seed: int, skew: float, side: str) -> None:
    """Any place and motion: the elastic force points out of the ring, friction opposes the slip."""
    p = parameters()
    sticky = only(p, film=p.effects.film, mixed=p.effects.mixed)
    cases = motions(side, 8, seed, skew=skew)
    whole = contacts(side, cases, sticky, speed=6.0)
    elastic = contacts(side, cases, only(p))
    for motion, total, push in zip(cases, whole, elastic, strict=True):
        normal = push[16:19]
        assert push[:3] @ normal <= 0.0
        friction = total[:6] - push[:6]
        relative_velocity = (
            motion.velocity - motion.ring_velocity - np.cross(motion.ring_omega, motion.centre)
        )
        relative_omega = motion.omega - motion.ring_omega
        power = friction[:3] @ relative_velocity + friction[3:] @ relative_omega
        assert power <= 1e-9 * np.linalg.norm(push[:3])


@pytest.mark.parametrize("field", range(21))
def test_a_nan_in_any_input_is_seen_in_the_force(lanes: Any, field: int) -> None:
    p = parameters()
    states = np.array([packed(motion) for motion in motions("cup", 8, 11)])
    states[2, field] = np.nan
    found = through(lanes, raceways, states, RACEWAY_OUTPUTS, p.cup, 0, 6.0, p)
    assert np.isnan(found[2, :6]).any()
    assert np.isfinite(np.delete(found, 2, axis=0)).all()
