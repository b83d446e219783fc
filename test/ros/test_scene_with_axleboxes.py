"""A scene with `axleboxes` on ROS: its boxes and no others, one process, one file, loads as in a desk run."""

from __future__ import annotations

import json
import signal
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import psutil
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.config import read_scene
from beardyn_core.rail.train import TrainLoads
from beardyn_core.record.bag_scanning import scan_recording
from beardyn_core.record.mcap_scanning import END_RECORD
from beardyn_core.record.messages import Diagnostic, decode_string, encode_diagnostics
from beardyn_core.record.reading import read_run
from beardyn_core.scene.axleboxes import Axleboxes
from test.ros.graph import Graph
from test.ros.test_car import Car

FOUR = ("axle_1_left", "axle_1_right", "axle_2_left", "axle_2_right")


@pytest.fixture
def train() -> Axleboxes:
    found = read_scene("bogie").scene.axleboxes
    assert found is not None
    return found


def test_a_twin_or_a_load_of_one_box_says_what_to_start_instead() -> None:
    from beardyn_ros.rig import scene_rig
    from beardyn_ros.scenario import scene_scenario

    instead = (
        "has 4 axleboxes, axle_1_left to axle_2_right, .* `ros2 launch beardyn car.launch.py scene:=bogie`"
    )
    with pytest.raises(InputError, match=f"{instead}.*box of the twin.*car_twin"):
        scene_rig("bogie")
    with pytest.raises(InputError, match=f"{instead}.*car_load"):
        scene_scenario("bogie", "", 0.5)
    assert scene_scenario("smooth_run", "", 0.5).history.time_ns[-1] >= 0.5e9


def test_refusals_end_the_nodes_with_2_and_a_sentence(graph: Graph) -> None:
    told: dict[str, tuple[dict[str, Any], str]] = {
        "twin": ({}, "car.launch.py scene:=bogie"),
        "load": ({}, "car.launch.py scene:=bogie"),
        "car_twin": (
            {"faulty": "axle_1_left"},
            "parameter 'faulty': scene 'bogie' gives it, axleboxes.faulty",
        ),
        "car_load": ({"axle_distance": 2.5}, "parameter 'axle_distance': scene 'bogie' gives it"),
        "car_recorder": (
            {"boxes": "axle_3_left"},
            f"'axle_3_left' is none of the axleboxes; allowed are {FOUR[0]}",
        ),
    }
    for node, (parameters, _) in told.items():
        graph.node_process(node, scene="bogie", **parameters)
    for node, (_, sentence) in told.items():
        assert graph.exit_code(node) == 2
        assert sentence in graph.processes.log(node)
        assert "Traceback" not in graph.processes.log(node)


def test_parameters_choose_among_the_boxes_of_the_scene(train: Axleboxes) -> None:
    from beardyn_ros.rig import boxes_named

    assert tuple(box.name for box in boxes_named("", train)) == FOUR
    assert [box.name for box in boxes_named("axle_2_left, axle_1_left", train)] == [
        "axle_2_left",
        "axle_1_left",
    ]
    with pytest.raises(
        InputError, match=r"'axle_3_left' is none .* allowed are axle_1_left, .*, axle_2_right$"
    ):
        boxes_named("axle_3_left", train)
    with pytest.raises(InputError, match=r"allowed are axle_1_left to axle_32_right$"):
        boxes_named("axle_33_left", Axleboxes(axles=32))


def test_boxes_stand_about_the_middle_of_a_car_where_the_scene_has_them(train: Axleboxes) -> None:
    from beardyn_ros.rig import CAR, place_of

    assert [place_of(train, box).split()[:2] for box in train.boxes] == [
        ["1.25", "1"],
        ["1.25", "-1"],
        ["-1.25", "1"],
        ["-1.25", "-1"],
    ]
    assert [place_of(CAR, box).split()[0] for box in CAR.boxes[::2]] == ["10", "7.5", "-7.5", "-10"]
    assert place_of(Axleboxes(axles=1), Axleboxes(axles=1).boxes[0]).startswith("0 1 ")


def test_a_twin_that_is_told_its_box_is_that_of_the_scene() -> None:
    from beardyn_ros.rig import lone_box_rig

    def truth(box: str) -> dict[str, Any]:
        return dict(lone_box_rig(box)("bogie", "lumped", "standard")().description.truth)

    assert [bool(truth(box)["faults"]) for box in ("axle_1_left", "axle_2_left")] == [False, True]
    assert truth("axle_2_right")["box"] == {
        "name": "axle_2_right",
        "axle": 2,
        "side": "right",
        "behind_first_wheel_m": 2.5,
    }
    with pytest.raises(InputError, match="parameter 'box': 'axle_3_left' is none of the axleboxes"):
        lone_box_rig("axle_3_left")("bogie", "lumped", "standard")
    with pytest.raises(InputError, match="is not one box"):
        lone_box_rig("axle_1_left axle_2_left")("bogie", "lumped", "standard")


