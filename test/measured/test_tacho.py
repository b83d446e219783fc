"""The level of a tachometer's pulses is found among spikes, and what it does not give is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as some

import beardyn_core as bd
from beardyn_core.measured.tacho import PulseLevels, Tacho, judge_pulses
from test.examples import examples
from test.measured.files import noise, problems

RATE = 6000.0
TIME = np.arange(round(20 * RATE)) / RATE
SHAFT_HZ = 25.0


def pulses(duty: float = 0.1, low: float = 0.0, high: float = 5.0) -> Any:
    noise_in_it = np.random.default_rng(2).normal(0.0, 0.01 * abs(high - low), len(TIME))
    return np.where(duty > (SHAFT_HZ * TIME) % 1.0, high, low) + noise_in_it


def judged(volts: Any, per_turn: int = 1) -> Tacho:
    levels = PulseLevels()
    parts = [(t, v) for t, v in zip(np.array_split(TIME, 3), np.array_split(volts, 3), strict=True)]
    for _, values in parts:
        levels.take(values)

    def feed(take: Any) -> None:
        for time, values in parts:
            take(np.round(time * 1e9).astype(np.int64), values)

    found = judge_pulses(levels, None, per_turn, feed)
    assert found is not None
    return found


@given(
    spikes=some.integers(0, 60), reach=some.sampled_from([-200.0, -20.0, 20.0, 200.0]),
    duty=some.sampled_from([0.02, 0.1, 0.5, 0.9]), upside_down=some.booleans(), seed=some.integers(0, 99),
)  # fmt: skip
@settings(max_examples=examples(90), deadline=None)
def test_spikes_do_not_move_the_level(
    spikes: int, reach: float, duty: float, upside_down: bool, seed: int
) -> None:
    volts = pulses(duty, 5.0, 0.0) if upside_down else pulses(duty)
    volts[np.random.default_rng(seed).integers(0, len(volts), spikes)] = reach
    found = judged(volts).pulses
    assert abs(found.count - SHAFT_HZ * TIME[-1]) <= 0.01 * found.count + 1
    assert found.slowest == pytest.approx(2.0 * np.pi * SHAFT_HZ, rel=0.03)
    assert found.fastest == pytest.approx(2.0 * np.pi * SHAFT_HZ, rel=0.03)


def measured(folder: Path, volts: Any) -> Path:
    np.savez(folder / "a.npz", a=noise(len(TIME))[:, 0], tacho=volts, fs=RATE)
    return folder / "a.npz"


OPTIONS = {"channels": "z=a", "unit": "g", "tacho_channel": "tacho"}


def test_the_speed_is_told_by_its_range_and_spikes_change_nothing(tmp_path: Path) -> None:
    volts = pulses()
    volts[np.random.default_rng(1).integers(0, len(volts), 40)] = 20.0
    run = bd.read_measured(measured(tmp_path, volts), **OPTIONS)
    np.testing.assert_allclose(run.shaft.speed, 2.0 * np.pi * SHAFT_HZ, rtol=0.02)
    (told,) = [each for each in run.measured["understood"] if "the shaft turns with" in each]
    assert "rpm by the 500 pulses of tacho, known for 19.96 of 20 s" in told or "the 499 pulses" in told
    assert not run.measured["warnings"]


@pytest.mark.parametrize(
    ("lost", "sentence"),
    [
        ((TIME > 4.0), "no pulses from 4 to 20 s"),
        ((TIME < 15.0), "no pulses from 0 to 15 s"),
        ((TIME > 8.0) & (TIME < 12.0), "no pulses from 8 to 12 s"),
    ],
    ids=["lost", "late", "hole"],
)
def test_the_loss_of_the_tacho_is_told_and_no_speed_is_invented(
    lost: Any, sentence: str, tmp_path: Path
) -> None:
    volts = pulses()
    volts[lost] = 0.0
    with pytest.warns(UserWarning, match=sentence):
        run = bd.read_measured(measured(tmp_path, volts), **OPTIONS)
    inside = np.interp(run.shaft.time, TIME, lost.astype(float)) > 0.0
    assert inside.sum() <= 2.0 / SHAFT_HZ * 400.0
    np.testing.assert_allclose(run.shaft.speed, 2.0 * np.pi * SHAFT_HZ, rtol=0.02)


def test_a_monitor_refuses_a_tacho_without_pulses(tmp_path: Path) -> None:
    from beardyn_core.measured.options import Reading
    from beardyn_core.measured.survey import survey

    volts = np.where(TIME > 10.0, 5.0, 0.0)
    path = measured(tmp_path, volts)
    with pytest.raises(
        bd.InputError, match="has 1 pulses; the speed of the shaft is not known, and a monitor"
    ):
        survey([path], Reading.of(**OPTIONS), needs_speed=True)
    assert any(
        "every sample is 0; it has no pulses" in e for e in problems(measured(tmp_path, 0 * TIME), **OPTIONS)
    )
