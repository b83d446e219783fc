"""Several axleboxes in one graph: whose status, whose frame, and two twins under one name."""

from __future__ import annotations

import json

import numpy as np

from beardyn_core.record.messages import (
    DIAGNOSTICS,
    Diagnostic,
    decode,
    decode_string,
    encode_diagnostics,
    encode_string,
)
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_ros.live_load import encode_wrench
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected


def box(graph: Graph, namespace: str, kind: str, **parameters: object) -> None:
    """Start a node of one axlebox under the name ``<kind>_<namespace>``."""
    module = "test.ros.fake_twin" if kind in ("twin", "load") else "beardyn_ros"
    words = ["--ros-args", "-r", f"__ns:=/{namespace}"]
    for key, value in parameters.items():
        words += ["-p", f"{key}:={str(value).lower() if isinstance(value, bool) else value}"]
    graph.start(f"{kind}_{namespace}", module, kind, *words)


def test_the_end_of_one_axlebox_leaves_recorder_and_monitor_of_another_at_work(graph: Graph) -> None:
    path = graph.folder / "left.mcap"
    box(graph, "left", "twin", scene="fake", speed_factor=1.0, publish_clock=False)
    box(graph, "left", "recorder", output=path)
    box(graph, "left", "monitor")
    graph.until(lambda: graph.statuses("twin", "/left"), "the left twin")
    graph.until(
        lambda: any(s.value("connected") == "true" for s in graph.statuses("recorder", "/left")),
        "the recorder's connection",
    )
    box(graph, "right", "twin", scene="fake", exit_when_done=False, publish_clock=False)
    graph.until(lambda: graph.statuses("twin", "/right"), "the right twin")
    box(graph, "right", "load", duration=0.5)
    box(graph, "left", "load", duration=5.0)
    graph.until(
        lambda: graph.statuses("twin", "/right")[-1].value("state") == "finished", "the end of the right run"
    )
    # another product in the same graph has a part called twin too
    stranger = Diagnostic("digital_twin_platform/twin", 0, "done", (("state", "finished"),))
    graph.out.publish("/diagnostics", encode_diagnostics(0, "platform", [stranger]))
    assert graph.statuses("twin", "/left")[-1].value("state") != "finished"
    assert graph.exit_code("twin_left") == 0
    assert graph.exit_code("recorder_left") == 0
    assert graph.exit_code("monitor_left") == 0
    run = read_run(path)
    assert run.complete
    assert np.array_equal(run.vibration.sample, np.arange(5 * 50 * 512))


def test_frames_and_hardware_ids_are_those_of_the_namespace_or_as_given(graph: Graph) -> None:
    box(graph, "left", "twin", scene="fake", publish_clock=False)
    box(graph, "right", "twin", scene="fake", publish_clock=False, frame_id="car/right_box")
    box(graph, "left", "load", duration=0.2)
    box(graph, "right", "load", duration=0.2, frame_id="car/right_box")
    frames: dict[str, str] = {}
    hardware: dict[str, str] = {}

    def listen(namespace: str) -> None:
        from geometry_msgs.msg import WrenchStamped

        def take(message: object) -> None:
            frames[namespace] = message.header.frame_id  # type: ignore[attr-defined]

        graph.node.create_subscription(WrenchStamped, f"/{namespace}/force", take, 50)

    for namespace in ("left", "right"):
        listen(namespace)
    graph.until(lambda: len(frames) == 2, "forces of both")
    for cdr in graph.messages["/diagnostics"]:
        hardware |= {status.name: status.hardware_id for status in decode(DIAGNOSTICS, cdr).status}
    assert frames == {"left": "left", "right": "car/right_box"}
    assert hardware["left/twin"] == hardware["left/load"] == "left"
    assert hardware["right/twin"] == hardware["right/load"] == "right"
    assert graph.exit_code("twin_left") == 0
    assert graph.exit_code("twin_right") == 0


def test_a_second_twin_of_the_same_name_refuses_and_the_recording_of_the_first_is_whole(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=1.0)
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.fake_load(duration=2.0, fade=0.1, loop=True)
    graph.until_state("running")
    graph.fake_twin("second", speed_factor=1.0)
    assert graph.exit_code("second") == 2
    assert "there is a twin axlebox/twin already" in graph.processes.log("second")
    graph.dismiss("second")
    assert graph.processes.exit_code("twin") is None
    another = "another twin speaks as axlebox/twin"
    graph.until(lambda: any(another in s.message for s in graph.statuses("twin")), "the warning")
    warned = [s for s in graph.statuses("twin") if another in s.message]
    assert {status.level for status in warned} == {1}
    graph.until(lambda: graph.statuses("twin")[-1].level == 0, "the end of the warning")
    assert graph.set_parameter("load", "loop", False).successful
    assert graph.exit_code("twin") == 0
    assert graph.exit_code("recorder") == 0
    run = read_run(path)
    assert run.status == "complete"
    blocks = int(graph.statuses("twin")[-1].value("blocks"))
    assert np.array_equal(run.vibration.sample, np.arange(blocks * 512))


def test_a_recorder_follows_its_twin_while_another_publisher_speaks_in_its_name(graph: Graph) -> None:
    """Status, truth and signals of a rival are refused and counted; nothing ends, splits or is missing."""
    path = graph.folder / "run.mcap"
    graph.listen("truth")
    graph.fake_twin(speed_factor=1.0)
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.fake_load(duration=6.0)
    graph.until_state("running")
    graph.connected("truth", "force", "vibration")
    values = (
        *(("state", "finished"), ("run_id", "0badcafe-0")),
        *(("instance", "0badcafe"), ("since", "0")),
    )
    own = json.loads(decode_string(graph.messages["truth"][0]))
    for count, run_id in enumerate(("0badcafe-0", own["run_id"], ""), start=1):
        rival = dict(values) | {"run_id": run_id}
        status = Diagnostic("axlebox/twin", 0, "finished", tuple(rival.items()))
        graph.out.publish("/diagnostics", encode_diagnostics(0, "axlebox", [status]))
        graph.out.publish("truth", encode_string(json.dumps({**own, "run_id": run_id, "scene": "/x"})))
        graph.until(  # the topic keeps its latest message only
            lambda count=count: graph.statuses("recorder")[-1].value("refused: truth") == str(count),  # type: ignore[misc]
            "the refusal",
        )
    graph.out.publish("force", encode_wrench(np.zeros(6), 0))
    for part in ("twin", "recorder", "load"):
        assert graph.exit_code(part) == 0, graph.processes.log(part)
    said = graph.statuses("recorder")[-1]
    assert said.value("refused: truth") == "3"
    assert said.value("refused: force") == "1"
    assert int(said.value("refused: /diagnostics") or 0) == 3
    assert list(graph.folder.glob("*.mcap")) == [path]
    assert report(path).missing_messages == ()
    assert len(read_run(path).force) == 2400


def test_a_twin_says_that_somebody_else_publishes_the_clock(graph: Graph) -> None:
    graph.fake_twin()
    graph.until_state("waiting for load")
    graph.out.publisher("/clock")
    graph.until(
        lambda: any("somebody else publishes /clock too" in s.message for s in graph.statuses("twin")),
        "the warning of a second clock",
    )
    assert graph.statuses("twin")[-1].level == 1
