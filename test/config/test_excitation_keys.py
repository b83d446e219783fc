"""Defects of wheel and rail in a scene: units, usual values, every mistake at once."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene, scene_from_text
from beardyn_core.config import scene_text
from beardyn_core.scene.excitation import (
    IRREGULARITY_KINDS,
    Corrugation,
    Crossing,
    DippedJoint,
    DippedWeld,
    Irregularity,
    WheelFlat,
    WheelOutOfRound,
    WheelPolygon,
)
from beardyn_core.scene.operation import MeasuredOperation, QuarterVehicleOperation

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
    - {kind: out_of_round, amplitudes_um: [100, 20], seed: 7}
  rail_defects:
    - {kind: dipped_joint, position_m: 12, angle_mrad: 10, spacing_m: 18}
    - {kind: corrugation, wavelength_mm: 45, amplitude_um: 20, from_m: 5, to_m: 60}
    - {kind: dipped_weld, position_m: 9, depth_mm: 0.5, short_depth_mm: 0.1, spacing_m: 36}
    - {kind: crossing, position_m: 40, depth_mm: 2, wing_length_m: 0.4}
  irregularity: {kind: fra_2, short_waves: iso_3095}
  contact_patch_mm: 10
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
        WheelOutOfRound((100e-6, 20e-6), 7),
    )
    assert operation.rail_defects == (
        DippedJoint(12.0, 10e-3, 1.0, 18.0),
        Corrugation(0.045, 20e-6, 5.0, 60.0),
        DippedWeld(9.0, 0.5e-3, 1.0, 0.1e-3, 0.1, 36.0),
        Crossing(40.0, 2e-3, 0.4, 0.2),
    )
    assert operation.irregularity == Irregularity("fra_2", short_waves="iso_3095")
    assert operation.contact_patch == 0.01


def test_a_recorded_scene_says_the_same_again(tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text(GOOD.replace(", to_m: 60", ""))
    scene = load_scene(path)
    again = scene_from_text(scene_text(scene))
    assert again == scene


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
        ("depth_mm: 0.5", "depth_mm: 9", ["rail_defects[2].depth_mm is 9", "at most 5"]),
        ("spacing_m: 36", "spacing_m: 0.9", ["rail_defects[2]", "spacing_m is 0.9", "at least length_m, 1"]),
        ("short_depth_mm: 0.1", "length_m: 0.2, short_length_m: 0.3", ["short_length_m is 0.3", "at most"]),
        (
            "depth_mm: 2",
            "depth_mm: 10, nose_length_m: 0.05",
            ["rail_defects[3]", "225 mrad", "are 100"],
        ),
        ("position_m: 40, ", "", ["rail_defects[3].position_m is missing", "metres"]),
        ("[100, 20]", "[100, -20]", ["wheel_defects[3].amplitudes_um[1] is -20", "at least 0"]),
        ("[100, 20]", "[]", ["wheel_defects[3].amplitudes_um"]),
        ("seed: 7", "seed: -7", ["wheel_defects[3].seed is -7", "at least 0"]),
        ("kind: fra_2", "kind: fra_7", ["irregularity.kind is 'fra_7'", "'fra_6'", "'china_ballastless'"]),
        ("short_waves: iso_3095", "short_waves: true", ["irregularity.short_waves is True", "'iso_3095'"]),
        ("kind: fra_2", "kind: csv", ["irregularity", "path is missing", "'csv' needs the path"]),
        ("kind: fra_2", "kind: fra_2, path: a.csv", ["path is 'a.csv'", "'csv' or 'density_csv'"]),
        ("contact_patch_mm: 10", "contact_patch_mm: 40", ["contact_patch_mm is 40", "at most 30"]),
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


def test_every_kind_of_irregularity_has_a_key(tmp_path: Path) -> None:
    (tmp_path / "rail.csv").write_text("distance_m,vertical_mm\n0,0\n900,0\n")
    (tmp_path / "density.csv").write_text("wavelength_m,vertical_mm2_m\n0.02,1\n900,100\n")
    files = {"csv": ", path: rail.csv", "density_csv": ", path: density.csv"}
    for kind in IRREGULARITY_KINDS:
        path = tmp_path / "mine.yaml"
        path.write_text(GOOD.replace("kind: fra_2", f"kind: {kind}{files.get(kind, '')}"))
        found = operation_of(path).irregularity
        assert found.kind == kind
        assert found.path == ((tmp_path / files[kind].split()[-1]).resolve() if kind in files else None)


MEASURED = """\
scene: mine
bearing: HS130x230
lubricant: L055
operation: {kind: csv, path: run.csv, take: force, speed_profile: [{time_s: 0, speed_kmh: 36}]}
"""
CSV = "time_s,speed_rpm,fx_N,fy_N,fz_N\n0,600,0,0,5e4\n4,1200,0,0,6e4\n"


def test_measured_operations_in_si(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text(CSV)
    file = (tmp_path / "run.csv").resolve()
    path = tmp_path / "mine.yaml"
    path.write_text(MEASURED)
    assert load_scene(path).operation == MeasuredOperation(file, "force", ((0.0, 10.0),))
    path.write_text(
        MEASURED.replace("force, speed_profile: [{time_s: 0, speed_kmh: 36}]", "speed, force_kN: [0, 1, 80]")
    )
    scene = load_scene(path)
    assert scene.operation == MeasuredOperation(file, "speed", force=(0.0, 1e3, 80e3))
    assert scene_from_text(scene_text(scene)) == scene
    path.write_text(MEASURED.replace(", take: force, speed_profile: [{time_s: 0, speed_kmh: 36}]", ""))
    assert load_scene(path).operation == MeasuredOperation(file)


def test_a_vehicle_runs_with_a_measured_speed(tmp_path: Path) -> None:
    (tmp_path / "run.csv").write_text("time_s,speed_rpm\n0,600\n4,1200\n")
    path = tmp_path / "mine.yaml"
    good = GOOD.replace("speed_profile: [{time_s: 0, speed_kmh: 120}]", "measured_speed: run.csv")
    path.write_text(good)
    points = [value for point in operation_of(path).speed_profile for value in point]
    radius = 0.43
    assert points == pytest.approx([0.0, 20 * math.pi * radius, 4.0, 40 * math.pi * radius])
    scene = load_scene(path)
    assert scene_from_text(scene_text(scene)) == scene


@pytest.mark.parametrize(
    ("text", "bad", "words"),
    [
        (MEASURED, ("take: force", "take: forces"), ["operation.take is 'forces'", "did you mean 'force'"]),
        (MEASURED, ("take: force", "take: both"), ["speed_profile is given and take is 'both'"]),
        (MEASURED, ("take: force", "take: speed"), ["force_kN is missing", "take is 'speed'"]),
        (MEASURED, (", speed_profile: [{time_s: 0, speed_kmh: 36}]", ""), ["speed_profile is missing"]),
        (MEASURED, ("speed_kmh: 36", "speed_kmh: 500"), ["speed_profile[0].speed_kmh is 500", "at most 400"]),
        (MEASURED, ("path: run.csv", "path: no.csv"), ["no.csv: no such file", "CSV file of force"]),
        (MEASURED, ("kind: csv", "kind: mcap"), ["run.csv'; a recording ends in .mcap", "kind: csv"]),
        (MEASURED, ("path: run.csv", "path: run.mcap"), ["run.mcap'; that is a recording", "kind: mcap"]),
        (GOOD, ("speed_profile: [{time_s: 0, speed_kmh: 120}]\n", "\n"), ["speed_profile is missing"]),
        (
            GOOD,
            ("vehicle: emu_300\n", "vehicle: emu_300\n  measured_speed: run.csv\n"),
            ["speed_profile and measured_speed are given; give exactly one"],
        ),
        (GOOD, ("kind: fra_2", "kind: csv, path: run.csv"), ["run.csv: unknown column 'time_s'"]),
    ],
)
def test_a_mistake_in_measured_input_is_told(
    tmp_path: Path, text: str, bad: tuple[str, str], words: list[str]
) -> None:
    (tmp_path / "run.csv").write_text(CSV)
    assert bad[0] in text
    path = tmp_path / "mine.yaml"
    path.write_text(text.replace(*bad, 1))
    with pytest.raises(InputError) as caught:
        load_scene(path)
    for word in words:
        assert word in str(caught.value)
