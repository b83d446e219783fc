"""The sweep that an estimator of a bearing learns from, composed from that of its vehicle class."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import yaml

from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.life import dynamic_rating
from beardyn_core.bearing.radial_bearing import RadialBearing
from beardyn_core.config import load_any_bearing, read_sweep
from beardyn_core.config.folders import find, shipped_names
from beardyn_core.population.draw import rows_of
from beardyn_core.population.request import make_plan
from beardyn_core.population.sweep_scenes import check_rows, open_base
from beardyn_core.population.training_sweep import LEARNT, MOST, PARTS, TRUER, bearing_of, compose_sweep

OWN = {
    "FR130x230x150": "freight_axlebox",
    "HS130x230": "high_speed_axlebox",
    "METRO120x220": "metro_axlebox",
    "WJ130x240": "freight_cylindrical_axlebox",
    "SRB120x260": "freight_spherical_axlebox",
    "WJ180x320": "locomotive_axlebox",
}


def varied(keys: dict[str, Any], key: str) -> dict[str, Any]:
    return next(each for each in keys["vary"] if each["key"] == key)


@pytest.mark.parametrize(("bearing", "sweep"), OWN.items())
def test_the_bearing_of_a_shipped_sweep_has_that_sweep(bearing: str, sweep: str) -> None:
    assert bearing_of(sweep).name == bearing
    composed = compose_sweep(load_any_bearing(bearing))
    shipped = yaml.safe_load(Path(read_sweep(sweep)[1]).read_text(encoding="utf-8"))
    assert (composed.like, composed.box, composed.keys) == (sweep, None, shipped)


@pytest.mark.parametrize("bearing", OWN)
def test_runs_of_a_bearing_have_its_box_and_ten_turns_at_the_least_speed(bearing: str) -> None:
    keys = compose_sweep(load_any_bearing(bearing)).of_part(TRUER)
    sweep, label = read_sweep(keys)
    scene = open_base(sweep, label)[1].scene
    assert (scene.bearing.name, scene.tier) == (bearing, TRUER)
    speed = varied(keys, "operation.speed_profile[0].speed_kmh")["low"] / 3.6
    wheel = varied(keys, "operation.wheel_diameter_mm")["high"] * 1e-3
    assert speed / (3.1416 * wheel) * keys["set"]["duration_s"] > 10.0


@pytest.mark.slow
@pytest.mark.parametrize("bearing", ["WJ130x240", "SRB120x260", "WJ180x320"])
@pytest.mark.parametrize("part", PARTS)
def test_every_run_of_another_kind_makes_a_scene(bearing: str, part: str) -> None:
    """Without the choice of effects, which takes minutes with cylinders."""
    composed = compose_sweep(load_any_bearing(bearing))
    sweep, label = read_sweep(composed.of_part(part))
    rows = rows_of(sweep)
    assert len(rows) == MOST[part]
    assert not check_rows(open_base(sweep, label)[0], rows)


@pytest.mark.slow
@pytest.mark.parametrize("bearing", ["FR130x230x150", "HS130x230", "METRO120x220"])
@pytest.mark.parametrize("part", PARTS)
def test_every_run_of_a_shipped_bearing_can_be_simulated(bearing: str, part: str) -> None:
    composed = compose_sweep(load_any_bearing(bearing))
    plan = make_plan(composed.of_part(part))
    assert len(rows_of(plan.sweep)) == composed.count(part) <= MOST[part]
    assert plan.frame is not None


@pytest.mark.parametrize("bearing", OWN)
def test_what_is_said_before_of_the_time_is_within_what_the_pages_state(bearing: str) -> None:
    """Runs and choices; learning takes some minutes more."""
    assert 25.0 < compose_sweep(load_any_bearing(bearing)).seconds / 60.0 < 85.0


def test_no_bearing_is_in_both_tiers() -> None:
    composed = compose_sweep(load_any_bearing("FR130x230x150"))
    lots = [{row.lot for row in rows_of(read_sweep(composed.of_part(part))[0])} for part in PARTS]
    assert len(lots[0]) == composed.count(LEARNT) / 2  # two runs of a bearing
    assert not lots[0] & lots[1]


def test_another_bearing_has_the_box_the_loads_and_the_spalls_of_its_size() -> None:
    assert "AARK_6.5x9" in shipped_names("bearings")
    bearing, usual = load_any_bearing("AARK_6.5x9"), load_any_bearing("FR130x230x150")
    composed = compose_sweep(bearing, sensor="piezo_axlebox")
    assert composed.like == "freight_axlebox"
    assert composed.box is not None
    assert composed.box.outer_diameter / bearing.outer_diameter == pytest.approx(280.0 / 230.0)
    keys = composed.keys
    assert keys["set"]["bearing"] == bearing.name
    assert keys["set"]["sensors[0].type"] == "piezo_axlebox"
    assert keys["set"]["sensors[0].position_mm"][2] == pytest.approx(170.0 * 250.8 / 230.0, abs=1e-3)
    ratio = dynamic_rating(bearing).radial / dynamic_rating(usual).radial
    assert varied(keys, "operation.payload_t")["high"] == pytest.approx(70.0 * ratio, rel=1e-3)
    width = varied(keys, "defects[0].width_mm")
    spacing = (bearing.pitch_diameter / bearing.roller_count) / (usual.pitch_diameter / usual.roller_count)
    assert (width["low"], width["high"]) == (1.5, pytest.approx(40.0 * spacing, rel=1e-3))


@pytest.mark.parametrize(
    ("bearing", "usual"),
    [("WJ120x240", "WJ130x240"), ("SRB130x280", "SRB120x260"), ("WJ180x320", "WJ180x320")],
)
def test_a_bearing_of_another_kind_has_a_class_of_its_kind_and_its_clearance(
    bearing: str, usual: str
) -> None:
    mine, own = (load_any_bearing(each) for each in (bearing, usual))
    assert isinstance(mine, RadialBearing)
    assert isinstance(own, RadialBearing)
    composed = compose_sweep(mine)
    assert composed.like == OWN[usual]
    clearance, given = (
        varied(keys, "radial_clearance_mm") for keys in (composed.keys, compose_sweep(own).keys)
    )
    assert clearance["low"] < 1e3 * mine.radial_clearance < clearance["high"]
    ratio = mine.radial_clearance / own.radial_clearance
    assert clearance["high"] == pytest.approx(given["high"] * ratio, rel=1e-3)
    assert "end_play_mm" not in {each["key"] for each in composed.keys["vary"]}


def test_a_class_of_another_kind_of_bearing_is_refused_with_those_that_fit() -> None:
    words = (
        r"freight_axlebox\.yaml: is of FR130x230x150, a tapered roller bearing; WJ130x240 is a cylindrical "
        "roller bearing: like must be one of freight_cylindrical_axlebox, locomotive_axlebox, or a file"
    )
    with pytest.raises(InputError, match=words):
        compose_sweep(load_any_bearing("WJ130x240"), like="freight_axlebox")


def test_the_box_of_a_pair_keeps_the_range_of_the_clearance_which_no_calibration_finds() -> None:
    pair = load_any_bearing("WJ130x240")
    composed = compose_sweep(pair, scene="freight_cylindrical")
    usual = varied(compose_sweep(pair).keys, "radial_clearance_mm")
    assert varied(composed.keys, "radial_clearance_mm") == usual
    assert "end_play_mm" not in {each["key"] for each in composed.keys["vary"]}
    sweep, label = read_sweep(composed.of_part(LEARNT))
    assert open_base(sweep, label)[1].scene.bearing == pair


def test_a_bearing_with_the_same_cup_keeps_the_box_and_the_loads() -> None:
    usual = load_any_bearing("METRO120x220")
    assert isinstance(usual, Bearing)
    mine = replace(usual, name="mine", end_play=usual.end_play + 2e-5)
    keys, shipped = (compose_sweep(each).keys for each in (mine, usual))
    assert keys["vary"] == shipped["vary"]
    assert keys["set"].keys() - shipped["set"].keys() == {"bearing"}
    sweep, label = read_sweep(keys)
    assert open_base(sweep, label)[1].scene.bearing == mine


def test_one_axlebox_has_its_box_and_what_a_calibration_leaves_open(tmp_path: Path) -> None:
    scene = tmp_path / "mine.yaml"
    keys = yaml.safe_load(find("scenes", "service_high_speed").read_text(encoding="utf-8"))
    keys |= {"scene": "mine", "end_play_mm": 0.05}
    keys["effects"] = {
        "preset": "auto",
        "structure": {"kind": "modes", "table": "high_speed", "stiffness_factor": 1.4, "damping_factor": 0.7},
    }
    scene.write_text(yaml.safe_dump(keys), encoding="utf-8")
    composed = compose_sweep(load_any_bearing("HS130x230"), scene=str(scene))
    assert composed.keys["scene"] == str(scene)
    stiffness = varied(composed.keys, "effects.structure.stiffness_factor")
    assert stiffness["low"] < 1.4 < stiffness["high"] < 1.43
    assert stiffness["per"] == "bearing"
    assert varied(composed.keys, "end_play_mm")["high"] == pytest.approx(0.08)
    usual = compose_sweep(load_any_bearing("HS130x230")).keys["vary"]
    own = {each["key"]: each for each in composed.keys["vary"]}
    assert not [key for key in own if key.startswith("sensors[0]")]
    for each in usual:
        if each["key"].startswith(("operation.", "defects", "temperature", "scatter")):
            assert own[each["key"]] == each
    sweep, label = read_sweep(composed.of_part(LEARNT))
    assert open_base(sweep, label)[1].scene.end_play == pytest.approx(5e-5)


def test_an_axlebox_without_modes_is_refused(tmp_path: Path) -> None:
    scene = tmp_path / "rigid.yaml"
    text = find("scenes", "service_high_speed").read_text(encoding="utf-8")
    keys = yaml.safe_load(text) | {"effects": {"preset": "auto", "structure": False}}
    scene.write_text(yaml.safe_dump(keys), encoding="utf-8")
    with pytest.raises(InputError, match=r"rigid\.yaml: its axlebox has no modes"):
        compose_sweep(load_any_bearing("HS130x230"), scene=str(scene))


def test_a_sweep_without_a_box_that_rings_is_refused() -> None:
    with pytest.raises(InputError, match="smooth_run has no box that rings"):
        compose_sweep(load_any_bearing("HS130x230"), like="spalls")
