"""A trend alarms once and stays over files; legs of a shunting train are put together."""

import json

import numpy as np
import pytest

import beardyn_core as bd
from beardyn_core.base.errors import InputError
from beardyn_core.cli.main import main
from beardyn_core.measured.trending import read_memory, remember
from beardyn_core.monitor.rotation_segments import turning_legs
from beardyn_core.monitor.streaming import Monitor
from beardyn_core.monitor.trend import ALARM, LEARNING, STEADY, Trend, record_levels
from test.fault_signals import ORDERS, RATE, ROLLERS, fault_signal, feed_monitor


def _states(trend, levels):
    return [trend.take(each, float(k)) for k, each in enumerate(levels)]


def _levels(seed, records, rise=0.0, start=0):
    levels = np.random.default_rng(seed).normal(20.0, 1.0, (records, 1, 5))
    levels[start:, :, 2:4] += rise
    return levels


def test_trend_learns_alarms_and_stays():
    points = _states(Trend(("z",)), _levels(1, 300, rise=10.0, start=200))
    states = [point.state for point in points]
    assert states[:49] == [LEARNING] * 49
    assert set(states[49:200]) == {STEADY}
    assert states[202:].index(ALARM) <= 3
    assert set(states[206:]) == {ALARM}
    assert points[-1].since == pytest.approx(203.0, abs=2.0)
    assert points[-1].rise == pytest.approx(10.0, abs=1.5)


def test_single_knocks_and_one_loud_band_are_no_alarm():
    levels = _levels(2, 300)
    levels[100::20] += 30.0
    levels[:, :, 0][200:] += 10.0
    assert ALARM not in {point.state for point in _states(Trend(("z",)), levels)}


def test_alarm_ends_when_the_cause_is_long_gone():
    levels = _levels(3, 400, rise=10.0, start=200)
    levels[250:, :, 2:4] -= 10.0
    states = [point.state for point in _states(Trend(("z",)), levels)]
    assert states[300] == ALARM
    assert states[-1] == STEADY


def test_baseline_follows_a_bearing_that_runs_in_but_not_one_that_wears():
    levels = _levels(4, 600)
    levels -= np.linspace(0.0, 10.0, 300)[np.minimum(np.arange(600), 299)][:, None, None]
    levels[400:] += 8.0
    states = [point.state for point in _states(Trend(("z",)), levels)]
    assert set(states[50:400]) == {STEADY}
    assert states[-1] == ALARM


def test_memory_goes_on_as_if_there_had_been_no_break(tmp_path):
    levels = _levels(5, 260, rise=9.0, start=200)
    whole = _states(Trend(("z",)), levels)
    first = Trend(("z",))
    _states(first, levels[:230])
    remember(first, tmp_path / "memory.json")
    second = read_memory(tmp_path / "memory.json")
    assert second is not None
    rest = [second.take(each, 230.0 + k) for k, each in enumerate(levels[230:])]
    assert [point.state for point in rest] == [point.state for point in whole[230:]]
    assert rest[-1].since == whole[-1].since
    (tmp_path / "other.json").write_text("{}", encoding="utf-8")
    with pytest.raises(InputError, match=r"other\.json: is no memory of a trend"):
        read_memory(tmp_path / "other.json")


def test_levels_are_the_power_in_their_bands():
    time = np.arange(25_600) / 25_600.0
    tone = 3.0 * np.sqrt(2.0) * np.sin(2 * np.pi * 3000.0 * time)
    levels = record_levels(tone[:, None], 25_600.0)
    assert levels[0, 2] == pytest.approx(20 * np.log10(3.0), abs=0.01)
    assert levels[0, 0] < -60.0
    assert np.isnan(record_levels(tone[::2, None], 12_800.0)[0, 4])


def test_command_watches_short_records_and_remembers(tmp_path, capsys):
    random = np.random.default_rng(6)
    files = []
    for number in range(70):
        files.append(tmp_path / f"acc_{number:03d}.csv")
        loud = 4.0 if number >= 60 else 1.0
        np.savetxt(files[-1], loud * random.normal(size=(1280, 2)), delimiter=",", fmt="%.3f")
    options = [
        "--trend",
        "--channels",
        "x=1,z=2",
        "--unit",
        "g",
        "--rate-hz",
        "12800",
        "--file-interval-s",
        "10",
    ]
    memory = ["--memory", str(tmp_path / "memory.json")]
    assert main(["monitor", *map(str, files[:55]), *options, *memory]) == 0
    assert "steady" in capsys.readouterr().out.splitlines()[-1]
    keys = {"channels": "x=1,z=2", "unit": "g", "rate_Hz": 12_800, "file_interval_s": 10}
    assert len(bd.trend(files[:55], memory=tmp_path / "python.json", **keys)) == 55
    assert (tmp_path / "python.json").read_bytes() == (tmp_path / "memory.json").read_bytes()
    assert main(["monitor", *map(str, files[55:]), *options, *memory, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)["trend"]
    assert found[0]["state"] == "steady"
    assert found[-1]["state"] == "alarm"
    assert found[-1]["rise_dB"] == pytest.approx(12.0, abs=1.5)


def test_legs_turn_forwards_and_keep_the_angle_of_the_wheel():
    rate = 1000.0
    time = np.arange(20_000) / rate
    angle = 2 * np.pi * np.where(time < 9.0, time, np.where(time < 11.0, 9.0, 9.0 - (time - 11.0)))
    legs = turning_legs(angle, rate, enough=12.0, most=60.0)
    assert legs.count == 2
    assert (np.diff(legs.angle) > 0.0).all()
    assert legs.revolutions == pytest.approx(17.5, abs=1.0)
    turned = (legs.angle - angle[legs.samples]) / (2 * np.pi)
    assert np.allclose(turned, np.rint(turned), atol=1e-6)


def test_steady_turning_is_one_leg():
    angle = np.linspace(0.0, 200.0, 5000)
    legs = turning_legs(angle, 1000.0, enough=15.0, most=60.0)
    assert (legs.count, legs.ended) == (1, False)
    assert np.array_equal(legs.samples, np.arange(5000))


def test_a_shunting_train_gets_a_verdict_and_a_standing_one_waits():
    time, angle, acceleration = fault_signal("cup", 31, duration=0.45)
    back = (time + 0.45, 2 * angle[-1] - angle[::-1], acceleration[::-1])
    stands = np.arange(int(RATE)) / RATE + 0.9
    rest = np.full(len(stands), 0.0)
    noise = np.random.default_rng(1).normal(size=(len(stands), 3))
    there = np.concatenate((time, back[0], stands))
    turned = np.concatenate((angle, angle[::-1], rest))
    received = np.concatenate((acceleration, acceleration[::-1], noise))
    monitor = Monitor(ORDERS, ROLLERS)
    verdicts = [result.verdict for result in feed_monitor(monitor, (there, turned, received))]
    assert "cup" in verdicts
    assert verdicts[-1] == "waiting"
