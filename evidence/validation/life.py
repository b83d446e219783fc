"""Rating life: known limits of the standards."""

from __future__ import annotations

import math

import numpy as np

from beardyn_core.bearing.life import contact_ratings, dynamic_rating
from beardyn_core.config import load_any_bearing
from evidence.validation.anchor import Anchor

LUNDBERG = "Lundberg and Palmgren 1952: the rating is the load of a life of one million revolutions"


def rated_life_of_half_loaded_ring(name: str = "HS130x230") -> float:
    """Compute the life of a row under its own rating, half the ring loaded by the 10/9 law, no edges."""
    bearing = load_any_bearing(name)
    cone, cup = contact_ratings(bearing)
    angle = 2.0 * math.pi * np.arange(3600) / 3600
    shape = np.maximum(np.cos(angle), 0.0) ** (10.0 / 9.0)
    radial = dynamic_rating(bearing).radial / 2.0 ** (7.0 / 9.0)
    largest = radial / (
        bearing.roller_count * math.cos(bearing.cup_angle) * float(np.mean(shape * np.cos(angle)))
    )
    # the ratings hold 1/0.83 in reserve for the edge stress, which is left out here
    cone_mean = largest * float(np.mean(shape**4.0)) ** (1 / 4.0) / (0.83 * cone)
    cup_mean = largest * float(np.mean(shape**4.5)) ** (1 / 4.5) / (0.83 * cup)
    return float((cone_mean**4.5 + cup_mean**4.5) ** (-8.0 / 9.0))


ANCHORS = (
    Anchor(
        "rating life",
        "reference life at the rating, half the ring loaded, without edge stress",
        1.0,
        "10^6 rev",
        LUNDBERG + "; 0.83 for edges taken back",
        rated_life_of_half_loaded_ring,
        tolerance=0.02,
    ),
)
