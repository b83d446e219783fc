"""When tables begin, as files say it next to their samples: ``t0``, ``wf_start_time``, ``Start``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from beardyn_core.measured.moments import is_moment, moments_in_ns
from beardyn_core.measured.units import TIME, split_unit, unit_in, usual

_DATED = 10**17  # [ns] since 1970, from which a time in seconds is one since then: 1973
_UNSET_BEFORE = -2 * 10**18  # [ns], 1906: programs that count from 1904 write this for none
_NAME = re.compile(
    r"t0|t_?start|(?:wf_)?start_?time|time_?start|start_?zeit|wf_?start_?offset|time_?offset|begin_?time"
)
_NAME_OF_A_DATE = re.compile(
    r"start|begin(?:n|ning)?|date_?time|recorded|start_?date|measurement_?start|date"
)


class Start(NamedTuple):
    """When the first sample of a table was."""

    ns: int
    dated: bool  # since 1970, otherwise since a zero of the file


def start_in(said: Mapping[str, Any]) -> Start | None:
    """Find when a table begins among the numbers and words of its place; a start and an offset are added."""
    total, dated, found = 0, False, False
    for name, value in said.items():
        each = _start_of(name, value)
        if each is None or (dated and each.dated):
            continue
        total, dated, found = total + each.ns, dated or each.dated, True
    return Start(total, dated) if found else None


def seconds_as_start(seconds: float, origin_ns: int = 0) -> Start:
    """Make a start of time stamps in seconds; large ones are since 1970."""
    ns = origin_ns + round(seconds * 1e9)
    return Start(ns, ns > _DATED)


def _start_of(name: str, value: Any) -> Start | None:
    stem, unit = split_unit(name.strip())
    unit = usual(unit) or unit_in(stem, TIME)
    stem = stem.lower().replace(" ", "_")
    stem = stem.removesuffix(f"_{unit}") if unit else stem
    if isinstance(value, np.datetime64):
        ns = int(value.astype("datetime64[ns]").astype(np.int64))
        return Start(ns, True) if _NAME.fullmatch(stem) and ns > _UNSET_BEFORE else None
    if isinstance(value, str):
        is_named = _NAME.fullmatch(stem) or _NAME_OF_A_DATE.fullmatch(stem)
        return Start(int(moments_in_ns([value])[0]), True) if is_named and is_moment(value) else None
    if _NAME.fullmatch(stem) and isinstance(value, int | float) and np.isfinite(value) and abs(value) < 9e9:
        return seconds_as_start(value * TIME.get(unit, 1.0))
    return None
