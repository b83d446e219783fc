"""How far the speed of a shaft may be from the truth, by the way it is known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from beardyn_core.measured.survey import Survey

UNCERTAINTY = 0.03  # of a speed that no tachometer counts: worn wheels, slipping motors, rounded figures, [-]
_COUNTED = "tacho"  # revolutions are counted


def uncertainty_of(survey: Survey) -> float:
    """Compute the relative uncertainty of the speed of measured files, [-]."""
    if survey.received is not None:
        return survey.received.uncertainty
    return 0.0 if survey.files[0].chosen.speed.kind == _COUNTED else UNCERTAINTY


def recorded_uncertainty(facts: Mapping[str, Any]) -> float:
    """Read the relative uncertainty of the speed from what a recording says of itself, [-].

    A simulated recording, whose shaft angle is known, says nothing.
    """
    speed = facts.get("speed")
    if not isinstance(speed, Mapping):
        return 0.0
    stated = speed.get("uncertainty")
    if isinstance(stated, int | float) and 0.0 <= stated < 1.0:
        return float(stated)
    return 0.0 if speed.get("from") == _COUNTED else UNCERTAINTY
