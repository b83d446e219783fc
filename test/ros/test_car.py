"""Several axleboxes of a car: one load source, one recorder, and an orderly end whatever ends first."""

from __future__ import annotations

import json
import re
import signal
from dataclasses import replace
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import psutil
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.record.reading import read_run
from beardyn_core.scene.axleboxes import Axleboxes, Box
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.car import NodeGroup
from beardyn_ros.rig import CAR, boxes_named
from test.ros.graph import Graph

EIGHT = tuple(box.name for box in CAR.boxes)
TWO = ("axle_1_left", "axle_4_right")
RADIUS = 0.46


def history(speed: np.ndarray, spacing_ns: int = 500_000) -> LoadHistory:
    count = len(speed)
    time = np.arange(count) * spacing_ns * 1e-9
    wrench = np.zeros((count, 6))
    wrench[:, 2] = 6e4 + 5e3 * np.sin(2 * np.pi * 40.0 * time)
    return LoadHistory(
        np.arange(count, dtype=np.int64) * spacing_ns, wrench, speed / RADIUS, np.zeros((count, 3))
    )


def test_a_wheel_further_back_gets_the_force_later_by_the_way_over_the_speed() -> None:
    from beardyn_core.rail.train import passed_later

    whole = history(np.full(4001, 50.0))
    first, begin = passed_later(whole, RADIUS, 0.0, 20.0)
    last, _ = passed_later(whole, RADIUS, 20.0, 20.0)
    assert begin == pytest.approx(0.4, abs=5e-4)
    assert len(first) == len(last) == 4001 - 800
    assert first.time_ns[0] == 0
    delay = 800
    # a cubic through 50 samples a wave: better than 1e-4 of the amplitude
    assert np.allclose(last.wrench[delay:, 2], first.wrench[:-delay, 2], atol=0.5)
    assert np.allclose(last.wrench[:, 2], whole.wrench[:-delay, 2], atol=0.5)


def test_a_slowing_train_has_one_speed_and_longer_delays() -> None:
    from beardyn_core.rail.train import passed_later

    speed = np.linspace(60.0, 20.0, 8001)
    whole = history(speed)
    last, begin = passed_later(whole, RADIUS, 20.0, 20.0)
    first = round(begin / 5e-4)
    assert np.array_equal(last.shaft_speed, whole.shaft_speed[first:])
    way = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]) * 5e-4)])
    then = np.interp(way[-1] - 20.0, way, whole.time_ns * 1e-9)
    assert last.wrench[-1, 2] == pytest.approx(6e4 + 5e3 * np.sin(2 * np.pi * 40.0 * then), abs=1.0)


def test_a_train_that_stands_or_turns_back_is_refused_with_a_sentence() -> None:
    from beardyn_core.rail.train import passed_later

    with pytest.raises(InputError, match=r"20 m behind the first.*runs 0\.0 m"):
        passed_later(history(np.zeros(100)), RADIUS, 20.0, 20.0)
    with pytest.raises(InputError, match="turns back"):
        passed_later(history(np.linspace(50.0, -50.0, 8001)), RADIUS, 2.5, 20.0)
    whole = history(np.zeros(100))
    assert passed_later(whole, RADIUS, 0.0, 0.0)[0] is whole


def test_boxes_are_named_by_axle_and_side() -> None:
    assert len(boxes_named(" ".join(EIGHT))) == 8
    assert boxes_named("axle_3_left, axle_4_right") == (
        Box("axle_3_left", 3, "left"),
        Box("axle_4_right", 4, "right"),
    )
    car = Axleboxes(axles=5)
    assert [car.behind(box) for box in car.boxes[::2]] == [0, 2.5, 17.5, 20, 25.0]
    assert [box.name for box in boxes_named("")] == list(EIGHT)
    for text, sentence in (
        ("axle_9_left", "'axle_9_left' is none of the axleboxes; allowed are axle_1_left, axle_1_right"),
        ("axle_1_left " * 2, "twice"),
    ):
        with pytest.raises(InputError, match=sentence):
            boxes_named(text)


def test_the_right_rail_is_another_one_and_a_wheel_defect_stays_with_its_wheel() -> None:
    from beardyn_ros.scenario import CarScenario

    boxes = boxes_named("axle_1_left axle_2_left axle_1_right")
    car = Axleboxes(axles=4, faulty=("axle_2_left",))
    scenario = CarScenario(boxes, car, "wheel_flat", "", 0.5)
    leading, flat, right = (scenario.of(box) for box in boxes)
    assert len(leading.history) == len(flat.history)  # 10 kHz over a rough rail as with a flat
    assert flat.history.wrench[:, 2].max() > 1.2 * leading.history.wrench[:, 2].max()
    assert leading.history.time_ns[-1] >= 0.49e9
    assert not np.allclose(leading.history.wrench[:, 2], right.history.wrench[:, 2], atol=100.0)
    assert leading.events["box"]["name"] == "axle_1_left"
    assert flat.events["box"]["behind_first_wheel_m"] == 2.5


