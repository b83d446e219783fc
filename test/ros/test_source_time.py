"""Stamps of the train's own clock: two clocks, one that drifts, one that is set, messages that come late."""

from __future__ import annotations

import re
import signal
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.record.clouds import cloud_to_arrays
from beardyn_core.record.messages import decode_string, header_stamp, time_reference
from beardyn_core.record.reading import read_run
from beardyn_core.record.reporting import report
from beardyn_ros.live_load import SHAFT_TOPIC, WRENCH_TOPIC
from beardyn_ros.load_feed import LoadFeed
from beardyn_ros.source_time import FASTEST_DRIFT, ClockReading, SourceStamps
from test.ros.graph import Graph
from test.ros.live_train import EPOCH_S, LiveTrain
from test.ros.test_load_feed import OPTIONS, Covered
from test.ros.test_recorder import is_connected

BLOCK_NS, DELAY_NS = 20_000_000, 113_000_000
Clock = Callable[[float], float]  # what a clock shows at a wall time, both [s]


class _Stamped(NamedTuple):
    """Stamp of the end of a block, and what it should be."""

    stamp_ns: int
    true_ns: int
    held: float


def _stamps(clock: Clock, latency: Callable[[], float], duration: float = 8.0) -> Iterator[_Stamped]:
    """Let messages of a clock come late, 200 a second, and stamp blocks of a twin that keeps real time."""
    origin = [0.0]  # wall time of simulated time 0
    stamps = SourceStamps(threading.Condition(), lambda wall: wall - origin[0])
    arrivals: list[tuple[float, int]] = []  # in their order: one that is late holds up those behind it
    for wall in np.arange(-1.0, duration, 5e-3).tolist():
        arrival = max(wall + latency(), arrivals[-1][0] if arrivals else -1.0)
        arrivals.append((arrival, round(1e9 * clock(wall))))
    block, last_ns = 0, -(10**30)
    while (wall := origin[0] + 1e-9 * block * BLOCK_NS) < duration:
        while arrivals and arrivals[0][0] <= wall:
            arrival, stamp_ns = arrivals.pop(0)
            stamps.receive(WRENCH_TOPIC, stamp_ns, arrival, was_set=stamp_ns < last_ns)
            last_ns = stamp_ns
        offset, held = stamps.follow(WRENCH_TOPIC, block * BLOCK_NS, BLOCK_NS, DELAY_NS)
        if held > 0.0:
            origin[0] += min(held, 0.1)
            continue
        true_ns = round(1e9 * clock(wall)) - DELAY_NS
        yield _Stamped(block * BLOCK_NS + offset.ahead_ns, true_ns, held)
        block += 1


def _late(seed: int, usual: float = 3e-4, worst: float = 0.03) -> Callable[[], float]:
    """Make latencies: some tenths of a millisecond, now and then much more."""
    random = np.random.default_rng(seed)
    return lambda: float(usual + random.exponential(usual) + worst * (random.random() < 0.05))


@settings(max_examples=20, deadline=None)
@given(drift=st.floats(-2e-4, 2e-4), seed=st.integers(0, 1000))
def test_stamps_follow_a_clock_that_drifts_and_never_go_back(drift: float, seed: int) -> None:
    found = list(_stamps(lambda wall: EPOCH_S + (1.0 + drift) * wall, _late(seed)))
    errors = [each.stamp_ns - each.true_ns for each in found]
    assert max(abs(each) for each in errors) < 3_000_000
    steps = np.diff([each.stamp_ns for each in found])
    assert (np.abs(steps - BLOCK_NS) <= FASTEST_DRIFT * BLOCK_NS).all()


@pytest.mark.parametrize("step", [-8.0, -0.35, -0.06, 0.06, 0.35, 9.0])
def test_stamps_follow_a_clock_that_is_set_and_come_once(step: float) -> None:
    """Set forward they leap; set back the twin waits until the clock shows a time that was not yet."""
    found = list(_stamps(lambda wall: EPOCH_S + wall + step * (wall >= 3.0), _late(1), 20.0))
    stamps = np.array([each.stamp_ns for each in found])
    assert (np.diff(stamps) >= BLOCK_NS * (1.0 - FASTEST_DRIFT)).all()
    settled = found[-50:]
    assert max(abs(each.stamp_ns - each.true_ns) for each in settled) < 3_000_000
    leaps = np.diff(stamps) - BLOCK_NS
    assert leaps.max() == pytest.approx(1e9 * step, abs=5e6) if step > 0.0 else leaps.max() < 1e6


