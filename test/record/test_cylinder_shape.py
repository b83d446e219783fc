"""Shape of a cylindrical pair in a recording: it is stored, read back and drawn as the bearing is."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest

from beardyn_core.config import load_any_bearing
from beardyn_core.record import meshes
from beardyn_core.record.description import BearingShape
from test.bearings import CYLINDRICAL, TAPERED


@pytest.mark.parametrize("name", [*CYLINDRICAL, *TAPERED])
def test_raceways_of_the_picture_are_those_of_the_bearing(name: str) -> None:
    bearing = load_any_bearing(name)
    shape = BearingShape(**asdict(BearingShape.of(bearing)))
    assert shape.is_cylindrical is (bearing.kind == "cylindrical")
    for ring, radius in (("cup", bearing.cup_radius), ("cone", bearing.cone_radius)):
        place, found = meshes.raceway_radius(shape, ring, 0.0)
        assert found == pytest.approx(radius, rel=2e-4)
        # both ends of a contact: as far from the axle as the angle of the raceway has it
        ends = [meshes.raceway_radius(shape, ring, way) for way in (-0.02, 0.02)]
        slope = (ends[1][1] - ends[0][1]) / (ends[1][0] - ends[0][0])
        angle = bearing.cup_angle if ring == "cup" else bearing.cone_angle
        assert np.arctan(slope) == pytest.approx(angle, abs=1e-9)
        assert abs(place) < 0.005


@pytest.mark.parametrize("name", CYLINDRICAL)
def test_rollers_of_the_picture_fill_the_space_between_the_raceways(name: str) -> None:
    bearing = load_any_bearing(name)
    shape = BearingShape.of(bearing)
    roller = meshes.roller(shape).vertices
    across = np.hypot(roller[:, 1], roller[:, 2]).max()
    assert 2.0 * across == pytest.approx(bearing.cup_radius - bearing.cone_radius, rel=1e-9)
    assert np.abs(roller[:, 0]).max() == pytest.approx(0.5 * bearing.roller_length)
    for mesh in (meshes.cup(shape), meshes.cone(shape), meshes.cage(shape, 0), meshes.cage(shape, 1)):
        assert np.isfinite(mesh.vertices).all()
