"""Rows and rollers that are not there, as a scene says it."""

from __future__ import annotations

from pathlib import Path

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene
from beardyn_core.config import scene_text
from beardyn_core.config.schema import json_schema
from beardyn_core.scene.defect import MissingRoller, defect_from, truth_of

SCENE = """
scene: mine
bearing: HS130x230
lubricant: L055
operation: {kind: constant, force_kN: [0, 0, 80], speed_rpm: 600}
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "mine.yaml"
    path.write_text(SCENE + text)
    return path


def test_scene_has_both_rows_and_all_rollers_unless_it_says_otherwise(tmp_path: Path) -> None:
    scene = load_scene(written(tmp_path, ""))
    assert (scene.rows, scene.missing_rollers, scene.roller_total) == (2, (), 34)
    assert "faults" not in scene.effect_names


def test_missing_rollers_and_one_row_are_read_and_written_back(tmp_path: Path) -> None:
    text = "rows: 1\nmissing_rollers: [{row: 0, roller: 3}, {row: 0, roller: 16}]\n"
    text += "mounting: {axial_prop_stiffness_MN_per_m: 500, axial_prop_damping_kN_s_per_m: 20}\n"
    scene = load_scene(written(tmp_path, text))
    assert (scene.rows, scene.missing_places, scene.roller_total) == (1, ((0, 3), (0, 16)), 15)
    assert scene.mounting.axial_prop_stiffness == 5.0e8
    assert scene.mounting.axial_prop_damping == 2.0e4
    assert "faults" in scene.effect_names
    assert scene.fault_sentences == ("roller 3, row 0, missing", "roller 16, row 0, missing")
    again = tmp_path / "again.yaml"
    again.write_text(scene_text(scene))
    assert load_scene(again).missing_rollers == scene.missing_rollers


ALL_OF_ROW_1 = ", ".join(f"{{row: 1, roller: {k}}}" for k in range(17))


@pytest.mark.parametrize(
    ("text", "sentences"),
    [
        ("rows: 3", ["rows is 3; allowed are 1, 2"]),
        ("missing_rollers: [{row: 0, roller: 17}]", ["missing_rollers[0]: roller is 17;", "0 to 16"]),
        ("missing_rollers: [{row: 2, roller: 1}]", ["missing_rollers[0].row is 2"]),
        (
            "missing_rollers: [{row: 0, roller: 1}]\n"
            "defects: [{kind: diameter, row: 0, roller: [1], diameter_um: 5}]",
            ["defects[0].roller is [1]; it must be a whole number"],
        ),
        ("missing_rollers: [{row: 0, rollers: 1}]", ["unknown key; did you mean `roller`?"]),
        (
            "missing_rollers: [{row: 0, roller: 1}, {row: 0, roller: 1}]",
            ["missing_rollers[1]: roller 1 of row 0 is given twice"],
        ),
        ("rows: 1\nmissing_rollers: [{row: 1, roller: 1}]", ["missing_rollers[0]: row is 1; with `rows: 1`"]),
        (f"missing_rollers: [{ALL_OF_ROW_1}]", ["every roller of row 1 (outboard) is missing", "`rows: 1`"]),
        (
            "rows: 1\ndefects: [{on: cup, row: 1, width_mm: 2, depth_um: 20}]\n"
            "waviness: [{on: cone, row: 1, orders: [9], amplitude_um: 1}]",
            ["defects[0]: row is 1; with `rows: 1`", "waviness[0]: row is 1; with `rows: 1`"],
        ),
        (
            "missing_rollers: [{row: 0, roller: 2}]\n"
            "defects: [{on: roller, row: 0, roller: 2, width_mm: 2, depth_um: 20},"
            " {kind: diameter, row: 0, roller: 2, diameter_um: 3}]",
            [
                "defects[0]: roller 2 of row 0 is one of missing_rollers",
                "defects[1]: roller 2 of row 0 is one of missing_rollers",
            ],
        ),
        ("mounting: {axial_prop_stiffness_MN_per_m: -1}", ["mounting.axial_prop_stiffness_MN_per_m is -1"]),
    ],
)
def test_mistakes_are_sentences_with_key_and_value(tmp_path: Path, text: str, sentences: list[str]) -> None:
    with pytest.raises(InputError) as refused:
        load_scene(written(tmp_path, text))
    found = "\n".join(refused.value.problems)
    assert all(sentence in found for sentence in sentences), found


def test_a_worn_pocket_may_be_empty(tmp_path: Path) -> None:
    text = "missing_rollers: [{row: 0, roller: 2}]\n"
    text += "defects: [{kind: worn_pocket, row: 0, pocket: 2, clearance_mm: 0.2}]"
    assert load_scene(written(tmp_path, text)).roller_total == 33


def test_schema_knows_the_keys() -> None:
    schema = json_schema("scene")
    assert {"rows", "missing_rollers"} <= set(schema["properties"])
    assert set(schema["$defs"]["MissingRollerKeys"]["properties"]) == {"row", "roller"}


def test_missing_roller_survives_the_recorded_truth() -> None:
    missing = MissingRoller(1, 4)
    assert truth_of(missing, 0.0) == {"row": 1, "roller": 4, "kind": "missing"}
    assert defect_from(truth_of(missing, 0.0)) == missing
