"""Shape of a cylindrical pair in a recording: it is stored, read back and drawn as the bearing is."""

from __future__ import annotations

from dataclasses import asdict, replace

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.cylindrical import CylindricalBearing
from beardyn_core.config import load_any_bearing
from beardyn_core.record import meshes
from beardyn_core.record.description import BearingShape, RunDescription
from test.bearings import CYLINDRICAL, TAPERED
from test.record.synthetic_run import description


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


def beyond_the_raceway(mesh: meshes.Mesh, raceway: float, inwards: bool) -> np.ndarray:
    """Places along y of what stands more than 1 mm above a raceway."""
    radius = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 2])
    above = radius < raceway - 1e-3 if inwards else radius > raceway + 1e-3
    found: np.ndarray = mesh.vertices[above, 1]
    return found


@pytest.mark.parametrize("name", CYLINDRICAL)
@pytest.mark.parametrize("cup_ribs", ["none", "inner", "outer", "both"])
@pytest.mark.parametrize("cone_ribs", ["none", "inner", "outer", "both"])
def test_ribs_of_both_rings_stand_beside_the_rollers_on_their_sides(
    name: str, cup_ribs: str, cone_ribs: str
) -> None:
    bearing = load_any_bearing(name)
    assert isinstance(bearing, CylindricalBearing)
    bearing = replace(bearing, cup_ribs=cup_ribs, cone_ribs=cone_ribs)
    shape = BearingShape(**asdict(BearingShape.of(bearing)))
    for mesh, raceway, inwards, sides, height in (
        (meshes.cup(shape), bearing.cup_radius, True, cup_ribs, bearing.cup_rib_height),
        (meshes.cone(shape), bearing.cone_radius, False, cone_ribs, bearing.cone_rib_height),
    ):
        places = beyond_the_raceway(mesh, raceway, inwards)
        for row in (-1.0, 1.0):
            off = row * places[np.sign(places) == row] - 0.5 * bearing.row_spacing
            # beyond the ends of the rollers, and nowhere between
            assert np.abs(off).min(initial=1.0) >= 0.5 * bearing.roller_length
            assert bool((off > 0.0).any()) is (sides in ("outer", "both"))
            assert bool((off < 0.0).any()) is (sides in ("inner", "both"))
        radius = np.hypot(mesh.vertices[:, 0], mesh.vertices[:, 2])
        if sides != "none":
            tip = radius.min() if inwards else radius[radius < bearing.cup_radius].max()
            assert tip == pytest.approx(raceway - height if inwards else raceway + height)
        assert np.abs(mesh.vertices[:, 1]).max() == pytest.approx(0.5 * bearing.width)


def test_a_recording_of_a_rib_that_no_bearing_has_is_refused() -> None:
    run = description()
    for wrong in (replace(run.shape, cup_ribs="left"), replace(run.shape, cup_rib_height=-1.0)):
        with pytest.raises(InputError, match="a rib of the bearing is none"):
            RunDescription.from_json(replace(run, shape=wrong).to_json())
