"""Kernels that an installation brings: compiled while the wheel is built, for a level of x86-64.

Nothing else stands for them: they are found under the same digest as those that are compiled here, so that
kernels of other sources, libraries or Pythons are left alone.
"""

from __future__ import annotations

from functools import cache

import numba
from numba.core.codegen import get_host_cpu_features

_LEVEL_3 = ("avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe")
_LEVEL_4 = ("avx512f", "avx512bw", "avx512cd", "avx512dq", "avx512vl")
# Levels of x86-64, the highest first, and what a processor has that is of them.
LEVELS = {"x86-64-v4": (*_LEVEL_3, *_LEVEL_4), "x86-64-v3": _LEVEL_3}


def told_to_numba(level: str) -> dict[str, str]:
    """Give the environment in which numba compiles for a level."""
    return {"NUMBA_CPU_NAME": level, "NUMBA_CPU_FEATURES": _features(level)}


def _features(level: str) -> str:
    # LLVM would take half of the width of a register where it is free to choose
    return ",".join(["-prefer-256-bit", *(f"+{feature}" for feature in LEVELS[level])])


@cache
def shipped_processor() -> tuple[str, str] | None:
    """Find for which name and features of a processor there are kernels that run here.

    Returns
    -------
    (str, str) or None
        As numba has them. Where a processor is set for numba, `None`: it compiles for that one.
    """
    if numba.config.CPU_NAME or numba.config.CPU_FEATURES is not None:  # type: ignore[attr-defined]
        return None
    here = set(get_host_cpu_features().split(","))
    for level, features in LEVELS.items():
        if here.issuperset(f"+{feature}" for feature in features):
            return level, _features(level)
    return None
