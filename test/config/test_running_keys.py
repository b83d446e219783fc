"""Curves, brakes, timetables, payload and freight vehicles as written in a scene, and their mistakes."""

from __future__ import annotations

from pathlib import Path

import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.choice import load_scene
from beardyn_core.config import load_vehicle
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_core.scene.running import Braking, Curve, Starting

SCENE = """
scene: mine
bearing: HS130x230
lubricant: L055
duration_s: 1
operation:
  kind: quarter_vehicle
  vehicle: {vehicle}
{keys}
"""
SPEED = "  speed_profile: [{time_s: 0, speed_kmh: 120}]\n"


def scene(folder: Path, keys: str, vehicle: str = "emu_300") -> Path:
    path = folder / "mine.yaml"
    path.write_text(SCENE.replace("{vehicle}", vehicle).replace("{keys}", keys))
    return path


def operation(folder: Path, keys: str, vehicle: str = "emu_300") -> QuarterVehicleOperation:
    found = load_scene(scene(folder, keys, vehicle)).operation
    assert isinstance(found, QuarterVehicleOperation)
    return found


def problems_of(folder: Path, keys: str) -> str:
    with pytest.raises(InputError) as caught:
        load_scene(scene(folder, keys))
    return "\n".join(caught.value.problems)


def test_one_curve_or_several(tmp_path: Path) -> None:
    one = "{radius_m: 500, cant_mm: 80, begin_m: 100, length_m: 300, transition_m: 60, hand: right}"
    two = "{radius_m: 800, begin_m: 400, length_m: 200, transition_m: 50}"
    first = Curve(500.0, 0.08, 100.0, 300.0, 60.0, "right")
    assert operation(tmp_path, f"{SPEED}  curve: {one}").curves == (first,)
    found = operation(tmp_path, f"{SPEED}  curve: [{one}, {two}]")
    assert found.curves == (first, Curve(800.0, 0.0, 400.0, 200.0, 50.0))
    assert found.moves_sideways
    assert not operation(tmp_path, SPEED).moves_sideways
    assert operation(tmp_path, f"{SPEED}  lateral: true").moves_sideways


def test_brake_drive_and_payload(tmp_path: Path) -> None:
    keys = "  payload_t: 70\n  braking: {brake: block, friction: 0.2, ahead: false}\n  starting: {share: 2}\n"
    found = operation(tmp_path, SPEED + keys, "freight_y25")
    assert found.braking == Braking("block", friction=0.2, ahead=False)
    assert found.starting == Starting(2.0)
    assert found.body_mass == pytest.approx(80.8e3)
    suspension = found.vehicle.primary_suspension
    assert suspension is not None
    assert suspension.stiff_stiffness == pytest.approx(1.5e6)
    sources = dict(load_vehicle("freight_y25").sources)
    assert "Lenoir" in sources["primary_suspension.friction_ratio"]


def test_a_timetable_instead_of_a_speed_profile(tmp_path: Path) -> None:
    found = operation(tmp_path, "  timetable: {stops: [{distance_m: 900, top_speed_kmh: 72}]}")
    assert max(speed for _, speed in found.speed_profile) == pytest.approx(20.0)
    assert found.speed_profile[0] == (0.0, 0.0)
    assert found.speed_profile[-1][1] == 0.0


def test_a_train_may_run_backwards(tmp_path: Path) -> None:
    assert operation(tmp_path, "  speed_profile: [{time_s: 0, speed_kmh: -90}]").speed_profile == (
        (0.0, -25.0),
    )


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("  payload_t: 1", ["speed_profile is missing", "exactly one"]),
        (
            SPEED + "  timetable: {stops: [{distance_m: 900, top_speed_kmh: 72}]}",
            ["speed_profile and timetable are given"],
        ),
        (SPEED + "  curve: {radius_m: 20, length_m: 200, transition_m: 50}", ["radius_m is 20", "50"]),
        (SPEED + "  curve: {radius_m: 500, length_m: 80, transition_m: 50}", ["transition_m is 50", "40"]),
        (SPEED + "  curve: {radius_m: 500, length_m: 80}", ["transition_m", "missing"]),
        (
            SPEED + "  curve: {radius_m: 500, length_m: 80, transition_m: 9, hand: up}",
            ["hand is 'up'", "left", "right"],
        ),
        (
            SPEED + "  lateral: false\n  curve: {radius_m: 500, length_m: 200, transition_m: 50}",
            ["lateral is false"],
        ),
        (
            SPEED + "  curve: [{radius_m: 500, length_m: 200, transition_m: 50}, "
            "{radius_m: 500, begin_m: 150, length_m: 200, transition_m: 50}]",
            ["curve[1].begin_m is 150", "at least 200"],
        ),
        (SPEED + "  braking: {brake: drum}", ["brake is 'drum'", "disc", "clasp"]),
        (SPEED + "  braking: {fricton: 0.2}", ["unknown key", "`friction`"]),
        (SPEED + "  starting: {share: -1}", ["share is -1"]),
        (SPEED + "  payload: 3", ["unknown key", "`payload_t`", "tonnes"]),
        ("  timetable: {stops: []}", ["stops"]),
        ("  timetable: {stops: [{distance_m: 9, top_speed_kmh: 500}]}", ["top_speed_kmh is 500"]),
    ],
)
def test_mistakes_are_named_with_file_key_and_what_is_allowed(
    tmp_path: Path, keys: str, words: list[str]
) -> None:
    found = problems_of(tmp_path, keys)
    for word in ["mine.yaml", *words]:
        assert word in found


def test_mistakes_of_a_vehicle_are_named_all_at_once(tmp_path: Path) -> None:
    path = tmp_path / "wagon.yaml"
    path.write_text(
        "name: wagon\nbody_mass_t: 10\nbogie_mass_t: 2\nsecondary_stiffness_kN_per_mm: 10\n"
        "secondary_damping_kN_s_per_m: 60\nguidance: {conicity: 2, flange_clearance_cm: 1}\n"
        "primary_suspension: {soft_stiffness_MN_per_m: 0.5, meeting_load_kN: -3}\n"
    )
    with pytest.raises(InputError) as caught:
        load_vehicle(path)
    found = "\n".join(caught.value.problems)
    for word in (
        "guidance.conicity is 2",
        "flange_clearance_mm",
        "stiff_stiffness_MN_per_m",
        "meeting_load_kN is -3",
    ):
        assert word in found
    assert len(caught.value.problems) == 4


def test_a_wheelset_that_bends_in_the_twin_is_held_by_nothing_else(tmp_path: Path) -> None:
    problems = problems_of(
        tmp_path, f"{SPEED}  wheelset: coupled\nmounting: {{cup: held, journal_tilt: free}}\n"
    )
    assert "mounting.journal_tilt is free; with operation.wheelset coupled it must be locked" in problems
    assert "mounting.cup is held; with operation.wheelset coupled it must be suspended" in problems
