"""Exact search: the cheapest alternatives of which the summed influences stay within the limits."""

from __future__ import annotations

from dataclasses import dataclass

from beardyn_core.choice.costs import Costs
from beardyn_core.choice.rule import Alternative


@dataclass(frozen=True)
class Stage:
    """A tier with a lamina count: its cost and its errors before any effect is chosen."""

    tier: str
    laminae: int
    cost: float
    influence: tuple[float, ...]
    tier_reason: str
    laminae_reason: str


def cheapest(
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
            cost = costs.scaled(next(iter(option.members)), option.cost, stage.laminae)
            # a tier with few states does not pay for an effect what the full one does
            entries.append((cost if stage.tier == "full" else min(cost, 0.001), influence, option))
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
