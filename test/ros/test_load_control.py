"""Pause, step, seek, loop and pace of the load node over real DDS, and what the twin makes of them."""

from __future__ import annotations

import json
import signal
import time
from typing import Any

import numpy as np
import pytest

from beardyn_core.record.load_stream import decode_load
from beardyn_core.record.messages import decode_string, encode_time, header_stamp
from beardyn_core.scene.load import LoadHistory
from test.ros.fake_twin import fake_history
from test.ros.graph import Graph


def stream(graph: Graph) -> LoadHistory:
    """Everything received so far; its numbers must run on from 0."""
    blocks = [decode_load(cdr) for cdr in graph.messages["load/blocks"]]
    loads = [load for load, _ in blocks if len(load)]
    samples = np.concatenate([np.zeros(0, np.int64), *(numbers for _, numbers in blocks)])
    assert np.array_equal(samples, np.arange(len(samples)))
    return LoadHistory(
        np.concatenate([np.zeros(0, np.int64), *(load.time_ns for load in loads)]),
        np.concatenate([np.zeros((0, 6)), *(load.wrench for load in loads)]),
        np.concatenate([np.zeros(0), *(load.shaft_speed for load in loads)]),
        np.concatenate([np.zeros((0, 3)), *(load.bogie for load in loads)]),
    )


def truth(graph: Graph) -> dict[str, Any]:
    """The latest load/truth."""
    return dict(json.loads(decode_string(graph.messages["load/truth"][-1])))


def load_is(graph: Graph, state: str) -> None:
    graph.until(
        lambda: graph.messages["load/truth"] and truth(graph)["replay"]["state"] == state, f"load {state}"
    )


def pause(graph: Graph, paused: bool) -> None:
    from std_srvs.srv import SetBool

    assert graph.call("load/pause", SetBool, data=paused).success
    load_is(graph, "paused" if paused else "playing")


def test_truth_is_latched_and_says_seed_irregularity_and_defects_of_the_scene(graph: Graph) -> None:
    graph.node_process("load", scene="smooth_run", duration=1.0)
    graph.until(lambda: "waiting for a twin" in graph.processes.log("load"), "the load node")
    graph.until(lambda: graph.statuses("load"), "its diagnostics")
    graph.listen("load/truth")
    graph.until(lambda: graph.messages["load/truth"], "the truth, though we came later")
    content = truth(graph)
    assert content["scene"] == "smooth_run"
    assert isinstance(content["seed"], int)
    assert content["irregularity"]["kind"]
    assert content["replay"]["state"] == "playing"
    first = {"sample": 0, "stamp_s": 0.0, "position_s": 0.0, "fade_s": 0.0}
    assert content["replay"]["passages"] == [first]
    assert graph.statuses("load")[-1].value("state") == "playing"


def test_seek_and_loop_move_the_position_and_the_truth_says_where(graph: Graph) -> None:
    graph.listen("load/blocks", "load/truth")
    graph.out.publisher("load/consumed")
    graph.fake_load(duration=2.0, horizon=0.5, fade=0.1)
    graph.until(lambda: len(stream(graph).time_ns) == 1000, "load up to the horizon")
    graph.connected("load/consumed")
    assert "outside the scenario" in graph.set_parameter("load", "position", 2.5).reason
    assert graph.set_parameter("load", "position", 1.7).successful
    assert graph.set_parameter("load", "loop", True).successful
    graph.out.publish("load/consumed", encode_time(1_500_000_000))
    graph.until(lambda: len(stream(graph).time_ns) == 4000, "load up to the next horizon")
    passages = truth(graph)["replay"]["passages"]
    assert [p["position_s"] for p in passages] == [0.0, 1.7, 0.0]
    assert [p["fade_s"] for p in passages] == [0.0, 0.1, 0.1]
    # one block was ready before the seek; the wrap begins a fade before the end, 4001 - 200 samples in
    assert [p["sample"] for p in passages] == [0, 1200, 1601]
    history, load = fake_history("", "", 2.0), stream(graph)
    assert np.all(np.diff(load.time_ns) == 500_000)
    assert np.array_equal(load.wrench[:1200], history.wrench[:1200])
    assert np.array_equal(load.wrench[1400:1601], history.wrench[3600:3801])
    assert np.array_equal(load.wrench[1801:4000], history.wrench[200:2399])
    assert graph.set_parameter("load", "loop", False).successful
    graph.out.publish("load/consumed", encode_time(2_900_000_000))
    assert graph.exit_code("load") == 0
    assert len(stream(graph).time_ns) == 1601 + 4001
    assert truth(graph)["replay"]["state"] == "ended"


