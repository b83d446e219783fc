"""What running leaves of a fill of grease: oil on the raceways, and grease where the rollers run.

A fresh fill is churned. Most of it is pushed aside within a few hours, and what is left on the raceways thins
from a thick layer to that of a settled grease. From then on the grease bleeds, and as its oil is used up the
layer thins further, slowly.
"""

from __future__ import annotations

import math
from typing import Annotated as A

FRESH, SETTLED = 2.0e-6, 0.6e-6
# Oil on both surfaces before a contact, [m], None for more than any contact takes in.
LAYERS: dict[str, float | None] = {
    "flooded": None,
    "fresh": FRESH,
    "settled": SETTLED,
    "channelled": 0.3e-6,
}
SETTLED_FILL = 0.02
CHURNING: A[float, "in which churning dies away to 37 %, [millions of revolutions]"] = 0.1
GREASE_LIFE: A[float, "in which half of the oil is used up, likewise"] = 300.0


def aged_layer(million_revolutions: float) -> float:
    """Compute the layer of oil after some running, as of `LAYERS`, [m].

    Parameters
    ----------
    million_revolutions : float
        Of the shaft, since the grease was filled in.

    Notes
    -----
    Both times are assumed. Churning ends when a certain energy has gone into the grease, so it is counted in
    revolutions rather than in hours: a film that is at first above that of oil alone falls to 40 % below it
    within a few hours of a test rig. 300 million revolutions are 870 000 km on wheels of 0.92 m, about as
    far as a sealed unit runs before it is overhauled (800 000 km); greases fail when about half of
    their oil is gone, and the layer is taken in proportion to it, down to the ``channelled`` one.

    References
    ----------
    Lugt (2009), Tribol. Trans. 52, 470; Chatra, Osara and Lugt (2023), Tribol. Int. 183, 108375, churning and
    bleeding; "When lubrication fails" (1976), Ind. Lubr. Tribol. 28, 198, the oil left at the end.
    """
    churned = SETTLED + (FRESH - SETTLED) * math.exp(-million_revolutions / CHURNING)
    return float(churned * 0.5 ** min(million_revolutions / GREASE_LIFE, 1.0))


def aged_fill(fill: float, million_revolutions: float) -> float:
    """Compute the grease that is still where the rollers run, over the free space there.

    Parameters
    ----------
    fill : float
        As it was filled in.
    million_revolutions : float
        Of the shaft, since then.

    Notes
    -----
    What is pushed aside does not come back. A fill that is smaller than a settled one stays.
    """
    left = min(fill, SETTLED_FILL)
    return left + (fill - left) * math.exp(-million_revolutions / CHURNING)
