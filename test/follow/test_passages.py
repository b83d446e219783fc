"""Harmonics of two bursts a passage follow the law of two slits, whatever the level."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.entry_exit_features import NAMES, WAYS, of_passages
from beardyn_core.monitor.chain import Stretch
from beardyn_core.monitor.severity import spacing_of

RATE, SHAFT_HZ, SECONDS = 25_600.0, 19.0, 1.5
PLATE = NamePlate(name="axlebox", roller_count=17, roller_diameter=26.7e-3, pitch_diameter=185e-3)
HARMONICS = range(1, 9)


def received(shares: tuple[float, ...], part: str = "cup") -> dict[str, float]:
    """Work out what a train of bursts of 6 kHz has, at these shares of each passage."""
    order = PLATE.frequencies.bpfo if part == "cup" else PLATE.frequencies.bpfi
    time = np.arange(round(SECONDS * RATE)) / RATE
    passed = SHAFT_HZ * order * time
    bursts = np.zeros(len(time))
    for share in shares:
        away = ((passed - share + 0.5) % 1.0 - 0.5) / (SHAFT_HZ * order)
        bursts += np.exp(-0.5 * (away / 2e-4) ** 2)
    noise = 1e-4 * np.random.default_rng(1).normal(size=len(time))
    signal: Float = bursts * np.sin(2.0 * np.pi * 6000.0 * time) + noise
    stretch = Stretch(RATE, signal[:, None], 2.0 * np.pi * SHAFT_HZ * time, np.nan, 0)
    return of_passages(stretch, part, order, PLATE)


@pytest.mark.parametrize("part", ["cup", "cone"])
@pytest.mark.parametrize("share", [0.15, 0.22, 0.31])
def test_harmonics_of_two_bursts_rise_and_fall_by_the_share_between(share: float, part: str) -> None:
    one, two = received((0.5,), part), received((0.5, 0.5 + share), part)
    gain = np.array([two[f"harmonic_high_{k}"] - one[f"harmonic_high_{k}"] for k in HARMONICS])
    law = np.abs(np.cos(np.pi * share * np.array(HARMONICS)))
    clear = law > 0.2
    off = gain[clear] - 20.0 * np.log10(law[clear])
    np.testing.assert_allclose(off, off.mean(), atol=0.3)
    assert (gain[law < 0.05] < off.mean() - 15.0).all()


def test_levels_do_not_matter_and_every_name_has_a_number() -> None:
    found = received((0.5, 0.7))
    assert tuple(found) == NAMES
    assert np.sum(10.0 ** (0.1 * np.array([found[f"harmonic_high_{k}"] for k in range(1, 25)]))) == (
        pytest.approx(1.0)
    )


def test_silence_has_no_numbers_that_are_none_but_of_echoes() -> None:
    time = np.arange(round(SECONDS * RATE)) / RATE
    silent = Stretch(RATE, np.zeros((len(time), 1)), 2.0 * np.pi * SHAFT_HZ * time, np.nan, 0)
    found = of_passages(silent, "cup", PLATE.frequencies.bpfo, PLATE)
    assert all(np.isfinite(value) for name, value in found.items() if name.startswith("harmonic"))


def test_ways_lie_within_the_distance_of_two_rollers() -> None:
    assert WAYS[-1] < 0.5 * spacing_of("cone", PLATE)