@pytest.mark.parametrize(("code", "ends"), [(5, False), (4, True)])
def test_a_box_whose_file_is_incomplete_stops_no_other_box(code: int, ends: bool) -> None:
    group = NodeGroup.__new__(NodeGroup)
    done = SimpleNamespace(finished=True, exit_code=code)
    group.members = [done, SimpleNamespace(finished=False, exit_code=0)]
    assert group.finished is ends
    group.members = [done, SimpleNamespace(finished=True, exit_code=0)]
    assert group.finished
    assert group.exit_code == code


class Car:
    """The launch file, running in a test."""

    def __init__(self, graph: Graph, boxes: tuple[str, ...], *words: str, fake: bool = True) -> None:
        self.graph, self.boxes = graph, boxes
        graph.processes.start(
            "car", "-m", "test.ros.launch_stand_in", str(graph.folder), "car.launch.py",
            *(["--fake-twin"] if fake else []), f"boxes:={' '.join(boxes)}",
            f"output:={graph.folder / 'car.mcap'}", *words,
        )  # fmt: skip

    @property
    def log(self) -> str:
        return self.graph.processes.log("car")

    def pid(self, name: str) -> int:
        found = re.search(rf"^\[launch\] {name} pid (\d+)$", self.log, re.M)
        assert found is not None, self.log
        return int(found[1])

    def exits(self) -> dict[str, int]:
        return {
            name: int(code) for name, code in re.findall(r"^\[launch\] (\S+) exit (-?\d+)$", self.log, re.M)
        }

    def names(self) -> list[str]:
        return [*(f"car/{box}/twin" for box in self.boxes), "car/load", "car/recorder"]

    def until_running(self, blocks: int = 10) -> None:
        def running() -> bool:
            said = [self.graph.statuses("twin", f"/car/{box}") for box in self.boxes]
            return all(each and int(each[-1].value("blocks") or 0) > blocks for each in said)

        self.graph.until(running, "all boxes to run")

    def end(self) -> None:
        """Wait for the end of everything: the launch fails with a node, and nothing is left behind."""
        assert self.graph.exit_code("car") == int(any(self.exits().values())), self.log
        pids = [self.pid(name) for name in self.names()]
        _, alive = psutil.wait_procs([psutil.Process(p) for p in pids if psutil.pid_exists(p)], timeout=2.0)
        assert alive == []
        assert "Traceback" not in self.log, self.log

    def file(self, box: str) -> Path:
        return self.graph.folder / f"car_{box}.mcap"


def test_a_car_ends_with_its_load_and_every_box_has_a_whole_file(graph: Graph) -> None:
    car = Car(graph, TWO, "duration:=2.0")
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)
    loads = {}
    for box in TWO:
        run = read_run(car.file(box))
        assert np.array_equal(run.vibration.sample, np.arange(100 * 512))
        assert (run.complete, run.status) == (True, "complete")
        loads[box] = run.load
        told = json.loads((graph.folder / f"car.{box}.twin.yaml").read_text(encoding="utf-8"))
        assert told[f"/car/{box}/twin"]["ros__parameters"]["box"] == box
    assert all(graph.statuses("twin", f"/car/{box}") for box in TWO)
    assert not np.allclose(loads[TWO[0]].wrench[:500], loads[TWO[1]].wrench[:500])


@pytest.mark.slow
def test_boxes_of_a_car_stay_together_within_the_horizon(graph: Graph) -> None:
    car = Car(graph, TWO, "scene:=static_80kN", "duration:=6.0", "speed_factor:=1.0")
    car.until_running()
    slow = psutil.Process(car.pid("car/axle_4_right/twin"))
    slow.suspend()

    def lead() -> float:
        first, last = (graph.statuses("twin", f"/car/{box}")[-1] for box in TWO)
        return float(first.value("simulated_time")) - float(last.value("simulated_time"))

    graph.until(lambda: lead() > 0.8, "the other box to run ahead")
    graph.until(
        lambda: graph.statuses("twin", f"/car/{TWO[0]}")[-1].value("load_queue") == "0",
        "the other box to wait for load",
    )
    assert lead() < 1.4  # the horizon, and credit on its way
    slow.resume()
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)


@pytest.mark.parametrize(
    ("first", "number"),
    [
        pytest.param(name, number, marks=pytest.mark.slow)
        for name in ("car/load", "car/recorder", "car/axle_4_right/twin")
        for number in (signal.SIGKILL, signal.SIGINT)
    ],
)
def test_a_car_ends_orderly_whatever_ends_first(graph: Graph, first: str, number: signal.Signals) -> None:
    graph.shorten_lease()
    car = Car(graph, TWO, "scene:=static_80kN", "duration:=60.0", "speed_factor:=1.0")
    car.until_running(75 if first == "car/recorder" else 10)  # a killed recorder may lack a second
    psutil.Process(car.pid(first)).send_signal(number)
    car.end()
    exits = car.exits()
    assert set(exits) == set(car.names())
    assert exits[first] == (-number if number == signal.SIGKILL else 0)
    assert all(code in (0, 4) for name, code in exits.items() if name != first)
    if first != "car/recorder":
        assert exits["car/recorder"] == 0
    for box in TWO:
        assert len(read_run(car.file(box)).vibration) > 10 * 512


