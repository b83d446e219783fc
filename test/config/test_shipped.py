"""Everything that is shipped loads, and a resolved scene says the same again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import fields, replace
from typing import Any

import pytest
import yaml

from beardyn_core import effects
from beardyn_core.base.edge import is_kind
from beardyn_core.base.units import stem_of
from beardyn_core.bearing.geometry import Material
from beardyn_core.bearing.profile import Profile
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import (
    SCHEMA_KINDS,
    json_schema,
    load_any_bearing,
    load_bearing,
    load_box,
    load_effects,
    load_lubricant,
    load_vehicle,
    scene_text,
    shipped_names,
)
from beardyn_core.config.folders import find
from beardyn_core.config.keys import keys_of
from beardyn_core.config.yaml_text import read_file, read_mapping
from beardyn_core.effects import Drag, EffectSet, Rib, RibMixedFilm
from beardyn_core.effects.catalogue import catalogue
from beardyn_core.scene.mounting import Guidance, Mounting
from beardyn_core.scene.operation import ConstantOperation, QuarterVehicleOperation, Track
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.scene import Numerics
from beardyn_core.scene.sensor import Accelerometer

LOADERS: dict[str, Callable[[str], Any]] = {
    "bearings": load_any_bearing,
    "lubricants": load_lubricant,
    "vehicles": load_vehicle,
    "structures": load_box,
    "effects": load_effects,
    "scenes": load_scene,
}


@pytest.mark.parametrize("kind", LOADERS)
def test_every_shipped_file_loads_and_bears_its_name(kind: str) -> None:
    names = shipped_names(kind)
    assert names
    for name in names:
        thing = LOADERS[kind](name)
        if kind != "effects":
            assert thing.name == name


def test_the_preset_of_every_effect_is_found_by_its_former_name() -> None:
    assert "full" not in shipped_names("effects")
    assert load_effects("full") == load_effects("all")
    assert load_scene("static_80kN", effects="full") == load_scene("static_80kN", effects="all")


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_resolved_scene_loads_again_to_the_same_scene(name: str) -> None:
    scene = load_scene(name, seed=7, laminae=11)
    again = scene_from_text(scene_text(scene))
    assert again == scene
    assert scene_text(again) == scene_text(scene)


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_resolved_scene_refers_to_no_other_file(name: str) -> None:
    resolved = read_mapping(scene_text(load_scene(name)), name)
    assert isinstance(resolved["bearing"], dict)
    assert isinstance(resolved["lubricant"], dict)
    assert isinstance(resolved["effects"], dict)
    assert isinstance(resolved["operation"].get("vehicle", {}), dict)


def test_every_scene_states_its_purpose_in_one_line() -> None:
    for name in shipped_names("scenes"):
        purpose = load_scene(name).purpose
        assert purpose
        assert "\n" not in purpose


def test_static_scene_is_80_kN_upwards_at_122_rad_per_s() -> None:
    scene = load_scene("static_80kN")
    assert isinstance(scene.operation, ConstantOperation)
    assert scene.operation.force == (0.0, 0.0, 80e3)
    assert scene.operation.speed == pytest.approx(122.0, rel=1e-4)
    assert scene.end_play == 0.0
    assert scene.mounting.cup == "held"
    assert scene.temperature == pytest.approx(343.15)


def test_spalled_scene_in_si() -> None:
    scene = load_scene("cup_spall")
    assert isinstance(scene.operation, QuarterVehicleOperation)
    assert scene.operation.speed_profile[0] == pytest.approx((0.0, 200 / 3.6))
    (spall,) = scene.defects
    assert isinstance(spall, Patch)
    assert (spall.on, spall.row, spall.azimuth) == ("cup", 0, 0.0)
    assert (spall.width, spall.depth, spall.length) == pytest.approx((6e-3, 0.1e-3, 25e-3))


def test_standard_preset_is_the_usual_effect_set_with_a_lubricated_rib_and_drag() -> None:
    """Without them idle rollers, which the rib drives, push the cages ahead (docs/evidence/light.md)."""
    usual = replace(EffectSet(), rib=Rib(lubrication=RibMixedFilm()), drag=Drag())
    assert load_effects("standard") == usual


def test_full_preset_has_every_effect_but_the_slow_one_and_the_tiny_one() -> None:
    members = {field.name for field in fields(EffectSet)}
    assert set(load_effects("all").names()) == members - {"thermal", "windage"}


def test_dry_preset_has_no_film_and_coulomb_friction() -> None:
    dry = load_effects("dry")
    assert dry.film is None
    assert isinstance(dry.traction, effects.CoulombTraction)


def test_numbers_keep_their_sources() -> None:
    sources = dict(load_bearing("HS130x230").sources)
    assert "Table 2" in sources["roller_count"]
    assert sources["row_spacing"] == "assumed"
    assert "cage.mass" in sources


def shipped_mappings(kind: str) -> list[dict[str, Any]]:
    """Read the shipped files of a kind; boxes are in figures or like another one, bearings of three kinds."""
    folder = kind if kind == "effects" else f"{kind.removeprefix(f'{_roller(kind)}_')}s"
    read = [read_file(find(folder, name)) for name in shipped_names(folder)]
    if folder == "bearings":
        return [each for each in read if each.get("kind", "") == _roller(kind)]
    return [each for each in read if kind != "structure" or "like" not in each]


def _roller(kind: str) -> str:
    """The kind that the files of a schema name; tapered bearings name none."""
    return kind.removesuffix("_bearing") if kind.endswith("_bearing") else ""


@pytest.mark.parametrize("kind", SCHEMA_KINDS)
def test_schema_refuses_unknown_keys_and_describes_the_shipped_ones(kind: str) -> None:
    schema = json_schema(kind)
    assert schema["additionalProperties"] is False
    for mapping in shipped_mappings(kind):
        assert set(mapping) <= set(schema["properties"])


@pytest.mark.parametrize("kind", SCHEMA_KINDS)
def test_every_shipped_file_fits_its_schema_and_a_spoilt_one_does_not(kind: str) -> None:
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft202012Validator(json_schema(kind))
    for mapping in shipped_mappings(kind):
        assert [error.message for error in validator.iter_errors(mapping)] == []
        assert not validator.is_valid({**mapping, "nonsense": 1})


def test_schema_of_a_sourced_part_wants_a_number_and_its_source() -> None:
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft202012Validator(json_schema("bearing"))
    bearing = read_file(find("bearings", "HS130x230"))
    for spoilt in ({"value": "heavy", "source": "guess"}, {"value": 1.0}, "heavy"):
        assert not validator.is_valid({**bearing, "cage": {**bearing["cage"], "mass_kg": spoilt}})


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_readers_of_yaml_1_1_find_the_same_in_a_shipped_scene(name: str) -> None:
    path = find("scenes", name)
    assert yaml.safe_load(path.read_text(encoding="utf-8")) == read_file(path)


@pytest.mark.parametrize(
    "noun",
    [
        *(entry.options for entry in catalogue()),
        effects.RibMixedFilm,
        effects.RibShearedFilm,
        effects.PocketFilm,
        effects.LandGuidance,
        Mounting,
        Numerics,
        Accelerometer,
        Guidance,
        Track,
        Profile,
        Material,
    ],
)
def test_every_option_of_a_noun_has_a_key_and_the_same_usual_value(noun: type[Any]) -> None:
    keys = keys_of(noun)
    written_as = {"rail_mass": "rail_mass_per_length"}
    stems = {written_as.get(stem_of(key), stem_of(key)) for key in keys.model_fields}
    assert stems - {"kind"} == {field.name for field in fields(noun)} - {"kind"}
    kind = {"kind": noun.kind} if keys.model_fields.get("kind") and is_kind(noun) else {}
    needed = {"table": "high_speed"} if noun is effects.ModalStructure else {}  # every box is another
    found = keys.model_validate(kind | needed).noun()
    assert found == noun(**needed)
    assert repr(found) == repr(noun(**needed))


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_every_box_rings_but_those_of_the_laboratory(name: str) -> None:
    scene = load_scene(name, effects=None)
    rings = isinstance(scene.effects.structure, effects.ModalStructure)
    assert rings != name.startswith(("santos_", "static_"))
    if scene.defects:
        assert rings
