"""A box fitted to another bearing: sizes in proportion, one that every shipped bearing fits in, refusals."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.config.folders import find
from beardyn_core.config.load import read_scene_mapping
from beardyn_core.config.nouns import box_for, load_any_bearing, load_bearing, load_box
from beardyn_core.config.yaml_text import read_file
from beardyn_core.scene.mounting import Mounting
from beardyn_core.structure.box import Box
from beardyn_core.structure.build import modes_of
from beardyn_core.structure.fitting import fit_box
from beardyn_core.structure.mounted_box import mounting_of, require_cup, table_path
from beardyn_core.structure.table import read_table
from test.bearings import TAPERED
from test.finite_elements import need_finite_elements

FREIGHT = "high_speed_FR130x230x150"
STANDING = {"kind": "constant", "force_kN": [0, 0, 80], "speed_rpm": 500}


def high_speed() -> Box:
    box = load_box("high_speed")
    assert isinstance(box, Box)
    return box


def test_a_box_for_its_own_bearing_stays_as_it_is() -> None:
    own = load_bearing("HS130x230")
    assert fit_box(high_speed(), own, own) == high_speed()


def test_sizes_follow_the_outer_diameter_across_and_the_width_along_the_axle() -> None:
    own = load_bearing("HS130x230")
    carried = replace(own, outer_diameter=1.1 * own.outer_diameter, width=0.9 * own.width)
    box, found = high_speed(), fit_box(high_speed(), own, carried)
    scale = np.array([1.1, 0.9, 1.1])
    assert (found.outer_diameter, found.length) == pytest.approx((1.1 * box.outer_diameter, 0.9 * box.length))
    for block, drawn in zip(found.blocks, box.blocks, strict=True):
        assert block.centre == pytest.approx(scale * drawn.centre)
        assert block.size == pytest.approx(scale * drawn.size)
    for seat, before in zip(
        (*found.sensors, *found.suspension), (*box.sensors, *box.suspension), strict=True
    ):
        assert seat.name == before.name
        assert seat.position == pytest.approx(scale * before.position)
    assert found.discs[0].thickness == pytest.approx(0.9 * box.discs[0].thickness)
    assert (found.damping_ratio, found.density) == (box.damping_ratio, box.density)


def test_the_shipped_file_like_another_one_is_what_the_command_fits() -> None:
    shipped, fitted = load_box(FREIGHT), box_for(high_speed(), "FR130x230x150")
    assert isinstance(shipped, Box)
    assert shipped.name == fitted.name == FREIGHT
    assert replace(shipped, description="") == replace(fitted, description="")


def test_the_shipped_table_is_as_heavy_as_its_sizes_say() -> None:
    """Against high_speed, 160 mm wide: lighter by less than the width is smaller, stiffer by the same.

    The cup of FR130x230x150 has a smaller raceway, so its wall is thicker: more mass, stiffer.
    """
    own, other = read_table(table_path("high_speed")), read_table(table_path(FREIGHT))
    narrower = 150.0 / 160.0
    assert narrower < other.mass / own.mass < 1.0
    ratio = np.array(other.inertia) / np.array(own.inertia)
    assert ((ratio > narrower - 0.02) & (ratio < 1.01)).all()
    first, before = other.frequency[:10], own.frequency[:10]
    assert (np.abs(first / before - 1.0) < 0.15).all()
    require_cup(other, load_bearing("FR130x230x150"))
    mounting = mounting_of(other, Mounting(), load_bearing("FR130x230x150"))
    assert 60.0 < mounting.box_mass < 80.0


def test_a_scene_of_the_bearing_takes_the_fitted_box_by_its_name() -> None:
    path = find("scenes", "service_freight")
    effects = {"preset": "standard", "structure": {"kind": "modes", "table": FREIGHT}}
    data = {**read_file(path), "effects": effects, "operation": STANDING}
    del data["background"]  # of a train that runs
    scene = read_scene_mapping(data, "mine", path.parent).scene
    assert scene.mounting.box_mass + scene.bearing.cup_mass == pytest.approx(
        read_table(table_path(FREIGHT)).mass
    )
    other = {**data, "bearing": "METRO120x220"}
    with pytest.raises(InputError, match=r"beardyn structure BOX --bearing METRO120x220 -o box\.csv"):
        read_scene_mapping(other, "mine", path.parent)


@pytest.mark.slow
@pytest.mark.parametrize("name", TAPERED)
def test_every_shipped_bearing_fits_in_the_box(name: str) -> None:
    """Of one mesh and up to 3 kHz: mass and inertia as the size of the cup, first modes against it."""
    need_finite_elements()
    bearing, own = load_bearing(name), load_bearing("HS130x230")
    modes = modes_of(box_for(high_speed(), name), bearing, mesh=0.05, highest=3000.0).modes
    require_cup(modes, bearing)
    across, along = bearing.outer_diameter / own.outer_diameter, bearing.width / own.width
    table = read_table(table_path("high_speed"))
    assert modes.mass == pytest.approx(table.mass * across**2 * along, rel=0.06)
    assert modes.inertia[1] == pytest.approx(table.inertia[1] * across**4 * along, rel=0.1)
    assert modes.frequency[:2] == pytest.approx(table.frequency[:2] / across, rel=0.12)
    assert {seat: modes.places[seat] for seat in table.seats}.keys() == table.places.keys()


@pytest.mark.parametrize("name", ["freight_box", "freight_WJ130x240"])
def test_the_coarsest_mesh_has_modes_near_those_of_the_shipped_one(name: str) -> None:
    """Edges of 60 mm for 15 mm; so large elements flatten where their edges follow the bore."""
    need_finite_elements()
    box, table = load_box(name), read_table(table_path(name))
    assert isinstance(box, Box)
    modes = modes_of(box, load_any_bearing(box.bearing), mesh=0.06, highest=3000.0).modes
    assert modes.mass == pytest.approx(table.mass, rel=0.01)
    # coarse elements are stiffer, never softer
    stiffer = modes.frequency[:4] / table.frequency[:4]
    assert stiffer.min() > 1.0
    assert stiffer.max() < 1.06


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("name: a\nlike: high_sped\nbearing: HS130x230\n", "did you mean high_speed"),
        ("name: a\nlike: b.yaml\nbearing: HS130x230\n", "b.yaml', whose file has the key like; it must be"),
        ("name: a\nlike: c.yaml\nbearing: HS130x230\n", "c.yaml', whose file has the key modes"),
        ("name: a\nlike: high_speed\n", "bearing is missing"),
        ("name: a\nlike: high_speed\nbearing: HS130\n", "HS130"),
        ("name: a\nlike: high_speed\nbearing: HS130x230\nlength_mm: 3\n", "length_mm: unknown key"),
    ],
)
def test_a_file_like_another_one_that_cannot_be_is_refused(text: str, sentence: str, tmp_path: Path) -> None:
    (tmp_path / "a.yaml").write_text(text)
    (tmp_path / "b.yaml").write_text("name: b\nlike: high_speed\nbearing: HS130x230\n")
    (tmp_path / "c.yaml").write_text("name: c\nmodes: c.unv\nbearing: HS130x230\n")
    with pytest.raises(InputError) as refused:
        load_box(tmp_path / "a.yaml")
    assert sentence in str(refused.value)


def test_the_command_refuses_a_bearing_that_is_none_and_one_for_modes_that_are_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command.main(["structure", "high_speed", "--bearing", "FR130x230"]) == command.BAD_INPUT
    assert "did you mean FR130x230x150" in capsys.readouterr().err
    path = tmp_path / "mine.yaml"
    path.write_text(
        "name: mine\nbearing: HS130x230\nmodes: modes.unv\n"
        "mass_kg: 70\ninertia_kg_m2: [1, 2, 3]\nproducts_kg_m2: [0, 0, 0]\n"
        "sensors: [{name: top, position_mm: [0, 0, 170]}]\n"
    )
    assert command.main(["structure", str(path), "--bearing", "HS130x230"]) == command.BAD_INPUT
    assert "leave --bearing, --mesh, --highest and --waves out" in capsys.readouterr().err
