"""Lamina count and time step."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import Any

from beardyn_core.choice.evidence import MOST_DB, Evidence, decibels
from beardyn_core.choice.rule import Influence, percent
from beardyn_core.effects import EffectSet
from beardyn_core.scene.defect import Patch
from beardyn_core.scene.tier import TIERS

LAMINAE = (2, 4, 6, 8, 12, 20, 40)
_REFERENCE_LAMINAE = 40
# Width of a third-octave band over its centre.
_BAND = 0.2316


@dataclass(frozen=True)
class LaminaVerdict:
    """What a lamina count makes of a scene.

    Parameters
    ----------
    count : int
    reason : str
    influence : mapping
    """

    count: int
    reason: str
    influence: Influence


def laminae(evidence: Evidence, count: int) -> LaminaVerdict:
    """Convergence of the static load distribution, of the tilt spring, and of what patches take away."""
    change = evidence.difference({"laminae": count}, {"laminae": _REFERENCE_LAMINAE}, heavy=True)
    # n springs at the laminae's middles have (1 - 1/n^2) of the line's tilt stiffness
    tilt = max(1.0 / count**2 - 1.0 / _REFERENCE_LAMINAE**2, 0.0)
    # a mode that moves by half of that takes its level out of its band by as much
    shift = decibels(1.0 + 0.5 * tilt / _BAND)
    influence = {**change.influence(), "vibration": shift + decibels(change.stiffness)}
    said = f"{percent(change.deflection)} of the deflection and {percent(tilt)} of the tilt stiffness are left out"
    partial = [patch for patch in evidence.patches if patch.length < evidence.scene.bearing.effective_length]
    if partial:
        lever = max(lever_error(patch, evidence.scene.bearing.effective_length, count) for patch in partial)
        influence["vibration"] += decibels(1.0 + lever)
        influence["roller_load"] += 0.5 * lever * max(
            min(patch.length / evidence.scene.bearing.effective_length, 1.0) for patch in partial
        )
        said += f"; a patch of {1e3 * min(patch.length for patch in partial):.3g} mm tilts its roller {percent(lever)} wrong"
    influence["vibration"] = min(influence["vibration"], MOST_DB)
    return LaminaVerdict(count, said, influence)


def lever_error(patch: Patch, length: float, count: int) -> float:
    """By how much the laminae misplace what a patch takes from a roller, over a quarter of its length, [-].

    The covered share of a lamina acts at the lamina's middle.
    """
    step = length / count
    low = max(patch.offset - 0.5 * patch.length, -0.5 * length)
    high = min(patch.offset + 0.5 * patch.length, 0.5 * length)
    if high <= low:
        return 0.0
    moment = covered = 0.0
    for index in range(count):
        left = -0.5 * length + index * step
        share = max(min(high, left + step) - max(low, left), 0.0)
        covered += share
        moment += share * (left + 0.5 * step)
    return abs(moment / covered - 0.5 * (low + high)) / (0.25 * length)


@dataclass(frozen=True)
class StepVerdict:
    """Time step of a tier."""

    steps_per_sample: int
    reason: str


def steps(evidence: Evidence, effects: EffectSet, tier: str, count: int) -> StepVerdict:
    """Coarsest step that is converged: by the current stiffness where that is known, else the tier's own."""
    try:
        chooser: Any = importlib.import_module("beardyn_core.integrate.step_choice").choose_steps
    except ImportError:
        usual = TIERS[tier].steps_per_sample
        return StepVerdict(usual, f"the step of the tier, 1/{25600 * usual} s")
    loads = evidence.loads
    sizes = [case.size for case in loads.cases]
    found = chooser(
        evidence.scene.bearing,
        (min(sizes), max(sizes)),
        (abs(loads.typical.speed), loads.top_speed),
        effects,
        tier,
        count,
    )
    return StepVerdict(found.steps_per_sample, found.reason)
