"""A sensor that is not mounted as stated is recognised by what makes its signal familiar again."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.fft import irfft, rfft

from beardyn_core.base.arrays import Float
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.descriptors import AXES, FINE, band_levels, names_of, places_of
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.familiarity import familiarity_of
from beardyn_core.follow.mounting_search import cross_powers, mountings_of
from beardyn_core.monitor.chain import Stretch
from test.follow.synthetic import PLATE

RATE, SAMPLES = 6400.0, 6400
RINGS = (
    (420.0, (1.0, 0.1, 0.4)),
    (900.0, (0.3, 1.0, 0.0)),
    (1700.0, (0.1, 0.5, 1.0)),
)  # [Hz], along the axes


def heard(seed: int) -> Stretch:
    """Noise of a box with three modes, each with a direction of its own."""
    draw = np.random.default_rng(seed)
    frequency = np.arange(SAMPLES // 2 + 1) * RATE / SAMPLES
    found = 0.05 * draw.normal(size=(SAMPLES, 3))
    for ring, along in RINGS:
        mode = 1.0 / (1.0 + ((frequency / ring - ring / np.maximum(frequency, 1.0)) * 8.0) ** 2)
        excited = irfft(rfft(draw.normal(size=SAMPLES)) * mode, SAMPLES) * 10.0 ** (
            draw.normal(0.0, 1.0) / 20.0
        )
        found += excited[:, None] * np.array(along)
    turned: Float = 60.0 * np.arange(SAMPLES, dtype=float) / RATE
    return Stretch(RATE, found, turned, np.nan, 0)


@cache
def learnt() -> Estimator:
    """An estimator that knows the levels of such boxes, and nothing else of them."""
    names, rows = names_of(AXES), np.full((130, len(names_of(AXES))), np.nan)
    for k, row in enumerate(rows):
        for axis, signal in zip(AXES, (heard(k).acceleration).T, strict=True):
            levels = band_levels(signal - signal.mean(), RATE, FINE, 12)
            for frequency, level in levels.items():
                row[names.index(f"fine_{axis}_{frequency:.0f}")] = level
    box = places_of(AXES, "box")
    middle: Float = np.zeros(len(names))
    spread: Float = np.ones(len(names))
    middle[box], spread[box] = rows[:, box].mean(axis=0), rows[:, box].std(axis=0)
    standard = np.nan_to_num((rows - middle) / spread)
    familiar = familiarity_of(standard[:100], box).set_bound(standard[100:])
    plate = PLATE if isinstance(PLATE, NamePlate) else NamePlate.of(PLATE)
    return Estimator(plate, AXES, RATE, 1.0, middle, spread, familiar, familiar, {}, None, None, {})


def mounted(seed: int, matrix: Float) -> Stretch:
    """What a sensor hears whose axes are a matrix times those stated."""
    usual = heard(seed)
    return replace(usual, acceleration=usual.acceleration @ matrix.T)


def turn(degrees: float) -> Float:
    """Turn about x, from y to z."""
    cosine, sine = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])


def test_powers_of_bands_are_the_levels_that_an_estimator_hears() -> None:
    stretch = heard(1)
    powers = np.diagonal(cross_powers(stretch), axis1=1, axis2=2)
    for axis in range(3):
        signal = stretch.acceleration[:, axis]
        expected = list(band_levels(signal - signal.mean(), RATE, FINE, 12).values())
        np.testing.assert_allclose(10.0 * np.log10(powers[:, axis]), expected, atol=1e-9)


@pytest.mark.parametrize("seed", range(1000, 1005))
@pytest.mark.parametrize(
    ("matrix", "kind", "axes", "amount"),
    [
        (np.eye(3)[[0, 2, 1]], "exchanged", ("x", "z", "y"), 0.0),
        (np.eye(3)[[1, 2, 0]], "exchanged", ("y", "z", "x"), 0.0),
        (turn(25.0), "turned", ("x",), 25.0),
        (turn(-40.0), "turned", ("x",), -40.0),
        (10.0 * np.eye(3), "gain", AXES, 20.0),
        (np.diag([1.0, 0.25, 1.0]), "gain", ("y",), -12.0),
    ],
)
def test_a_mistake_of_mounting_is_named_with_its_amount(
    matrix: Float, kind: str, axes: tuple[str, ...], amount: float, seed: int
) -> None:
    found = mountings_of([mounted(seed, matrix), mounted(seed + 50, matrix)], learnt())
    assert (found[0].kind, found[0].axes) == (kind, axes), found
    assert found[0].amount == pytest.approx(amount, abs=4.0 if kind == "turned" else 1.0)
    assert found[0].strangeness <= 1.0


def test_what_is_familiar_or_of_another_box_is_no_mistake_of_mounting() -> None:
    kept = [seed for seed in range(2000, 2020) if not mountings_of([heard(seed)], learnt())]
    assert len(kept) >= 17
    other = heard(5).acceleration
    lines = rfft(other, axis=0) * (1.0 + 3.0 * np.sin(np.arange(SAMPLES // 2 + 1) / 40.0) ** 2)[:, None]
    assert mountings_of([replace(heard(5), acceleration=irfft(lines, SAMPLES, axis=0))], learnt()) == ()
