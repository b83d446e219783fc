"""When rollers pass a spall of a ring, and which passage is worth showing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int
from beardyn_core.base.errors import InputError
from beardyn_core.record.description import RunDescription
from beardyn_core.record.run import Run
from beardyn_core.record.view_title import faults_of
from beardyn_core.scene.field_spall import FieldSpall
from beardyn_core.scene.patch import Patch
from beardyn_core.study.animation.row_motion import RowMotion

RingSpall = Patch | FieldSpall
TURN = 2.0 * np.pi


@dataclass(frozen=True, eq=False)
class Passages:
    """Moments at which the centre of a roller is over the middle of a spall, in the order of time."""

    time: A[Float, "shape [passage], [s]"]
    roller: A[Int, "shape [passage]"]
    load: A[Float, "shape [passage], of the roller on the cup, between two snapshots, [N]"]


def ring_spalls(run: RunDescription) -> list[RingSpall]:
    """List the spalls of the rings; those of rollers, which cross no spall, are left out."""
    spalls = [each for each in run.defects if isinstance(each, Patch | FieldSpall)]
    return [each for each in spalls if each.on in ("cup", "cone")]


def shown_spall(run: Run) -> RingSpall:
    """Choose the spall to show: the first one of a ring.

    Raises
    ------
    InputError
        There is none.
    """
    spalls = ring_spalls(run.described())
    if not spalls:
        there = faults_of(run.described()) or "no fault"
        raise InputError(
            f"{run.label}: --of crossing shows a spall of the outer ring (cup) or inner ring (cone); the "
            f"bearing has {there}. --of load_zone shows any bearing"
        )
    return spalls[0]


def spall_azimuth(spall: RingSpall, shaft: Float | float) -> Float:
    """Find where a spall is when the shaft has turned by an angle; one of the cone turns with it, [rad]."""
    return np.asarray(spall.azimuth + (shaft if spall.on == "cone" else 0.0 * np.asarray(shaft)))


def passages(motion: RowMotion, spall: RingSpall) -> Passages:
    """Find every passage of a roller over a spall."""
    shaft = np.interp(motion.time, motion.shaft_time, motion.shaft)
    turns = (motion.azimuth - spall_azimuth(spall, shaft)[:, None]) / TURN
    whole = np.floor(turns)
    snapshot, roller = np.nonzero((np.diff(whole, axis=0) != 0.0) & motion.present)
    before, after = turns[snapshot, roller], turns[snapshot + 1, roller]
    passed = np.maximum(whole[snapshot, roller], whole[snapshot + 1, roller])
    share = (passed - before) / (after - before)
    time = motion.time[snapshot] + share * (motion.time[snapshot + 1] - motion.time[snapshot])
    load = (1.0 - share) * motion.load[snapshot, roller] + share * motion.load[snapshot + 1, roller]
    order = np.argsort(time, kind="stable")
    return Passages(time[order], roller[order], load[order])


def chosen_window(
    run: Run, motion: RowMotion, spall: RingSpall, begin: float, shown: int
) -> tuple[float, float]:
    """Choose the time to show: some passages of one shaft turn from a time on, the most loaded in the middle.

    Parameters
    ----------
    run : Run
    motion : RowMotion
        Of the row of the spall.
    spall : Patch or FieldSpall
    begin : float
        [s].
    shown : int
        Passages to show.

    Returns
    -------
    begin, end : float
        As long as that many passages take, [s].

    Raises
    ------
    InputError
        Rollers pass the spall too seldom from that time to the end of the recording.
    """
    found = passages(motion, spall)
    late = (found.time >= begin) & (found.time <= motion.span[1])
    time, load = found.time[late], found.load[late]
    if len(time) <= shown:
        raise InputError(
            f"{run.label}: {len(time)} rollers pass the spall from {begin:.3f} s to the end of the "
            f"recording, and {shown + 1} are needed. Begin earlier (--at), or record longer or faster"
        )
    turn = _shaft_period(motion, begin)
    inside = np.flatnonzero(time <= max(begin + turn, time[shown]))
    period = float(np.median(np.diff(time[inside])))
    low, high = motion.span
    middle = time[inside[np.argmax(load[inside])]]
    start = float(np.clip(middle - 0.5 * shown * period, low, max(low, high - shown * period)))
    return start, start + shown * period


def _shaft_period(motion: RowMotion, time: float) -> float:
    speed = np.gradient(motion.shaft, motion.shaft_time)
    now = abs(float(np.interp(time, motion.shaft_time, speed)))
    return TURN / now if now > 0.0 else np.inf
