"""Scenes of stray publishers and of files that nobody would write, next to a run of all nodes."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.record.messages import encode_string
from beardyn_core.record.reporting import report
from beardyn_ros.live_load import encode_wrench
from test.record.hostile import told
from test.record.test_hostile_files import bomb
from test.ros import test_nothing_lost as lost
from test.ros.graph import Graph

BAD_INPUT = 2
SOON_S = 30.0
DEEP = "[" * 5000
DIGITS = 6000
STRANGE_NAMES = ("../../elsewhere/x", "/elsewhere", "a/b")


def _refused(graph: Graph, part: str) -> int:
    return max((int(each.value("refused_messages") or 0) for each in graph.statuses(part)), default=0)


def _run_with(graph: Graph, parts: tuple[str, ...], send: Callable[[], None], duration: float = 4.0) -> Path:
    """Record a run in which something is sent; every node ends with 0, nothing is missing."""
    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=1.0)
    graph.node_process("recorder", output=str(path))
    for part in parts:
        more: dict[str, object] = {}
        if part == "viewer":
            more = {"target": "file", "output": str(graph.folder / "live.rrd"), "exit_when_done": True}
        graph.node_process(part, **more)
    lost.is_connected(graph, "recorder")
    graph.fake_load(duration=duration)
    graph.until_state("running")
    send()
    for part in ("twin", "load", "recorder", *parts):
        code = graph.exit_code(part)
        assert code == 0, f"{part} ends with {code}"
        assert "Traceback" not in graph.processes.log(part), f"{part} ends with a traceback"
    missing = report(path).missing_messages
    assert missing == (), f"missing: {missing}"
    return path


def stray_stamp(graph: Graph) -> str:
    """Send one message with stamp 0 on `force` in the middle of a run."""

    def send() -> None:
        graph.connected("force")
        graph.until(
            lambda: float(graph.statuses("twin")[-1].value("simulated_time") or 0.0) > 0.5, "half a second"
        )
        graph.out.publish("force", encode_wrench(np.full(6, 7.0), 0))

    path = _run_with(graph, (), send)
    count = lost.recorded_counts(path)["force"]
    assert _refused(graph, "recorder") == 1, "the stray was not counted"
    return f"1 refused, {count} messages of force recorded, none missing"


def hostile_texts(graph: Graph) -> str:
    """Send 5 kB of brackets, and 'hello', on every topic of texts to all nodes that read them."""
    names = ("truth", "load/truth", "follower/estimate", "follower/residual")
    texts = (DEEP, '{"a":' * 5000, "hello")

    def send() -> None:
        graph.connected(*names)
        for name in names:
            for text in texts:
                graph.out.publish(name, encode_string(text))
        everything = len(names) * len(texts)
        graph.until(lambda: _refused(graph, "recorder") >= everything, f"{everything} refused texts")

    _run_with(graph, ("monitor", "viewer"), send)
    return f"refused: recorder {_refused(graph, 'recorder')}, viewer {_refused(graph, 'viewer')}; codes 0"


def strange_truth(graph: Graph) -> str:
    """Let strangers publish truths, before and in a run, that name folders and other runs."""
    inside = graph.folder / "inside"
    inside.mkdir()

    def strange(number: int) -> bytes:
        scene = STRANGE_NAMES[number % len(STRANGE_NAMES)]
        return encode_string(json.dumps({"scene": scene, "run_id": f"0badcafe-{number}"}))

    with pytest.MonkeyPatch.context() as place:
        place.chdir(inside)
        graph.node_process("recorder")
    graph.connected("truth")
    for number in range(3):
        graph.out.publish("truth", strange(number))
    graph.fake_twin(speed_factor=1.0)
    lost.is_connected(graph, "recorder")
    graph.fake_load(duration=4.0)
    graph.until_state("running")
    for number in range(3, 9):
        graph.out.publish("truth", strange(number))
    for part in ("twin", "load", "recorder"):
        assert graph.exit_code(part) == 0, graph.processes.log(part)
    files = sorted(graph.folder.rglob("*.mcap"))
    assert {path.parent for path in files} == {inside}, f"files: {files}"
    (own,) = (path for path in files if path.name.startswith("synthetic_"))
    found = report(own)
    assert found.missing_messages == (), f"missing: {found.missing_messages}"
    assert lost.recorded_counts(own)["vibration"] == 200, "the run is split"
    return (
        f"9 foreign truths: all files where the recorder was started, the run whole in one of them "
        f"({found.end:.2f} of 4.00 s), codes 0"
    )


def _soon(*words: str) -> tuple[int, str]:
    begin = time.monotonic()
    code, said = told(*words)
    assert time.monotonic() - begin < SOON_S, f"{words[0]} took {time.monotonic() - begin:.0f} s"
    assert "Traceback" not in said, said
    return code, said


def devices(graph: Graph) -> str:
    """Give a device and a FIFO as CSV to commands and to the load node."""
    fifo, device = graph.folder / "fifo.csv", graph.folder / "zero.csv"
    os.mkfifo(fifo)
    device.symlink_to("/dev/zero")
    for path in (fifo, device):
        target = graph.folder / "out.mcap"
        code, said = _soon("import", str(path), "-o", str(target))
        assert code == BAD_INPUT, said
        assert "a pipe or a device" in said, said
        assert not target.exists()
        graph.node_process("load", csv=str(path))
        assert graph.exit_code("load") == BAD_INPUT, graph.processes.log("load")
        assert str(path) in graph.processes.log("load")
        graph.dismiss("load")
    return "import and load end with 2 and name the file"


def long_integer(folder: Path) -> str:
    """Simulate a scene with an integer of 6000 digits."""
    path = folder / "scene.yaml"
    path.write_text(f"name: x\nseed: {'9' * DIGITS}\n", encoding="utf-8")
    code, said = _soon("simulate", str(path))
    assert code == BAD_INPUT, said
    assert str(path) in said, said
    return "simulate ends with 2 and names the file"


def huge_chunk(folder: Path) -> str:
    """Report a small file with a chunk of 1 GB."""
    path = bomb(folder / "bomb.mcap", [1 << 30])
    begin = time.monotonic()
    code, said = _soon("report", str(path))
    assert code == BAD_INPUT, said
    return f"{path.stat().st_size / 1e3:.0f} kB: report ends with 2 after {time.monotonic() - begin:.1f} s"


def late_recorder(graph: Graph) -> str:
    """Start a recorder in the middle of a run."""
    lost.test_a_recorder_that_joins_a_run_says_from_when_and_ends_with_0(graph)
    begin = graph.statuses("recorder")[-1].value("recorded_from")
    return f"recorded from t = {float(begin):.2f} s, nothing missing after that, exit 0"
