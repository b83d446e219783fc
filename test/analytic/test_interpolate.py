"""The interpolator keeps its samples and the band, leaves no image, and sees no cuts of the stream."""

from __future__ import annotations

from copy import deepcopy

import numpy as np
import pytest

from beardyn_core.sensors.resampling import FACTORS, Interpolator, delay

LENGTH = 4000


def _wave(factor: int, frequency: float) -> tuple[complex, float]:
    """Gain of a wave of `frequency` (of the old rate), and rms of what else comes out."""
    n = np.arange(LENGTH)
    wave = np.column_stack([np.cos(2 * np.pi * frequency * n), np.sin(2 * np.pi * frequency * n)])
    out = Interpolator(factor, 2, wave[0]).push(wave)
    # an input is the end of its step: number n stands at n + 1
    time = (np.arange(len(out)) - delay(factor)) / factor - 1.0
    settled = slice(100 * factor, None)
    found, expected = out[settled, 0] + 1j * out[settled, 1], np.exp(2j * np.pi * frequency * time[settled])
    gain = complex(np.mean(found * expected.conj()))
    return gain, float(np.sqrt(np.mean(np.abs(found - gain * expected) ** 2)))


@pytest.mark.parametrize("factor", FACTORS)
@pytest.mark.parametrize("frequency", [0.01, 0.1, 0.2, 0.3, 0.4])
def test_band_is_flat_with_the_stated_delay_and_images_are_70_db_down(factor: int, frequency: float) -> None:
    gain, rest = _wave(factor, frequency)
    assert abs(20 * np.log10(abs(gain))) < 0.1
    assert abs(np.angle(gain)) < 1e-9
    assert rest < 10 ** (-70 / 20)


@pytest.mark.parametrize("factor", FACTORS)
def test_samples_of_the_stream_pass_unchanged(factor: int) -> None:
    stream = np.random.default_rng(1).normal(size=(600, 3))
    out = Interpolator(factor, 3, stream[0]).push(stream)
    late = delay(factor) // factor + 1
    passed = out[late * factor :: factor]
    assert np.array_equal(passed, stream[: len(passed)])


@pytest.mark.parametrize("factor", FACTORS)
def test_any_cut_and_a_copy_of_the_filter_give_the_same_bits(factor: int) -> None:
    stream = np.random.default_rng(2).normal(size=(1280, 4)) * 1e3
    whole = Interpolator(factor, 4, np.arange(4.0)).push(stream)
    cut = Interpolator(factor, 4, np.arange(4.0))
    parts = [cut.push(part) for part in np.split(stream, [128, 256, 260, 1000])]
    assert np.array_equal(np.concatenate(parts), whole)
    first = Interpolator(factor, 4, np.arange(4.0))
    first.push(stream[:512])
    other = deepcopy(first)
    first.push(stream[:512])
    assert np.array_equal(other.push(stream[512:]), whole[512 * factor :])


def test_a_held_value_stays_and_other_factors_are_refused() -> None:
    level = np.array([9.80665, -3.0])
    out = Interpolator(4, 2, level).push(np.tile(level, (300, 1)))
    np.testing.assert_allclose(out, np.tile(level, (1200, 1)), rtol=1e-12)
    with pytest.raises(ValueError, match="one of"):
        Interpolator(3, 2, level)
