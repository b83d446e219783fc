"""A recorded run in the place of the load node: the twin computes the same bits again."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from mcap.reader import make_reader

from beardyn_core.record.messages import decode_string
from beardyn_core.record.topics import relative_name, topic
from test.ros.graph import Graph
from test.ros.nursery import Nursery

SIGNALS = ("force", "force_waveform", "vibration")
PLAYED = ("load/blocks", "load/truth")
DURATION = 0.2
BLOCKS = 10


def recorded_messages(path: Path, *names: str) -> list[tuple[str, bytes]]:
    """Messages of a file as ``ros2 bag play`` sends them: by log time, bytes untouched."""
    topics = [topic(name).path() for name in names]
    with path.open("rb") as file:
        found = make_reader(file).iter_messages(topics=topics, log_time_order=True)
        return [(relative_name(channel.topic), message.data) for _, channel, message in found]


def recorded_signals(path: Path) -> dict[str, list[bytes]]:
    """Signals of the twin in a file."""
    return {name: [cdr for _, cdr in recorded_messages(path, name)] for name in SIGNALS}


def wrap_twice(graph: Graph) -> None:
    """Let a looped load wrap, and end with its lap."""

    def wraps() -> int:
        told = [json.loads(decode_string(cdr)) for cdr in graph.messages["load/truth"]]
        return int(told[-1]["replay"]["passage_count"]) if told else 0

    graph.until(lambda: wraps() >= 3, "two wraps")
    assert graph.set_parameter("load", "loop", False).successful


def original_run(folder: Path, nursery: Nursery | None, fake: bool, **load: object) -> Path:
    """Twin and load node under a recorder; the file."""
    folder.mkdir()
    path = folder / "run.mcap"
    with Graph(folder, nursery) as graph:
        graph.listen("load/truth")
        graph.node_process("recorder", output=str(path))
        graph.fake_twin() if fake else graph.node_process("twin", scene="cup_spall")
        graph.until(
            lambda: any(status.value("connected") == "true" for status in graph.statuses("recorder")),
            "the recorder's connection to every topic of the twin",
        )
        graph.fake_load(**load) if fake else graph.node_process("load", scene="cup_spall", **load)
        if load.get("loop"):
            wrap_twice(graph)
        assert graph.exit_code("twin") == 0
        assert graph.exit_code("recorder") == 0
        assert graph.statuses("recorder")[-1].value("lost_samples") == "0"
    return path


def signals_of_replay(
    folder: Path, nursery: Nursery | None, fake: bool, path: Path
) -> dict[str, list[bytes]]:
    """Signals of the twin fed from the file, all at once: a bag knows no credit."""
    folder.mkdir()
    wanted = {name: len(cdrs) for name, cdrs in recorded_signals(path).items()}
    with Graph(folder, nursery) as graph:
        graph.listen(*SIGNALS)
        graph.fake_twin() if fake else graph.node_process("twin", scene="cup_spall")
        graph.until(
            lambda: all(graph.node.count_publishers(topic(name).path()) for name in SIGNALS),
            "publishers of the signals",
        )
        graph.connected(*PLAYED)
        for name, cdr in recorded_messages(path, *PLAYED):
            assert graph.out.publish(name, cdr)
        assert graph.exit_code("twin") == 0
        graph.until(
            lambda: all(len(graph.messages[name]) >= count for name, count in wanted.items()), f"{wanted}"
        )
        return {name: graph.messages[name] for name in SIGNALS}


def test_recorded_load_topics_of_the_real_twin_give_the_same_bits_again(
    tmp_path: Path, nursery: Nursery | None, compiled_kernels: None
) -> None:
    path = original_run(tmp_path / "original", nursery, fake=False, duration=DURATION)
    signals = recorded_signals(path)
    assert len(signals["vibration"]) == BLOCKS
    assert signals_of_replay(tmp_path / "replay", nursery, False, path) == signals


def test_recording_of_a_looped_load_replays_to_the_same_bits_and_tells_its_passages(
    tmp_path: Path, nursery: Nursery | None
) -> None:
    load = {"duration": 0.5, "position": 0.3, "loop": True, "fade": 0.05, "horizon": 0.2}
    path = original_run(tmp_path / "original", nursery, fake=True, **load)
    assert signals_of_replay(tmp_path / "replay", nursery, True, path) == recorded_signals(path)
    _, last = recorded_messages(path, "load/truth")[-1]
    passages = json.loads(decode_string(last))["replay"]["passages"]
    assert [passage["position_s"] for passage in passages[:3]] == [0.3, 0.0, 0.0]
    assert passages[1]["stamp_s"] == pytest.approx(0.5 - 0.05 - 0.3, abs=0.001)
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    offered = {relative_name(c.topic): c.metadata["offered_qos_profiles"] for c in summary.channels.values()}
    assert "durability: transient_local" in offered["load/truth"]
    assert "history: keep_all" in offered["load/blocks"]
    assert all("reliability: reliable" in offered[name] for name in PLAYED)
