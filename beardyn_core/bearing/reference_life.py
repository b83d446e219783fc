"""Reference rating life of a loaded bearing from the load of every lamina, after ISO 16281."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

import numpy as np
from numpy.typing import NDArray

from beardyn_core.bearing.edge_concentration import edge_concentration
from beardyn_core.bearing.geometry import Bearing
from beardyn_core.bearing.life import (
    LINE_CONTACT_REDUCTION,
    MILLION,
    dynamic_rating,
    fatigue_load_limit,
    life_modification,
    rating_gamma,
)

Float = NDArray[np.float64]

SMALLEST_LAMINA_COUNT = 30
_ROWS = 2
_WEIBULL = 9.0 / 8.0  # slope of line contact; the load exponent of one contact is 4
_ROTATING, _STATIONARY = 4.0, 4.5  # exponents of the mean load of a ring


@dataclass(frozen=True)
class ReferenceLife:
    """Reference rating life of one load."""

    basic: A[float, "L_10r, [revolutions]"]
    modified: A[float, "L_10mr with lubrication and contamination, [revolutions]"]
    equivalent_load: A[float, "P_ref,r = C_r / (L_10r / 10^6)^(3/10), [N]"]
    lamina_life: A[
        Float, "shape [row, lamina], basic life of each lamina of a row, both raceways, [revolutions]"
    ]


def contact_ratings(bearing: Bearing) -> tuple[float, float]:
    """Compute the dynamic load ratings Q_ci and Q_ce of one roller on cone and cup, [N].

    References
    ----------
    ISO/TS 16281 (2008), roller bearings; C_r of both rows, i = 2.
    """
    gamma = rating_gamma(bearing)
    rings = (1.038 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)) ** 4.5
    radial = dynamic_rating(bearing).radial / LINE_CONTACT_REDUCTION
    share = radial / (bearing.roller_count * _ROWS ** (7.0 / 9.0) * math.cos(bearing.cup_angle))
    cone = share / 0.378 * (1.0 + rings) ** (2.0 / 9.0)
    cup = share / 0.364 * (1.0 + 1.0 / rings) ** (2.0 / 9.0)
    return cone, cup


def reference_life(
    bearing: Bearing, cup_load: Float, cone_load: Float, viscosity_ratio: float, contamination: float
) -> ReferenceLife:
    """Compute the basic and modified reference rating life; the cone turns, the load direction is fixed.

    Parameters
    ----------
    bearing : Bearing
    cup_load, cone_load : float64 arrays, shape [row, roller, lamina]
        Load of each lamina, [N]; at least 30 laminae for a life by the standard.
    viscosity_ratio, contamination : float
        kappa and e_C, as in `life_modification`.

    Returns
    -------
    ReferenceLife

    Notes
    -----
    The life modification of a lamina takes the equivalent load of a bearing of which every lamina is loaded
    like it, at the fourth-power law of one contact.

    References
    ----------
    ISO/TS 16281 (2008), roller bearings: ratings and mean loads of the laminae, their lives added with the
    Weibull slope 9/8.
    """
    lamina_count = cup_load.shape[2]
    scale = float(lamina_count) ** (-7.0 / 9.0)
    cone_rating, cup_rating = (scale * rating for rating in contact_ratings(bearing))
    edge = edge_concentration(lamina_count)
    cone_mean = np.mean((edge * cone_load) ** _ROTATING, axis=1) ** (1.0 / _ROTATING)
    cup_mean = np.mean((edge * cup_load) ** _STATIONARY, axis=1) ** (1.0 / _STATIONARY)
    damage = (cone_mean / cone_rating) ** (4.0 * _WEIBULL) + (cup_mean / cup_rating) ** (4.0 * _WEIBULL)
    total = float(damage.sum())
    rating = dynamic_rating(bearing).radial
    with np.errstate(divide="ignore"):
        lamina_life = MILLION * damage ** (-1.0 / _WEIBULL)
        alike = (_ROWS * lamina_count * damage) ** (0.25 / _WEIBULL) * rating / LINE_CONTACT_REDUCTION
    limit = fatigue_load_limit(bearing)
    modification = np.array(
        [
            life_modification(viscosity_ratio, contamination, limit / load) if load > 0.0 else math.inf
            for load in alike.ravel()
        ]
    ).reshape(alike.shape)
    modified = float((damage * modification**-_WEIBULL).sum())
    basic_life = MILLION * total ** (-1.0 / _WEIBULL) if total > 0.0 else math.inf
    modified_life = MILLION * modified ** (-1.0 / _WEIBULL) if modified > 0.0 else math.inf
    equivalent = rating * (MILLION / basic_life) ** 0.3
    return ReferenceLife(basic_life, modified_life, equivalent, lamina_life)
