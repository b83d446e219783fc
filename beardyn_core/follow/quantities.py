"""What can be estimated of a bearing in service, and by which label of a simulated run it is learnt."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

import numpy as np

from beardyn_core.base.arrays import Float
from beardyn_core.base.units import ZERO_CELSIUS


@dataclass(frozen=True)
class Quantity:
    """A number that is estimated."""

    name: A[str, "in results"]
    words: A[str, "what it is"]
    label: A[str, "column of the table of a set that holds its truth, in SI"]
    unit: A[str, "in SI"]
    shown: A[str, "unit at the edge"]
    factor: A[float, "from SI to it"]
    relative: A[bool, "errors are shares of it: it is learnt as a logarithm"]
    of_fault: A[bool, "only spalled bearings have it"] = False
    offset: A[float, "at the edge: zero of the unit there, in SI"] = 0.0
    of_passages: A[bool, "learnt from the shape of passages alone, which no level of a box changes"] = False

    def scaled(self, values: Float) -> Float:
        """Take values in SI to the scale on which they are learnt."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.log(values) if self.relative else values * self.factor

    def restored(self, scaled: Float) -> Float:
        """Take values from the scale on which they are learnt to SI."""
        return np.exp(scaled) if self.relative else scaled / self.factor

    def text(self, value: float) -> str:
        """Write a value in SI in the unit of the edge."""
        return f"{(value - self.offset) * self.factor:.3g} {self.shown}"

    def width_text(self, width: float) -> str:
        """Write a difference of two values in SI in the unit of the edge."""
        return f"{width * self.factor:.2g} {'K' if self.offset else self.shown}"


QUANTITIES = (
    Quantity("vertical_load", "mean vertical load on the journal", "load_fz_N_mean", "N", "kN", 1e-3, True),
    Quantity("lateral_load", "mean lateral load on the journal", "load_fy_N_mean", "N", "kN", 1e-3, False),
    Quantity("end_play", "end play of the bearing as mounted", "end_play_m", "m", "mm", 1e3, False),
    Quantity(
        "temperature",
        "temperature of the bearing",
        "temperature_K",
        "K",
        "°C",
        1.0,
        False,
        offset=ZERO_CELSIUS,
    ),
    Quantity(
        "width",
        "width of the spall along the raceway",
        "fault_width_m",
        "m",
        "mm",
        1e3,
        True,
        True,
        of_passages=True,
    ),
    Quantity(
        "length", "length of the spall across the raceway", "fault_length_m", "m", "mm", 1e3, True, True
    ),
    Quantity("depth", "depth of the spall", "fault_depth_m", "m", "um", 1e6, True, True),
)
"""In the order in which they are reported."""
BY_NAME = {each.name: each for each in QUANTITIES}
