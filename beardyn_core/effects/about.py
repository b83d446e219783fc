"""Description of an effect in the catalogue."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class About:
    """One entry of the catalogue.

    Parameters
    ----------
    adds : str
        What the effect adds to the model.
    states : str
        States it adds, ``none`` for a force alone.
    cost : str
        Cost class in the step: ``none``, ``low`` (below 3 %), ``medium`` (below 15 %) or ``high``.
    validity : str
        Where it holds.
    source : str
        Where its formulas come from.
    """

    adds: str
    states: str
    cost: str
    validity: str
    source: str
