"""The monitor node: finds the fault from what a train has, and asks for nothing else."""

from __future__ import annotations

import pytest

from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.config import load_bearing
from beardyn_core.record.messages import decode, decode_diagnostics, header_frame, header_stamp
from beardyn_core.record.plot_samples import encode_samples
from beardyn_core.record.plot_values import CODES, MONITOR, VECTOR, value_topics
from beardyn_core.study.monitored_recording import Finding
from test.ros.graph import Graph

ALLOWED = {f"/axlebox/{name}" for name in ("vibration", "shaft", "load/blocks", "load/wrench", "temperature")}
HOUSEKEEPING = {"/diagnostics", "/parameter_events"}


def test_monitor_finds_the_cup_fault_and_subscribes_to_nothing_that_a_train_has_not(graph: Graph) -> None:
    graph.listen("monitor/result", *value_topics(MONITOR))
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("monitor", bearing="HS130x230", interval=0.5)
    graph.until(
        lambda: any(status.value("connected") == "true" for status in graph.statuses("monitor")),
        "the monitor's connection",
    )
    monitor = ("monitor", "/axlebox")
    graph.until(
        lambda: monitor in graph.node.get_node_names_and_namespaces(), "the monitor's name in the graph"
    )
    received = graph.node.get_subscriber_names_and_types_by_node(*monitor)
    assert {name for name, _ in received} - HOUSEKEEPING == ALLOWED
    graph.fake_load(duration=3.0)
    assert graph.exit_code("monitor") == 0
    statuses = [decode_diagnostics(cdr)[1][0] for cdr in graph.messages["monitor/result"]]
    last = Finding.from_diagnostic(statuses[-1])
    assert last is not None
    assert statuses[-1].value("final") == "true"
    assert last.verdict == "cup"
    assert abs(last.deviation) < 0.01
    assert last.signal_to_background > 10.0
    assert statuses[0].value("verdict") == "waiting"
    stamps = [header_stamp(cdr) for cdr in graph.messages["monitor/result"]][:-1]  # without the last word
    for name in value_topics(MONITOR):
        messages = graph.messages[name]
        assert [header_stamp(cdr) for cdr in messages] == stamps
        assert {header_frame(cdr) for cdr in messages} == {"axlebox"}
        for cdr, status in zip(messages, statuses, strict=False):
            finding = Finding.from_diagnostic(status)
            assert finding is not None
            told = finding.to_values()[name.removeprefix("values/")]
            vector = decode(VECTOR, cdr).vector
            # the status has nine digits
            assert (vector.x, vector.y, vector.z) == pytest.approx(tuple(told), rel=1e-8, nan_ok=True)
    assert decode(VECTOR, graph.messages["values/verdict"][-1]).vector.x == CODES["cup"]


def test_numbers_are_left_out_and_every_sample_comes_as_the_parameters_say(graph: Graph) -> None:
    graph.listen("monitor/result", "vibration", "vibration_samples", *value_topics(MONITOR))
    graph.fake_twin(speed_factor=4.0)
    graph.node_process("monitor", interval=0.5, values=False, waveform=True)
    graph.until(
        lambda: any(status.value("connected") == "true" for status in graph.statuses("monitor")),
        "the monitor's connection",
    )
    graph.fake_load(duration=1.0)
    assert graph.exit_code("monitor") == 0
    while graph.drain():
        pass
    assert graph.messages["monitor/result"]
    assert not any(graph.messages[name] for name in value_topics(MONITOR))
    assert not any(graph.node.count_publishers(f"/axlebox/{name}") for name in value_topics(MONITOR))
    assert len(graph.messages["vibration_samples"]) == 50
    assert graph.messages["vibration_samples"] == [encode_samples(cdr) for cdr in graph.messages["vibration"]]


def test_a_fault_received_with_the_data_of_another_bearing_is_unexplained_on_the_topic(graph: Graph) -> None:
    graph.listen("monitor/result")
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("monitor", bearing="FR130x230x150")
    graph.until(
        lambda: any(status.value("connected") == "true" for status in graph.statuses("monitor")),
        "the monitor's connection",
    )
    graph.fake_load(duration=3.0)
    assert graph.exit_code("monitor") == 0
    status = decode_diagnostics(graph.messages["monitor/result"][-1])[1][0]
    last = Finding.from_diagnostic(status)
    assert last is not None
    assert (status.value("final"), last.verdict, status.level) == ("true", "unexplained", 1)
    orders = fault_frequencies(load_bearing("HS130x230"))
    assert last.comb_order == pytest.approx(orders.bpfo, rel=0.01)
    assert "HS130x230" in last.reason


def test_algorithm_of_ones_own_takes_the_place_of_the_chain(graph: Graph) -> None:
    graph.listen("monitor/result")
    graph.fake_twin(speed_factor=4.0)
    graph.node_process(
        "monitor", bearing="HS130x230", interval=0.5, algorithm="test.ros.always_roller:always"
    )
    graph.until(
        lambda: any(status.value("connected") == "true" for status in graph.statuses("monitor")),
        "the monitor's connection",
    )
    graph.fake_load(duration=2.0)
    assert graph.exit_code("monitor") == 0
    last = decode_diagnostics(graph.messages["monitor/result"][-1])[1][0]
    assert (last.value("verdict"), last.message) == ("roller", "always says so")


def test_unknown_algorithm_and_bearing_are_refused_together(graph: Graph) -> None:
    graph.node_process("monitor", bearing="HS999", algorithm="no_such_module:chain")
    assert graph.exit_code("monitor") == 2
    log = graph.processes.log("monitor")
    assert "parameter 'bearing'" in log
    assert "parameter 'algorithm'" in log
    assert "no_such_module" in log
    assert "Traceback" not in log


def test_factors_that_contradict_each_other_are_refused(graph: Graph) -> None:
    graph.node_process("monitor", bpfo=10.76, bpfi=8.24, bsf=70.6)
    assert graph.exit_code("monitor") == 2
    log = graph.processes.log("monitor")
    assert "are they exchanged?" in log
    assert "bsf is 70.6; it must be at most 20; a factor is per turn of the shaft" in log


def test_unknown_bearing_is_refused_with_the_known_ones(graph: Graph) -> None:
    graph.node_process("monitor", bearing="HS999")
    assert graph.exit_code("monitor") == 2
    log = graph.processes.log("monitor")
    assert "parameter 'bearing'" in log
    assert "HS130x230" in log
    assert "Traceback" not in log
