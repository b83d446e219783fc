"""What the benchmarks compare is comparable, and what they write can be read."""

from __future__ import annotations

import json

import numpy as np
import pytest

from beardyn_core.physics.bodies.layout import BODY_STATES, CONE_BODY, CUP_BODY, LINEAR
from benchmarks.naive_model import NaiveModel, forces_against_kernel
from benchmarks.runs import Table, straight_line
from test.kernels.rig import Rig
from test.kernels.states import shaken
from test.scenes import standard_scene


def test_the_plain_model_has_the_forces_of_the_kernel() -> None:
    force_off, torque_off = forces_against_kernel(Rig.at_equilibrium(standard_scene()))
    assert force_off < 1e-6
    assert torque_off < 1e-3


def test_the_plain_model_has_the_forces_of_the_kernel_with_everything_in_motion() -> None:
    """What differs is the generator line, 1e-4 of a contact force at 1 mrad, as in the step's own test."""
    model = NaiveModel(shaken(1))
    naive = model.wrenches(model.initial_state())
    moving = shaken(1)
    moving.parameters = moving.parameters._replace(step=1e-12)
    moving.run(1)
    np.testing.assert_allclose(naive, moving.work.wrenches, atol=1e-4 * 8e4)


def test_the_plain_model_accelerates_the_cone_by_its_forces_and_the_load() -> None:
    model = NaiveModel(shaken(2))
    state = model.initial_state()
    rates = model.rates(0.0, state)[: 4 * BODY_STATES].reshape(4, BODY_STATES)
    mass = model.rig.parameters.mounting.journal_mass
    expected = (model.wrenches(state)[CONE_BODY, :3] + model.rig.load[:3]) / mass
    np.testing.assert_allclose(rates[CONE_BODY, LINEAR : LINEAR + 3], expected)
    assert not rates[CUP_BODY].any()  # held


def test_a_straight_line_is_found_with_its_fit() -> None:
    line = straight_line([1.0, 2.0, 4.0], [5.0, 7.0, 11.0])
    assert (line.offset, line.slope, line.fit) == pytest.approx((3.0, 2.0, 1.0))
    assert straight_line([1.0, 2.0, 3.0], [1.0, 0.0, 1.0]).fit == pytest.approx(0.0)


def test_a_table_survives_json() -> None:
    table = Table("t", "Title", ("name", "us"), [("a", 1.2345), ("b", 12345.6)], "A note.")
    read = json.loads(json.dumps(table.to_json()))
    assert read["rows"] == [{"name": "a", "us": 1.2345}, {"name": "b", "us": 12345.6}]
    assert read["title"] == "Title"
    assert [line.split() for line in table.lines()[3:]] == [
        ["name", "us"], ["a", "1.23"], ["b", "12346"], ["A", "note."],
    ]  # fmt: skip
