"""The twin node as a process over real DDS, around a fake twin."""

from __future__ import annotations

import re
import signal
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.record.clouds import cloud_to_arrays
from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.messages import decode_string, header_stamp
from beardyn_core.record.plot_values import BY_TOPIC
from beardyn_core.record.topics import TOPICS, topic
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.diagnostics import WARN
from test.ros.fake_twin import fake_history
from test.ros.graph import Graph
from test.ros.nursery import Nursery

SIGNALS = ("force", "force_waveform", "vibration")


def signal_bytes(folder: Path, speed_factor: float, nursery: Nursery | None) -> dict[str, list[bytes]]:
    with Graph(folder, nursery) as graph:
        graph.listen(*SIGNALS)
        graph.fake_twin(speed_factor=speed_factor)
        graph.until(
            lambda: all(graph.node.count_publishers(topic(name).path()) for name in SIGNALS),
            "publishers of the signals",
        )
        graph.fake_load(duration=0.4)
        assert graph.exit_code("twin") == 0
        assert graph.exit_code("load") == 0
        graph.until(lambda: len(graph.messages["vibration"]) == 20, "20 blocks")
        graph.until(lambda: len(graph.messages["force"]) == 160, "160 forces")
        return {name: graph.messages[name] for name in SIGNALS}


@pytest.mark.parametrize("paced", [0.5, pytest.param(1.0, marks=pytest.mark.slow)])
def test_lockstep_signals_are_bit_identical_at_any_speed_factor(
    tmp_path: Path, paced: float, nursery: Nursery | None
) -> None:
    runs = []
    for factor in (paced, 0.0):
        folder = tmp_path / str(factor)
        folder.mkdir()
        runs.append(signal_bytes(folder, factor, nursery))
    assert runs[0] == runs[1]
    samples = np.concatenate([cloud_to_arrays(cdr)["sample"] for cdr in runs[0]["vibration"]])
    assert np.array_equal(samples, np.arange(20 * 512))


def test_lifecycle_by_hand_configure_activate_deactivate_shutdown(graph: Graph) -> None:
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState, GetState

    def change(transition: int) -> bool:
        wanted = Transition(id=transition)
        return bool(graph.call("twin/change_state", ChangeState, transition=wanted).success)

    def state() -> str:
        return str(graph.call("twin/get_state", GetState).current_state.label)

    graph.fake_twin(autostart=False, speed_factor=1.0)
    assert state() == "unconfigured"
    assert change(Transition.TRANSITION_CONFIGURE)
    assert state() == "inactive"
    graph.until_state("ready")
    assert change(Transition.TRANSITION_ACTIVATE)
    assert state() == "active"
    graph.until_state("waiting for load")
    graph.fake_load(duration=60.0)
    graph.until_state("running")
    assert change(Transition.TRANSITION_DEACTIVATE)
    graph.until_state("paused")
    blocks = graph.until_state("paused").value("blocks")
    assert change(Transition.TRANSITION_ACTIVATE)
    graph.until_state("running")
    graph.until(lambda: graph.statuses("twin")[-1].value("blocks") != blocks, "blocks after the pause")
    assert change(Transition.TRANSITION_ACTIVE_SHUTDOWN)
    assert graph.exit_code("twin") == 0


def test_bad_load_is_refused_and_counted_while_good_load_goes_on(graph: Graph) -> None:
    graph.listen("vibration")
    graph.fake_twin()
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")

    def send(part: LoadHistory, first: int) -> None:
        assert graph.out.publish("load/blocks", encode_load(part, first))

    def spoiled(first: int, last: int, value: float) -> LoadHistory:
        part = history.part(first, last)
        wrench = part.wrench.copy()
        wrench[3, 2] = value
        return LoadHistory(part.time_ns, wrench, part.shaft_speed, part.bogie)

    def backwards(first: int, last: int) -> LoadHistory:
        part = history.part(first, last)
        return LoadHistory(part.time_ns[::-1].copy(), part.wrench, part.shaft_speed, part.bogie)

    send(history.part(0, 200), 0)
    graph.until(lambda: len(graph.messages["vibration"]) == 4, "the blocks that 200 samples cover")
    send(spoiled(200, 400, float("nan")), 200)
    send(spoiled(200, 400, float("inf")), 200)
    send(spoiled(200, 400, 2.0e7), 200)
    send(history.part(100, 200), 100)
    send(history.part(400, 600), 400)
    send(backwards(200, 400), 200)
    wrong = encode_load(history.part(200, 400), 200).replace(b"shaft_speed\0", b"shaft_spool\0")
    graph.out.publish("load/blocks", wrong)
    send(history.part(200, 1001), 200)
    graph.until(lambda: len(graph.messages["vibration"]) == 25, "every block of half a second")
    send(history.part(0, 0), 1001)
    assert graph.exit_code("twin") == 0
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "finished"
    counts = {key: value for key, value in last.values if key.startswith("refused: ")}
    assert counts == {
        "refused: not finite": "2",
        "refused: absurd": "1",
        "refused: out of order": "2",
        "refused: gap": "1",
        "refused: wrong fields": "1",
    }
    assert last.value("refused_messages") == "7"
    assert last.level == 1
    log = graph.processes.log("twin")
    assert "fz is nan in 1 of 200 samples" in log
    assert "Traceback" not in log


