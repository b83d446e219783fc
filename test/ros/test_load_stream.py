"""Streams and live signals of load with something wrong in them: the true cause, and what recovers."""

from __future__ import annotations

import signal
import threading
import time
from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
import pytest

from beardyn_core.record.load_stream import encode_load
from beardyn_core.record.reading import read_run
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.live_load import encode_shaft, encode_wrench
from test.ros.fake_twin import fake_history
from test.ros.graph import Graph
from test.ros.test_recorder import is_connected
from test.ros.test_wall_time import has_come

RATE_HZ = 200.0


def send(graph: Graph, part: LoadHistory, first: int, frame: str = "axlebox") -> None:
    assert graph.out.publish("load/blocks", encode_load(part, first, frame))


def moved(part: LoadHistory, seconds: float) -> LoadHistory:
    time_ns = part.time_ns + round(seconds * 1e9)
    return LoadHistory(time_ns, part.wrench, part.shaft_speed, part.bogie)


# --- streams of blocks -------------------------------------------------------------------------------


def test_a_stream_whose_beginning_was_lost_is_refused_and_what_is_missing_is_said(graph: Graph) -> None:
    graph.fake_twin(load_timeout=1.0)
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    for first in range(200, 2000, 200):
        send(graph, history.part(first, first + 200), first)
    assert graph.exit_code("twin") == 4
    last = graph.statuses("twin")[-1]
    assert last.value("blocks") == "0"
    assert "samples 0 to 199 are missing" in last.message
    assert "--delay 1" in last.message


def test_a_stream_whose_beginning_comes_late_is_whole(graph: Graph) -> None:
    graph.listen("vibration")
    graph.fake_twin(load_timeout=30.0)
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    send(graph, history.part(200, 400), 200)
    graph.until(
        lambda: any(status.value("refused_messages") == "1" for status in graph.statuses("twin")),
        "the refusal",
    )
    send(graph, history.part(0, 2001), 0)
    send(graph, history.part(0, 0), 2001)
    assert graph.exit_code("twin") == 0
    graph.until(lambda: len(graph.messages["vibration"]) == 50, "every block")


def test_a_stream_may_be_joined_when_asked_for(graph: Graph) -> None:
    graph.fake_twin(join=True)
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    send(graph, history.part(1000, 2001), 1000)
    send(graph, history.part(0, 0), 2001)
    assert graph.exit_code("twin") == 0
    assert graph.statuses("twin")[-1].value("blocks") == "25"


def test_one_block_with_wild_sample_numbers_does_not_spoil_a_complete_stream(graph: Graph) -> None:
    graph.fake_twin()
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    send(graph, history.part(0, 1000), 0)
    send(graph, history.part(200, 400), 3_000_000_000)
    send(graph, history.part(1000, 2001), 1000)
    send(graph, history.part(0, 0), 2001)
    assert graph.exit_code("twin") == 0
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "finished"
    assert last.value("blocks") == "50"
    assert last.value("refused: gap") == "1"


def test_one_block_from_the_far_future_is_refused_and_the_true_one_taken(graph: Graph) -> None:
    graph.fake_twin()
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    send(graph, history.part(0, 1000), 0)
    send(graph, moved(history.part(1000, 1200), 1e6), 1000)
    send(graph, history.part(1000, 2001), 1000)
    send(graph, history.part(0, 0), 2001)
    assert graph.exit_code("twin") == 0
    assert graph.statuses("twin")[-1].value("refused: far future") == "1"


def test_load_in_another_frame_is_refused_with_both_names(graph: Graph) -> None:
    graph.fake_twin()
    history = fake_history("", "", 1.0)
    graph.connected("load/blocks")
    send(graph, history.part(0, 1000), 0, "wheelset")
    send(graph, history.part(0, 1000), 0, "axlebox")
    send(graph, history.part(1000, 2001), 1000, "")
    send(graph, history.part(0, 0), 2001)
    assert graph.exit_code("twin") == 0
    last = graph.statuses("twin")[-1]
    assert last.value("refused: wrong frame") == "1"
    assert "its frame is 'wheelset', this twin takes load in 'axlebox'" in last.message


