"""The monitor finds synthetic faults through noise, speed changes and slip, and is silent without."""

import itertools

import numpy as np
import pytest

from beardyn_core.monitor.chain import REFERENCE, MonitorResult, MonitorSettings, Stretch
from beardyn_core.monitor.streaming import Monitor, fast_length
from test.fault_signals import ORDERS, RATE, ROLLERS, SETTINGS, fault_signal, feed_monitor


def _analyse(*args, **kwargs):
    time, angle, acceleration = fault_signal(*args, **kwargs)
    end_ns = round(time[-1] * 1e9)
    return REFERENCE(Stretch(RATE, acceleration, angle, 8e4, end_ns), ORDERS, ROLLERS, SETTINGS)


@pytest.mark.parametrize("fault", ["cup", "cone", "roller"])
@pytest.mark.parametrize(
    "situation",
    [
        {},
        {"duration": 1.0},
        {"speed": (17.0, 22.0)},
        {"speed": (33.0, 33.0)},
        {"slip": 0.007},
        {"slip": -0.007},
        {"noise": 2.0},
        {"coloured": True},
    ],
)
def test_fault_is_found_within_a_percent_of_its_frequency(fault, situation):
    expected = {"cup": ORDERS.bpfo, "cone": ORDERS.bpfi, "roller": 2 * ORDERS.bsf}[fault]
    speed = np.mean(situation.get("speed", (19.2, 19.2)))
    for seed in (100, 101):
        result = _analyse(fault, seed, **situation)
        assert result.verdict == fault, result.reason
        assert result.expected_order == pytest.approx(expected)
        assert result.fault_order == pytest.approx(expected * (1 + situation.get("slip", 0.0)), rel=1e-3)
        assert result.fault_frequency == pytest.approx(result.fault_order * speed, rel=1e-3)
        assert result.score == max(result.scores) >= result.threshold
        # in the logarithm of the envelope strong lines are some 4 dB less strong than in its square
        assert result.score > sorted(result.scores)[1] + 3.0


def test_cone_fault_shows_sidebands_at_shaft_speed_and_roller_fault_at_cage_speed():
    cone = {line.name: line for line in _analyse("cone", 5).lines}
    assert cone["BPFI - shaft"].order == pytest.approx(ORDERS.bpfi - 1.0, abs=0.01)
    assert cone["BPFI + shaft"].order == pytest.approx(ORDERS.bpfi + 1.0, abs=0.01)
    roller = {line.name: line for line in _analyse("roller", 5).lines}
    assert roller["2 BSF - FTF"].order == pytest.approx(2 * ORDERS.bsf - ORDERS.ftf, abs=0.01)
    assert roller["2 BSF + FTF"].order == pytest.approx(2 * ORDERS.bsf + ORDERS.ftf, abs=0.01)
    assert not any("shaft" in line.name for line in _analyse("cup", 5).lines)


def test_strongest_line_of_a_cup_fault_is_bpfo_and_10_db_above_the_healthy_run():
    fault, healthy = _analyse("cup", 6), _analyse(None, 6)
    multiple = fault.strongest_order / ORDERS.bpfo
    assert multiple == pytest.approx(max(1, round(multiple)), rel=0.01)
    assert fault.score > healthy.score + 10.0
    assert fault.kurtosis > healthy.kurtosis


NOISES = [{}, {"duration": 1.0}, {"coloured": True}, {"coloured": True, "speed": (10.0, 30.0)}]


def assert_no_false_alarm(situation, seeds):
    results = [_analyse(None, seed, **situation) for seed in seeds]
    assert {result.verdict for result in results} == {"healthy"}
    # the threshold has room: not one of the candidates came near with lines that agree
    assert all(result.score < result.threshold for result in results)


@pytest.mark.parametrize("situation", NOISES)
def test_no_false_alarm_on_noise(situation):
    assert_no_false_alarm(situation, range(1000, 1005))


@pytest.mark.slow
@pytest.mark.parametrize("situation", NOISES)
def test_no_false_alarm_on_much_noise(situation):
    assert_no_false_alarm(situation, range(1000, 1060))


def test_impulses_that_match_no_fault_frequency_are_unexplained():
    _, angle, acceleration = fault_signal("cup", 7, slip=0.12)
    result = REFERENCE(Stretch(RATE, acceleration, angle, 8e4, 0), ORDERS, ROLLERS, SETTINGS)
    assert result.strongest_level > 20.0
    assert result.verdict == "unexplained"
    assert result.comb_order == pytest.approx(1.12 * ORDERS.bpfo, rel=2e-3)


def test_stream_waits_then_finds_the_fault_through_a_speed_change():
    monitor = Monitor(ORDERS, ROLLERS)
    results = feed_monitor(monitor, fault_signal("cup", 8, duration=4.0, speed=(18.0, 22.0)))
    verdicts = [result.verdict for result in results]
    assert verdicts[0] == "waiting"
    assert set(verdicts[2:]) == {"cup"}
    assert len(results) == pytest.approx(4.0 / SETTINGS.interval, abs=1)
    assert results[-1].load == pytest.approx(8e4)
    assert results[-1].revolutions == pytest.approx(SETTINGS.window_revolutions, rel=0.01)
    assert (monitor.lost, monitor.refused) == (0, 0)