def test_twins_of_a_scene_without_pictures_publish_none(tmp_path: Path) -> None:
    from beardyn_ros.rig import axleboxes_of, box_rig

    text = Path("config/scenes/bogie.yaml").read_text(encoding="utf-8")
    mine = tmp_path / "mine.yaml"
    mine.write_text(text.replace("  axles: 2 ", "  pictures: false\n  axles: 2 "), encoding="utf-8")
    for scene, pictures in (("bogie", True), (str(mine), False)):
        train = axleboxes_of(scene)
        assert train is not None
        assert box_rig(train, train.boxes[0])(scene, "lumped", "standard")().pictures is pictures


def test_left_and_right_share_the_load_of_the_wheelset_as_in_a_desk_run(train: Axleboxes) -> None:
    from beardyn_ros.scenario import CarScenario

    scenario = CarScenario(train.boxes, train, "bogie", "", 0.5)
    desk = TrainLoads(read_scene("bogie").scene, train, train.boxes, 0.5)
    loads = {box.name: scenario.of(box).history for box in train.boxes}
    for box in train.boxes:
        assert np.array_equal(loads[box.name].wrench, desk.of(box).history.wrench)
    left, right = loads["axle_1_left"].wrench[:, 2], loads["axle_1_right"].wrench[:, 2]
    assert left.mean() == pytest.approx(right.mean(), rel=0.02)
    assert np.ptp(left - right) > 500.0  # a rail each
    time, second = loads["axle_2_left"].time_ns * 1e-9, loads["axle_2_left"].wrench[:, 2]
    later = time > 0.1
    earlier = np.interp(time[later] - 2.5 / (140.0 / 3.6), time, left)
    assert np.std(second[later] - earlier) < 0.05 * np.std(earlier)


def test_a_shared_file_has_what_each_box_said_once_and_ends_with_the_last(tmp_path: Path) -> None:
    from beardyn_ros.run_file import SharedFiles

    path = tmp_path / "run.mcap"
    shared = SharedFiles(("/car/a", "/car/b"))
    assert shared.path_of(1, lambda: path) == shared.path_of(1, lambda: tmp_path / "no.mcap") == path
    a, b = (shared.writer(shared.path_of(1, lambda: path), space) for space in ("/car/a", "/car/b"))
    said = {
        name: encode_diagnostics(0, "f", [Diagnostic(name, 0, "runs")])
        for name in ("car/a/twin", "car/b/twin", "x")
    }
    for each in (a, b):
        for cdr in said.values():
            each.add("/diagnostics", 0, cdr)  # everybody receives them all
    b.close("the twin has vanished")
    a.add("/diagnostics", 5, said["car/a/twin"])
    assert (a.message_count, b.counts["/diagnostics"]) == (4, 3)
    a.close("")
    scan = scan_recording(path)
    found = [message.cdr for message in scan.messages()]
    assert sorted(found) == sorted([*said.values(), said["car/a/twin"]])
    assert scan.metadata[END_RECORD]["status"] == "car/b: the twin has vanished"
    second = shared.writer(shared.path_of(2, lambda: tmp_path / "run_2.mcap"), "/car/b")  # after a reset
    second.add("/diagnostics", 0, said["car/b/twin"])
    second.close("")
    shared.close()  # the other box has had no second run
    scan = scan_recording(tmp_path / "run_2.mcap")
    assert [message.cdr for message in scan.messages()] == [said["car/b/twin"]]
    assert scan.metadata[END_RECORD]["status"] == "complete"


def test_a_shared_file_says_which_box_had_no_run(tmp_path: Path) -> None:
    from beardyn_ros.run_file import SharedFiles

    shared = SharedFiles(("/car/a", "/car/b"))
    box = shared.writer(shared.path_of(1, lambda: tmp_path / "run.mcap"), "/car/a")
    box.add("/diagnostics", 0, encode_diagnostics(0, "f", [Diagnostic("car/a/twin", 0, "runs")]))
    box.close("")
    shared.close()
    scan = scan_recording(tmp_path / "run.mcap")
    assert len(list(scan.messages())) == 1
    assert scan.metadata[END_RECORD]["status"] == "car/b: no run"


