"""The decimator keeps the passband, rejects aliases, and does not see how the stream is cut."""

import time
from copy import deepcopy

import numpy as np
import pytest

from beardyn_core.sensors.resampling import Decimator, TwoStageDecimator


def _gain(factor, frequency, kind=Decimator):
    """Amplitude and phase that a wave of `frequency` (of the new rate) comes out with."""
    decimator = kind(factor, 2)
    n = np.arange(factor * 4000)
    wave = 2 * np.pi * frequency / factor * n
    out = decimator.push(np.column_stack([np.cos(wave), np.sin(wave)]))[1000:]
    m = np.arange(1000, 4000)
    # if the delay is as stated, the output is the wave at input m x factor - delay
    place = m * factor - decimator.delay_samples
    return np.mean((out[:, 0] + 1j * out[:, 1]) * np.exp(-2j * np.pi * frequency / factor * place))


@pytest.mark.parametrize("factor", [2, 3, 4, 8, 64])
def test_passband_is_flat_with_the_stated_delay(factor):
    for frequency in np.linspace(0.0, 0.4, 21):
        assert abs(20 * np.log10(abs(_gain(factor, frequency)))) < 0.1
        assert abs(np.angle(_gain(factor, frequency))) < 1e-9


@pytest.mark.parametrize("factor", [2, 4, 64])
def test_stopband_is_70_db_down(factor):
    frequencies = np.concatenate([np.linspace(0.6, 1.0, 25), np.linspace(1.0, factor / 2, 20)])
    assert max(abs(_gain(factor, f)) for f in frequencies) < 10 ** (-70 / 20)


@pytest.mark.parametrize("factor", [16, 32, 64, 128])
def test_two_stages_have_the_band_and_the_delay_of_one(factor):
    assert TwoStageDecimator(factor, 2).delay_samples == Decimator(factor, 2).delay_samples
    for frequency in np.linspace(0.0, 0.4, 11):
        gain = _gain(factor, frequency, TwoStageDecimator)
        assert abs(20 * np.log10(abs(gain))) < 0.1
        assert abs(np.angle(gain)) < 1e-9
    frequencies = np.concatenate([np.linspace(0.6, 1.0, 15), np.linspace(1.0, factor / 2, 30)])
    assert max(abs(_gain(factor, f, TwoStageDecimator)) for f in frequencies) < 10 ** (-70 / 20)


def test_two_stages_of_any_cut_and_a_copy_of_them_give_the_same_bits():
    stream = np.random.default_rng(4).normal(size=(64 * 60, 3))
    whole = TwoStageDecimator(64, 3, held_back=5).push(stream)
    pieces = TwoStageDecimator(64, 3, held_back=5)
    parts = [pieces.push(part) for part in np.split(stream, [64, 64 * 9, 64 * 10])]
    assert np.array_equal(np.concatenate(parts), whole)
    again = TwoStageDecimator(64, 3, held_back=5)
    again.push(stream[: 64 * 20])
    other = deepcopy(again)
    again.push(stream[: 64 * 20])
    assert np.array_equal(other.push(stream[64 * 20 :]), whole[20:])


@pytest.mark.parametrize("factor", [1, 4, 64])
def test_any_cut_into_blocks_gives_the_same_bits(factor):
    random = np.random.default_rng(1)
    stream = random.normal(size=(factor * 700, 9)) * 1e3
    whole = Decimator(factor, 9, initial=np.arange(9.0)).push(stream)
    for _ in range(3):
        cuts = factor * np.sort(random.integers(0, 700, 40))
        pieces = Decimator(factor, 9, initial=np.arange(9.0))
        parts = [pieces.push(part) for part in np.split(stream, cuts)]
        assert np.array_equal(np.concatenate(parts), whole)


def test_a_copy_of_the_filter_continues_with_the_same_bits():
    stream = np.random.default_rng(2).normal(size=(4096, 3))
    decimator = Decimator(4, 3)
    decimator.push(stream[:2048])
    other = deepcopy(decimator)
    first = decimator.push(stream[2048:])
    assert np.array_equal(other.push(stream[2048:]), first)
    assert not np.array_equal(Decimator(4, 3).push(stream[2048:]), first)


def test_a_held_initial_value_gives_no_transient():
    level = np.array([9.80665, -3.0])
    out = Decimator(4, 2, initial=level).push(np.tile(level, (400, 1)))
    assert np.allclose(out, level, rtol=1e-12, atol=0)


def test_a_nan_is_not_hidden():
    stream = np.zeros((400, 2))
    stream[200, 0] = np.nan
    out = Decimator(4, 2).push(stream)
    assert np.isnan(out[:, 0]).any()
    assert not np.isnan(out[:, 1]).any()


@pytest.mark.parametrize("factor", [4, 64])
def test_a_block_of_2048_by_9_takes_less_than_half_a_millisecond(factor):
    decimator = Decimator(factor, 9)
    block = np.random.default_rng(3).normal(size=(2048, 9))
    decimator.push(block)
    walls = []
    for _ in range(50):
        start = time.perf_counter()
        decimator.push(block)
        walls.append(time.perf_counter() - start)
    # the best of many: the machine may be busy with others
    assert min(walls) < 0.5e-3


def test_wrong_shapes_and_factors_are_refused():
    with pytest.raises(ValueError, match="multiple of 4"):
        Decimator(4, 2).push(np.zeros((6, 2)))
    with pytest.raises(ValueError, match="1 to 4096"):
        Decimator(4097, 2)


@pytest.mark.parametrize("factor", [1, 4])
def test_a_stream_can_be_held_back(factor):
    stream = np.random.default_rng(3).normal(size=(factor * 100, 2))
    late = Decimator(factor, 2, initial=np.array([3.0, 4.0]), held_back=3)
    plain = Decimator(factor, 2, initial=np.array([3.0, 4.0]))
    shifted = np.concatenate([np.tile([3.0, 4.0], (3, 1)), stream])[: len(stream)]
    parts = [late.push(part) for part in np.split(stream, [factor, 4 * factor, 50 * factor])]
    assert np.array_equal(np.concatenate(parts), plain.push(shifted))
    assert late.delay_samples == plain.delay_samples + 3
