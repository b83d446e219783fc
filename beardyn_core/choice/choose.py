"""The cheapest tier, effects and laminae of which the expected errors stay within the accuracy asked for.

Every rule gives alternatives with a cost and with an influence on each quantity against the reference; what
is left out adds up. Tier, laminae and alternatives are chosen together, by exact search, so that the choice
can only become more expensive when the accuracy asked for becomes tighter.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields, is_dataclass, replace
from itertools import product
from typing import Any

from beardyn_core.base.errors import ValidityError
from beardyn_core.base.one_thread import in_one_thread
from beardyn_core.bearing.spherical import FEWEST_OF_ELLIPSE
from beardyn_core.choice import bending, discretisation_error, friction, gravity_damping_rules, guidance
from beardyn_core.choice.costs import Costs, measured_costs
from beardyn_core.choice.reference_solution import Evidence
from beardyn_core.choice.rule import Alternative, Choice, Decision, Rule, tolerance
from beardyn_core.choice.sampling import rate_for
from beardyn_core.effects import Audit, EffectSet
from beardyn_core.physics.tiers.friction_steps import StepChoice
from beardyn_core.scene.scene import QUANTITIES, Free, Scene
from beardyn_core.scene.sensor import RATES
from beardyn_core.scene.tier import TIERS

USUAL_ACCURACY = 0.05
_DECIDING = 2  # so many first rules decide the step: friction, and what damps the bounce of rollers
_BESIDES = 1.0  # of a limit, compared with an error beyond it that a tier has whatever is chosen in it
_OF_STEP = ("traction", "film", "contact_damping", "structure")

RULES: tuple[Callable[[Evidence], Rule], ...] = (
    friction.traction,
    gravity_damping_rules.contact_damping,
    gravity_damping_rules.lamina_coupling,
    friction.rolling_resistance,
    friction.drag,
    guidance.rib,
    guidance.small_rib,
    guidance.cage,
    friction.seal,
    *friction.cage_drag_rules(),
    bending.structure,
    gravity_damping_rules.gravity,
    friction.thermal,
    gravity_damping_rules.audit,
)


@dataclass(frozen=True)
class Stage:
    """A tier with a lamina count: its cost and its errors before any effect is chosen."""

    tier: str
    laminae: int
    cost: float
    influence: tuple[float, ...]
    tier_reason: str
    laminae_reason: str


@in_one_thread
def choose(scene: Scene, free: Free | None = None, given: EffectSet | None = None) -> Choice:
    """Choose the cheapest tier, effects, laminae and step within the accuracy of a scene.

    Where nothing is within the accuracy, the one that comes nearest; in a tier that the scene names, the
    cheapest that misses by hardly more than the tier does anyway.

    Parameters
    ----------
    scene : Scene
        Its effects are those of the reference; `accuracy` and `quantities` say what is asked for.
    free : Free, optional
        What may be chosen, everything when left out; the rest is kept as the scene has it.
    given : EffectSet, optional
        The effects that are kept where they are not free; those of the reference when left out.
    """
    free = free or Free()
    given = given or scene.effects
    asked = scene.quantities
    accuracy = USUAL_ACCURACY if scene.accuracy is None else scene.accuracy
    try:
        evidence = Evidence(replace(scene, tier="full"))
    except ValidityError as error:
        return _choose_all(scene, free, given, accuracy, str(error))
    looked_at = tuple(name for name in asked if name != "vibration" or evidence.moves)
    limits = tuple(tolerance(name, accuracy) for name in looked_at)
    rules = [rule(evidence) for rule in RULES]
    best: tuple[tuple[float, ...], Stage, list[Alternative]] | None = None
    clock = _Clock(evidence, free, "vibration" in looked_at)
    for name in reversed(TIERS) if free.tier else (scene.tier,):
        offered = [_list_alternatives(rule, free, name, given) for rule in rules]
        if any(not alternatives for alternatives in offered):
            continue
        least = _least_errors(evidence, name, offered, looked_at)
        beyond = any(error > limit for error, limit in zip(least, limits, strict=True))
        if best is not None and best[0][0] == 0.0 and beyond:
            continue
        # no fineness is bought for what a tier that the scene names misses anyway
        allowed = limits if free.tier else tuple(map(_widen_limit, limits, least))
        for count in _counts(scene, free, given, name):
            steps = [
                (deciding, clock.step(scene, name, count, deciding))
                for deciding in product(*offered[:_DECIDING])
            ]
            if best is not None and best[0][0] == 0.0:
                cheapest = _least_cost(evidence.costs, offered, name, count)
                fewest = min(step.steps_per_sample for _, step in steps)
                if evidence.costs.seconds(cheapest, fewest, name) > best[0][1]:
                    continue  # its errors need not be known
            stage = _stage(evidence, name, count, looked_at)
            if stage is None:
                continue
            for deciding, step in steps:
                fixed = [[option] for option in deciding]
                found = _cheapest([*fixed, *offered[_DECIDING:]], stage, looked_at, allowed, evidence.costs)
                # cost counts per simulated second; between equal costs the smaller error
                seconds = evidence.costs.seconds(found[1], step.steps_per_sample, stage.tier)
                key = (found[0], seconds, found[2])
                if best is None or key < best[0]:
                    best = (key, stage, found[3])
    assert best is not None  # the full tier offers the reference of every rule
    _, stage, taken = best
    step = clock.step(scene, stage.tier, stage.laminae, taken)
    return _choice_of(scene, evidence, free, stage, taken, step, rules, looked_at, accuracy)


class _Clock:
    """Time step for each tier, lamina count, law of friction and damping."""

    def __init__(self, evidence: Evidence, free: Free, vibration: bool) -> None:
        self._evidence, self._free, self._vibration = evidence, free, vibration
        self._known: dict[tuple[str, int, EffectSet], StepChoice] = {}

    def step(self, scene: Scene, tier_name: str, laminae: int, deciding: Iterable[Alternative]) -> StepChoice:
        """Find the time step and what decides it; the scene's own where it is not free.

        What is not among the decided alternatives is taken as in the reference.
        """
        if not self._free.steps:
            return StepChoice(scene.numerics.steps_per_sample, "as the scene has it")
        members = {name: value for option in deciding for name, value in option.members.items()}
        decided = {**{name: getattr(scene.effects, name) for name in _OF_STEP}, **members}
        effects = replace(scene.effects, **{name: decided[name] for name in _OF_STEP}, lamina_coupling=None)
        key = (tier_name, laminae, effects)
        if key not in self._known:
            self._known[key] = discretisation_error.steps(
                self._evidence, effects, tier_name, laminae, self._vibration
            )
        return self._known[key]


def _widen_limit(limit: float, least: float) -> float:
    """Widen a limit that cannot be kept to what can be."""
    return limit if least <= limit else least + _BESIDES * limit


def _least_errors(
    evidence: Evidence, name: str, offered: list[list[Alternative]], asked: tuple[str, ...]
) -> tuple[float, ...]:
    """Add up the errors that a tier has at least, whatever its laminae and springs are."""
    of_tier = discretisation_error.least_errors(evidence, name)
    return tuple(
        of_tier.get(quantity, 0.0)
        + sum(min(option.influence.get(quantity, 0.0) for option in options) for options in offered)
        for quantity in asked
    )


def _counts(scene: Scene, free: Free, given: EffectSet, name: str) -> list[int]:
    """List the lamina counts that a tier can take for a scene."""
    limits = TIERS[name]
    barrels = scene.bearing.self_aligning  # held by their raceways, with ellipses of so many slices
    if limits.needs_rib and given.rib is None and not barrels:
        return []
    fewest = max(limits.smallest_laminae, FEWEST_OF_ELLIPSE if barrels else 1)
    counts = discretisation_error.LAMINAE if free.laminae else (scene.numerics.laminae,)
    return [count for count in counts if count >= fewest]


def _least_cost(costs: Costs, offered: list[list[Alternative]], name: str, count: int) -> float:
    """Work out what a step costs at least, a rounding less."""
    added = (
        min(costs.scaled(next(iter(option.members)), option.cost, name, count) for option in alternatives)
        for alternatives in offered
    )
    return (costs.base(name, count) + sum(added)) * (1.0 - 1.0e-9)


def _stage(evidence: Evidence, name: str, count: int, asked: tuple[str, ...]) -> Stage | None:
    """Judge a tier with a lamina count before any effect; ``None`` where no spring fits."""
    lamina = discretisation_error.laminae(evidence, count, name)
    verdict = discretisation_error.tier(evidence, name, count)
    if verdict is None:
        return None
    total = tuple(
        verdict.influence.get(quantity, 0.0) + lamina.influence.get(quantity, 0.0) for quantity in asked
    )
    return Stage(name, count, evidence.costs.base(name, count), total, verdict.reason, lamina.reason)


def _list_alternatives(rule: Rule, free: Free, tier_name: str, given: EffectSet) -> list[Alternative]:
    """List the alternatives of a rule in a tier; an effect that the scene fixes is the only one."""
    possible = [
        option
        for option in rule.alternatives
        if tier_name in option.tiers and _is_represented(option, tier_name)
    ]
    members = rule.alternatives[0].members
    if all(name in free.effects for name in members):
        return possible
    kept = {name: getattr(given, name) for name in members if name not in free.effects}
    agreeing = [
        option for option in possible if all(option.members[name] == value for name, value in kept.items())
    ]
    if agreeing:
        return [replace(option, reason=f"as the scene has it; {option.reason}") for option in agreeing]
    if tier_name != "full":
        nearest = (possible or rule.alternatives)[-1]
        reason = f"as the scene has it, not in the tier {tier_name}; {nearest.reason}"
        return [replace(nearest, members={**nearest.members, **kept}, reason=reason)]
    return [_make_unoffered(rule, kept)]


def _make_unoffered(rule: Rule, kept: dict[str, Any]) -> Alternative:
    """Make the alternative of options that no rule offers, judged like the most similar one offered."""

    def likeness(option: Alternative) -> int:
        return sum(_likeness(option.members[name], value) for name, value in kept.items())

    if all(value is None for value in kept.values()):
        return Alternative(
            {**rule.alternatives[0].members, **kept},
            "as the scene has it; no rule judges the bearing without it",
            dict.fromkeys(QUANTITIES, math.nan),
            word="off",
        )
    nearest = max(reversed(rule.alternatives), key=likeness)
    reason = f"as the scene has it, judged like {nearest.word!r}; {nearest.reason}"
    return replace(nearest, members={**nearest.members, **kept}, reason=reason, word="on")


def _likeness(one: Any, other: Any) -> int:
    """Count what two effects have of the same kind: themselves, and their options."""
    if type(one) is not type(other):
        return 0
    options = fields(one) if is_dataclass(one) else ()
    return 1 + sum(type(getattr(one, each.name)) is type(getattr(other, each.name)) for each in options)


def _is_represented(option: Alternative, tier_name: str) -> bool:
    represented = TIERS[tier_name].represented
    present = (name for name, value in option.members.items() if value is not None)
    return represented is None or all(name in represented for name in present)


def _choice_of(
    scene: Scene,
    evidence: Evidence,
    free: Free,
    stage: Stage,
    taken: list[Alternative],
    step: StepChoice,
    rules: list[Rule],
    asked: tuple[str, ...],
    accuracy: float,
) -> Choice:
    """Put together the choice with its reasons, cost and expected errors."""
    members = {name: value for option in taken for name, value in option.members.items()}
    effects = replace(scene.effects, **members)
    if effects.thermal is not None and stage.tier == "full":
        effects = replace(effects, audit=effects.audit or Audit())
    costs = evidence.costs
    parts = [
        costs.scaled(rule.effect, option.cost, stage.tier, stage.laminae)
        for rule, option in zip(rules, taken, strict=True)
    ]
    total = stage.cost + sum(parts)
    decisions = tuple(
        Decision(
            rule.effect,
            option.word,
            option.reason,
            next(iter(option.members.values())) is not None,  # a film may stay without traction
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
    reason = stage.tier_reason if free.tier else f"as the scene has it; {stage.tier_reason}"
    sampling = rate_for(scene, free)
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
        laminae_reason=stage.laminae_reason
        if free.laminae
        else f"as the scene has it; {stage.laminae_reason}",
        steps_reason=step.reason,
        decisions=decisions,
        expected={name: errors[name] for name in scene.quantities},
        step_cost=total,
        seconds=costs.seconds(total, step.steps_per_sample, stage.tier),
        within=within,
        vibration_to=evidence.band,
        notes=()
        if sampling is not None and sampling.rate < RATES[0]
        else tuple(bending.rates_told(evidence)),
        rate=None if sampling is None else sampling.rate,
        rate_reason="" if sampling is None else sampling.reason,
    )


def _choose_all(scene: Scene, free: Free, given: EffectSet, accuracy: float, why: str) -> Choice:
    """Choose every effect where no equilibrium exists by which to judge them."""
    name = "full" if free.tier else scene.tier
    usual = scene.numerics.steps_per_sample
    if free.steps:
        usual = discretisation_error.refine_for_outputs(
            StepChoice(TIERS[name].steps_per_sample, ""), scene
        ).steps_per_sample
    total = measured_costs().ratios["full"]
    effects = replace(given, **{member: getattr(scene.effects, member) for member in free.effects})
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
        decisions=tuple(Decision(effect, "on", why, True, math.nan, {}) for effect in effects.names()),
        expected=dict.fromkeys(scene.quantities, math.nan),
        step_cost=total,
        seconds=measured_costs().seconds(total, usual, name),
        within=False,
    )


def _cheapest(
    offered: list[list[Alternative]],
    stage: Stage,
    asked: tuple[str, ...],
    limits: tuple[float, ...],
    costs: Costs,
) -> tuple[float, float, float, list[Alternative]]:
    """Find the best alternatives of a stage: by excess over the limits, cost of a step, error over limit.

    Depth first, with the least cost of the rules that are left as bound.
    """
    options = []
    for alternatives in offered:
        entries = []
        for option in alternatives:
            influence = tuple(option.influence.get(name, 0.0) for name in asked)
            cost = costs.scaled(next(iter(option.members)), option.cost, stage.tier, stage.laminae)
            entries.append((cost, influence, option))
        entries.sort(key=lambda entry: (entry[0], sum(entry[1])))
        options.append(entries)
    least_cost = _tails([min(entry[0] for entry in entries) for entries in options])
    least_error = [
        _tails([min(entry[1][index] for entry in entries) for entries in options])
        for index in range(len(asked))
    ]
    best: list[tuple[float, float, float, list[Alternative]]] = []

    def excess(errors: tuple[float, ...]) -> float:
        return sum(
            max(error / limit - 1.0, 0.0)
            for error, limit in zip(errors, limits, strict=True)
            if error > limit
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
    """Sum the values from each one to the last, with 0 behind the last."""
    sums = [0.0]
    for value in reversed(values):
        sums.append(sums[-1] + value)
    return sums[::-1]