class Scene(Car):
    """The launch file with a scene that has axleboxes."""

    def names(self) -> list[str]:
        return ["car/twin", "car/load", "car/recorder"]


@pytest.mark.slow
def test_a_launch_of_a_bogie_has_its_boxes_in_one_process_and_one_file(graph: Graph) -> None:
    car = Scene(graph, (), "scene:=bogie", "duration:=0.5")
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)
    assert sorted(path.name for path in graph.folder.glob("*.mcap")) == ["car.mcap"]
    run = read_run(graph.folder / "car.mcap")
    assert tuple(run.boxes) == tuple(f"car/{name}" for name in FOUR)
    assert (run.complete, run.status) == (True, "complete")
    for name, box in run.boxes.items():
        assert np.array_equal(box.vibration.sample, np.arange(25 * 512))
        spoken = {status.name for _, statuses in box.diagnostics for status in statuses}
        assert {f"{name}/twin", f"{name}/load"} <= spoken
    assert not np.allclose(run.load.wrench[:500], run.boxes["car/axle_1_right"].load.wrench[:500])
    told = json.loads((graph.folder / "car.twin.yaml").read_text(encoding="utf-8"))
    assert told["/car/twin"]["ros__parameters"]["tier"] == "scene"


@pytest.mark.slow
def test_a_launch_takes_some_of_the_boxes_and_refuses_what_the_scene_says(graph: Graph) -> None:
    text = Path("config/scenes/bogie.yaml").read_text(encoding="utf-8")
    mine = graph.folder / "mine.yaml"
    mine.write_text(text.replace("axle_distance_m: 2.5", "axle_distance_m: 2.0"), encoding="utf-8")
    car = Scene(graph, ("axle_2_left",), f"scene:={mine}", "duration:=0.2")
    car.end()
    path = graph.folder / "car.mcap"
    assert tuple(read_run(path).boxes) == ("car/axle_2_left",)
    truth = [each.cdr for each in scan_recording(path).messages() if each.topic.endswith("/load/truth")]
    assert json.loads(decode_string(truth[-1]))["box"]["behind_first_wheel_m"] == 2.0
    graph.processes.start(
        "refused", "-m", "test.ros.launch_stand_in", str(graph.folder), "car.launch.py",
        "scene:=bogie", "faulty_box:=axle_1_left", "axle_distance:=2.0",
    )  # fmt: skip
    assert graph.exit_code("refused") != 0
    assert "its axleboxes set what faulty_box, axle_distance would" in graph.processes.log("refused")
    graph.dismiss("refused")


@pytest.mark.slow
def test_sigint_closes_the_one_file_of_all_boxes(graph: Graph) -> None:
    car = Scene(graph, (), "scene:=bogie", "duration:=4.0", "speed_factor:=1.0")
    car.boxes = FOUR
    car.until_running()
    graph.processes.signal("car", signal.SIGINT)
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)
    run = read_run(graph.folder / "car.mcap")
    assert run.complete
    assert all(len(box.vibration) > 10 * 512 for box in run.boxes.values())
    assert len(run.boxes) == 4


@pytest.mark.slow
def test_a_killed_recorder_leaves_a_file_with_all_boxes(graph: Graph) -> None:
    graph.shorten_lease()
    car = Scene(graph, (), "scene:=bogie", "duration:=4.0", "speed_factor:=1.0")
    car.boxes = FOUR
    car.until_running(75)  # it may lack a second
    psutil.Process(car.pid("car/recorder")).kill()
    car.end()
    run = read_run(graph.folder / "car.mcap")
    assert not run.complete
    assert all(len(box.vibration) > 10 * 512 for box in run.boxes.values())


@pytest.mark.slow
def test_a_bogie_on_ros_has_the_numbers_of_a_desk_run(graph: Graph) -> None:
    desk = bd.simulate("bogie", duration=1.0)  # compiles the kernels too
    car = Scene(graph, (), "scene:=bogie", "duration:=1.0", fake=False)
    graph.until(partial(has_ended, graph), "the end", timeout=280.0)
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)
    boxes = read_run(graph.folder / "car.mcap").boxes
    for name, here in desk.boxes.items():
        box = boxes[f"car/{name}"]
        count = round(0.9 * len(here.force_waveform))  # the load of a desk run goes on after its end
        assert len(box.force_waveform) > count
        np.testing.assert_allclose(
            box.force_waveform.values[:count], here.force_waveform.values[:count], rtol=1e-6, atol=1e-2
        )
        assert box.truth["condition"] == ("cup" if name == "axle_2_left" else "healthy")


def has_ended(graph: Graph) -> bool:
    return graph.processes.exit_code("car") is not None
