"""Interpolation between samples, by the polynomials of `scene.chord_polynomials` where they are even."""

from __future__ import annotations

from functools import partial

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.jit import entry
from beardyn_core.scene.chord_polynomials import POLYNOMIALS
from beardyn_core.scene.load import LONGEST_SPACING_NS, LOOK_AHEAD, UNEVENNESS

# a sample on the line between its neighbours is so close to it, in parts of all three
_STRAIGHT = 1e-10
# of the polynomials, all in groups of so many
_TAPS_AT_ONCE = 6


def interpolate_columns(time_ns: Int, values: Float, start_ns: int, at: Float) -> Float:
    """Interpolate columns of samples; outside them the first and the last are held.

    Band-limited where samples are evenly spaced and measured or computed, straight from sample to sample
    where they are not (`scene.load.LoadHistory` says which): each column by itself. Only `LOOK_AHEAD` samples
    on either side count. Beyond either end of the samples a signal is taken to go on as its own image turned
    about the end, without a step in value or slope.

    Parameters
    ----------
    time_ns : int64 array, shape [sample], strictly increasing, [ns]
    values : array, shape [sample, column]
    start_ns : int
        What the wanted times count from, [ns].
    at : array, shape [row], increasing, [ns]

    Returns
    -------
    array, shape [row, column]
    """
    rows = np.empty((len(at), values.shape[1]))
    _fill_blocks(time_ns, values, start_ns, 0, at, 1, POLYNOMIALS, rows)
    return rows


def at_steps(time_ns: Int, values: Float, start_ns: int, block_ns: int, steps: int, blocks: int) -> Float:
    """Interpolate as `interpolate_columns` at the step boundaries of blocks.

    Parameters
    ----------
    time_ns : int64 array, shape [sample], strictly increasing, [ns]
    values : array, shape [sample, column]
    start_ns, block_ns : int
        Begin of the first block, length of each, [ns].
    steps : int
        Of each block.
    blocks : int
        As many as wanted give the same bits as one at a time.

    Returns
    -------
    array, shape [steps * blocks + 1, column]
    """
    rows = np.empty((steps * blocks + 1, values.shape[1]))
    _fill_steps(time_ns, values, start_ns, block_ns, steps, blocks, POLYNOMIALS, rows)
    return rows


@partial(entry, allocates=True, flags=())
def seam(time_ns, sample):
    """Say whether the even spacing ends at a sample, which has one before it and one after it."""
    span, before = time_ns[sample + 1] - time_ns[sample], time_ns[sample] - time_ns[sample - 1]
    return span > LONGEST_SPACING_NS or abs(span - before) > UNEVENNESS * span


@partial(entry, allocates=True, flags=())
def _fill_steps(time_ns, values, start_ns, block_ns, steps, blocks, polynomials, rows):
    at = np.arange(steps + 1) * (block_ns / steps)
    _fill_blocks(time_ns, values, start_ns, block_ns, at, blocks, polynomials, rows)


@partial(entry, allocates=True, flags=())
def _fill_blocks(time_ns, values, start_ns, block_ns, at, blocks, polynomials, rows):
    """Fill the rows of all blocks; held before the first and after the last sample.

    A straight stretch gives the same bits as `numpy.interp`.
    """
    end_ns = start_ns + (blocks - 1) * block_ns
    first = max(np.searchsorted(time_ns, start_ns + at[0], side="right") - 1, 0)
    last = min(np.searchsorted(time_ns, end_ns + at[-1]), len(time_ns) - 1)
    if _is_constant(values[max(first - LOOK_AHEAD, 0) : last + LOOK_AHEAD + 1]):
        for row in range(len(rows)):
            for i in range(values.shape[1]):
                rows[row, i] = values[first, i]
        return
    times = _around(time_ns, first, last)
    seams = _count_seams(times, len(time_ns) > LOOK_AHEAD)
    columns, begins = values.shape[1], np.empty(len(times), np.int64)
    signals = np.empty((columns, len(times)))
    bows = np.zeros((columns, polynomials.shape[1], len(times) - 1 - 2 * LOOK_AHEAD))
    constant = np.empty(columns, np.bool_)
    for i in range(columns):
        signals[i] = _around(values[:, i], first, last)
        constant[i] = _is_constant(signals[i].reshape(-1, 1))
        if not constant[i]:
            _bend(signals[i], seams, polynomials, bows[i])
    for block in range(blocks):  # the rows of a block stay in the near cache for all columns
        start, row = start_ns + block * block_ns, block * (len(at) - 1)
        own = rows[row : row + len(at)]
        near = _sort_rows(times, start, at, begins)
        for i in range(columns):
            if constant[i]:
                _hold(signals[i, 0], own[:, i])
            else:
                _fill_block(at, times, start, near, begins, signals[i], bows[i], own[:, i])


@partial(entry, allocates=True, flags=())
def _hold(value, rows):
    for row in range(len(rows)):
        rows[row] = value


