"""Functions that saturate, divided by their argument, for arguments from zero on.

Friction is used as force over slip speed; f(x) / x is finite at zero slip where f(x) and x both vanish.
"""

from __future__ import annotations

from typing import Any

from beardyn_core.jit import inline
from beardyn_core.kernels.lane_math import at_least, at_most, exp2, log2, sqrt, where_greater

_LOG2_E = 1.4426950408889634
_LN_2 = 0.6931471805599453
_HALF_PI = 1.5707963267948966
# below this the functions are taken from their series, whose error is then smaller than that of exp2 and log2
_SMALL = 0.03


@inline
def decay_over(x: Any) -> Any:
    """(1 - exp(-x)) / x for x >= 0; relative error below 1e-7."""
    series = 1.0 - x * (1 / 2 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120))))
    decayed = (1.0 - exp2(-_LOG2_E * x)) / at_least(x, _SMALL)
    return where_greater(x, _SMALL, decayed, series)


@inline
def asinh_over(x: Any) -> Any:
    """asinh(x) / x for 0 <= x < 1e100; relative error below 1e-8."""
    x2 = x * x
    series = 1.0 - x2 * (1 / 6 - x2 * (3 / 40 - x2 * (15 / 336)))
    found = _LN_2 * log2(x + sqrt(x2 + 1.0)) / at_least(x, _SMALL)
    return where_greater(x, _SMALL, found, series)


@inline
def arctangent_over(x: Any) -> Any:
    """atan(x) / x for x >= 0; relative error below 1e-9.

    Halving the angle of min(x, 1/x) leaves at most 22.5 degrees, where a polynomial in the square holds.
    """
    inverse = 1.0 / at_least(x, 1e-30)
    folded = at_most(x, inverse)
    half = 1.0 / (1.0 + sqrt(1.0 + folded * folded))
    t = folded * half
    s = t * t
    series = 1.0 + s * (
        -0.3333333209761623
        + s
        * (
            0.19999883856946377
            + s
            * (
                -0.1428158878179486
                + s * (0.11040489327930807 + s * (-0.08456193410149723 + s * 0.04707349170091556))
            )
        )
    )
    return where_greater(x, 1.0, (_HALF_PI - 2.0 * t * series) * inverse, 2.0 * half * series)
