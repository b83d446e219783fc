"""The order of the passages is found near the nominal one, and passages are averaged by it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.descriptors import AXES, describe, names_of
from beardyn_core.follow.passage_profile import LAGS, profile_of
from beardyn_core.monitor.chain import Stretch
from beardyn_core.monitor.passage_order import REACH, find_passage_order
from beardyn_core.monitor.severity import spacing_of

RATE, SHAFT_HZ, SECONDS = 25_600.0, 19.0, 1.5
PLATE = NamePlate(name="axlebox", roller_count=17, roller_diameter=26.7e-3, pitch_diameter=185e-3)
TIME = np.arange(round(SECONDS * RATE)) / RATE
ANGLE = 2.0 * np.pi * SHAFT_HZ * TIME


def struck(order: float, shares: tuple[float, ...], noise: float = 0.05) -> Float:
    """Make bursts of 6 kHz at these shares of each passage, shape [sample, axis]."""
    passed = SHAFT_HZ * order * TIME
    bursts = np.zeros(len(TIME))
    for share in shares:
        away = ((passed - share + 0.5) % 1.0 - 0.5) / (SHAFT_HZ * order)
        bursts += np.exp(-0.5 * (away / 1.5e-4) ** 2)
    values = bursts * np.sin(2.0 * np.pi * 6000.0 * TIME)
    random = np.random.default_rng(1)
    return np.stack([values + noise * random.normal(size=len(TIME)) for _ in AXES], axis=1)


@settings(max_examples=15, deadline=None)
@given(shift=st.floats(-0.9 * REACH, 0.9 * REACH), part=st.sampled_from(["cup", "cone"]))
def test_order_is_found_to_a_twentieth_of_a_passage_in_a_stretch(shift: float, part: str) -> None:
    nominal = PLATE.frequencies.bpfo if part == "cup" else PLATE.frequencies.bpfi
    true = nominal * (1.0 + shift)
    found = find_passage_order(struck(true, (0.3, 0.5)), RATE, ANGLE, nominal)
    assert abs(found - true) * SHAFT_HZ * SECONDS < 0.05


def test_silence_leaves_the_nominal_order() -> None:
    assert find_passage_order(np.zeros((len(TIME), 1)), RATE, ANGLE, 7.3) == 7.3


@pytest.mark.parametrize("shift", [-0.004, 0.002, 0.006])
def test_descriptors_of_the_passages_do_not_change_with_a_shift_of_the_order(shift: float) -> None:
    orders = PLATE.frequencies

    def described(order: float) -> Float:
        return describe(Stretch(RATE, struck(order, (0.3, 0.5)), ANGLE, np.nan, 0), orders, PLATE, AXES)

    one, other = described(orders.bpfo), described(orders.bpfo * (1.0 + shift))
    names = names_of(AXES)
    harmonics = [names.index(f"harmonic_high_{k}") for k in range(1, 7)]
    np.testing.assert_allclose(one[harmonics], other[harmonics], atol=1.5)  # dB; 10 and more at the nominal


@pytest.mark.parametrize("part", ["cup", "cone"])
@pytest.mark.parametrize("way", [3e-3, 6e-3, 10e-3, 13e-3])
def test_mean_passage_repeats_at_the_way_between_its_events(way: float, part: str) -> None:
    order = PLATE.frequencies.bpfo if part == "cup" else PLATE.frequencies.bpfi
    share = way / spacing_of(part, PLATE)
    stretch = Stretch(RATE, struck(order, (0.2, 0.2 + share), 0.01), ANGLE, np.nan, 0)
    found = profile_of(stretch, part, order, PLATE)
    inside = [lag for lag in LAGS if 2e-3 < lag < 0.5 * spacing_of(part, PLATE)]
    best = max(inside, key=lambda lag: found[f"repeat_high_envelope_{1e3 * lag:.1f}"])
    assert best == pytest.approx(way, abs=0.51e-3)
