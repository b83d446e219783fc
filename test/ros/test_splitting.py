"""The recorder in several files: split while it runs, killed in between, read as one."""

from __future__ import annotations

import signal

import numpy as np

from beardyn_core.record.bag_scanning import INDEX, files_of
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from test.record.hostile import told
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected


def test_a_run_in_files_of_a_second_is_whole_and_its_index_is_followed(graph: Graph) -> None:
    folder = graph.folder / "run"
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("recorder", output=f"{folder}.mcap", max_file_duration=1.0)
    is_connected(graph, "recorder")
    graph.fake_load(duration=4.0)
    assert graph.exit_code("recorder") == 0, graph.processes.log("recorder")
    assert [path.name for path in files_of(folder)] == [f"run_{number}.mcap" for number in range(4)]
    for path in files_of(folder):
        assert McapScan(path).problem == ""
    run = read_run(folder)
    assert run.complete
    assert run.status == "complete"
    assert np.array_equal(run.vibration.sample, np.arange(200 * 512))
    assert report(folder / INDEX).missing_messages == ()
    code, said = told("report", str(folder))
    assert code == 0
    assert "no samples missing" in said


def test_kill_9_leaves_every_file_before_whole_and_the_last_but_its_end(graph: Graph) -> None:
    folder = graph.folder / "run"
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("recorder", output=f"{folder}.mcap", max_file_duration=1.0, max_file_size=100.0)
    is_connected(graph, "recorder")
    graph.fake_load(duration=60.0)
    graph.until(lambda: (folder / "run_2.mcap").is_file(), "the third file")
    graph.until(
        lambda: (folder / "run_2.mcap").stat().st_size > 200_000 or (folder / "run_3.mcap").is_file(),
        "some of it",
    )
    before = read_run(folder).force.time[-1]  # what the recorder had handed to the system
    graph.processes.signal("recorder", signal.SIGKILL)
    run = read_run(folder)
    assert not run.complete
    assert run.problem
    assert np.array_equal(run.vibration.sample, np.arange(len(run.vibration)))
    assert all(McapScan(path).problem == "" for path in files_of(folder)[:-1])
    assert run.force.time[-1] >= before
    assert before > 1.0  # two files and some of the third
    code, said = told("report", str(folder))
    assert code == 0
    assert "recovered" in said


def test_a_folder_with_a_recording_is_refused(graph: Graph) -> None:
    folder = graph.folder / "run"
    folder.mkdir()
    (folder / "run_0.mcap").write_bytes(b"of last week")
    graph.node_process("recorder", output=f"{folder}.mcap", max_file_size=5.0)
    assert graph.exit_code("recorder") == 2
    assert "the folder exists; give another name, or replace:=true" in graph.processes.log("recorder")


def test_too_small_a_size_is_refused(graph: Graph) -> None:
    graph.node_process("recorder", output=str(graph.folder / "run.mcap"), max_file_size=0.2)
    assert graph.exit_code("recorder") == 2
    assert "max_file_size 0.2 MB is too small" in graph.processes.log("recorder")
