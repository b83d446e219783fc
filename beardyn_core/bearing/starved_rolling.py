"""Rolling couple of a contact with as much oil as there is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.bearing.film_thickness import line_film, rigid_line_film
from beardyn_core.bearing.oil_layer import CoupleShares, layer_couple_shares, layer_thickness
from beardyn_core.bearing.rolling_resistance import (
    RollingContact,
    aihara_line,
    biboulet_houpert_line,
    rigid_line,
    zhou_hoeprich_line,
)
from beardyn_core.bearing.starvation import couple_shares

_POWER_LAWS = {"aihara": aihara_line, "zhou_hoeprich": zhou_hoeprich_line}
FORMS = (*_POWER_LAWS, "biboulet_houpert")


@dataclass(frozen=True)
class OilSupply:
    """How much oil the contacts find: a layer on the raceways, or the same share for all."""

    formula: A[str, "of the film, a key of `LINE_FORMULAS`"] = "dowson_higginson"
    layer: A[float | None, "as in `layer_thickness`, None for enough, [m]"] = None
    film_share: A[float, "film over the flooded one where there is no layer"] = 1.0

    def shares(self, contact: RollingContact) -> CoupleShares:
        """Compute the couple over that of a flooded inlet."""
        if self.layer is None:
            return couple_shares(self.film_share)
        if contact.entrainment_speed == 0.0:
            return CoupleShares(1.0, 1.0)  # of no couple
        layer = layer_thickness(self.layer, contact.viscosity, contact.entrainment_speed)
        return layer_couple_shares(max(flooded_film(contact, self.formula), rigid_film(contact)) / layer)


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


def rolling_couple(form: str, contact: RollingContact, supply: OilSupply = FLOODED) -> float:
    """Compute the isothermal rolling couple of a line contact with the oil it finds, [N m].

    The laws of elastic contacts are limited by the couple of rigid surfaces.

    Parameters
    ----------
    form : str
        One of `FORMS`.
    contact : RollingContact
    supply : OilSupply
    """
    rigid, elastic = supply.shares(contact)
    if form == "biboulet_houpert":
        return biboulet_houpert_line(contact, rigid, elastic)
    return min(elastic * _POWER_LAWS[form](contact), rigid * rigid_line(contact))
