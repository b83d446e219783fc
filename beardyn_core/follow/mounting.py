"""A mounting of a sensor that is not as stated, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from statistics import median
from typing import Annotated as A

from beardyn_core.follow.descriptors import AXES

EXCHANGED, TURNED, GAIN = "exchanged", "turned", "gain"
_SAME = {EXCHANGED: 0.0, TURNED: 10.0, GAIN: 3.0}  # of an amount, by which one mounting scatters


@dataclass(frozen=True)
class Mounting:
    """A mounting of the sensor that would make a strange signal familiar."""

    kind: A[str, "``exchanged``, ``turned`` or ``gain``"]
    axes: A[tuple[str, ...], "of the channels in their order; the one turned about; those with another gain"]
    amount: A[
        float,
        "angle by which the sensor is turned by the rule of the right hand [degree], or gain over the one "
        "stated [dB]; 0 of an exchange",
    ]
    strangeness: A[float, "of the signal with it undone, [-]"]

    @property
    def sentence(self) -> str:
        """Say it in words."""
        if self.kind == EXCHANGED:
            return f"its channels are {', '.join(self.axes)} in place of {', '.join(AXES)}"
        if self.kind == TURNED:
            return f"it is turned by {self.amount:.0f}° about {self.axes[0]}"
        which = "all axes" if len(self.axes) > 1 else f"axis {self.axes[0]}"
        factor = 10.0 ** (self.amount / 20.0)
        return f"the gain of {which} is off by {self.amount:+.1f} dB (a factor of {factor:.3g})"


@dataclass(frozen=True)
class LastingMounting:
    """A mounting that is found in several recordings of a sensor."""

    mounting: A[Mounting, "middle of what is found in each"]
    recordings: A[tuple[int, ...], "in which it is found, in the order of time, from 0"]

    def sentence_of(self, count: int) -> str:
        """Say it in words, with the recordings of so many that it is found in, counted from 1."""
        if count == 1:
            return self.mounting.sentence
        if len(self.recordings) == count:
            return f"{self.mounting.sentence}, in all {count} recordings"
        which = ", ".join(str(each + 1) for each in self.recordings)
        return f"{self.mounting.sentence}, in recordings {which} of {count}"


def check_mounting(sentences: Sequence[str]) -> str:
    """Ask for a check of the sensor, for the signal would be familiar if one of these were so."""
    return f"check mounting and gain of the sensor: the signal would be familiar if {', or '.join(sentences)}"


def lasting_mountings(found: Sequence[tuple[Mounting, ...]]) -> tuple[LastingMounting, ...]:
    """Join what is found in the recordings of one sensor.

    Parameters
    ----------
    found : sequence of tuple of Mounting
        Of each recording in the order of time, empty where its signal is familiar or unexplained.

    Returns
    -------
    tuple of LastingMounting
        Those that are found in most of the recordings from the first one on that has them, and in two at
        least where there are several: a sensor that is mounted otherwise stays so, and a single recording
        may be strange for another reason. First the one that most recordings have.
    """
    several: dict[tuple[str, tuple[str, ...]], list[tuple[int, Mounting]]] = {}
    for number, mountings in enumerate(found):
        for each in mountings:
            several.setdefault((each.kind, each.axes), []).append((number, each))
    lasting = []
    for (kind, _), ones in several.items():
        middle = median(each.amount for _, each in ones)
        near = [(number, each) for number, each in ones if abs(each.amount - middle) <= _SAME[kind]]
        if not near:
            continue
        numbers = tuple(number for number, _ in near)
        if len(near) < min(len(found), 2) or 2 * len(near) <= len(found) - numbers[0]:
            continue
        mounting = replace(
            near[0][1],
            amount=median(each.amount for _, each in near),
            strangeness=median(each.strangeness for _, each in near),
        )
        lasting.append(LastingMounting(mounting, numbers))
    return tuple(sorted(lasting, key=lambda each: (-len(each.recordings), each.mounting.strangeness)))
