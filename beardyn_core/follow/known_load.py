"""A vertical load that somebody knows: its value, how well it is known, and where it is from."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from math import exp, hypot, isfinite, log, sqrt
from typing import Annotated as A
from typing import Any

from beardyn_core.base.errors import InputError
from beardyn_core.base.units import STANDARD_GRAVITY

ASSUMED_SHARE = 0.1  # half width of the 90 % interval of a load that is stated without one
LARGEST_SHARE = 0.5
LEAST_N, MOST_N = 1e3, 400e3
NORMAL_90, NORMAL_50 = 1.6449, 0.6745
CONTRADICTS = 1.5  # half widths of both intervals together, about 2.5 standard deviations
_FORCES = {"kN": 1e3, "N": 1.0, "t": 1e3 * STANDARD_GRAVITY}
_NUMBER = r"(\d+\.?\d*|\.\d+)"
_WRITTEN = re.compile(rf"{_NUMBER}\s*(kN|N|t)?(?:\s*:\s*{_NUMBER}\s*(kN|N|t|%)?)?")
_HOW = "VALUE or VALUE:UNCERTAINTY, such as 80, 80:3 (kN) or 80:5%"


@dataclass(frozen=True)
class KnownLoad:
    """Vertical load on the journal that is known from outside of the vibration."""

    value: A[float, "most likely, [N]"]
    half_width: A[float, "of the 90 % interval, [N]"]
    source: A[str, "where it is from, in words"] = "stated"
    assumed: A[str, "what of the uncertainty is assumed, in words; empty"] = ""
    doubts: A[tuple[str, ...], "what contradicts it, in sentences"] = ()

    @property
    def deviation(self) -> float:
        """Standard deviation of its logarithm, the scale on which loads are estimated."""
        return self.half_width / self.value / NORMAL_90

    @property
    def interval(self) -> tuple[float, float]:
        """Both ends of 90 %, [N]."""
        return self.ends(NORMAL_90)

    def ends(self, deviations: float) -> tuple[float, float]:
        """Give both ends so many standard deviations away, [N]; the law is log-normal, so never below 0."""
        factor = exp(deviations * self.deviation)
        return self.value / factor, self.value * factor

    @property
    def sentence(self) -> str:
        """Say it in a line."""
        low, high = self.interval
        words = (
            f"known vertical load: {self.value / 1e3:.3g} kN, 90 % interval {low / 1e3:.3g} to "
            f"{high / 1e3:.3g} kN; {self.source}"
        )
        return f"{words}; {self.assumed}" if self.assumed else words


def read_load(text: str, name: str = "--load-kn") -> KnownLoad:
    """Read a load on one journal from a text.

    Parameters
    ----------
    text : str
        ``80``, ``80:3`` (kN) or ``80:5%``; other units are written behind a number: N, t. The second number
        is half of the 90 % interval, by default 10 % of the load.
    name : str
        What the text is called in messages.

    Raises
    ------
    InputError
        It is no load, or one that no railway journal carries.
    """
    match = _WRITTEN.fullmatch(text.strip())
    if match is None:
        raise InputError(f"{name} is {text!r}; write {_HOW}")
    number, unit, around, its_unit = match.groups()
    value = float(number) * _FORCES[unit or "kN"]
    if around is None:
        half, assumed = ASSUMED_SHARE * value, f"uncertainty of {100 * ASSUMED_SHARE:.0f} % assumed"
    else:
        assumed = ""
        half = (
            value * float(around) / 100.0
            if its_unit == "%"
            else float(around) * _FORCES[its_unit or unit or "kN"]
        )
    if not LEAST_N <= value <= MOST_N:
        hint = f"; were newtons meant? Then write {number}N" if not unit and value > MOST_N else ""
        raise InputError(
            f"{name} is {text!r}, {value / 1e3:.4g} kN on one journal; allowed are {LEAST_N / 1e3:g} to "
            f"{MOST_N / 1e3:g} kN{hint}"
        )
    return checked(KnownLoad(value, half, "stated", assumed), f"{name} is {text!r}")


def checked(load: KnownLoad, label: str) -> KnownLoad:
    """Refuse a load whose uncertainty is none, or is so large that nothing is known.

    Raises
    ------
    InputError
        With the label in front.
    """
    share = load.half_width / load.value
    if not (isfinite(share) and 0.0 < share <= LARGEST_SHARE):
        raise InputError(
            f"{label}: its uncertainty is {100 * share:.3g} % of it; it must be above 0 and at most "
            f"{100 * LARGEST_SHARE:.0f} %"
        )
    return load


def combine_loads(loads: Iterable[KnownLoad]) -> KnownLoad | None:
    """Combine what several sources say of one load; none of no source.

    Sources that agree are averaged by their precision on the logarithmic scale; their errors are taken as
    independent. Where two contradict, the result spans both, and says so: no average hides it.
    """
    given = list(loads)
    if len(given) < 2:
        return given[0] if given else None
    doubts = [each for load in given for each in load.doubts]
    apart = [pair for pair in combinations(given, 2) if _contradict(*pair)]
    sources = " and ".join(each.source for each in given)
    assumed = "; ".join(dict.fromkeys(each.assumed for each in given if each.assumed))
    for one, other in apart:
        doubts.append(
            f"two sources of the vertical load contradict: {_words(one)}, {_words(other)}; the interval "
            "spans both"
        )
    if apart:
        return _spanning(given, f"{sources}, which contradict", assumed, doubts)
    weights = [each.deviation**-2 for each in given]
    whole = sum(weights)
    middle = sum(weight * log(each.value) for weight, each in zip(weights, given, strict=True)) / whole
    return KnownLoad(
        exp(middle), NORMAL_90 / sqrt(whole) * exp(middle), sources, assumed, tuple(dict.fromkeys(doubts))
    )


def _spanning(given: Sequence[KnownLoad], source: str, assumed: str, doubts: Sequence[str]) -> KnownLoad:
    low = min(each.interval[0] for each in given)
    high = max(each.interval[1] for each in given)
    value = sqrt(low * high)
    return KnownLoad(value, 0.5 * log(high / low) * value, source, assumed, tuple(dict.fromkeys(doubts)))


def _contradict(one: KnownLoad, other: KnownLoad) -> bool:
    both = NORMAL_90 * hypot(one.deviation, other.deviation)
    return abs(log(one.value / other.value)) > CONTRADICTS * both


def _words(load: KnownLoad) -> str:
    return f"{load.source} {load.value / 1e3:.3g} ± {load.half_width / 1e3:.2g} kN"


def load_of_channel(channel: Mapping[str, Any]) -> KnownLoad:
    """Give the load that the channel of a measured recording has.

    Parameters
    ----------
    channel : mapping
        ``mean_N`` of its samples, ``uncertainty_N``, half of the 90 % interval, null: not stated, and
        ``channel``, its name.

    Raises
    ------
    InputError
        It is no load of a railway journal.
    """
    name, value = str(channel["channel"]), float(channel["mean_N"])
    stated = channel.get("uncertainty_N")
    assumed = f"uncertainty of {100 * ASSUMED_SHARE:.0f} % assumed" if stated is None else ""
    half = ASSUMED_SHARE * value if stated is None else float(stated)
    if not LEAST_N <= value <= MOST_N:
        raise InputError(
            f"channel {name}: its mean is {value / 1e3:.4g} kN on one journal; allowed are "
            f"{LEAST_N / 1e3:g} to {MOST_N / 1e3:g} kN: check --load-unit"
        )
    return checked(KnownLoad(value, half, f"channel {name}", assumed), f"channel {name}")
