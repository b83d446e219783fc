"""The layer of oil that a grease leaves on the raceways, and what it makes of film and rolling couple.

What a grease leaves on the raceways is a layer of oil. Contacts whose flooded film would be thinner than the
layer run flooded; the others have a film of about the layer, whatever their load. Their rolling couple falls
faster than their film: `starvation`.
"""

from __future__ import annotations

from typing import Annotated as A
from typing import NamedTuple, TypeVar

from beardyn_core.base.arrays import Float

Thickness = TypeVar("Thickness", float, Float)

# Of the film over the layer, (1 + ratio^4)^(-1/4) times the flooded film.
TRANSITION = 4.0
# Shares of the couple as (1 + (factor ratio)^steepness)^(-power / steepness), fitted to Reynolds' equation.
RIGID_FIT = (1.838, 4.0, 0.923)
ELASTIC_FIT = (1.743, 2.551, 1.984)
LAYER_LOAD: A[float, "[N/m]"] = 0.15
LAYER_EXPONENT = 0.3


class CoupleShares(NamedTuple):
    """Couple over that of a flooded inlet."""

    rigid: float
    elastic: float


def layer_thickness(layer: float, viscosity: float, speed: float) -> float:
    """Compute the layer of oil that a contact finds, [m].

    It grows with viscosity times speed, but less than the film does, so that contacts starve the more the
    colder and faster they run.

    Parameters
    ----------
    layer : float
        Where viscosity times speed is `LAYER_LOAD`, [m].
    viscosity : float
        [Pa s].
    speed : float
        Of entrainment, [m/s].

    References
    ----------
    The exponent is chosen: with it the couple's share falls from 30 to 400 mm2/s as the replenishment factor
    for grease of SKF (2018), Rolling bearings, "The SKF model for calculating the frictional moment".
    """
    return float(layer * (viscosity * speed / LAYER_LOAD) ** LAYER_EXPONENT)


def starved_film(flooded: Thickness, layer: float) -> Thickness:
    """Compute the film that a layer of oil leaves of the flooded one, [m].

    References
    ----------
    Chevalier et al. (1998), ASME J. Tribol. 120, 126: r / (1 + r^g)^(1/g) of the flooded film, r the layer
    over it, g from 2 to 5 for point contacts, higher the less oil flows aside.
    """
    return flooded / (1.0 + (flooded / layer) ** TRANSITION) ** (1.0 / TRANSITION)


def layer_couple_shares(ratio: float) -> CoupleShares:
    """Compute the couple over that of a flooded inlet from the flooded film over the layer of oil.

    `beardyn_core.bearing.starvation.couple_shares` of `starved_film`, within 11 %.
    """
    return CoupleShares(*(_fit(ratio, *fit) for fit in (RIGID_FIT, ELASTIC_FIT)))


def _fit(ratio: float, factor: float, steepness: float, power: float) -> float:
    return float((1.0 + (factor * ratio) ** steepness) ** (-power / steepness))
