"""Every curve of the shipped layouts is a number in the messages of a recording."""

from __future__ import annotations

import importlib
import json
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from rosbags.highlevel import AnyReader

from beardyn_core.cli.main import main
from test.record.conftest import BLOCKS
from test.recordings import write_recording

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "docs"))
write_layouts = importlib.import_module("write_layouts")
sys.path.pop(0)


@pytest.fixture(scope="module")
def recording(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_recording(tmp_path_factory.mktemp("layouts") / "run.mcap", BLOCKS)


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
    assert len(curves) >= 10
    assert set(curves) <= known


def test_every_path_of_foxglove_leads_to_a_number_of_the_recording(messages: dict[str, Any]) -> None:
    panels = json.loads((ROOT / "layouts" / "foxglove.json").read_text(encoding="utf-8"))["configById"]
    paths = [path for panel in panels.values() for path in panel.get("paths", ())]
    assert len(paths) >= 10
    for path in paths:
        topic, *members = path["value"].split(".")
        value = messages[topic]
        for member in members:
            name, place = re.fullmatch(r"(\w+)(?:\[(\d+)\])?", member).groups()  # type: ignore[union-attr]
            if place is not None:
                assert value.name[int(place)] == path["label"]
            value = getattr(value, name) if place is None else getattr(value, name)[int(place)]
        assert isinstance(value, (int, float)), path["value"]


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
