"""Nothing is lost in silence: node and report tell, by topic, what was published and is not recorded."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pytest

from beardyn_core.record.mcap_scanning import McapScan
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_core.record.topics import relative_name
from beardyn_ros import diagnostics
from beardyn_ros.environment import PROFILE_VARIABLES, prepare_environment
from beardyn_ros.wire import LONGEST_SWEEP, RawIntake
from test.record.hostile import told
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected

INCOMPLETE = 5
TRUE_DEFAULTS = """<?xml version="1.0" encoding="UTF-8" ?>
<dds xmlns="http://www.eprosima.com"><profiles></profiles></dds>
"""


def reported(path: Path) -> str:
    """What ``beardyn report`` prints."""
    code, said = told("report", str(path))
    assert code == 0, said
    return said


def recorded_counts(path: Path) -> dict[str, int]:
    counts: dict[str, int] = {}
    for message in McapScan(path).messages():
        name = relative_name(message.topic)
        counts[name] = counts.get(name, 0) + 1
    return counts


def code_and_report_agree(graph: Graph, path: Path) -> int:
    """Exit code of the recorder: 0 exactly when nothing is missing; log and report say the same."""
    code, log = graph.exit_code("recorder"), graph.processes.log("recorder")
    missing = report(path).missing_messages
    assert missing is not None, log
    assert code == (INCOMPLETE if missing else 0), log
    text = reported(path)
    for each in missing:
        told = f"{each.topic} {each.count} of {each.published}"
        assert told in log
        assert told in text
    assert ("no samples missing" in text) == (not missing)
    return code


class Queue(nullcontext[None]):
    """A subscription, and its handle, in which messages wait."""

    def __init__(self, count: int) -> None:
        super().__init__()
        self.handle = self
        self._waiting = count

    def take_message(self, _kind: object, _raw: bool) -> tuple[bytes, dict[str, object]] | None:
        self._waiting -= 1
        return (b"", {}) if self._waiting >= 0 else None


@pytest.mark.parametrize("waiting", [0, 1, LONGEST_SWEEP - 1, LONGEST_SWEEP, 5 * LONGEST_SWEEP + 224])
def test_a_recorder_that_is_behind_takes_everything_that_waits_at_the_end(waiting: int) -> None:
    taken: list[bytes] = []
    intake = RawIntake(None, polled=True)
    for count in (3, waiting, 2):
        queue = Queue(count)
        intake._subscriptions.append((queue, None, lambda cdr, _source: taken.append(cdr)))
    intake.sweep_to_the_end()
    assert len(taken) == waiting + 5


def test_a_twin_that_was_there_all_the_time_is_gone_from_when_it_is_first_missed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    now, publishers = 0.0, 1
    monkeypatch.setattr(diagnostics.time, "monotonic", lambda: now)
    watch = diagnostics.TwinWatch("axlebox/twin", lambda: publishers)
    now = 600.0
    assert not watch.vanished()
    now, publishers = 900.0, 0
    assert watch.absent_for() == 0.0
    now = 902.0
    assert watch.absent_for() == 2.0
    assert not watch.vanished()
    now = 903.5
    assert watch.vanished()


def test_a_recorder_that_joins_a_run_says_from_when_and_ends_with_0(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=2.0)
    graph.fake_load(duration=12.0)
    graph.until(
        lambda: any(float(s.value("simulated_time")) > 0.5 for s in graph.statuses("twin")), "half a second"
    )
    graph.node_process("recorder", output=str(path))
    assert graph.exit_code("twin") == 0
    assert code_and_report_agree(graph, path) == 0
    assert report(path).missing_messages == ()
    counts, samples = recorded_counts(path), read_run(path).vibration.sample
    assert np.array_equal(samples, np.arange(samples[0], 600 * 512))
    assert 0 < counts["vibration"] < 600
    assert report(path).begin > 0.4
    assert "before the recorder was there" in graph.processes.log("recorder")
    assert "recorded from t = " in graph.processes.log("recorder")
    assert float(graph.statuses("recorder")[-1].value("recorded_from")) > 0.4


def test_a_file_that_begins_late_and_is_left_by_a_reset_says_so_and_the_monitor_goes_on(graph: Graph) -> None:
    from std_srvs.srv import SetBool, Trigger

    def simulated(more_than: float) -> None:
        graph.until(
            lambda: any(float(s.value("simulated_time")) > more_than for s in graph.statuses("twin")[-1:]),
            "simulated time",
        )

    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=0.2)  # a busy machine has time to reset it
    graph.node_process("monitor")
    is_connected(graph, "monitor")
    graph.fake_load(duration=3.0, exit_when_done=False)
    simulated(0.1)
    assert graph.call("pause", SetBool, data=True).success
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    at = float(graph.statuses("twin")[-1].value("simulated_time"))
    assert graph.call("pause", SetBool, data=False).success
    simulated(at)
    assert graph.call("reset", Trigger).success
    graph.set_parameter("twin", "speed_factor", 2.0)
    assert graph.exit_code("recorder") == 0
    assert graph.exit_code("monitor") == 0
    assert report(path).missing_messages == ()
    assert f"{path}: recorded from t = " in graph.processes.log("recorder")
    second = path.with_name("run_2.mcap")
    assert report(second).missing_messages == (), graph.processes.log("recorder")
    assert f"{second}: published" not in graph.processes.log("recorder")
    said = [status for _, statuses in read_run(second).results for status in statuses]
    assert len([status for status in said if status.value("final") == "true"]) == 1


def test_a_whole_recording_ends_with_0_and_has_every_published_message(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.fake_twin()
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.fake_load(duration=4.0)
    assert code_and_report_agree(graph, path) == 0
    counts = recorded_counts(path)
    assert (counts["vibration"], counts["force"], counts["joint_states"]) == (200, 1600, 800)
    assert counts["truth"] == 1


@pytest.fixture(params=["sourced", "true defaults"])
def sourced(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[Graph]:
    """A graph in a sourced ROS; with `true defaults` the user's own empty Fast DDS profile is in force."""
    prepare_environment()  # AMENT_PREFIX_PATH, which a sourced ROS has
    for name in PROFILE_VARIABLES:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROS_DISTRO", "kilted")
    if request.param == "true defaults":
        profile = tmp_path / "empty.xml"
        profile.write_text(TRUE_DEFAULTS)
        monkeypatch.setenv(PROFILE_VARIABLES[0], str(profile))
    with Graph(tmp_path) as running:
        running.has_profile = request.param == "sourced"  # type: ignore[attr-defined]
        yield running
    assert os.environ["ROS_DISTRO"] == "kilted"


