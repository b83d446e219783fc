"""The cheapest tier, effects and laminae of which the expected errors stay within the accuracy asked for.

Every rule gives alternatives with a cost and with an influence on each quantity against the reference; what is left
out adds up. Tier, laminae and alternatives are chosen together, by exact search, so that the choice can only
become more expensive when the accuracy asked for becomes tighter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from beardyn_core.choice import friction, guidance, motion, numerics, stiffness, tier
from beardyn_core.choice.costs import Costs, measured_costs
from beardyn_core.choice.evidence import Evidence
from beardyn_core.choice.free import Free
from beardyn_core.choice.rule import Alternative, Decision, Rule, percent, tolerance
from beardyn_core.effects import Audit, EffectSet
from beardyn_core.errors import ValidityError
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS

USUAL_ACCURACY = 0.05

RULES: tuple[Callable[[Evidence], Rule], ...] = (
    motion.contact_damping,
    stiffness.lamina_coupling,
    friction.traction,
    friction.rolling_resistance,
    friction.drag,
    guidance.rib,
    guidance.small_rib,
    guidance.cage,
    friction.seal,
    stiffness.ring_flexibility,
    motion.gravity,
    friction.thermal,
    motion.audit,
)


@dataclass(frozen=True)
class Choice:
    """What a scene is computed with, and why.

    Parameters
    ----------
    tier : str
    effects : EffectSet
    laminae, steps_per_sample : int
    accuracy : float
        Asked for, [-].
    quantities : tuple of str
        Asked for.
    tier_reason, laminae_reason, steps_reason : str
    decisions : tuple of Decision
        One for each effect, in the order of the catalogue.
    expected : mapping
        Expected error of each asked quantity: a fraction, of vibration in dB.
    step_cost : float
        Of a step, in steps of the standard set.
    seconds : float
        Wall time of a simulated second on the machine of the cost file, [s].
    within : bool
        Whether the expected errors are within the accuracy.
    """

    tier: str
    effects: EffectSet
    laminae: int
    steps_per_sample: int
    accuracy: float
    quantities: tuple[str, ...]
    tier_reason: str
    laminae_reason: str
    steps_reason: str
    decisions: tuple[Decision, ...]
    expected: Mapping[str, float]
    step_cost: float
    seconds: float
    within: bool

    @property
    def real_time_factor(self) -> float:
        """Expected on the machine of the cost file."""
        return 1.0 / self.seconds

    @property
    def reasons(self) -> tuple[str, ...]:
        """A sentence for each choice."""
        return (
            f"tier {self.tier}: {self.tier_reason}",
            f"laminae {self.laminae}: {self.laminae_reason}",
            f"steps_per_sample {self.steps_per_sample}: {self.steps_reason}",
            *(decision.sentence() for decision in self.decisions),
        )

    def applied(self, scene: Scene) -> Scene:
        """The scene with this choice; bearing, load, faults, sensors and seed stay."""
        kept = replace(scene.numerics, laminae=self.laminae, steps_per_sample=self.steps_per_sample)
        return replace(scene, tier=self.tier, effects=self.effects, numerics=kept, chosen=self.reasons)

    def to_json(self) -> dict[str, Any]:
        """JSON-able content; JSON has no NaN."""
        return {
            "tier": self.tier,
            "effects": list(self.effects.names()),
            "laminae": self.laminae,
            "steps_per_sample": self.steps_per_sample,
            "accuracy_percent": 100.0 * self.accuracy,
            "quantities": list(self.quantities),
            "within_accuracy": self.within,
            "expected_error": {name: _number(error) for name, error in self.expected.items()},
            "expected_rtf": self.real_time_factor,
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
                    "cost_share": _number(decision.cost_share),
                    "error": {name: _number(error) for name, error in decision.influence.items()},
                }
                for decision in self.decisions
            ],
        }


@dataclass(frozen=True)
class _Stage:
    """A tier with a lamina count: what it costs and leaves out before any effect is chosen."""

    tier: str
    laminae: int
    cost: float
    influence: tuple[float, ...]
    tier_reason: str
    laminae_reason: str


def choose(scene: Scene, free: Free | None = None, given: EffectSet | None = None) -> Choice:
    """Cheapest choice within the accuracy of a scene.

    Parameters
    ----------
    scene : Scene
        Its effects are those of the reference; `accuracy` and `quantities` say what is asked for.
    free : Free, optional
        What may be chosen, everything when not given; the rest is kept as the scene has it.
    given : EffectSet, optional
        The effects that are kept where they are not free; those of the reference when not given.

    Returns
    -------
    Choice
        Where nothing is within the accuracy, the one that comes nearest.
    """
    free = free or Free()
    given = given or scene.effects
    asked = scene.quantities
    accuracy = USUAL_ACCURACY if scene.accuracy is None else scene.accuracy
    try:
        evidence = Evidence(replace(scene, tier="full"))
    except ValidityError as error:
        return _unjudged(scene, free, given, accuracy, str(error))
    looked_at = tuple(name for name in asked if name != "vibration" or evidence.moves)
    limits = tuple(tolerance(name, accuracy) for name in looked_at)
    rules = [rule(evidence) for rule in RULES]
    best: tuple[tuple[float, ...], _Stage, list[Alternative]] | None = None
    for stage in _stages(evidence, scene, free, given, looked_at):
        offered = [_offered(rule, free, stage.tier, given) for rule in rules]
        if any(not alternatives for alternatives in offered):
            continue
        found = _cheapest(offered, stage, looked_at, limits, evidence.costs)
        # cost counts per simulated second; between equal costs the smaller error
        key = (found[0], found[1] * _rate(stage.tier, scene, free), found[2])
        if best is None or key < best[0]:
            best = (key, stage, found[3])
    assert best is not None  # the full tier offers the reference of every rule
    return _told(scene, evidence, free, best[1], best[2], rules, looked_at, accuracy)


def _rate(tier_name: str, scene: Scene, free: Free) -> float:
    return float(TIERS[tier_name].steps_per_sample if free.steps else scene.numerics.steps_per_sample)


def _stages(
    evidence: Evidence, scene: Scene, free: Free, given: EffectSet, asked: tuple[str, ...]
) -> list[_Stage]:
    found = []
    counts = numerics.LAMINAE if free.laminae else (scene.numerics.laminae,)
    names = tuple(TIERS) if free.tier else (scene.tier,)
    for name in names:
        if TIERS[name].needs_rib and given.rib is None:
            continue
        for count in counts:
            if count < TIERS[name].smallest_laminae:
                continue
            lamina = numerics.laminae(evidence, count)
            verdict = tier.verdict(evidence, name, count)
            if verdict is None:
                continue
            total = tuple(
                verdict.influence.get(quantity, 0.0) + lamina.influence.get(quantity, 0.0) for quantity in asked
            )
            cost = evidence.costs.base(name, count)
            found.append(_Stage(name, count, cost, total, verdict.reason, lamina.reason))
    return found


def _offered(rule: Rule, free: Free, tier_name: str, given: EffectSet) -> list[Alternative]:
    """Alternatives of a rule in a tier; what is written down stays, whether or not the tier represents it."""
    possible = [
        option for option in rule.alternatives if tier_name in option.tiers and _represented(option, tier_name)
    ]
    members = rule.alternatives[0].members
    if all(name in free.effects for name in members):
        return possible
    kept = {name: getattr(given, name) for name in members if name not in free.effects}
    agreeing = [
        option for option in possible if all(option.members[name] == value for name, value in kept.items())
    ]
    if agreeing:
        return [
            replace(option, reason=f"written down in the scene; {option.reason}") for option in agreeing
        ]
    # the tier goes without it, or it is an option that no rule offers
    nearest = possible[-1] if tier_name != "full" else rule.alternatives[0]
    missing = f"written down in the scene, not in the tier {tier_name}; {nearest.reason}"
    return [replace(nearest, members={**nearest.members, **kept}, reason=missing)]


def _represented(option: Alternative, tier_name: str) -> bool:
    represented = TIERS[tier_name].represented
    if represented is None:
        return True
    return all(name in represented for name, value in option.members.items() if value is not None)


def _cheapest(
    offered: list[list[Alternative]],
    stage: _Stage,
    asked: tuple[str, ...],
    limits: tuple[float, ...],
    costs: Costs,
) -> tuple[float, float, float, list[Alternative]]:
    """Best alternatives of one stage: by excess over the limits, cost of a step, error over limit.

    Depth first, with the least cost of the rules that are left as bound.
    """
    options = []
    for alternatives in offered:
        entries = []
        for option in alternatives:
            influence = tuple(option.influence.get(name, 0.0) for name in asked)
            cost = costs.scaled(next(iter(option.members)), option.cost, stage.laminae)
            # a tier with few states does not pay for an effect what the full one does
            entries.append((cost if stage.tier == "full" else min(cost, 0.001), influence, option))
        entries.sort(key=lambda entry: (entry[0], sum(entry[1])))
        options.append(entries)
    least_cost = _tails([min(entry[0] for entry in entries) for entries in options])
    least_error = [
        _tails([min(entry[1][index] for entry in entries) for entries in options]) for index in range(len(asked))
    ]
    best: list[tuple[float, float, float, list[Alternative]]] = []

    def excess(errors: tuple[float, ...]) -> float:
        return sum(
            max(error / limit - 1.0, 0.0) for error, limit in zip(errors, limits, strict=True) if error > limit
        )

    def descend(depth: int, cost: float, errors: tuple[float, ...], taken: list[Alternative]) -> None:
        if depth == len(options):
            relative = sum(error / limit for error, limit in zip(errors, limits, strict=True))
            key = (excess(errors), cost, relative)
            if not best or key < best[0][:3]:
                best[:] = [(*key, list(taken))]
            return
        bound = tuple(error + least_error[index][depth] for index, error in enumerate(errors))
        if best and (excess(bound), cost + least_cost[depth]) > best[0][:2]:
            return
        for more, influence, option in options[depth]:
            added = tuple(error + part for error, part in zip(errors, influence, strict=True))
            descend(depth + 1, cost + more, added, [*taken, option])

    descend(0, stage.cost, stage.influence, [])
    return best[0]


def _tails(values: list[float]) -> list[float]:
    """Sum of the values from each one on, and 0 behind the last."""
    sums = [0.0]
    for value in reversed(values):
        sums.append(sums[-1] + value)
    return sums[::-1]


def _told(
    scene: Scene,
    evidence: Evidence,
    free: Free,
    stage: _Stage,
    taken: list[Alternative],
    rules: list[Rule],
    asked: tuple[str, ...],
    accuracy: float,
) -> Choice:
    """The choice with its reasons, shares and expected errors."""
    members = {name: value for option in taken for name, value in option.members.items()}
    effects = replace(scene.effects, **members)
    if effects.thermal is not None:
        effects = replace(effects, audit=effects.audit or Audit())
    if free.steps:
        step = numerics.steps(evidence, effects, stage.tier, stage.laminae)
    else:
        step = numerics.StepVerdict(scene.numerics.steps_per_sample, "written down in the scene")
    costs = evidence.costs
    parts = [
        costs.scaled(rule.effect, option.cost, stage.laminae) if stage.tier == "full" else min(option.cost, 0.001)
        for rule, option in zip(rules, taken, strict=True)
    ]
    total = stage.cost + sum(parts)
    decisions = tuple(
        Decision(
            rule.effect,
            option.word,
            option.reason,
            any(value is not None for value in option.members.values()),
            part / total,
            {name: option.influence.get(name, 0.0) for name in asked},
        )
        for rule, option, part in zip(rules, taken, parts, strict=True)
    )
    errors = {
        name: stage.influence[index] + sum(decision.influence[name] for decision in decisions)
        for index, name in enumerate(asked)
    }
    if "vibration" in scene.quantities and "vibration" not in asked:
        errors["vibration"] = 0.0
    within = all(error <= tolerance(name, accuracy) + 1.0e-12 for name, error in errors.items())
    reason = stage.tier_reason if free.tier else f"written down in the scene; {stage.tier_reason}"
    if not evidence.moves and "vibration" in scene.quantities:
        reason += "; the cup is held, so there is no vibration of it to resolve"
    return Choice(
        tier=stage.tier,
        effects=effects,
        laminae=stage.laminae,
        steps_per_sample=step.steps_per_sample,
        accuracy=accuracy,
        quantities=scene.quantities,
        tier_reason=reason,
        laminae_reason=stage.laminae_reason if free.laminae else f"written down in the scene; {stage.laminae_reason}",
        steps_reason=step.reason,
        decisions=decisions,
        expected={name: errors[name] for name in scene.quantities},
        step_cost=total,
        seconds=costs.seconds(total, step.steps_per_sample),
        within=within,
    )


def _unjudged(scene: Scene, free: Free, given: EffectSet, accuracy: float, why: str) -> Choice:
    """Everything on, for want of an equilibrium to judge by."""
    name = "full" if free.tier else scene.tier
    usual = TIERS[name].steps_per_sample if free.steps else scene.numerics.steps_per_sample
    total = measured_costs().ratios["full"]
    effects = replace(
        given, **{member: getattr(scene.effects, member) for member in free.effects}
    )
    return Choice(
        tier=name,
        effects=effects,
        laminae=scene.numerics.laminae,
        steps_per_sample=usual,
        accuracy=accuracy,
        quantities=scene.quantities,
        tier_reason=f"{why}, so nothing is left out",
        laminae_reason="nothing is left out",
        steps_reason="nothing is left out",
        decisions=tuple(
            Decision(effect, "on", why, True, math.nan, {}) for effect in effects.names()
        ),
        expected={name: math.nan for name in scene.quantities},
        step_cost=total,
        seconds=measured_costs().seconds(total, usual),
        within=False,
    )


def _number(value: float) -> float | None:
    return value if math.isfinite(value) else None


def error_text(quantity: str, error: float) -> str:
    """Expected error in words."""
    if math.isnan(error):
        return "unknown"
    return f"{error:.2g} dB" if quantity == "vibration" else percent(error)
