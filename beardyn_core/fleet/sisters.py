"""Axleboxes of one train on the same ride, compared: what one has alone, and what all share.

Track, speed, load and weather are those of a ride, and a wheel those of an axle. What differs from the median
of the ride is the axlebox; what both ends of an axle have is the wheelset.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.fleet.identity import Axlebox
from beardyn_core.fleet.store import Stored

RIDE_S = 900.0  # recordings of a train that begin within this are of one ride
LEAST_SISTERS = 3  # others on a ride, from which their median counts


@dataclass(frozen=True)
class Comparison:
    """One recording against the others of its ride."""

    sisters: A[int, "other axleboxes of the ride"]
    levels: A[Float, "over the median of the others, shape [axis, band], [dB]; NaN where unknown"]
    partner: A[Float, "the same of the other end of the axle, NaN without, [dB]"]
    warmer: A[float, "than the median of the others, NaN unknown, [K]"]
    partner_warmer: A[float, "the same of the other end of the axle, NaN without, [K]"]


def compare_sisters(recordings: Sequence[Stored]) -> dict[int, Comparison]:
    """Compare every recording with the others of its ride.

    Parameters
    ----------
    recordings : sequence of Stored
        In the order of time.

    Returns
    -------
    dict
        By the number of the recording; without those that have fewer than 3 sisters.
    """
    found: dict[int, Comparison] = {}
    for ride in _rides(recordings):
        ride = _alike(ride)
        if len(ride) <= LEAST_SISTERS:
            continue
        relative: dict[Axlebox, Float] = {}
        warmer: dict[Axlebox, float] = {}
        levels = np.array([each.analysis.levels for each in ride.values()])
        temperature = np.array([each.analysis.temperature for each in ride.values()])
        axle = np.unique([f"{box.vehicle}\n{box.axle}" for box in ride], return_inverse=True)[1]
        for place, box in enumerate(ride):
            others = axle != axle[place]
            if np.count_nonzero(others) < LEAST_SISTERS:
                others = np.arange(len(ride)) != place
            relative[box] = levels[place] - np.median(levels[others], axis=0)
            known = temperature[others & np.isfinite(temperature)]
            enough = len(known) >= LEAST_SISTERS
            warmer[box] = float(temperature[place] - np.median(known)) if enough else np.nan
        for box, each in ride.items():
            partner = partner_of(box)
            found[each.number] = Comparison(
                len(ride) - 1,
                relative[box],
                relative.get(partner, np.full(relative[box].shape, np.nan)),
                warmer[box],
                warmer.get(partner, np.nan),
            )
    return found


def partner_of(box: Axlebox) -> Axlebox:
    """Give the axlebox at the other end of the axle."""
    return box._replace(side="right" if box.side == "left" else "left")


def _alike(ride: Mapping[Axlebox, Stored]) -> dict[Axlebox, Stored]:
    """Keep the recordings of a ride with the axes that most have; a dead sensor has none."""
    kinds = Counter(each.analysis.axes for each in ride.values() if each.analysis.levels.size)
    most = kinds.most_common(1)
    if not most:
        return {}
    return {
        box: each
        for box, each in ride.items()
        if each.analysis.levels.size and each.analysis.axes == most[0][0]
    }


def _rides(recordings: Sequence[Stored]) -> list[dict[Axlebox, Stored]]:
    """Group recordings by train and time; of an axlebox that has several in a ride the first."""
    rides: list[dict[Axlebox, Stored]] = []
    current: dict[str, tuple[float, dict[Axlebox, Stored]]] = {}
    for each in recordings:
        begin, ride = current.get(each.train, (-np.inf, {}))
        if each.time - begin > RIDE_S:
            begin, ride = each.time, {}
            current[each.train] = begin, ride
            rides.append(ride)
        ride.setdefault(each.axlebox, each)
    return rides