@pytest.mark.slow
@pytest.mark.parametrize("factor", [0.0, 4.0])
def test_in_a_sourced_ros_the_code_tells_the_truth_and_nothing_is_lost(sourced: Graph, factor: float) -> None:
    path = sourced.folder / "run.mcap"
    sourced.fake_twin(speed_factor=factor)
    sourced.node_process("recorder", output=str(path))
    is_connected(sourced, "recorder")
    sourced.fake_load(duration=12.0)
    code = code_and_report_agree(sourced, path)
    if sourced.has_profile:  # type: ignore[attr-defined]
        assert code == 0, sourced.processes.log("recorder")


@pytest.mark.slow
def test_a_disk_that_stalls_costs_no_message(graph: Graph) -> None:
    """Eight seconds, longer than the history of any topic at that speed."""
    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=2.0)
    graph.start("recorder", "test.ros.slow_disk", "8", "recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.fake_load(duration=24.0)
    assert graph.exit_code("twin") == 0
    assert "the disk stalls" in graph.processes.log("recorder")
    assert code_and_report_agree(graph, path) == 0


def test_a_full_disk_is_a_sentence_and_code_2(graph: Graph) -> None:
    graph.fake_twin(speed_factor=2.0)
    graph.node_process("recorder", output="/dev/full", replace=True)
    is_connected(graph, "recorder")
    graph.fake_load(duration=4.0)
    assert graph.exit_code("recorder") == 2
    log = graph.processes.log("recorder")
    assert "No space left on device" in log
    assert "Traceback" not in log
