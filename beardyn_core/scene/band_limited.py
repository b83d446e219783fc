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
    begins = np.empty((blocks, len(times)), np.int64)
    for block in range(blocks):
        _sort_rows(times, start_ns + block * block_ns, at, begins[block])
    end = len(times) - 1 - LOOK_AHEAD
    for i in range(values.shape[1]):
        signal = _around(values[:, i], first, last)
        if _is_constant(signal.reshape(-1, 1)):
            rows[:, i] = signal[0]
            continue
        bows = _bows(signal, seams, polynomials)
        for block in range(blocks):
            start, row = start_ns + block * block_ns, block * (len(at) - 1)
            for sample in range(LOOK_AHEAD, end):
                begin, after = begins[block, sample], begins[block, sample + 1]
                if begin < after:
                    since = float(times[sample] - start)
                    span = float(times[sample + 1] - start) - since
                    chord = signal[sample], (signal[sample + 1] - signal[sample]) / span
                    bow = bows[:, sample - LOOK_AHEAD]
                    _fill(at[begin:after], since, span, chord, bow, rows[row + begin : row + after, i])
            rows[row + begins[block, end] : row + len(at), i] = signal[end]


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
    """Find for each sample the first row that is not before it; what is before all belongs to the first."""
    row = 0
    begins[: LOOK_AHEAD + 1] = 0
    for sample in range(LOOK_AHEAD + 1, len(times) - LOOK_AHEAD):
        while row < len(at) and at[row] < float(times[sample] - start_ns):
            row += 1
        begins[sample] = row


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
def _bows(signal, seams, polynomials):
    """Compute the polynomials by which the signal leaves its chords, shape [power, chord]; 0 where linear."""
    taps, powers = polynomials.shape
    chords = len(signal) - 2 * LOOK_AHEAD - 1
    bows = np.zeros((powers, chords))
    # the chord itself adds nothing: the polynomials are 0 for straight lines
    for k in range(taps):
        shifted = signal[k + 1 : k + 1 + chords]
        for p in range(powers):
            weight, bow = polynomials[k, p], bows[p]
            for chord in range(len(bow)):
                bow[chord] += weight * shifted[chord]
    bends = _count_bends(signal)
    for chord in range(chords):
        begin, end = chord + 1, chord + taps
        uneven = seams[end] != seams[begin + 1]
        drawn_by_ruler = 2 * (bends[end] - bends[begin + 1]) < end - begin - 1
        if uneven or drawn_by_ruler:
            bows[:, chord] = 0.0
    return bows


@partial(entry, allocates=True, flags=())
def _fill(at, since, span, chord, bow, rows):
    """Fill the rows between two neighbouring samples; before the first one it is held."""
    left, slope = chord
    a, b, c, d, e = bow[0], bow[1], bow[2], bow[3], bow[4]
    for row in range(len(at)):
        after = max(at[row] - since, 0.0)
        u = after / span
        v = 2.0 * u - 1.0
        rows[row] = slope * after + left + u * (1.0 - u) * (a + v * (b + v * (c + v * (d + v * e))))
