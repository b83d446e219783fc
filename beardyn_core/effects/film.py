"""Lubricant film of the raceway contacts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class LineFilm:
    """Elastohydrodynamic film of the raceway line contacts.

    Parameters
    ----------
    starvation : float
        Film thickness over the fully flooded one, 0 to 1.
    formula : str
        ``dowson_higginson`` or ``pan_hamrock`` for the minimum film, ``pan_hamrock_central`` or
        ``dowson_toyoda`` for the central one.
    thermal : str
        Reduction by shear heating of the inlet: ``none``, ``murch_wilson``, ``wilson`` or ``gupta_cheng`` (in
        pure rolling under light load).
    isoviscous : bool
        Whether light contacts have the film of rigid surfaces where that is thicker.
    thickening : str
        Viscosity at pressure, for film tractions that ask for it: ``barus`` or ``roelands``.
    """

    about: ClassVar[About] = About(
        adds="Film thickness of the raceway contacts.",
        states="none",
        cost="high",
        validity="Elastohydrodynamic regime of hard line contacts; light loads with isoviscous.",
        source="Dowson and Higginson (1966); Pan and Hamrock (1989); Dowson and Toyoda (1978); Martin (1916)",
    )

    starvation: float = 0.7
    formula: str = "dowson_higginson"
    thermal: str = "none"
    isoviscous: bool = False
    thickening: str = "barus"
