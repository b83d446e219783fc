"""Sampling rates that files claim, and the one function that decides which is true.

A claim is a value with its unit at a place in the file. It may have several readings (``512.000 Hz``). The
nearest place counts: the channel itself, its struct or group, the file. What is no sampling rate of a
vibration is not believed, and two claims that differ are refused.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import isfinite, isnan, nan
from typing import Annotated as A
from typing import Any

from beardyn_core.measured.units import TIME, sampling_factor, split_unit, usual

SLOWEST, FASTEST = 200.0, 10e6
"""Limits of a claimed rate of a vibration, [Hz]."""
_SLOWEST_SPEED = 0.01  # [Hz], of a channel with the speed of the shaft
_SLOWEST_ASKED, _FASTEST_ASKED = 1.0, 1e8  # [Hz], where a person has given the unit of time
SAME = 1e-3  # within which two rates are one
_CONTRADICTS = 1e-2  # beyond which two claims are refused
_ELSEWHERE = 1000

_RATE_NAME = re.compile(
    r"fs|sr|sps|fsamp(?:le|ling)?|(?:sampl(?:e|ing)|scan|acq(?:uisition)?|daq|adc|abtast)(?:rate|freq(?:uency)?|"
    r"frequenz|s?persecond|clockrate)|samplespersecond|frequencedechantillonnage|frecuenciademuestreo|"
    r"frequenzadicampionamento|bemonsteringsfrequentie|samplingf"
)
_STEP_NAME = re.compile(
    r"dt|ts|tsamp(?:le)?|timestep|(?:wf|x|time)?increment|deltat(?:ime)?|sampl(?:e|ing)(?:interval|period|time)|"
    r"abtast(?:intervall|zeit|periode)|perioded?echantillonnage|pasdetemps|xinc"
)
_UNIT_BEHIND = re.compile(r"(.+?)[_ .\-]?(kHz|khz|MHz|Hz|hz|HZ|[kM]?S/s|ms|us|ns|usec|msec|sec|s)")
_GROUPED = re.compile(r"\d{1,3}(?:([.,' \u00a0\u2009\u202f_’])\d{3})(?:\1\d{3})*(?:[.,]\d+)?")
_QUANTITY = re.compile(
    r"([-+]?[\d][\d.,'’_ \u00a0\u2009\u202f]*(?:[eE][-+]?\d+)?|[-+]?[.,]\d+(?:[eE][-+]?\d+)?)\s*(.*)"
)
_THOUSANDS = "' \u00a0\u2009\u202f_’"


@dataclass(frozen=True)
class Claim:
    """What a file claims to be the sampling rate."""

    what: A[str, "as the file has it: ``vib.fs = 25.6 kHz``"]
    rates: A[tuple[float, ...], "every reading, empty where it is not understood, [Hz]"]
    place: A[tuple[str, ...], "struct, group or channel that it stands in; empty: the file"] = ()
    distance: A[int, "from the channel: 0 its own, 1 its group, ..."] = 0


@dataclass(frozen=True)
class Stamps:
    """What the time stamps of a table claim."""

    what: str
    rate: A[float, "with their unit, or in seconds, [Hz]"]
    has_unit: A[bool, "whether file or person state the unit"]
    asked: A[bool, "whether a person has stated it"]
    uncertainty: A[float, "share by which the rate may be wrong"] = 0.0


@dataclass
class Decision:
    """The sampling rate, and what is to be said of it."""

    rate: A[float, "NaN where it must be asked for, [Hz]"] = nan
    seconds: A[float, "in one unit of the time stamps, times the unit they were read with"] = 1.0
    problems: A[list[str], "sentences without the file"] = field(default_factory=list)
    warnings: A[list[str], "sentences without the file"] = field(default_factory=list)


def claims_in(said: Mapping[str, Any], place: tuple[str, ...] = (), shown: str = "") -> list[Claim]:
    """Find the claims among numbers and words of one place of a file, by their names.

    Parameters
    ----------
    said : mapping
        Numbers or texts with units, by name.
    place : tuple of str
        Where they stand.
    shown : str
        What is written before a name.
    """
    found = []
    for name, value in said.items():
        kind, unit = _kind_of(name)
        if kind and ":" not in str(value):  # a time of day
            unit = unit or _unit_beside(name, said)
            written = f"{value:.9g}" if isinstance(value, float | int) else str(value).strip()[:60]
            found.append(Claim(f"{shown}{name} = {written}", tuple(_readings(kind, unit, value)), place))
    return found


def claims_by_path(said: Mapping[str, Any]) -> list[Claim]:
    """Find the claims among what a file says by path: ``vib.fs``."""
    places: dict[str, dict[str, Any]] = {}
    for path, value in said.items():
        above, _, name = path.replace("/", ".").rpartition(".")
        places.setdefault(above, {})[name] = value
    return [
        claim
        for above, names in places.items()
        for claim in claims_in(names, tuple(above.split(".")) if above else (), f"{above}." if above else "")
    ]


def claims_on(
    channel: tuple[str, ...], claims: Iterable[Claim], channels: Iterable[tuple[str, ...]]
) -> tuple[Claim, ...]:
    """Give the claims on one channel, the nearest first.

    What stands next to other channels, in a struct or group that this one is not in, belongs to them.

    Parameters
    ----------
    channel : tuple of str
        Its path, its name last.
    claims : iterable of Claim
    channels : iterable of tuple
        Paths of all channels.
    """
    branches = {path[: k + 1] for path in channels for k in range(len(path))}
    found = []
    for claim in claims:
        common = 0
        while common < min(len(channel), len(claim.place)) and channel[common] == claim.place[common]:
            common += 1
        beside = common < len(claim.place)
        if beside and claim.place[: common + 1] in branches:
            continue
        found.append(replace(claim, distance=len(channel) - common + (_ELSEWHERE if beside else 0)))
    return tuple(sorted(found, key=lambda claim: claim.distance))


def decide_rate(
    claims: Sequence[Claim],
    stamps: Stamps | None,
    asked: float | None,
    *,
    name: str,
    is_vibration: bool,
) -> Decision:
    """Decide on the sampling rate of a table: the one that a person gives, else the one claim of the file.

    Parameters
    ----------
    claims : sequence of Claim
        On its channels.
    stamps : Stamps, optional
        Its time stamps, where it has some that are usable.
    asked : float, optional
        What a person says, [Hz].
    name : str
        A channel of the table.
    is_vibration : bool
        Whether its limits are those of a vibration.
    """
    out = Decision()
    if asked is not None:
        if stamps is not None and not stamps.has_unit:
            out.seconds = _unit_that_gives(stamps, asked)
        every = [(f"states {c.what},", c.rates) for c in claims]
        every += [(stamps.what, (stamps.rate,))] if stamps is not None else []
        for what, rates in every:
            differs = rates and all(abs(rate - asked) > SAME * asked for rate in rates)
            if differs and not (stamps is not None and what == stamps.what and out.seconds != 1.0):
                out.warnings.append(f"{what} {_hertz(rates)}; taken are {asked:.6g} Hz, as asked")
        out.rate = asked
        return out
    near, doubtful = _nearest(claims, is_vibration)
    if stamps is not None and not near and _is_stamp_usable(stamps, is_vibration):
        out.rate = stamps.rate
        if is_vibration and stamps.rate < SLOWEST:
            out.warnings.append(
                f"{stamps.what} {stamps.rate:.6g} Hz, slow for a vibration; give --time-unit if theirs is "
                "wrong"
            )
        if stamps.uncertainty > SAME:
            out.warnings.append(
                f"{stamps.what} {stamps.rate:.6g} Hz and are so coarse that it may be wrong by "
                f"{100.0 * stamps.uncertainty:.2g} %; give --rate-hz if it is known"
            )
    elif near:
        _agree(near, stamps, is_vibration, out)
    elif stamps is not None or doubtful:
        _ask(doubtful, stamps, is_vibration, out)
    else:
        out.problems.append(
            f"does not state the rate at which {name} was sampled; give --rate-hz or --time-channel"
        )
    if not out.problems:
        out.warnings += [
            f"{claim.what} is not taken as a sampling rate ({_doubt(claim, is_vibration)}); taken is "
            f"{out.rate:.6g} Hz"
            for claim in doubtful
        ]
        nearest = round(out.rate)
        if nearest and abs(out.rate - nearest) < 1e-6 * out.rate:
            out.rate = float(nearest)
    return out


def is_plausible(rate: float, is_vibration: bool = True) -> bool:
    """Tell whether a rate [Hz] may be that of a vibration, or of a channel with the speed."""
    return (SLOWEST if is_vibration else _SLOWEST_SPEED) <= rate <= FASTEST


def _nearest(claims: Sequence[Claim], is_vibration: bool) -> tuple[list[Claim], list[Claim]]:
    """Give the plausible claims of the nearest place that has some, and the nearer ones not believed."""
    near: list[Claim] = []
    doubtful: list[Claim] = []
    for claim in sorted(dict.fromkeys(claims), key=lambda each: each.distance):
        if near and claim.distance > near[0].distance:
            break
        rates = tuple(rate for rate in claim.rates if is_plausible(rate, is_vibration))
        (near if rates else doubtful).append(replace(claim, rates=rates or claim.rates))
    return near, doubtful


def _is_stamp_usable(stamps: Stamps, is_vibration: bool) -> bool:
    """Tell whether stamps give the rate: slow ones do where their unit is certain."""
    if stamps.asked:
        return _SLOWEST_ASKED <= stamps.rate <= _FASTEST_ASKED
    slowest = _SLOWEST_ASKED if stamps.has_unit and is_vibration else 0.0
    return is_plausible(stamps.rate, is_vibration) or 0.0 < slowest <= stamps.rate < SLOWEST


def _agree(near: list[Claim], stamps: Stamps | None, is_vibration: bool, out: Decision) -> None:
    """Find the one rate that all claims can mean."""
    common = [rate for rate in near[0].rates if all(_fits(rate, each.rates) for each in near)]
    common = [rate for k, rate in enumerate(common) if not _fits(rate, common[:k])]
    if not common:
        each = " and ".join(f"{claim.what} ({_hertz(claim.rates)})" for claim in near)
        out.problems.append(f"states {each}; give --rate-hz with the right one")
        return
    if stamps is None:
        if len(common) > 1:
            out.problems.append(
                f"states {near[0].what}, which may be {_hertz(common)}; give --rate-hz with the right one"
            )
        else:
            out.rate = common[0]
        return
    with_stamps = [rate for rate in common if abs(stamps.rate - rate) <= _CONTRADICTS * rate]
    if with_stamps:
        out.rate = with_stamps[0]
        if abs(stamps.rate - out.rate) > SAME * out.rate + stamps.uncertainty * out.rate:
            out.warnings.append(
                f"states {near[0].what} ({out.rate:.6g} Hz) and {stamps.what} {stamps.rate:.6g} Hz; taken is "
                f"{out.rate:.6g} Hz; give --rate-hz if that is wrong"
            )
        return
    for rate in common if not stamps.has_unit else ():
        if (factor := _unit_that_gives(stamps, rate)) != 1.0:
            out.rate, out.seconds = rate, factor
            return
    out.problems.append(
        f"states {near[0].what} ({_hertz(common)}) and {stamps.what} {stamps.rate:.6g} Hz; "
        "give --rate-hz with the right one"
    )


def _unit_that_gives(stamps: Stamps, rate: float) -> float:
    """Find the unit [s] in which stamps without one agree with a rate; a second where none does."""
    fitting = (factor for factor in TIME.values() if abs(stamps.rate / factor - rate) <= SAME * rate)
    return next(fitting, 1.0)


def _ask(doubtful: list[Claim], stamps: Stamps | None, is_vibration: bool, out: Decision) -> None:
    """Ask for the rate where nothing that is claimed can be one."""
    what = "a vibration" if is_vibration else "a channel with the speed"
    allowed = f"{SLOWEST if is_vibration else _SLOWEST_SPEED:g} Hz to {FASTEST * 1e-6:g} MHz"
    for claim in doubtful:
        out.problems.append(
            f"states {claim.what}, {_doubt(claim, is_vibration)}; the sampling rate of {what} is {allowed}: "
            "give --rate-hz"
        )
    if stamps is None:
        return
    if stamps.has_unit:
        out.problems.append(
            f"{stamps.what} {stamps.rate:.6g} Hz; the sampling rate of {what} is {allowed}: give --time-unit "
            "or --rate-hz"
        )
        return
    fitting = [unit for unit, factor in TIME.items() if is_plausible(stamps.rate / factor, is_vibration)]
    hint = ", ".join(f"{unit} ({stamps.rate / TIME[unit]:.6g} Hz)" for unit in fitting)
    slow = "too slow" if stamps.rate < SLOWEST else "too fast"
    out.problems.append(
        f"{stamps.what} {stamps.rate:.6g} Hz if they are in s, {slow} for {what}; give --time-unit, one of "
        f"{', '.join(TIME)}{f', such as {hint}' if hint else ''}, or --rate-hz"
    )


def _fits(rate: float, rates: Iterable[float]) -> bool:
    return any(abs(rate - other) <= _CONTRADICTS * other for other in rates)


def _hertz(rates: Iterable[float]) -> str:
    return " or ".join(f"{rate:.6g} Hz" for rate in rates)


def _doubt(claim: Claim, is_vibration: bool) -> str:
    if not claim.rates:
        return "whose value or unit is not understood"
    return f"which is {_hertz(claim.rates)}"


def _kind_of(name: str) -> tuple[str, str]:
    """Tell whether a name is that of a rate or a step, '' for neither, with the unit it has in it."""
    stem, unit = split_unit(name)
    plain = unicodedata.normalize("NFKD", stem.replace("µ", "u")).encode("ascii", "ignore").decode()
    if kind := _kind_of_words(plain, unit):
        return kind, unit
    if not unit and (found := _UNIT_BEHIND.fullmatch(plain)) and (kind := _kind_of_words(found[1], found[2])):
        return kind, found[2]
    return "", ""


def _kind_of_words(text: str, unit: str) -> str:
    joined = re.sub(r"[^a-z0-9]", "", text.lower())
    of_sampling = isfinite(sampling_factor(unit)) if unit else False
    if _RATE_NAME.fullmatch(joined) or (of_sampling and joined in ("rate", "scans")):
        return "rate"
    return "step" if _STEP_NAME.fullmatch(joined) else ""


def _unit_beside(name: str, said: Mapping[str, Any]) -> str:
    for ending in ("unit", "units", "_unit", "_units", ".unit", ".units", " unit", " Unit", "Unit"):
        if isinstance(value := said.get(f"{name}{ending}"), str):
            return value
    return ""


def _readings(kind: str, unit: str, value: Any) -> list[float]:
    """Give the rates [Hz] that a value may mean; none where it or its unit is not understood."""
    if isinstance(value, float | int):
        return _in_hertz(kind, unit, [float(value)])
    cells = [cell.strip() for cell in re.split(r"[;\t]", str(value)) if cell.strip(" ,\"'")]
    found: list[list[float]] = []
    for cell in cells:
        match = _QUANTITY.fullmatch(cell.strip(" ,\"'"))
        if match is None:
            is_unit = isfinite(sampling_factor(cell)) or usual(cell) in TIME
            if found and is_unit:  # ``25.6;kHz``
                return _readings(kind, unit, f"{cells[0]} {cell}") if len(cells) == 2 else []
            continue
        own = re.sub(r"\s*(?:per|/)\s*(?:channel|kanal|ch)\b.*$|\s*\(.*\)$", "", match[2]).strip(" ,.")
        if own and unit and _same_unit(own, unit):
            own = ""
        if own and unit:  # two units
            return []
        found.append(_in_hertz(kind, own or unit, _numbers(match[1].strip())))
    if not found or any(set(each) != set(found[0]) for each in found):  # none, or a list of several
        return []
    return found[0]


def _same_unit(one: str, other: str) -> bool:
    return sampling_factor(one) == sampling_factor(other) or (usual(one) == usual(other) and one != "")


def _in_hertz(kind: str, unit: str, values: Iterable[float]) -> list[float]:
    """Write rates or steps in hertz; a unit of the other kind shows what it is."""
    rate = sampling_factor(unit) if unit else 1.0
    step = TIME.get(usual(unit), nan) if unit else 1.0
    values = [value for value in values if value > 0.0 and isfinite(value)]
    if kind == "rate":
        return [] if isnan(rate) else [float(f"{value * rate:.12g}") for value in values]
    return [] if isnan(step) else [float(f"{1.0 / (value * step):.12g}") for value in values]


def _numbers(text: str) -> list[float]:
    """Give the numbers that a text may mean: ``25,600`` is 25.6 and 25600, ``25.600,0`` only 25600."""
    text = text.strip(" ,.")
    mantissa, sign, exponent = re.fullmatch(r"(.*?)(?:([eE])(.*))?", text).groups()  # type: ignore[union-attr]
    power = f"e{exponent}" if sign else ""
    plain = mantissa
    spaced = any(mark in mantissa for mark in _THOUSANDS)
    if spaced:
        if not _GROUPED.fullmatch(mantissa):
            return []
        for mark in _THOUSANDS:
            plain = plain.replace(mark, "")
    points, commas = plain.count("."), plain.count(",")
    texts = []
    if points and commas:  # the last one is the decimal sign
        decimal = "." if plain.rfind(".") > plain.rfind(",") else ","
        other = "," if decimal == "." else "."
        if plain.count(decimal) == 1 and _GROUPED.fullmatch(plain.lstrip("+-")):
            texts.append(plain.replace(other, "").replace(decimal, "."))
    elif points + commas > 1:
        if _GROUPED.fullmatch(plain.lstrip("+-")):
            texts.append(plain.replace(",", "").replace(".", ""))
    elif re.fullmatch(r"\d{4,},[1-9]\d{2,}", plain):  # one number, or a list of two
        return []
    else:
        texts.append(plain.replace(",", "."))
        if points + commas and not spaced and not power and re.fullmatch(r"[1-9]\d{0,2}[.,]\d{3}", plain):
            texts.append(plain.replace(",", "").replace(".", ""))
    try:
        return [float(f"{each}{power}") for each in texts]
    except ValueError:
        return []
