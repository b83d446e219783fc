"""Columns of time: by their name, and by numbers that rise from sample to sample as no vibration does."""

from __future__ import annotations

import re

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.measured.units import TIME, split_unit, unit_in

_NAME = re.compile(
    r"(?:.*[./])?(?:time|t|x_value|timestamps|time_?stamp|zeit|temps|tiempo|elapsed(?:[ _]time)?|seconds"
    r"|sec)",
    re.I,
)
_LOOKED_AT = 4096  # samples
_LEAST = 16
_EVEN = 0.01  # share of a step by which the others may differ
_MOST = 0.9  # share of steps that are even in a counter that begins again and again


def is_time_name(name: str) -> bool:
    """Tell whether a channel is called as time is, with or without a unit behind it."""
    stem, _ = split_unit(name)
    if _NAME.fullmatch(stem):
        return True
    for sign in "_ /.":
        before, found, last = stem.rpartition(sign)
        if found and (last in TIME or unit_in(stem, TIME)) and _NAME.fullmatch(before):
            return True
    return False


def is_ramp(values: Float) -> bool:
    """Tell whether numbers are a time or a counter: they never turn round, or nearly all steps are alike."""
    step = np.diff(values[:_LOOKED_AT])
    step = step[np.isfinite(step)]
    if np.count_nonzero(step) < _LEAST:
        return False
    if (step >= 0.0).all() or (step <= 0.0).all():
        return True
    usual = float(np.median(step))
    return usual != 0.0 and float(np.mean(np.abs(step - usual) <= _EVEN * abs(usual))) >= _MOST


def is_counter(values: Float) -> bool:
    """Tell whether a ramp counts samples: it has whole numbers with one between two."""
    step = np.diff(values[:_LOOKED_AT])
    return bool(
        np.median(np.abs(step)) == 1.0 and (values[:_LOOKED_AT] == np.round(values[:_LOOKED_AT])).all()
    )
