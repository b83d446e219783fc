"""Elementary functions of lane values, with stated errors.

All of them let a NaN through: a wrong state must be seen, not hidden.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from beardyn_core.base.jit import inline
from beardyn_core.physics.lanes.lanes import integer_type, library_call, primitive, splat

Value = Any  # a float, an LLVM vector, or (without the compiler) a NumPy array


@primitive(lambda builder, a: library_call(builder, "sqrt", a))
def sqrt(a: Value) -> Value:
    """Take the square root."""
    return np.sqrt(a)


@primitive(lambda builder, a: library_call(builder, "fabs", a))
def magnitude(a: Value) -> Value:
    """Take the absolute value."""
    return np.abs(a)


@primitive(lambda builder, a: library_call(builder, "floor", a))
def floor(a: Value) -> Value:
    """Round down to the largest whole number not above ``a``."""
    return np.floor(a)


@primitive(lambda builder, a, b: builder.select(builder.fcmp_ordered("<", a, b), b, a))
def at_least(a: Value, b: Value) -> Value:
    """Take the larger of ``a`` and the bound ``b``; a NaN in ``a`` stays."""
    return np.asarray(np.where(np.less(a, b), b, a))[()]


@primitive(lambda builder, a, b: builder.select(builder.fcmp_ordered(">", a, b), b, a))
def at_most(a: Value, b: Value) -> Value:
    """Take the smaller of ``a`` and the bound ``b``; a NaN in ``a`` stays."""
    return np.asarray(np.where(np.greater(a, b), b, a))[()]


@primitive(lambda builder, a, b, c, d: builder.select(builder.fcmp_ordered(">", a, b), c, d))
def where_greater(a: Value, b: Value, c: Value, d: Value) -> Value:
    """Take ``c`` in the lanes where ``a > b``, else ``d``."""
    return np.asarray(np.where(np.greater(a, b), c, d))[()]


_ONE_BITS = float(0x3FF0000000000000)
# the offset levels the remainder of the seed: 1 - a z^9 is within +-0.263
_SEED_MAGIC = _ONE_BITS * (1 + 1 / 9) - 0.0525 * 2.0**52 * (10 / 9)


def _emit_seed(builder: Any, a: Any) -> Any:
    integers = integer_type(a.type)
    bits = builder.sitofp(builder.bitcast(a, integers), a.type)
    seed = builder.fsub(splat(a.type, _SEED_MAGIC), builder.fmul(bits, splat(a.type, 1 / 9)))
    return builder.bitcast(builder.fptosi(seed, integers), a.type)


@primitive(_emit_seed)
def _seed_minus_ninth(a: Value) -> Value:
    bits = np.asarray(a, dtype=np.float64).view(np.int64)
    return (_SEED_MAGIC - bits * (1 / 9)).astype(np.int64).view(np.float64)[()]


@inline
def ninth_root(a):
    """Take the ninth root ``a ** (1/9)`` for ``a > 0``; relative error below 1e-14, without a division.

    With z near ``a ** (-1/9)`` and ``e = 1 - a z^9``, known exactly, ``a ** (1/9)`` is
    ``a z^8 (1 - e) ** (-8/9)``: one series of the remainder does the work of several Newton steps. The
    seed's remainder is below 0.263; a fitted cubic brings it to 3e-4, a Taylor series does the rest.
    """
    z = _seed_minus_ninth(a)
    z2 = z * z
    z4 = z2 * z2
    e = 1.0 - a * (z4 * z4) * z
    z = z * (0.999978685 + e * (0.111074033 + e * (0.064167728 + e * 0.0458267711)))
    z2 = z * z
    z4 = z2 * z2
    root = a * (z4 * z4)
    e = 1.0 - root * z
    return root + root * e * (8 / 9 + e * (68 / 81 + e * (1768 / 2187)))


@inline
def quick_ninth_root(a):
    """Take the ninth root for ``a > 0``; relative error below 2e-7 (one fitted series of the remainder)."""
    z = _seed_minus_ninth(a)
    z2 = z * z
    z4 = z2 * z2
    root = a * (z4 * z4)
    e = 1.0 - root * z
    e2 = e * e
    low = (0.999999855 + e * 0.888889154) + e2 * (0.839573897 + e * 0.808432702)
    high = (0.781068861 + e * 0.765045923) + e2 * (0.864974945 + e * 0.840168018)
    return root * (low + (e2 * e2) * high)


def _emit_exponent(builder: Any, a: Any) -> Any:
    integers = integer_type(a.type)
    return builder.sitofp(builder.lshr(builder.bitcast(a, integers), splat(integers, 52)), a.type)


@primitive(_emit_exponent)
def _biased_exponent(a: Value) -> Value:
    return np.frexp(a)[1] + 1022.0


def _emit_mantissa(builder: Any, a: Any) -> Any:
    integers = integer_type(a.type)
    kept = builder.and_(builder.bitcast(a, integers), splat(integers, (1 << 52) - 1))
    mantissa = builder.bitcast(builder.or_(kept, splat(integers, 0x3FF << 52)), a.type)
    return builder.select(builder.fcmp_unordered("uno", a, a), a, mantissa)


@primitive(_emit_mantissa)
def _mantissa(a: Value) -> Value:
    return 2.0 * np.frexp(a)[0]


@inline
def log2(a):
    """Take the binary logarithm for ``a > 0``; absolute error below 1e-11 (odd minimax of degree 9)."""
    m = _mantissa(a)
    t = (m - 1.4142135623730951) / (m + 1.4142135623730951)
    t2 = t * t
    tail = 0.5770866439926176 + t2 * (0.4115342215244034 + t2 * 0.34282036635830193)
    return (_biased_exponent(a) - 1022.5) + t * (2.8853900818453737 + t2 * (0.9617966483156426 + t2 * tail))


def _emit_power_of_two(builder: Any, a: Any) -> Any:
    integers = integer_type(a.type)
    power = builder.shl(builder.bitcast(a, integers), splat(integers, 52))
    return builder.bitcast(builder.add(power, splat(integers, 1023 << 52)), a.type)


# A number added to this is rounded to a whole one, which stands in the last bits of the sum.
_ROUNDER = 1.5 * 2.0**52


@primitive(_emit_power_of_two)
def _power_of_two_rounded(a: Value) -> Value:
    bits = np.asarray(a, dtype=np.float64).view(np.int64)
    return np.asarray((bits << 52) + (1023 << 52)).view(np.float64)[()]


@inline
def exp2(a):
    """Raise two to a power from -1000 to 1000; relative error below 1e-10, none for whole numbers.

    Minimax polynomial of degree 7 over half a unit on either side of a whole number.
    """
    bounded = at_most(at_least(a, -1000.0), 1000.0)
    shifted = bounded + _ROUNDER
    f = bounded - (shifted - _ROUNDER)
    f2 = f * f
    low = (1.0 + f * 0.6931471807045321) + f2 * (0.24022651066561598 + f * 0.05550410365990846)
    high = 0.00015466756332717886 + f * 1.5196156191076872e-05
    high = (0.009618038132002254 + f * 0.0013333935056599935) + f2 * high
    return _power_of_two_rounded(shifted) * (low + (f2 * f2) * high)


@inline
def log2_one_plus_exp2(a):
    """Take the binary logarithm of ``1 + 2 ** a``; absolute error below 2e-4.

    The positive part of ``a`` plus an even rest, which is fitted: cheaper than a logarithm and a power.
    """
    t = magnitude(a)
    t2 = t * t
    root = (1.0 + 0.125 * t) + t2 * (0.017720076058528458 + t * 0.0007708004379662252 + t2 * 2.54198850e-05)
    root2 = root * root
    return at_least(a, 0.0) + 1.0 / (root2 * root2)


@inline
def wrap(angle):
    """Turn an angle by whole turns into [-pi, pi), [rad]."""
    return angle - 6.283185307179586 * floor(angle * 0.15915494309189535 + 0.5)


@inline
def cos_sin(angle):
    """Take cosine and sine of an angle of a few turns, [rad]; absolute error below 2e-15."""
    x = 0.25 * wrap(angle)
    x2 = x * x
    tail = x2 * (1 / 362880 + x2 * (-1 / 39916800 + x2 * (1 / 6227020800 - x2 / 1307674368000)))
    s = x * (1.0 + x2 * (-1 / 6 + x2 * (1 / 120 + x2 * (-1 / 5040 + tail))))
    tail = x2 * (1 / 3628800 + x2 * (-1 / 479001600 + x2 * (1 / 87178291200 - x2 / 20922789888000)))
    versine = x2 * (0.5 + x2 * (-1 / 24 + x2 * (1 / 720 + x2 * (-1 / 40320 + tail))))
    c = 1.0 - versine
    s_half = 2.0 * s * c
    c_half = 1.0 - 2.0 * s * s
    return 1.0 - 2.0 * s_half * s_half, 2.0 * s_half * c_half


# Functions that saturate, divided by their argument: friction is used as force over slip speed, and f(x) / x
# is finite at zero slip where f(x) and x both vanish.
LOG2_E = 1.4426950408889634
_LN_2 = 0.6931471805599453
_HALF_PI = 1.5707963267948966
# below this the functions are taken from their series, whose error is then smaller than that of exp2 and log2
_SERIES_BELOW = 0.03


@inline
def decay_over(x):
    """Work out (1 - exp(-x)) / x for x >= 0; relative error below 1e-7."""
    series = 1.0 - x * (1 / 2 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120))))
    decayed = (1.0 - exp2(-LOG2_E * x)) / at_least(x, _SERIES_BELOW)
    return where_greater(x, _SERIES_BELOW, decayed, series)


@inline
def decay_rate(per_slip, slip, inverse_slip):
    """Work out (1 - exp(-per_slip slip)) / slip where 1 / slip is known; errors as of `decay_over`."""
    x = per_slip * slip
    series = per_slip * (1.0 - x * (1 / 2 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120)))))
    return where_greater(x, _SERIES_BELOW, (1.0 - exp2(-LOG2_E * x)) * inverse_slip, series)


@inline
def asinh_over(x):
    """Work out asinh(x) / x for 0 <= x < 1e100; relative error below 1e-8."""
    x2 = x * x
    series = 1.0 - x2 * (1 / 6 - x2 * (3 / 40 - x2 * (15 / 336)))
    found = _LN_2 * log2(x + sqrt(x2 + 1.0)) / at_least(x, _SERIES_BELOW)
    return where_greater(x, _SERIES_BELOW, found, series)


@inline
def arctangent_over(x):
    """Work out atan(x) / x for x >= 0; relative error below 1e-9."""
    return arctangent_with(x, 1.0 / at_least(x, 1e-30))


@inline
def arctangent_with(x, inverse):
    """Work out atan(x) / x where 1 / x is known: a minimax polynomial in the square of min(x, 1/x)."""
    folded = at_most(x, inverse)
    s = folded * folded
    tail = 0.02253987213401459 + s * (-0.0073179591294139906 + s * 0.0011137893081054834)
    tail = -0.08811091477881007 + s * (0.06741597453598872 + s * (-0.04468994705394946 + s * tail))
    tail = 0.19999671122813323 + s * (-0.142798330523907 + s * (0.1105822369876473 + s * tail))
    series = 1.0 + s * (-0.33333326899541654 + s * tail)
    return where_greater(x, 1.0, (_HALF_PI - folded * series) * inverse, series)
