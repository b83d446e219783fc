"""Description of an effect in the catalogue, and the option that several effects have."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated as A

from beardyn_core.base.edge import At

# where friction is regularised by u / sqrt(u^2 + u_r^2)
SlipSpeed = A[float, At("m_per_s", gt=0.0), "slip speed at which 71 % of the friction is reached"]

# Half of what a contact loses warms each of its partners; the raceways are not distinguished.
RACEWAY_HEAT = {"rollers": 0.5, "cup": 0.25, "cone": 0.25}
RIB_HEAT = {"rollers": 0.5, "cone": 0.5}
POCKET_HEAT = {"rollers": 0.5, "cages": 0.5}


@dataclass(frozen=True)
class About:
    """One entry of the catalogue."""

    adds: A[str, "what the effect adds to the model"]
    loss: A[str, "source of loss that its work counts as, of ``LOSS_NAMES``; empty when it loses nothing"]
    states: A[str, "states it adds, ``none`` for a force alone"]
    cost: A[str, "cost class in the step: ``none``, ``low`` (below 3 %), ``medium`` (below 15 %) or ``high``"]
    validity: A[str, "where it holds"]
    source: A[str, "where its formulas come from"]
    heat: A[
        Mapping[str, float], "part that its loss warms, of `physics.thermal.NODES` -> share of it; sum 1"
    ] = field(default_factory=dict)
    needs: A[tuple[str, ...], "members of the `EffectSet` without which it means nothing"] = ()
    bearings: A[tuple[str, ...], "kinds of bearings that have it; empty for all"] = ()

    def suits(self, kind: str) -> bool:
        """Tell whether bearings of a kind have what the effect is about."""
        return not self.bearings or kind in self.bearings
