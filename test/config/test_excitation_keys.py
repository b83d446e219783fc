"""Defects of wheel and rail in a scene: units, usual values, every mistake at once."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from beardyn_core.config import load_scene, scene_from_text
from beardyn_core.errors import InputError
from beardyn_core.scene.excitation import Corrugation, DippedJoint, WheelFlat, WheelPolygon
from beardyn_core.scene.operation import QuarterVehicleOperation

GOOD = """\
scene: mine
bearing: HS130x230
lubricant: L055
operation:
  kind: quarter_vehicle
  vehicle: emu_300
  speed_profile: [{time_s: 0, speed_kmh: 120}]
  wheel_diameter_mm: 860
  wheel_defects:
    - {kind: flat, length_mm: 40, depth_mm: 0.46}
    - {kind: flat, shape: rounded, length_mm: 50, azimuth_deg: 90}
    - {kind: polygon, order: 20, amplitude_um: 25}
  rail_defects:
    - {kind: dipped_joint, position_m: 12, angle_mrad: 10, spacing_m: 18}
    - {kind: corrugation, wavelength_mm: 45, amplitude_um: 20, from_m: 5, to_m: 60}
"""


def operation_of(path: Path) -> QuarterVehicleOperation:
    operation = load_scene(path).operation
    assert isinstance(operation, QuarterVehicleOperation)
    return operation


def test_defects_in_si(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(GOOD)
    operation = operation_of(path)
    assert operation.wheel_defects == (
        WheelFlat(0.04, 0.46e-3),
        WheelFlat(0.05, None, "rounded", math.pi / 2),
        WheelPolygon(20, 25e-6),
    )
    assert operation.rail_defects == (
        DippedJoint(12.0, 10e-3, 1.0, 18.0),
        Corrugation(0.045, 20e-6, 5.0, 60.0),
    )


def test_a_recorded_scene_says_the_same_again(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(GOOD.replace(", to_m: 60", ""))
    scene = load_scene(path)
    again = scene_from_text(scene.source_text)
    assert replace(again, source_text="") == replace(scene, source_text="")


def test_the_shipped_flat_is_a_healthy_bearing_under_a_fresh_flat() -> None:
    scene = load_scene("wheel_flat")
    assert isinstance(scene.operation, QuarterVehicleOperation)
    (flat,) = scene.operation.wheel_defects
    assert flat == WheelFlat(0.035)
    assert isinstance(flat, WheelFlat)
    assert 1e3 * flat.depth_on(0.46) == pytest.approx(0.333, abs=5e-4)
    assert scene.fault_sentences == ()
    spalled = load_scene("cup_spall")
    assert scene.mounting == spalled.mounting
    assert scene.sensors == spalled.sensors


@pytest.mark.parametrize(
    ("good", "bad", "words"),
    [
        ("length_mm: 40", "length_cm: 4", ["wheel_defects[0].length_cm", "`length_mm`", "millimetres"]),
        ("length_mm: 40", "length_mm: 400", ["wheel_defects[0].length_mm is 400", "at most 150"]),
        ("length_mm: 40, ", "", ["wheel_defects[0].length_mm is missing", "millimetres"]),
        (
            "depth_mm: 0.46",
            "depth_mm: 1.2",
            ["wheel_defects[0].depth_mm is 1.2", "40 mm on a wheel of 860 mm", "0.465 mm deep while fresh"],
        ),
        (
            "shape: rounded, length_mm: 50",
            "shape: rounded, length_mm: 50, depth_mm: 1",
            ["wheel_defects[1].depth_mm is 1;", "at most 0.727 mm", "0.363 mm"],
        ),
        ("shape: rounded", "shape: round", ["wheel_defects[1].shape is 'round'", "'fresh', 'rounded'"]),
        ("kind: polygon", "kind: poligon", ["wheel_defects[2].kind is 'poligon'", "did you mean 'polygon'"]),
        ("order: 20", "order: 20.5", ["wheel_defects[2].order is 20.5", "whole number"]),
        ("angle_mrad: 10", "angle_deg: 1", ["rail_defects[0].angle_deg", "`angle_mrad`", "milliradians"]),
        ("spacing_m: 18", "spacing_m: 0.5", ["rail_defects[0]", "spacing_m is 0.5", "at least length_m, 1"]),
        ("to_m: 60", "to_m: 5.1", ["rail_defects[1]", "to_m is 5.1", "four waves", "5.18"]),
        ("kind: corrugation", "kind: flat", ["rail_defects[1].kind is 'flat'", "'dipped_joint'"]),
        ("wheel_defects:", "wheel_defect:", ["operation.wheel_defect", "did you mean `wheel_defects`?"]),
    ],
)
def test_a_mistake_is_one_sentence(tmp_path: Path, good: str, bad: str, words: list[str]) -> None:
    assert good in GOOD
    path = tmp_path / "mine.yaml"
    path.write_text(GOOD.replace(good, bad, 1))
    with pytest.raises(InputError) as caught:
        load_scene(path)
    (problem,) = caught.value.problems
    assert problem.startswith(f"{path}: operation")
    for word in words:
        assert word in problem


def test_all_mistakes_are_reported_together(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    text = GOOD.replace("depth_mm: 0.46", "depth_mm: 2").replace("order: 20", "order: 0")
    text = text.replace("wavelength_mm: 45", "wavelength_mm: 4").replace("speed_kmh: 120", "speed_kmh: 500")
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        load_scene(path)
    assert len(caught.value.problems) == 4
