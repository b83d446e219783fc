"""What a recording says against a load that is stated: the bearing, the lateral load, speed, the vehicle."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite, pi
from typing import Annotated as A

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.bearing.life import load_doubts
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.follow.known_load import KnownLoad

LEAST_USUAL, MOST_USUAL = 12e3, 200e3  # on a journal: axles of some 4 to 42 t on the rail, [N]
WHEELSET_MASS = 1500.0  # that the journals do not carry, where nobody says; assumed [kg]
_PRUD_HOMME, _PRUD_HOMME_SHARE = 10e3, 1.0 / 3.0
FAST, FAST_AXLE = 200.0 / 3.6, 22_500.0
_TONNE = 1e3


@dataclass(frozen=True)
class AxleLoads:
    """Axle loads that a vehicle can have, as masses on the rail."""

    empty: A[float, "[kg]"]
    full: A[float, "[kg]"]


def read_axle_loads(text: str, name: str = "--axle-load-t") -> AxleLoads | None:
    """Read ``EMPTY:FULL`` in tonnes; none of an empty text.

    Raises
    ------
    InputError
        It is no such pair.
    """
    if not text:
        return None
    match = re.fullmatch(r"\s*(\d+\.?\d*)\s*:\s*(\d+\.?\d*)\s*", text)
    if match is None or not 2.0 <= float(match[1]) < float(match[2]) <= 60.0:
        raise InputError(
            f"{name} is {text!r}; write EMPTY:FULL, masses of one axle on the rail in tonnes such as 12:17, "
            "from 2 to 60"
        )
    return AxleLoads(_TONNE * float(match[1]), _TONNE * float(match[2]))


@dataclass(frozen=True)
class Evidence:
    """What a recording says of the load besides, SI; NaN where it says nothing."""

    lateral: A[tuple[float, float] | None, "90 % interval of the mean lateral load, [N]"] = None
    speed: A[float, "of the vehicle, [m/s]"] = float("nan")
    axle_loads: AxleLoads | None = None


def doubts_of(load: KnownLoad, bearing: RollerBearing | None, evidence: Evidence) -> tuple[str, ...]:
    """Say what contradicts a load, in sentences; empty where nothing does.

    Raises
    ------
    InputError
        No such bearing can carry it.

    References
    ----------
    EN 14363, limit of the sum of lateral forces of a wheelset (Prud'homme): 10 kN and a third of the axle
    load. High-speed rolling stock TSI (2008/232/EC) 4.2.3.2: up to 22.5 t an axle, locomotives, to 230 km/h.
    """
    problem, doubt = "", ""
    if bearing is not None:
        problem, doubt = load_doubts(bearing, (0.0, 0.0, load.value))
    if problem:
        raise InputError(f"known vertical load, {load.source}: {problem}")
    found = [*load.doubts, *([f"known vertical load: {doubt}"] if doubt else [])]
    return tuple(dict.fromkeys([*found, *_against(load, evidence)]))


def _against(load: KnownLoad, evidence: Evidence) -> Iterator[str]:
    low, high = load.interval
    stated = f"known vertical load of {load.value / 1e3:.3g} kN"
    if high < LEAST_USUAL or low > MOST_USUAL:
        yield (
            f"{stated}: journals of railway axles carry {LEAST_USUAL / 1e3:.0f} to "
            f"{MOST_USUAL / 1e3:.0f} kN; check the unit, and that it is of one journal"
        )
    yield from _against_vehicle(stated, low, high, evidence.axle_loads)
    if evidence.lateral is not None and (sideways := _least_size(evidence.lateral)) > _lateral_limit(high):
        yield (
            f"{stated} is too small for the estimated lateral load, at least {sideways / 1e3:.3g} kN: a "
            f"track withstands {_lateral_limit(high) / 1e3:.3g} kN of such an axle (EN 14363)"
        )
    if isfinite(evidence.speed) and evidence.speed > FAST and _axle_mass(low) > FAST_AXLE:
        yield (
            f"{stated} is an axle of {_axle_mass(load.value) / 1e3:.3g} t at {3.6 * evidence.speed:.0f} "
            f"km/h; above {3.6 * FAST:.0f} km/h axles are lighter than "
            f"{FAST_AXLE / 1e3:g} t: is it of one journal?"
        )


def _against_vehicle(stated: str, low: float, high: float, axles: AxleLoads | None) -> Iterator[str]:
    if axles is None:
        return
    empty, full = (0.5 * (each - WHEELSET_MASS) * STANDARD_GRAVITY for each in (axles.empty, axles.full))
    if low <= full and high >= empty:
        return
    usual = f"{empty / 1e3:.3g} to {full / 1e3:.3g} kN"
    hint = ""
    if low <= 2.0 * full + WHEELSET_MASS * STANDARD_GRAVITY and high >= 2.0 * empty:
        hint = "; is it the load of the whole axle?"
    yield (
        f"{stated} is outside of what the vehicle puts on a journal, {usual} (axle loads "
        f"{axles.empty / 1e3:g} to {axles.full / 1e3:g} t, wheelset of {WHEELSET_MASS / 1e3:g} t "
        f"assumed){hint}"
    )


def _least_size(interval: tuple[float, float]) -> float:
    low, high = interval
    return 0.0 if low <= 0.0 <= high else min(abs(low), abs(high))


def _axle_mass(journal: float) -> float:
    """Give the mass on the rail under an axle of which each journal carries a load, [kg]."""
    return 2.0 * journal / STANDARD_GRAVITY + WHEELSET_MASS


def _lateral_limit(journal: float) -> float:
    return _PRUD_HOMME + _PRUD_HOMME_SHARE * _axle_mass(journal) * STANDARD_GRAVITY


def vehicle_speed(shaft_frequency: float, wheel_diameter: float) -> float:
    """Give the speed of the vehicle, [m/s]."""
    return pi * wheel_diameter * abs(shaft_frequency)
