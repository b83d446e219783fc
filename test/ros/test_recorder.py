"""The recorder node: complete, self-describing, safe against kill -9, one file a run."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from beardyn_core.record.clouds import cloud_to_arrays, encode_points
from beardyn_core.record.encoding import temperature_template
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.messages import (
    Diagnostic,
    decode_diagnostics,
    encode_diagnostics,
    encode_string,
    encode_time,
    header_stamp,
)
from beardyn_core.record.plot_values import FOLLOWER, value_topics
from beardyn_core.record.published import MissingMessages, last_published
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.record.topics import TOPICS, topic
from beardyn_ros.diagnostics import TwinWatch
from beardyn_ros.recording import MESSAGES_BEFORE_TRUTH, Recording, free_name
from beardyn_ros.run_state import FINISHED, INTERRUPTED, LEFT
from test.ros.fake_twin import fake_history
from test.ros.graph import Graph

NO_BODIES = np.zeros(0, dtype=[("sample", "<u4")])
LIVE_ONLY = ("load/wrench", "load/shaft")
# no thermal effect in the scene, no follower beside
OF_A_FOLLOWER = ("follower/estimate", "follower/residual", *value_topics(FOLLOWER))
ABSENT = (*LIVE_ONLY, "temperature", "source_time", "vibration_samples", *OF_A_FOLLOWER)


def is_connected(graph: Graph, part: str) -> None:
    """Wait until a node receives the twin: nobody misses a twin that it has never seen."""
    graph.until(
        lambda: any(status.value("connected") == "true" for status in graph.statuses(part)),
        f"the connection of the {part} to the twin",
    )


def record(graph: Graph, path: Path, duration: float, *others: str, **parameters: object) -> None:
    graph.fake_twin(speed_factor=2.0, **parameters)
    graph.node_process("recorder", output=str(path))
    for other in others:
        graph.node_process(other)
    for part in ("recorder", *others):
        is_connected(graph, part)
    graph.fake_load(duration=duration)


def test_recording_is_complete_and_an_independent_reader_decodes_every_topic(graph: Graph) -> None:
    from rosbags.highlevel import AnyReader

    path = graph.folder / "run.mcap"
    graph.listen("vibration", "force_waveform")
    record(graph, path, 1.6, "monitor")
    for name in ("twin", "load", "monitor", "recorder"):
        assert graph.exit_code(name) == 0, graph.processes.log(name)
    run = read_run(path)
    assert run.complete
    assert run.status == "complete"
    assert np.array_equal(run.vibration.sample, np.arange(80 * 512))
    assert np.array_equal(run.force_waveform.sample, np.arange(80 * 512))
    assert len(run.force) == len(run.shaft) == len(run.specific_force) == 640
    assert len(run.cages) == len(run.bodies) == 320
    assert np.array_equal(run.load.sample, np.arange(3201))
    assert run.described().scene == "synthetic"
    assert run.truth["run_id"]
    assert run.results[-1][1][0].value("verdict") == "cup"

    namespace_free = {entry.path(): entry.type for entry in TOPICS if entry.name not in ABSENT}
    with AnyReader([path]) as reader:
        assert {connection.topic: connection.msgtype for connection in reader.connections} == namespace_free
        decoded = {connection.topic: 0 for connection in reader.connections}
        waveforms = []
        for connection, _, raw in reader.messages():
            message: Any = reader.deserialize(raw, connection.msgtype)
            decoded[connection.topic] += 1
            if connection.topic == "/axlebox/vibration":
                waveforms.append(message.data.tobytes())
    assert min(decoded.values()) > 0
    assert decoded["/axlebox/force"] == 640
    received = [cloud_to_arrays(cdr).tobytes() for cdr in graph.messages["vibration"]]
    assert waveforms == received


def test_kill_9_of_the_recorder_leaves_a_recoverable_file_and_the_twin_runs_on(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.listen("vibration")
    record(graph, path, 60.0)
    graph.until(
        lambda: any(float(s.value("simulated_time")) > 4.0 for s in graph.statuses("twin")), "4 s recorded"
    )
    graph.processes.signal("recorder", signal.SIGKILL)
    simulated = float(graph.statuses("twin")[-1].value("simulated_time"))
    run = read_run(path)
    assert not run.complete
    assert run.problem
    assert run.described().scene == "synthetic"
    # At a speed factor of 2 one second on the wall is 2 s of simulated time.
    assert run.vibration.time[-1] > simulated - 2.0
    assert np.all(np.diff(run.vibration.sample) == 1)
    before = len(graph.messages["vibration"])
    graph.until(
        lambda: len(graph.messages["vibration"]) > before + 50,
        "a second of blocks without the recorder",
        check_processes=False,
    )


@pytest.mark.parametrize("clock", ["source", "simulated"])
def test_live_load_stamped_with_wall_time_leaves_the_span_of_the_file_alone(graph: Graph, clock: str) -> None:
    from mcap.reader import make_reader

    from beardyn_ros.live_load import encode_shaft, encode_wrench

    path = graph.folder / "run.mcap"
    graph.fake_twin(mode="live", stamps=clock)
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.connected("load/wrench", "load/shaft", "load/blocks")
    stamps: list[int] = []

    def send_until_one_second() -> bool:
        stamps.append(time.time_ns())
        graph.out.publish("load/wrench", encode_wrench(np.array([0.0, 0.0, 8e4, 0.0, 0.0, 0.0]), stamps[-1]))
        graph.out.publish("load/shaft", encode_shaft(100.0, stamps[-1]))
        return any(float(s.value("simulated_time")) > 1.0 for s in graph.statuses("twin"))

    graph.until(send_until_one_second, "a second under live load")
    empty = fake_history("", "", 1.0).part(0, 0)
    graph.out.publish("load/blocks", encode_load(empty, 0))
    assert graph.exit_code("twin") == 0
    assert graph.exit_code("recorder") == 0
    with path.open("rb") as stream:
        messages = list(make_reader(stream).iter_messages())
    logged = np.array([message.log_time for _, _, message in messages])
    shaft = [message for _, channel, message in messages if channel.topic == "/axlebox/load/shaft"]
    times = np.array([message.log_time for message in shaft])
    begin = stamps[0] - 1_000_000_000 if clock == "source" else 0
    assert begin <= logged.min() <= logged.max() < logged.min() + 5_000_000_000
    assert times.max() > logged.min() + 800_000_000
    assert np.all(np.diff(times) >= 0)
    assert {header_stamp(message.data) for message in shaft} <= set(stamps)


def test_recorder_without_a_twin_gives_up_with_a_sentence(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.node_process("recorder", output=str(path), start_timeout=0.5)
    assert graph.exit_code("recorder") == 4
    assert "no twin in /axlebox for start_timeout = 0.5 s" in graph.processes.log("recorder")
    assert not path.exists()


def test_reset_begins_a_new_file(graph: Graph) -> None:
    from std_srvs.srv import Trigger

    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=0.1)  # a busy machine has time to reset it
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.fake_load(duration=1.5, exit_when_done=False)
    graph.until(
        lambda: any(float(s.value("simulated_time")) > 0.1 for s in graph.statuses("twin")), "some blocks"
    )
    assert graph.call("reset", Trigger).success
    graph.set_parameter("twin", "speed_factor", 2.0)
    assert graph.exit_code("twin") == 0
    assert graph.exit_code("recorder") == 0, graph.processes.log("recorder")
    first, second = read_run(path), read_run(path.with_name("run_2.mcap"))
    assert first.complete
    assert second.complete
    assert first.status == "the run was left by a reset"
    assert report(path).missing_messages == report(path.with_name("run_2.mcap")).missing_messages == ()
    assert second.status == "complete"
    assert first.truth["run_id"] != second.truth["run_id"]
    assert np.array_equal(second.vibration.sample, np.arange(75 * 512))
    old = first.vibration
    assert np.array_equal(old.sample, np.arange(len(old)))
    assert np.array_equal(old.values, second.vibration.values[: len(old)])
    assert np.array_equal(np.unique(second.load.sample), np.arange(3001))


def test_kill_9_of_the_twin_is_noticed_by_everybody(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.shorten_lease()
    record(graph, path, 60.0, "monitor")
    graph.until_state("running")
    graph.processes.signal("twin", signal.SIGKILL)
    assert graph.exit_code("recorder") == 0
    assert graph.exit_code("monitor") == 0
    assert graph.exit_code("load") == 4
    assert "vanished" in (read_run(path).status or "")


def test_recorder_of_a_validity_error_says_how_the_run_ended(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    record(graph, path, 1.0, scene="fake_invalid")
    assert graph.exit_code("recorder") == 0
    run = read_run(path)
    assert run.complete
    assert "a roller has left its rib" in (run.status or "")
    assert len(run.vibration) == 6 * 512
    assert topic("vibration").path() == "/axlebox/vibration"


def test_an_existing_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    path.write_text("of last week")
    done = subprocess.run(
        [sys.executable, "-m", "beardyn_ros", "recorder", "--ros-args", "-p", f"output:={path}"],
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 2
    assert f"output '{path}': the file exists; give another name, or replace:=true" in done.stderr
    assert path.read_text() == "of last week"


def test_a_reset_never_writes_over_an_earlier_recording(tmp_path: Path) -> None:
    """A run that has begun takes the next free name, for it cannot be refused any more."""
    (tmp_path / "run_2.mcap").write_text("of last week")
    names = ["run.mcap", "run_3.mcap"]
    recording = Recording(lambda _scene, number: free_name(tmp_path / "run.mcap", number), "/axlebox")
    for run_id in ("one", "two"):
        recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": run_id})))
    recording.close("")
    assert [path.name for path in recording.paths] == names
    assert (tmp_path / "run_2.mcap").read_text() == "of last week"


def test_a_short_run_that_is_over_before_its_truth_comes_has_its_last_word(tmp_path: Path) -> None:
    """Topics are not ordered among each other: a truth that is sent again may come after everything else."""
    recording = Recording(lambda _scene, number: free_name(tmp_path / "run.mcap", number), "/axlebox")
    watch = TwinWatch("axlebox/twin", lambda: 1)
    parts = [temperature_template(f"axlebox/{part}") for part in ("cup", "cone")]

    def truth(run_id: str) -> None:
        recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": run_id})))
        watch.begin_run(run_id)

    def last_word(run_id: str, state: str, said: str, bodies: int) -> None:
        values = (("run_id", run_id), ("state", state), ("messages bodies", str(bodies)))
        word = Diagnostic("axlebox/twin", 0, said, values)
        watch.take_statuses((word,))
        recording.receive(word)
        recording.add(topic("/diagnostics"), encode_diagnostics(0, "axlebox", [word]))

    def blocks(count: int) -> None:
        for block in range(count):
            recording.add(topic("bodies"), encode_points(NO_BODIES, 20_000_000 * block, "axlebox"))
            for part in parts:
                (row,) = part.rows(np.array([20_000_000 * (block + 1)]), celsius=np.full((1, 1), 60.0))
                recording.add(topic("temperature"), row.tobytes())

    truth("i-1")
    blocks(5)
    last_word("i-1", INTERRUPTED, LEFT, 5)
    first = recording.current
    blocks(3)
    last_word("i-2", FINISHED, "finished", 4)
    assert not watch.ended
    truth("i-2")
    second = recording.current
    assert first is not None
    assert second is not None
    assert watch.ended
    assert first.missing() == []
    assert second.missing() == [MissingMessages("bodies", 4, 3)]
    recording.close("")
    assert (first.counts["temperature"], second.counts["temperature"]) == (10, 6)
    for path, published in zip(recording.paths, (5, 4), strict=True):
        said = [each.cdr for each in McapScan(path).messages() if each.topic == "/diagnostics"]
        statuses = [status for cdr in said for status in decode_diagnostics(cdr)[1]]
        assert last_published(statuses) == {"bodies": published}


@pytest.mark.parametrize("before", [1, 2])
@pytest.mark.parametrize("truth_first", [True, False])
def test_temperatures_of_a_run_left_at_once_are_told_apart(
    before: int, truth_first: bool, tmp_path: Path
) -> None:
    """The first stamps of two runs are equal; each has a message for each part."""
    recording = Recording(lambda _scene, number: free_name(tmp_path / "run.mcap", number), "/axlebox")
    parts = [temperature_template(f"axlebox/{part}") for part in ("cup", "cone")]

    def truth(run_id: str) -> None:
        recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": run_id})))

    def heat(count: int) -> None:
        for number in range(count):
            for part in parts:
                (row,) = part.rows(
                    np.array([20_000_000 + 200_000_000 * number]), celsius=np.full((1, 1), 60.0)
                )
                recording.add(topic("temperature"), row.tobytes())

    truth("i-1")
    heat(before)
    first = recording.current
    if truth_first:
        truth("i-2")
    heat(3)
    if not truth_first:
        truth("i-2")
    second = recording.current
    recording.close("")
    assert first is not None
    assert second is not None
    assert (first.counts["temperature"], second.counts["temperature"]) == (2 * before, 6)


def test_a_file_without_a_truth_has_the_last_word_of_the_twin(tmp_path: Path) -> None:
    recording = Recording(lambda _scene, number: free_name(tmp_path / "run.mcap", number), "/axlebox")
    recording.add(topic("truth"), encode_string(json.dumps({"scene": "x"})))
    word = Diagnostic("axlebox/twin", 0, "finished", (("run_id", "i-1"), ("state", FINISHED)))
    recording.receive(word)
    recording.add(topic("/diagnostics"), encode_diagnostics(0, "axlebox", [word]))
    recording.close("")
    recording.close("")
    assert len(recording.paths) == 1
    assert "/diagnostics" in recorded_topics(recording.paths[0])


@pytest.mark.parametrize("count", [10, 2 * MESSAGES_BEFORE_TRUTH])
def test_a_load_that_goes_on_behind_a_run_makes_no_file(tmp_path: Path, count: int) -> None:
    """It is of the next run; where none has begun, it may be all that there is, and is kept."""
    received = topic("/clock"), encode_time(0)
    recording = Recording(lambda _scene, number: free_name(tmp_path / "run.mcap", number), "/axlebox")
    recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": "one"})))
    recording.close("finished")
    for _ in range(count):
        recording.add(*received)
    recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": "two"})))
    assert recording.current is not None
    kept = recording.current.counts["/clock"]
    assert min(count, MESSAGES_BEFORE_TRUTH // 2) <= kept <= MESSAGES_BEFORE_TRUTH
    recording.close("finished")
    recording.add(*received)
    recording.close("the recorder was told to stop")
    assert [path.name for path in recording.paths] == ["run.mcap", "run_2.mcap"]
    alone = Recording(lambda _scene, number: free_name(tmp_path / "alone.mcap", number), "/axlebox")
    alone.add(*received)
    alone.close("")
    assert recorded_topics(tmp_path / "alone.mcap") == {"/clock"}


def test_an_early_last_word_counts_where_the_run_before_said_nothing() -> None:
    watch = TwinWatch("axlebox/twin", lambda: 1)
    watch.begin_run("i-1")
    watch.take_statuses((Diagnostic("axlebox/twin", 0, "", (("run_id", "i-2"), ("state", FINISHED))),))
    assert not watch.ended
    watch.begin_run("i-2")
    assert watch.ended


def recorded_topics(path: Path) -> set[str]:
    return {each.topic for each in McapScan(path).messages()}


@pytest.mark.parametrize("truth_after", range(4))
def test_blocks_of_a_new_run_that_overtake_its_truth_stay_with_it(tmp_path: Path, truth_after: int) -> None:
    """Topics are not ordered among each other; the truth of a run may come after its first blocks."""
    recording = Recording(lambda _scene, number: free_name(tmp_path / "run.mcap", number), "/axlebox")

    def truth(run_id: str) -> None:
        recording.add(topic("truth"), encode_string(json.dumps({"scene": "x", "run_id": run_id})))

    truth("one")
    for block in range(5):
        recording.add(topic("bodies"), encode_points(NO_BODIES, 20_000_000 * block, "axlebox"))
    first = recording.current
    for block in range(8):
        if block == truth_after:
            truth("two")
        recording.add(topic("bodies"), encode_points(NO_BODIES, 20_000_000 * block, "axlebox"))
    second = recording.current
    assert first is not None
    assert second is not None
    recording.close("")
    assert (first.counts["bodies"], second.counts["bodies"]) == (5, 8)
