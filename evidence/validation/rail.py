"""Track irregularity."""

from __future__ import annotations

from functools import partial

import numpy as np

from beardyn_core.rail.irregularity import rail_profile
from beardyn_core.scene.operation import Irregularity
from evidence.validation.anchor import Anchor


def deviation(kind: str) -> float:
    """Return the standard deviation of a made irregularity, [mm]."""
    profile = rail_profile(Irregularity(kind, 3.0, 150.0), 1.0e5, seed=11)
    return float(1e3 * np.std(profile.height))


ANCHORS = tuple(
    Anchor(
        "track",
        f"standard deviation of {kind}, wavelengths 3 to 150 m",
        value,
        "mm",
        "one-sided density integrated",
        partial(deviation, kind),
        tolerance=0.03,
    )
    for kind, value in (("german_low", 2.86), ("german_high", 4.69), ("fra_6", 4.32))
)
