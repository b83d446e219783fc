"""Energy balance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from beardyn_core.effects.about import About


@dataclass(frozen=True)
class Audit:
    """Energy balance kept while the model runs."""

    about: ClassVar[About] = About(
        loss="",
        adds="Energy balance kept while the model runs.",
        states="none",
        cost="medium",
        validity="Covers the run up to the start of the latest block.",
        source="Definition of the energy residual in the model page",
    )
