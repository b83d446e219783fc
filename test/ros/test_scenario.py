"""What the load node says about the load that it replays."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from beardyn_core.base.plain_json import LONGEST_TEXT
from beardyn_core.choice import load_scene
from beardyn_core.rail.build import load_history
from beardyn_core.scene.excitation import WheelFlat
from beardyn_core.scene.operation import QuarterVehicleOperation
from beardyn_ros.replay import Replay
from beardyn_ros.scenario import PAUSED, PLAYING, Scenario, says_paused, scenario_events, truth_text

SCENES = sorted(path.stem for path in (Path(__file__).parents[2] / "config" / "scenes").glob("*.yaml"))


@pytest.mark.parametrize("name", SCENES)
def test_events_of_every_shipped_scene_are_json(name: str) -> None:
    scene = load_scene(name)
    said = json.loads(json.dumps(scenario_events(scene)))
    assert (said["scene"], said["seed"]) == (scene.name, scene.seed)


def test_truth_says_irregularity_wheel_flat_and_where_the_stream_stands() -> None:
    scene = load_scene("smooth_run")
    assert isinstance(scene.operation, QuarterVehicleOperation)
    operation = replace(scene.operation, wheel_defects=(WheelFlat(length=0.04),))
    scene = replace(scene, operation=operation, duration=0.5)
    history = load_history(operation, scene.mounting, 0.5, scene.seed)
    replay = Replay(history, fade=0.1)
    replay.take(1000)
    replay.seek(0.25)
    replay.take(1)
    text = truth_text(Scenario(history, scenario_events(scene)), replay, PLAYING, "run")
    said = json.loads(text)
    assert said["irregularity"]["kind"] == operation.irregularity.kind
    assert "flat" in text.lower()
    assert said["run_id"] == "run"
    assert said["replay"]["length_s"] == 0.5
    stamps = [(passage["stamp_s"], passage["position_s"]) for passage in said["replay"]["passages"]]
    assert stamps == [(0.0, 0.0), (1000 * replay.spacing_ns / 1e9, 0.25)]
    assert not says_paused(text)
    assert says_paused(truth_text(Scenario(history, {}), replay, PAUSED, ""))


def test_the_truth_of_a_load_does_not_grow_with_the_laps_of_its_loop() -> None:
    scene = load_scene("smooth_run")
    assert isinstance(scene.operation, QuarterVehicleOperation)
    history = load_history(scene.operation, scene.mounting, 0.1, scene.seed)
    replay = Replay(history, fade=0.01, loop=True)
    scenario = Scenario(history, scenario_events(scene))
    sizes = []
    for _ in range(2):
        replay.take(200 * len(history))
        sizes.append(len(truth_text(scenario, replay, PLAYING, "run")))
    assert json.loads(truth_text(scenario, replay, PLAYING, "run"))["replay"]["passage_count"] > 350
    assert sizes[1] < 1.02 * sizes[0] < 0.01 * LONGEST_TEXT  # stamps have more digits


@pytest.mark.parametrize("text", ["", "no json", "[]", "3", '{"replay": 5}', '{"replay": {}}', "{}"])
def test_truth_of_a_stranger_is_no_pause(text: str) -> None:
    assert not says_paused(text)
