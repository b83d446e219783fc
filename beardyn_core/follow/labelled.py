"""Runs of a set of labelled runs as an estimator sees them: descriptors, and the truth to learn."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isclose
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.kinematics import frequencies
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.follow.descriptors import AXES, describe, names_of
from beardyn_core.follow.quantities import QUANTITIES
from beardyn_core.monitor.chain import Stretch
from beardyn_core.population.labelled_set import LabelledSet

_ALIKE = 0.01  # sizes of bearings of one drawing, whose runs may differ by their tolerances
_SAME_SAMPLING = 1e-3
_SAMPLED = {"rate": "sampling rate", "seconds": "length of a run"}


class Described(NamedTuple):
    """Runs of a set as an estimator sees them."""

    descriptors: Float  # shape [run, descriptor]
    truth: dict[str, Float]  # by quantity, SI, shape [run]; NaN where a run has none
    bearings: NDArray[Any]  # shape [run], names; of one bearing those of its rides
    conditions: NDArray[Any]  # shape [run]


class Sampling(NamedTuple):
    """How the vibration of a set is sampled."""

    rate: float  # [Hz]
    seconds: float  # of a run


def describe_runs(runs: LabelledSet, part: str | None, axes: tuple[str, ...] = AXES) -> Described:
    """Work out the descriptors of the complete runs of a part of a set, of all parts with `None`."""
    chosen = runs.runs_of(part)
    columns = [each.label for each in QUANTITIES if each.label in runs.table]
    known = runs.labels_of(chosen, [*columns, "bearing_id", "condition"])
    plate = plate_of(runs)
    orders = frequencies(plate.roller_count, plate.pitch_diameter, plate.roller_diameter, plate.contact_angle)
    rows = np.full((len(chosen), len(names_of(axes))), np.nan)
    for k, stretch in enumerate(stretches_of_set(runs, part, axes)):
        rows[k] = describe(stretch, orders, plate, axes)
    truth = {
        each.name: np.asarray(known[each.label], np.float64)
        if each.label in columns
        else np.full(len(chosen), np.nan)
        for each in QUANTITIES
    }
    made = [f"{runs.folder}, ride {run}" for run in chosen] if is_one_bearing(runs) else known["bearing_id"]
    return Described(rows, truth, *(np.asarray(names).astype(str) for names in (made, known["condition"])))


def stretches_of_set(runs: LabelledSet, part: str | None, axes: tuple[str, ...] = AXES) -> Iterator[Stretch]:
    """Take vibration and shaft of the complete runs of a part of a set, one after the other."""
    kept, rate = [AXES.index(axis) for axis in axes], sampling_of(runs).rate
    time, turned = np.asarray(runs.signals.time_vibration), np.asarray(runs.signals.time_shaft)
    for run in runs.runs_of(part):
        vibration = np.asarray(runs.arrays["vibration"][int(run)], np.float64)[:, kept]
        angle = np.interp(time, turned, np.asarray(runs.arrays["shaft_angle"][int(run)], np.float64))
        yield Stretch(rate, vibration, angle, np.nan, 0)


def plate_of(runs: LabelledSet) -> NamePlate:
    """Take the data of the bearings of a set.

    Raises
    ------
    InputError
        They are of several drawings.
    """
    keys = {"roller_count": "roller_count", "roller_diameter": "roller_diameter_m",
            "pitch_diameter": "pitch_diameter_m", "contact_angle": "contact_angle_rad"}  # fmt: skip
    several = runs.table["bearing"].nunique() > 1
    if several:
        names = ", ".join(sorted(runs.table["bearing"].unique()))
        raise InputError(f"{runs.folder}: has the bearings {names}; an estimator is for one")
    usual = runs.table.median(numeric_only=True)
    numbers: dict[str, Any] = {name: float(usual[f"geometry_{column}"]) for name, column in keys.items()}
    numbers["roller_count"] = round(numbers["roller_count"])
    first = runs.table.iloc[0]
    return NamePlate(name=str(first["bearing"]), kind=first.get("bearing_kind") or Bearing.kind, **numbers)


def sampling_of(runs: LabelledSet) -> Sampling:
    """Tell how the vibration of a set is sampled."""
    time = np.asarray(runs.signals.time_vibration)
    seconds = float(time[-1] - time[0])
    return Sampling((len(time) - 1) / seconds, seconds)


def check_alike(runs: LabelledSet, other: LabelledSet) -> None:
    """Check that an estimator that learns from one set can be calibrated or judged by another.

    Raises
    ------
    InputError
        They are of different bearings, sampling rates or lengths.
    """
    one, two = plate_of(runs), plate_of(other)
    sizes = ("roller_count", "pitch_diameter", "roller_diameter", "contact_angle")
    same = (isclose(getattr(one, name), getattr(two, name), rel_tol=_ALIKE) for name in sizes)
    if one.kind != two.kind or not all(same):
        raise InputError(_unlike(runs, other, "bearing", one.name, two.name))
    received, beside = sampling_of(runs), sampling_of(other)
    for name, unit in (("rate", "Hz"), ("seconds", "s")):
        first, second = getattr(received, name), getattr(beside, name)
        if abs(second / first - 1.0) > _SAME_SAMPLING:
            raise InputError(
                _unlike(runs, other, _SAMPLED[name], f"{first:.6g} {unit}", f"{second:.6g} {unit}")
            )


def check_unseen(learnt: Sequence[LabelledSet], other: LabelledSet) -> None:
    """Check that none of the bearings of a set is in the sets that were learnt from.

    Lots of bearings are known by the seed of their scatter, whatever grade they are of. Where all runs were
    of one bearing, it is their rides that may not come again.

    Raises
    ------
    InputError
        Some do, as of the same sweep drawn from the same seed in another tier.
    """
    for runs in learnt:
        one = is_one_bearing(runs)
        scattered = len(_different(runs, "scatter_seed")) > 1
        key = "seed" if one else "scatter_seed" if scattered else "bearing_id"
        if shared := _different(runs, key) & _different(other, key):
            raise InputError(
                f"{other.folder}: {len(shared)} of its {'rides' if one else 'bearings'} are those of "
                f"{runs.folder}, so it does not tell how an estimator does on others; draw it from another "
                "seed (`beardyn sweep --seed`)"
            )


def is_one_bearing(runs: LabelledSet) -> bool:
    """Tell whether all runs of a set are of one bearing as drawn and made."""
    return len(_different(runs, "bearing_id")) < 2


def _different(runs: LabelledSet, key: str) -> set[Any]:
    """Take what is under a key of the complete runs; nothing where there is no such key."""
    if key not in runs.table:
        return set()
    return set(runs.table.loc[runs.table["status"] == "complete", key].dropna())


def _unlike(runs: LabelledSet, other: LabelledSet, what: str, first: str, second: str) -> str:
    return (
        f"{other.folder}: its {what} is {second}, that of {runs.folder} is {first}; an estimator is "
        "calibrated and judged by runs of the bearing and the accelerometer that it learns from"
    )


def select_runs(runs: Described, inside: NDArray[np.bool_]) -> Described:
    """Take some of the runs."""
    truth = {name: values[inside] for name, values in runs.truth.items()}
    return Described(runs.descriptors[inside], truth, runs.bearings[inside], runs.conditions[inside])


def join_sets(parts: Sequence[Described]) -> Described:
    """Put runs of several sets together."""
    return Described(
        np.concatenate([each.descriptors for each in parts]),
        {name: np.concatenate([each.truth[name] for each in parts]) for name in parts[0].truth},
        np.concatenate([each.bearings for each in parts]),
        np.concatenate([each.conditions for each in parts]),
    )
