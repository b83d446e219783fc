"""The load node with the shipped scenes and with a CSV."""

from __future__ import annotations

import time
from functools import partial

import numpy as np
import pytest

from beardyn_core.record.load_stream import decode_load
from beardyn_core.record.messages import encode_time
from beardyn_ros import awaited
from beardyn_ros.load_node import OTHERS_TIMEOUT_S
from test.ros.graph import Graph


def has_received(graph: Graph, count: int) -> bool:
    return len(received(graph)) == count


def received(graph: Graph) -> np.ndarray:
    blocks = [decode_load(cdr)[1] for cdr in graph.messages["load/blocks"]]
    return np.concatenate([np.zeros(0, np.int64), *blocks])


def test_load_stays_within_the_horizon_of_the_credit_and_ends_with_an_empty_block(graph: Graph) -> None:
    graph.listen("load/blocks")
    graph.out.publisher("load/consumed")
    graph.node_process("load", scene="static_5kN", duration=2.0, horizon=0.5)
    graph.until(lambda: len(received(graph)) == 1000, "half a second of load")
    graph.connected("load/consumed")
    for credit in (0.25, 0.5, 1.0):
        graph.out.publish("load/consumed", encode_time(round(credit * 1e9)))
        wanted = round((credit + 0.5) * 2000) // 200 * 200
        graph.until(partial(has_received, graph, wanted), f"load up to {credit} + 0.5 s")
    graph.out.publish("load/consumed", encode_time(2_000_000_000))
    assert graph.exit_code("load") == 0
    assert np.array_equal(received(graph), np.arange(4001))
    assert len(decode_load(graph.messages["load/blocks"][-1])[0]) == 0


def test_load_replays_a_csv_of_time_speed_and_force(graph: Graph) -> None:
    file = graph.folder / "measured.csv"
    rows = [f"{0.01 * k:.2f},{1000 + k},{0},{0},{60000 + 100 * k}" for k in range(51)]
    file.write_text("\n".join(["time_s,speed_rpm,fx_N,fy_N,fz_N", *rows]) + "\n")
    graph.listen("load/blocks")
    graph.out.publisher("load/consumed")
    graph.node_process("load", scene="static_5kN", csv=str(file))
    assert graph.exit_code("load") == 0
    load = [decode_load(cdr)[0] for cdr in graph.messages["load/blocks"]]
    force = np.concatenate([part.wrench[:, 2] for part in load])
    speed = np.concatenate([part.shaft_speed for part in load])
    assert len(force) == 1001
    assert np.allclose(force, np.linspace(60e3, 65e3, 1001))
    assert np.allclose(speed, np.linspace(1000, 1050, 1001) * np.pi / 30)


def test_load_without_a_twin_gives_up_with_a_sentence(graph: Graph) -> None:
    graph.fake_load(start_timeout=0.5)
    assert graph.exit_code("load") == 4
    assert "no twin in /axlebox for start_timeout = 0.5 s" in graph.processes.log("load")


def test_bad_csv_and_unknown_scene_are_told_without_traceback(graph: Graph) -> None:
    file = graph.folder / "bad.csv"
    file.write_text("time_s,speed_rpm,fx_N,fy_N\n0,1000,0,0\n")
    graph.start("bad_csv", "beardyn_ros", "load", scene="static_5kN", csv=str(file))
    graph.start("bad_scene", "beardyn_ros", "load", scene="no_such_scene")
    for name, word in (("bad_csv", "fz_N"), ("bad_scene", "no_such_scene")):
        assert graph.exit_code(name) == 2
        log = graph.processes.log(name)
        assert word in log
        assert "Traceback" not in log


def test_replay_waits_for_a_listener_that_is_named_and_starts_late(graph: Graph) -> None:
    graph.listen("load/blocks")
    graph.out.publisher("load/consumed")
    graph.node_process("load", scene="static_5kN", duration=0.5, wait_for="monitor")
    graph.connected("load/consumed")
    longer_than_those_seen = time.monotonic() + OTHERS_TIMEOUT_S + 1.0
    graph.until(lambda: time.monotonic() > longer_than_those_seen, "the wait for those that are seen")
    assert not len(received(graph))
    graph.node_process("monitor")
    graph.until(partial(has_received, graph, 1001), "the replay")


def test_replay_begins_without_a_listener_that_never_comes_and_says_so(
    graph: Graph, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(awaited, "LONGEST_S", 0.2)
    wait = awaited.Awaited(graph.node, "monitor follower")
    begin = time.monotonic()
    graph.until(wait.are_there, "the end of the wait")
    assert time.monotonic() - begin > 0.2
    assert awaited.Awaited(graph.node, "").are_there()
