"""Resistance of the raceway contacts against rolling."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from beardyn_core.effects.about import About

RollingKind = Literal["aihara", "zhou_hoeprich", "biboulet_houpert", "hysteresis"]


@dataclass(frozen=True)
class RollingResistance:
    """Couple on roller and ring against their relative rotation about the contact line.

    Parameters
    ----------
    kind : str
        Law of the film's couple: ``aihara``, ``zhou_hoeprich`` (measured on tapered roller bearings) or
        ``biboulet_houpert`` (from light to heavy loads); ``hysteresis`` for none.
    supply : float
        Couple over that of a fully flooded inlet, 0 to 1.
    thermal : bool
        Reduce the couple by heating of the inlet. The film thickness is not reduced by this.
    hysteresis : float
        Share of the elastic energy that the steel loses in a cycle, 0 for none.
    regularisation_speed : float
        Entrainment speed at which 71 % of the couple is reached, [m/s].
    """

    about: ClassVar[About] = About(
        adds="Rolling couple of the raceway contacts: hydrodynamic inlet, elastic hysteresis.",
        states="none",
        cost="low",
        validity="Line contacts with an even load along the roller; the laws differ by a factor of 2.",
        source="Aihara (1987); Zhou and Hoeprich (1991); Biboulet and Houpert (2010); Johnson (1985)",
    )

    kind: RollingKind = "zhou_hoeprich"
    supply: float = 1.0
    thermal: bool = True
    hysteresis: float = 0.0
    regularisation_speed: float = 0.01