@partial(entry, allocates=True, flags=())
def _fill_block(at, times, start_ns, near, begins, signal, bows, rows):
    """Fill the rows of a column in a block; ``near`` and ``begins`` are of `_sort_rows`."""
    for sample in range(near[0], near[1]):
        begin, after = begins[sample], begins[sample + 1]
        if begin < after:
            since = float(times[sample] - start_ns)
            span = float(times[sample + 1] - start_ns) - since
            left, slope = signal[sample], (signal[sample + 1] - signal[sample]) / span
            chord = sample - LOOK_AHEAD
            a, b, c = bows[0, chord], bows[1, chord], bows[2, chord]
            d, e = bows[3, chord], bows[4, chord]
            for row in range(begin, after):
                past = max(at[row] - since, 0.0)
                u = past / span
                v = 2.0 * u - 1.0
                rows[row] = slope * past + left + u * (1.0 - u) * (a + v * (b + v * (c + v * (d + v * e))))
    _hold(signal[near[1]], rows[begins[near[1]] :])


@partial(entry, allocates=True, flags=())
def _is_constant(values):
    for sample in range(1, len(values)):
        for i in range(values.shape[1]):
            if values[sample, i] != values[0, i]:
                return False
    return True


@partial(entry, allocates=True, flags=())
def _around(series, first, last):
    """Take all between two samples and `LOOK_AHEAD` more on either side, turned about the ends."""
    count, end = last - first + 1 + 2 * LOOK_AHEAD, len(series) - 1
    wide = np.empty(count, series.dtype)
    for k in range(count):
        at = first - LOOK_AHEAD + k
        if at < 0:
            wide[k] = 2 * series[0] - series[min(-at, end)]
        elif at > end:
            wide[k] = 2 * series[end] - series[max(2 * end - at, 0)]
        else:
            wide[k] = series[at]
    return wide


@partial(entry, allocates=True, flags=())
def _count_seams(times, enough):
    """Count, before each sample, those where the even spacing ends: all, where there are not enough."""
    seams = np.zeros(len(times) + 1, np.int64)
    for k in range(len(times)):
        ends = not enough or (0 < k < len(times) - 1 and seam(times, k))
        seams[k + 1] = seams[k] + ends
    return seams


@partial(entry, allocates=True, flags=())
def _sort_rows(times, start_ns, at, begins):
    """Find for each sample near the rows the first row that is not before it.

    What is before all samples belongs to the first. Returned are a sample at or before the first row and one
    behind the last row: a look at all samples for each of many blocks took longer than the rest.
    """
    end = len(times) - 1 - LOOK_AHEAD
    near = max(np.searchsorted(times, start_ns + at[0]) - 2, LOOK_AHEAD)
    row, sample = 0, min(near, end)
    begins[sample] = 0
    while sample < end and row < len(at):
        sample += 1
        while row < len(at) and at[row] < float(times[sample] - start_ns):
            row += 1
        begins[sample] = row
    return min(near, end), sample


@partial(entry, allocates=True, flags=())
def _count_bends(signal):
    """Count, before each sample, those that do not lie on the line between their neighbours."""
    bends = np.zeros(len(signal) + 1, np.int64)
    for k in range(1, len(signal) - 1):
        before, here, after = signal[k - 1], signal[k], signal[k + 1]
        size = abs(before) + 2.0 * abs(here) + abs(after)
        bends[k + 1] = bends[k] + (abs(before - 2.0 * here + after) > _STRAIGHT * size)
    bends[len(signal)] = bends[len(signal) - 1]
    return bends


@partial(entry, allocates=True, flags=())
def _add_taps(signal, weights, bow):
    """Add the next taps of all chords, one after the other: written out, the sum stays in a register."""
    a, b, c, d, e, f = weights[0], weights[1], weights[2], weights[3], weights[4], weights[5]
    for i in range(len(bow)):
        total = bow[i] + a * signal[i] + b * signal[i + 1] + c * signal[i + 2]
        bow[i] = total + d * signal[i + 3] + e * signal[i + 4] + f * signal[i + 5]


@partial(entry, allocates=True, flags=())
def _bend(signal, seams, polynomials, bows):
    """Compute the polynomials by which the signal leaves its chords, shape [power, chord]; 0 where linear."""
    taps, powers = polynomials.shape
    chords = bows.shape[1]
    # the chord itself adds nothing: the polynomials are 0 for straight lines
    for k in range(0, taps, _TAPS_AT_ONCE):
        for p in range(powers):
            _add_taps(signal[k + 1 :], polynomials[k : k + _TAPS_AT_ONCE, p], bows[p])
    bends = _count_bends(signal)
    for chord in range(chords):
        begin, end = chord + 1, chord + taps
        uneven = seams[end] != seams[begin + 1]
        drawn_by_ruler = 2 * (bends[end] - bends[begin + 1]) < end - begin - 1
        if uneven or drawn_by_ruler:
            bows[:, chord] = 0.0
    return bows
