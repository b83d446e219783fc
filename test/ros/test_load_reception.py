"""The load of a topic as a known load: its mean over a stretch, and what is no load."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.base.errors import InputError
from beardyn_core.record.load_stream import encode_load
from beardyn_core.scene.load import LoadHistory
from beardyn_ros.live_load import encode_wrench
from beardyn_ros.load_reception import KEPT_S, LoadReception


def block(begin_s: float, force: float, count: int = 20) -> bytes:
    time_ns = np.round(1e9 * (begin_s + 0.01 * np.arange(count))).astype(np.int64)
    wrench = np.zeros((count, 6))
    wrench[:, 2] = force
    return encode_load(LoadHistory(time_ns, wrench, np.full(count, 120.0), np.zeros((count, 3))), 0)


def test_the_load_of_a_stretch_is_the_mean_of_its_samples() -> None:
    reception = LoadReception("topic:5%")
    for begin, force in ((0.0, 60e3), (0.2, 70e3), (0.4, 90e3)):
        reception.handlers["load/blocks"](block(begin, force))
    load = reception.load_between(0, 395_000_000)
    assert load is not None
    assert load.value == pytest.approx(65e3)
    assert load.half_width == pytest.approx(0.05 * 65e3)
    assert not load.assumed
    assert not reception.doubt


def test_single_wrenches_are_taken_and_an_uncertainty_that_is_not_stated_is_assumed() -> None:
    reception = LoadReception("topic")
    for k, force in enumerate((60e3, 62e3)):
        reception.handlers["load/wrench"](encode_wrench(np.array([0, 0, force, 0, 0, 0.0]), k * 10_000_000))
    load = reception.load_between(0, 1_000_000_000)
    assert load is not None
    assert load.value == pytest.approx(61e3)
    assert "assumed" in load.assumed


@pytest.mark.parametrize(
    ("force", "words"), [(-70e3, "on average"), (70.0, "on average"), (np.nan, "no sample")]
)
def test_what_is_no_load_of_a_journal_is_not_known_and_is_said(force: float, words: str) -> None:
    reception = LoadReception("topic")
    assert reception.load_between(0, 1) is None
    assert "no load comes" in reception.doubt
    reception.handlers["load/blocks"](block(0.0, force))
    assert reception.load_between(0, 1_000_000_000) is None
    assert words in reception.doubt


def test_old_samples_are_forgotten() -> None:
    reception = LoadReception("topic")
    for begin in np.arange(0.0, 2.0 * KEPT_S, 0.2):
        reception.handlers["load/blocks"](block(float(begin), 70e3))
    assert reception.load_between(0, 1_000_000_000) is None
    assert reception.load_between(round(1e9 * 1.5 * KEPT_S), round(1e9 * 2 * KEPT_S)) is not None


@pytest.mark.parametrize("text", ["topic:0%", "topic:90%", "topic:5", "topics"])
def test_a_text_that_makes_no_sense_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        LoadReception(text)
