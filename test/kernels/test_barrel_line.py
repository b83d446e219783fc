"""Contact lines of barrels against those of the statics, and what their gradients must not do."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from beardyn_core.base.jit import entry
from beardyn_core.bearing.spherical import SphericalBearing
from beardyn_core.config import load_any_bearing
from beardyn_core.physics.barrel_line import barrel_line, barrel_params
from beardyn_core.physics.statics import barrel_contacts
from beardyn_core.physics.statics.roller_contacts import ConePose, contact_model

SIDES = {"cup": 1.0, "cone": -1.0}
PLACES = {"cup": (9e-5, 2e-5, 2e-4), "cone": (-2e-5, 1e-5, -1e-4)}
LAMINAE = 12
Array = np.ndarray[Any, Any]


@entry
def lines(centre: Any, axis: Any, ring_axis: Any, side: Any, barrel: Any) -> Any:
    """Give approach, normal, moment, turn and slope of the moment of one barrel."""
    line = barrel_line(centre, axis, ring_axis, 0.0, side, barrel)
    curve = line.curve
    return line.approach, line.normal, curve.moment, curve.turn, curve.moment_slope


def bearing_of() -> SphericalBearing:
    bearing = load_any_bearing("SRB120x260")
    assert isinstance(bearing, SphericalBearing)
    return bearing


def line_of(ring: str, centre: Array, axis: Array, ring_axis: Array) -> tuple[Array, ...]:
    unit, upright = axis / np.linalg.norm(axis), ring_axis / np.linalg.norm(ring_axis)
    barrel = barrel_params(bearing_of(), ring, LAMINAE)
    found = lines(tuple(centre), tuple(unit), tuple(upright), SIDES[ring], barrel)
    return tuple(np.array(each) for each in found)


@pytest.mark.parametrize("ring", SIDES)
def test_approach_and_gradients_are_those_of_the_statics(ring: str) -> None:
    bearing = bearing_of()
    model = contact_model(bearing, 0.0, LAMINAE, 0.0, 0.0)
    radial, axial, tilt = PLACES[ring]
    roller = np.broadcast_to((radial, axial, tilt), (2, bearing.roller_count, 3)).copy()
    pose = ConePose(np.zeros(3), np.eye(3))
    statics = (
        barrel_contacts.cup_contacts(model, roller, pose)
        if ring == "cup"
        else barrel_contacts.cone_contacts(model, roller)
    )
    lean, x = bearing.roller_slant + tilt, model.abscissa
    centre = np.array([0.5 * bearing.pitch_diameter + radial, 0.0, 0.5 * bearing.row_spacing + axial])
    approach, normal, moment, turn, slope = line_of(
        ring, centre, np.array([math.sin(lean), 0.0, math.cos(lean)]), np.array([0.0, 0.0, 1.0])
    )
    found = approach[0] + x * (approach[1] + x * (approach[2] + x * approach[3]))
    assert statics.approach[1, 0].max() > 1e-5
    np.testing.assert_allclose(found, statics.approach[1, 0], atol=1e-14)
    moved = np.stack([normal[0] + x * turn[0], normal[2] + x * turn[2], moment[1] + x * slope[1]], axis=1)
    np.testing.assert_allclose(moved, statics.by_roller[1, 0], atol=1e-12)


@pytest.mark.parametrize("ring", SIDES)
def test_normal_forces_of_a_skewed_barrel_turn_neither_ring_nor_roller(ring: str) -> None:
    """About the middle of the sphere nothing at all, about the cone's axis and the roller's own no torque."""
    bearing = bearing_of()
    centre = np.array([0.5 * bearing.pitch_diameter + 5e-5, 1e-5, 0.5 * bearing.row_spacing + 3e-5])
    lean = bearing.roller_slant + 2e-4
    axis = np.array([math.sin(lean), 5e-3, math.cos(lean)])
    axis /= np.linalg.norm(axis)
    ring_axis = np.array([1e-3, -5e-4, 1.0])
    ring_axis /= np.linalg.norm(ring_axis)
    _, normal, moment, turn, slope = line_of(ring, centre, axis, ring_axis)
    for force, couple in ((normal, moment), (turn, slope)):
        about = np.cross(centre, force) + couple
        whole = about if ring == "cup" else about @ ring_axis
        np.testing.assert_allclose(whole, 0.0, atol=1e-14)
        assert abs(couple @ axis) < 1e-14
