"""How the bearing is held: offset loads, restrained tilt, mass and springs beside the bearing."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

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
    TILT,
)
from beardyn_core.physics.bodies.losses import ENERGY_TERMS
from beardyn_core.physics.bodies.rigid_bodies import drift_bodies
from beardyn_core.physics.statics.static import solve
from beardyn_core.physics.suspension import BOX_FIELDS, BoxCoupling, box_energy, kick_box, mounting_params
from beardyn_core.physics.tiers.parameters import GravityParams
from beardyn_core.scene.mounting import Mounting
from test.kernels.rig import Float
from test.runs import constant_load, started
from test.scenes import scene_with, standard_scene

BESIDE = Mounting(
    box_centre=(0.02, 0.03, -0.05), suspension_centre=(0.01, -0.04, 0.06), box_inertia=(3.0, 3.0, 3.0)
)


def loaded(**options: object) -> tuple[int, ...]:
    bearing = standard_scene().bearing
    return solve(bearing, (0.0, 1.5e4, 8e4), end_play=2e-4, laminae=6, **options).loaded_roller_count  # type: ignore[arg-type]


def test_restrained_tilt_lies_between_free_and_locked() -> None:
    """80 kN radial, 15 kN axial: free tilt spreads the load over far more rollers of one row than locked."""
    free, locked = loaded(tilt="free"), loaded(tilt="locked")
    assert max(free) >= 15
    assert max(locked) < max(free)
    held = [max(loaded(tilt="free", tilt_stiffness=(k, k))) for k in (0.0, 1e6, 1e7, 1e8, 1e12)]
    assert held == sorted(held, reverse=True)
    assert held[0] == max(free)
    assert held[-1] == max(locked)


def test_stiff_suspension_tilts_the_bearing_less_at_the_start() -> None:
    """Journal locked, box on springs: the bearing tilts as far as they let the box go; moments balance."""
    load = constant_load((0.0, 1.5e4, 8e4), 122.0)
    tilts = []
    for stiffness in (1e3, 1e7, 1e9):
        scene = scene_with(
            end_play=2e-4, cup="suspended", journal_tilt="locked", rotational_stiffness=(stiffness,) * 3
        )
        twin = started(scene, load)
        assert twin._state is not None
        tilt = twin._state.bodies[CONE_BODY, [TILT, TILT + 2]]
        tilts.append(float(np.linalg.norm(tilt)))
        held = twin._parameters.mounting.preload[[3, 5]]
        np.testing.assert_allclose(held, stiffness * tilt, rtol=1e-9, atol=1e-9)
    assert tilts[0] > 1.5 * tilts[1] > 2.0 * tilts[2]


def test_offset_load_is_the_load_with_its_moment() -> None:
    """80 kN at 40 mm along the axle: the state at the start is that under 80 kN and r x F."""
    scene = scene_with(journal_tilt="free")
    offset = replace(scene, mounting=replace(scene.mounting, load_offset=(0.01, 0.04, -0.02)))
    force = (2e3, 5e3, 8e4)
    moment = np.cross((0.01, 0.04, -0.02), force)
    one = started(offset, constant_load(force, 122.0))
    two = started(scene, constant_load(force, 122.0, 10.0, *moment))
    assert one._state is not None
    assert two._state is not None
    np.testing.assert_allclose(one._state.bodies, two._state.bodies, rtol=1e-9, atol=1e-15)
    block = one.advance()
    np.testing.assert_allclose(block.load[:, 3:], np.repeat(moment[None], len(block.load), axis=0), atol=1e-6)
    np.testing.assert_allclose(block.force_waveform, two.advance().force_waveform, rtol=1e-6, atol=1e-3)


def test_eccentric_load_moves_to_the_nearer_row() -> None:
    """40 mm off the middle: the radial load is shared as by a beam on the pressure centres.

    One lamina: with more, the tilt moves the load to the ends of the rollers and with it the pressure
    centres. The cone tilts freely, so the thrust of the loaded row presses all rollers of the other one.
    """
    bearing = standard_scene().bearing
    centred = solve(bearing, (0.0, 0.0, 8e4), end_play=2e-4, laminae=1, tilt="free")
    moment = np.cross((0.0, 0.04, 0.0), (0.0, 0.0, 8e4))
    beside = solve(bearing, (0.0, 0.0, 8e4), moment, end_play=2e-4, laminae=1, tilt="free")
    assert centred.loaded_roller_count[0] == centred.loaded_roller_count[1]
    azimuth = 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
    radial = (beside.cup_load * np.cos(azimuth)).sum(axis=1)
    assert radial[1] / radial.sum() == pytest.approx(0.5 + 0.04 / bearing.pressure_centre_spread, rel=0.02)
    assert beside.cup_load[1].max() > 1.3 * centred.cup_load[1].max()
    assert beside.loaded_roller_count[0] == bearing.roller_count


def moving_box(
    mounting: Mounting, steps: int, step: float, gravity: float
) -> tuple[Float, Float, BoxCoupling]:
    """Box alone from a shove: places [step, 6], energies of motion, spring and loss [step, 4]."""
    params = mounting_params(standard_scene().bearing, mounting, np.zeros(6))
    bodies = np.zeros((4, BODY_STATES))
    bodies[CUP_BODY, LINEAR : LINEAR + 3] = (0.01, -0.02, 0.03)
    bodies[CUP_BODY, ANGULAR : ANGULAR + 3] = (0.1, 0.2, -0.1)
    box, energy, load = np.zeros(BOX_FIELDS), np.zeros(ENERGY_TERMS), np.zeros(10)
    places, energies = np.zeros((steps, 6)), np.zeros((steps, 4))
    for k in range(steps):
        drift_bodies(bodies, step)
        before = box_energy(bodies, params, params.coupling)
        worked = energy.copy()
        stored = kick_box(
            bodies,
            np.zeros(6),
            load,
            load,
            energy,
            box,
            step,
            params,
            GravityParams(gravity),
            params.coupling,
        )
        places[k, :3] = bodies[CUP_BODY, POSITION : POSITION + 3]
        places[k, 3:] = bodies[CUP_BODY, TILT : TILT + 3]
        motion = 0.5 * (before + box_energy(bodies, params, params.coupling))
        # works, too, at the middle of the step
        works = 0.5 * (worked + energy)
        energies[k] = motion, stored, works[ENERGY_LOST + LOSS_SUSPENSION], works[ENERGY_EXTERNAL]
    assert params.coupling is not None
    return places, energies, params.coupling


def test_box_beside_the_bearing_swings_as_its_matrices_say() -> None:
    """Free motion of 50 ms against the exponential of the first-order system."""
    step, steps = 1e-5, 5000
    places, _, c = moving_box(BESIDE, steps, step, 0.0)
    system = np.block(
        [
            [np.zeros((6, 6)), np.eye(6)],
            [-np.linalg.solve(c.mass, c.stiffness), -np.linalg.solve(c.mass, c.damping)],
        ]
    )
    values, vectors = np.linalg.eig(system)
    start = np.concatenate([np.zeros(6), [0.01, -0.02, 0.03, 0.1, 0.2, -0.1]])
    # velocities stand half a step before the first kick
    at = step * np.arange(1, steps + 1)
    exact = (vectors * np.linalg.solve(vectors, start.astype(complex))) @ np.exp(np.outer(values, at))
    assert np.all(np.abs(places - exact[:6].real.T) < 3e-3 * np.abs(places).max(axis=0))


def test_energy_of_a_box_beside_the_bearing_is_kept() -> None:
    """Motion and spring lose what dampers spend and win what gravity does, to second order."""
    _, energies, _ = moving_box(BESIDE, 5000, 1e-5, 9.81)
    motion, stored, lost, external = energies.T
    balance = motion + stored - external + lost
    assert np.ptp(balance) < 1e-3 * lost[-1]
    assert np.ptp(external) > 0.1 * lost[-1]


def test_mass_and_springs_at_their_places_do_the_same_as_their_matrices() -> None:
    """Kinetic energy from the speed of the centre of mass, spring force from the stretch at the spring."""
    bearing = standard_scene().bearing
    c = mounting_params(bearing, BESIDE, np.zeros(6)).coupling
    assert c is not None
    rng = np.random.default_rng(2)
    v, w = rng.normal(size=3), rng.normal(size=3)
    twist = np.concatenate([v, w])
    centre = np.array(BESIDE.box_centre)
    at_centre = v + np.cross(w, centre)
    about_centre = np.diag(BESIDE.box_inertia) - BESIDE.box_mass * (
        centre @ centre * np.eye(3) - np.outer(centre, centre)
    )
    # products of inertia about the bearing centre are taken as zero, so they are not zero about the mass's
    energy = 0.5 * BESIDE.box_mass * at_centre @ at_centre + 0.5 * w @ about_centre @ w
    energy += 0.5 * bearing.cup_mass * v @ v + 0.5 * w @ np.diag(bearing.cup_inertia) @ w
    assert 0.5 * twist @ c.mass @ twist == pytest.approx(energy, rel=1e-12)
    arm = np.array(BESIDE.suspension_centre)
    force = np.array(BESIDE.stiffness) * (v + np.cross(w, arm))
    moment = np.array(BESIDE.rotational_stiffness) * w + np.cross(arm, force)
    np.testing.assert_allclose(c.stiffness @ twist, np.concatenate([force, moment]), rtol=1e-12)
    pull = np.array([0.0, 0.0, -BESIDE.box_mass])
    np.testing.assert_allclose(c.weight[3:], np.cross(centre, pull), rtol=1e-12, atol=1e-15)


def test_box_beside_the_bearing_starts_at_rest() -> None:
    """The suspension carries load and weight with their moments at the start: nothing falls."""
    scene = scene_with(cup="suspended", end_play=1e-4)
    scene = replace(scene, mounting=replace(BESIDE, journal_tilt="locked"))
    twin = started(scene, constant_load((0.0, 0.0, 8e4), 122.0))
    for _ in range(3):
        block = twin.advance()
    assert twin._state is not None
    box = twin._state.bodies[CUP_BODY]
    # 10 ms of unbalanced weight would be 0.5 mm and half a degree
    assert np.abs(box[POSITION : POSITION + 3]).max() < 2e-5
    assert np.abs(box[TILT : TILT + 3]).max() < math.radians(0.02)
    assert block.audit is not None
    assert block.audit.residual < 1e-3


def test_hardly_displaced_box_moves_as_one_at_the_centre() -> None:
    """The full matrices with vanishing arms are the plain box, to rounding."""
    plain = scene_with(cup="suspended", end_play=1e-4)
    near = replace(plain, mounting=replace(plain.mounting, box_centre=(1e-14, 0.0, 0.0)))
    load = constant_load((1e3, 2e3, 8e4), 122.0)
    one, two = started(plain, load).advance(), started(near, load).advance()
    half = slice(0, len(one.force_waveform) // 2)  # rounding grows, as in all chaotic motion
    np.testing.assert_allclose(one.force_waveform[half], two.force_waveform[half], atol=1e-5)
