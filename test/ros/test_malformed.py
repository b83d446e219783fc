"""Malformed messages: counted and refused by every node, and no reader of a file dies of them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from beardyn_core.record.clouds import column_dtype, encode_points, points_of
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.mcap_writing import McapWriter
from beardyn_core.record.messages import encode_time
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.record.topics import relative_name
from test.record.hostile import told
from test.recordings import write_recording
from test.ros.fake_twin import fake_history
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected


def wrong_fields() -> bytes:
    """A cloud of somebody else's columns."""
    points = points_of(column_dtype((("x", "f4"), ("intensity", "f4"))), 0, np.arange(5), 0)
    return encode_points(points, 0, "axlebox")


def wrong_sizes() -> bytes:
    """A load whose points are longer than its data."""
    cdr = bytearray(encode_load(fake_history("", "", 1.0).part(0, 20), 0))
    at = cdr.index(b"axlebox") + 8 + 4  # behind the frame and the height: the width
    cdr[at : at + 4] = (10_000).to_bytes(4, "little")
    return bytes(cdr)


MALFORMED = {
    "load/blocks": (wrong_fields(), wrong_sizes(), wrong_sizes()[:60], b"\x00\x01\x00\x00"),
    "vibration": (wrong_fields(), b"\x00\x01\x00\x00" + bytes(40)),
    "shaft": (encode_time(3), b"\x00\x01\x00\x00" + b"\xff" * 30),
    "bodies": (wrong_fields(),),
    "values/confidence": (encode_time(3), b"\x00\x01\x00\x00" + b"\xff" * 60),
    "vibration_samples": (encode_time(3), wrong_fields()),
}
NOT_OF_THE_MONITOR = ("bodies", "values/confidence", "vibration_samples")
NOT_OF_THE_VIEWER = NOT_OF_THE_MONITOR[2:]


def test_every_node_counts_and_refuses_malformed_messages_and_goes_on(graph: Graph) -> None:
    path, drawn = graph.folder / "run.mcap", graph.folder / "live.rrd"
    graph.fake_twin(speed_factor=1.0)
    graph.node_process("recorder", output=str(path))
    graph.node_process("monitor")
    graph.node_process("viewer", target="file", output=str(drawn), exit_when_done=True)
    is_connected(graph, "recorder")
    graph.until(lambda: graph.node.count_subscribers("/axlebox/bodies") > 1, "the viewer")
    graph.connected(*MALFORMED)
    graph.fake_load(duration=4.0)
    graph.until_state("running")
    for name, messages in MALFORMED.items():
        for cdr in messages:
            graph.out.publish(name, cdr)

    def refused(part: str) -> int:
        return max((int(s.value("refused_messages") or 0) for s in graph.statuses(part)), default=0)

    counts = {name: len(messages) for name, messages in MALFORMED.items()}
    wanted = {
        "twin": counts["load/blocks"],
        "recorder": sum(counts.values()),
        "viewer": sum(count for name, count in counts.items() if name not in NOT_OF_THE_VIEWER),
        "monitor": sum(count for name, count in counts.items() if name not in NOT_OF_THE_MONITOR),
    }
    graph.until(
        lambda: all(refused(part) == count for part, count in wanted.items()),
        f"{wanted} refused messages",
    )
    for part in ("recorder", "monitor", "viewer"):
        assert graph.statuses(part)[-1].value("refused: load/blocks") == str(len(MALFORMED["load/blocks"]))
        assert graph.statuses(part)[-1].level == 1
    for part in ("twin", "load", "recorder", "monitor", "viewer"):
        assert graph.exit_code(part) == 0, graph.processes.log(part)
        assert "Traceback" not in graph.processes.log(part)
    found = report(path)
    assert found.complete
    assert found.missing_messages == ()
    assert found.gaps == ()
    assert found.end > 3.9


@pytest.mark.parametrize("name", MALFORMED)
def test_a_file_with_malformed_messages_is_reported_without_them(name: str, tmp_path: Path) -> None:
    """As another recorder writes it, which takes whatever comes."""
    whole = read_run(write_recording(tmp_path / "whole.mcap", 3))
    path = tmp_path / "run.mcap"
    source = McapWriter(path)
    for index, message in enumerate(McapScan(tmp_path / "whole.mcap").messages()):
        source.add(relative_name(message.topic), message.log_time, message.cdr)
        if index == 10:
            for cdr in MALFORMED[name]:
                source.add(name, 0, cdr)
    source.close()
    run = read_run(path)
    assert run.malformed == {name: len(MALFORMED[name])}
    assert np.array_equal(run.vibration.values, whole.vibration.values)
    assert np.array_equal(run.bodies.pose, whole.bodies.pose)
    code, said = told("report", str(path))
    assert code == 0, said
    assert f"malformed messages, left out: {name} {len(MALFORMED[name])}" in said
    assert "Traceback" not in said
