"""Whether a sensor is mounted as stated: what must be undone for its signal to be of the kind learnt from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from itertools import permutations
from math import cos, radians, sin

import numpy as np
from scipy.fft import rfft

from beardyn_core.base.arrays import Float
from beardyn_core.follow.descriptors import AXES, FINE, LEVEL_FLOOR, bands_of, names_of
from beardyn_core.follow.estimator import Estimator
from beardyn_core.follow.mounting import EXCHANGED, GAIN, TURNED, Mounting
from beardyn_core.monitor.chain import Stretch

FARTHEST_TURN = 45.0  # about an axis, beyond which it is nearer to an exchange of two, [degree]
LEAST_TURN = 5.0  # [degree]
FARTHEST_GAIN = 40.0  # [dB]
LEAST_GAIN = 2.0  # [dB]
AS_GOOD = 0.1  # of strangeness: what comes so near to the best explains as well
_ROUNDS = (1.0, 0.2, 0.04)  # of a search, steps over the first one
_STEPS = {TURNED: 5.0, GAIN: 2.0}  # first ones, [degree], [dB]


def mountings_of(stretches: Sequence[Stretch], estimator: Estimator) -> tuple[Mounting, ...]:
    """Find what of the mounting would explain a signal that is unlike all that was learnt from.

    Parameters
    ----------
    stretches : sequence of Stretch
        With the axes of the estimator.
    estimator : Estimator

    Returns
    -------
    tuple of Mounting
        See `search_mountings`.
    """
    if estimator.axes != AXES:
        return ()
    return search_mountings([cross_powers(each) for each in stretches], estimator)


def search_mountings(powers: Sequence[Float], estimator: Estimator) -> tuple[Mounting, ...]:
    """Find what of the mounting would explain powers that are unlike all that was learnt from.

    Parameters
    ----------
    powers : sequence of float64 array
        Of each stretch, as of `cross_powers`.
    estimator : Estimator
        Of three axes; one of fewer knows no mounting.

    Returns
    -------
    tuple of Mounting
        Best first, and other familiar ones within `AS_GOOD` of it, one of each kind and axes. Empty where
        the signal is familiar as it is, or nothing makes it so.

    Notes
    -----
    Levels in twelfths of an octave of any other mounting follow from the powers and cross powers of the axes,
    so that nothing is described again. Only one mistake at a time is looked for.
    """
    if estimator.axes != AXES or not len(powers):
        return ()
    several, levels = np.stack(list(powers)), _Levels(estimator)
    if levels.strangeness(several, np.eye(len(AXES))) <= 1.0:
        return ()
    found = sorted(
        _candidates(lambda turn: levels.strangeness(several, turn)), key=lambda each: each.strangeness
    )
    if not found or found[0].strangeness > 1.0:
        return ()
    return tuple(each for each in found if each.strangeness <= min(found[0].strangeness + AS_GOOD, 1.0))


def strangeness_of(stretches: Sequence[Stretch], estimator: Estimator) -> float:
    """Measure how unlike what was learnt from stretches of three axes are by their levels, middle of them."""
    return strangeness_of_powers([cross_powers(each) for each in stretches], estimator)


def strangeness_of_powers(powers: Iterable[Float], estimator: Estimator) -> float:
    """Measure the same by the powers of stretches, as of `cross_powers`."""
    return _Levels(estimator).strangeness(np.stack(list(powers)), np.eye(len(AXES)))


def cross_powers(stretch: Stretch) -> Float:
    """Measure powers and cross powers of the axes in twelfths of an octave, shape [band, axis, axis]."""
    centred = stretch.acceleration - stretch.acceleration.mean(axis=0)
    lines = (
        rfft(centred * np.hanning(len(centred))[:, None], axis=0) / len(centred) * np.sqrt(2.0 * 8.0 / 3.0)
    )
    found = np.full((len(FINE), len(AXES), len(AXES)), np.nan)
    for k, band in enumerate(bands_of(FINE, 12, stretch.rate, len(centred))):
        if band is not None:
            found[k] = np.real(np.conj(lines[band]).T @ lines[band])
    return found


class _Levels:
    """Distance of levels from those that an estimator was learnt from."""

    def __init__(self, estimator: Estimator) -> None:
        names = names_of(AXES)
        self._estimator = estimator
        self._places = [[names.index(f"fine_{axis}_{middle:.0f}") for middle in FINE] for axis in AXES]

    def strangeness(self, powers: Float, undo: Float) -> float:
        """Measure it with a matrix applied to the axes, middle of the stretches."""
        power = np.einsum("ij,sbjk,ik->sib", undo, powers, undo)
        rows = np.tile(self._estimator.middle, (len(powers), 1))
        rows[:, np.ravel(self._places)] = 10.0 * np.log10(np.maximum(power, LEVEL_FLOOR**2)).reshape(
            len(powers), -1
        )
        return float(np.median(self._estimator.strangeness(rows)))


def _candidates(strangeness: Callable[[Float], float]) -> Iterator[Mounting]:
    for order in permutations(range(len(AXES))):
        if order != tuple(range(len(AXES))):
            # channel k has the axis order[k]
            restored = np.eye(len(AXES))[np.argsort(order)]
            yield Mounting(EXCHANGED, tuple(AXES[k] for k in order), 0.0, strangeness(restored))
    for about in range(len(AXES)):
        undo = partial(undo_turn, about)
        yield from _search_amount(TURNED, (AXES[about],), LEAST_TURN, FARTHEST_TURN, undo, strangeness)
    for which in (tuple(range(len(AXES))), *((k,) for k in range(len(AXES)))):
        undo = partial(undo_gain, which)
        yield from _search_amount(
            GAIN, tuple(AXES[k] for k in which), LEAST_GAIN, FARTHEST_GAIN, undo, strangeness
        )


def _search_amount(
    kind: str,
    axes: tuple[str, ...],
    least: float,
    farthest: float,
    undo: Callable[[float], Float],
    strangeness: Callable[[Float], float],
) -> Iterator[Mounting]:
    best = 0.0
    reach, step = farthest, _STEPS[kind]
    for finer in _ROUNDS:
        tried = np.arange(
            max(best - reach, -farthest), min(best + reach, farthest) + 0.5 * finer * step, finer * step
        )
        best = float(min(tried, key=lambda by: strangeness(undo(float(by)))))
        reach = finer * step
    if abs(best) >= least:
        yield Mounting(kind, axes, best, strangeness(undo(best)))


def undo_turn(about: int, degrees: float) -> Float:
    """Give the matrix from what a sensor records that is turned about an axis to the axes stated.

    By the rule of the right hand: turned by 90 degrees about x, its y axis points along z.
    """
    one, two = (about + 1) % 3, (about + 2) % 3
    turn = np.eye(3)
    turn[one, one] = turn[two, two] = cos(radians(degrees))
    turn[one, two], turn[two, one] = -sin(radians(degrees)), sin(radians(degrees))
    return turn


def undo_gain(which: Sequence[int], decibels: float) -> Float:
    """Give the matrix from what a sensor records whose axes have a gain over the one stated to the truth."""
    gain = np.eye(3)
    for k in which:
        gain[k, k] = 10.0 ** (-decibels / 20.0)
    return gain