@pytest.mark.parametrize("silence", [0.5, 3.0, 12.0])
def test_messages_that_come_late_in_a_burst_set_no_clock(silence: float) -> None:
    """After a silence of the network they come all at once: the clock has gone on, and no stamp waits."""

    def late(wall: float) -> float:
        return max(4.0 + silence - wall, 0.0) if 4.0 <= wall < 4.0 + silence else 3e-4

    stamps = SourceStamps(threading.Condition(), lambda wall: wall)
    messages = sorted((wall + late(wall), wall) for wall in np.arange(-1.0, 20.0, 5e-3).tolist())
    held, ends = 0.0, []
    for block in range(1000):
        while messages and messages[0][0] <= 0.02 * block:
            arrival, wall = messages.pop(0)
            stamps.receive(WRENCH_TOPIC, round(1e9 * (EPOCH_S + wall)), arrival, was_set=False)
        offset, behind = stamps.follow(WRENCH_TOPIC, block * BLOCK_NS, BLOCK_NS, DELAY_NS)
        held += behind
        ends.append(block * BLOCK_NS + offset.ahead_ns)
    assert held == 0.0
    assert (np.abs(np.diff(ends) - BLOCK_NS) <= FASTEST_DRIFT * BLOCK_NS).all()


def test_a_clock_that_begins_at_0_gives_no_stamp_before_that() -> None:
    found = list(_stamps(lambda wall: wall + 1.0, _late(2), 3.0))
    assert found[0].stamp_ns >= 0
    assert abs(found[-1].stamp_ns - found[-1].true_ns) < 3_000_000


def test_the_next_run_begins_behind_the_one_before() -> None:
    stamps = SourceStamps(threading.Condition(), lambda wall: wall)
    for k in range(100):
        stamps.receive(WRENCH_TOPIC, round(1e9 * (EPOCH_S + 5e-3 * k)), 5e-3 * k, was_set=False)
    first, _ = stamps.follow(WRENCH_TOPIC, 0, BLOCK_NS, DELAY_NS)
    end = first.ahead_ns + BLOCK_NS
    earliest = stamps.preview(WRENCH_TOPIC, DELAY_NS)  # at once: the clock has not gone on
    stamps.begin()
    again, held = stamps.follow(WRENCH_TOPIC, 0, BLOCK_NS, DELAY_NS)
    assert held == 0.0
    assert earliest == again.ahead_ns == end


