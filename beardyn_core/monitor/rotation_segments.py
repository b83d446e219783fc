"""Legs: times in which the shaft turns one way and not too slowly, put together to one forward turn."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float, Int

# share of the fastest, below which strikes are too faint and too far apart to count
_SLOW = 0.2
_STANDS = 2.0 * np.pi * 0.2  # [rad/s]; a wheel at 2 km/h
_TURN = 2.0 * np.pi
_ROUNDING = 1e-9  # of a revolution


@dataclass(frozen=True)
class Legs:
    """Samples in which the shaft turns, as if it had turned forwards all the time."""

    samples: A[Int, "shape [sample], their places in the signal"]
    angle: A[Float, "shape [sample], increasing, [rad]"]
    count: A[int, "legs they are of"]
    ended: A[bool, "whether the shaft has stopped or turned round since"]
    last: A[int, "the place of the latest of them; -1 without any"]

    @property
    def revolutions(self) -> float:
        """Revolutions of the shaft, [-]."""
        return float(self.angle[-1] - self.angle[0]) / _TURN if len(self.angle) else 0.0

    def latest(self, most: float) -> Legs:
        """Keep no more than the last revolutions, [-]."""
        if not len(self.angle):
            return self
        first = int(np.argmax(self.angle >= self.angle[-1] - _TURN * most))
        return replace(self, samples=self.samples[first:], angle=self.angle[first:])


def turning_legs(angle: Float, rate: float, enough: float, most: float) -> Legs:
    """Join the latest legs of a signal: as few as have enough revolutions, and of these the last.

    A backward leg is turned round in time, so that its angle increases as well: what comes back with the
    angle does so either way, and an envelope knows no direction. Each leg begins at the angle of the wheel
    at which the one before ended, so that flats and polygons stay where they are on the wheel.

    Parameters
    ----------
    angle : float64 array, shape [sample]
        Of the shaft, [rad].
    rate : float
        [Hz].
    enough : float
        Revolutions from which one leg needs no earlier one, [-].
    most : float
        Revolutions that are kept, [-].
    """
    pieces = _pieces(angle, rate)
    used: list[tuple[int, int]] = []
    turned = 0.0
    for begin, end in reversed(pieces):
        used.insert(0, (begin, end))
        turned += abs(float(angle[end - 1] - angle[begin])) / _TURN
        if turned >= enough:
            break
    samples, joined = np.empty(0, np.int64), np.empty(0)
    for begin, end in used:
        leg = np.arange(begin, end)
        leg = leg if angle[end - 1] > angle[begin] else leg[::-1]
        # backwards in time and in angle: the angle itself still increases
        own = angle[leg]
        if len(joined):
            lacking = (joined[-1] - own[0]) % _TURN
            first = int(np.searchsorted(own, own[0] + lacking + _ROUNDING * _TURN))
            leg, own = leg[first:], own[first:]
            if not len(own):
                continue
            own = own + np.floor((joined[-1] - own[0]) / _TURN + 0.5) * _TURN
            if own[0] <= joined[-1]:
                leg, own = leg[1:], own[1:]
        samples, joined = np.concatenate((samples, leg)), np.concatenate((joined, own))
    last = pieces[-1][1] - 1 if pieces else -1
    whole = Legs(samples, joined, len(used), bool(pieces) and last < len(angle) - 1, last)
    return whole.latest(most)


def _pieces(angle: Float, rate: float) -> list[tuple[int, int]]:
    """Find begin and end of the legs, in the order of time."""
    if len(angle) < 2:
        return []
    speed = np.diff(angle) * rate
    fastest = float(np.quantile(np.abs(speed), 0.95))
    least = max(_SLOW * fastest, _STANDS)
    way = np.where(np.abs(speed) > least, np.sign(speed), 0.0)
    edges = np.flatnonzero(np.diff(way)) + 1
    bounds = [0, *edges.tolist(), len(way)]
    return [(begin, end + 1) for begin, end in pairwise(bounds) if way[begin] and end > begin]
