"""Resistance of the raceway contacts against rolling."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated as A
from typing import ClassVar, Literal

from beardyn_core.base.edge import SHARE, At
from beardyn_core.effects.about import RACEWAY_HEAT, About

RollingKind = Literal["aihara", "zhou_hoeprich", "biboulet_houpert", "hysteresis"]


@dataclass(frozen=True)
class RollingResistance:
    """Couple on roller and ring against their relative rotation about the contact line."""

    about: ClassVar[About] = About(
        loss="rolling_resistance",
        heat=RACEWAY_HEAT,
        adds="Rolling couple of the raceway contacts: hydrodynamic inlet, elastic hysteresis.",
        states="none",
        cost="low",
        validity="Line contacts with an even load along the roller; the laws differ by a factor of 2.",
        source="Aihara (1987); Zhou and Hoeprich (1991); Biboulet and Houpert (2010); Johnson (1985)",
    )

    kind: A[RollingKind, "law of the film's couple"] = "zhou_hoeprich"
    supply: A[float, SHARE, "couple over that of a flooded inlet"] = 1.0
    thermal: A[bool, "heating of the inlet"] = True
    hysteresis: A[float, At(ge=0.0, le=0.1), "share of the elastic energy lost in a cycle"] = 0.0
    regularisation_speed: A[
        float, At("m_per_s", gt=0.0), "entrainment speed at which 71 % of the couple is reached"
    ] = 0.01

    def rules(self) -> Iterator[str]:
        """Check the options against each other."""
        if self.kind == "hysteresis" and self.hysteresis == 0.0:
            yield (
                "kind is hysteresis, but hysteresis is 0; give the share of the elastic energy lost in a "
                "cycle, 0.005 to 0.01 for bearing steel"
            )