@pytest.mark.parametrize("pace", [0.5, 2.0])
def test_a_clock_of_another_pace_is_found_out(pace: float) -> None:
    stamps = SourceStamps(threading.Condition(), lambda wall: pace * wall)
    for k in range(2000):
        wall = 5e-3 * k
        stamps.receive(WRENCH_TOPIC, round(1e9 * (EPOCH_S + wall)), wall, was_set=False)
        if k % 4 == 0:
            stamps.follow(WRENCH_TOPIC, k // 4 * BLOCK_NS, BLOCK_NS, DELAY_NS)
    assert stamps.is_at_another_pace


def test_one_stray_stamp_moves_no_clock() -> None:
    reading = ClockReading(lambda wall: wall)
    for k in range(200):
        reading.receive(round(1e9 * (EPOCH_S + 5e-3 * k)), 5e-3 * k + 1e-4)
        if k == 100:
            before = reading.ahead_ns()
            reading.receive(round(1e9 * (EPOCH_S + 7.0)), 5e-3 * k + 2e-4)
            assert reading.ahead_ns() == before
    assert reading.ahead_ns() == pytest.approx(1e9 * EPOCH_S, abs=2e5)


def test_two_clocks_are_told_apart() -> None:
    stamps = SourceStamps(threading.Condition(), lambda wall: wall)
    assert np.isnan(stamps.apart_s(SHAFT_TOPIC, WRENCH_TOPIC))
    for k in range(20):
        stamps.receive(WRENCH_TOPIC, round(1e9 * (EPOCH_S + 5e-3 * k)), 5e-3 * k, was_set=False)
        stamps.receive(SHAFT_TOPIC, round(1e9 * (EPOCH_S + 3.2 + 5e-3 * k)), 5e-3 * k, was_set=False)
    assert stamps.apart_s(SHAFT_TOPIC, WRENCH_TOPIC) == pytest.approx(3.2, abs=1e-6)


@pytest.mark.parametrize("bandwidth", [2.0, 10.0])
@pytest.mark.parametrize("look_ahead_ns", [0, 15_000_000])
def test_the_delay_of_live_load_is_what_stamps_leave_out(look_ahead_ns: int, bandwidth: float) -> None:
    """A step comes out of filter and line as late as `live_delay_ns` says.

    A Bessel filter is at half of its step 2 % before its delay.
    """
    options = replace(OPTIONS, mode="live", live_bandwidth=bandwidth)
    found = []
    for lag_ns in range(0, BLOCK_NS, 4_000_000):  # of the step behind the begin of a block
        feed = LoadFeed(options, threading.Condition(), lambda ready, _timeout: ready(), lambda *_said: None)
        twin, step_ns, delay_ns = Covered(look_ahead_ns), 20 * BLOCK_NS + lag_ns, 0
        for block in range(100):
            begin_ns = block * BLOCK_NS
            for stamp_ns in range(begin_ns - BLOCK_NS + 1_000_000, begin_ns + 1, 1_000_000):
                level = 80e3 if stamp_ns > step_ns else 40e3
                feed.live.offer_wrench(np.array([0.0, 0.0, level, 0.0, 0.0, 0.0]), 10**12 + stamp_ns)
                feed.live.offer_speed(30.0, 10**12 + stamp_ns)
            if block == 0:
                twin.feed(feed.first(BLOCK_NS))
            twin.next_block()
            feed.cover(twin)
            delay_ns = feed.live_delay_ns(begin_ns)
        risen_ns = np.interp(60e3, twin.vertical, twin.times)
        found.append(float(risen_ns) - step_ns - delay_ns)
    assert np.abs(found).max() < 0.02 * delay_ns


def _crossing_ns(graph: Graph, level: float) -> int:
    """Find the stamp at which the force on the cup first passes a level."""
    clouds = [cloud_to_arrays(cdr) for cdr in graph.messages["force_waveform"]]
    stamps = [header_stamp(cdr) for cdr in graph.messages["force_waveform"]]
    for stamp, cloud in zip(stamps, clouds, strict=True):
        over = np.flatnonzero(cloud["fz"] > level)
        if len(over):
            return stamp + int(cloud["t"][over[0]])
    raise AssertionError("the force has not passed the level")


def _reach_ns(graph: Graph) -> int:
    """Give what stamps may be off: a block, the spacing of messages, latency, and the lag of the twin."""
    return 40_000_000 + round(1e9 * float(graph.statuses("twin")[-1].value("worst_lag")))


def _more_blocks(graph: Graph, count: int) -> None:
    wanted = len(_blocks(graph)) + count
    graph.until(lambda: len(_blocks(graph)) > wanted, f"{count} blocks more")


def _blocks(graph: Graph) -> list[int]:
    return [header_stamp(cdr) for cdr in graph.messages["force_waveform"]]


@pytest.mark.ros
def test_live_outputs_carry_the_clock_of_the_source_and_its_events(graph: Graph) -> None:
    path = graph.folder / "run.mcap"
    graph.listen("force_waveform", "force", "source_time", "truth", "load/consumed")
    graph.fake_twin(mode="live", max_age=5.0)
    graph.node_process("recorder", output=str(path))
    is_connected(graph, "recorder")
    with LiveTrain(graph) as train:
        graph.until(lambda: len(_blocks(graph)) > 25, "half a second")
        stepped_ns = train.step()
        graph.until(lambda: _blocks(graph)[-1] > stepped_ns + 500_000_000, "the answer to the step")
        assert abs(_crossing_ns(graph, 60e3) - stepped_ns) < _reach_ns(graph)
        assert 0.0 < train.now - 1e-9 * _blocks(graph)[-1] < 5.0
        assert not graph.node.count_publishers("/clock")
        graph.processes.signal("twin", signal.SIGINT)
        assert graph.exit_code("twin") == 0
    blocks = np.array(_blocks(graph))
    assert (np.abs(np.diff(blocks) - BLOCK_NS) < 0.01 * BLOCK_NS).all()
    assert abs(header_stamp(graph.messages["force"][-1]) - blocks[-1]) < 2 * BLOCK_NS
    reference = graph.messages["source_time"][0]
    assert abs(header_stamp(reference) - time_reference(reference) - blocks[0]) < BLOCK_NS
    assert '"begin_ns"' in decode_string(graph.messages["truth"][-1])
    assert graph.exit_code("recorder") == 0
    run = read_run(path)
    assert run.force_waveform.time_ns[0] == blocks[0]
    assert len(run.force_waveform) == 512 * len(blocks)


@pytest.mark.ros
def test_a_clock_that_is_set_back_holds_the_twin_and_no_stamp_comes_twice(graph: Graph) -> None:
    graph.listen("force_waveform")
    graph.fake_twin(mode="live", max_age=5.0)
    with LiveTrain(graph) as train:
        graph.until(lambda: len(_blocks(graph)) > 25, "half a second")
        train.ahead -= 0.6
        count = len(_blocks(graph))
        graph.until(lambda: "was set back" in graph.statuses("twin")[-1].message, "the word about the clock")
        graph.until(lambda: len(_blocks(graph)) > count + 25, "the twin to go on")
        assert (np.diff(_blocks(graph)) > 0.99 * BLOCK_NS).all()
        stepped_ns = train.step()
        graph.until(lambda: _blocks(graph)[-1] > stepped_ns + 500_000_000, "the answer to the step")
        assert abs(_crossing_ns(graph, 60e3) - stepped_ns) < _reach_ns(graph)
        train.ahead += 2.0
        graph.until(lambda: "stamps leap by" in graph.statuses("twin")[-1].message, "the leap")
        first = graph.statuses("twin")[-1].value("run_id")
        train.ahead -= 100.0
        graph.until(lambda: graph.statuses("twin")[-1].value("run_id") not in ("", first), "a new run")
        graph.until(lambda: 1e-9 * _blocks(graph)[-1] < train.now, "stamps of the clock as it is now")


@pytest.mark.ros
def test_a_leap_is_no_loss_and_a_recorder_may_join_late(graph: Graph) -> None:
    early, late = graph.folder / "early.mcap", graph.folder / "late.mcap"
    graph.listen("force_waveform")
    graph.fake_twin(mode="live", max_age=5.0)
    graph.node_process("recorder", output=str(early))
    is_connected(graph, "recorder")
    with LiveTrain(graph) as train:
        graph.until(lambda: len(_blocks(graph)) > 25, "half a second")
        train.ahead += 2.0
        graph.until(lambda: "stamps leap by" in graph.statuses("twin")[-1].message, "the leap")
        graph.start("second", "beardyn_ros", "recorder", output=str(late))
        graph.until(late.exists, "the second file")
        count = len(_blocks(graph))
        graph.until(lambda: len(_blocks(graph)) > count + 25, "half a second more")
        graph.processes.signal("twin", signal.SIGINT)
        for name in ("twin", "recorder", "second"):
            assert graph.exit_code(name) == 0, graph.processes.log(name)
    for path in (early, late):
        found = report(path)
        assert found.gaps == ()
        assert found.missing_messages == ()
        rates = {each.name.removeprefix("/axlebox/"): each.rate for each in found.topics}
        assert rates["force_waveform"] == pytest.approx(50.0, rel=0.02)
    stamps = read_run(early).source_time
    assert stamps[-1][0] - stamps[-1][1] - (stamps[0][0] - stamps[0][1]) == pytest.approx(2e9, abs=5e7)
    assert "messages and" in graph.processes.log("second")  # what was before it


@pytest.mark.ros
def test_runs_that_a_reset_parts_are_each_whole(graph: Graph) -> None:
    """Stamps go on from run to run, so that only the truth tells which run they belong to."""
    from std_srvs.srv import Trigger

    graph.listen("force_waveform")
    graph.fake_twin(mode="live", max_age=5.0)
    graph.node_process("recorder", output=str(graph.folder / "run.mcap"))
    is_connected(graph, "recorder")
    with LiveTrain(graph):
        for reset in range(5):
            _more_blocks(graph, 20)
            if reset < 4:
                assert graph.call("reset", Trigger).success
        graph.processes.signal("twin", signal.SIGINT)
        assert graph.exit_code("twin") == 0
        assert graph.exit_code("recorder") == 0, graph.processes.log("recorder")
    paths = sorted(graph.folder.glob("*.mcap"))
    assert len(paths) == 5
    for path in paths:
        found, run = report(path), read_run(path)
        assert found.gaps == ()
        assert found.missing_messages == (), path
        assert run.force_waveform.sample[0] == 0
        assert run.force_waveform.time_ns[0] >= run.truth["begin_ns"]
    assert (np.diff(_blocks(graph)) > 0.99 * BLOCK_NS).all()


@pytest.mark.ros
@pytest.mark.parametrize("factor", [0.5, 2.0])
def test_a_pace_that_is_not_that_of_the_clock_is_reported_and_not_followed(
    graph: Graph, factor: float
) -> None:
    graph.listen("force_waveform")
    graph.fake_twin(mode="live", max_age=5.0, speed_factor=factor)
    with LiveTrain(graph):
        graph.until(
            lambda: graph.statuses("twin") and "at another pace" in graph.statuses("twin")[-1].message,
            "the word about the pace",
        )
        _more_blocks(graph, 5)
        begin = len(_blocks(graph))
        _more_blocks(graph, 50)
        assert (np.diff(_blocks(graph)[begin:]) == BLOCK_NS).all()
        assert f"than speed_factor = {factor:g}" in graph.statuses("twin")[-1].message


@pytest.mark.ros
def test_two_clocks_of_one_load_are_reported(graph: Graph) -> None:
    graph.fake_twin(mode="live", max_age=5.0)
    with LiveTrain(graph, shaft_ahead=3.2):
        graph.until(
            lambda: graph.statuses("twin") and "have two clocks" in graph.statuses("twin")[-1].message,
            "the word about two clocks",
        )
    assert re.search(r"load/shaft is stamped 3\.(19|20)", graph.statuses("twin")[-1].message)
