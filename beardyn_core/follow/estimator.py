"""An estimator: what it was learnt from, how well it does, and the file that keeps it."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from math import inf, isfinite, nan
from pathlib import Path
from typing import Annotated as A
from typing import Any
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.base.inputs import size_of_file
from beardyn_core.base.outputs import as_a_whole
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import FaultFrequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.conformal import LEVELS, Learnt, Way
from beardyn_core.follow.descriptors import names_of
from beardyn_core.follow.familiarity import Familiarity
from beardyn_core.follow.fault_location import PartEstimate, PartRule
from beardyn_core.follow.forest import EventForest, Forest
from beardyn_core.follow.known_load import KnownLoad
from beardyn_core.follow.mounting import Mounting, check_mounting
from beardyn_core.follow.quantities import BY_NAME, Quantity
from beardyn_core.follow.regression import Regression
from beardyn_core.follow.wide_spall import LEAST_SHARE, WideRule
from beardyn_core.sensors.labels import HEALTHY

VERSION = 4
# of each way to a number: its arrays, and its numbers
_KINDS: dict[str, tuple[type[Regression] | type[Forest], tuple[str, ...], tuple[str, ...]]] = {
    "kernel": (
        Regression,
        ("directions", "support", "weights", "doubt_weights"),
        ("width", "mean", "doubt"),
    ),
    "events": (
        EventForest,
        ("descriptor", "number", "other", "roots", "reading"),
        ("usual", "offset", "slope", "start", "added", "doubt"),
    ),
    "trees": (Forest, ("descriptor", "number", "other", "roots"), ("usual", "offset", "slope")),
}
_PART = ("slope", "offset", "least")
AS_WIDE = 0.8  # of the range that 90 % of the runs learnt from have: an interval says nothing more than it
_BLURRED = "not identifiable from this signal: the interval is as wide as the range learnt from"
_UNPROVEN = "not reported: no runs prove its interval"
AT_EDGE = 0.97  # of the largest value learnt from: what reaches it may be any larger one
UNLIKE = (
    "the signal is unlike all that was learnt from (strangeness {:.1f}, familiar up to 1): another box, "
    "sensor place or track"
)
ELSEWHERE = f"not reported: {UNLIKE}"
_UNUSUAL = "not reported: the passages are unlike those learnt from (strangeness {:.1f}, familiar up to 1)"
_WIDE = ("readings", "offsets", "spacings")
_WIDE_NUMBERS = ("largest", "added", "doubt", "narrow", "wide")
_FAMILIAR = ("columns", "directions", "sizes")


@dataclass(frozen=True)
class Estimate:
    """What is known of one quantity."""

    quantity: Quantity
    value: A[float, "most likely, NaN where it is not identifiable, SI"]
    intervals: A[
        tuple[tuple[float, float], ...],
        "of 50 and of 90 %, SI; of the runs learnt from",
    ]
    reason: A[str, "why there is no value, or no more than `at_least`; empty"] = ""
    at_least: A[
        float, "lower end of the last interval, where the upper end is beyond what was learnt from"
    ] = nan
    source: A[str, "where it is from, where not from the vibration alone; empty"] = ""

    @property
    def sentence(self) -> str:
        """Write it in a line."""
        if self.reason:
            return f"{self.quantity.words}: {self.reason}"
        show, (low, high) = self.quantity.text, self.intervals[-1]
        words = (
            f"{self.quantity.words}: {show(self.value)}, {100 * LEVELS[-1]:.0f} % interval {show(low)} to "
            f"{show(high)}"
        )
        return f"{words}; {self.source}" if self.source else words


@dataclass(frozen=True)
class Estimates:
    """What an estimator makes of a run."""

    part: A[PartEstimate | None, "condition of the bearing; none where the estimator learnt one alone"]
    quantities: A[tuple[Estimate, ...], "in the order in which they are reported"]
    strangeness: A[float, "distance from the runs learnt from, 1 where one in twenty lies farther away, [-]"]
    stretches: A[int, "of the signal that were used"]
    shaft_frequency: A[float, "middle of the stretches, [Hz]"]
    known_load: A[KnownLoad | None, "vertical, from outside of the vibration"] = None
    mountings: A[tuple[Mounting, ...], "of the sensor that would make a strange signal familiar"] = ()

    @property
    def sentences(self) -> list[str]:
        """List everything, a line each."""
        lines = [] if self.part is None else [self.part.sentence]
        lines += [each.sentence for each in self.quantities]
        if self.strangeness > 1.0:
            lines.append(f"{UNLIKE.format(self.strangeness)}; no numbers are reported")
        if self.mountings:
            lines.append(check_mounting([each.sentence for each in self.mountings]))
        if self.known_load is not None:
            lines += [f"doubt: {each}" for each in self.known_load.doubts]
        return lines

    def __getitem__(self, name: str) -> Estimate:
        """Find a quantity by its name."""
        return next(each for each in self.quantities if each.quantity.name == name)


@dataclass(frozen=True, eq=False)
class Estimator:
    """Numbers that give estimates, and where they come from."""

    plate: A[NamePlate, "bearing that it was learnt for"]
    axes: A[tuple[str, ...], "of the accelerometer"]
    rate: A[float, "of the accelerometer, [Hz]"]
    stretch: A[float, "length of signal that it takes at once, [s]"]
    middle: A[Float, "shape [descriptor], mean of those learnt from"]
    spread: A[Float, "shape [descriptor], their standard deviation"]
    box: A[Familiarity, "of the levels of bands, which tell another box or sensor place"]
    passages: A[Familiarity, "of what repeats with the passages of a fault, on spalled bearings"]
    regressions: A[Mapping[str, Learnt], "by quantity"]
    part: A[PartRule | None, "which part is spalled; none where one condition alone was learnt"]
    wide: A[WideRule | None, "whether a spall is wide; none where no wide ones were learnt"]
    card: A[Mapping[str, Any], "set, counts, errors on bearings not learnt from, versions"]

    @property
    def orders(self) -> FaultFrequencies:
        """Fault frequencies of the bearing per revolution."""
        return self.plate.frequencies

    def standardise(self, descriptors: Float) -> Float:
        """Take descriptors, shape [run, descriptor], to zero mean and unit spread; what lacks is usual."""
        return np.nan_to_num((descriptors - self.middle) / self.spread, nan=0.0, posinf=0.0, neginf=0.0)

    def strangeness(self, descriptors: Float) -> Float:
        """Compute how far runs lie from those learnt from, shape [run]; one in twenty exceeds 1."""
        return self.box.distance(self.standardise(descriptors))

    def estimates(self, descriptors: Float) -> Estimates:
        """Estimate from stretches of one run, shape [stretch, descriptor].

        The middle of the stretches is reported, with the intervals of one stretch: what a box or a track has
        of its own is in all of them, and does not go away with their number.
        """
        standard = self.standardise(descriptors)
        part = None if self.part is None else self.part.estimate(standard)
        known = [BY_NAME[name] for name in BY_NAME if name in self.card["quantities"]]
        spalled = part is None or part.condition != HEALTHY
        strange, unusual = self._unlike(standard)
        if part is not None and self.part is not None and strange > 1.0:
            # in another box no condition is excluded
            part = replace(part, probability=nan, sets=(self.part.conditions,) * len(LEVELS))
        return Estimates(
            part,
            tuple(
                _silent(each, "no part is called spalled")
                if each.of_fault and not spalled
                else self._estimate(each, standard, strange, unusual)
                for each in known
            ),
            strange,
            len(descriptors),
            float(np.median(10.0 ** descriptors[:, names_of(self.axes).index("shaft")])),
        )

    def prior_estimate(self, quantity: Quantity) -> Estimate:
        """Give what is known of a quantity that no signal identifies: its range in the runs learnt from."""
        known = self.card["quantities"][quantity.name]
        return _silent(
            quantity,
            "not identifiable from these sensors",
            tuple((low, high) for low, high in known["ranges"]),
        )

    def ends_of(self, quantity: Quantity) -> tuple[float, float]:
        """Give the least and the largest value that was learnt from, SI."""
        low, high = self.card["quantities"][quantity.name].get("ends", (-inf, inf))
        return low, high

    def knows(self, standard: Float) -> NDArray[np.bool_]:
        """Tell which runs, shape [run], have a box and passages like those learnt from."""
        return np.asarray(
            (self.box.distance(standard) <= 1.0) & (self.passages.distance(standard) <= 1.0), bool
        )

    def reports(self, quantity: Quantity, standard: Float) -> NDArray[np.bool_]:
        """Tell of which runs, shape [run], the number of a quantity is reported."""
        learnt = self.regressions[quantity.name]
        reported = (self.box.distance(standard) <= 1.0) & bool(np.isfinite(learnt.reach).all())
        guess = learnt.guess(standard)
        reported &= guess.high[-1] - guess.low[-1] < AS_WIDE * self._range(quantity)
        if quantity.of_passages:
            value, low, high = (
                quantity.restored(each) for each in (guess.value, guess.low[-1], guess.high[-1])
            )
            reported &= self.knows(standard) & (high < AT_EDGE * self.ends_of(quantity)[1])
            if self.wide is not None:
                reported &= self.wide.chance(standard, value, low, high) <= self.wide.narrow
                reported &= high < AT_EDGE * self.wide.half(standard)
        return np.asarray(reported, bool)

    def _range(self, quantity: Quantity) -> float:
        """Give the range that 90 % of the runs learnt from have, on the scale of learning."""
        low, high = quantity.scaled(np.array(self.card["quantities"][quantity.name]["ranges"][-1])).tolist()
        return float(high - low)

    def _unlike(self, standard: Float) -> tuple[float, float]:
        """Measure how unlike what was learnt from box and passages are, of stretches of one run."""
        strange, unusual = self.box.distance(standard), self.passages.distance(standard)
        return float(np.median(strange)), float(np.median(unusual))

    def _wide(
        self, quantity: Quantity, standard: Float, value: float, interval: tuple[float, float]
    ) -> Estimate | None:
        """Give the least width of a spall that is or can be wide; folded value and interval, SI."""
        if self.wide is None or not quantity.of_passages:
            return None
        low, high = interval
        chances = self.wide.chance(standard, *(np.full(len(standard), each) for each in (value, low, high)))
        chance, half = float(np.median(chances)), float(np.median(self.wide.half(standard)))
        if chance <= self.wide.narrow and high < AT_EDGE * half:
            return None
        least, wider = LEAST_SHARE * half, quantity.text(half)
        if chance > self.wide.wide:
            why = f"wider than {wider}, half of the distance of two rollers, or nearly so"
        else:
            narrow = f"{quantity.text(value)}, {quantity.text(low)} to {quantity.text(high)}"
            least, why = min(low, least), f"either {narrow}, or wider than {wider}, which looks alike"
        ends = ((least, self.ends_of(quantity)[1]),) * len(LEVELS)
        return Estimate(quantity, nan, ends, f"at least {quantity.text(least)}: {why}", least)

    def _estimate(self, quantity: Quantity, standard: Float, strange: float, unusual: float) -> Estimate:
        if quantity.name not in self.regressions:
            return self.prior_estimate(quantity)
        known = self.card["quantities"][quantity.name]
        far, reason = strange, ELSEWHERE
        if quantity.of_passages and strange <= 1.0:
            far, reason = unusual, _UNUSUAL
        if far > 1.0:
            ranges = tuple((low, high) for low, high in known["ranges"])
            return _silent(quantity, reason.format(far), ranges)
        guess = self.regressions[quantity.name].guess(standard)
        if not np.isfinite(self.regressions[quantity.name].reach).all():
            return _silent(quantity, _UNPROVEN, tuple((low, high) for low, high in known["ranges"]))
        middle = float(np.median(guess.value))
        half = np.median(guess.high - guess.value, axis=1)
        ends = [quantity.restored(np.array([middle - each, middle + each])) for each in half]
        intervals = tuple((float(first), float(last)) for first, last in ends)
        value = float(quantity.restored(np.array(middle)))
        if (wide := self._wide(quantity, standard, value, intervals[-1])) is not None:
            return wide
        if 2.0 * half[-1] >= AS_WIDE * self._range(quantity):
            return Estimate(quantity, float("nan"), intervals, _BLURRED)
        return within_learnt(quantity, value, intervals, self.ends_of(quantity))

    def save(self, path: Path, *, replace: bool = True) -> None:
        """Write the estimator as an NPZ file, whole or not at all."""
        arrays = {f"{name}_": getattr(self, name) for name in ("middle", "spread")}
        for name in ("box", "passages"):
            arrays |= {f"{name}.{part}": getattr(getattr(self, name), part) for part in _FAMILIAR}
        kinds = {name: [_kind_of(way) for way in each.ways] for name, each in self.regressions.items()}
        for name, each in self.regressions.items():
            arrays[f"{name}.reach"] = each.reach
            for k, way in enumerate(each.ways):
                _, parts, numbers = _KINDS[kinds[name][k]]
                arrays |= {f"{name}.{k}.{part}": getattr(way, part) for part in parts}
                arrays[f"{name}.{k}.numbers"] = np.array([getattr(way, part) for part in numbers])
        if self.wide is not None:
            arrays |= {f"wide.{name}": getattr(self.wide, name) for name in _WIDE}
        if self.part is not None:
            arrays |= {f"part.{name}": getattr(self.part, name) for name in _PART}
        head = {
            "version": VERSION,
            "plate": {
                field.name: getattr(self.plate, field.name)
                for field in fields(self.plate)
                if field.name != "sources"
            },
            "axes": self.axes,
            "rate": self.rate,
            "stretch": self.stretch,
            "familiar": {
                name: [getattr(self, name).outside, getattr(self, name).farthest]
                for name in ("box", "passages")
            },
            "wide": None if self.wide is None else [getattr(self.wide, name) for name in _WIDE_NUMBERS],
            "quantities": kinds,
            "conditions": () if self.part is None else self.part.conditions,
            "card": dict(self.card),
        }
        stored = {
            name: values if values.dtype.kind == "i" else np.asarray(values, np.float32)
            for name, values in arrays.items()
        }
        with as_a_whole(path, replace=replace) as fresh, fresh.open("wb") as file:
            np.savez_compressed(file, head=np.array(json.dumps(head)), **stored)  # type: ignore[arg-type]


def within_learnt(
    quantity: Quantity,
    value: float,
    intervals: tuple[tuple[float, float], ...],
    ends: tuple[float, float],
) -> Estimate:
    """Give an estimate, or the least value alone where its interval reaches the end of what was learnt from.

    What lies beyond that end looks like the end: an estimate cannot tell them apart.
    """
    low, high = intervals[-1]
    if not (quantity.of_passages and isfinite(ends[1]) and high >= AT_EDGE * ends[1]):
        return Estimate(quantity, value, intervals)
    reason = (
        f"at least {quantity.text(low)}: the interval reaches {quantity.text(ends[1])}, the largest value "
        "learnt from"
    )
    return Estimate(quantity, nan, intervals, reason, low)


def _silent(quantity: Quantity, reason: str, ranges: tuple[tuple[float, float], ...] = ()) -> Estimate:
    return Estimate(quantity, float("nan"), ranges, reason)


def read_estimator(path: Path) -> Estimator:
    """Read an estimator from its file; no code is read from it.

    Raises
    ------
    InputError
        The file is absent, or no estimator of this version.
    """
    try:
        size_of_file(path)
        with np.load(path, allow_pickle=False) as file:
            stored = {name: file[name] for name in file.files}
        head = json.loads(str(stored.pop("head")))
        if head["version"] != VERSION:
            raise InputError(
                f"{path}: is an estimator of version {head['version']}, not {VERSION}: train it again"
            )
        numbers = {
            name: values if values.dtype.kind == "i" else np.asarray(values, np.float64)
            for name, values in stored.items()
        }
        kept: dict[str, Any] = {name: head[name] for name in ("rate", "stretch", "card")}
        kept |= {name: numbers[f"{name}_"] for name in ("middle", "spread")}
        for name in ("box", "passages"):
            outside, farthest = head["familiar"][name]
            found_parts: dict[str, Any] = {part: numbers[f"{name}.{part}"] for part in _FAMILIAR}
            kept[name] = Familiarity(**found_parts, outside=outside, farthest=farthest)
        found = Estimator(
            plate=NamePlate(**{"kind": Bearing.kind, **head["plate"]}),  # older files are of tapered bearings
            axes=tuple(head["axes"]),
            **kept,
            wide=_wide_rule(numbers, head["wide"]),
            regressions={name: _learnt(numbers, name, kinds) for name, kinds in head["quantities"].items()},
            part=PartRule(tuple(head["conditions"]), *(numbers[f"part.{name}"] for name in _PART))
            if head["conditions"]
            else None,
        )
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file") from None
    except ValueError:  # of a file of another kind NumPy says how to load it unsafely
        raise InputError(f"{path}: is no estimator that `beardyn train` wrote") from None
    except (OSError, KeyError, TypeError, EOFError, BadZipFile) as error:
        raise InputError(f"{path}: is no estimator that `beardyn train` wrote ({error})") from None
    if len(found.middle) != len(names_of(found.axes)):
        raise InputError(
            f"{path}: has {len(found.middle)} descriptors, this version of beardyn works out "
            f"{len(names_of(found.axes))}: train it again"
        )
    return found


def _kind_of(way: Way) -> str:
    return next(kind for kind, (learns, *_) in _KINDS.items() if isinstance(way, learns))


def _learnt(stored: Mapping[str, Any], name: str, kinds: Sequence[str]) -> Learnt:
    ways = tuple(_way(stored, f"{name}.{k}", kind) for k, kind in enumerate(kinds))
    return Learnt(ways, stored[f"{name}.reach"])


def _wide_rule(stored: Mapping[str, Any], limits: Sequence[float] | None) -> WideRule | None:
    if limits is None:
        return None
    return WideRule(*(stored[f"wide.{name}"] for name in _WIDE), *limits)


def _way(stored: Mapping[str, Any], name: str, kind: str) -> Way:
    learns, parts, numbers = _KINDS[kind]
    given: dict[str, Any] = {part: stored[f"{name}.{part}"] for part in parts}
    return learns(**given, **dict(zip(numbers, stored[f"{name}.numbers"].tolist(), strict=True)))
