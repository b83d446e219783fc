"""Lists in messages are laid out as their layout says; topics keep their starts, and two clocks are told."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

import beardyn_core as bd
from beardyn_core.record.other_messages import _flat
from test.examples import examples
from test.measured.files import RATE, noise

EPOCH_NS = 1_700_000_000_000_000_000
Messages = list[tuple[int, dict[str, Any]]]  # time of the log [ns] and content


def json_log(path: Path, **topics: Messages) -> Path:
    """Write topics as JSON, their messages in the order of the log."""
    from mcap.writer import Writer

    with path.open("wb") as file:
        writer = Writer(file)
        writer.start()
        schema = writer.register_schema("any", "jsonschema", b"{}")
        channels = {topic: writer.register_channel(f"/{topic}", "json", schema) for topic in topics}
        every = [(log, topic, content) for topic, messages in topics.items() for log, content in messages]
        for log, topic, content in sorted(every, key=lambda each: each[:2]):
            writer.add_message(channels[topic], log, json.dumps(content).encode(), log)
        writer.finish()
    return path


def header(ns: int) -> dict[str, Any]:
    return {"stamp": {"sec": ns // 10**9, "nanosec": ns % 10**9}}


def lists(values: Any, shift_ns: int = 0, log_ns: int = 0, **more: Any) -> Messages:
    """Blocks of 600 samples, stamped at their first one."""
    out = []
    for begin in range(0, len(values), 600):
        ns = round(begin * 1e9 / RATE)
        content = {"header": header(ns + shift_ns), "z": values[begin : begin + 600].tolist(), **more}
        out.append((ns + log_ns, content))
    return out


@given(
    samples=some.integers(4, 40),
    channels=some.integers(2, 3),
    lying=some.booleans(),
    offset=some.integers(0, 5),
)
@settings(max_examples=examples(60), deadline=None)
def test_a_multi_array_becomes_the_channels_of_its_layout(
    samples: int, channels: int, lying: bool, offset: int
) -> None:
    values = np.arange(samples * channels, dtype=float).reshape(samples, channels)
    stored = values.T if lying else values
    dims = (
        [("channels", channels), ("samples", samples)]
        if lying
        else [("samples", samples), ("channels", channels)]
    )
    for labels in (True, False):
        layout = {
            "dim": [{"label": name if labels else "", "size": size, "stride": 0} for name, size in dims],
            "data_offset": offset,
        }
        data = [*[-1.0] * offset, *stored.reshape(-1).tolist()]
        found = _flat({"layout": layout, "data": data})
        for k in range(channels):
            np.testing.assert_array_equal(found[f"data[{k}]"], values[:, k])
        assert "data" not in found
        with pytest.raises(ValueError, match="its layout"):
            _flat({"layout": layout, "data": data[1:]})


def test_a_multi_array_of_a_bag_and_rows_of_rows_are_three_channels(tmp_path: Path) -> None:
    from mcap.writer import Writer
    from rosbags.typesys import Stores, get_typestore

    store, values = get_typestore(Stores.ROS2_HUMBLE), noise(5120, axes=3)
    name, types = "std_msgs/msg/Float32MultiArray", store.types
    dimension = types["std_msgs/msg/MultiArrayDimension"]
    with (tmp_path / "a.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2")
        definition = store.generate_msgdef(name, ros_version=2)[0].encode()
        channel = writer.register_channel("/v", "cdr", writer.register_schema(name, "ros2msg", definition))
        for begin in range(0, len(values), 512):
            part = values[begin : begin + 512].astype(np.float32)
            dims = [dimension("", 512, 1536), dimension("", 3, 3)]
            layout = types["std_msgs/msg/MultiArrayLayout"](dims, 0)
            data = bytes(store.serialize_cdr(types[name](layout, part.reshape(-1)), name))
            writer.add_message(channel, round(begin * 1e9 / RATE), data, round(begin * 1e9 / RATE))
        writer.finish()
    rows = [
        (round(begin * 1e9 / RATE), {"data": values[begin : begin + 512].tolist()})
        for begin in range(0, len(values), 512)
    ]
    json_log(tmp_path / "b.mcap", v=rows)
    for path in (tmp_path / "a.mcap", tmp_path / "b.mcap"):
        run = bd.read_measured(path, unit="g")
        assert run.vibration.rate == pytest.approx(RATE, rel=1e-6)
        np.testing.assert_allclose(run.vibration.values, values * 9.80665, rtol=1e-6)


def test_a_list_without_a_layout_is_said_to_be_taken_as_samples(tmp_path: Path) -> None:
    path = json_log(tmp_path / "a.mcap", v=lists(noise()[:, 0]))
    run = bd.read_measured(path, channels="/v.z", unit="g")
    assert any(
        "each message of /v has 600 numbers in z, and no layout" in e for e in run.measured["understood"]
    )


def speeds(late: float, shift_ns: int = 0, log_ns: int = 0) -> Messages:
    out = []
    for k in range(30):
        ns = round((late + k * 0.05) * 1e9)
        out.append((ns + log_ns, {"header": header(ns + shift_ns), "rpm": 600.0 + 100.0 * (late + k * 0.05)}))
    return out


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_topics_of_one_clock_keep_their_starts(tmp_path: Path) -> None:
    vibration = lists(noise(24_000)[:, 0], EPOCH_NS, EPOCH_NS)
    path = json_log(tmp_path / "a.mcap", v=vibration, s=speeds(0.7, EPOCH_NS, EPOCH_NS))
    run = bd.read_measured(path, channels="/v.z", unit="g", speed_channel="/s.rpm", speed_unit="rpm")
    assert run.shaft.time[0] == pytest.approx(0.7, abs=1e-3)
    np.testing.assert_allclose(run.shaft.speed, (600.0 + 100.0 * run.shaft.time) * np.pi / 30.0, rtol=1e-4)
    assert not any("clocks" in each for each in run.measured["warnings"])


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("shift", [0, EPOCH_NS - 3_000_000_000, EPOCH_NS + 90_000_000_000])
def test_topics_of_two_clocks_are_aligned_by_the_log_and_told(shift: int, tmp_path: Path) -> None:
    vibration = lists(noise(24_000)[:, 0], EPOCH_NS, EPOCH_NS)
    path = json_log(tmp_path / "a.mcap", v=vibration, s=speeds(0.7, shift, EPOCH_NS))
    run = bd.read_measured(path, channels="/v.z", unit="g", speed_channel="/s.rpm", speed_unit="rpm")
    assert run.shaft.time[0] == pytest.approx(0.7, abs=1e-3)
    assert any(
        "are of different clocks" in e and "by the time of the log" in e for e in run.measured["warnings"]
    )


def test_a_cloud_with_its_times_in_seconds_is_read_and_told(tmp_path: Path) -> None:
    from mcap.writer import Writer
    from rosbags.typesys import Stores, get_typestore

    store, values = get_typestore(Stores.ROS2_HUMBLE), noise()[:, 0]
    name, types = "sensor_msgs/msg/PointCloud2", store.types
    field = types["sensor_msgs/msg/PointField"]
    with (tmp_path / "a.mcap").open("wb") as file:
        writer = Writer(file)
        writer.start(profile="ros2")
        definition = store.generate_msgdef(name, ros_version=2)[0].encode()
        channel = writer.register_channel("/v", "cdr", writer.register_schema(name, "ros2msg", definition))
        for begin in range(0, len(values), 600):
            stamp = round(begin * 1e9 / RATE)
            points = np.zeros(600, [("t", "<f4"), ("az", "<f4")])
            points["t"], points["az"] = np.arange(600) / RATE, values[begin : begin + 600]
            time = types["builtin_interfaces/msg/Time"](stamp // 10**9, stamp % 10**9)
            message = types[name](
                types["std_msgs/msg/Header"](time, ""), 1, 600, [field("t", 0, 7, 1), field("az", 4, 7, 1)],
                False, 8, 4800, np.frombuffer(points.tobytes(), np.uint8), True,
            )  # fmt: skip
            writer.add_message(channel, stamp, bytes(store.serialize_cdr(message, name)), stamp)
        writer.finish()
    run = bd.read_measured(tmp_path / "a.mcap", channels="/v.az", unit="g")
    assert run.vibration.rate == pytest.approx(RATE, rel=1e-3)
    assert any("t of its points is taken in seconds" in each for each in run.measured["understood"])
