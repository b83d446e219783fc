"""A channel with the vertical load on the journal: which one, in which unit, and its mean."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.base.units import STANDARD_GRAVITY
from beardyn_core.measured.choosing import Choosing, find_channel
from beardyn_core.measured.source import Channel, Source
from beardyn_core.measured.units import unit_in

FORCE = {"N": 1.0, "kN": 1e3, "t": 1e3 * STANDARD_GRAVITY, "kg": STANDARD_GRAVITY}
"""Newtons in each unit of a load."""


@dataclass(frozen=True)
class LoadChannel:
    """A channel with the vertical load on the journal."""

    channel: Channel
    factor: A[float, "newtons of one number of the channel"]


def choose_load(work: Choosing) -> LoadChannel | None:
    """Find the channel of the load that is asked for, and its unit; none where none is."""
    if not work.reading.load_channel:
        return None
    channel = find_channel(work, "load_channel", work.reading.load_channel)
    if channel is None:
        return None
    in_file = channel.unit.strip() if channel.unit.strip() in FORCE else unit_in(channel.name, FORCE)
    said = work.reading.load_unit
    if said and in_file and said != in_file:
        work.warnings.append(
            f"{work.path}: the unit of {channel.name} is {in_file} in the file; taken is {said}, as asked"
        )
    if not (said or in_file):
        units = ", ".join(FORCE)
        work.complain(f"does not state the unit of {channel.name}; give --load-unit, one of {units}")
        return None
    work.told.append(f"{channel.name} is the vertical load on the journal in {said or in_file}")
    return LoadChannel(channel, FORCE[said or in_file])


def describe_load(
    files: Sequence[tuple[LoadChannel | None, Source]], error: float | None
) -> dict[str, Any] | None:
    """Describe the load over all files, JSON-able; none where no channel of it is read.

    Parameters
    ----------
    files : sequence of pairs
        Channel of the load and file.
    error : float, optional
        Half of the 90 % interval over the mean.
    """
    total, squares, count = 0.0, 0.0, 0
    for load, source in files:
        if load is None:
            continue
        for block in source.blocks([load.channel.name]):
            force = load.factor * block[:, 0]
            force = force[np.isfinite(force)]
            total += float(force.sum())
            squares += float(force @ force)
            count += len(force)
    first = files[0][0]
    if first is None or not count:
        return None
    mean = float(total / count)
    return {
        "channel": first.channel.name,
        "mean_N": mean,
        "rms_about_mean_N": float(np.sqrt(max(squares / count - mean**2, 0.0))),
        "uncertainty_N": None if error is None else error * abs(mean),
    }
