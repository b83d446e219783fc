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
def decay_rate(per_slip: Any, slip: Any, inverse_slip: Any) -> Any:
    """(1 - exp(-per_slip slip)) / slip where 1 / slip is known as well; errors as of `decay_over`."""
    x = per_slip * slip
    series = per_slip * (1.0 - x * (1 / 2 - x * (1 / 6 - x * (1 / 24 - x * (1 / 120)))))
    return where_greater(x, _SMALL, (1.0 - exp2(-_LOG2_E * x)) * inverse_slip, series)


@inline
def asinh_over(x: Any) -> Any:
    """asinh(x) / x for 0 <= x < 1e100; relative error below 1e-8."""
    x2 = x * x
    series = 1.0 - x2 * (1 / 6 - x2 * (3 / 40 - x2 * (15 / 336)))
    found = _LN_2 * log2(x + sqrt(x2 + 1.0)) / at_least(x, _SMALL)
    return where_greater(x, _SMALL, found, series)


@inline
def arctangent_over(x: Any) -> Any:
    """atan(x) / x for x >= 0; relative error below 1e-9."""
    return arctangent_with(x, 1.0 / at_least(x, 1e-30))


@inline
def arctangent_with(x: Any, inverse: Any) -> Any:
    """atan(x) / x where 1 / x is known as well: a polynomial in the square of min(x, 1/x), minimax."""
    folded = at_most(x, inverse)
    s = folded * folded
    tail = 0.02253987213401459 + s * (-0.0073179591294139906 + s * 0.0011137893081054834)
    tail = -0.08811091477881007 + s * (0.06741597453598872 + s * (-0.04468994705394946 + s * tail))
    tail = 0.19999671122813323 + s * (-0.142798330523907 + s * (0.1105822369876473 + s * tail))
    series = 1.0 + s * (-0.33333326899541654 + s * tail)
    return where_greater(x, 1.0, (_HALF_PI - folded * series) * inverse, series)
