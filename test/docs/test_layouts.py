"""Every curve of the shipped layouts is a number in the messages of a recording."""

from __future__ import annotations

import importlib
import json
import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from rosbags.highlevel import AnyReader

from beardyn_core.cli.main import main
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.plot_samples import encode_samples
from beardyn_core.record.plot_values import FOLLOWER, MONITOR, VALUES, Bounded, ValueEncoder
from beardyn_core.record.topics import FRAME, relative_name
from test.record.conftest import BLOCKS
from test.recordings import write_recording

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))
write_layouts = importlib.import_module("write_layouts")
sys.path.pop(0)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with what monitor and follower say, and with every sample of its vibration for plots."""
    folder = tmp_path_factory.mktemp("layouts")
    twin = write_recording(folder / "twin.mcap", BLOCKS)
    writer = McapWriter(folder / "run.mcap")
    for message in McapScan(twin).messages():
        name = relative_name(message.topic)
        writer.add(name, message.log_time, message.cdr)
        if name == "vibration":
            writer.add("vibration_samples", message.log_time, encode_samples(message.cdr))
    for source in (MONITOR, FOLLOWER):
        values = {each.name: Bounded(2.0, 1.0, 3.0) for each in VALUES}
        for name, cdr in ValueEncoder(source, FRAME).encode(20_000_000, values):
            writer.add(name, 20_000_000, cdr)
    writer.close()
    return folder / "run.mcap"


@pytest.fixture(scope="module")
def messages(recording: Path) -> dict[str, Any]:
    """The first message of every topic."""
    found: dict[str, Any] = {}
    with AnyReader([recording]) as reader:
        for connection, _, raw in reader.messages():
            if connection.topic not in found:
                found[connection.topic] = reader.deserialize(raw, connection.msgtype)
    return found


def numbers(path: str, value: Any) -> Iterator[str]:
    """Names that PlotJuggler gives to the numbers of a message; those of a joint state by joint."""
    if type(value).__name__.endswith("JointState"):
        for place, joint in enumerate(value.name):
            for member in ("position", "velocity", "effort"):
                if len(getattr(value, member)) > place:
                    yield f"{path}/{joint}/{member}"
    elif isinstance(value, (int, float)):
        yield path
    elif hasattr(value, "__dataclass_fields__"):
        for member in value.__dataclass_fields__:
            if not member.startswith("__"):
                yield from numbers(f"{path}/{member}", getattr(value, member))


def test_the_files_are_those_of_the_writer() -> None:
    assert write_layouts.main(["--check"]) == 0


def test_every_curve_of_plotjuggler_is_in_the_recording(messages: dict[str, Any]) -> None:
    layout = ElementTree.parse(ROOT / "layouts" / "plotjuggler.xml")
    curves = [str(curve.get("name")) for curve in layout.iter("curve")]
    known = {name for topic, message in messages.items() for name in numbers(topic, message)}
    assert len(curves) >= 20
    assert set(curves) <= known


STEP = re.compile(r"(\w+)(?:\[(\d+|:)\])?")
"""A part of a message path: a member, one element of it, or all of them."""


def along(path: str, messages: Mapping[str, Any]) -> list[Any]:
    """Where a message path of Foxglove leads: members after dots, elements in brackets, all with a colon."""
    topic, *steps = path.split(".")
    found = [messages[topic]]
    for step in steps:
        name, place = STEP.fullmatch(step).groups()  # type: ignore[union-attr]
        found = [getattr(each, name) for each in found]
        if place == ":":
            found = [element for each in found for element in each]
        elif place is not None:
            found = [each[int(place)] for each in found]
    return found


def plots_of_foxglove() -> list[dict[str, Any]]:
    panels = json.loads((ROOT / "layouts" / "foxglove.json").read_text(encoding="utf-8"))["configById"]
    return [panel for panel in panels.values() if "paths" in panel]


def test_every_path_of_foxglove_leads_to_numbers_of_the_recording(messages: dict[str, Any]) -> None:
    plots = plots_of_foxglove()
    assert sum(len(plot["paths"]) for plot in plots) >= 20
    for plot in plots:
        for path in plot["paths"]:
            found = along(path["value"], messages)
            assert all(isinstance(each, (int, float)) for each in found), path["value"]
            # over the time a message is one point; over the index all elements of the latest one are points
            assert len(found) == 1 if plot["xAxisVal"] == "timestamp" else plot["xAxisVal"] == "index"
            topic, *_, last = path["value"].split(".")
            if place := re.fullmatch(r"\w+\[(\d+)\]", last):
                assert messages[topic].name[int(place[1])] == path["label"]


def test_foxglove_draws_every_sample_of_a_block_of_vibration(messages: dict[str, Any]) -> None:
    (plot,) = [each for each in plots_of_foxglove() if each["xAxisVal"] == "index"]
    block = messages["/axlebox/vibration"]
    points = np.frombuffer(
        block.data, [("", "<u4"), ("", "<u4"), ("ax", "<f4"), ("ay", "<f4"), ("az", "<f4")]
    )
    assert len(points) == block.width == 512
    for path in plot["paths"]:
        np.testing.assert_array_equal(along(path["value"], messages), points[path["label"]])


def as_lists(value: Any) -> Any:
    """A message as mappings and lists."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, list):
        return [as_lists(each) for each in value]
    if hasattr(value, "__dataclass_fields__"):
        return {
            name: as_lists(getattr(value, name)) for name in value.__dataclass_fields__ if name[:2] != "__"
        }
    return value


