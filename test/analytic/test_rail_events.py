"""What a run meets on its way, as truth."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from beardyn_core.choice import load_scene
from beardyn_core.config import shipped_names
from beardyn_core.rail.events import MOST_TIMES, events_of
from beardyn_core.rail.vehicle import quarter_vehicle
from beardyn_core.scene.excitation import (
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
from beardyn_core.twin import Twin
from test.analytic.rail_rides import ride_of

SCENE = load_scene("smooth_run")


def scene_with(duration: float = 4.0, **changes: Any) -> Any:
    assert isinstance(SCENE.operation, QuarterVehicleOperation)
    return replace(SCENE, duration=duration, operation=replace(SCENE.operation, **changes))


def test_strikes_of_a_flat_are_when_the_force_is_highest():
    smooth = Irregularity("none")
    scene = scene_with(3.0, irregularity=smooth, wheel_defects=(WheelFlat(0.04, azimuth=1.0),),
                       speed_profile=((0.0, 20.0), (3.0, 10.0)))  # fmt: skip
    (flat,) = events_of(scene)["events"]
    assert flat["kind"] == "wheel_flat"
    assert flat["period_m"] == pytest.approx(np.pi * 0.92)
    assert flat["top_frequency_Hz"] == pytest.approx(20.0 / (np.pi * 0.92))
    assert np.diff(flat["distance_m"]) == pytest.approx(np.pi * 0.92, abs=1e-3)
    assert flat["count"] == len(flat["time_s"]) == 16
    response, step = ride_of(scene.operation, scene.mounting, 3.0, 1)
    high = response.contact_force > 1.5 * quarter_vehicle(scene.operation, scene.mounting).static_force
    times = np.flatnonzero(high) * step
    for time in flat["time_s"]:
        if 0.3 < time < 2.95:
            assert np.abs(times - time).min() < 0.01


def test_joints_are_passed_at_their_places_and_only_where_the_train_comes():
    rail = (
        DippedJoint(10.0, 0.01, 1.0, 18.0),
        DippedWeld(1000.0, 1e-4),
        Crossing(30.0, 2e-3),
        Corrugation(0.05, 1e-5, 20.0, 40.0),
    )
    scene = scene_with(4.0, rail_defects=rail, speed_profile=((0.0, 20.0),))
    joint, weld, crossing, corrugation = events_of(scene)["events"]
    assert joint["distance_m"] == [10.0, 28.0, 46.0, 64.0]
    assert joint["time_s"] == pytest.approx([0.5, 1.4, 2.3, 3.2], abs=1e-5)
    assert (weld["count"], weld["time_s"]) == (0, [])
    assert (crossing["count"], crossing["time_s"]) == (1, pytest.approx([1.5]))
    assert crossing["angle_rad"] == pytest.approx(2e-3 / 0.3 + 2e-3 / 0.2)
    assert (corrugation["begin_s"], corrugation["end_s"]) == pytest.approx((1.0, 2.0), abs=0.003)
    assert corrugation["top_frequency_Hz"] == pytest.approx(400.0)


def test_a_train_that_turns_back_passes_a_joint_twice():
    scene = scene_with(
        10.0,
        speed_profile=((0.0, 4.0), (1.0, 4.0), (9.0, -4.0)),
        rail_defects=(DippedJoint(8.0, 0.01), DippedJoint(1.0, 0.01, 1.0, 5.0)),
    )
    one, several, stop, back = events_of(scene)["events"]
    # way: 4 t, then 4 + 4 s - s^2 / 2 with its top of 12 m after s = 4 s
    root = np.sqrt(8.0)
    assert one["time_s"] == pytest.approx([5.0 - root, 5.0 + root], abs=1e-4)
    assert several["distance_m"] == [1.0, 6.0, 11.0, 11.0, 6.0, 1.0]
    assert np.diff(several["time_s"]).min() > 0.0
    assert (stop["kind"], back["kind"]) == ("standstill", "backwards")
    assert stop["time_s"] == pytest.approx([5.0], abs=0.003)


def test_waves_of_the_wheel_and_the_rail_name_sizes_and_seeds():
    scene = scene_with(wheel_defects=(WheelPolygon(20, 2e-5), WheelOutOfRound((1e-4, 2e-5), 9)),
                       irregularity=Irregularity("fra_3", short_waves="iso_3095"))  # fmt: skip
    told = events_of(scene)
    polygon, wheel = told["events"]
    assert polygon["orders"] == [20]
    assert polygon["top_frequency_Hz"] == pytest.approx(20 * 200 / 3.6 / (np.pi * 0.92))
    assert (wheel["orders"], wheel["amplitudes_m"], wheel["seed"]) == ([1, 2], [1e-4, 2e-5], 9)
    assert told["irregularity"] == {
        "kind": "fra_3", "wavelength_m": [2.0, 150.0], "short_waves": "iso_3095", "seed": scene.seed,
    }  # fmt: skip
    assert events_of(scene_with(irregularity=Irregularity("none")))["irregularity"] == {"kind": "none"}


def test_a_long_run_names_the_first_strikes_and_counts_all():
    scene = scene_with(
        7200.0, wheel_defects=(WheelFlat(0.04),), rail_defects=(DippedJoint(5.0, 0.01, 1.0, 18.0),)
    )
    flat, joint = events_of(scene)["events"]
    way = 7200.0 * 200 / 3.6
    assert flat["count"] == pytest.approx(way / (np.pi * 0.92), abs=1.0)
    assert joint["count"] == int((way - 5.0) // 18.0) + 1
    assert len(flat["time_s"]) == len(joint["time_s"]) == MOST_TIMES
    assert joint["time_s"][7] == pytest.approx((5.0 + 7 * 18.0) / (200 / 3.6), abs=1e-5)


def test_a_measured_operation_names_its_file(tmp_path):
    operation = MeasuredOperation(tmp_path / "run.csv", "force", ((0.0, 10.0),))
    told = events_of(replace(SCENE, operation=operation))
    assert told == {"load": "force measured, run.csv", "events": []}


def test_the_truth_of_a_twin_has_what_its_run_meets():
    scene = load_scene("wheel_flat", tier="quasistatic", effects="frictionless")
    assert Twin(scene).truth()["excitation"] == events_of(scene)


@pytest.mark.parametrize("name", shipped_names("scenes"))
def test_truth_of_every_shipped_scene_is_plain_json(name):
    told = events_of(load_scene(name))
    assert json.loads(json.dumps(told, allow_nan=False)) == told
    assert all(event["kind"] for event in told["events"])
