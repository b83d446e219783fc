"""How much oil a rolling contact finds, and the films that it would have with enough of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.bearing.film_thickness import line_film, rigid_line_film
from beardyn_core.bearing.rolling_resistance import RollingContact


@dataclass(frozen=True)
class OilSupply:
    """How much oil the contacts find: a layer on the raceways, or the same share for all."""

    formula: A[str, "of the film, a key of `LINE_FORMULAS`"] = "dowson_higginson"
    layer: A[float | None, "as in `layer_thickness`, None for enough, [m]"] = None
    film_share: A[float, "film over the flooded one where there is no layer"] = 1.0


FLOODED = OilSupply()


def flooded_film(contact: RollingContact, formula: str) -> float:
    """Compute the film of elastic surfaces with enough oil, [m]; see `line_film`."""
    return line_film(
        contact.load / contact.length,
        contact.entrainment_speed,
        contact.radius,
        contact.contact_modulus,
        contact.viscosity,
        contact.pressure_viscosity,
        formula,
    )


def rigid_film(contact: RollingContact) -> float:
    """Compute the film of rigid surfaces with enough oil, [m]; see `rigid_line_film`."""
    return rigid_line_film(
        contact.load / contact.length, contact.entrainment_speed, contact.radius, contact.viscosity
    )
