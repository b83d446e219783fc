"""Tilt of cone against cup: the lengths of the rollers hold it in the lumped tier as in the others."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.bearing.profile import Profile
from beardyn_core.config import load_bearing
from beardyn_core.physics.bodies.layout import CONE_BODY, CUP_BODY, POSITION
from beardyn_core.physics.roller_spring import lever_of_cup
from beardyn_core.physics.statics.roller_contacts import ConePose, contact_model
from beardyn_core.physics.statics.roller_equilibrium import reach, solve_rollers, spring_params
from beardyn_core.run import start
from test.runs import blocks_of
from test.tiers.bent_box import bent_scene

Float = NDArray[np.float64]


@pytest.mark.parametrize("name", ["HS130x230", "METRO120x220"])
def test_straight_rollers_hold_as_a_line_of_springs(name: str) -> None:
    bearing = load_bearing(name)
    assert reach(bearing) == pytest.approx(0.5 * bearing.effective_length, rel=0.01)


@pytest.mark.parametrize("drop_um", [5.0, 30.0, 80.0])
@pytest.mark.parametrize("laminae", [1, 2, 3, 6])
def test_crowned_rollers_hold_less_whatever_the_laminae(laminae: int, drop_um: float) -> None:
    straight = load_bearing("HS130x230")
    bearing = replace(straight, profile=Profile("crowned", drop=1e-6 * drop_um))
    assert 0.0 < spring_params(bearing, laminae).reach < reach(straight)


def test_it_is_what_a_tilt_takes_about_the_point_where_it_pushes_nothing_across() -> None:
    """Forces of a pressed row, all rollers in equilibrium, after small tilts about x and motions along z."""
    bearing, tilt, shift, depth = load_bearing("HS130x230"), 2e-5, 1e-7, 2e-5
    model = contact_model(bearing, 0.0, 20, 0.0, 0.0)

    def force(about_x: float, along_z: float) -> Float:
        cosine, sine = np.cos(about_x), np.sin(about_x)
        rotation = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
        place = np.array([0.0, -depth / np.sin(bearing.cup_angle), along_z])
        found: Float = solve_rollers(model, ConePose(place, rotation), None).cone_force
        return found

    by_tilt = (force(-tilt, 0.0) - force(tilt, 0.0)) / (2.0 * tilt)
    by_shift = (force(0.0, -shift) - force(0.0, shift)) / (2.0 * shift)
    pushed = np.array([0.0, -depth / np.sin(bearing.cup_angle), 0.0])
    load = solve_rollers(model, ConePose(pushed, np.eye(3)), None)
    tangent = 10.0 / 9.0 * load.cup.force[1].sum(axis=-1) / depth
    held = 0.5 * float(tangent.sum()) * reach(bearing) ** 2 / 3.0
    assert by_tilt[3] - by_tilt[2] * by_shift[3] / by_shift[2] == pytest.approx(held, rel=0.02)


def test_deflection_and_tilt_in_a_box_that_opens_its_rows_unevenly_are_those_of_quasistatic() -> None:
    """`smooth_run` in a box with modes; rollers of no length let the cone go 11 % of it too far."""
    found, lever = {}, lever_of_cup(load_bearing("HS130x230"))
    for tier in ("lumped", "quasistatic"):
        blocks = blocks_of(bent_scene(tier, "modes", "smooth_run"), 0.4)[10:]
        pose = np.concatenate([block.body_pose[:, :2] for block in blocks])
        apart = (pose[:, 1] - pose[:, 0]).mean(axis=0)
        found[tier] = np.array([*apart[:3], lever * apart[3], lever * apart[5]])
    size = np.linalg.norm(found["quasistatic"])
    assert np.linalg.norm(found["lumped"] - found["quasistatic"]) < 0.01 * size


def test_a_bent_box_stays_where_it_was_put() -> None:
    """The start and the step have one law of what lengths hold; rollers as drawn, for waves move the cone."""
    twin = start(replace(bent_scene("lumped", "modes", "smooth_run"), scatter=None), 0.02).twin
    before = _apart(twin.snapshot().state.bodies)
    twin.advance()
    moved = _apart(twin.snapshot().state.bodies) - before
    assert np.abs(moved).max() < 0.02 * np.abs(before).max()


def _apart(bodies: Float) -> Float:
    """Displacement of the cone against the cup."""
    return np.array(bodies[CONE_BODY, POSITION : POSITION + 3] - bodies[CUP_BODY, POSITION : POSITION + 3])
