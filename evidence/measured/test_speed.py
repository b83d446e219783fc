"""The speed of a record that is known is told with an interval that holds it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from beardyn_core.config import load_plate
from evidence.measured.cases import MFPT, Listening, Record
from evidence.measured.speed import Told, told_of


def test_a_wrong_speed_is_not_covered() -> None:
    assert Told(True, 0.01, 0.022).covered
    assert not Told(True, 0.03, 0.022).covered


def test_harmonics_of_a_shaft_tell_its_speed_and_noise_tells_none() -> None:
    rate, speed = 12_000.0, 25.0
    time = np.arange(int(2.0 * rate)) / rate
    noise = np.random.default_rng(2).normal(size=len(time))
    hum = sum(np.cos(2.0 * np.pi * order * speed * time + order) for order in range(1, 13))
    record = Record(MFPT, "made", Path("made.mat"), "")
    turning, still = (
        told_of(Listening(record, "", load_plate("NICE"), "", rate, speed, np.asarray(noise + loud * hum)))
        for loud in (0.3, 0.0)
    )
    assert turning.certain
    assert turning.covered
    assert not still.certain
