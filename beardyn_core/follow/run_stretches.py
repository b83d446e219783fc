"""The stretches of a run as the filter of its bearing takes them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated as A
from typing import NamedTuple

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.bearing.lubricant import Lubricant
from beardyn_core.bearing.name_plate import NamePlate
from beardyn_core.bearing.roller_bearing import RollerBearing
from beardyn_core.config import load_any_bearing, load_lubricant
from beardyn_core.follow.descriptors import AXES, describe
from beardyn_core.follow.estimator import Estimator, read_estimator
from beardyn_core.follow.estimator_choice import estimator_for
from beardyn_core.follow.following import Follower
from beardyn_core.follow.growth import GrowthLaw
from beardyn_core.follow.inference import alike, doubt_of, stretches_of
from beardyn_core.follow.life_assumptions import LifeAssumptions
from beardyn_core.follow.load_checks import AxleLoads
from beardyn_core.follow.mounting_search import cross_powers
from beardyn_core.follow.service import Service
from beardyn_core.record.run import Run


def follower_of(
    plate: RollerBearing | NamePlate,
    estimator: Estimator | Path | str | None = None,
    *,
    service: Service | None = None,
    law: GrowthLaw | None = None,
    lubricant: Lubricant | str = "L055",
    axle_loads: AxleLoads | None = None,
    assumptions: LifeAssumptions | None = None,
    temperature: tuple[float, float] | None = None,
) -> Follower:
    """Make the filter of one bearing; see `beardyn_core.follow`.

    Raises
    ------
    InputError
        The estimator is for another bearing.
    """
    if estimator is None:
        estimator = estimator_for(plate)
    elif not isinstance(estimator, Estimator):
        estimator = read_estimator(Path(estimator))
    if doubt := doubt_of(estimator, plate):
        raise InputError(f"{doubt}; train one with `beardyn train`")
    whole = whole_bearing(plate)
    grease = load_lubricant(lubricant) if isinstance(lubricant, str) else lubricant
    return Follower(
        estimator, whole, grease, service or Service(), law or GrowthLaw(), axle_loads,
        assumptions or LifeAssumptions(), temperature,
    )  # fmt: skip


def whole_bearing(plate: RollerBearing | NamePlate) -> RollerBearing | None:
    """Find the bearing of bearing data; none where only these are known, or of the name alone."""
    if isinstance(plate, RollerBearing):
        return plate
    try:
        named = load_any_bearing(plate.name)
    except InputError:
        return None
    return named if alike(plate, named) else None


class FollowedStretch(NamedTuple):
    """What is taken of a stretch of a run."""

    descriptors: A[Float, "shape [descriptor]"]
    end: A[float, "since the begin of the run, [s]"]
    distance: A[float, "that the wheel has run since, [m]"]
    powers: A[Float | None, "of `cross_powers`, for the mounting; none of an estimator of fewer axes"]


def stretches_followed(
    run: Run, follower: Follower, plate: RollerBearing | NamePlate, sensor: str
) -> Iterator[FollowedStretch]:
    """Give the stretches of a run as a filter takes them."""
    estimator, wheel = follower.estimator, follower.service.wheel_diameter
    if doubt := doubt_of(estimator, plate):
        raise InputError(f"{run.label}: {doubt}; train one with `beardyn train`")
    turned = np.unwrap(run.shaft.angle) if len(run.shaft) else np.zeros(1)
    begin_ns = int(run.shaft.time_ns[0]) if len(run.shaft) else 0
    for stretch in stretches_of(run, estimator, sensor):
        row = describe(stretch, estimator.orders, estimator.plate, estimator.axes)
        angle = float(np.interp(stretch.end_ns, run.shaft.time_ns, turned)) - float(turned[0])
        powers = cross_powers(stretch) if estimator.axes == AXES else None
        yield FollowedStretch(row, 1e-9 * (stretch.end_ns - begin_ns), 0.5 * wheel * abs(angle), powers)
