"""Bending of the cup: thin-ring formulas, what it does to the load zone, energy, and its absence."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.bearing.ring_bending import ThinRing, cup_ring, housing_ring, rectangular_ring
from beardyn_core.effects import EffectSet, RingStructure
from beardyn_core.physics.bodies.layout import (
    ANGLE,
    ANGULAR,
    CONE,
    CONTACT_OUTPUT,
    CUP,
    ELASTIC,
    ENERGY_LOST,
    LINEAR,
    LOSS_STRUCTURE,
    MOMENTUM,
    OUTPUT_FIELDS,
    OUTPUT_FORCE,
    RADIUS,
    RATE,
    RIB,
    ROLLER_STATES,
    SIGNAL_FORCE,
    VELOCITY,
)
from beardyn_core.physics.modal_body import body_of
from beardyn_core.physics.oscillators import exact_oscillators
from beardyn_core.physics.statics.static import solve
from test.kernels.momentum import assert_momentum_is_exchanged
from test.kernels.rig import Float, Rig
from test.kernels.states import shaken
from test.runs import constant_load, started
from test.scenes import LOAD_80_KN, scene_with, standard_scene

FLEXIBLE = replace(EffectSet(), structure=RingStructure())
STEPS = 512


def deflection(ring: ThinRing, loads: Float, angles: Float, at: Float, highest: int) -> Float:
    """Radial deflection under outward point loads, a sum over the modes."""
    total = np.zeros_like(at)
    for n in range(2, highest + 1):
        k = ring.modal_stiffness(n)
        a = float(loads @ np.cos(n * angles)) / k
        b = float(loads @ np.sin(n * angles)) / k
        total += a * np.cos(n * at) + b * np.sin(n * at)
    return total


def test_two_opposite_loads_open_a_ring_as_in_the_tables() -> None:
    """Roark's formulas for stress and strain, circular rings, case 1: 0.1488 and 0.1366 W R^3 / EI."""
    ring = ThinRing(radius=0.12, rigidity=2.3e3, mass=8.0)
    pair = np.array([0.0, math.pi])
    unit = 1e4 * ring.radius**3 / ring.rigidity
    opened = deflection(ring, np.array([1e4, 1e4]), pair, np.array([0.0, 0.5 * math.pi]), 60)
    assert 2.0 * opened[0] / unit == pytest.approx(0.1488, abs=1e-4)
    assert 2.0 * opened[1] / unit == pytest.approx(-0.1366, abs=1e-4)
    # up to four waves it is 0.8 % short of that
    short = deflection(ring, np.array([1e4, 1e4]), pair, np.array([0.0]), 4)
    assert 2.0 * short[0] / unit == pytest.approx(0.1488, rel=0.015)


@pytest.mark.parametrize("waves", [2, 3, 4])
def test_frequency_of_a_free_ring(waves: int) -> None:
    """Rayleigh (1894), art. 233: w^2 = EI / (m R^4) n^2 (n^2 - 1)^2 / (n^2 + 1), m per length."""
    ring = rectangular_ring(0.1, 0.01, 0.16, 206e9, 8.0)
    per_length = ring.mass / (2.0 * math.pi * ring.radius)
    expected = ring.rigidity / (per_length * ring.radius**4)
    expected *= waves**2 * (waves**2 - 1) ** 2 / (waves**2 + 1)
    assert ring.modal_stiffness(waves) / ring.modal_mass(waves) == pytest.approx(expected, rel=1e-12)


def test_mass_of_the_cup_ring_is_that_of_its_section() -> None:
    """The wall taken at mid-length and the width give the stated mass of the cup within 10 %."""
    bearing = standard_scene().bearing
    ring = cup_ring(bearing)
    wall = 2.0 * (0.5 * bearing.outer_diameter - ring.radius)
    section = wall * bearing.width * bearing.material.density * 2.0 * math.pi * ring.radius
    assert section == pytest.approx(bearing.cup_mass, rel=0.1)
    housing = housing_ring(bearing, 0.025, 170e9, 7100.0)
    assert housing.mass == pytest.approx(7100.0 * 0.16 * math.pi * (0.14**2 - 0.115**2), rel=1e-12)


