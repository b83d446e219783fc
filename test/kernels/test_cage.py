"""Pockets of every kind of cage, and lands, against plain formulas, integrals and their own energy."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from beardyn_core.effects import Cage, CageModel, KinematicCage, LandGuidance, PocketFilm, RotatingCage
from beardyn_core.physics.bodies.layout import (
    ANGULAR,
    BODY_STATES,
    CAGE_BODY,
    CONE_BODY,
    LINEAR,
    POSITION,
    RATE,
    TILT,
)
from beardyn_core.physics.cage.land import LandParams
from beardyn_core.physics.cage.play import loose_params
from beardyn_core.physics.lanes.lanes import Lanes
from beardyn_core.physics.tiers.parameters import Parameters
from test.kernels import naive_cage, naive_step
from test.kernels.cage_entries import bars, journals, kinematic_pockets, lands, rotating_pockets
from test.kernels.casting import through
from test.kernels.entries import pockets
from test.kernels.naive import Motion
from test.kernels.rig import parameters_of
from test.kernels.states import packed
from test.kernels.test_rib_and_pocket import in_orbit_frame, pocket_cases
from test.scenes import standard_scene

Float = NDArray[np.float64]
LANES8 = Lanes(8)
CAGES: dict[str, CageModel] = {
    "dry": Cage(),
    "lubricated": Cage(lubrication=PocketFilm(layer=4e-4)),
    "rotating": RotatingCage(),
    "kinematic": KinematicCage(),
}
ENTRIES = {"rotating": rotating_pockets, "kinematic": kinematic_pockets}


@cache
def parameters(cage: CageModel) -> Parameters:
    scene = standard_scene()
    scene = replace(scene, effects=replace(scene.effects, cage=cage))
    return parameters_of(scene)


def results(kind: str, cases: list[Motion], advances: Float, lanes: Any = LANES8, cage: Any = None) -> Float:
    p = parameters(CAGES[kind])
    states = [packed(in_orbit_frame(m)[0], a) for m, a in zip(cases, advances, strict=True)]
    entry = ENTRIES.get(kind, pockets)
    return through(lanes, entry, np.array(states), 7, p.roller, cage or p.effects.cage)


@pytest.mark.parametrize("half_clearance", [None, 0.0, -2e-6], ids=["play", "no play", "interference"])
@pytest.mark.parametrize("kind", CAGES)
def test_pocket_wrench_is_the_plain_formula(kind: str, half_clearance: float | None, lanes: Any) -> None:
    """No file can say a negative clearance; a free cage presses both bars, a rotating one knows none."""
    if kind == "rotating" and half_clearance == -2e-6:
        half_clearance = 0.0
    p = parameters(CAGES[kind])
    cage = p.effects.cage
    assert cage is not None
    if half_clearance is not None:
        cage = cage._replace(half_clearance=half_clearance, half_end_clearance=abs(half_clearance))
    cases, advances = pocket_cases(120, 5)
    pressed = 0
    for motion, advance, found in zip(
        cases, advances, results(kind, cases, advances, lanes, cage), strict=True
    ):
        azimuth = in_orbit_frame(motion)[1]
        untilted = replace(motion, ring_axis=np.array([0.0, 0.0, 1.0]))
        expected = naive_cage.pocket_wrench(untilted, motion.ring_axis, advance, azimuth, p.roller, cage)
        size = np.linalg.norm(expected.force)
        pressed += int(size > 1.0)
        force = naive_step.turned(azimuth, found[:3])
        moment = naive_step.turned(azimuth, found[3:6])
        # the depth loses 1e-9 of the 0.1 m it is measured over; the film's wedge sees it at 2 um: 5e-8
        assert np.linalg.norm(force - expected.force) <= 1e-7 * size + 1e-6
        assert np.linalg.norm(moment - expected.moment) <= (1e-7 * size + 1e-6) * 0.05
        assert found[6] == pytest.approx(expected.energy, rel=1e-6, abs=1e-12)
    assert pressed > 10


def at_front_bar(gap: float, approach: float, spin: float) -> tuple[Motion, Float]:
    """An upright roller that stands `gap` off the front bar."""
    p = parameters(CAGES["lubricated"])
    cage = p.effects.cage
    assert cage is not None
    place = cage.half_clearance - gap / cage.bar_cosine
    height = standard_scene().bearing.roller_mass_offset * cage.axis_axial
    centre = np.array([cage.roller_height, place, height])
    axis = np.array([cage.axis_radial, 0.0, cage.axis_axial])
    normal = np.array([cage.bar_sine, cage.bar_cosine, 0.0])
    zero = np.zeros(3)
    motion = Motion(centre, axis, approach * normal, spin * axis, zero, zero, zero)
    return motion, np.array([math.atan2(centre[1], centre[0])])


def front_load(gap: float, approach: float = 0.0, spin: float = 0.0, cage: Any = None) -> float:
    motion, advance = at_front_bar(gap, approach, spin)
    azimuth = in_orbit_frame(motion)[1]
    force = naive_step.turned(azimuth, results("lubricated", [motion], advance, cage=cage)[0, :3])
    base = parameters(CAGES["lubricated"]).effects.cage
    assert base is not None
    # without friction along the normal, but for the lean of the roller's surface speed
    return -float(force @ np.array([base.bar_sine, base.bar_cosine, 0.0]))


def test_film_load_is_continuous_from_the_open_gap_to_the_pressed_wall() -> None:
    """No jump where the layer ends, where the film is thinnest, and where the wall is touched."""
    cage = parameters(CAGES["lubricated"]).effects.cage
    assert cage is not None
    assert cage.film is not None
    far = cage._replace(half_end_clearance=1.0)
    for gap in (1.0 / cage.film.inverse_layer, cage.film.thinnest, 0.0):
        before, after = (front_load(gap + shift, spin=500.0, cage=far) for shift in (1e-10, -1e-10))
        assert abs(before - after) <= 1e-3 * (abs(before) + 1.0)
    gaps = np.geomspace(1e-4, 2e-6, 12)
    loads = np.array([front_load(gap, spin=500.0, cage=far) for gap in gaps])
    assert np.all(np.diff(loads) > 0.0)
    assert loads[-1] > 50.0


def test_opening_film_pulls_no_harder_than_to_nothing() -> None:
    cage = parameters(Cage(lubrication=PocketFilm())).effects.cage
    assert cage is not None
    speeds = (-0.1, 0.0, 0.02, 10.0)
    loads = [front_load(5e-6, -speed, spin=500.0, cage=cage) for speed in speeds]
    assert loads[0] > loads[1] > loads[2] > 1.0
    assert abs(loads[3]) < 0.5  # shear of the leaning faces


def test_film_of_no_viscosity_is_a_dry_pocket() -> None:
    cage = parameters(CAGES["lubricated"]).effects.cage
    assert cage is not None
    assert cage.film is not None
    cases, advances = pocket_cases(40, 6)
    thin = cage._replace(film=cage.film._replace(wedge=0.0, squeeze=0.0, shear=0.0))
    found = results("lubricated", cases, advances, cage=thin)
    dry = results("dry", cases, advances)
    np.testing.assert_allclose(found, dry, rtol=1e-12, atol=1e-12)


def test_wear_opens_every_pocket_by_half_on_each_side() -> None:
    fresh, worn = (parameters(Cage(pocket_wear=wear)).effects.cage for wear in (0.0, 2e-4))
    assert fresh is not None
    assert worn is not None
    assert worn.half_clearance - fresh.half_clearance == pytest.approx(1e-4, rel=1e-12)
    assert worn._replace(half_clearance=fresh.half_clearance) == fresh
    assert fresh == parameters(Cage()).effects.cage


@settings(max_examples=60, deadline=None)
@given(
    st.integers(0, 10_000),
    st.sampled_from(["dry", "lubricated"]),
    st.floats(0.005, 5.0),
)
def test_no_pocket_makes_energy(seed: int, kind: str, viscosity: float) -> None:
    """Power of the whole force less what the springs store, at viscosities from warm oil to pitch."""
    scene = standard_scene()
    thick = replace(scene.lubricant, density=scene.lubricant.density * viscosity / 0.05)
    scene = replace(scene, lubricant=thick, effects=replace(scene.effects, cage=CAGES[kind]))
    p = parameters_of(scene)
    cases, advances = pocket_cases(8, seed)
    states = np.array([packed(in_orbit_frame(m)[0], a) for m, a in zip(cases, advances, strict=True)])
    assert p.effects.cage is not None
    instant = p.effects.cage._replace(step=0.0)  # over a step a strike gives back what it stores
    found = through(LANES8, pockets, states, 7, p.roller, instant)
    for state, (force, moment), energy in zip(
        states, found[:, :6].reshape(-1, 2, 3), found[:, 6], strict=True
    ):
        centre, velocity, omega = state[0:3], state[9:12], state[12:15]
        ring_velocity, ring_omega = state[15:18], state[18:21]
        relative = velocity - ring_velocity - np.cross(ring_omega, centre)
        power = float(force @ relative + moment @ (omega - ring_omega))
        # what the springs take up: their energy a moment later
        dt = 1e-9
        later = state.copy()
        later[0:3] += dt * relative
        turn = np.cross(omega - ring_omega, state[3:6])
        later[3:6] += dt * turn
        grown = through(LANES8, pockets, later[None], 7, p.roller, instant)[0, 6] - energy
        # the walls turn a little with the roller's arm, 1e-3 of a mN over 10 um of depth
        assert -power - grown / dt >= -2e-2 * (1.0 + math.sqrt(energy))


# --- land


def land_params(**options: Any) -> LandParams:
    cage = parameters(Cage(guidance=LandGuidance(**options))).effects.cage
    assert cage is not None
    assert cage.land is not None
    return cage.land


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.5, 0.9])
@pytest.mark.parametrize(("opening", "whirl"), [(0.0, 30.0), (0.0, -30.0), (0.02, 30.0), (-0.02, 30.0)])
def test_land_film_is_the_integral_of_the_short_bearings_pressure(
    ratio: float, opening: float, whirl: float
) -> None:
    land, scene = land_params(), standard_scene()
    viscosity = scene.lubricant.dynamic_viscosity(scene.temperature)
    speed_sum = 170.0
    clearance = land.clearance
    # ratio times whirl speed less half the speed sum is `whirl`: about +y, from z towards x
    ahead = whirl + 0.5 * speed_sum * ratio
    case = np.array([[0.0, ratio * clearance, ahead * clearance, opening * clearance, speed_sum]])
    out = np.zeros((1, 3))
    journals(case, out, land)
    radial, forward = naive_cage.short_bearing_force(
        viscosity, land.radius, 2.0 * land.half_width, clearance, ratio, opening, whirl
    )
    size = math.hypot(radial, forward)
    if ratio == 0.0:  # the direction of no eccentricity is free: any direction damps alike
        assert math.hypot(out[0, 0], out[0, 1]) == pytest.approx(size, rel=1e-3)
    else:
        assert out[0, 1] == pytest.approx(radial, abs=1e-3 * size)
        assert out[0, 0] == pytest.approx(forward, abs=1e-3 * size)


def land_state(seed: int, spread: float) -> Float:
    rng = np.random.default_rng(seed)
    bodies = np.zeros((4, BODY_STATES))
    for body in (CONE_BODY, CAGE_BODY, CAGE_BODY + 1):
        bodies[body, POSITION : POSITION + 3] = rng.normal(0.0, spread, 3)
        bodies[body, TILT : TILT + 3] = rng.normal(0.0, 1e-3, 3) * [1.0, 0.0, 1.0]
        bodies[body, LINEAR : LINEAR + 3] = rng.normal(0.0, 0.1, 3)
        bodies[body, ANGULAR : ANGULAR + 3] = rng.normal(0.0, 1.0, 3) * [1.0, 0.0, 1.0]
    bodies[CONE_BODY, RATE] = rng.uniform(-150.0, 150.0)
    bodies[CAGE_BODY:, RATE] = rng.uniform(-60.0, 60.0)
    return bodies


@settings(max_examples=100, deadline=None)
@given(
    st.integers(0, 10_000), st.sampled_from(["cup", "cone"]), st.floats(1e-6, 6e-4), st.sampled_from([2, 3])
)
def test_no_land_makes_energy(seed: int, on: str, spread: float, body: int) -> None:
    """Lost part of the wrench against the motion of the cage in its ring: never a gain."""
    land, bodies, out = land_params(on=on), land_state(seed, spread), np.zeros(13)
    place = 0.5 * standard_scene().bearing.row_spacing
    lift = place if body > CAGE_BODY else -place
    lands(bodies, out, body, lift, land)
    ring = int(land.body)
    third = np.array([0.0, 1.0, 0.0])
    axis = {b: naive_step.rotated(bodies[b, TILT : TILT + 3], third) for b in (body, ring)}
    omega = {b: bodies[b, ANGULAR : ANGULAR + 3] + bodies[b, RATE] * axis[b] for b in (body, ring)}
    arm = bodies[body, POSITION : POSITION + 3] - bodies[ring, POSITION : POSITION + 3] + lift * third
    moving = (
        bodies[body, LINEAR : LINEAR + 3] - bodies[ring, LINEAR : LINEAR + 3] - np.cross(omega[ring], arm)
    )
    turning = omega[body] - omega[ring]
    power = float(out[6:9] @ moving + out[9:12] @ turning)
    # the axes lean 1 mrad against each other, which the half-speed frame of the film neglects
    scale = float(np.linalg.norm(out[6:9]) * np.linalg.norm(moving) + np.linalg.norm(out[9:12]) * 200.0)
    assert power <= 2e-3 * scale


@pytest.mark.parametrize("on", ["cup", "cone"])
def test_edges_of_a_land_touch_when_the_clearance_is_closed(on: str) -> None:
    """A cage shifted by the clearance and 5 um: both edges carry 5 um each, back towards the middle."""
    land, out = land_params(on=on), np.zeros(13)
    bodies = np.zeros((4, BODY_STATES))
    place = 0.5 * standard_scene().bearing.row_spacing
    bodies[3, POSITION] = land.clearance + 5e-6
    lands(bodies, out, 3, place, land)
    assert out[0] == pytest.approx(-2.0 * land.stiffness * 5e-6, rel=1e-9)
    assert out[12] == pytest.approx(land.stiffness * 25e-12, rel=1e-9)
    np.testing.assert_allclose(out[6:12], 0.0, atol=1e-12)
    # no film at rest; tilted about the land's middle, one edge only
    bodies[3, POSITION] = land.clearance - 1e-6
    bodies[3, TILT + 2] = -2e-3
    bodies[3, POSITION] -= 2e-3 * land.place
    lands(bodies, out, 3, place, land)
    reach = 2e-3 * land.half_width - 1e-6
    assert out[0] == pytest.approx(-land.stiffness * reach, rel=1e-2)


def test_bound_of_the_land_film_keeps_its_resistance_below_what_the_step_bears() -> None:
    p = parameters(Cage(guidance=LandGuidance()))
    cage = p.effects.cage
    assert cage is not None
    assert cage.land is not None
    land = cage.land
    assert 0.5 < land.most_eccentric < 0.99
    case = np.array([[0.0, land.clearance, 0.0, 0.1, 0.0]])
    out = np.zeros((1, 3))
    journals(case, out, land)
    assert 0.0 < -out[0, 1] / 0.1 * p.step / cage.mass < 0.3


@pytest.mark.parametrize("spin", [-12.0, 0.02, 0.5, 5.0])
@pytest.mark.parametrize("kind", ["dry", "lubricated"])
def test_the_bar_of_a_loose_roller_is_two_touches_of_the_full_cage(
    kind: str, spin: float, lanes: Any
) -> None:
    """Depths down to twice the layer of the film apart; a roller that does not skew feels both ends alike.

    Below 0.4 m/s the bar is dry, from 0.6 m/s on it has its film.
    """
    scene = replace(standard_scene(), effects=replace(standard_scene().effects, cage=CAGES[kind]))
    p = parameters_of(scene)
    loose, cage, radius = loose_params(scene, p.step), p.effects.cage, p.roller.radius
    assert loose is not None
    assert cage is not None
    rng = np.random.default_rng(7)
    depth = np.concatenate([rng.uniform(-8e-4, 3e-5, 60), rng.uniform(-2e-6, 2e-6, 60)])
    cases = np.stack([depth, rng.normal(0.0, 0.05, 120)], axis=1)
    found = through(lanes, bars, cases, 2, spin, radius, p.step, loose)
    carried, share = 0, min(max((abs(spin) - 0.4) / 0.2, 0.0), 1.0)
    for (deep, rate), (load, friction) in zip(cases, found, strict=True):
        wet, bare = (
            naive_cage.wall_loads(deep, rate, abs(spin), abs(spin), radius, cage, film)
            for film in (cage.film, None)
        )
        expected = [share * one + (1.0 - share) * other for one, other in zip(wet, bare, strict=True)]
        assert load == pytest.approx(2.0 * expected[0], rel=1e-9, abs=1e-12)
        assert friction == pytest.approx(-2.0 * expected[1] * spin, rel=1e-9, abs=1e-12)
        carried += int(deep < 0.0 and load > 0.0)
    assert (carried > 20) == (kind == "lubricated" and share > 0.0)
