"""Lubricant film of the raceway contacts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar

from beardyn_core.edge import At
from beardyn_core.effects.about import About

FORMULAS = ("dowson_higginson", "pan_hamrock", "pan_hamrock_central", "dowson_toyoda")
INLET_HEATING = ("none", "murch_wilson", "wilson", "gupta_cheng")
THICKENING = ("barus", "roelands")


@dataclass(frozen=True)
class LineFilm:
    """Elastohydrodynamic film of the raceway contacts.

    Inlet heating of ``gupta_cheng`` is for pure rolling under light load.
    """

    about: ClassVar[About] = About(
        adds="Film thickness of the raceway contacts.",
        states="none",
        cost="high",
        validity="Elastohydrodynamic regime of hard line contacts; light loads with isoviscous.",
        source="Dowson and Higginson (1966); Pan and Hamrock (1989); Dowson and Toyoda (1978); Martin (1916)",
    )

    starvation: A[float, At(gt=0.0, le=1.0), "film over the fully flooded film"] = 0.7
    formula: A[str, At(one_of=FORMULAS), "minimum film, or the central one of the last two"] = FORMULAS[0]
    thermal: A[str, At(one_of=INLET_HEATING), "reduction by shear heating of the inlet"] = "none"
    isoviscous: A[bool, "light contacts have the film of rigid surfaces where it is thicker"] = False
    thickening: A[str, At(one_of=THICKENING), "viscosity at pressure, for film tractions that ask for it"] = (
        "barus"
    )
