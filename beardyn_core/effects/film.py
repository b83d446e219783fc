"""Lubricant film of the raceway contacts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.base.edge import At
from beardyn_core.effects.about import About
from beardyn_core.effects.grease import LAYERS, aged_layer

FORMULAS = ("dowson_higginson", "pan_hamrock", "pan_hamrock_central", "dowson_toyoda")
INLET_HEATING = ("none", "murch_wilson", "wilson", "gupta_cheng")
THICKENING = ("barus", "roelands")
SUPPLIES = (*LAYERS, "ageing")


@dataclass(frozen=True)
class LineFilm:
    """Elastohydrodynamic film of the raceway contacts.

    Inlet heating of ``gupta_cheng`` is for pure rolling under light load. What grease has left of the oil on
    the raceways thins the film and takes from the rolling couple.
    """

    about: ClassVar[About] = About(
        loss="",
        adds="Film thickness of the raceway contacts.",
        states="none",
        cost="high",
        validity="Elastohydrodynamic regime of hard line contacts; light loads with isoviscous.",
        source="Dowson and Higginson (1966); Pan and Hamrock (1989); Dowson and Toyoda (1978); Martin (1916)",
    )

    supply: A[
        str,
        At(one_of=SUPPLIES),
        "oil bath; grease just filled in, run in, or pushed aside; or what million_revolutions make of it",
    ] = "settled"
    million_revolutions: A[
        float | None, At(ge=0.0, le=1e4), "of the shaft since the grease was filled in, for ageing"
    ] = None
    layer: A[
        float | None,
        At("um", gt=0.0, le=1000.0),
        "oil on both surfaces before a contact, at 0.15 N/m of viscosity times entrainment speed, instead of "
        "that of the supply",
    ] = None
    starvation: A[
        float | None,
        At(gt=0.0, le=1.0),
        "film over the fully flooded film, the same for all contacts, instead of a layer",
    ] = None
    formula: A[str, At(one_of=FORMULAS), "minimum film, or the central one of the last two"] = FORMULAS[0]
    thermal: A[str, At(one_of=INLET_HEATING), "reduction by shear heating of the inlet"] = "none"
    isoviscous: A[bool, "light contacts have the film of rigid surfaces where it is thicker"] = False
    thickening: A[str, At(one_of=THICKENING), "viscosity at pressure, for film tractions that ask for it"] = (
        "barus"
    )

    def rules(self) -> Iterator[str]:
        """Check the options against each other."""
        if self.layer is not None and self.starvation is not None:
            yield "layer_um and starvation both set the amount of oil; give one of them"
        if (self.supply == "ageing") != (self.million_revolutions is not None):
            yield "supply ageing and million_revolutions go together; give both or neither"
        for key, given in (("layer_um", self.layer), ("starvation", self.starvation)):
            if self.supply == "ageing" and given is not None:
                yield f"supply ageing and {key} both set the amount of oil; give one of them"

    @property
    def oil_layer(self) -> float | None:
        """Layer of oil that starves the contacts, [m]; None where nothing or `starvation` does."""
        if self.starvation is not None:
            return None
        if self.layer is not None:
            return self.layer
        if self.million_revolutions is not None:
            return aged_layer(self.million_revolutions)
        return LAYERS[self.supply]

    @property
    def constant_share(self) -> float:
        """Film over the flooded one of every contact, 1 where a layer or nothing starves them."""
        return 1.0 if self.starvation is None else self.starvation
