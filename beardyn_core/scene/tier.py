"""Tiers: how many states a run has, what each can represent of a scene's effects, how it takes its steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated as A


@dataclass(frozen=True)
class TierLimits:
    """Abilities and limits of a tier."""

    name: str
    states: A[str, "what moves by its own equations of motion"]
    represented: A[frozenset[str] | None, "effects it computes or reports; ``None``: all of them"]
    steps_per_sample: A[
        int, "time steps per waveform sample when the scene gives none; `choice.fast_step` may take fewer"
    ]
    needs_rib: A[bool, "whether nothing but the rib holds the rollers axially"]
    smallest_laminae: A[int, "fewest laminae it can work with"]
    absent: A[tuple[str, ...], "channels of a block that it leaves at zero or without content"]
    blocks_at_once: A[
        int, "blocks of 20 ms that are worth computing in one go where nobody waits for each"
    ] = 1
    long_steps: A[
        tuple[float, ...], "steps per sample that it may take where a step is longer than a sample"
    ] = ()
    long_ring_steps: A[
        tuple[float, ...],
        "the same where the cup bends as two rings: longer ones end in no number, modes of a box get lost",
    ] = ()


_FAST = frozenset(
    {
        *("contact_damping", "traction", "film", "rib", "rolling_resistance", "drag", "seal", "gravity"),
        *("faults", "waviness", "scatter", "structure", "cage", "thermal"),
    }
)
_FAST_ABSENT = ("raceway slip", "pocket contacts", "energy audit", "chatter")

TIERS = {
    tier.name: tier
    for tier in (
        TierLimits(
            "lumped",
            "axlebox with cup, journal with cones; each roller a massless spring",
            _FAST,
            1,
            needs_rib=True,
            smallest_laminae=1,
            absent=(*_FAST_ABSENT, "slip of cages", "roller displacement and tilt"),
            blocks_at_once=32,
            long_steps=(0.25, 0.5),
            long_ring_steps=(0.5,),
        ),
        TierLimits(
            "quasistatic",
            "axlebox with cup, journal with cones, every roller but its skew and spin, cages in their plane",
            _FAST | {"lamina_coupling"},
            1,  # third-octave bands to 8 kHz within 0.9 dB of 8 steps, fault lines and loads within 2 %
            needs_rib=True,
            smallest_laminae=2,
            absent=_FAST_ABSENT,
            blocks_at_once=16,
        ),
        TierLimits("full", "every body with 6 degrees of freedom", None, 4, False, 2, ()),
    )
}
TIER_NAMES = tuple(TIERS)
# Time steps per waveform sample that a scene may ask for; 391 explicit ones are 0.1 us each.
LARGEST_STEPS = {"implicit": 64, "explicit": 512}
LONG_STEPS = tuple(sorted({steps for tier in TIERS.values() for steps in tier.long_steps}))


def missing_effects(tier: str, effects: tuple[str, ...]) -> tuple[str, ...]:
    """Find the effects among `effects` that a tier does not represent, in the same order."""
    represented = TIERS[tier].represented
    return () if represented is None else tuple(name for name in effects if name not in represented)


def long_steps(tier: str, bends: str) -> tuple[float, ...]:
    """List the steps longer than a sample that a tier may take with a kind of structure, or none."""
    limits = TIERS[tier]
    return {"": limits.long_steps, "rings": limits.long_ring_steps}.get(bends, ())


def contradictions(
    tier: str,
    has_rib: bool,
    laminae: int,
    steps_per_sample: float = 1,
    bends: str = "",
    unaudited_heat: bool = False,
) -> list[str]:
    """List the reasons why a tier cannot run a scene, with what is allowed.

    ``bends``: kind of structure; ``unaudited_heat``: whether the effect thermal has no energy audit.
    """
    limits, found = TIERS[tier], []
    if limits.needs_rib and not has_rib:
        found.append(
            f"{tier!r} needs effects.rib, which is absent: nothing else holds its rollers axially; switch "
            "effects.rib on (friction 0 leaves a frictionless rib) or take the tier 'full'"
        )
    if unaudited_heat and not missing_effects(tier, ("audit",)):
        found.append(
            f"{tier!r} warms by what effects.audit finds, which is absent: effects.thermal needs the audit; "
            "set audit to true, or take a fast tier"
        )
    if laminae < limits.smallest_laminae:
        found.append(
            f"{tier!r} needs numerics.laminae of at least {limits.smallest_laminae}, not {laminae}: a single "
            "lamina holds no tilt"
        )
    if steps_per_sample < 1 and steps_per_sample not in limits.long_steps:
        *others, last = *(f"{steps:g}" for steps in limits.long_steps), "1 or more"
        allowed = f"{', '.join(others)} or {last}" if others else last
        found.append(
            f"numerics.steps_per_sample {steps_per_sample} does not go with tier {tier!r}: "
            f"allowed is {allowed}"
        )
    elif steps_per_sample < 1 and bends and steps_per_sample not in long_steps(tier, bends):
        rings = "".join(f"{steps:g} with kind rings, " for steps in limits.long_ring_steps)
        found.append(
            f"numerics.steps_per_sample {steps_per_sample} does not go with effects.structure: rollers that "
            f"come into contact push modes of the box over in steps that long; take {rings}1 or more"
        )
    return found


def integrator_problems(integrator: str, tier: str, steps_given: bool, automatic: bool) -> list[str]:
    """List the reasons why a scene cannot use its integrator, with what is allowed.

    ``implicit`` solves for each roller's velocities under its contacts, linearised. ``explicit`` takes the
    contact forces of the beginning of the step on roller and ring alike, symplectic Euler. With steps above
    0.5 us (dry friction at 150 kN) to 5 us (films) slips flip from step to step while mean forces stay about
    right: it is nothing but a reference for the other.
    """
    if integrator != "explicit":
        return []
    if automatic:
        return [
            "'explicit' is for references and goes with nothing that is auto; write tier, effects, laminae "
            "and steps_per_sample down, or take 'implicit'"
        ]
    found = []
    if tier != "full":
        found.append(f"'explicit' needs the tier 'full', not {tier!r}; change it, or take 'implicit'")
    if not steps_given:
        found.append(
            "'explicit' needs numerics.steps_per_sample: 391 for the 0.1 us of a reference, some 80 or more"
        )
    return found