def frictionless(rig: Rig) -> Rig:
    """The same kernel with friction and damping of no size, everything at rest, and hardly a step."""
    p = rig.parameters
    effects = p.effects
    assert effects.mixed is not None
    assert effects.damping is not None
    mixed = effects.mixed._replace(friction=0.0, film_friction=0.0)
    damping = effects.damping._replace(time_constant=0.0)
    rig.parameters = p._replace(step=1e-13, effects=effects._replace(mixed=mixed, damping=damping))
    rig.state.bodies[:, LINEAR : LINEAR + 3] = 0.0
    rig.state.bodies[:, ANGULAR : ANGULAR + 3] = 0.0
    rig.state.bodies[:, RATE] = 0.0
    rig.state.rollers[:, VELOCITY : VELOCITY + 3] = 0.0
    rig.state.rollers[:, MOMENTUM : MOMENTUM + 3] = 0.0
    rig.state.flex[1] = 0.0
    rig.load[6] = 0.0
    return rig


def looked_at(rig: Rig) -> tuple[float, Float, Float]:
    """Elastic energy of all contacts, forces on the modes and fields of the rollers, state untouched."""
    kept = rig.state
    rig.state = kept.copy()
    rig.run(1)
    structure = rig.parameters.effects.structure
    assert structure is not None
    energy = float(rig.work.sums[:, 0, ELASTIC].sum())
    modal = structure.shapes @ rig.work.bend.forces
    fields = rig.fields()
    rig.state = kept
    return energy, modal, fields


def bent(seed: int, width: int = 8) -> Rig:
    """A disturbed bearing whose cup is bent by some ten micrometres."""
    rig = shaken(seed, width, scene_with(FLEXIBLE))
    rng = np.random.default_rng(seed)
    mass = np.repeat(masses(), 2)
    rig.state.flex[0, :6] += rng.normal(0.0, 4e-6, 6) * np.sqrt(mass)
    rig.state.flex[1, :6] = rng.normal(0.0, 0.01, 6) * np.sqrt(mass)
    return rig


def parts() -> list[ThinRing]:
    """Cup and housing wall of `FLEXIBLE`."""
    return [cup_ring(standard_scene().bearing), housing_ring(standard_scene().bearing, 0.025, 170e9, 7100.0)]


def masses() -> Float:
    """Modal masses with 2, 3 and 4 waves, [kg]."""
    return np.array([sum(part.modal_mass(n) for part in parts()) for n in (2, 3, 4)])


@pytest.mark.parametrize("width", [8, 1])
def test_force_on_a_mode_is_the_gradient_of_the_contact_energy(width: int) -> None:
    """Central difference of 10 nm.

    The slope of the raceway turns a part of each normal force along the orbit, 3e-4 for amplitudes of
    10 um. That part moves with the material, v, and not with the slope: n - 1/n times 3e-4 differs.
    """
    rig = frictionless(bent(3, width))
    _, modal, _ = looked_at(rig)
    scale = np.abs(modal).max()
    assert scale > 1e3
    for m, n in enumerate((2, 2, 3, 3, 4, 4)):
        energies = []
        for sign in (1.0, -1.0):
            rig.state.flex[0, m] += sign * 5e-8
            energies.append(looked_at(rig)[0])
            rig.state.flex[0, m] -= sign * 5e-8
        gradient = (energies[1] - energies[0]) / 1e-7
        assert modal[m] == pytest.approx(gradient, abs=(n - 1.0 / n) * 3e-4 * scale)


def test_bent_raceway_pushes_a_roller_along_its_orbit_as_its_energy_says() -> None:
    """Force along the orbit of a loaded roller on the slope of the cup: gradient with its azimuth."""
    rig = frictionless(bent(4))
    _, _, fields = looked_at(rig)
    first = CONTACT_OUTPUT + CUP * OUTPUT_FIELDS + OUTPUT_FORCE
    row, k = np.unravel_index(np.argmax(-fields[first]), fields[first].shape)
    states = rig.fields()[:ROLLER_STATES]
    energies, others = [], []
    for sign in (1.0, -1.0):
        moved = states.copy()
        moved[ANGLE, row, k] += sign * 1e-5
        rig.set_fields(moved)
        energies.append(looked_at(rig)[0])
    # what the slope alone adds: the same bearing with a round cup
    rig.set_fields(states)
    rig.state.flex[0] = 0.0
    for sign in (1.0, -1.0):
        moved = states.copy()
        moved[ANGLE, row, k] += sign * 1e-5
        rig.set_fields(moved)
        others.append(looked_at(rig)[0])
    rig.set_fields(states)
    round_force = looked_at(rig)[2]
    arm = fields[RADIUS, row, k]
    torque = (energies[1] - energies[0]) / 2e-5 - (others[1] - others[0]) / 2e-5
    change = fields - round_force
    # force at the contact point, which lies a roller radius farther out
    found = sum(
        change[CONTACT_OUTPUT + c * OUTPUT_FIELDS + OUTPUT_FORCE + 1, row, k] for c in (CUP, CONE, RIB)
    )
    assert abs(torque) > 0.1
    assert found * arm == pytest.approx(torque, rel=0.02)


