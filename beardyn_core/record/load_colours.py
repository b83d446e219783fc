"""Colour of a roller by its load, one scale for the 3-D view and for pictures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from beardyn_core.base.arrays import Float

# From nothing to the largest load of the run.
LOAD_COLOURS = np.array(
    [(176, 184, 196), (120, 190, 200), (130, 210, 120), (245, 215, 60), (250, 140, 40), (225, 40, 35)], float
)
CUP_COLOUR = (150, 164, 184)
CONE_COLOUR = (122, 136, 160)
SPALL_COLOUR = (255, 40, 90)


def load_colours(load: Float, largest: float) -> NDArray[np.uint8]:
    """Choose the colour of each load, shape [..., 3]; loads in [N]."""
    place = np.clip(load / max(largest, 1e-9), 0.0, 1.0) * (len(LOAD_COLOURS) - 1)
    stations = np.arange(len(LOAD_COLOURS))
    return np.stack([np.interp(place, stations, LOAD_COLOURS[:, i]) for i in range(3)], axis=-1).astype(
        np.uint8
    )
