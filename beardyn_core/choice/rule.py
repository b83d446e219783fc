"""Data of a choice: alternatives of an effect with their cost and the errors they cause."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated as A
from typing import Any

from beardyn_core.scene.scene import QUANTITIES

# Third-octave bands within 1.5 dB, whatever the accuracy of the rest.
VIBRATION_TOLERANCE_DB = 1.5
# What another law of friction at raceways or ribs does to the bands beside the resonance of the axlebox, at
# most: from runs with one law after the other, everything else alike, at 68 kN.
FRICTION_DB = 2.1
_SMALLEST_PERCENT = 0.01
UNITS = {name: "dB" if name == "vibration" else "%" for name in QUANTITIES}

Influence = Mapping[str, float]


@dataclass(frozen=True)
class Alternative:
    """One choice for an effect: options with which it is on, or that it is off."""

    members: A[Mapping[str, Any], "member of the effect set -> its options or ``None``"]
    reason: A[str, "a sentence with the number that speaks for or against it"]
    influence: A[
        Influence, "quantity -> what it makes wrong against the reference: a fraction, of vibration in dB"
    ] = field(default_factory=dict)
    cost: A[float, "added to the step, in steps of the standard set"] = 0.0
    tiers: A[frozenset[str], "tiers that can have it"] = frozenset({"lumped", "quasistatic", "full"})
    word: A[str, "what it is called, ``on`` and ``off`` mostly"] = "on"


@dataclass(frozen=True)
class Rule:
    """All alternatives for one effect; the first is that of the reference."""

    effect: A[str, "its name in the catalogue"]
    alternatives: tuple[Alternative, ...]


@dataclass(frozen=True)
class Decision:
    """What has been decided on an effect."""

    effect: str
    word: str
    reason: str
    on: bool
    cost_share: A[float, "part of the step that it takes, [-]"]
    influence: A[
        Influence, "expected error of each asked quantity by this decision: a fraction, of vibration in dB"
    ]

    def sentence(self) -> str:
        """Write effect, decision and reason in a sentence."""
        return f"{self.effect} {self.word}: {self.reason}"


def tolerance(quantity: str, accuracy: float) -> float:
    """Return the largest error that a quantity may have: a fraction, for vibration in dB."""
    return VIBRATION_TOLERANCE_DB if quantity == "vibration" else accuracy


def percent(value: float) -> str:
    """Write a fraction in percent, to two digits."""
    share = 100.0 * value
    if 0.0 < abs(share) < _SMALLEST_PERCENT:
        return f"below {_SMALLEST_PERCENT:g} %"
    return f"{share:.2g} %" if abs(share) < 99.5 else f"{share:.0f} %"
