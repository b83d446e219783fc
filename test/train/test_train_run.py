"""Several axleboxes at once: the same numbers as one by one, one recording for all."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.cli.main import BAD_INPUT, main
from beardyn_core.config.boxes import scene_of_box
from beardyn_core.rail.build import length_of_load
from beardyn_core.rail.train import TrainLoads
from beardyn_core.record.reading import namespaces_in
from beardyn_core.record.run import Run
from beardyn_core.run import start
from beardyn_core.scene.scene import Scene
from beardyn_core.study.monitored_recording import EXIT_CODES
from test.train.test_boxes import train

SECONDS = 0.72  # three rounds of 16 blocks of 20 ms, the last of them shorter


@pytest.fixture(scope="module")
def scene() -> Scene:
    return replace(train(faulty=["axle_1_right"]), duration=SECONDS)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("train") / "train.mcap"


@pytest.fixture(scope="module")
def in_memory(scene: Scene, recording: Path) -> Run:
    return bd.simulate(scene, record=recording)


def test_each_box_has_the_numbers_that_it_has_alone(scene: Scene, in_memory: Run) -> None:
    assert scene.axleboxes is not None
    boxes = scene.axleboxes.boxes
    loads = TrainLoads(scene, scene.axleboxes, boxes, length_of_load(scene, SECONDS))
    for box in boxes[1:3]:
        alone = start(scene_of_box(scene, box), SECONDS, loads.of(box).history)
        force = np.concatenate([block.force_waveform for block in alone.blocks()])
        assert np.array_equal(in_memory.boxes[box.name].force_waveform.values, force)


def test_a_recording_has_a_namespace_for_each_box_and_a_truth(in_memory: Run, recording: Path) -> None:
    read = bd.read(recording)
    assert list(read.boxes) == ["axle_1_left", "axle_1_right", "axle_2_left", "axle_2_right"]
    assert read.status == "complete"
    for name, box in read.boxes.items():
        here = in_memory.boxes[name]
        assert len(box.vibration) == len(here.vibration) > 15_000
        assert np.allclose(box.force_waveform.values, here.force_waveform.values, rtol=1e-6, atol=1e-2)
        assert box.truth["box"]["name"] == name
        assert box.truth["condition"] == ("cup" if name == "axle_1_right" else "healthy")
        assert len(box.bodies.time_ns) == len(here.bodies.time_ns)
        assert len(box.load) == len(here.load)
        assert {each.name for _, statuses in box.diagnostics for each in statuses} == {f"{name}/twin"}
    # row 0 is inboard on the left side: the mirrored spall lies in row 1 of the right box
    assert [fault["row"] for fault in read.boxes["axle_1_right"].truth["faults"]] == [1]
    other = bd.read(recording, "axle_2_left")
    assert other.truth["box"]["behind_first_wheel_m"] == 2.5
    assert "vibration" in repr(other) or "Run of" in repr(other)
    with pytest.raises(InputError, match=r"namespace /axle_9_left; it has axle_1_left"):
        bd.read(recording, "axle_9_left")


def test_boxes_are_listed_by_name_and_number_in_whatever_order_they_begin() -> None:
    topics = [f"/car/{name}/force" for name in ("axle_10_left", "axle_2_right", "axle_1_left", "axle_2_left")]
    assert namespaces_in(["/clock", *topics, "/car/axle_1_left/vibration/side"]) == [
        "/car/axle_1_left",
        "/car/axle_2_left",
        "/car/axle_2_right",
        "/car/axle_10_left",
    ]


def test_commands_take_a_box(
    in_memory: Run, recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert in_memory.boxes
    assert main(["report", str(recording), "--box", "axle_1_right"]) == 0
    told = capsys.readouterr().out
    assert "4, 3 healthy; axle_1_right: cup" in told
    assert "spall on the cup, row 1" in told
    assert "no samples missing" in told
    target = tmp_path / "one.npz"
    assert main(["export", str(recording), "--box", "axle_2_right", "-o", str(target)]) == 0
    assert len(np.load(target, allow_pickle=False)["force_waveform.values"]) == len(in_memory.force_waveform)
    assert main(["monitor", str(recording)]) == EXIT_CODES["not_diagnosable"]
    assert capsys.readouterr().out.count("not_diagnosable") >= 4
    assert main(["monitor", str(recording), "--which-bearing"]) == BAD_INPUT
    assert "has 4 axleboxes" in capsys.readouterr().err
    assert main(["monitor", str(recording), "--which-bearing", "--box", "axle_1_right"]) == 0
    assert capsys.readouterr().out.startswith("cannot tell: ")
    assert main(["view", str(recording), "--box", "axle_1_right", "--save", str(tmp_path / "v.rrd")]) == 0


def test_bodies_and_contacts_can_be_left_out(scene: Scene, tmp_path: Path) -> None:
    assert scene.axleboxes is not None
    bare = replace(scene, duration=0.1, axleboxes=replace(scene.axleboxes, axles=1, pictures=False))
    bd.simulate(bare, record=tmp_path / "bare.mcap")
    read = bd.read(tmp_path / "bare.mcap")
    assert len(read.bodies.time_ns) == 0
    assert len(read.vibration) > 1000
    assert read.duration == pytest.approx(0.1, abs=0.05)


def test_loads_of_both_sides_are_mirrored_runs_over_rails_of_their_own(in_memory: Run) -> None:
    left, right = in_memory.boxes["axle_1_left"].load.wrench, in_memory.boxes["axle_1_right"].load.wrench
    assert np.mean(left[:, 2]) == pytest.approx(np.mean(right[:, 2]), rel=0.02)
    assert not np.allclose(left[:, 2], right[:, 2], rtol=1e-4)


@pytest.mark.slow
def test_a_monitor_finds_the_spall_of_the_shipped_bogie_in_its_box_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bogie.mcap"
    assert main(["warmup", "bogie"]) == 0  # two sorts of kernels: sound and faulty
    assert main(["simulate", "bogie", "-o", str(path)]) == 0
    capsys.readouterr()
    assert main(["monitor", str(path)]) == EXIT_CODES["cup"]
    told = [line for line in capsys.readouterr().out.splitlines() if " analyses, " in line]
    assert [line.split(":")[0] for line in told] == [
        "axle_1_left healthy",
        "axle_1_right healthy",
        "axle_2_left outer ring (cup)",
        "axle_2_right healthy",
    ]
