"""Errors of a tier that has fewer states than the full one."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated as A

from beardyn_core.bearing.contact_law import line_contact_factor
from beardyn_core.choice.evidence import Evidence, decibels
from beardyn_core.choice.losses import raceway_speed
from beardyn_core.choice.rule import Influence, percent

# The flat band of the accelerometer.
_HIGHEST_FREQUENCY = 10.0e3
# One Newton step of the rollers in a time step, and the neglected turn of the normals: see test/tiers.
_QUASISTATIC_SHARE = 0.005


@dataclass(frozen=True)
class TierVerdict:
    """Errors of a scene in a tier, and the reason for them."""

    name: str
    reason: str
    influence: A[Influence, "quantity -> what it makes wrong besides the effects it does not have"]


def verdict(evidence: Evidence, name: str, laminae: int) -> TierVerdict | None:
    """Judge the errors of a tier; ``None`` where it cannot run the scene."""
    if name == "lumped":
        return lumped(evidence, laminae)
    return quasistatic(evidence) if name == "quasistatic" else full(evidence)


def full(_evidence: Evidence) -> TierVerdict:
    """Judge the full tier, the reference, in which every body has its own motion."""
    return TierVerdict("full", "every body has its own equations of motion", {})


def quasistatic(evidence: Evidence) -> TierVerdict:
    """Judge the quasi-static tier: its rollers have no inertia."""
    influence, reason = _without_roller_inertia(evidence)
    return TierVerdict("quasistatic", reason, {"deflection": _QUASISTATIC_SHARE, **influence})


def lumped(evidence: Evidence, laminae: int) -> TierVerdict | None:
    """Judge the lumped tier against the exact equilibrium; ``None`` where no roller spring fits."""
    influence, reason = _without_roller_inertia(evidence)
    deflection = roller_load = 0.0
    for case in evidence.loads.cases:
        spring, exact = evidence.statics.lumped(case, laminae), evidence.statics.at(case)
        if exact is None:
            continue
        if spring is None:
            return None
        straight = float((exact.displacement @ exact.displacement) ** 0.5)
        deflection = max(deflection, abs(spring[0] / max(straight, 1.0e-9) - 1.0))
        roller_load = max(roller_load, abs(spring[1] / max(exact.largest_roller_load, 1.0e-3) - 1.0))
    reason = (
        f"one spring a roller misses the deflection by {percent(deflection)} and the largest roller load by "
        f"{percent(roller_load)}; {reason}"
    )
    influence = dict(influence)
    influence["deflection"] = deflection
    influence["roller_load"] = influence["roller_load"] + roller_load
    return TierVerdict("lumped", reason, influence)


def _without_roller_inertia(evidence: Evidence) -> tuple[dict[str, float], str]:
    bounce = roller_bounce(evidence)
    # response of a mass on springs over that of the springs alone, at the end of the band
    ratio = 1.0 / abs(1.0 - min((_HIGHEST_FREQUENCY / bounce) ** 2, 0.999))
    reason = f"its rollers have no inertia, a roller bounces at {bounce / 1e3:.3g} kHz"
    influence = {"vibration": decibels(ratio), "roller_load": _QUASISTATIC_SHARE}
    if evidence.patches:
        overshoot = fault_overshoot(evidence, bounce)
        reason += f" and overshoots by {percent(overshoot)} behind a fault"
        influence["roller_load"] += overshoot
    return influence, reason


def roller_bounce(evidence: Evidence) -> float:
    """Compute the frequency at which a roller with the mean load bounces between the raceways, [Hz]."""
    bearing = evidence.scene.bearing
    pressed = evidence.typical.cone_load[evidence.typical.cone_load > 0.0]
    load = float(pressed.mean()) if pressed.size else 1.0
    factor = line_contact_factor(bearing.material, bearing.effective_length)
    # Q = K d^(10/9): tangent (10/9) K^(9/10) Q^(1/10), of both raceways together
    tangent = 10.0 / 9.0 * factor**0.9 * load**0.1
    return math.sqrt(2.0 * tangent / bearing.roller_mass) / (2.0 * math.pi)


def fault_overshoot(evidence: Evidence, bounce: float) -> float:
    """Compute the overshoot of a roller that leaves the steepest edge of a patch, [-].

    The edge lasts a time e/v; a spring-mass answers to a ramp of that duration with at most 1/(pi f e/v).
    """
    speed = raceway_speed(evidence.scene, evidence.loads.top_speed)
    radius = 0.5 * evidence.scene.bearing.roller_diameter
    edges = [
        min(0.5 * patch.width, math.sqrt(2.0 * radius * max(patch.depth, 1.0e-9)))
        for patch in evidence.patches
    ]
    if speed == 0.0:
        return 0.0
    return min(1.0 / (math.pi * bounce * min(edges) / speed), 1.0)
