"""Tilt of cone against cup: the lengths of the rollers hold it in the lumped tier as in the others."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from beardyn_core.config import load_bearing
from beardyn_core.integrate.roller_contacts import ConePose, contact_model
from beardyn_core.integrate.roller_equilibrium import reach, solve_rollers
from test.tiers.runs import blocks_of
from test.tiers.test_bending import bent_scene

Float = NDArray[np.float64]


@pytest.mark.parametrize("name", ["HS130x230", "METRO120x220"])
@pytest.mark.parametrize("laminae", [4, 20])
def test_straight_rollers_hold_as_a_line_of_springs(name: str, laminae: int) -> None:
    bearing = load_bearing(name)
    line = bearing.effective_length**2 / 12.0 * (1.0 - 1.0 / laminae**2)
    assert reach(bearing, laminae) ** 2 / 3.0 == pytest.approx(line, rel=0.01)
    assert reach(bearing, 1) ** 2 / 3.0 == pytest.approx(0.0, abs=1e-3 * line)


def test_it_is_what_a_tilt_takes_beside_the_arms_of_the_normals() -> None:
    """A tilt of a pressed row about x, of all rollers in equilibrium, beside that of rollers of no length."""
    bearing, tilt, depth = load_bearing("HS130x230"), 2e-5, 2e-5
    cosine, sine = np.cos(tilt), np.sin(tilt)
    rotation = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    push = np.array([0.0, -depth / np.sin(bearing.cup_angle), 0.0])

    def moment(laminae: int) -> float:
        model = contact_model(bearing, 0.0, laminae, 0.0, 0.0)
        there = [solve_rollers(model, ConePose(push, turn), None) for turn in (rotation, rotation.T)]
        return float(there[0].cone_force[3] - there[1].cone_force[3]) / (2.0 * tilt)

    model = contact_model(bearing, 0.0, 20, 0.0, 0.0)
    load = solve_rollers(model, ConePose(push, np.eye(3)), None).cup.force[1].sum(axis=-1)
    tangent = 10.0 / 9.0 * load / depth
    held = 0.5 * float(tangent.sum()) * reach(bearing, 20) ** 2 / 3.0
    assert moment(1) - moment(20) == pytest.approx(held, rel=0.15)


@pytest.mark.parametrize("kind", ["rings", "modes"])
def test_deflection_and_tilt_under_a_box_that_bends_are_those_of_quasistatic(kind: str) -> None:
    """`smooth_run`: the cup tilts in a box that bends unevenly."""
    found = {}
    for tier in ("lumped", "quasistatic"):
        blocks = blocks_of(bent_scene(tier, kind, "smooth_run"), 0.4)[10:]
        pose = np.concatenate([block.body_pose[:, :2] for block in blocks])
        found[tier] = (pose[:, 1] - pose[:, 0]).mean(axis=0)
    lumped, quasistatic = found["lumped"], found["quasistatic"]
    size = np.linalg.norm(quasistatic[:3])
    assert np.linalg.norm(lumped[:3] - quasistatic[:3]) < 0.02 * size