def test_another_reader_of_message_paths_finds_the_same(messages: dict[str, Any]) -> None:
    ros_parser = pytest.importorskip(
        "ros_parser.message_path", reason="a reader of message paths is missing (pip install ros-parser)"
    )
    for plot in plots_of_foxglove():
        for each in plot["paths"]:
            path = ros_parser.parse_message_path(each["value"])
            found = path.apply(as_lists(messages[path.topic]))
            assert (found if isinstance(found, list) else [found]) == along(each["value"], messages)


def test_every_path_of_rqt_plot_is_one_number_of_the_recording(messages: dict[str, Any]) -> None:
    """`/topic/a/b:c` is two curves; a topic is one whose name and a slash begin the path, so only one may."""
    page = (ROOT / "docs" / "viewers.md").read_text(encoding="utf-8")
    for command in (write_layouts.RQT_PLOT, write_layouts.RQT_INTERVAL):
        assert command in page
        assert command.startswith("ros2 run rqt_plot rqt_plot ")
        for word in command.split()[4:]:
            first, *others = word.split(":")
            for path in (first, *(f"{first.rpartition('/')[0]}/{each}" for each in others)):
                (topic,) = [name for name in messages if path.startswith(f"{name}/")]
                value = messages[topic]
                for member in path.removeprefix(f"{topic}/").split("/"):
                    value = getattr(value, member)
                assert isinstance(float(value), float)


def test_the_other_panels_of_foxglove_have_their_topics(messages: dict[str, Any]) -> None:
    whole = json.loads((ROOT / "layouts" / "foxglove.json").read_text(encoding="utf-8"))
    panels = whole["configById"]
    assert panels["DiagnosticSummary!beardyn"]["topicToRender"] in messages
    topic, member = panels["RawMessages!beardyn"]["topicPath"].split(".")
    json.loads(getattr(messages[topic], member))
    placed = set(re.findall(r"\w+!\w+", json.dumps(whole["layout"])))
    assert placed == set(panels)


def test_every_sample_of_the_waveform_is_in_the_table_that_plotjuggler_opens(
    recording: Path, messages: dict[str, Any], tmp_path: Path
) -> None:
    table = tmp_path / "vibration.csv"
    assert main(["export", str(recording), "-o", str(table), "--signals", "vibration"]) == 0
    head, *rows = table.read_text(encoding="utf-8").splitlines()
    assert head.split(",")[0].startswith("time")
    assert len(rows) == BLOCKS * messages["/axlebox/vibration"].width
