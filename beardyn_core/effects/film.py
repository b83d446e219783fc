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
    """

    about: ClassVar[About] = About(
        adds="Film thickness of the raceway contacts.",
        states="none",
        cost="medium",
        validity="Elastohydrodynamic regime of hard line contacts.",
        source="Dowson and Higginson (1966)",
    )

    starvation: float = 0.7