def test_twin_in_lockstep_waits_as_long_as_the_load_is_paused(graph: Graph) -> None:
    from std_srvs.srv import Trigger

    graph.listen("load/blocks", "load/truth", "vibration")
    graph.fake_twin(load_timeout=0.5)
    graph.fake_load(duration=60.0, horizon=0.2)
    graph.until(lambda: len(graph.messages["vibration"]) > 5, "blocks")
    assert not graph.call("load/step", Trigger).success
    pause(graph, True)
    graph.until_state("paused")
    sent = len(stream(graph).time_ns)
    begin = time.monotonic()
    graph.until(lambda: time.monotonic() - begin > 1.5, "three times the load timeout")
    assert graph.statuses("twin")[-1].value("state") == "paused"
    assert len(stream(graph).time_ns) == sent
    assert graph.call("load/step", Trigger).success
    graph.until(lambda: len(stream(graph).time_ns) == sent + 200, "one block of load")
    blocks = (sent + 200 - 1) // 40
    graph.until(lambda: len(graph.messages["vibration"]) == blocks, "the blocks that it covers")
    graph.until_state("paused")
    assert float(graph.statuses("twin")[-1].value("waited_for_load")) < 1.5
    pause(graph, False)
    graph.until(lambda: len(graph.messages["vibration"]) > blocks + 20, "the run going on")


def test_twin_in_live_mode_stands_still_as_long_as_the_load_is_paused(graph: Graph) -> None:
    graph.listen("load/truth", "load/wrench", "vibration")
    graph.fake_twin(mode="live", max_age=0.4)
    graph.fake_load(mode="live", duration=60.0)
    graph.until(lambda: len(graph.messages["vibration"]) > 5, "blocks under live load")
    pause(graph, True)
    stands = graph.until_state("paused").value("blocks")
    begin, stamp = time.monotonic(), header_stamp(graph.messages["load/wrench"][-1])
    graph.until(lambda: time.monotonic() - begin > 1.2, "three times the age limit")
    assert graph.statuses("twin")[-1].value("blocks") == stands
    count = len(graph.messages["load/wrench"])
    pause(graph, False)
    graph.until(lambda: len(graph.messages["vibration"]) > int(stands) + 20, "the run going on")
    assert header_stamp(graph.messages["load/wrench"][count]) - stamp < 500_000_000
    assert graph.statuses("twin")[-1].value("state") == "running"


def test_pace_of_the_live_load_changes_while_it_runs(graph: Graph) -> None:
    def advance(seconds: float) -> float:
        """Simulated over wall time of the load's stamps."""
        wall, first = time.monotonic(), header_stamp(graph.messages["load/wrench"][-1])
        graph.until(lambda: time.monotonic() - wall > seconds, "a while")
        last = header_stamp(graph.messages["load/wrench"][-1])
        return (last - first) * 1e-9 / (time.monotonic() - wall)

    graph.listen("load/wrench")
    graph.fake_twin(mode="live")
    graph.fake_load(mode="live", duration=60.0, speed_factor=0.5)
    graph.until(lambda: len(graph.messages["load/wrench"]) > 5, "live load")
    assert advance(0.8) == pytest.approx(0.5, abs=0.15)
    assert graph.set_parameter("load", "speed_factor", 4.0).successful
    graph.until(lambda: advance(0.2) > 2.0, "the faster pace")
    assert advance(0.8) == pytest.approx(4.0, abs=1.0)
    assert not graph.set_parameter("load", "speed_factor", 1000.0).successful


def test_reset_of_the_twin_starts_a_looped_load_at_sample_0_again(graph: Graph) -> None:
    from std_srvs.srv import Trigger

    graph.listen("truth", "load/truth", "force_waveform")
    graph.fake_twin(speed_factor=4.0)
    graph.fake_load(duration=0.6, fade=0.1, loop=True, exit_when_done=False)
    graph.until(lambda: graph.messages["load/truth"], "truth of the load")
    graph.until(lambda: truth(graph)["replay"]["passage_count"] >= 3, "two wraps")
    first = graph.until(lambda: graph.messages["force_waveform"], "the first block")[0]
    graph.messages["force_waveform"].clear()
    assert graph.call("reset", Trigger).success
    graph.until(lambda: len(graph.messages["truth"]) == 2, "the truth of the new run")
    run_id = json.loads(decode_string(graph.messages["truth"][1]))["run_id"]
    graph.until(
        lambda: truth(graph)["run_id"] == run_id and truth(graph)["replay"]["passage_count"] >= 3,
        "two wraps of the new run",
    )
    graph.until(lambda: first in graph.messages["force_waveform"], "the same first block again")


@pytest.mark.slow
def test_a_paused_load_node_that_dies_is_a_lost_load_again(graph: Graph) -> None:
    graph.listen("load/truth", "vibration")
    graph.fake_twin(load_timeout=1.0)
    graph.fake_load(duration=60.0, horizon=0.2)
    graph.until(lambda: len(graph.messages["vibration"]) > 5, "blocks")
    pause(graph, True)
    graph.until_state("paused")
    graph.processes.signal("load", signal.SIGKILL)
    assert graph.exit_code("twin") == 4
    assert "no usable load for 1 s" in graph.statuses("twin")[-1].message
