"""Frequencies of the loaded box in the fast tiers, beside an eigenproblem of its own."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from beardyn_core.physics.bodies.layout import CONE_BODY, CUP_BODY, LINEAR, POSITION
from beardyn_core.physics.modal_body import ModalBody, body_of
from beardyn_core.physics.roller_spring import lever_of_cup
from beardyn_core.physics.statics.roller_contacts import ConePose, contact_model
from beardyn_core.physics.statics.roller_equilibrium import load_of_approach, solve_rollers
from beardyn_core.physics.tiers.state import State
from beardyn_core.physics.tiers.tier_bending import step_body
from beardyn_core.scene.scene import Scene
from beardyn_core.twin import Twin
from test.tiers.bent_box import Float, bent_scene, started, stepped
from test.tiers.runs import FAST

STRIDE, CALLS = 8, 20  # steps between two looks at the state, looks


@pytest.mark.parametrize("tier", FAST)
def test_frequencies_of_the_loaded_box_are_those_of_an_independent_eigenproblem(tier: str) -> None:
    """Mass and stiffness of rings, all modes of the table and contact springs, up to 4 kHz: within 1 %.

    The kernel starts on one eigenvector after the other; its phase in 20 calls, against a run without,
    tells the frequency: later the fastest have died away, and phases are those of the rest. Springs of the
    contacts are those of the static solution, for the lumped tier slopes of its law of a single roller.
    """
    scene = bent_scene(tier, "modes", "static_5kN")
    # preloaded: of a roller at the edge of a load zone a nanometre decides whether it is a spring
    scene = replace(scene, end_play=-1e-4, mounting=replace(scene.mounting, cup="suspended"))
    # creep of the raceways damps, the eigenproblem does not
    scene = replace(scene, effects=replace(scene.effects, film=None, traction=None))
    body, h = body_of(scene), 1.0 / 25600.0
    assert body is not None
    twin = started(scene)
    p = twin._kernel_parameters
    stepped(twin, 3200, 0.0)  # settled without turning
    assert twin._state is not None
    rest = twin._state.copy()
    motion = rest.bodies[CONE_BODY, POSITION : POSITION + 6] - rest.bodies[CUP_BODY, POSITION : POSITION + 6]
    fitted = step_body(scene, h)
    assert fitted is not None
    bent = np.linalg.pinv(fitted.share) @ rest.flex[0]
    springs = _springs if tier == "lumped" else _laminae
    # cup (6), journal (3), modes of the table
    relative = np.zeros((5 + len(body.rate), 9 + len(body.rate)))
    relative[range(5), [0, 1, 2, 3, 5]] = -1.0
    relative[range(3), [6, 7, 8]] = 1.0
    relative[5:, 9:] = np.eye(len(body.rate))
    stiffness = relative.T @ springs(scene, body, motion[[0, 1, 2, 3, 5]], bent) @ relative
    box = p.base.mounting.coupling
    mass = np.eye(9 + len(body.rate))
    mass[:6, :6] = box.mass
    mass[6:9, 6:9] *= p.base.mounting.journal_mass
    assert body.suspension is not None
    stretch = np.concatenate([np.eye(6), np.zeros((6, 3)), body.suspension], axis=1)
    stiffness += stretch.T @ box.stiffness @ stretch
    stiffness[9:, 9:] += np.diag(body.rate**2)
    root = np.linalg.cholesky(mass)
    inner = np.linalg.solve(root, np.linalg.solve(root, stiffness).T)
    squares, vectors = np.linalg.eigh(0.5 * (inner + inner.T))
    vectors = np.linalg.solve(root.T, vectors)
    rates = np.sqrt(np.maximum(squares, 0.0))
    tested = np.flatnonzero((rates > 2e3) & (rates < 2.0 * np.pi * (4e3 if tier == "quasistatic" else 2e3)))
    assert len(tested) > 5
    errors = [
        _frequency(twin, rest, vectors[:, index], mass, rates[index], fitted.share, h) for index in tested
    ]
    # the eigenproblem has no mass of rollers: 8 kg between rings of 100 kg and more, 1.3 % in one mode
    assert np.abs(errors).max() < (0.015 if tier == "quasistatic" else 0.01), errors


def _springs(scene: Scene, body: ModalBody, pose: Float, bent: Float) -> Float:
    """Stiffness of rollers as single springs against pose and modes, shape [5 + mode, 5 + mode]."""
    bearing = scene.bearing
    approach, load = load_of_approach(bearing, scene.numerics.laminae)
    order = np.argsort(approach)
    slope = np.gradient(load[order], approach[order])
    azimuth = 2.0 * np.pi * np.arange(bearing.roller_count) / bearing.roller_count
    angle, lever, side = bearing.cup_angle, lever_of_cup(bearing), np.array([[-1.0], [1.0]])
    across, along = np.sin(azimuth) + 0.0 * side, np.cos(azimuth) + 0.0 * side
    rigid = [math.cos(angle) * across, -math.sin(angle) * side + 0.0 * along, math.cos(angle) * along]
    normal = np.stack([*rigid, side * lever * along, -side * lever * across], axis=2)
    normal = np.concatenate([normal, -math.cos(angle) * body.openings(azimuth)], axis=2)
    normal = normal.reshape(-1, normal.shape[2])
    depth = normal @ np.concatenate([pose, bent]) - 0.5 * scene.end_play * math.sin(angle)
    spring = np.where(depth > 0.0, np.interp(depth, approach[order], slope), 0.0)
    # both contacts of a roller are lines of springs, which hold a tilt in its meridian plane
    plane = np.stack([along, -across], axis=2).reshape(-1, 2)
    square = bearing.effective_length**2 / 12.0
    stiffness = (normal.T * spring) @ normal
    stiffness[3:5, 3:5] += square * (plane.T * spring) @ plane
    return np.asarray(stiffness)


def _laminae(scene: Scene, body: ModalBody, pose: Float, bent: Float) -> Float:
    """The same of rollers in balance with their laminae, from the static solution."""
    model = contact_model(scene.bearing, scene.end_play, scene.numerics.laminae, 0.0, 0.0, body=body)
    about_x, about_z = pose[3:]
    turn = np.array([[1.0, -about_z, 0.0], [about_z, 1.0, -about_x], [0.0, about_x, 1.0]])
    return solve_rollers(model, ConePose(pose[:3], turn, bent), None).cone_stiffness


def _frequency(
    twin: Twin, rest: State, vector: Float, mass: Float, rate: float, share: Float, h: float
) -> float:
    """Relative error of the frequency of a loaded mode in the running kernel."""
    size, back = 1e-8, np.linalg.pinv(share)
    state = rest.copy()
    # velocities half a step later than places
    speed = -rate * math.sin(0.5 * rate * h)
    state.bodies[CUP_BODY, POSITION : POSITION + 6] += size * vector[:6]
    state.bodies[CONE_BODY, POSITION : POSITION + 3] += size * vector[6:9]
    state.bodies[CUP_BODY, LINEAR : LINEAR + 6] += size * speed * vector[:6]
    state.bodies[CONE_BODY, LINEAR : LINEAR + 3] += size * speed * vector[6:9]
    state.flex[0] += size * share @ vector[9:]
    state.flex[1] += size * speed * share @ vector[9:]
    phases, other = [], rest.copy()
    for _ in range(CALLS):
        twin._state = state
        stepped(twin, STRIDE, 0.0)
        twin._state = other
        stepped(twin, STRIDE, 0.0)

        def amount(field: int, flex: int) -> float:
            cup = (state.bodies - other.bodies)[CUP_BODY, field : field + 6]
            cone = (state.bodies - other.bodies)[CONE_BODY, field : field + 3]
            bent = back @ (state.flex - other.flex)[flex]
            return float(vector @ mass @ np.concatenate([cup, cone, bent])) / size

        place, speed = amount(POSITION, 0), amount(LINEAR, 1) / rate
        lag = 0.5 * rate * h  # place at t, speed at t + h / 2
        phases.append(math.atan2(-(speed + math.sin(lag) * place) / math.cos(lag), place))
    times = STRIDE * h * np.arange(1, CALLS + 1)
    late = np.unwrap(np.array(phases) - rate * times)
    return float(np.polyfit(times, late, 1)[0]) / rate
