"""One noun, one declaration: text, schema and limits follow from the fields; nothing recorded goes stale."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as some

from beardyn_core.base.edge import Place, outside, places, rules_of, write_noun
from beardyn_core.base.errors import InputError
from beardyn_core.base.units import UNITS
from beardyn_core.bearing.thermal import Temperatures
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import SCHEMA_KINDS, json_schema, scene_text, shipped_names
from beardyn_core.config.folders import find
from beardyn_core.config.load import read_scene
from beardyn_core.config.yaml_text import read_file, read_mapping
from beardyn_core.record.description import RunDescription
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.patch import Patch
from beardyn_core.scene.running import Curve, Stop, Timetable
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.waviness import Band, Waviness
from test.commands import run_python

SCENES = ("curve", "waviness", "growing_spall", "freight_100", "static_80kN")


def test_truth_and_recorded_scene_say_the_same_after_a_change() -> None:
    scene = load_scene("static_80kN")
    spall = Patch("cup", 1, 0.0, 6e-3, 1e-4, 20e-3)
    changed = replace(scene, tier="quasistatic", defects=(spall,), end_play=1e-4)
    recorded = scene_from_text(RunDescription.of(changed, {}, ()).scene_text)
    assert (recorded.tier, recorded.defects, recorded.end_play) == ("quasistatic", (spall,), 1e-4)
    assert recorded == changed


def test_an_end_play_changed_beside_temperatures_is_recorded_as_it_is() -> None:
    hot = Temperatures(333.15, 353.15, 348.15, 291.0, 11.5e-6)
    scene = replace(load_scene("static_80kN"), temperatures=hot, end_play=1.7e-4)
    again = scene_from_text(scene_text(scene))
    assert again.end_play == pytest.approx(1.7e-4, rel=1e-15)  # the sum of two numbers may miss the last bit
    assert replace(again, end_play=1.7e-4) == scene


@pytest.mark.parametrize(("cup_C", "others_C", "sign"), [(250.0, -60.0, ""), (-60.0, 250.0, "-")])
def test_temperatures_that_move_the_rings_too_far_are_refused_with_their_key(
    cup_C: float, others_C: float, sign: str
) -> None:
    parts = {"cup_C": cup_C, "cone_C": others_C, "rollers_C": others_C, "expansion_um_per_m_K": 60.0}
    with pytest.raises(InputError) as told:
        read_scene("static_80kN", {("temperatures",): parts})
    assert len(told.value.problems) == 1
    sentence = (
        rf"make the end play of 0 mm when mounted one of {sign}[\d.]+ mm; it must lie between -5 and 5 mm"
    )
    assert re.search(f"temperatures {sentence}", str(told.value))


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_the_text_of_a_scene_has_the_decimals_of_its_file(name: str) -> None:
    file, text = read_file(find("scenes", name)), read_mapping(scene_text(load_scene(name)), name)
    compared = list(_numbers_in_both(file, text))
    assert compared
    for key, one, two in compared:
        assert one == two, key


def _numbers_in_both(one: Any, two: Any, key: str = "") -> Iterator[tuple[str, Any, Any]]:
    if isinstance(one, dict) and isinstance(two, dict):
        for name in one.keys() & two.keys():
            yield from _numbers_in_both(one[name], two[name], f"{key}.{name}")
    elif isinstance(one, list) and isinstance(two, list):
        for index, (first, second) in enumerate(zip(one, two, strict=True)):
            yield from _numbers_in_both(first, second, f"{key}[{index}]")
    elif isinstance(one, float | int) and isinstance(two, float | int):
        yield key, one, two


@given(some.sampled_from(sorted(UNITS)), some.decimals(-2000, 2000, places=4).map(float))
@settings(max_examples=300, deadline=None)
def test_a_decimal_comes_back_as_it_was_written(unit: str, number: float) -> None:
    scale = UNITS[unit]
    found = scale.to_edge(scale.to_si(number))
    assert scale.to_si(found) == scale.to_si(number)
    assert len(repr(abs(found))) <= len(repr(abs(number)))


@given(some.sampled_from(sorted(UNITS)), some.floats(1e-9, 1e9))
@settings(max_examples=300, deadline=None)
def test_any_number_comes_back_at_least_as_its_neighbour(unit: str, number: float) -> None:
    scale = UNITS[unit]
    found = scale.to_si(scale.to_edge(number))
    assert abs(found - number) <= 2.0 * math.ulp(number) + abs(scale.plus) * 2.0**-52


def leaves(noun: Any, way: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Place]]:
    """Find the numbers of a noun and of its parts: field names and indices, and the place of each."""
    for place in places(type(noun)):
        value = getattr(noun, place.field)
        parts = value if isinstance(value, tuple) else (value,)
        if isinstance(value, bool) or place.key in ("sources", "kind"):
            continue
        if isinstance(value, float):
            yield (*way, place.field), place
        for index, part in enumerate(parts):
            if is_dataclass(part):
                inner = (place.field, index) if isinstance(value, tuple) else (place.field,)
                yield from leaves(part, (*way, *inner))


def altered(noun: Any, way: tuple[Any, ...], value: float) -> Any:
    """Replace one number in a noun of nouns."""
    if not way:
        return value
    if isinstance(way[0], int):
        part = altered(noun[way[0]], way[1:], value)
        return (*noun[: way[0]], part, *noun[way[0] + 1 :])
    return replace(noun, **{way[0]: altered(getattr(noun, way[0]), way[1:], value)})


KNOWN = {name: load_scene(name) for name in SCENES}


def test_a_sensor_keeps_the_usual_damping_where_its_type_has_another_one() -> None:
    scene = KNOWN["freight_100"]
    changed = altered(scene, ("sensors", 0, "type", "mounting_damping_ratio"), 0.5)
    again = scene_from_text(scene_text(changed))
    assert again == changed
    assert again.sensors[0].mounting_damping_ratio != 0.5


@given(some.data())
@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
def test_a_scene_with_any_number_changed_is_recorded_and_read_as_it_is(data: some.DataObject) -> None:
    check_a_changed_number(data)


@pytest.mark.slow
@given(some.data())
@settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))
def test_a_scene_with_many_numbers_changed_is_recorded_and_read_as_it_is(data: some.DataObject) -> None:
    check_a_changed_number(data)


def check_a_changed_number(data: some.DataObject) -> None:
    scene = KNOWN[data.draw(some.sampled_from(SCENES))]
    way, place = data.draw(some.sampled_from(list(leaves(scene))))
    limits = place.at.limits
    low, high = limits.get("ge", limits.get("gt", -50.0)), limits.get("le", limits.get("lt", 500.0))
    number = round(data.draw(some.floats(low, high)), 3) + 0.0  # never -0
    assume(low < number < high)
    try:
        changed = altered(scene, way, place.at.scale.to_si(number))
    except InputError:
        assume(False)
    text = scene_text(changed)
    try:
        again = scene_from_text(text)
    except InputError:
        assume(False)  # numbers that cannot be together
    assert again == changed
    assert scene_text(again) == text


def test_a_timetable_and_a_band_are_recorded_as_such() -> None:
    text = scene_text(load_scene("curve"))
    mapping = read_mapping(text, "curve")
    timetable = Timetable((Stop(900.0, 30.0, 20.0), Stop(400.0, 20.0, 15.0)), 0.7, 0.9, 2.0)
    del mapping["operation"]["speed_profile"]
    mapping["operation"]["timetable"] = write_noun(timetable)
    band = Band(2, 30, 4e-7, 1.5)
    mapping["waviness"] = [{"on": "cup", "row": 0, "band": write_noun(band)}]
    scene = scene_from_text(json.dumps(mapping))
    assert isinstance(scene.operation, QuarterVehicleOperation)
    assert scene.operation.speed_profile == timetable.speed_profile()
    again = read_mapping(scene_text(scene), "again")
    assert again["operation"]["timetable"] == mapping["operation"]["timetable"]
    assert again["waviness"][0]["band"] == write_noun(band)
    assert scene_from_text(scene_text(scene)) == scene
    slower = replace(scene.operation, speed_profile=((0.0, 10.0),))
    assert "timetable" not in write_noun(replace(scene, operation=slower))["operation"]


def test_orders_may_have_an_amplitude_each() -> None:
    wave = Waviness("cup", 0, (5, 9), (0.1 / 1e6, 0.3 / 1e6))
    assert write_noun(wave)["amplitude_um"] == [0.1, 0.3]
    scene = replace(load_scene("static_80kN"), waviness=(wave,))
    assert scene_from_text(scene_text(scene)) == scene


@pytest.mark.parametrize("kind", SCHEMA_KINDS)
def test_every_key_is_described(kind: str) -> None:
    """Also those of ``{value: 17, source: catalogue}``, which stand where a number may stand."""

    def look(part: Any, place: str) -> None:
        if isinstance(part, list):
            for each in part:
                look(each, place)
        elif isinstance(part, dict):
            keys = part.get("properties", {}) if part.get("type") == "object" else {}
            for key, found in keys.items():
                assert found.get("description"), f"{place}.{key}"
            for key, each in part.items():
                look(each, f"{place}.{key}")

    look(json_schema(kind), kind)


def test_a_noun_made_in_python_is_held_to_the_limits_of_its_file() -> None:
    with pytest.raises(InputError) as caught:
        Curve(10.0, 1.0, -1.0, 300.0, 200.0, "middle")
    assert caught.value.problems == [
        "curve: radius_m is 10; it must be at least 50",
        "curve: cant_mm is 1000; it must be at most 250",
        "curve: begin_m is -1; it must be at least 0",
        "curve: hand is 'middle'; allowed are left, right",
        "curve: transition_m is 200; it must be at most half of length_m, 150",
    ]


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_what_is_shipped_keeps_the_limits(name: str) -> None:
    def parts(noun: Any) -> Iterator[Any]:
        yield noun
        for field in fields(noun):
            value = getattr(noun, field.name)
            for part in value if isinstance(value, tuple) else (value,):
                if is_dataclass(part):
                    yield from parts(part)

    for noun in parts(load_scene(name)):
        assert not list(outside(noun)), noun
        assert not list(rules_of(noun)) or isinstance(noun, Scene), noun


HEAVY = ("numba", "llvmlite", "scipy", "matplotlib", "rerun", "mcap", "beardyn_core.physics.lanes")


def test_the_room_itself_is_light() -> None:
    code = (
        "import beardyn_core.config, sys; print({'numpy', 'pydantic', 'yaml'} & set(sys.modules) or 'none')"
    )
    assert run_python(code).strip() == "none"


@pytest.mark.parametrize(
    "statement",
    [
        "import beardyn_core.config",
        "from beardyn_core.config import load_bearing; load_bearing('HS130x230')",
        "from beardyn_core.config import read_scene; read_scene('cup_spall')",
        "from beardyn_core.choice import load_scene; load_scene('santos_step')",
    ],
)
def test_reading_files_brings_no_compiler_along(statement: str) -> None:
    code = f"{statement}\nimport sys\nprint([name for name in {HEAVY!r} if name in sys.modules])"
    assert run_python(code).strip() == "[]"
