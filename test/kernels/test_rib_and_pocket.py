"""Rib and cage pocket against search, against plain formulas, and against their own energy."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels import naive, naive_step
from test.kernels.casting import through
from test.kernels.entries import pockets, ribs
from test.kernels.rig import parameters_of
from test.kernels.states import packed, random_motion
from test.scenes import standard_scene

Float = NDArray[np.float64]
LANES8 = Lanes(8)


@cache
def parameters() -> Parameters:
    """A whole sphere on the rib: `test_rib_edges` has its rim."""
    scene = standard_scene()
    assert scene.effects.rib is not None
    whole = replace(scene.effects, rib=replace(scene.effects.rib, roller_end=False))
    return parameters_of(replace(scene, effects=whole))


def rib_cases(count: int, seed: int, **options: Any) -> list[naive.Motion]:
    """Rollers pressed some micrometres against the rib."""
    rng = np.random.default_rng(seed)
    cases = []
    for _ in range(count):
        motion = random_motion(standard_scene(), rng, tilt=3e-4, **options)
        cases.append(replace(motion, centre=motion.centre + np.array([0.0, 0.0, 1.2e-4])))
    return cases


def rib_results(cases: list[naive.Motion], lanes: Any = LANES8, damping: Any = None) -> Float:
    return through(lanes, ribs, np.array([packed(m) for m in cases]), 8, parameters().effects.rib, damping)


def test_rib_depth_is_that_of_the_deepest_point_of_the_sphere() -> None:
    """Sphere on cone is exact; the search itself stops at 1e-15 m of depth, the energy tells the depth."""
    rib = parameters().effects.rib
    assert rib is not None
    cases = rib_cases(10, 1, moving=False)
    energy = rib_results(cases)[:, 6]
    for motion, found in zip(cases, energy, strict=True):
        depth = naive.rib_depth_by_search(motion.centre, motion.axis, motion.ring_axis, rib)
        assert depth > 1e-6
        assert found == pytest.approx(rib.stiffness * depth**2.5 / 2.5, rel=1e-6)


def test_rib_wrench_is_the_plain_formula(lanes: Any) -> None:
    """Sliding, pressed and damped; the same formula in another order of operations, hence 1e-9."""
    p = parameters()
    damping = p.effects.damping
    assert damping is not None
    cases = rib_cases(40, 2)
    touching = 0
    for motion, found in zip(cases, rib_results(cases, lanes, damping), strict=True):
        expected = naive.rib_wrench(motion, p.effects.rib, damping_time=damping.time_constant)
        size = np.linalg.norm(expected.force)
        touching += int(size > 0.0)
        assert np.linalg.norm(found[:3] - expected.force) <= 1e-9 * size
        assert np.linalg.norm(found[3:6] - expected.moment) <= 1e-9 * size * 0.05
        assert found[6] == pytest.approx(expected.energy, rel=1e-9, abs=1e-15)
    assert touching > 20


def test_elastic_rib_force_is_the_gradient_of_its_energy() -> None:
    cases = rib_cases(16, 3, moving=False)
    found = rib_results(cases)
    load = np.linalg.norm(found[:, :3], axis=1)
    step = 1e-8
    for i in range(3):
        shift = step * np.eye(3)[i]
        ahead = rib_results([replace(m, centre=m.centre + shift) for m in cases])[:, 6]
        behind = rib_results([replace(m, centre=m.centre - shift) for m in cases])[:, 6]
        # friction at rest is zero, so the force is elastic; 1e-5: truncation of the difference at 1 um depth
        assert np.all(np.abs(-(ahead - behind) / (2 * step) - found[:, i]) <= 3e-5 * load + 1e-3)


def test_rib_touched_by_no_sphere_pushes_nothing(lanes: Any) -> None:
    cases = [replace(m, centre=m.centre - np.array([0.0, 0.0, 5e-4])) for m in rib_cases(8, 4, moving=False)]
    np.testing.assert_array_equal(rib_results(cases, lanes), 0.0)


# --- pocket


def pocket_cases(count: int, seed: int, *, still: bool = False) -> tuple[list[naive.Motion], Float]:
    """Rollers that lean on the walls of their pocket, and their advance in it."""
    p, scene = parameters(), standard_scene()
    assert p.effects.cage is not None
    rng = np.random.default_rng(seed)
    cases, advances = [], []
    for _ in range(count):
        motion = random_motion(scene, rng, skew=1e-3, moving=not still)
        play = rng.uniform(-1.2, 1.2) * p.effects.cage.half_clearance
        advances.append(play / (0.5 * scene.bearing.pitch_diameter))
        along = rng.uniform(-1.2, 1.2) * p.effects.cage.half_end_clearance
        tilt = np.array([*rng.uniform(-5e-4, 5e-4, 2), 0.0])
        shift = along * motion.axis + np.array([0.0, 0.0, 0.0])
        # the place along the walls is counted from the cage's centre of mass
        centre = motion.centre + shift - np.array([0.0, 0.0, 0.5 * scene.bearing.row_spacing])
        cases.append(replace(motion, centre=centre, ring_axis=tilt))
    return cases, np.array(advances)


def in_orbit_frame(motion: naive.Motion) -> tuple[naive.Motion, float]:
    """The kernel sees vectors along radial, tangential and axial of the roller."""
    azimuth = math.atan2(motion.centre[1], motion.centre[0])
    vectors = {
        name: naive_step.turned(-azimuth, getattr(motion, name)) for name in motion.__dataclass_fields__
    }
    return naive.Motion(**vectors), azimuth


def pocket_results(cases: list[naive.Motion], advances: Float, lanes: Any = LANES8) -> Float:
    p = parameters()
    states = [packed(in_orbit_frame(m)[0], advance) for m, advance in zip(cases, advances, strict=True)]
    return through(lanes, pockets, np.array(states), 7, p.roller, p.effects.cage)


def test_pocket_wrench_is_the_sum_of_its_five_walls(lanes: Any) -> None:
    """Planes written out in the frame of the ring; the depth loses 1e-9 of the 0.1 m it is measured over."""
    p = parameters()
    cases, advances = pocket_cases(200, 5)
    pressed = 0
    for motion, advance, found in zip(cases, advances, pocket_results(cases, advances, lanes), strict=True):
        azimuth = in_orbit_frame(motion)[1]
        still = naive.Motion(
            motion.centre, motion.axis, motion.velocity, motion.omega, np.array([0.0, 0.0, 1.0]),
            motion.ring_velocity, motion.ring_omega,
        )  # fmt: skip
        expected = naive.pocket_wrench(still, motion.ring_axis, advance, azimuth, p.roller, p.effects.cage)
        size = np.linalg.norm(expected.force)
        pressed += int(size > 1.0)
        force = naive_step.turned(azimuth, found[:3])
        moment = naive_step.turned(azimuth, found[3:6])
        assert np.linalg.norm(force - expected.force) <= 1e-8 * size + 1e-6
        assert np.linalg.norm(moment - expected.moment) <= (1e-8 * size + 1e-6) * 0.05
        assert found[6] == pytest.approx(expected.energy, rel=1e-7, abs=1e-12)
    assert pressed > 40


def test_elastic_pocket_force_and_moment_are_the_gradient_of_the_energy() -> None:
    """At rest, so without friction and damping; moved and turned rollers in moved and turned cages.

    Truncation of the difference at 5 um of depth. A leaning bar has to feel the roller tilt.
    """
    cases, advances = pocket_cases(60, 9, still=True)
    found = pocket_results(cases, advances)
    step, lever = 1e-8, 0.02
    size = np.linalg.norm(found[:, :3], axis=1)
    assert (size > 10.0).sum() > 20

    def energy(move: Float, turn: Float) -> Float:
        moved = []
        for motion in cases:
            azimuth = in_orbit_frame(motion)[1]
            # the orbit frame is held, as the advance is given in it
            shift, angle = naive_step.turned(azimuth, move), naive_step.turned(azimuth, turn)
            axis = motion.axis + np.cross(angle, motion.axis)
            moved.append(replace(motion, centre=motion.centre + shift, axis=axis / np.linalg.norm(axis)))
        p = parameters()
        states = []
        for motion, before, advance in zip(moved, cases, advances, strict=True):
            azimuth = in_orbit_frame(before)[1]
            names = motion.__dataclass_fields__
            local = naive.Motion(
                **{name: naive_step.turned(-azimuth, getattr(motion, name)) for name in names}
            )
            states.append(packed(local, advance))
        return through(LANES8, pockets, np.array(states), 7, p.roller, p.effects.cage)[:, 6]

    for i in range(3):
        unit, still = step * np.eye(3)[i], np.zeros(3)
        force = -(energy(unit, still) - energy(-unit, still)) / (2.0 * step)
        assert np.all(np.abs(force - found[:, i]) <= 2e-4 * size + 1e-2)
        moment = -(energy(still, unit / lever) - energy(still, -unit / lever)) / (2.0 * step / lever)
        assert np.all(np.abs(moment - found[:, 3 + i]) <= lever * (2e-4 * size + 1e-2))


def test_bar_is_as_deep_as_the_exact_disc_against_a_plane() -> None:
    """g = (C - p0).n - r sqrt(1 - (n.a)^2): the kernel keeps the lean n.a of the nominal roller.

    Without skew both are the same; a skew s changes the exact reach by r (n.a) s cos(bar), 0.94 um at 1 mrad
    against a play of 113 um.
    """
    p, scene = parameters(), standard_scene()
    cage = p.effects.cage
    assert cage is not None
    normal = np.array([cage.bar_sine, cage.bar_cosine, 0.0])
    nominal = np.array([cage.roller_height, 0.0, scene.bearing.roller_mass_offset * cage.axis_axial])
    nominal_axis = np.array([cage.axis_radial, 0.0, cage.axis_axial])

    def reach(centre: Float, axis: Float, x: float) -> float:
        lean = float(normal @ axis)
        radius = p.roller.radius + x * p.roller.taper
        return float((centre + x * axis) @ normal) + radius * math.sqrt(1.0 - lean**2)

    zero = np.zeros(3)
    centre = nominal + np.array([0.0, 1.5e-4, 0.0])
    azimuth = math.atan2(centre[1], centre[0])
    for skew in (-1e-3, 0.0, 1e-3):
        axis = nominal_axis + np.array([0.0, skew, 0.0])
        axis /= np.linalg.norm(axis)
        depths = [
            reach(centre, axis, x) - reach(nominal, nominal_axis, x) - cage.bar_cosine * cage.half_clearance
            for x in (-cage.bar_place, cage.bar_place)
        ]
        assert min(depths) > 0.0
        motion = naive.Motion(centre, axis, zero, zero, zero, zero, zero)
        found = pocket_results([motion], np.array([azimuth]))[0, 6]
        energy = sum(0.5 * cage.stiffness * depth**2 for depth in depths)
        lost = abs(skew) * cage.bar_cosine * cage.axis_radial * cage.bar_sine * 1.1 * p.roller.radius
        assert abs(found - energy) <= cage.stiffness * sum(depths) * lost + 1e-6 * energy


def test_bar_damps_but_never_pulls(lanes: Any) -> None:
    """Spring and damper on the front bar, at both of its points, zero once the roller leaves fast enough."""
    p = parameters()
    assert p.effects.cage is not None
    cage = p.effects.cage._replace(friction=0.0)
    zero = np.zeros(3)
    height = standard_scene().bearing.roller_mass_offset * cage.axis_axial
    centre = np.array([cage.roller_height, 1.5e-4, height])
    axis = np.array([cage.axis_radial, 0.0, cage.axis_axial])
    depth = cage.bar_cosine * (1.5e-4 - cage.half_clearance)
    azimuth = math.atan2(centre[1], centre[0])
    speeds = np.array([-5.0, -1.0, 0.0, 1.0])
    states = []
    for speed in speeds:
        motion = naive.Motion(centre, axis, np.array([0.0, speed, 0.0]), zero, zero, zero, zero)
        states.append(packed(in_orbit_frame(motion)[0], azimuth))
    found = through(lanes, pockets, np.array(states), 7, p.roller, cage)
    normal = naive_step.turned(-azimuth, np.array([cage.bar_sine, cage.bar_cosine, 0.0]))
    push = 2.0 * np.maximum(cage.stiffness * depth + cage.damping * cage.bar_cosine * speeds, 0.0)
    assert push[0] == 0.0 < push[1]
    np.testing.assert_allclose(found[:, :3], -push[:, None] * normal, atol=1e-4 * push.max())


@pytest.mark.parametrize("field", [*range(6), *range(9, 15)])
def test_a_nan_is_seen_in_rib_and_pocket(lanes: Any, field: int) -> None:
    p = parameters()
    cases = rib_cases(8, 7)
    states = np.array([packed(m) for m in cases])
    states[5, field] = np.nan
    found = through(lanes, ribs, states, 8, p.effects.rib, p.effects.damping)
    assert np.isnan(found[5, :6]).any()
    assert np.isfinite(np.delete(found, 5, axis=0)).all()
    places, advances = pocket_cases(8, 8)
    states = np.array([packed(in_orbit_frame(m)[0], a) for m, a in zip(places, advances, strict=True)])
    states[5, field] = np.nan
    found = through(lanes, pockets, states, 7, p.roller, p.effects.cage)
    assert np.isfinite(np.delete(found, 5, axis=0)).all()
    if field < 3:
        assert np.isnan(found[5, :6]).any()
