"""Description of an effect in the catalogue."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A


@dataclass(frozen=True)
class About:
    """One entry of the catalogue."""

    adds: A[str, "what the effect adds to the model"]
    states: A[str, "states it adds, ``none`` for a force alone"]
    cost: A[str, "cost class in the step: ``none``, ``low`` (below 3 %), ``medium`` (below 15 %) or ``high``"]
    validity: A[str, "where it holds"]
    source: A[str, "where its formulas come from"]
