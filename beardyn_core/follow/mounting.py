"""A mounting of a sensor that is not as stated, in words."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.follow.descriptors import AXES

EXCHANGED, TURNED, GAIN = "exchanged", "turned", "gain"


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