def test_the_warning_of_a_refusal_goes_when_all_is_well_again(graph: Graph) -> None:
    graph.fake_twin(speed_factor=1.0)
    history = fake_history("", "", 60.0)
    graph.connected("load/blocks")
    for first in range(0, 80_000, 4000):
        send(graph, history.part(first, first + 4000), first)
    graph.until_state("running")
    send(graph, history.part(0, 200), 0)
    graph.until(lambda: graph.statuses("twin")[-1].level == 1, "the warning")
    graph.until(lambda: graph.statuses("twin")[-1].level == 0, "its end", timeout=20.0)
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "running"
    assert last.value("refused_messages") == "1"


def test_a_twin_that_was_told_to_stop_is_recorded_as_interrupted(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.fake_twin(speed_factor=1.0)
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    graph.fake_load(duration=60.0)
    graph.until_state("running")
    graph.until(lambda: float(graph.statuses("twin")[-1].value("simulated_time")) > 1.0, "a second")
    graph.processes.signal("twin", signal.SIGINT)
    assert graph.exit_code("twin") == 0
    assert graph.exit_code("recorder") == 0
    run = read_run(path)
    assert "asked to stop" in (run.status or "")
    last = graph.statuses("twin")[-1]
    assert last.value("state") == "interrupted"
    assert len(run.vibration) == int(last.value("waveform_samples"))
    assert len(run.force) == int(last.value("messages force"))


# --- live signals ------------------------------------------------------------------------------------


class LiveSource(threading.Thread):
    """Sends force and speed at 200 Hz, each message stamped with its time on the wall.

    Parameters
    ----------
    frequency : float
        Of the vertical force, which is 50 kN and 20 kN of sine, [Hz].
    """

    def __init__(self, graph: Graph, frequency: float) -> None:
        super().__init__(daemon=True)
        self._graph = graph
        self._frequency = frequency
        self._ended = threading.Event()
        self.stamp_offset_ns = 0
        graph.connected("load/wrench", "load/shaft")

    def force(self, seconds: float) -> float:
        return 5e4 + 2e4 * float(np.sin(2 * np.pi * self._frequency * seconds))

    def run(self) -> None:
        begin = time.monotonic()
        for count in range(100_000):
            if self._ended.wait(max(begin + count / RATE_HZ - time.monotonic(), 0.0)):
                return
            self.send(round(count * 1e9 / RATE_HZ) + self.stamp_offset_ns)

    def send(self, stamp_ns: int, frame: str = "axlebox") -> None:
        wrench = np.array([0.0, 0.0, self.force(stamp_ns * 1e-9), 0.0, 0.0, 0.0])
        self._graph.out.publish("load/wrench", encode_wrench(wrench, stamp_ns, frame))
        self._graph.out.publish("load/shaft", encode_shaft(100.0, stamp_ns, frame))

    def end(self) -> None:
        self._ended.set()
        self.join()


Sources = Callable[[float], LiveSource]


@pytest.fixture
def live_source(graph: Graph) -> Iterator[Sources]:
    """Starts a source of a frequency; it ends before the graph does."""
    sources: list[LiveSource] = []

    def start(frequency: float) -> LiveSource:
        sources.append(LiveSource(graph, frequency))
        sources[-1].start()
        return sources[-1]

    yield start
    for source in sources:
        source.end()


def test_delay_of_live_load_is_the_stated_one() -> None:
    from beardyn_ros.live_load import LowPass

    low_pass, steps = LowPass(10.0), np.full(4000, 1e-3)
    times = np.cumsum(steps)
    out = [low_pass.push(np.array([1e-3]), np.array([[np.sin(2 * np.pi * 3.0 * t)]]))[0] for t in times]
    later = times > 1.0
    waves = np.stack([np.sin(2 * np.pi * 3.0 * times), np.cos(2 * np.pi * 3.0 * times)], axis=1)
    (cosine, sine), *_ = np.linalg.lstsq(waves[later], np.array(out)[later], rcond=None)
    stated = 2.1139176749 / (2 * np.pi * 10.0)  # of a Bessel filter of order 4, 0.336 / bandwidth
    assert stated == pytest.approx(0.0336, abs=1e-4)
    assert -np.arctan2(sine, cosine) / (2 * np.pi * 3.0) == pytest.approx(stated, rel=1e-3)


@pytest.mark.parametrize("bandwidth", [1.0, 10.0])
def test_filter_of_live_load_is_the_bessel_filter_however_its_samples_are_spaced(bandwidth: float) -> None:
    from scipy.signal import bessel, freqs_zpk

    from beardyn_ros.live_load import LowPass

    zeros, poles, gain = bessel(4, 2 * np.pi * bandwidth, analog=True, norm="mag", output="zpk")
    steps = np.random.default_rng(3).uniform(0.2e-3, 1.8e-3, 8000) / bandwidth * 10.0
    times = np.cumsum(steps)
    for ratio in (0.2, 1.0, 3.0):
        frequency = ratio * bandwidth
        wave = np.exp(2j * np.pi * frequency * times)
        low_pass = LowPass(bandwidth)
        values = np.stack([wave.real, wave.imag], axis=1)
        out = np.array([low_pass.push(steps[k : k + 1], values[k : k + 1]) for k in range(len(times))])
        later = times * bandwidth > 20.0
        response = np.mean((out[later, 0] + 1j * out[later, 1]) / wave[later])
        _, (expected,) = freqs_zpk(zeros, poles, gain, [2 * np.pi * frequency])
        assert abs(response - expected) < 0.01 * abs(expected) + 1e-4
    whole, parts = LowPass(bandwidth), LowPass(bandwidth)
    one_by_one = [parts.push(steps[k : k + 1], values[k : k + 1]) for k in range(500)][-1]
    assert np.allclose(whole.push(steps[:500], values[:500]), one_by_one, rtol=0.0, atol=1e-12)


def test_one_stamp_from_the_far_future_does_not_end_the_live_load(graph: Graph, live_source: Sources) -> None:
    graph.listen("vibration")
    graph.fake_twin(mode="live", max_age=1.0)
    source = live_source(1.0)
    graph.until(lambda: len(graph.messages["vibration"]) > 10, "blocks under live load")
    source.send(int(2e18))
    graph.until(lambda: len(graph.messages["vibration"]) > 100, "more of the run than max_age")
    counts = dict(graph.statuses("twin")[-1].values)
    assert counts["refused: far future"] == "2"
    assert counts["refused_messages"] == "2"


def test_a_source_that_sets_its_clock_goes_on(graph: Graph, live_source: Sources) -> None:
    graph.listen("vibration")
    graph.fake_twin(mode="live", max_age=1.0)
    source = live_source(1.0)
    for offset_s in (0, 10**9, -5):
        source.stamp_offset_ns = offset_s * 10**9
        goal = len(graph.messages["vibration"]) + 75
        graph.until(partial(has_come, graph, "vibration", goal), f"more than max_age at {offset_s} s")


def test_live_load_that_is_all_refused_is_not_called_silent(graph: Graph) -> None:
    graph.fake_twin(mode="live", max_age=2.0)
    source = LiveSource(graph, 1.0)
    source.send(0)
    graph.until_state("running")

    def over() -> bool:
        source.send(0, "wheelset")
        return graph.processes.exit_code("twin") is not None

    graph.until(over, "the end of the twin", check_processes=False)
    assert graph.exit_code("twin") == 4
    last = graph.statuses("twin")[-1].message
    assert "have come since and were refused" in last
    assert "its frame is 'wheelset'" in last
    assert "its source has stopped" not in last


def test_a_message_that_cannot_be_read_is_counted_and_the_run_goes_on(
    graph: Graph, live_source: Sources
) -> None:
    graph.listen("vibration")
    graph.fake_twin(mode="live", max_age=2.0)
    live_source(1.0)
    graph.until(lambda: len(graph.messages["vibration"]) > 10, "blocks under live load")
    graph.out.publish("load/wrench", b"\x00\x01\x00\x00\x01")
    graph.out.publish("load/truth", b"\x00\x01\x00\x00\xff\xff\xff\xffx")
    graph.until(lambda: graph.statuses("twin")[-1].value("refused: wrong fields") == "2", "two refusals")
    goal = len(graph.messages["vibration"]) + 50
    graph.until(lambda: len(graph.messages["vibration"]) > goal, "the run going on")
    assert "Traceback" not in graph.processes.log("twin")
