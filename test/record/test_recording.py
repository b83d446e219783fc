"""Recordings: what independent readers find, what a cut leaves, what gaps show."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mcap.reader import make_reader
from rosbags.highlevel import AnyReader, AnyReaderError
from rosbags.interfaces import ConnectionExtRosbag2

from beardyn_core.base.errors import InputError
from beardyn_core.cli import main as command
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.mcap_scanning import McapScan, recover
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import encode_string
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import gaps, report
from beardyn_core.record.sinks import McapSink, MemorySink
from beardyn_core.record.topics import relative_name, topic
from test.examples import examples
from test.record.conftest import BLOCKS
from test.record.synthetic_run import SHAPE, SyntheticRun, description
from test.recordings import write_recording

EXPECTED_COUNTS = {
    "force": 8 * BLOCKS,
    "imu": 8 * BLOCKS,
    "shaft": 8 * BLOCKS,
    "joint_states": 4 * BLOCKS,
    "force_waveform": BLOCKS,
    "vibration": BLOCKS,
    "vibration/axlebox_end": BLOCKS,
    "bodies": BLOCKS,
    "contacts": BLOCKS,
    "truth": 1,
    "load/blocks": BLOCKS,
    "/diagnostics": BLOCKS // 10,
}


def test_rosbags_lists_and_decodes_every_topic(recording: Path) -> None:
    with AnyReader([recording]) as reader:
        counts = {relative_name(c.topic): c.msgcount for c in reader.connections}
        assert counts == EXPECTED_COUNTS
        seen = dict.fromkeys(counts, 0)
        for connection, log_time, raw in reader.messages():
            message = reader.deserialize(raw, connection.msgtype)
            name = relative_name(connection.topic)
            seen[name] += 1
            if hasattr(message, "header") and name != "load/blocks":
                stamp = message.header.stamp
                assert stamp.sec * 1_000_000_000 + stamp.nanosec == log_time
        assert seen == counts
        for connection in reader.connections:
            entry = topic(relative_name(connection.topic))
            assert isinstance(connection.ext, ConnectionExtRosbag2)
            qos = connection.ext.offered_qos_profiles[0]
            assert qos.reliability.name.lower() == entry.reliability
            assert qos.durability.name.lower() == entry.durability


def test_mcap_ros2_support_decodes_every_message_from_the_embedded_schemas(recording: Path) -> None:
    decoder = pytest.importorskip("mcap_ros2.decoder", reason="mcap-ros2-support is not installed")
    counts: dict[str, int] = {}
    with recording.open("rb") as file:
        reader = make_reader(file, decoder_factories=[decoder.DecoderFactory()])
        for schema, channel, _, message in reader.iter_decoded_messages():
            name = relative_name(channel.topic)
            counts[name] = counts.get(name, 0) + 1
            if name == "vibration" and counts[name] == 1:
                assert schema is not None
                assert schema.name == "sensor_msgs/msg/PointCloud2"
                assert [field.name for field in message.fields] == ["sample", "t", "ax", "ay", "az"]
                assert message.width * message.point_step == len(message.data)
            if name == "force" and counts[name] == 1:
                assert message.wrench.force.z == pytest.approx(SyntheticRun().block(0).force[0, 2])
    assert counts == EXPECTED_COUNTS


def test_the_file_explains_itself(recording: Path) -> None:
    with recording.open("rb") as file:
        reader = make_reader(file)
        assert reader.get_header().profile == "ros2"
        attachments = {a.name: a.data for a in reader.iter_attachments()}
        records = {m.name: m.metadata for m in reader.iter_metadata()}
        summary = reader.get_summary()
    assert summary is not None
    assert summary.statistics is not None
    assert yaml.safe_load(attachments["scene.yaml"])["bearing"] == "HS130x230"
    assert json.loads(attachments["run.json"])["faults"] == [{"on": "cup", "row": 0}]
    assert records["beardyn"]["scene"] == "synthetic"
    bag = yaml.safe_load(records["rosbag2"]["serialized_metadata"])
    assert bag["message_count"] == sum(EXPECTED_COUNTS.values()) == summary.statistics.message_count
    assert all(chunk.compression == "zstd" for chunk in summary.chunk_indexes)
    for channel in summary.channels.values():
        assert channel.message_encoding == "cdr"
        assert channel.metadata["topic_type_hash"].startswith("RIHS01_")
        assert summary.schemas[channel.schema_id].encoding == "ros2msg"


def test_type_hashes_are_those_of_ros(recording: Path) -> None:
    messages = pytest.importorskip("sensor_msgs.msg", reason="the ROS wheels are not installed")
    share = next(
        (
            folder / "share" / "sensor_msgs" / "msg" / "PointCloud2.json"
            for folder in map(Path, (sys.prefix, *os.environ.get("AMENT_PREFIX_PATH", "").split(":")))
            if (folder / "share" / "sensor_msgs" / "msg" / "PointCloud2.json").exists()
        ),
        None,
    )
    if share is None or not hasattr(messages, "PointCloud2"):
        pytest.skip("the type descriptions of sensor_msgs are not installed")
    official = {
        entry["type_name"]: entry["hash_string"] for entry in json.loads(share.read_text())["type_hashes"]
    }
    with recording.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    hashes = {
        c.metadata["topic_type_hash"]
        for c in summary.channels.values()
        if summary.schemas[c.schema_id].name == "sensor_msgs/msg/PointCloud2"
    }
    assert hashes == {official["sensor_msgs/msg/PointCloud2"]}


def test_a_recording_comes_back_as_the_arrays_of_its_blocks(recording: Path) -> None:
    run, memory = read_run(recording), MemorySink()
    memory.open(description(BLOCKS * 0.02))
    for block in SyntheticRun(sensor_count=2).blocks(BLOCKS):
        memory.write(block)
    memory.close()
    blocks = memory.blocks
    assert run.complete
    assert run.problem == ""
    assert run.status == "complete"
    np.testing.assert_array_equal(run.force.values, np.concatenate([b.force for b in blocks]))
    np.testing.assert_array_equal(run.force.time_ns, np.concatenate([b.trend_time_ns for b in blocks]))
    np.testing.assert_array_equal(
        run.force_waveform.values,
        np.concatenate([b.force_waveform for b in blocks]).astype(np.float32).astype(float),
    )
    for name, sensor in (("vibration", 0), ("vibration/axlebox_end", 1)):
        expected = np.concatenate([b.acceleration[sensor] for b in blocks]).astype(np.float32)
        np.testing.assert_array_equal(run.sensor_topics[name].values, expected.astype(float))
    np.testing.assert_array_equal(run.vibration.time_ns, np.concatenate([b.waveform_time_ns for b in blocks]))
    np.testing.assert_array_equal(run.shaft.angle, np.concatenate([b.shaft_angle for b in blocks]))
    np.testing.assert_array_equal(
        run.cages.speed[:, 0], np.concatenate([b.cage_speed[::2, 0] for b in blocks])
    )
    pose = np.concatenate([b.body_pose for b in blocks])
    np.testing.assert_allclose(run.bodies.pose, pose, rtol=0, atol=1e-7)  # float32 of metres and quaternions
    np.testing.assert_array_equal(run.load.wrench, run_load(BLOCKS))
    assert run.described().shape == SHAPE
    assert run.described().defects == description().defects
    assert run.truth["fault_frequencies_per_rev"] == SHAPE.fault_frequencies


def run_load(blocks: int) -> np.ndarray:
    load = description(blocks * 0.02).load
    assert load is not None
    return load.wrench


def test_the_same_run_writes_the_same_signals(tmp_path: Path) -> None:
    paths = [write_recording(tmp_path / f"{name}.mcap", 5) for name in "ab"]
    first, second = ([(m.topic, m.cdr) for m in McapScan(path).messages()] for path in paths)
    assert first == second


def test_no_gap_in_a_whole_recording(recording: Path) -> None:
    assert gaps(read_run(recording)) == ()


def test_lost_blocks_and_lost_messages_are_found(tmp_path: Path) -> None:
    path, encoder, run = tmp_path / "lossy.mcap", BlockEncoder(17, ("axlebox_top",)), description()
    writer = McapWriter(path)
    writer.describe(run)
    for block in SyntheticRun().blocks(20):
        for name, stamp, cdr in encoder.encode(block):
            lost_block = block.index in (7, 8) and name == "vibration"
            lost_message = block.index == 12 and name == "force" and stamp == block.trend_time_ns[3]
            if not (lost_block or lost_message):
                writer.add(name, stamp, cdr)
    writer.close()
    found = {(gap.topic, gap.missing): gap.time for gap in gaps(read_run(path))}
    assert set(found) == {("vibration", 1024), ("force", 1)}
    assert found["vibration", 1024] == pytest.approx(0.14, abs=1e-3)
    assert found["force", 1] == pytest.approx(0.2450, abs=1e-6)


def test_a_description_that_comes_only_as_a_message_is_found(tmp_path: Path) -> None:
    path, run = tmp_path / "graph.mcap", description()
    writer = McapWriter(path, namespace="/train/left")
    writer.add("truth", 0, encode_string(run.to_json()))
    for name, stamp, cdr in BlockEncoder(17, run.sensor_names).encode(SyntheticRun().block(0)):
        writer.add(name, stamp, cdr)
    writer.close()
    back = read_run(path)
    assert back.described().shape == run.shape
    assert back.scene_text == run.scene_text
    assert len(back.force) == 8


@pytest.fixture(scope="module")
def short_recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("short") / "short.mcap", 12)


@settings(
    max_examples=examples(60), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(share=st.floats(0.0, 1.0))
def test_a_file_cut_anywhere_yields_a_prefix_or_says_why_not(
    share: float, short_recording: Path, tmp_path: Path
) -> None:
    path, content = tmp_path / "cut.mcap", short_recording.read_bytes()
    whole = [(m.topic, m.log_time, m.cdr) for m in McapScan(short_recording).messages()]
    size = round(share * len(content))
    path.write_bytes(content[:size])
    if size == 0:
        with pytest.raises(InputError, match="is empty"):
            McapScan(path)
        return
    scan = McapScan(path)
    found = [(m.topic, m.log_time, m.cdr) for m in scan.messages()]
    assert found == whole[: len(found)]
    assert scan.complete == (size == len(content))
    assert scan.complete or str(scan.usable_bytes) in scan.problem
    if not found:
        with pytest.raises(InputError, match=r"not closed properly"):
            read_run(path)
        with pytest.raises(InputError, match="nothing can be recovered"):
            recover(path)
        return
    assert read_run(path).complete == scan.complete
    if not scan.complete:
        recovery = recover(path, replace=True)
        assert recovery.message_count == len(found)
        with AnyReader([recovery.target]) as reader:
            assert reader.message_count == len(found)


@settings(
    max_examples=examples(60), deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(share=st.floats(0.0, 0.999), flip=st.integers(1, 255))
def test_a_damaged_byte_never_crashes_the_reader(
    share: float, flip: int, short_recording: Path, tmp_path: Path
) -> None:
    damaged = bytearray(short_recording.read_bytes())
    damaged[int(share * len(damaged))] ^= flip
    path = tmp_path / "damaged.mcap"
    path.write_bytes(damaged)
    with suppress(InputError):
        read_run(path)


def test_a_killed_writer_loses_at_most_a_second(tmp_path: Path) -> None:
    path = tmp_path / "killed.mcap"
    script = (
        "import sys, time\n"
        "from beardyn_core.record.sinks import McapSink\n"
        "from test.record.synthetic_run import SyntheticRun, description\n"
        "sink, run = McapSink(sys.argv[1]), SyntheticRun()\n"
        "sink.open(description())\n"
        "while True:\n"
        "    for block in run.blocks(10**6):\n"
        "        sink.write(block)\n"
        "        print(block.index, time.monotonic(), flush=True)\n"
        "        time.sleep(0.02)\n"
    )
    root = Path(__file__).resolve().parents[2]
    environment = {**os.environ, "PYTHONPATH": str(root)}
    process = subprocess.Popen(
        [sys.executable, "-c", script, str(path)],
        cwd=root,
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    )
    written: list[tuple[int, float]] = []
    try:
        assert process.stdout is not None
        for line in process.stdout:
            index, at = line.split()
            written.append((int(index), float(at)))
            if written[-1][1] - written[0][1] > 2.0:
                break
    finally:
        process.send_signal(signal.SIGKILL)
        killed_at = time.monotonic()
        process.wait()
        run = read_run(path)
    assert not run.complete
    last_block = int(run.vibration.sample[-1]) // 512
    kept_until = dict(written)[last_block]
    assert last_block > 20
    assert killed_at - kept_until < 1.0
    assert run.described().shape == SHAPE
    with pytest.raises(AnyReaderError), AnyReader([path]):
        pass  # an ordinary reader rejects the cut file: that is what recover is for
    recovery = recover(path)
    with AnyReader([recovery.target]) as reader:
        assert reader.message_count == recovery.message_count > 0
    again = report(recovery.target)
    assert again.complete
    assert "cut off" in (again.status or "")
    assert again.gaps == ()


def run_report(arguments: list[str]) -> int:
    return command.main(["report", *arguments])


def test_report_says_what_a_recording_holds(recording: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_report([str(recording)]) == 0
    text = capsys.readouterr().out
    assert "/axlebox/vibration" in text
    assert "closed properly" in text
    assert "no samples missing" in text
    assert "BPFO 7.2938/rev" in text
    assert run_report([str(recording), "--json"]) == 0
    content = json.loads(capsys.readouterr().out)
    assert content["recovered"] is None
    assert {t["name"]: t["count"] for t in content["topics"]}["/axlebox/force"] == 8 * BLOCKS
    assert content["mean_shaft_speed_rad_per_s"] == pytest.approx(120.0)


def test_report_recovers_a_cut_file_and_says_so(
    recording: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "cut.mcap"
    path.write_bytes(recording.read_bytes()[: recording.stat().st_size // 2])
    assert run_report([str(path), "--json"]) == 0
    captured = capsys.readouterr()
    content = json.loads(captured.out)
    assert content["complete"] is False
    assert Path(content["recovered"]).exists()
    assert "was cut off: recovered" in captured.err
    assert 0.2 < content["end_s"] < BLOCKS * 0.02


@pytest.mark.parametrize("content", [b"", b"not a recording at all", b"\x89MCAP0\r\n"])
def test_report_refuses_what_is_no_recording_with_a_sentence(
    content: bytes, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "x.mcap"
    path.write_bytes(content)
    assert run_report([str(path)]) == 2
    assert str(path) in capsys.readouterr().err
    assert run_report([str(tmp_path / "absent.mcap")]) == 2


def test_a_recording_cannot_be_written_where_there_is_no_folder(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot write the recording"):
        McapSink(tmp_path / "no" / "run.mcap").open(description())


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no device that is always full")
def test_a_full_disk_is_a_sentence_and_closing_does_nothing_more() -> None:
    sink = McapSink("/dev/full")
    with pytest.raises(InputError, match=r"cannot write on /dev/full: No space left on device; nothing"):
        sink.open(description())
    with pytest.raises(InputError, match="No space left on device"):
        sink.write(SyntheticRun().block(0))
    sink.close()


def test_what_came_before_the_disk_was_full_is_readable(tmp_path: Path) -> None:
    path = tmp_path / "full.mcap"
    script = (
        "import resource, sys\n"
        "from beardyn_core.base.errors import InputError\n"
        "from beardyn_core.record import mcap_writing\n"
        "from beardyn_core.record.sinks import McapSink\n"
        "from test.record.synthetic_run import SyntheticRun, description\n"
        "mcap_writing.FLUSH_SECONDS = 0.0\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (500_000, 500_000))\n"
        "sink = McapSink(sys.argv[1])\n"
        "sink.open(description())\n"
        "try:\n"
        "    for block in SyntheticRun().blocks(10**6):\n"
        "        sink.write(block)\n"
        "except InputError as error:\n"
        "    print(error)\n"
        "sink.close()\n"
    )
    root = Path(__file__).resolve().parents[2]
    done = subprocess.run(
        [sys.executable, "-c", script, str(path)],
        cwd=root,
        env={**os.environ, "PYTHONPATH": str(root)},
        capture_output=True,
        text=True,
        timeout=60,
        check=True,
    )
    said = re.search(r"File too large; the file holds the run until ([0-9.]+) s, (\d+) messages", done.stdout)
    assert said, done.stdout
    found = report(path)
    assert not found.complete
    assert found.usable_bytes == found.size_bytes <= 500_000
    assert sum(topic.count for topic in found.topics) == int(said[2])
    assert found.end == pytest.approx(float(said[1]), abs=0.03)
    assert found.end > 0.02
    assert recover(path).message_count == int(said[2])


def test_a_load_stream_that_runs_ahead_does_not_stretch_the_recording(tmp_path: Path) -> None:
    path, run = tmp_path / "live.mcap", description()
    assert run.load is not None
    writer = McapWriter(path)
    writer.describe(run)
    for stamp in (0, 5_000_000_000, 10_000_000_000):
        writer.add("load/blocks", stamp, encode_load(run.load.part(0, 2), 0, "frame"))
    for block in SyntheticRun().blocks(20):
        for name, stamp, cdr in BlockEncoder(17, run.sensor_names).encode(block):
            writer.add(name, stamp, cdr)
    writer.close()
    found = report(path)
    assert found.end == pytest.approx(0.4, abs=0.02)
    rates = {relative_name(count.name): count.rate for count in found.topics}
    assert rates["force"] == pytest.approx(400.0, rel=1e-6)
    assert rates["load/blocks"] == pytest.approx(0.2)
    assert found.status == "complete"
    assert found.to_json()["status"] == "complete"
