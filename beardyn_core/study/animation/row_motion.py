"""Places, turns and loads of the rollers of one row at any time between the snapshots of a recording."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float
from beardyn_core.base.errors import InputError
from beardyn_core.record.run import Run

LEAST_SNAPSHOTS = 4


class Moment(NamedTuple):
    """One row at one time; angles from +z towards +x."""

    time: float  # [s]
    azimuth: Float  # of the rollers' centres, shape [roller], [rad]
    spin: Float  # of a mark on each roller, shape [roller], [rad]
    load: Float  # between cup and roller, shape [roller], [N]
    shaft: float  # angle of the shaft since the start of the run, [rad]


@dataclass(frozen=True, eq=False)
class RowMotion:
    """Motion of the rollers of one row, its angles continuous over time."""

    row: int
    present: A[NDArray[np.bool_], "shape [roller], whether the roller is there"]
    time: A[Float, "shape [snapshot], [s]"]
    azimuth: A[Float, "shape [snapshot, roller], [rad]"]
    spin: A[Float, "shape [snapshot, roller], of a mark on the roller that faces the cup at zero spin, [rad]"]
    load: A[Float, "shape [snapshot, roller], between cup and roller, [N]"]
    shaft_time: A[Float, "shape [sample], [s]"]
    shaft: A[Float, "shape [sample], [rad]"]

    @classmethod
    def of(cls, run: Run, row: int) -> RowMotion:
        """Take the motion of a row from a recording.

        Raises
        ------
        InputError
            It has no bodies, contacts or shaft angle, or too few of them.
        """
        described = run.described()
        topics = {"bodies": len(run.bodies), "contacts": len(run.contacts), "shaft": len(run.shaft)}
        if short := [name for name, count in topics.items() if count < LEAST_SNAPSHOTS]:
            raise InputError(
                f"{run.label}: a moving picture needs {LEAST_SNAPSHOTS} snapshots or more of the topics "
                f"{', '.join(topics)}; too few are of {', '.join(short)}"
            )
        first = described.body_names.index(f"roller_{row}_0")
        part = slice(first, first + described.roller_count)
        pose, twist, time = run.bodies.pose[:, part], run.bodies.twist[:, part], run.bodies.time
        names = described.body_names[part]
        return cls(
            row=row,
            present=np.array([name not in described.absent_bodies for name in names]),
            time=time,
            azimuth=np.unwrap(np.arctan2(pose[..., 0], pose[..., 2]), axis=0),
            spin=_continuous(_mark_angle(pose[..., 3:]), twist[..., 4], time),
            load=_at_times(time, run.contacts.time, run.contacts.load[:, row, :, run.contacts.of("cup")]),
            shaft_time=run.shaft.time,
            shaft=np.unwrap(run.shaft.angle),
        )

    @property
    def span(self) -> tuple[float, float]:
        """First and last time at which all of it is known, [s]."""
        return max(self.time[0], self.shaft_time[0]), min(self.time[-1], self.shaft_time[-1])

    def at(self, time: float) -> Moment:
        """Find the row at a time [s]; straight lines between the snapshots."""
        index = int(np.clip(np.searchsorted(self.time, time, side="right") - 1, 0, len(self.time) - 2))
        share = (time - self.time[index]) / (self.time[index + 1] - self.time[index])

        def between(values: Float) -> Float:
            return (1.0 - share) * values[index] + share * values[index + 1]

        shaft = float(np.interp(time, self.shaft_time, self.shaft))
        return Moment(time, between(self.azimuth), between(self.spin), between(self.load), shaft)

    def cage_period(self, time: float) -> float:
        """Find how long the rollers take for one turn about the axis at a time [s]; inf at rest, [s]."""
        step = 0.5 * (self.time[-1] - self.time[0]) / (len(self.time) - 1)
        before, after = self.at(max(time - step, self.time[0])), self.at(min(time + step, self.time[-1]))
        turned = abs(float(np.median((after.azimuth - before.azimuth)[self.present])))
        return 2.0 * np.pi * (after.time - before.time) / turned if turned > 0.0 else np.inf


def _mark_angle(quaternion: Float) -> Float:
    """Find the direction of a body's own z axis in the plane across the bearing axis, from +z towards +x."""
    x, y, z, w = np.moveaxis(quaternion, -1, 0)
    return np.asarray(np.arctan2(2.0 * (x * z + y * w), 1.0 - 2.0 * (x * x + y * y)))


def _continuous(angle: Float, speed: Float, time: Float) -> Float:
    """Add whole turns to an angle, as many as its speed [rad/s] asks for, shape [snapshot, roller].

    Between two snapshots a roller may turn by more than half a turn, so the nearest angle may be wrong.
    """
    expected = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time)[:, None]
    missed = np.diff(angle, axis=0) - expected
    steps = expected + np.mod(missed + np.pi, 2.0 * np.pi) - np.pi
    return np.concatenate((angle[:1], angle[:1] + np.cumsum(steps, axis=0)))


def _at_times(time: Float, known: Float, values: Float) -> Float:
    """Interpolate each column at other times."""
    if len(time) == len(known) and np.array_equal(time, known):
        return values
    return np.stack([np.interp(time, known, column) for column in values.T], axis=1)
