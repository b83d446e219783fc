"""Data of a choice: alternatives with cost and errors, decisions, the outcome with its reasons."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated as A
from typing import Any, NamedTuple

from beardyn_core.effects import EffectSet
from beardyn_core.scene.scene import QUANTITIES, Scene

# Third-octave bands within 1.5 dB, whatever the accuracy of the rest.
VIBRATION_TOLERANCE_DB = 1.5
# What another law of friction at raceways or ribs does to the bands next to the resonance of the axlebox, at
# most: from runs with one law after the other, everything else alike, at 68 kN.
FRICTION_DB = 2.1
_SMALLEST_PERCENT = 0.01
UNITS = {name: "dB" if name == "vibration" else "%" for name in QUANTITIES}
# how the parts of `Choice.summary` begin
_CHOSEN, _LEFT = "chosen for ", "left out: "
_BOUNDS = "differs from the full model by at most (bounds) "
_UNKNOWN = "difference from the full model unknown"
_WIDE = "the bound is wider than the wanted "
FAST, FULL = frozenset({"lumped", "quasistatic"}), frozenset({"full"})

# quantity -> error: a fraction, of vibration in dB
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
    tiers: A[frozenset[str], "tiers that can have it"] = FAST | FULL
    word: A[str, "what it is called, ``on`` and ``off`` mostly"] = "on"


@dataclass(frozen=True)
class Rule:
    """All alternatives for one effect; the first is that of the reference."""

    effect: A[str, "its name in the catalogue"]
    alternatives: tuple[Alternative, ...]


def absent(effect: str, tiers: frozenset[str] = FAST | FULL) -> Rule:
    """Make the rule of an effect that the reference does not have."""
    return Rule(effect, (Alternative({effect: None}, "not in the reference", word="off", tiers=tiers),))


def on_or_off(
    effect: str,
    options: Any,
    reason: str,
    influence: Influence,
    cost: float,
    tiers: frozenset[str] = FAST | FULL,
) -> Rule:
    """Make the rule of an effect that is on at a cost, or off with errors."""
    on = Alternative({effect: options}, reason, {}, cost, tiers)
    return Rule(effect, (on, Alternative({effect: None}, reason, influence, word="off")))


class Verdict(NamedTuple):
    """Errors of a tier or of a lamina count, and the reason for them."""

    reason: str
    influence: Influence


@dataclass(frozen=True)
class Decision:
    """What has been decided on an effect."""

    effect: str
    word: str
    reason: str
    on: bool
    cost_share: A[float, "part of the step that it takes, [-]"]
    influence: A[
        Influence,
        "bound of the error of each quantity by this decision: a fraction, of vibration in dB",
    ]

    def sentence(self) -> str:
        """Write effect, decision, reason and the error that it is expected to cause in a sentence."""
        return f"{self.effect} {self.word}: {self.reason}{self.left_out}"

    @property
    def left_out(self) -> str:
        """Write what the decision makes wrong in brackets; nothing where it does not."""
        errors = ", ".join(
            f"{name} {error_text(name, error)}" for name, error in self.influence.items() if error > 0.0
        )
        return f" (error: {errors})" if errors else ""


def tolerance(quantity: str, accuracy: float) -> float:
    """Return the largest error that a quantity may have: a fraction, for vibration in dB."""
    return VIBRATION_TOLERANCE_DB if quantity == "vibration" else accuracy


def _write_largest_error(quantity: str, accuracy: float) -> str:
    """Write the largest error that a quantity may have."""
    limit = tolerance(quantity, accuracy)
    return f"{limit:g} dB" if quantity == "vibration" else f"{100.0 * limit:.3g} %"


def percent(value: float) -> str:
    """Write a fraction in percent, to two digits."""
    share = 100.0 * value
    if 0.0 < abs(share) < _SMALLEST_PERCENT:
        return f"below {_SMALLEST_PERCENT:g} %"
    return f"{share:.2g} %" if abs(share) < 99.5 else f"{share:.0f} %"


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
    expected: A[
        Mapping[str, float],
        "bound of the difference from the full model: a fraction, dB of vibration",
    ]
    step_cost: A[float, "of a step, in steps of the standard set"]
    seconds: A[float, "wall time of a simulated second on the machine of the cost file, [s]"]
    within: A[bool, "whether these bounds are within the accuracy"]
    vibration_to: A[float, "highest third octave asked for, [Hz]; NaN where nothing is known"] = math.nan
    notes: A[tuple[str, ...], "where sensors and the modes of the box do not reach equally far"] = ()
    rate: A[float | None, "of all sensors and the force waveform, [Hz]; ``None``: as the scene has them"] = (
        None
    )
    rate_reason: str = ""
    kept: A[bool, "whether it was made before and kept, see `beardyn_core.choice.choice_cache`"] = False

    @property
    def judged(self) -> bool:
        """Whether there was an equilibrium by which to judge."""
        return not math.isnan(self.vibration_to)

    @property
    def real_time_factor(self) -> float:
        """Real-time factor to expect on the machine of the cost file."""
        return 1.0 / self.seconds

    @property
    def asked(self) -> str:
        """Write what was asked for."""
        means = [name for name in self.quantities if name != "vibration"]
        parts = [f"{', '.join(means)} within {100.0 * self.accuracy:.3g} %"] if means else []
        if "vibration" in self.quantities:
            to = f" to {1e-3 * self.vibration_to:.3g} kHz" if math.isfinite(self.vibration_to) else ""
            parts.append(f"vibration in third-octave bands{to} within {VIBRATION_TOLERANCE_DB:g} dB")
        return "; ".join(parts)

    @property
    def summary(self) -> str:
        """Write in a sentence what was asked for, what is expected, and what is left out."""
        off = ", ".join(each.effect for each in self.decisions if not each.on and each.left_out)
        left = f"; {_LEFT}{off}" if off else ""
        return f"{_CHOSEN}{self.asked}; {self.difference}{left}"

    @property
    def difference(self) -> str:
        """Write by how much the run may differ from the full model: bounds, not measured differences."""
        known = {name: error for name, error in self.expected.items() if not math.isnan(error)}
        unknown = ", ".join(name for name in self.expected if name not in known)
        bounds = ", ".join(f"{name} {error_text(name, error)}" for name, error in known.items())
        wide = [
            f"{name} {_write_largest_error(name, self.accuracy)}"
            for name, error in known.items()
            if error > tolerance(name, self.accuracy)
        ]
        parts = []
        if bounds:
            parts.append(f"{_BOUNDS}{bounds}")
        if unknown or not bounds:
            parts.append(f"{_UNKNOWN}{f' for {unknown}' if unknown else ''}")
        if wide:
            parts.append(f"{_WIDE}{', '.join(wide)}")
        return "; ".join(parts)

    @property
    def reasons(self) -> tuple[str, ...]:
        """List what the choice is for, and a reason for each part of it, in sentences."""
        return (
            self.summary,
            f"tier {self.tier}: {self.tier_reason}",
            f"laminae {self.laminae}: {self.laminae_reason}",
            f"steps_per_sample {self.steps_per_sample}: {self.steps_reason}",
            *([] if self.rate is None else [f"rate {1e-3 * self.rate:g} kHz: {self.rate_reason}"]),
            *(decision.sentence() for decision in self.decisions),
        )

    @property
    def phrase(self) -> str:
        """Write in a phrase how far the run may be from the full model, and what is left out."""
        return shorten_summary(self.summary)

    def applied(self, scene: Scene) -> Scene:
        """Apply this choice to a scene; bearing, load, faults, places of sensors and seed stay."""
        if self.rate is not None:
            scene = replace(scene, sensors=tuple(replace(each, rate=self.rate) for each in scene.sensors))
        kept = replace(scene.numerics, laminae=self.laminae, steps_per_sample=self.steps_per_sample)
        return replace(scene, tier=self.tier, effects=self.effects, numerics=kept, chosen=self.reasons)

    def to_json(self) -> dict[str, Any]:
        """Give the choice as a mapping for JSON; unknown errors and costs are NaN."""
        return {
            "tier": self.tier,
            "effects": self.effects.names(),
            "laminae": self.laminae,
            "steps_per_sample": self.steps_per_sample,
            "rate_Hz": self.rate,
            "accuracy": self.accuracy,
            "quantities": self.quantities,
            "vibration_to_Hz": self.vibration_to,
            "within_accuracy": self.within,
            "kept": self.kept,
            "expected_error": _errors(self.expected),
            "real_time_factor": self.real_time_factor,
            "step_cost": self.step_cost,
            "notes": self.notes,
            "reasons": {
                "tier": self.tier_reason,
                "laminae": self.laminae_reason,
                "steps_per_sample": self.steps_reason,
                "rate": self.rate_reason,
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


def shorten_summary(sentence: str) -> str:
    """Write in a phrase what a choice gives up: of its bounds those that are wider than what was asked for.

    Parameters
    ----------
    sentence : str
        `Choice.summary`, as recordings have it; another sentence, or an empty one, is given back.
    """
    parts = sentence.removeprefix(_CHOSEN).split("; ")
    bounds = _after(parts, _BOUNDS).split(", ")
    wide = {each.split()[0] for each in _after(parts, _WIDE).split(", ") if each}
    unknown = [part for part in parts if part.startswith(_UNKNOWN)]
    if not sentence.startswith(_CHOSEN) or not (any(bounds) or unknown):
        return sentence
    beyond = [each for each in bounds if each.partition(" ")[0] in wide]
    if beyond:
        found = [f"differs from the full model by at most {', '.join(beyond)}"]
    else:
        found = [] if unknown else [f"within {parts[0].rpartition('within ')[2]} of the full model"]
    left = [f"without {names}" for names in [_after(parts, _LEFT)] if names]
    return "; ".join([*found, *unknown, *left]).replace("roller_load", "roller load")


def _after(parts: list[str], beginning: str) -> str:
    """Find what follows a beginning in one of the parts of a sentence; empty where there is none."""
    return next((part.removeprefix(beginning) for part in parts if part.startswith(beginning)), "")


def _errors(errors: Mapping[str, float]) -> dict[str, dict[str, Any]]:
    return {
        name: {"error": error, "unit": "dB" if name == "vibration" else "share"}
        for name, error in errors.items()
    }


def error_text(quantity: str, error: float) -> str:
    """Write an error in words."""
    if math.isnan(error):
        return "unknown"
    return f"{error:.2g} dB" if quantity == "vibration" else percent(error)
