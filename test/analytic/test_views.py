"""Compiled poses, twists, contacts and instants say what the array formulas say."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.physics.bodies.arrangement import Arrangement
from beardyn_core.physics.bodies.layout import (
    AXIS,
    BODY_STATES,
    CAGE_BODY,
    CONE_BODY,
    CONTACT_OUTPUT,
    LARGEST,
    OUTPUT_FIELDS,
    RATE,
    ROLLER_FIELDS,
    TILT,
    TURN,
)
from beardyn_core.physics.tiers.kinematics import INSTANT_ROLLERS, Snapshots, write_instants
from beardyn_core.physics.tiers.parameters import RollerParams
from test.analytic import naive_views

COUNT, CAGE_PLACE, TIMES = 17, 0.031, 3
ROLLER = RollerParams(**{name: 0.01 * (i + 1) for i, name in enumerate(RollerParams._fields)})


def random_states(width: int) -> tuple[np.ndarray, np.ndarray, Arrangement]:
    """States all over the range of every angle, a unit axis, every other contact open."""
    random, arrangement = np.random.default_rng(width), Arrangement(COUNT, width)
    rollers = 5.0 * random.normal(size=(TIMES, arrangement.block_count, ROLLER_FIELDS, width))
    rollers[:, :, AXIS : AXIS + 3] /= np.linalg.norm(rollers[:, :, AXIS : AXIS + 3], axis=2, keepdims=True)
    rollers[:, :, LARGEST:] **= 2
    for kind in range(4):
        first = CONTACT_OUTPUT + kind * OUTPUT_FIELDS
        rollers[:, kind % 2 :: 2, first : first + 3] = 0.0
    bodies = random.normal(size=(TIMES, 4, BODY_STATES))
    bodies[0, :, TILT : TILT + 3] = 0.0
    return rollers, bodies, arrangement


@pytest.mark.parametrize("width", [1, 8])
def test_snapshots_are_those_of_the_array_formulas(width: int) -> None:
    rollers, bodies, arrangement = random_states(width)
    views = naive_views.RollerViews(rollers, bodies, arrangement, ROLLER)
    found = Snapshots(rollers, bodies, COUNT, ROLLER, CAGE_PLACE)
    shape = (TIMES, 2 * COUNT)
    pose = [naive_views.ring_pose(bodies, CAGE_PLACE), views.pose().reshape(*shape, 7)]
    twist = [naive_views.ring_twist(bodies), views.twist().reshape(*shape, 6)]
    np.testing.assert_allclose(found.pose(), np.concatenate(pose, axis=1), rtol=1e-12, atol=1e-13)
    np.testing.assert_allclose(found.twist(), np.concatenate(twist, axis=1), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(found.contacts(), views.contacts(), rtol=1e-12, atol=1e-13)
    assert not found.contacts()[..., 3:6].all()


@pytest.mark.parametrize("width", [1, 8])
def test_instants_hold_load_shaft_cages_and_rollers(width: int) -> None:
    rollers, bodies, arrangement = random_states(width)
    views = naive_views.RollerViews(rollers, bodies, arrangement, ROLLER)
    loads = np.random.default_rng(1).normal(size=(4 * TIMES + 1, 10))
    found = np.empty((TIMES, INSTANT_ROLLERS + 4 * COUNT))
    write_instants(rollers, bodies, loads, 4, COUNT, found)
    expected = np.concatenate(
        [
            loads[4::4, :6],
            bodies[:, CONE_BODY, [TURN, RATE]],
            bodies[:, CAGE_BODY:, TURN],
            bodies[:, CAGE_BODY:, RATE],
            views.orbit_angle.reshape(TIMES, -1),
            views.orbit_speed.reshape(TIMES, -1),
        ],
        axis=1,
    )
    np.testing.assert_allclose(found, expected, rtol=1e-14)
