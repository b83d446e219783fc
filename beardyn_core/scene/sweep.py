"""A sweep: runs of a scene whose keys are drawn from distributions, for a set of labelled data."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Annotated as A
from typing import Any, ClassVar

from beardyn_core.base.edge import INTERNAL, SEED, At, Problem

SAMPLINGS = ("sobol", "latin_hypercube", "random", "grid")
RUN, BEARING = "run", "bearing"
# first words of keys that say how a bearing was made and what has happened to it
OF_A_BEARING = (
    "bearing",
    "scatter",
    "defects",
    "waviness",
    "missing_rollers",
    "end_play_mm",
    "roughness",
    "radial_clearance_mm",
)
MOST_RUNS = 10_000_000
_LEVELS = At(ge=1, le=10_000)
_KEY = "key path of a scene file, such as defects[0].width_mm; created where the scene has none"
_PER = "draw once for every run or for every bearing; what makes a bearing is drawn for every bearing"


@dataclass(frozen=True)
class Uniform:
    """Any number between two, each as likely."""

    kind: ClassVar[str] = "uniform"

    key: A[str, At(longest=200), _KEY]
    low: A[float, "smallest, in the unit of the key"]
    high: A[float, "largest"]
    levels: A[int, _LEVELS, "numbers of a grid, ends included"] = 5
    per: A[str | None, At(one_of=(RUN, BEARING)), _PER] = None

    def rules(self) -> Iterator[str]:
        """Check the order of the ends."""
        if not self.low <= self.high:
            yield f"high is {self.high:g}; it must be at least low, {self.low:g}"

    def at(self, share: float) -> float:
        """Give the number below which a share of all draws lies."""
        return self.low + share * (self.high - self.low)

    def grid(self) -> list[Any]:
        """List the numbers of a grid."""
        return _evenly(self)


@dataclass(frozen=True)
class LogUniform:
    """Any number between two, each ratio as likely: 1 to 2 as often as 2 to 4."""

    kind: ClassVar[str] = "log_uniform"

    key: A[str, At(longest=200), _KEY]
    low: A[float, At(gt=0.0), "smallest, in the unit of the key"]
    high: A[float, At(gt=0.0), "largest"]
    levels: A[int, _LEVELS, "numbers of a grid, ends included"] = 5
    per: A[str | None, At(one_of=(RUN, BEARING)), _PER] = None

    def rules(self) -> Iterator[str]:
        """Check the order of the ends."""
        if not self.low <= self.high:
            yield f"high is {self.high:g}; it must be at least low, {self.low:g}"

    def at(self, share: float) -> float:
        """Give the number below which a share of all draws lies."""
        return float(self.low * (self.high / self.low) ** share)

    def grid(self) -> list[Any]:
        """List the numbers of a grid."""
        return _evenly(self)


@dataclass(frozen=True)
class Normal:
    """Numbers about a mean; what lies beyond the ends is drawn within them instead."""

    kind: ClassVar[str] = "normal"

    key: A[str, At(longest=200), _KEY]
    mean: A[float, "in the unit of the key"]
    deviation: A[float, At(gt=0.0), "standard deviation, before the ends are cut"]
    low: A[float | None, "nothing below; three deviations below the mean when left out"] = None
    high: A[float | None, "nothing above; three deviations above the mean when left out"] = None
    levels: A[int, _LEVELS, "numbers of a grid, ends included"] = 5
    per: A[str | None, At(one_of=(RUN, BEARING)), _PER] = None

    @property
    def ends(self) -> tuple[float, float]:
        """Smallest and largest number."""
        reach = 3.0 * self.deviation
        low = self.mean - reach if self.low is None else self.low
        return low, self.mean + reach if self.high is None else self.high

    def rules(self) -> Iterator[str]:
        """Check the order of the ends."""
        low, high = self.ends
        if not low < high:
            yield f"high is {high:g}; it must be above low, {low:g}"

    def at(self, share: float) -> float:
        """Give the number below which a share of all draws lies."""
        from scipy.special import ndtr, ndtri

        low, high = ((end - self.mean) / self.deviation for end in self.ends)
        below = float(ndtr(low))
        return self.mean + self.deviation * float(ndtri(below + share * (float(ndtr(high)) - below)))

    def grid(self) -> list[Any]:
        """List the numbers of a grid: the middles of shares of equal size."""
        return [round_digits(self.at((k + 0.5) / self.levels)) for k in range(self.levels)]


@dataclass(frozen=True)
class Integer:
    """Any whole number between two, each as likely."""

    kind: ClassVar[str] = "integer"

    key: A[str, At(longest=200), _KEY]
    low: A[int, "smallest"]
    high: A[int, "largest"]
    per: A[str | None, At(one_of=(RUN, BEARING)), _PER] = None

    def rules(self) -> Iterator[str]:
        """Check the order of the ends."""
        if not self.low <= self.high:
            yield f"high is {self.high}; it must be at least low, {self.low}"

    def at(self, share: float) -> int:
        """Give the number below which a share of all draws lies."""
        count = self.high - self.low + 1
        return self.low + min(int(share * count), count - 1)

    def grid(self) -> list[Any]:
        """List the numbers of a grid: all."""
        return list(range(self.low, self.high + 1))


@dataclass(frozen=True)
class Choice:
    """One of several values of whatever kind: words, numbers, lists, mappings."""

    kind: ClassVar[str] = "choice"

    key: A[str, At(longest=200), _KEY]
    one_of: A[tuple[Any, ...], At(size=(1, None)), "each as it would stand in a scene file"]
    weights: A[tuple[float, ...], At(ge=0.0), "how often each is taken; all alike when left out"] = ()
    per: A[str | None, At(one_of=(RUN, BEARING)), _PER] = None

    def rules(self) -> Iterator[str]:
        """Check that there is a weight for each value."""
        if self.weights and len(self.weights) != len(self.one_of):
            yield f"weights has {len(self.weights)} entries; give one for each of {len(self.one_of)}"
        elif self.weights and not sum(self.weights) > 0.0:
            yield "weights are all 0; at least one must be above"

    def at(self, share: float) -> Any:
        """Give the value below which a share of all draws lies, in the order of the list."""
        weights = self.weights or (1.0,) * len(self.one_of)
        reached, wanted = 0.0, share * sum(weights)
        for value, weight in zip(self.one_of, weights, strict=True):
            reached += weight
            if wanted < reached:
                return value
        return next(v for v, weight in reversed(list(zip(self.one_of, weights, strict=True))) if weight)

    def grid(self) -> list[Any]:
        """List the values of a grid: all."""
        return list(self.one_of)


@dataclass(frozen=True)
class Scaled:
    """A number that follows another one of the run: ``plus + times`` that number, within its ends."""

    kind: ClassVar[str] = "scaled"

    key: A[str, At(longest=200), _KEY]
    by: A[str, At(longest=200), "key path of the number that it follows, drawn above"]
    times: A[float, "factor, in the unit of the key over that of the other"] = 1.0
    plus: A[float, "added, in the unit of the key"] = 0.0
    low: A[float | None, "nothing below"] = None
    high: A[float | None, "nothing above"] = None

    def of(self, number: float) -> float:
        """Give the number that goes with another."""
        value = self.plus + self.times * number
        value = value if self.low is None else max(value, self.low)
        return value if self.high is None else min(value, self.high)


Drawn = Uniform | LogUniform | Normal | Integer | Choice
Variable = Uniform | LogUniform | Normal | Integer | Choice | Scaled


@dataclass(frozen=True)
class Split:
    """Shares of the bearings that the parts of a set get; no bearing is in two parts."""

    train: A[float, At(ge=0.0, le=1.0), "to learn from"] = 0.7
    validation: A[float, At(ge=0.0, le=1.0), "to choose between learners with"] = 0.15
    test: A[float, At(ge=0.0, le=1.0), "to judge the chosen one with"] = 0.15

    def rules(self) -> Iterator[str]:
        """Check that the shares are all there is."""
        total = self.train + self.validation + self.test
        if abs(total - 1.0) > 1e-9:
            yield f"the shares add up to {total:g}; they must add up to 1"

    @property
    def shares(self) -> dict[str, float]:
        """Shares by the name of the part."""
        return {"train": self.train, "validation": self.validation, "test": self.test}


@dataclass(frozen=True)
class Sweep:
    """Runs of a scene whose keys are drawn from distributions, for a set of labelled data.

    `folder` is that of its file, where a scene file is looked for first.
    """

    name: A[str, At(longest=80, key="sweep"), "name of the sweep and of its set"]
    purpose: A[str, "one line: what the set is for"]
    scene: A[str, At(longest=200), "what every run starts from: shipped, or a path"]
    folder: A[Path, INTERNAL] = Path()
    changes: A[
        dict[str, Any], At(key="set"), "key paths of the scene with the values that they have in every run"
    ] = None  # type: ignore[assignment]
    vary: A[tuple[Variable, ...], "what differs from run to run"] = ()
    sampling: A[
        str,
        At(one_of=SAMPLINGS),
        "random draws every key on its own; sobol fills all dimensions evenly, but few runs of it have keys "
        "that go together; latin_hypercube fills each dimension evenly; grid takes every combination",
    ] = "random"
    runs: A[int | None, At(ge=1, le=MOST_RUNS), "how many; those of the grid when left out, else 100"] = None
    runs_per_bearing: A[int, At(ge=1, le=100_000), "runs of each bearing, under other conditions"] = 1
    hours: A[
        float | None, At(gt=0.0, le=100_000.0), "stop after so much time, at the end of runs that have begun"
    ] = None
    seed: A[int, SEED, "of the draws, of each bearing of the lot, of track and noise of each run"] = 1
    signals: A[tuple[str, ...], At(size=(1, None)), "what is kept of each run"] = ("vibration", "shaft")
    runs_per_task: A[
        int, At(ge=1, le=10_000), "runs that a process does in one go, and that lie in one file of signals"
    ] = 8
    split: A[Split, "parts of the set, by bearings"] = Split()
    licence: A[str, At(longest=200), "of the set, for its data card"] = "CC-BY-4.0"

    def rules(self) -> Iterator[str | Problem]:
        """Check what the draws need of one another."""
        if not self.vary:
            yield "vary is missing; name at least one key that differs from run to run"
        keys = [each.key for each in self.vary]
        for index, each in enumerate(self.vary):
            if each.key in keys[:index]:
                yield f"vary[{index}].key is {each.key!r}, given twice; vary each key once"
            if isinstance(each, Scaled) and each.by not in keys[:index]:
                known = f"there are {', '.join(keys[:index])}" if index else "there is none"
                yield f"vary[{index}].by is {each.by!r}; it must be the key of an entry above, and {known}"
        if self.sampling == "grid" and self.runs is None and self.grid_size > MOST_RUNS:
            yield f"sampling is grid, of {self.grid_size} combinations; allowed are {MOST_RUNS}"
        if self.runs_per_bearing > 1 and self.sampling == "grid":
            yield (
                f"runs_per_bearing is {self.runs_per_bearing}; in a grid every run is of its own bearing: "
                "leave it out"
            )

    @property
    def drawn(self) -> tuple[Drawn, ...]:
        """Keys that are drawn by themselves."""
        return tuple(each for each in self.vary if not isinstance(each, Scaled))

    @property
    def grid_size(self) -> int:
        """Number of combinations of a grid."""
        size = 1
        for each in self.drawn:
            size *= len(each.grid()) if not hasattr(each, "levels") else each.levels
        return size

    @property
    def run_count(self) -> int:
        """Number of runs."""
        if self.sampling == "grid":
            return self.grid_size if self.runs is None else min(self.runs, self.grid_size)
        return 100 if self.runs is None else self.runs

    @property
    def extends(self) -> bool:
        """Tell whether more runs continue the same draws."""
        return self.sampling in ("sobol", "random")


def per_of(variable: Drawn) -> str:
    """Tell whether a key is drawn for every run or for every bearing."""
    if variable.per is not None:
        return variable.per
    first = variable.key.partition(".")[0].partition("[")[0]
    return BEARING if first in OF_A_BEARING else RUN


def round_digits(value: Any) -> Any:
    """Round a number to six digits: as a table shows it, and the same on every machine."""
    return float(f"{value:.6g}") if isinstance(value, float) and isfinite(value) else value


def _evenly(variable: Uniform | LogUniform) -> list[Any]:
    count = variable.levels
    return [round_digits(variable.at(k / (count - 1) if count > 1 else 0.5)) for k in range(count)]
