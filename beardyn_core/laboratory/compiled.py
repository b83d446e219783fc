"""The general contact search compiled: the same shapes and conditions as numbers, many pairs in one call."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import Annotated as A
from typing import Any

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.jit import entry, inline
from beardyn_core.laboratory import shapes
from beardyn_core.laboratory.search import DIFFERENCE, MOST_ITERATIONS, ROWS, TOLERANCE, Pair

WORK_NUMBERS = 160  # vectors [7, 3], slopes [4, 7, 3], system [4, 5], moved parameters [4]
_SLOPES, _SYSTEM, _MOVED = 24, 110, 132
_STRIDE = 3 * ROWS


@inline
def _put(shape: Any, cosine: Any, sine: Any, out: Any, around: Any, along: Any, target: Any, at: Any) -> None:
    """Store ``out e + around g + along k`` at ``target[at]``; e, g, k: radial, circumferential, pole."""
    first, second = cosine * out - sine * around, sine * out + cosine * around
    for i in range(3):
        target[at + i] = (
            first * shape[shapes.EAST + i] + second * shape[shapes.NORTH + i] + along * shape[shapes.POLE + i]
        )


@entry
def _frame(shape: Any, u: Any, v: Any, sign: Any, row: Any, column: Any, slopes: Any, w: Any) -> None:
    """Add the point times ``sign`` to d; write the vectors, and where ``slopes`` their derivatives."""
    kind = shape[shapes.KIND]
    first, second, side = shape[shapes.FIRST], shape[shapes.SECOND], shape[shapes.SIDE]
    base = _SLOPES + column * _STRIDE
    turn = v if kind < shapes.CIRCLE else u
    cosine, sine = math.cos(turn), math.sin(turn)
    t, b, n = 3 * row, 3 * row + 3, 3 * row + 6
    if kind < shapes.CIRCLE:
        if kind == shapes.CONE:
            t_out, t_along, speed = math.sin(second), math.cos(second), 1.0
            n_out, n_along = side * t_along, -side * t_out
            distance, height = first + u * t_out, u * t_along
            bend_out, bend_along, lean_out, lean_along = 0.0, 0.0, 0.0, 0.0
        else:
            c, s = math.cos(u), math.sin(u)
            t_out, t_along, speed = -s, c, second
            n_out, n_along = side * c, side * s
            distance, height = first + second * c, second * s
            bend_out, bend_along, lean_out, lean_along = -c, -s, -side * s, side * c
        _put(shape, cosine, sine, t_out, 0.0, t_along, w, t)
        _put(shape, cosine, sine, 0.0, 1.0, 0.0, w, b)
        _put(shape, cosine, sine, n_out, 0.0, n_along, w, n)
        if slopes:
            _put(shape, cosine, sine, sign * speed * t_out, 0.0, sign * speed * t_along, w, base)
            _put(shape, cosine, sine, bend_out, 0.0, bend_along, w, base + t)
            _put(shape, cosine, sine, 0.0, 0.0, 0.0, w, base + b)
            _put(shape, cosine, sine, lean_out, 0.0, lean_along, w, base + n)
            next_base = base + _STRIDE
            _put(shape, cosine, sine, 0.0, sign * distance, 0.0, w, next_base)
            _put(shape, cosine, sine, 0.0, t_out, 0.0, w, next_base + t)
            _put(shape, cosine, sine, -1.0, 0.0, 0.0, w, next_base + b)
            _put(shape, cosine, sine, 0.0, n_out, 0.0, w, next_base + n)
    elif kind < shapes.STRAIGHT:
        distance, height = first, 0.0
        radial, axial = (b, n) if kind == shapes.FACE_CIRCLE else (n, b)
        _put(shape, cosine, sine, 0.0, 1.0, 0.0, w, t)
        _put(shape, cosine, sine, 1.0, 0.0, 0.0, w, radial)
        _put(shape, cosine, sine, 0.0, 0.0, side, w, axial)
        if slopes:
            _put(shape, cosine, sine, 0.0, sign * first, 0.0, w, base)
            _put(shape, cosine, sine, -1.0, 0.0, 0.0, w, base + t)
            _put(shape, cosine, sine, 0.0, 1.0, 0.0, w, base + radial)
            _put(shape, cosine, sine, 0.0, 0.0, 0.0, w, base + axial)
    else:
        distance, height = 0.0, u
        _put(shape, 1.0, 0.0, 0.0, 0.0, 1.0, w, t)
        _put(shape, 1.0, 0.0, 0.0, 1.0, 0.0, w, b)
        _put(shape, 1.0, 0.0, 1.0, 0.0, 0.0, w, n)
        if slopes:
            _put(shape, 1.0, 0.0, 0.0, 0.0, sign, w, base)
            for i in range(3):
                w[base + t + i] = w[base + b + i] = w[base + n + i] = 0.0
    for i in range(3):
        out = cosine * shape[shapes.EAST + i] + sine * shape[shapes.NORTH + i]
        w[i] += sign * (shape[shapes.ORIGIN + i] + distance * out + height * shape[shapes.POLE + i])


@inline
def _fill(p: Any, q: Any, cut: Any, x: Any, at: Any, slopes: Any, w: Any) -> None:
    """Write the vectors of a pair at the parameters ``x[at:]``, with their derivatives where ``slopes``."""
    w[0] = w[1] = w[2] = 0.0
    if slopes:
        for i in range(4 * _STRIDE):
            w[_SLOPES + i] = 0.0
    _frame(p, x[at], x[at + 1], 1.0, 1, 0, slopes, w)
    _frame(q, x[at + cut], x[at + min(cut + 1, 3)], -1.0, 4, cut, slopes, w)


@inline
def _product(w: Any, a: Any, b: Any) -> Any:
    return w[a] * w[b] + w[a + 1] * w[b + 1] + w[a + 2] * w[b + 2]


@inline
def _eliminate(w: Any, count: Any) -> Any:
    """Solve the system in the work by elimination with pivots; False when it is singular."""
    for k in range(count):
        pivot = k
        for i in range(k + 1, count):
            if abs(w[_SYSTEM + 5 * i + k]) > abs(w[_SYSTEM + 5 * pivot + k]):
                pivot = i
        if not abs(w[_SYSTEM + 5 * pivot + k]) > 0.0:
            return False
        if pivot != k:
            for j in range(k, count + 1):
                a, b = _SYSTEM + 5 * k + j, _SYSTEM + 5 * pivot + j
                w[a], w[b] = w[b], w[a]
        for i in range(k + 1, count):
            share = w[_SYSTEM + 5 * i + k] / w[_SYSTEM + 5 * k + k]
            for j in range(k + 1, count + 1):
                w[_SYSTEM + 5 * i + j] -= share * w[_SYSTEM + 5 * k + j]
    for i in range(count - 1, -1, -1):
        total = w[_SYSTEM + 5 * i + count]
        for j in range(i + 1, count):
            total -= w[_SYSTEM + 5 * i + j] * w[_SYSTEM + 5 * j + count]
        w[_SYSTEM + 5 * i + count] = total / w[_SYSTEM + 5 * i + i]
    return True


@entry
def solve_pair(p: Any, q: Any, cut: Any, form: Any, count: Any, analytic: Any, x: Any, w: Any) -> Any:
    """Iterate after Newton on the parameters ``x``; return the number of steps, or -1 when it failed.

    The vectors at the solution stay in ``w``: d, then t, b, n of P and of Q.
    """
    for iteration in range(MOST_ITERATIONS):
        _fill(p, q, cut, x, 0, analytic, w)
        largest = 0.0
        for i in range(count):
            value = _product(w, 3 * form[i, 0], 3 * form[i, 1])
            w[_SYSTEM + 5 * i + count] = value
            largest = max(largest, abs(value))
            if not abs(value) < 1e30:
                return -1
        if largest < TOLERANCE:
            return iteration
        if analytic:
            for i in range(count):
                a, b = 3 * form[i, 0], 3 * form[i, 1]
                for j in range(count):
                    base = _SLOPES + _STRIDE * j
                    total = 0.0
                    for k in range(3):
                        total += w[base + a + k] * w[b + k] + w[a + k] * w[base + b + k]
                    w[_SYSTEM + 5 * i + j] = total
        else:
            for j in range(count):
                for k in range(4):
                    w[_MOVED + k] = x[k]
                w[_MOVED + j] += DIFFERENCE
                _fill(p, q, cut, w, _MOVED, False, w)
                for i in range(count):
                    moved = _product(w, 3 * form[i, 0], 3 * form[i, 1])
                    w[_SYSTEM + 5 * i + j] = (moved - w[_SYSTEM + 5 * i + count]) / DIFFERENCE
        if not _eliminate(w, count):
            return -1
        for i in range(count):
            x[i] -= w[_SYSTEM + 5 * i + count]
    return -1


@partial(entry, allocates=True)
def solve_pairs(
    p: Any,
    q: Any,
    cut: Any,
    forms: Any,
    counts: Any,
    signed: Any,
    start: Any,
    analytic: Any,
    x: Any,
    out: Any,
) -> None:
    """Solve pairs: parameters to ``x`` [pair, 4]; iterations (-1: failed) and gap to ``out`` [pair, 2]."""
    w = np.zeros(WORK_NUMBERS)
    for i in range(len(counts)):
        for j in range(4):
            x[i, j] = start[i, j]
        out[i, 0] = solve_pair(p[i], q[i], cut[i], forms[i], counts[i], analytic, x[i], w)
        out[i, 1] = _product(w, 0, 18) if signed[i] else math.sqrt(_product(w, 0, 0))


@entry
def pair_residual(p: Any, q: Any, cut: Any, form: Any, count: Any, x: Any, w: Any, out: Any) -> None:
    """Compute the residual of one pair at ``x`` [4], for a root finder outside."""
    _fill(p, q, cut, x, 0, False, w)
    for i in range(count):
        out[i] = _product(w, 3 * form[i, 0], 3 * form[i, 1])


@dataclass(frozen=True)
class Batch:
    """Pairs as arrays, with their starts."""

    p: A[Float, "shape [pair, SHAPE_NUMBERS]"]
    q: A[Float, "shape [pair, SHAPE_NUMBERS]"]
    cut: A[NDArray[np.int64], "shape [pair], parameters of P"]
    forms: A[NDArray[np.int64], "shape [pair, 4, 2]"]
    counts: A[NDArray[np.int64], "shape [pair], equations"]
    signed: A[NDArray[np.bool_], "shape [pair]"]
    start: A[Float, "shape [pair, 4]"]

    def solve(self, *, analytic: bool = True) -> tuple[Float, NDArray[np.int64], Float]:
        """Return parameters [pair, 4], iterations [pair] (-1: failed) and gaps [pair] of all pairs."""
        x, out = np.zeros((len(self.counts), 4)), np.zeros((len(self.counts), 2))
        self.solve_into(x, out, analytic=analytic)
        return x, out[:, 0].astype(np.int64), out[:, 1]

    def solve_into(self, x: Float, out: Float, *, analytic: bool) -> None:
        """Write the same into arrays that exist, for timing."""
        solve_pairs(*vars(self).values(), analytic, x, out)


def batch(pairs: Sequence[Pair], starts: Sequence[Float]) -> Batch:
    """Put pairs and their starts into arrays."""
    start = np.zeros((len(pairs), 4))
    for i, parameters in enumerate(starts):
        start[i, : len(parameters)] = parameters
    return Batch(
        p=np.array([pair.p.encode() for pair in pairs]).reshape(-1, shapes.SHAPE_NUMBERS),
        q=np.array([pair.q.encode() for pair in pairs]).reshape(-1, shapes.SHAPE_NUMBERS),
        cut=np.array([pair.p.parameter_count for pair in pairs], dtype=np.int64),
        forms=np.array([pair.form.encode() for pair in pairs]),
        counts=np.array([len(pair.form.equations) for pair in pairs], dtype=np.int64),
        signed=np.array([pair.form.signed for pair in pairs]),
        start=start,
    )
