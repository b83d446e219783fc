"""What has been chosen, with its reasons, cost and expected errors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated as A
from typing import Any

from beardyn_core.choice.rule import Decision, percent
from beardyn_core.effects import EffectSet
from beardyn_core.scene.scene import Scene


@dataclass(frozen=True)
class Choice:
    """What a scene is computed with, and why."""

    tier: str
    effects: EffectSet
    laminae: int
    steps_per_sample: float
    accuracy: A[float, "asked for, [-]"]
    quantities: A[tuple[str, ...], "asked for"]
    tier_reason: str
    laminae_reason: str
    steps_reason: str
    decisions: A[tuple[Decision, ...], "one for each effect, in the order of the catalogue"]
    expected: A[Mapping[str, float], "expected error of each asked quantity: a fraction, of vibration in dB"]
    step_cost: A[float, "of a step, in steps of the standard set"]
    seconds: A[float, "wall time of a simulated second on the machine of the cost file, [s]"]
    within: A[bool, "whether the expected errors are within the accuracy"]

    @property
    def real_time_factor(self) -> float:
        """Real-time factor to expect on the machine of the cost file."""
        return 1.0 / self.seconds

    @property
    def reasons(self) -> tuple[str, ...]:
        """List the reasons, a sentence for each choice."""
        return (
            f"tier {self.tier}: {self.tier_reason}",
            f"laminae {self.laminae}: {self.laminae_reason}",
            f"steps_per_sample {self.steps_per_sample}: {self.steps_reason}",
            *(decision.sentence() for decision in self.decisions),
        )

    def applied(self, scene: Scene) -> Scene:
        """Apply this choice to a scene; bearing, load, faults, sensors and seed stay."""
        kept = replace(scene.numerics, laminae=self.laminae, steps_per_sample=self.steps_per_sample)
        return replace(scene, tier=self.tier, effects=self.effects, numerics=kept, chosen=self.reasons)

    def to_json(self) -> dict[str, Any]:
        """Give the choice as a mapping for JSON; unknown errors and costs are NaN."""
        return {
            "tier": self.tier,
            "effects": self.effects.names(),
            "laminae": self.laminae,
            "steps_per_sample": self.steps_per_sample,
            "accuracy": self.accuracy,
            "quantities": self.quantities,
            "within_accuracy": self.within,
            "expected_error": _errors(self.expected),
            "real_time_factor": self.real_time_factor,
            "step_cost": self.step_cost,
            "reasons": {
                "tier": self.tier_reason,
                "laminae": self.laminae_reason,
                "steps_per_sample": self.steps_reason,
            },
            "decisions": [
                {
                    "effect": decision.effect,
                    "on": decision.on,
                    "choice": decision.word,
                    "reason": decision.reason,
                    "cost_share": decision.cost_share,
                    "error": _errors(decision.influence),
                }
                for decision in self.decisions
            ],
        }


def _errors(errors: Mapping[str, float]) -> dict[str, dict[str, Any]]:
    return {
        name: {"error": error, "unit": "dB" if name == "vibration" else "share"}
        for name, error in errors.items()
    }


def error_text(quantity: str, error: float) -> str:
    """Write an expected error in words."""
    if math.isnan(error):
        return "unknown"
    return f"{error:.2g} dB" if quantity == "vibration" else percent(error)
