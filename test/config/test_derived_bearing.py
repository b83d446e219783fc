"""A bearing file of five numbers, and bearings that are saved and load again equal."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

import beardyn_core as bd
from beardyn_core.base.edge import write_noun
from beardyn_core.config import shipped_names
from beardyn_core.config.nouns import bearing_from_mapping

FIVE: dict[str, Any] = {
    "roller_count": 20,
    "pitch_diameter_mm": 180,
    "roller_diameter_mm": 24,
    "roller_length_mm": 45,
    "contact_angle_deg": 10,
}


def write(folder: Path, keys: dict[str, Any]) -> Path:
    path = folder / "mine.yaml"
    path.write_text("\n".join(f"{key}: {value}" for key, value in keys.items()) + "\n")
    return path


def test_a_file_of_five_numbers_is_the_bearing_made_in_code(tmp_path: Path) -> None:
    path = write(tmp_path, {"derive": "true", **FIVE})
    made = bd.bearing(rollers=20, **{key: value for key, value in FIVE.items() if key != "roller_count"})
    assert bd.bearing(path) == made
    assert all(text.startswith(("assumed", "derived")) for _, text in made.sources)
    assert bd.scene("static_80kN", bearing=str(path), effects="standard").bearing == made


def test_what_the_file_gives_is_kept_with_its_source(tmp_path: Path) -> None:
    path = write(
        tmp_path,
        {
            "derive": "true",
            **FIVE,
            "cup_mass_kg": "{value: 9.0, source: weighed}",
            "cage": "{mass_kg: 0.5}",
            "bore_mm": 131,
        },
    )
    bearing, derived = bd.bearing(path), bd.bearing(write(tmp_path, {"derive": "true", **FIVE}))
    sources = dict(bearing.sources)
    assert (bearing.cup_mass, bearing.cage.mass, bearing.bore) == (9.0, 0.5, 0.131)
    assert sources["cup_mass"] == "weighed"
    assert not {"cage.mass", "bore"} & set(sources)  # given, and nobody says from where
    assert bearing.cage.stiffness == derived.cage.stiffness
    assert bearing.width == derived.width


def test_nothing_is_derived_unless_the_file_asks(tmp_path: Path) -> None:
    with pytest.raises(bd.InputError) as error:
        bd.bearing(write(tmp_path, FIVE))
    said = str(error.value)
    assert "bore_mm is missing" in said
    assert "`derive: true` derives what is missing" in said


@pytest.mark.parametrize("key", FIVE)
def test_one_of_the_five_that_is_missing_is_the_one_mistake(tmp_path: Path, key: str) -> None:
    keys = {name: value for name, value in FIVE.items() if name != key}
    with pytest.raises(bd.InputError) as error:
        bd.bearing(write(tmp_path, {"derive": "true", **keys}))
    (problem,) = error.value.problems
    assert f"{key} is missing" in problem


@pytest.mark.parametrize("value", ["-3", "wide", ".nan", "[1]", "true"])
def test_one_that_is_no_size_is_refused_by_its_key(tmp_path: Path, value: str) -> None:
    with pytest.raises(bd.InputError) as error:
        bd.bearing(write(tmp_path, {"derive": "true", **FIVE, "pitch_diameter_mm": value}))
    assert "pitch_diameter_mm is" in str(error.value)


@pytest.mark.parametrize("name", shipped_names("bearings"))
def test_a_shipped_bearing_that_is_saved_loads_again_equal(tmp_path: Path, name: str) -> None:
    bearing = bd.bearing(name)
    assert bd.bearing(bd.save(bearing, tmp_path / "saved.yaml")) == bearing


@given(
    count=st.integers(14, 22),
    pitch=st.floats(150.0, 220.0),
    roller=st.floats(15.0, 24.0),
    length=st.floats(30.0, 55.0),
    angle=st.floats(8.0, 16.0),
)
def test_a_derived_bearing_that_is_saved_loads_again_the_same(
    tmp_path_factory: pytest.TempPathFactory,
    count: int,
    pitch: float,
    roller: float,
    length: float,
    angle: float,
) -> None:
    """Numbers of which no decimal in the units of the file is exact come back as their neighbours."""
    folder = tmp_path_factory.mktemp("saved")
    try:
        bearing = bd.bearing(
            rollers=count,
            pitch_diameter_mm=pitch,
            roller_diameter_mm=roller,
            roller_length_mm=length,
            contact_angle_deg=angle,
        )
    except bd.InputError:
        return  # rollers that touch each other
    back = bd.bearing(bd.save(bearing, folder / "mine.yaml"))
    assert back.sources == bearing.sources
    for name in ("pitch_diameter", "roller_diameter", "contact_angle", "bore", "cup_mass", "end_play"):
        assert getattr(back, name) == pytest.approx(getattr(bearing, name), rel=1e-15)


def test_lubricant_bearing_data_and_scene_are_saved_too(tmp_path: Path) -> None:
    oil = bd.lubricant("L055")
    assert bd.lubricant(bd.save(oil, tmp_path / "oil.yaml")) == oil
    data = bd.name_plate("6205-2RS JEM")
    assert bd.name_plate(bd.save(data, tmp_path / "data.yaml")) == data
    scene = bd.scene("static_80kN", effects="standard", tier="quasistatic")
    assert bd.scene(bd.save(scene, tmp_path / "scene.yaml")) == scene


@pytest.mark.parametrize(("kind", "shipped"), [("cylindrical", "WJ130x240"), ("spherical", "SRB120x260")])
def test_derive_is_refused_for_what_is_not_tapered(kind: str, shipped: str) -> None:
    for keys, others in (
        ({"kind": kind, **FIVE}, ["is missing"]),
        (write_noun(bd.bearing(shipped)), []),
        ({**write_noun(bd.bearing(shipped)), "rollers": 20}, ["unknown key"]),
    ):
        with pytest.raises(bd.InputError) as error:
            bearing_from_mapping({**keys, "derive": True}, "mine.yaml")
        first, *rest = error.value.problems
        assert first.startswith(f"mine.yaml: derive is for tapered roller bearings; the file of a {kind}")
        assert f"beardyn schema {kind}_bearing" in first
        assert bool(rest) == bool(others)
        assert all(any(other in problem for problem in rest) for other in others)
        assert not any(": derive: " in problem for problem in rest)


@pytest.mark.parametrize(
    ("noun", "said"),
    [
        ("HS130x230", r"the name 'HS130x230'; `beardyn new` copies a shipped file, and bd\.bearing\(name\)"),
        (bd.Run.of_blocks([]), r"a Run; its bearing is run\.bearing"),
        ({"bearing": "HS130x230"}, "a dict; save takes a bearing"),
        (None, "a NoneType; save takes a bearing"),
    ],
)
def test_what_cannot_be_saved_is_named_and_leaves_no_file(noun: Any, said: str, tmp_path: Path) -> None:
    with pytest.raises(bd.InputError, match=said) as error:
        bd.save(noun, tmp_path / "mine.txt")
    assert len(error.value.problems) == 2  # the ending too
    with pytest.raises(bd.InputError, match=said):
        bd.save(noun, tmp_path / "mine.yaml")
    assert not list(tmp_path.iterdir())


def test_saving_replaces_nothing_unasked(tmp_path: Path) -> None:
    bearing, path = bd.bearing("HS130x230"), tmp_path / "mine.yaml"
    bd.save(bearing, path)
    with pytest.raises(bd.InputError, match="exists"):
        bd.save(bearing, path)
    bd.save(bd.bearing(bearing, end_play_mm=0.1), path, force=True)
    assert bd.bearing(path).end_play == 1e-4
    with pytest.raises(bd.InputError, match=r"ends in \.txt; allowed are \.yaml, \.yml"):
        bd.save(bearing, tmp_path / "mine.txt")
