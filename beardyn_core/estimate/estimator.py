"""An estimator: what it was learnt from, how well it does, and the file that keeps it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from math import sqrt
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.arrays import Float
from beardyn_core.bearing.kinematics import fault_frequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.errors import InputError
from beardyn_core.estimate.descriptors import names_of
from beardyn_core.estimate.quantities import BY_NAME, Quantity
from beardyn_core.estimate.regression import LEVELS, Regression
from beardyn_core.outputs import as_a_whole

VERSION = 1
_ARRAYS = ("directions", "support", "weights", "doubt_weights", "reach")
_NUMBERS = ("width", "mean", "doubt")
_FAR = 4.0  # standard deviations: an expected share of 1e-4 of runs like those learnt from


@dataclass(frozen=True)
class Estimate:
    """What is known of one quantity."""

    quantity: Quantity
    value: A[float, "most likely, NaN where nothing can be said, SI"]
    intervals: A[tuple[tuple[float, float], ...], "of 50 and of 90 %, SI; none where nothing can be said"]
    reason: A[str, "why nothing can be said; empty"] = ""

    @property
    def sentence(self) -> str:
        """Say it in a line."""
        if self.reason:
            return f"{self.quantity.words}: {self.reason}"
        show, (low, high) = self.quantity.text, self.intervals[-1]
        return (
            f"{self.quantity.words}: {show(self.value)}, {show(low)} to {show(high)} in "
            f"{100 * LEVELS[-1]:.0f} of 100"
        )


@dataclass(frozen=True, eq=False)
class Estimator:
    """Numbers that give estimates, and where they come from."""

    plate: A[NamePlate, "bearing that it was learnt for"]
    axes: A[tuple[str, ...], "of the accelerometer"]
    rate: A[float, "of the accelerometer, [Hz]"]
    stretch: A[float, "length of signal that it hears at once, [s]"]
    middle: A[Float, "shape [descriptor], mean of those learnt from"]
    spread: A[Float, "shape [descriptor], their standard deviation"]
    usual: A[Float, "shape [direction, descriptor]: principal directions of standardised descriptors"]
    sizes: A[Float, "shape [direction], standard deviation along each"]
    farthest: A[float, "distance from the middle that a run learnt from hardly has, [-]"]
    regressions: A[Mapping[str, Regression], "by quantity"]
    card: A[Mapping[str, Any], "set, counts, errors on bearings not learnt from, versions"]

    @property
    def orders(self) -> Any:
        """Fault frequencies of the bearing per revolution."""
        return fault_frequencies(self.plate)

    def standardised(self, descriptors: Float) -> Float:
        """Take descriptors, shape [run, descriptor], to zero mean and unit spread; what is missing is usual."""
        return np.nan_to_num((descriptors - self.middle) / self.spread, nan=0.0, posinf=0.0, neginf=0.0)

    def strangeness(self, descriptors: Float) -> Float:
        """Say how far runs lie from those learnt from, shape [run], 1 where hardly one of those did."""
        along = self.standardised(descriptors) @ self.usual.T / self.sizes
        return np.asarray(np.sqrt((along**2).mean(axis=1)) / self.farthest, np.float64)

    def estimates(self, descriptors: Float, spalled: bool) -> list[Estimate]:
        """Estimate from stretches of one run, shape [stretch, descriptor].

        The middle of the stretches is told, with the intervals of one stretch: what a box or a track has of
        its own is in all of them, and does not go away with their number.
        """
        standard = self.standardised(descriptors)
        return list(self._estimates(standard, spalled))

    def _estimates(self, standard: Float, spalled: bool) -> Iterator[Estimate]:
        for name, quantity in BY_NAME.items():
            known = self.card["quantities"].get(name)
            if known is None:
                continue
            if quantity.of_fault and not spalled:
                yield _silent(quantity, "no part is called faulty")
                continue
            if name not in self.regressions:
                yield _silent(
                    quantity,
                    f"not identifiable: on bearings not learnt from, the estimate explains "
                    f"{100 * max(known['explained'], 0.0):.0f} % of its variance",
                )
                continue
            guess = self.regressions[name].guess(standard)
            middle = float(np.median(guess.value))
            half = np.median(guess.high - guess.value, axis=1)
            ends = [quantity.restored(np.array([middle - each, middle + each])) for each in half]
            value = float(quantity.restored(np.array(middle)))
            yield Estimate(quantity, value, tuple((float(low), float(high)) for low, high in ends))

    def save(self, path: Path) -> None:
        """Write the estimator as an NPZ file, whole or not at all."""
        arrays = {f"{name}_": getattr(self, name) for name in ("middle", "spread", "usual", "sizes")}
        for name, each in self.regressions.items():
            arrays |= {f"{name}.{part}": getattr(each, part) for part in _ARRAYS}
            arrays[f"{name}.numbers"] = np.array([getattr(each, part) for part in _NUMBERS])
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
            "farthest": self.farthest,
            "quantities": tuple(self.regressions),
            "card": dict(self.card),
        }
        stored = {name: np.asarray(values, np.float32) for name, values in arrays.items()}
        with as_a_whole(path) as fresh, fresh.open("wb") as file:
            np.savez_compressed(file, head=np.array(json.dumps(head)), **stored)  # type: ignore[arg-type]


def _silent(quantity: Quantity, reason: str) -> Estimate:
    return Estimate(quantity, float("nan"), (), reason)


def read_estimator(path: Path) -> Estimator:
    """Read an estimator from its file; no code is read from it.

    Raises
    ------
    InputError
        The file is absent, or no estimator of this version.
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            stored = {name: file[name] for name in file.files}
        head = json.loads(str(stored.pop("head")))
        if head["version"] != VERSION:
            raise InputError(
                f"{path}: is an estimator of version {head['version']}, not {VERSION}: train it again"
            )
        numbers = {name: np.asarray(values, np.float64) for name, values in stored.items()}
        regressions = {
            name: Regression(
                **{part: numbers[f"{name}.{part}"] for part in _ARRAYS},
                **dict(zip(_NUMBERS, map(float, numbers[f"{name}.numbers"]), strict=True)),
            )
            for name in head["quantities"]
        }
        found = Estimator(
            NamePlate(**head["plate"]), tuple(head["axes"]), head["rate"], head["stretch"],
            *(numbers[f"{name}_"] for name in ("middle", "spread", "usual", "sizes")),
            head["farthest"], regressions, head["card"],
        )  # fmt: skip
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file") from None
    except (OSError, ValueError, KeyError, TypeError, EOFError) as error:
        raise InputError(f"{path}: is no estimator that `beardyn train` wrote ({error})") from None
    if len(found.middle) != len(names_of(found.axes)):
        raise InputError(
            f"{path}: has {len(found.middle)} descriptors, this version of beardyn works out "
            f"{len(names_of(found.axes))}: train it again"
        )
    return found


def farthest_of(along: Float) -> float:
    """Find the distance that a run learnt from hardly has; `along` has standard deviations, [run, direction]."""
    distance = np.sqrt((along**2).mean(axis=1))
    return float(distance.mean() + _FAR * distance.std()) or sqrt(along.shape[1])