def test_sigint_ends_a_car_with_closed_files(graph: Graph) -> None:
    car = Car(graph, TWO, "scene:=static_80kN", "duration:=60.0", "speed_factor:=1.0")
    car.until_running()
    graph.processes.signal("car", signal.SIGINT)
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)
    for box in TWO:
        assert len(read_run(car.file(box)).vibration) > 10 * 512


def test_load_of_a_car_refuses_what_it_cannot_do(graph: Graph) -> None:
    graph.start("names", "beardyn_ros", "car_load", boxes="axle_7_left")
    graph.start("scene", "beardyn_ros", "car_load", scene="no_such_scene")
    graph.start("back", "beardyn_ros", "car_load", scene="reversing")
    graph.start("flat", "beardyn_ros", "car_load", boxes="axle_2_left", scene="smooth_run")
    told = {
        "names": "is none of the axleboxes",
        "scene": "no_such_scene",
        "back": "turns back",
        "flat": "none of",
    }
    for name, word in told.items():
        assert graph.exit_code(name) == 2
        assert word in graph.processes.log(name)
        assert "Traceback" not in graph.processes.log(name)


def test_twins_of_a_car_refuse_boxes_that_there_are_not(graph: Graph) -> None:
    graph.start("twins", "beardyn_ros", "car_twin", boxes="axle_1_left", faulty="axle_2_left")
    assert graph.exit_code("twins") == 2
    assert "faulty has axle_2_left; the boxes are axle_1_left" in graph.processes.log("twins")


def test_a_twin_that_is_told_its_box_is_mirrored_on_the_right() -> None:
    """As `beardyn simulate` makes it of a scene with axleboxes; the defect stays, in the mirrored row."""
    from beardyn_ros.rig import lone_box_rig

    rows = [
        lone_box_rig(name)("cup_spall", "lumped", "standard")().description.truth["faults"][0]["row"]
        for name in ("axle_1_left", "axle_1_right", " axle_1_right,")
    ]
    assert rows == [0, 1, 1]


def _has_ended(graph: Graph, name: str) -> bool:
    return graph.processes.exit_code(name) is not None


@pytest.mark.slow
def test_twins_of_several_boxes_run_in_one_process(graph: Graph) -> None:
    from beardyn_core.choice import load_scene
    from beardyn_core.config.boxes import scene_of_box
    from beardyn_core.twin import Twin

    boxes = "axle_1_left axle_1_right"
    car = Axleboxes(axles=4, faulty=("axle_1_right",))
    scene = replace(load_scene("cup_spall", tier="lumped", effects="standard"), axleboxes=car)
    for box in car.boxes[:2]:
        Twin(scene_of_box(scene, box)).warm()
    graph.start(
        "twins", "beardyn_ros", "car_twin",
        boxes=boxes, scene="cup_spall", tier="lumped", effects="standard", faulty="axle_1_right",
    )  # fmt: skip
    output = str(graph.folder / "car.mcap")
    graph.start("recorder", "beardyn_ros", "car_recorder", boxes=boxes, output=output)
    graph.start(
        "load", "beardyn_ros", "car_load", boxes=boxes, scene="cup_spall", duration=0.5, axle_distance=0.0
    )
    for name in ("twins", "recorder"):
        graph.until(partial(_has_ended, graph, name), name, timeout=200.0)
        assert graph.exit_code(name) == 0, graph.processes.log(name)
    for name in boxes.split():
        run = read_run(graph.folder / f"car_{name}.mcap")
        assert len(run.vibration) > 24 * 512  # less what the filter of the sensor looks ahead
        assert [fault["row"] for fault in run.truth["faults"]] == ([1] if name == "axle_1_right" else [])


@pytest.mark.slow
def test_eight_boxes_of_a_car_run_to_the_end_and_one_of_them_is_spalled(graph: Graph) -> None:
    from beardyn_core.choice import load_scene
    from beardyn_core.sensors.resampling import DELAY
    from beardyn_core.sensors.sensor_set import lookahead
    from beardyn_core.twin import Twin

    scenes = [load_scene(name, tier="lumped", outside_load=True) for name in ("smooth_run", "cup_spall")]
    for scene in scenes:
        Twin(scene).warm()
        assert scene.numerics.steps_per_sample > 1  # which a filter makes samples of
    car = Car(graph, EIGHT, "duration:=1.0", "faulty_box:=axle_2_left", fake=False)
    graph.until(lambda: graph.processes.exit_code("car") is not None, "the end", timeout=280.0)
    car.end()
    assert car.exits() == dict.fromkeys(car.names(), 0)
    for box in EIGHT:
        run = read_run(car.file(box))
        assert len(run.vibration) == 50 * 512 - DELAY - lookahead(scenes[0])  # of filters of steps and sensor
        assert bool(run.truth["faults"]) == (box == "axle_2_left")
