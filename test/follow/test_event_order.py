"""Entry and exit are told apart by how the box moves, whichever of them is louder."""

from __future__ import annotations

import numpy as np
import pytest

from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.descriptors import AXES
from beardyn_core.follow.event_order import CONTRASTS, WAY, order_of_events
from beardyn_core.monitor.chain import Stretch
from beardyn_core.monitor.severity import spacing_of

PLATE = NamePlate(name="axlebox", roller_count=17, roller_diameter=26.7e-3, pitch_diameter=185e-3)
RATE, SPEED = 25_600.0, 18.0  # [Hz]


def ridden(
    part: str, width: float, louder_exit: bool, seed: int = 0, events: bool = True
) -> dict[str, float]:
    """A spall of a width: bursts at entry and exit, and a box that sinks between them."""
    random = np.random.default_rng(seed)
    time = np.arange(int(1.5 * RATE)) / RATE
    order = getattr(PLATE.frequencies, {"cup": "bpfo", "cone": "bpfi"}[part])
    spacing = spacing_of(part, PLATE)
    angle = 2.0 * np.pi * SPEED * time
    way = np.mod(angle * order / (2.0 * np.pi), 1.0) * spacing
    # entry at 0, exit at the width: the box is lower between them, once or twice over
    depth = (way < np.mod(width, spacing)).astype(float)
    line = np.fft.rfft(depth)
    frequency = np.fft.rfftfreq(len(time), 1.0 / RATE)
    sunk = np.fft.irfft(
        line * (2.0 * np.pi * frequency) ** 2 * np.exp(-((frequency / 1000.0) ** 4)), len(time)
    )
    shaken = 0.02 * sunk / max(float(sunk.std()), 1e-9) + 0.002 * random.normal(size=len(time))
    if events:
        for place, height in ((0.0, 1.0), (np.mod(width, spacing), 1.4 if louder_exit else 0.7)):
            since = np.mod(way - place, spacing)
            shaken += height * np.exp(-since / 0.4e-3) * np.sin(2.0 * np.pi * 5000.0 * time)
    axes = 1e-4 * random.normal(size=(len(time), 3))
    axes[:, 2] += shaken
    return order_of_events(Stretch(RATE, axes, angle, float("nan"), 0), part, order, PLATE, AXES)


@pytest.mark.parametrize("louder_exit", [False, True])
@pytest.mark.parametrize(("part", "narrow"), [("cup", 6e-3), ("cup", 12e-3), ("cone", 5e-3), ("cone", 9e-3)])
def test_contrasts_turn_their_sign_from_a_narrow_spall_to_the_wide_one_that_looks_alike(
    part: str, narrow: float, louder_exit: bool
) -> None:
    wide = spacing_of(part, PLATE) - narrow
    one, other = (ridden(part, width, louder_exit) for width in (narrow, wide))
    for found in (one, other):
        assert found[WAY] == pytest.approx(narrow, abs=0.6e-3)
    contrasts = np.array([[each[name] for name in CONTRASTS] for each in (one, other)])
    assert np.corrcoef(contrasts)[0, 1] < -0.8


def test_order_of_events_does_not_hang_on_which_one_is_louder() -> None:
    first, second = (ridden("cup", 8e-3, louder) for louder in (False, True))
    contrasts = np.array([[each[name] for name in CONTRASTS] for each in (first, second)])
    assert np.corrcoef(contrasts)[0, 1] > 0.8


def test_silence_and_few_passages_say_nothing_of_an_order() -> None:
    time = np.arange(2000) / RATE
    silent = Stretch(RATE, np.zeros((2000, 3)), 2.0 * np.pi * 300.0 * time, float("nan"), 0)
    slow = Stretch(RATE, np.ones((2000, 3)), 2.0 * np.pi * time, float("nan"), 0)
    for stretch in (silent, slow):
        assert set(order_of_events(stretch, "cup", 7.3, PLATE, AXES).values()) == {0.0}


def test_an_accelerometer_without_a_vertical_axis_says_nothing_of_an_order() -> None:
    time = np.arange(int(RATE)) / RATE
    stretch = Stretch(RATE, np.random.default_rng(0).normal(size=(len(time), 1)), 2.0 * np.pi * SPEED * time,
                      float("nan"), 0)  # fmt: skip
    assert set(order_of_events(stretch, "cup", 7.3, PLATE, ("x",)).values()) == {0.0}