@pytest.mark.parametrize("seed", [11, 12])
def test_momentum_is_exchanged_exactly_with_a_bent_cup(seed: int) -> None:
    """The modes take no net force and no net moment."""
    assert_momentum_is_exchanged(bent(seed))


def test_modes_move_by_the_force_they_get() -> None:
    """One step of each mode: spring of the beginning, damper of the middle of the step."""
    rig = bent(5)
    p = rig.parameters.effects.structure
    assert p is not None
    h = rig.parameters.step
    before = rig.state.flex.copy()
    lost = rig.state.energy[ENERGY_LOST + LOSS_STRUCTURE]
    rig.run(1)
    place = before[0] + h * before[1]
    np.testing.assert_allclose(rig.state.flex[0], place, rtol=1e-14)
    push = p.shapes @ rig.work.bend.forces
    change = rig.state.flex[1] - before[1]
    middle = before[1] + 0.5 * change
    expected = h * (push - p.stiffness * place - p.damping * middle)
    np.testing.assert_allclose(p.mass * change, expected, rtol=1e-9, atol=1e-12)
    spent = rig.state.energy[ENERGY_LOST + LOSS_STRUCTURE] - lost
    assert spent == pytest.approx(float((h * p.damping * middle**2).sum()), rel=1e-9)


@pytest.mark.parametrize("x", [1e-3, 0.3, 1.0, 1.5])
@pytest.mark.parametrize("ratio", [0.0, 0.02, 0.3])
def test_free_motion_of_a_mode_is_exact(x: float, ratio: float) -> None:
    """Place after 1000 steps that were started on the solution of q'' + 2 d w q' + w^2 q = 0, to rounding."""
    step = 1e-5
    rate = x / step
    mass, damping, inertia = (
        each.item() for each in exact_oscillators(np.array([rate]), np.array([ratio]), step)
    )

    def exact(n: int) -> float:
        turn = rate * math.sqrt(1.0 - ratio**2)
        return math.exp(-ratio * rate * n * step) * math.cos(turn * n * step)

    place, speed = exact(0), (exact(0) - exact(-1)) / step
    for n in range(1, 1001):
        speed += step * (-(rate**2) * place - damping * speed) / inertia
        place += step * speed
        assert place == pytest.approx(exact(n), abs=1e-9)
    assert mass + 0.5 * step * damping == pytest.approx(inertia)


def test_a_mode_that_the_step_does_not_resolve_is_stable_and_right_at_rest() -> None:
    """Twenty radians a step: under a constant force it settles where the spring balances it."""
    step, rate = 1e-5, 2e6
    mass, damping, inertia = (
        each.item() for each in exact_oscillators(np.array([rate]), np.array([0.02]), step)
    )
    place, speed, largest = 0.0, 0.0, 0.0
    for _ in range(20000):
        speed += step * (rate**2 * 1e-6 - rate**2 * place - damping * speed) / inertia
        place += step * speed
        largest = max(largest, abs(place))
    assert place == pytest.approx(1e-6, rel=1e-6)
    # of a step of the force: 1 - cos((n - 1/2) t) / cos(t / 2), 4 sin^2(t / 2) = (rate x step)^2 / mass
    assert largest < 1e-6 * (1.0 + 1.0 / math.sqrt(1.0 - 0.25 * (rate * step) ** 2 / mass))


def test_vectors_and_scalars_agree_with_a_bent_cup() -> None:
    wide, narrow = (Rig.at_equilibrium(scene_with(FLEXIBLE), width=width) for width in (8, 1))
    first, second = wide.run(50)[0], narrow.run(50)[0]
    # rounding of sums around the raceways, and what friction near no slip makes of it
    assert np.abs(first[:, :3] - second[:, :3]).max() < 1e-11 * 8e4
    np.testing.assert_allclose(wide.state.flex, narrow.state.flex, rtol=0.0, atol=1e-14)


