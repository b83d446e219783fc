"""What tiers, effects and laminae cost in the time step, from the shipped measurement."""

from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated as A
from typing import Any

import numpy as np

from beardyn_core.effects.catalogue import catalogue
from beardyn_core.physics.bodies.rates import WAVEFORM_RATE

COST_FILE = Path(__file__).with_name("costs.json")

# An effect that is there costs something, whatever the scatter of the measurement says.
_LEAST_SHARE = 0.001
_START_SHARE = 1.0e-5
_REFERENCE_LAMINAE = 6
_BLOCK_SAMPLES = 512
# middle of each cost class of the catalogue
_CLASS_SHARES = {"none": 0.001, "low": 0.015, "medium": 0.09, "high": 0.2}
# modes of a box, and the share of a step with all 99 modes of `high_speed`: docs/evidence/structure.md
_MODES, _MODES_SHARE = (0.0, 16.0, 50.0, 99.0), (0.0, 0.39, 0.76, 1.0)
# of what bending adds to a step of the full tier, in a fast one; the rest a tier with few states has for
# nothing: table in docs/tiers.md
_FAST_BENDING, _FAST_REST = 0.25, 0.001
# what rollers that move in their pockets add to a step of tier quasistatic: docs/tiers.md
_LOOSE_SHARE = 0.15
# what coupled laminae add to one: `python benchmarks/effect_costs.py --only quasistatic`
_COUPLED_SHARE = 0.44
# share of that, with 6 laminae, which grows with the square of their count, for each bears on every other: 40
# add 18 times as much in full, 19 in quasistatic:
# `python benchmarks/effect_costs.py --only coupl "laminae 40" quasistatic`
_COUPLED_SQUARES = 0.3
# what rollers that creep along the cup add to one: `python benchmarks/effect_costs.py --only quasistatic`
_CREEP_SHARE = 0.05
# effects computed for every lamina: their cost grows with the count
_PER_LAMINA = frozenset({"traction"})


@dataclass(frozen=True)
class Costs:
    """Costs relative to the step of the `standard` set in the full tier with 6 laminae."""

    ratios: A[
        dict[str, float],
        "name of a measured set (`benchmarks/effect_costs.py`) -> its time over that of the standard step",
    ]
    standard_step: A[float, "time of the standard step on the machine of the measurement, [s]"]
    rest_of_block: A[dict[str, float], "tier -> time of a block of 512 samples outside of its steps, [s]"]
    machine: A[str, "where it was measured"]
    date: A[str, "when"]

    def extra(self, change: str) -> float:
        """Look up the cost that a change adds to the standard step, always more than 0.

        A change that has not been measured costs what the class of its effect in the catalogue says.
        """
        measured = self.ratios.get(f"+ {change}")
        if measured is None:
            return _CLASS_SHARES[_class_of(change.split()[0])]
        return max(measured - 1.0, _LEAST_SHARE)

    def saved(self, effect: str) -> float:
        """Look up the cost that an effect of the standard set adds to a step."""
        measured = self.ratios.get(f"- {effect}")
        if measured is None:
            return _CLASS_SHARES[_class_of(effect)]
        return max(1.0 - measured, _LEAST_SHARE)

    def instead(self, effect: str, change: str) -> float:
        """Look up the cost of an effect of the standard set when it is of another kind."""
        measured = self.ratios.get(f"+ {change}")
        if measured is None:
            return 0.5 * self.saved(effect)
        return max(measured - 1.0 + self.saved(effect), _LEAST_SHARE)

    @property
    def of_loose_rollers(self) -> float:
        """Work out the cost that rollers which move in their pockets add in the quasistatic tier."""
        return _LOOSE_SHARE * self.ratios["tier quasistatic"]

    def of_modes(self, count: int) -> float:
        """Work out the cost that so many modes of a box add to the standard step."""
        share = count / _MODES[-1] if count > _MODES[-1] else float(np.interp(count, _MODES, _MODES_SHARE))
        return share * self.extra("structure modes")

    def base(self, tier: str, laminae: int) -> float:
        """Compute the cost of a tier's step without the effects that a choice can add."""
        if tier == "lumped":
            # the spring is fitted once; the count matters to nothing but the start
            return self.ratios["tier lumped"] + _START_SHARE * laminae
        more = laminae - _REFERENCE_LAMINAE
        if tier == "quasistatic":
            six, twenty = self.ratios["tier quasistatic"], self.ratios["tier quasistatic, laminae 20"]
            return six + max(twenty - six, 0.0) / 14.0 * more
        saved = sum(self.saved(name) for name in ("traction", "cage", "rib", "contact_damping", "gravity"))
        saved += self.saved("audit")
        # what every lamina costs without traction and film
        share = 1.0 - self.saved("traction")
        slope = max(self.ratios["laminae 20"] - self.ratios["laminae 2"], 0.0) / 18.0 * share
        return max(1.0 - saved, 0.1) + slope * more

    def scaled(self, effect: str, share: float, tier: str, laminae: int) -> float:
        """Scale the cost of an effect, measured in the full tier at 6 laminae, to another tier and count."""
        if effect == "lamina_coupling" and share > 0.0 and tier != "lumped":
            of_six = share if tier == "full" else _COUPLED_SHARE * self.ratios["tier quasistatic"]
            more = laminae / _REFERENCE_LAMINAE
            return of_six * ((1.0 - _COUPLED_SQUARES) * more + _COUPLED_SQUARES * more**2)
        if tier == "quasistatic" and effect == "traction" and share > 0.0:
            return _CREEP_SHARE * self.ratios["tier quasistatic"]
        if tier != "full":
            return _FAST_BENDING * share if effect == "structure" else min(share, _FAST_REST)
        return share * laminae / _REFERENCE_LAMINAE if effect in _PER_LAMINA else share

    def seconds(self, step: float, steps_per_sample: float, tier: str) -> float:
        """Compute the wall time of a simulated second on that machine, from the relative cost of a step."""
        steps = step * self.standard_step * steps_per_sample
        return WAVEFORM_RATE * (steps + self.rest_of_block[tier] / _BLOCK_SAMPLES)

    def unmeasured(self, effect: str) -> str | None:
        """Find the cost class of an effect that has not been measured; ``None`` when it has."""
        known = any(name.split(" ", 1)[1].split()[0] == effect for name in self.ratios if name[0] in "+-")
        return None if known else _class_of(effect)


def _class_of(effect: str) -> str:
    """Find the cost class of an effect, the lowest of its kinds."""
    order = tuple(_CLASS_SHARES)
    found = [entry.about.cost for entry in catalogue() if entry.member == effect]
    return min(found, key=order.index, default="low")


@cache
def measured_costs() -> Costs:
    """Read the shipped measurement of costs."""
    content: dict[str, Any] = json.loads(COST_FILE.read_text(encoding="utf-8"))
    return Costs(
        ratios=content["ratios"],
        standard_step=1e-6 * content["standard_us_per_step"],
        rest_of_block={tier: 1e-6 * rest for tier, rest in content["rest_us_per_block"].items()},
        machine=content["machine"],
        date=content["date"],
    )
