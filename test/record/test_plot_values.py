"""Results as numbers on values/<name>: their codes, their intervals, and NaN for what is not known."""

from __future__ import annotations

import subprocess
from math import isnan, nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rerun as rr
from rosbags.highlevel import AnyReader

from beardyn_core.cli.main import main as command
from beardyn_core.config import load_bearing
from beardyn_core.follow.estimator import Estimate, Estimates
from beardyn_core.follow.fault_location import PartEstimate
from beardyn_core.follow.follower_values import follower_values
from beardyn_core.follow.following import SPALLED, TAKE_OUT, UNEXPLAINED, WAITING, Followed
from beardyn_core.follow.forecast import Forecast
from beardyn_core.follow.quantities import QUANTITIES
from beardyn_core.monitor.chain import VERDICTS
from beardyn_core.record.checking import MessageChecker
from beardyn_core.record.clouds import cloud_to_arrays
from beardyn_core.record.encoding import BlockEncoder
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import decode, encode_string, header_frame, header_stamp
from beardyn_core.record.plot_samples import decode_samples, encode_samples
from beardyn_core.record.plot_values import (
    BOUNDS,
    CODES,
    FOLLOWER,
    MONITOR,
    VALUES,
    VECTOR,
    Bounded,
    ValueEncoder,
    value_topics,
)
from beardyn_core.record.reading import read_run
from beardyn_core.record.rerun_live import LiveView
from beardyn_core.record.topics import relative_name, topic
from beardyn_core.record.viewer import viewer_executable
from beardyn_core.sensors.labels import HEALTHY
from beardyn_core.study.monitored_recording import FAULT_SYMBOLS, Finding, MonitoredRecording
from test.record.synthetic_run import SyntheticRun, description

NAMES = {source: {each.name for each in VALUES if each.source == source} for source in (MONITOR, FOLLOWER)}


def step_of(condition: str, width: Estimate, remains: Forecast | None) -> Followed:
    """A step of a follower that knows the loads and says something of the width."""
    low, high = 30e3, 60e3
    load = Estimate(QUANTITIES[0], 45e3, ((40e3, 50e3), (low, high)))
    play = Estimate(QUANTITIES[2], nan, (), "not identifiable")
    known = Estimates(PartEstimate(condition, 0.9, ((condition,),) * 2), (load, play, width), 0.4, 3, 19.0)
    return Followed(
        4.5, 100.0, known, known, (), np.zeros((0, 0)), (nan, nan), 1.0, (), remains, SPALLED, ()
    )  # fmt: skip


def test_every_verdict_health_and_condition_has_a_code_and_faults_are_from_ten_on() -> None:
    said = {*VERDICTS, *FAULT_SYMBOLS, HEALTHY, WAITING, SPALLED, TAKE_OUT, UNEXPLAINED}
    assert said == set(CODES)
    assert len(set(CODES.values())) == len(CODES)
    faults = {name for name, code in CODES.items() if code >= 10}
    assert faults == {*FAULT_SYMBOLS, "hot_box", SPALLED, TAKE_OUT}


def test_a_finding_gives_every_value_of_the_monitor_and_what_it_does_not_know_is_nan() -> None:
    finding = Finding(
        "cup", "", 2.0, confidence=0.9, found_frequency=150.0, score=12.0, spall_width=3e-3,
        spall_width_low=2e-3, spall_width_high=5e-3,
    )  # fmt: skip
    values = finding.to_values()
    assert set(values) == NAMES[MONITOR]
    assert values["verdict"].value == CODES["cup"]
    assert values["fault_frequency"].value == 150.0
    assert values["spall_width"] == (3e-3, 2e-3, 5e-3)
    assert isnan(values["rms"].value)
    waiting = Finding("waiting", "", 0.5).to_values()
    assert {name for name, each in waiting.items() if not isnan(each.value)} == {"verdict"}


def test_a_step_gives_every_value_of_the_follower_with_open_ends() -> None:
    width = Estimate(QUANTITIES[4], nan, ((4e-3, 9e-3), (3e-3, 10e-3)), "at least 3 mm", 3e-3)
    remains = Forecast("cup", 0.02, (1e6, 2e6, 3e6), nan, nan, nan, (nan, nan, nan))
    values = follower_values(step_of("cup", width, remains))
    assert set(values) <= NAMES[FOLLOWER]
    assert values["vertical_load"] == (45e3, 30e3, 60e3)
    assert values["condition"].value == CODES["cup"]
    assert values["remaining_mileage"] == (2e6, 1e6, 3e6)
    at_least = values["estimated_spall_width"]
    assert isnan(at_least.value)
    assert at_least.low == 3e-3
    assert isnan(at_least.high)
    assert all(isnan(number) for number in values["end_play"])
    assert isnan(follower_values(step_of("cup", width, None))["remaining_mileage"].value)


def test_quantities_of_an_estimator_have_a_value_in_their_unit() -> None:
    every = tuple(Estimate(each, 1.0, ((0.5, 1.5), (0.0, 2.0))) for each in QUANTITIES)
    step = step_of("cup", every[0], None)
    known = Estimates(step.estimates.part, every, 0.4, 3, 19.0)
    values = follower_values(Followed(**{**vars(step), "estimates": known}))
    assert set(values) == NAMES[FOLLOWER]
    units = {each.unit for each in VALUES if each.source == FOLLOWER and each.level == 90}
    assert {each.unit for each in QUANTITIES} <= units


