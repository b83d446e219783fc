"""The follower node: estimates from what a train has, with a twin beside, and recorded."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from beardyn_core.record.messages import decode_string
from beardyn_core.record.reporting import report
from test.ros.graph import Graph

ALLOWED = {f"/axlebox/{name}" for name in ("vibration", "shaft", "temperature")}
HOUSEKEEPING = {"/diagnostics", "/parameter_events"}


def test_follower_tells_what_a_train_does_not_measure_and_is_recorded(graph: Graph, tmp_path: Path) -> None:
    graph.listen("follower/estimate")
    file = tmp_path / "run.mcap"
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("recorder", output=str(file))
    graph.node_process("follower", bearing="HS130x230", mileage=1000.0)
    for name in ("follower", "recorder"):
        graph.until(
            lambda name=name: any(each.value("connected") == "true" for each in graph.statuses(name)),  # type: ignore[misc]
            f"the connection of {name}",
        )
    follower = ("follower", "/axlebox")
    graph.until(
        lambda: follower in graph.node.get_node_names_and_namespaces(), "the follower's name in the graph"
    )
    heard = graph.node.get_subscriber_names_and_types_by_node(*follower)
    assert {name for name, _ in heard} - HOUSEKEEPING == ALLOWED
    graph.fake_load(duration=5.0)
    assert graph.exit_code("follower") == 0
    assert graph.exit_code("recorder") == 0
    told = [json.loads(decode_string(cdr)) for cdr in graph.messages["follower/estimate"]]
    assert told.pop()["final"]  # the last word again, for who waits for it
    assert [each["time_s"] for each in told] == pytest.approx([1.5, 3.0, 4.5], abs=0.02)
    assert told[0]["health"] == "waiting"
    last = told[-1]
    assert last["shaft_frequency_Hz"] == pytest.approx(19.1, abs=0.1)  # 120 rad/s
    assert len(last["covariance"]) == len(last["names"])
    # an artificial signal is no axlebox: it says so instead of being sure of its load
    assert last["health"] == "unexplained"
    assert last["doubts"]
    assert any(each.value("health") == "unexplained" for each in graph.statuses("follower"))
    counts = {each.name: each.count for each in report(file).topics}
    assert counts["/axlebox/follower/estimate"] == 4


def test_mistakes_are_refused_with_the_parameter(graph: Graph) -> None:
    graph.node_process("follower", bearing="HS999")
    assert graph.exit_code("follower") == 2
    log = graph.processes.log("follower")
    assert "parameter 'bearing'" in log
    assert "Traceback" not in log


@pytest.mark.parametrize(
    ("twin", "sentence"),
    [("smoth_run", "smoth_run"), ("static_5kN", "runs on a track (kind: quarter_vehicle)")],
)
def test_a_twin_that_cannot_run_beside_is_refused_at_once(twin: str, sentence: str, graph: Graph) -> None:
    graph.node_process("follower", bearing="HS130x230", twin=twin)
    assert graph.exit_code("follower") == 2
    log = graph.processes.log("follower")
    assert "parameter 'twin'" in log
    assert sentence in log


def test_a_bearing_without_an_estimator_is_refused_with_those_there_are(graph: Graph) -> None:
    graph.node_process("follower", bearing="AARK_6.5x9")
    assert graph.exit_code("follower") == 2
    log = graph.processes.log("follower")
    assert "parameter 'estimator'" in log
    assert "HS130x230" in log
