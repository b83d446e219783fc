"""Lines that fit two speeds make neither of them certain."""

import re

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import beardyn_core as bd
from beardyn_core.monitor.speed import speed_from_vibration
from beardyn_core.monitor.speed_lines import SpeedSettings, searched_signals
from beardyn_core.monitor.speed_rivals import Shaft, find_alternatives
from test.examples import examples

PLATE = bd.name_plate("6205")
RATE = 8000.0
SECONDS = 2.5


def _signal(strikes, lines=(), seed=1, strength=15.0):
    """Ringing strikes at a rate, and lines, both in Hz, in noise."""
    random = np.random.default_rng(seed)
    time = np.arange(int(SECONDS * RATE)) / RATE
    hits = np.diff(np.floor(strikes * time), prepend=0.0)
    decay = np.arange(150) / RATE
    ringing = np.exp(-900 * decay) * np.sin(2 * np.pi * 2900 * decay)
    signal = random.normal(size=len(time)) + strength * np.convolve(hits, ringing)[: len(time)]
    for line in lines:
        signal += 0.6 * np.sin(2 * np.pi * line * time + random.uniform(0, 6))
    return signal


def _alternatives(signal, frequency, lowest, highest):
    """Weigh other speeds beside one at which the shaft is taken to turn."""
    searched = searched_signals(signal[:, None], RATE, 13.0 * highest, SpeedSettings())
    window = 20.0 / lowest
    middles = np.array([0.5 * window, SECONDS - 0.5 * window])
    shaft = Shaft(
        lambda time: frequency * time, middles, 0.95 * window * frequency, frequency, lowest, highest
    )
    return find_alternatives(searched, shaft, (PLATE.frequencies,), (PLATE.name,), SpeedSettings())


@settings(max_examples=examples(12), deadline=None)
@given(
    row=st.sampled_from([("bpfo", k) for k in (3, 4, 5)] + [("bpfi", k) for k in (4, 5, 6, 7)]),
    speed=st.floats(15.0, 30.0),
    seed=st.integers(0, 100),
)
def test_strikes_alone_never_leave_one_speed(row, speed, seed):
    part, order = row
    strikes = getattr(PLATE.frequencies, part) * speed
    taken = strikes / order  # the strikes are taken for an order of the shaft
    low, high = 0.97 * min(speed, taken), 1.03 * max(speed, taken)
    signal = _signal(strikes, seed=seed)
    for frequency in (taken, speed):
        found = _alternatives(signal, frequency, low, high)
        assert found.rival is not None
        assert found.rival.lead < SpeedSettings().least_lead
        assert found.spread > 0.05


@settings(max_examples=examples(12), deadline=None)
@given(
    speed=st.floats(15.0, 30.0),
    orders=st.sampled_from([(1, 2, 3, 4, 5), (1, 2, 4, 5, 7, 8), (1, 2, 3, 5, 6)]),
    seed=st.integers(0, 100),
)
def test_lines_of_the_shaft_beside_the_strikes_leave_one_speed(speed, orders, seed):
    # an order at 50 or 60 Hz may be the mains
    assume(all(abs(mains / speed - round(mains / speed)) > 0.1 for mains in (50.0, 60.0)))
    signal = _signal(PLATE.frequencies.bpfo * speed, [order * speed for order in orders], seed)
    found = _alternatives(signal, speed, 0.8 * speed, 1.25 * speed)
    assert found.rival is None, found.rival
    assert found.reach < 0.035


@pytest.mark.parametrize(
    ("part", "speed"), [("bpfo", 26.0), pytest.param("bpfi", 26.0, marks=pytest.mark.slow)]
)
def test_a_speed_from_strikes_alone_is_refused_with_both_speeds(part, speed):
    strikes = getattr(PLATE.frequencies, part) * speed
    track = speed_from_vibration(
        _signal(strikes, seed=3), RATE, 20.0, 34.0, (PLATE.frequencies,), names=("6205",)
    )
    assert not track.certain
    named = [float(each) for each in re.findall(r"([\d.]+) rpm", track.reason)]
    assert len(set(named)) == 2, track.reason
    assert "the lines at" in track.reason
    assert "give a range that holds only one of them" in track.reason
    assert track.uncertainty > abs(named[0] / named[1] - 1.0) * 0.9


def test_a_speed_that_is_certain_carries_its_whole_interval():
    signal = _signal(PLATE.frequencies.bpfo * 27.0, [27.0 * order for order in (1, 2, 4, 5)], seed=5)
    track = speed_from_vibration(signal, RATE, 22.0, 33.0, (PLATE.frequencies,))
    assert track.certain, track.reason
    low, high = track.interval
    assert ((low < 27.0) & (high > 27.0)).all()
    assert track.uncertainty >= np.max(0.5 * (high - low) / track.frequency) - 1e-12
    assert track.uncertainty < 0.04
    assert not speed_from_vibration(signal[:300], RATE, 22.0, 33.0).uncertainty < np.inf