@pytest.mark.parametrize("source", [MONITOR, FOLLOWER])
def test_each_result_is_a_stamped_vector_on_every_topic_of_its_source(source: str) -> None:
    name = sorted(NAMES[source])[0]
    messages = dict(ValueEncoder(source, "car/axle_1_left").encode(3_000_000_007, {name: Bounded(2.5, 1.0)}))
    assert tuple(messages) == value_topics(source)
    for where, cdr in messages.items():
        assert MessageChecker().problem(topic(where), cdr) == ""
        assert (header_stamp(cdr), header_frame(cdr)) == (3_000_000_007, "car/axle_1_left")
        vector = decode(VECTOR, cdr).vector
        if where == f"values/{name}":
            assert (vector.x, vector.y) == (2.5, 1.0)
            assert isnan(vector.z)
        else:
            assert all(isnan(each) for each in (vector.x, vector.y, vector.z))


def test_a_monitored_recording_has_the_values_of_every_finding(tmp_path: Path) -> None:
    run, path = SyntheticRun(), tmp_path / "run.mcap"
    sink = MonitoredRecording(path, load_bearing("HS130x230"))
    sink.open(description())
    for index in range(120):
        sink.write(run.block(index))
    sink.close()
    assert len(sink.findings) >= 1
    message: Any
    with AnyReader([path]) as reader:
        found: dict[str, list[tuple[int, float]]] = {name: [] for name in value_topics(MONITOR)}
        for connection, stamp, raw in reader.messages():
            name = connection.topic.removeprefix("/axlebox/")
            if name in found:
                message = reader.deserialize(raw, connection.msgtype)
                found[name].append((stamp, message.vector.x))
    for name, messages in found.items():
        expected = [each.to_values()[name.removeprefix("values/")].value for each in sink.findings]
        np.testing.assert_array_equal([value for _, value in messages], expected)
        assert [stamp for stamp, _ in messages] == [round(each.time * 1e9) for each in sink.findings]


@pytest.fixture
def monitored(tmp_path: Path) -> Path:
    """A run with a monitor and the numbers of a follower."""
    path, run = tmp_path / "run.mcap", SyntheticRun()
    writer = McapWriter(path)
    writer.add("truth", 0, encode_string(description().to_json()))
    for name, stamp, cdr in BlockEncoder(17, ("axlebox_top",)).encode(run.block(0)):
        writer.add(name, stamp, cdr)
    for source, names in NAMES.items():
        for k in range(3):
            values = {name: Bounded(k + 1.0, k, nan) for name in names}
            for name, cdr in ValueEncoder(source, "axlebox").encode(1_000_000_000 * k, values):
                writer.add(name, 1_000_000_000 * k, cdr)
    writer.close()
    return path


def test_the_numbers_of_a_recording_are_arrays_and_columns(monitored: Path, tmp_path: Path) -> None:
    run = read_run(monitored)
    assert set(run.plot_values) == NAMES[MONITOR] | NAMES[FOLLOWER]
    width = run.plot_values["spall_width"]
    assert (width.components, width.unit) == (BOUNDS, "m")
    np.testing.assert_array_equal(width.time, [0.0, 1.0, 2.0])
    np.testing.assert_array_equal(width.values, [[1.0, 0.0, nan], [2.0, 1.0, nan], [3.0, 2.0, nan]])
    table = tmp_path / "width.csv"
    assert command(["export", str(monitored), "-o", str(table), "--signals", "value_spall_width"]) == 0
    head, first, *_ = table.read_text(encoding="utf-8").splitlines()
    assert head == "time [s],value [m],low [m],high [m]"
    assert first == "0,1,0,nan"
    (usual,) = run.to_csv(tmp_path / "usual.csv")[:1]
    assert usual.read_text(encoding="utf-8").startswith("time [s],ax")
    assert run.to_xarray()["value_rms"].dims == ("time_value_rms", "bound")


@pytest.mark.parametrize("live", [True, False], ids=["live", "from a recording"])
def test_the_numbers_of_the_monitor_are_drawn(live: bool, monitored: Path, tmp_path: Path) -> None:
    drawn = tmp_path / "drawn.rrd"
    if live:
        stream = rr.RecordingStream("beardyn")
        stream.save(drawn)
        view = LiveView(stream)
        for message in McapScan(monitored).messages():
            view.feed(relative_name(message.topic), message.cdr)
        view.flush()
        stream.flush()
        stream.disconnect()
        assert view.dropped == 0
    else:
        assert command(["view", str(monitored), "--save", str(drawn)]) == 0
    words = [viewer_executable(), "rrd", "print", str(drawn)]
    listing = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    for name in NAMES[MONITOR]:
        assert f"/monitor/values/{name}" in listing
    assert "/monitor/values/end_play" not in listing  # those of the follower have a page of their own


def test_an_array_for_plots_has_every_sample_of_its_block_of_vibration() -> None:
    entry = topic("vibration_samples")
    for name, stamp, cdr in BlockEncoder(17, ("axlebox_top", "axlebox_end")).encode(SyntheticRun().block(3)):
        if not name.startswith("vibration"):
            continue
        samples = encode_samples(cdr)
        assert MessageChecker().problem(entry, samples) == ""
        assert (header_stamp(samples), header_frame(samples)) == (stamp, header_frame(cdr))
        points = cloud_to_arrays(cdr)
        assert len(points) == 512
        np.testing.assert_array_equal(
            decode_samples(samples), np.stack([points[axis] for axis in ("ax", "ay", "az")], axis=1)
        )
        for broken in (samples[:-12], samples + bytes(12), samples[:30]):
            assert MessageChecker().problem(entry, broken)