def test_a_hole_left_by_a_nan_block_ends_the_run_with_the_reason(graph: Graph) -> None:
    graph.fake_twin()
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    graph.out.publish("load/blocks", encode_load(history.part(0, 200), 0))
    part = history.part(200, 400)
    bad = LoadHistory(part.time_ns, part.wrench * np.nan, part.shaft_speed, part.bogie)
    graph.out.publish("load/blocks", encode_load(bad, 200))
    graph.out.publish("load/blocks", encode_load(history.part(400, 600), 400))
    graph.out.publish("load/blocks", encode_load(history.part(0, 0), 600))
    assert graph.exit_code("twin") == 4
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "stopped"
    assert last.level == 2
    assert "samples 200 to 599 were refused" in last.message


def test_load_that_stops_coming_ends_the_run_with_a_status(graph: Graph) -> None:
    graph.fake_twin(load_timeout=0.5)
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    graph.out.publish("load/blocks", encode_load(history.part(0, 500), 0))
    assert graph.exit_code("twin") == 4
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "stopped"
    assert last.value("blocks") == "12"
    assert "no usable load for 0.5 s" in last.message
    assert "Traceback" not in graph.processes.log("twin")


def test_load_queue_overflow_is_an_error(graph: Graph) -> None:
    graph.fake_twin(scene="fake_slow", load_queue=0.5)
    history = fake_history("", "", 4.0)
    graph.connected("load/blocks")
    for first in range(0, 8000, 200):
        graph.out.publish("load/blocks", encode_load(history.part(first, first + 200), first))
    assert graph.exit_code("twin") == 4
    assert "the queue holds 0.5 s" in graph.statuses("twin")[-1].message


def test_services_pause_step_and_reset(graph: Graph) -> None:
    from std_srvs.srv import SetBool, Trigger

    graph.listen("vibration", "truth")
    graph.fake_twin(speed_factor=1.0)
    graph.fake_load(duration=60.0, exit_when_done=False)
    graph.until(lambda: len(graph.messages["vibration"]) > 2, "blocks")
    assert not graph.call("step", Trigger).success
    assert graph.call("pause", SetBool, data=True).success
    before = int(graph.until_state("paused").value("blocks"))
    assert graph.call("step", Trigger).success
    stepped = graph.until(
        lambda: int(graph.statuses("twin")[-1].value("blocks")) > before and graph.statuses("twin")[-1],
        "one step",
    )
    assert int(stepped.value("blocks")) == before + 1
    graph.until(lambda: len(graph.messages["vibration"]) == before + 1, "the block of the step")
    first_truth = decode_string(graph.messages["truth"][0])
    first_block = graph.messages["vibration"][0]
    graph.messages["vibration"].clear()
    assert graph.call("reset", Trigger).success
    graph.until(lambda: len(graph.messages["truth"]) == 2, "the truth of the new run")
    assert decode_string(graph.messages["truth"][1]) != first_truth
    graph.until_state("paused")
    assert graph.call("pause", SetBool, data=False).success
    graph.until(lambda: len(graph.messages["vibration"]) > 2, "blocks of the new run")
    assert graph.messages["vibration"][0] == first_block


def test_twin_publishes_every_topic_of_the_table_with_increasing_clock(graph: Graph) -> None:
    elsewhere = {"load/wrench", "load/shaft", "monitor/result", "follower/estimate", "follower/residual"}
    elsewhere |= {"vibration_samples", *BY_TOPIC}
    elsewhere |= {"temperature", "source_time"}  # need `thermal`, stamps of the source
    names = [entry.name for entry in TOPICS if entry.name not in elsewhere]
    graph.listen(*[name for name in names if name != "/diagnostics"])
    graph.fake_twin(speed_factor=1.0)
    graph.fake_load(duration=1.0)
    assert graph.exit_code("twin") == 0
    graph.until(lambda: len(graph.messages["vibration"]) == 50, "all blocks")
    assert [name for name in names if not graph.messages[name]] == []
    clock = [header_stamp(cdr) for cdr in graph.messages["/clock"]]
    assert clock == [20_000_000 * (k + 1) for k in range(50)]
    assert float(graph.statuses("twin")[-1].value("pace")) == pytest.approx(1.0, abs=0.15)


