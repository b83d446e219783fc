"""Maker's factors of a bearing: what follows from those that are given, and what contradicts.

Makers list the orders BPFO, BPFI, BSF and FTF in place of inner dimensions. With the number of rolling
elements Z, g = (d/D) cos(a) and the contact angle a: FTF = (1 - g)/2, BPFO = Z FTF, BPFI = Z (1 + g)/2,
BSF = cos(a) (1 - g^2)/(2 g).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import isfinite, isnan, nan
from typing import Annotated as A
from typing import Any, NamedTuple

from beardyn_core.bearing.kinematics import FaultFrequencies

SYMBOLS = ("bpfo", "bpfi", "bsf", "ftf")
PARTS = {"cup": ("bpfo",), "cone": ("bpfi",), "roller": ("bsf", "ftf")}
_SLACK = 0.003  # between factors of one list, which makers round and compute in several ways, [-]
_COARSEST = 0.01  # of an order that follows, by the digits of those it follows from, [-]
_LEAST_COSINE = 0.5  # of the contact angle of a radial bearing, [-]
_LARGEST_GAMMA = 0.5
_SEARCHED = 0.02  # of an order, within which a monitor searches, [-]
# beyond which no usual bearing has a factor; of passes 80 rolling elements of one row
_LARGEST = {"bpfo": 40.0, "bpfi": 40.0, "bsf": 20.0, "ftf": 1.0}
PER_TURN = (
    "a factor is per turn of the shaft: if this is a frequency in hertz, divide it by the speed of the "
    "shaft in hertz"
)


@dataclass(frozen=True)
class Factors:
    """What is known of a bearing, NaN or 0 where it is not."""

    bpfo: A[float, "[-]"] = nan
    bpfi: A[float, "[-]"] = nan
    bsf: A[float, "spin of a rolling element, not twice it, [-]"] = nan
    ftf: A[float, "[-]"] = nan
    roller_count: A[int, "of one row"] = 0
    ratio: A[float, "rolling element over pitch diameter, [-]"] = nan
    angle: A[float, "contact angle, [rad]"] = nan

    def given(self) -> dict[str, float]:
        """List the factors that are known."""
        return {name: value for name in SYMBOLS if not isnan(value := getattr(self, name))}

    def rounding(self, name: str) -> float:
        """Half of the last digit that a factor is written with; NaN where it is not known.

        A list has as many digits for all passes and spins: 2 next to 3.585 is 2.000. Of the cage it may have
        fewer.
        """
        if isnan(getattr(self, name)):
            return nan
        if name == "ftf":
            return 0.5 * 10.0 ** -max(2, _digits(self.ftf))
        return 0.5 * 10.0 ** -max(1, *map(_digits, (self.bpfo, self.bpfi, self.bsf)))


class Derived(NamedTuple):
    """What follows."""

    roller_count: A[int, "0: it does not follow"]
    frequencies: A[FaultFrequencies, "NaN: it does not follow"]
    missing: A[dict[str, str], "why, by the symbol of what does not follow"]


class _Gamma(NamedTuple):
    value: float
    doubt: float  # by the digits of what it follows from
    source: str


def derive(known: Factors) -> Derived:
    """Derive the fault frequencies that are not given from those that are; what does not follow is NaN.

    Parameters
    ----------
    known : Factors
        Free of contradictions.
    """
    count, gamma = _count_of(known), _gamma_of(known)
    found = {name: getattr(known, name) for name in SYMBOLS}
    missing = {}
    for name in SYMBOLS:
        if not isnan(found[name]):
            continue
        found[name], why = _follow(name, known, count, gamma)
        if why:
            missing[name] = why
    orders = FaultFrequencies(**found)
    return Derived(count, orders, missing)


def _follow(name: str, known: Factors, count: int, gamma: _Gamma | None) -> tuple[float, str]:
    """Derive one factor: its value, and why it has none."""
    if gamma is None:
        return nan, "it follows from none of the others"
    g = gamma.value
    if name in ("bpfo", "bpfi") and not count:
        return nan, "the number of rolling elements is not known; give roller_count"
    if name == "bsf" and isnan(known.angle):
        return nan, "the contact angle is not known; give bsf or contact_angle_deg"
    value, doubt = {
        "bpfo": (0.5 * count * (1.0 - g), gamma.doubt / (1.0 - g)),
        "bpfi": (0.5 * count * (1.0 + g), gamma.doubt / (1.0 + g)),
        "ftf": (0.5 * (1.0 - g), gamma.doubt / (1.0 - g)),
        "bsf": (0.5 * math.cos(known.angle) * (1.0 - g**2) / g, gamma.doubt / g),
    }[name]
    if doubt > _COARSEST:
        return nan, (
            f"from the digits of {gamma.source} it would be known to {100.0 * doubt:.2g} % only; give more "
            f"digits, or {name}"
        )
    return value, ""


def _count_of(known: Factors) -> int:
    """Find the number of rolling elements; 0 where several fit."""
    if known.roller_count:
        return known.roller_count
    if isfinite(known.bpfo + known.bpfi):
        return round(known.bpfo + known.bpfi)
    exact = 0.5 * (1.0 - known.ratio * math.cos(known.angle))  # NaN without diameters
    cage, doubt = (exact, 0.0) if isfinite(exact) else (known.ftf, known.rounding("ftf"))
    for name, share in (("bpfo", cage), ("bpfi", 1.0 - cage)):
        order = getattr(known, name)
        if isfinite(order + share):
            wide = order / share * (known.rounding(name) / order + doubt / share + _SLACK)
            fitting = range(math.ceil(order / share - wide), math.floor(order / share + wide) + 1)
            return fitting[0] if len(fitting) == 1 else 0
    return 0


def _gamma_of(known: Factors) -> _Gamma | None:
    """Find (d/D) cos(a) from what gives it best."""
    count, found = _count_of(known), []
    if isfinite(known.ratio * known.angle):
        found.append(_Gamma(known.ratio * math.cos(known.angle), 0.0, "the diameters"))
    out, inner = known.rounding("bpfo"), known.rounding("bpfi")
    if count and isfinite(known.bpfo + known.bpfi):
        found.append(_Gamma((known.bpfi - known.bpfo) / count, (out + inner) / count, "bpfo and bpfi"))
    elif count and isfinite(known.bpfo):
        found.append(_Gamma(1.0 - 2.0 * known.bpfo / count, 2.0 * out / count, "bpfo"))
    elif count and isfinite(known.bpfi):
        found.append(_Gamma(2.0 * known.bpfi / count - 1.0, 2.0 * inner / count, "bpfi"))
    if isfinite(known.ftf):
        found.append(_Gamma(1.0 - 2.0 * known.ftf, 2.0 * known.rounding("ftf"), "ftf"))
    return min(found, key=lambda each: each.doubt, default=None)


def contradictions(known: Factors) -> Iterator[str]:
    """Find what factors cannot be together, as sentences with the keys of bearing data."""
    given = known.given()
    hertz: dict[str, Any] = {}
    for name, value in given.items():
        if not value > 0.0:
            yield f"{name} is {value:g}; it must be greater than 0"
        elif value > _LARGEST[name] and not (name in ("bpfo", "bpfi") and value < known.roller_count):
            yield f"{name} is {value:g}; it must be at most {_LARGEST[name]:g}; {PER_TURN}"
            hertz[name] = nan
    known = replace(known, **hertz)
    if known.ftf >= 0.5:
        yield (
            f"ftf is {known.ftf:g}; it must be less than 0.5: the cage turns slower than half of the shaft "
            "where the outer ring is at rest"
        )
    elif known.ftf <= 0.5 * (1.0 - _LARGEST_GAMMA):
        yield f"ftf is {known.ftf:g}; it must be greater than {0.5 * (1.0 - _LARGEST_GAMMA):g}"
    if known.bpfo >= known.bpfi:
        yield (
            f"bpfo is {known.bpfo:g} and bpfi is {known.bpfi:g}; bpfo must be less than bpfi: are they "
            "exchanged?"
        )
    if any(value <= 0.0 for value in given.values()):
        return
    if known.ftf >= 0.5:
        known = replace(known, ftf=nan)
    yield from _too_few_digits(known)
    yield from _against_count(known)
    yield from _against_cage(known)
    yield from _against_diameters(known)
    yield from _against_spin(known)


def _too_few_digits(known: Factors) -> Iterator[str]:
    """Find factors whose last digit leaves their order open by more than a monitor searches.

    The zeros of 5.000 are not in the number 5: there FTF with two digits, which the other checks compare
    with BPFO and BPFI, or the diameters show that they are meant.
    """
    counted = bool(known.roller_count) or isfinite(known.bpfo + known.bpfi)
    if isfinite(known.ratio * known.angle) or (counted and _digits(known.ftf) >= 2):
        return
    passes, spin = max(_digits(known.bpfo), _digits(known.bpfi)), _digits(known.bsf)
    both = max(passes, spin)
    # a spin with digits next to whole passes is of another list: a sum is whole however they are rounded
    digits = dict.fromkeys(("bpfo", "bpfi"), both if passes else 0) | {"bsf": both}
    for name, value in known.given().items():
        doubt = 0.5 * 10.0 ** -digits.get(name, _digits(known.ftf)) / value
        passed = isfinite(known.bpfo) or isfinite(known.bpfi)
        if doubt <= _SEARCHED or (name == "ftf" and counted and passed):
            continue
        needed = math.ceil(math.log10(0.5 / (_SEARCHED * value)))
        also = "roller_count and ftf, or the diameters" if name != "ftf" else "bpfo and bpfi"
        yield (
            f"{name} is {value:g}; its last digit leaves the order open by {100.0 * doubt:.2g} %, and a "
            f"monitor searches within {100.0 * _SEARCHED:g} %: give it with {needed} or more digits behind "
            f"the point; where {value:.{needed}f} is exact, give {also}, too"
        )


def _against_count(known: Factors) -> Iterator[str]:
    total = known.bpfo + known.bpfi
    if not isfinite(total):
        for name, order, most in (("bpfo", known.bpfo, 0.5), ("bpfi", known.bpfi, 1.0)):
            least = 0.25 if name == "bpfo" else 0.5
            if known.roller_count and isfinite(order):
                low, high = least * known.roller_count, most * known.roller_count
                if not low < order < high:
                    yield (
                        f"{name} is {order:g} and roller_count is {known.roller_count}; {name} must be "
                        f"between {low:g} and {high:g} then"
                    )
        return
    doubt = known.rounding("bpfo") + known.rounding("bpfi") + _SLACK
    wanted = known.roller_count or round(total)
    if abs(total - wanted) > doubt:
        what = f"roller_count, {wanted}" if known.roller_count else "a whole number"
        yield (
            f"bpfo + bpfi is {known.bpfo:g} + {known.bpfi:g} = {total:.6g}; it must be {what}: it is the "
            "number of rolling elements of one row"
        )


def _against_cage(known: Factors) -> Iterator[str]:
    count = known.roller_count or (round(known.bpfo + known.bpfi) if isfinite(known.bpfo + known.bpfi) else 0)
    if not count or isnan(known.ftf):
        return
    for name, order, share in (("bpfo", known.bpfo, known.ftf), ("bpfi", known.bpfi, 1.0 - known.ftf)):
        if isfinite(order):
            doubt = count * known.rounding("ftf") + known.rounding(name) + _SLACK * order
            if abs(order - count * share) > doubt:
                law = "ftf" if name == "bpfo" else "(1 - ftf)"
                yield (
                    f"{name} is {order:g}, ftf is {known.ftf:g} and there are {count} rolling elements; "
                    f"{name} must be {count} x {law} = {count * share:.4g} then"
                )
                return


def _against_diameters(known: Factors) -> Iterator[str]:
    if not isfinite(known.ratio * known.angle):
        return
    gamma = known.ratio * math.cos(known.angle)
    for name, order, share in (
        ("bpfo", known.bpfo, 0.5 * (1.0 - gamma)),
        ("bpfi", known.bpfi, 0.5 * (1.0 + gamma)),
        ("ftf", known.ftf, 0.5 * (1.0 - gamma)),
    ):
        count = 1 if name == "ftf" else known.roller_count
        if (
            isfinite(order)
            and count
            and abs(order - count * share) > known.rounding(name) + _COARSEST * order
        ):
            yield f"{name} is {order:g}; from the diameters it is {count * share:.5g}"


def _against_spin(known: Factors) -> Iterator[str]:
    gamma = _gamma_of(known)
    if isnan(known.bsf) or gamma is None or not 0.0 < gamma.value < _LARGEST_GAMMA:
        return
    g = gamma.value
    largest = 0.5 * (1.0 - g**2) / g
    doubt = gamma.doubt / g + known.rounding("bsf") / known.bsf + _COARSEST
    cosine = known.bsf / largest
    if isfinite(known.angle) and abs(cosine / math.cos(known.angle) - 1.0) <= doubt:
        return
    others = f"with {gamma.source} and no contact angle it is {largest:.4g}"
    if cosine > 1.0 + doubt:
        half = known.bsf / 2.0
        twice = 2.0 * _LEAST_COSINE <= cosine <= 2.0 * (1.0 + doubt)
        hint = f": some makers list twice the spin, give {half:g} then" if twice else ""
        yield f"bsf is {known.bsf:g}; {others}, and a contact angle makes it less{hint}"
    elif cosine < _LEAST_COSINE - doubt:
        yield (
            f"bsf is {known.bsf:g}; {others}, and a contact angle of 60 degrees makes it half of that: it "
            "must be more"
        )
    elif isfinite(known.angle):
        yield (
            f"bsf is {known.bsf:g}; with {gamma.source} and a contact angle of "
            f"{math.degrees(known.angle):g} degrees it is {largest * math.cos(known.angle):.4g}"
        )


def _digits(value: float) -> int:
    """Count the digits behind the point that a number is written with."""
    return len(f"{value:.6g}".partition(".")[2]) if isfinite(value) else 0