def test_result_does_not_depend_on_how_the_stream_is_cut():
    signal = fault_signal("cone", 9, duration=2.0)
    one = feed_monitor(Monitor(ORDERS, ROLLERS), signal, block=512)[-1]
    two = feed_monitor(Monitor(ORDERS, ROLLERS), signal, block=256)[-1]
    assert one.end_ns == pytest.approx(two.end_ns, abs=20_000_000)
    assert one.verdict == two.verdict == "cone"
    assert one.fault_order == pytest.approx(two.fault_order, rel=1e-3)


def test_gap_is_counted_and_what_is_before_it_is_dropped():
    monitor = Monitor(ORDERS, ROLLERS)
    results = feed_monitor(monitor, fault_signal("cup", 10, duration=3.0), skip=(50,))
    assert monitor.lost == 1
    assert results[-1].verdict == "cup"
    assert results[-1].revolutions < 2.0 * 19.2


def test_nan_and_time_that_runs_back_are_refused():
    monitor = Monitor(ORDERS, ROLLERS)
    time_ns = np.arange(512, dtype=np.int64) * 39_062
    monitor.push_vibration(time_ns, np.zeros((512, 3)))
    monitor.push_vibration(time_ns, np.zeros((512, 3)))
    monitor.push_vibration(time_ns + 20_000_000, np.full((512, 3), np.nan))
    monitor.push_shaft(time_ns[::64], np.arange(8.0))
    monitor.push_shaft(time_ns[::64], np.arange(8.0))
    assert monitor.refused == 3


@pytest.mark.parametrize("late", ["vibration", "shaft", "both"])
@pytest.mark.parametrize("jump", [3600.0, -3600.0])
def test_after_one_block_that_was_stamped_wrong_the_monitor_begins_anew(late, jump):
    monitor = Monitor(ORDERS, ROLLERS)
    time, angle, acceleration = fault_signal("cup", 1, duration=8.0)
    stamps = 7_200_000_000_000 + np.round(time * 1e9).astype(np.int64)
    verdicts = []
    for number, part in enumerate(np.array_split(np.arange(len(time)), 400)):
        vibration, shaft = stamps[part], stamps[part][::64]
        shift = round(jump * 1e9) if number == 200 else 0
        monitor.push_vibration(vibration + (shift if late != "shaft" else 0), acceleration[part])
        monitor.push_shaft(shaft + (shift if late != "vibration" else 0), angle[part][::64])
        result = monitor.update()
        if result is not None and number > 210:
            verdicts.append(result)
    assert verdicts[-1].verdict == "cup"
    assert verdicts[-1].end_ns > stamps[int(0.9 * len(stamps))]
    assert monitor.restarts == (1 if jump > 0.0 and late != "both" else monitor.restarts)
    assert monitor.restarts <= 2
    assert monitor.refused <= 10
    assert (monitor.restarts > 0) == (jump > 0.0)


def test_a_monitor_says_that_the_time_jumped_back():
    monitor = Monitor(ORDERS, ROLLERS)
    time_ns = np.arange(512, dtype=np.int64) * 39_062
    monitor.push_vibration(time_ns + 10**12, np.zeros((512, 3)))
    for number in range(6):
        monitor.push_vibration(time_ns + 20_000_000 * number, np.zeros((512, 3)))
    assert monitor.restarts == 1
    assert "the time jumped back 1 times, and the monitor began anew" in monitor.result().reason


def test_standstill_keeps_waiting_with_bounded_memory():
    monitor = Monitor(ORDERS, ROLLERS, settings=MonitorSettings(longest_window=1.0))
    time = np.arange(int(4 * RATE)) / RATE
    results = feed_monitor(monitor, (time, np.zeros_like(time), np.zeros((len(time), 3))))
    assert {result.verdict for result in results} == {"waiting"}
    assert len(monitor._vibration) <= 1.6 * RATE


@pytest.mark.parametrize("stream", ["_vibration", "_shaft", "_load"])
def test_a_stream_that_the_others_do_not_follow_takes_bounded_memory(stream):
    monitor = Monitor(ORDERS, ROLLERS, settings=MonitorSettings(longest_window=1.0))
    for begin in range(0, 10 * 1000, 20):
        time_ns = (begin + np.arange(20)) * 1_000_000
        if stream == "_vibration":
            monitor.push_vibration(time_ns, np.zeros((20, 3)))
        elif stream == "_shaft":
            monitor.push_shaft(time_ns, np.zeros(20))
        else:
            monitor.push_load(time_ns, np.ones(20))
        assert monitor.update() is None
        assert len(getattr(monitor, stream)) <= 2021


def test_running_backwards_is_analysed_alike():
    time, angle, acceleration = fault_signal("cup", 11, duration=2.0)
    assert feed_monitor(Monitor(ORDERS, ROLLERS), (time, -angle, acceleration))[-1].verdict == "cup"


def test_another_algorithm_takes_the_place_of_the_example():
    def mine(stretch, orders, roller_count, settings):
        return MonitorResult("roller", f"{len(stretch.acceleration)}", stretch.end_ns)

    results = feed_monitor(Monitor(ORDERS, ROLLERS, algorithm=mine), fault_signal(None, 12, duration=2.0))
    assert results[-1].verdict == "roller"
    assert all(two.end_ns > one.end_ns for one, two in itertools.pairwise(results))


@pytest.mark.parametrize("count", [5000, 20_011, 80_123, 131_071])
def test_a_window_is_cut_to_a_length_with_a_fast_transform(count: int) -> None:
    length = fast_length(count)
    assert 0.984 * count <= length <= count
    rest = length
    for prime in (2, 3, 5, 7, 11):
        while rest % prime == 0:
            rest //= prime
    assert rest == 1
    assert fast_length(0) == 0