def test_two_twins_under_other_namespaces_do_not_receive_each_other(graph: Graph) -> None:
    graph.start(
        "left", "test.ros.fake_twin", "twin", "--ros-args", "-r", "__ns:=/left", "-p", "scene:=fake",
        "-p", "publish_clock:=false",
    )  # fmt: skip
    graph.start(
        "load", "test.ros.fake_twin", "load", "--ros-args", "-r", "__ns:=/left", "-p", "duration:=0.2"
    )
    graph.fake_twin("right", publish_clock=False)
    assert graph.exit_code("left") == 0
    assert graph.exit_code("load") == 0

    def states() -> dict[str, str]:
        found = [*graph.statuses("twin", "/left"), *graph.statuses("twin")]
        return {status.name: status.value("state") for status in found}

    graph.until(lambda: states().get("axlebox/twin") == "waiting for load", "the other twin")
    assert states() == {"left/twin": "finished", "axlebox/twin": "waiting for load"}
    assert [status for status in graph.statuses("twin") if status.value("blocks") != "0"] == []
    assert graph.node.count_publishers("/clock") == 0


def test_live_mode_holds_the_last_load_and_stops_when_it_is_too_old(graph: Graph) -> None:
    graph.listen("force", "vibration")
    graph.fake_twin(mode="live", speed_factor=1.0, max_age=0.4)
    graph.fake_load(mode="live", duration=60.0)
    graph.until(lambda: len(graph.messages["vibration"]) > 10, "blocks under live load")
    age = float(graph.statuses("twin")[-1].value("load_age"))
    assert age < 0.4
    graph.processes.signal("load", signal.SIGKILL)
    assert graph.exit_code("twin") == 4
    last = graph.statuses("twin")[-1]
    assert "more than max_age = 0.4 s" in last.message


def test_live_mode_alone_runs_in_real_time_and_says_how_far_it_lags(graph: Graph) -> None:
    graph.fake_twin(scene="fake_slow", mode="live")
    graph.fake_load(mode="live", duration=1.5)
    assert graph.exit_code("twin") == 0
    assert graph.exit_code("load") == 0
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "finished"
    assert last.value("speed_factor") == "1"
    lag = float(last.value("lag"))
    assert lag > 0.5
    assert float(last.value("worst_lag")) >= lag - 0.001
    assert last.level == 1
    simulated = float(last.value("simulated_time"))
    assert simulated < 1.4
    ended = re.fullmatch(
        rf"the live load has ended at simulated t = {simulated:.3f} s, (.*) s behind the wall clock",
        last.message,
    )
    assert ended is not None
    assert float(ended[1]) == pytest.approx(lag, abs=0.05)  # read at another moment
    running = [status.message for status in graph.statuses("twin") if status.value("state") == "running"]
    assert any("behind the wall clock" in message for message in running)


def test_a_load_without_the_forces_of_the_background_is_told_of(graph: Graph) -> None:
    graph.fake_twin(scene="fake_background")
    graph.fake_load(duration=0.2)
    assert graph.exit_code("twin") == 0
    last = graph.statuses("twin")[-1]
    assert "the forces of the background 'driven_emu' are not in the load" in last.message
    assert last.level == WARN


def test_validity_error_publishes_the_last_block_and_exits_with_3(graph: Graph) -> None:
    graph.listen("vibration")
    graph.fake_twin(scene="fake_invalid")
    graph.fake_load(duration=1.0, exit_when_done=False)
    assert graph.exit_code("twin") == 3
    last = graph.statuses("twin")[-1]
    assert last.value("status") == "4"
    assert "a roller has left its rib" in last.message
    graph.until(lambda: len(graph.messages["vibration"]) == 6, "the block that left validity")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_signals_end_the_nodes_cleanly(graph_of_new_processes: Graph, number: signal.Signals) -> None:
    graph = graph_of_new_processes
    graph.fake_twin(speed_factor=1.0)
    graph.fake_load(duration=60.0)
    graph.node_process("recorder", output=str(graph.folder / "run.mcap"))
    graph.until_state("running")
    graph.until(
        lambda: any(int(s.value("messages") or 0) > 100 for s in graph.statuses("recorder")), "a recording"
    )
    for name in ("recorder", "load", "twin"):
        graph.processes.signal(name, number)
        assert graph.exit_code(name) == 0
        assert "Traceback" not in graph.processes.log(name)