def test_flexible_cup_starts_in_equilibrium() -> None:
    """Without friction nothing moves the cup: modes and cup force stay where the static solution put them."""
    rig = Rig.at_equilibrium(scene_with(FLEXIBLE))
    start = rig.state.flex[0].copy()
    assert np.abs(start).max() > 2e-6
    signals, _, _ = rig.run(STEPS)
    assert np.abs(rig.state.flex[0] - start).max() < 0.02 * np.abs(start).max()
    assert np.abs(signals[:100, SIGNAL_FORCE + 2] / 8e4 - 1.0).max() < 0.01


def test_cup_as_stiff_as_one_likes_is_a_rigid_one() -> None:
    """Zero amplitude and absence are the same motion to rounding (512 steps)."""
    stiff = replace(EffectSet(), structure=RingStructure(stiffness_factor=1e13))
    signals, _, _ = Rig.at_equilibrium(scene_with(stiff)).run(STEPS)
    absent, _, _ = Rig.at_equilibrium(scene_with()).run(STEPS)
    np.testing.assert_allclose(signals[:, :3], absent[:, :3], atol=1e-12 * 8e4 * 100)


def test_energy_balance_closes_with_a_flexible_cup() -> None:
    """Half a second at 80 kN, as without it: better than 0.01 %; bending spends next to nothing."""
    twin = started(scene_with(FLEXIBLE), constant_load(LOAD_80_KN, 122.0))
    for _ in range(25):
        block = twin.advance()
    assert block.audit is not None
    assert block.audit.residual < 1e-4
    assert block.status == 0
    assert block.load[:, 2].mean() == pytest.approx(8e4)
    assert block.force_waveform[:, 2].mean() == pytest.approx(8e4, rel=0.01)


def test_flexible_housing_widens_the_load_zone() -> None:
    """80 kN and 0.1 mm end play: the cup follows the load, more rollers share it, softer walls more so.

    Measured 5 loaded rollers of 7 instrumented ones in a stiff rig housing, Zhao et al. (2026), against
    more in a real axlebox: the direction, not the number, is the claim.
    """
    bearing = standard_scene().bearing
    rigid = solve(bearing, LOAD_80_KN, end_play=1e-4, laminae=6)
    largest, loaded = [rigid.largest_roller_load], [sum(rigid.loaded_roller_count)]
    for wall in (0.04, 0.025, 0.015):
        effects = replace(EffectSet(), structure=RingStructure(housing_wall=wall))
        static = solve(bearing, LOAD_80_KN, end_play=1e-4, laminae=6, body=body_of(scene_with(effects)))
        largest.append(static.largest_roller_load)
        loaded.append(sum(static.loaded_roller_count))
        assert static.residual < 1e-4
    assert largest[1] < 0.8 * largest[0]
    assert loaded == sorted(loaded)
    assert loaded[-1] > loaded[0]


def test_static_bending_balances_the_rollers() -> None:
    """Stiffness times amplitude is the rollers' force on each mode, summed by hand."""
    bearing = standard_scene().bearing
    force = (5e3, 1e4, 8e4)
    static = solve(bearing, force, end_play=1e-4, laminae=6, body=body_of(scene_with(FLEXIBLE)))
    azimuth = 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
    radial = static.cup_load * math.cos(bearing.cup_angle)
    for k, n in enumerate((2, 3, 4)):
        pushed = np.array([(radial * np.cos(n * azimuth)).sum(), (radial * np.sin(n * azimuth)).sum()])
        stiffness = sum(part.modal_stiffness(n) for part in parts())
        amplitude = static.bending[2 * k : 2 * k + 2] / math.sqrt(masses()[k])
        np.testing.assert_allclose(stiffness * amplitude, pushed, rtol=1e-6, atol=0.1)


def test_stiffness_with_bending_is_the_change_of_load() -> None:
    """Tangent stiffness, bending following, against a difference of two equilibria."""
    bearing = standard_scene().bearing
    body = body_of(scene_with(FLEXIBLE))
    one, two = (
        solve(bearing, (0.0, 0.0, load), end_play=0.0, laminae=6, body=body)
        for load in (8e4 - 10.0, 8e4 + 10.0)
    )
    compliance = np.linalg.inv(one.stiffness_tilt_held) @ np.array([0.0, 0.0, 20.0])
    np.testing.assert_allclose(two.displacement - one.displacement, compliance, rtol=1e-3, atol=1e-12)
