"""The time step that friction asks for: a rule that needs no equilibrium and no compiled code.

See `physics.tiers.step_choice` for the runs that it was made from.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from beardyn_core.effects import (
    CoulombTraction,
    EffectSet,
    LoadSharingTraction,
    MixedTraction,
    ShearedFilmTraction,
)
from beardyn_core.scene.tier import TIERS

LARGEST_STEPS = 64
# A run whose index is above it has friction that flips from step to step.
LARGEST_CHATTER_INDEX = 0.2
# Chatter index of friction with a slope of 10 s/m at 2 steps per sample, before what moves was taken off it:
# on the side of more steps; it goes with this power of the step.
_CHATTER_INDEX = 0.33
_CHATTER_SLOPE = 10.0
_CHATTER_POWER = 1.4
# The index was measured with 6 laminae. Fewer carry more each; their friction is taken as steeper by the
# root of that: a margin that fits one scene, where at 80 kN 2 laminae flip with 2 steps and not with 3.
_USUAL_LAMINAE = 6
LARGEST_EXPECTED_INDEX = 0.85 * LARGEST_CHATTER_INDEX
_CREEP = 0.01  # slowest entrainment that is looked at [m/s]
_USUAL_ENTRAINMENT = 5.0  # [m/s]


@dataclass(frozen=True)
class StepChoice:
    """Time step of a run."""

    steps_per_sample: float  # time steps per waveform sample of 1/25600 s
    reason: str  # what decided


def usual_steps(effects: EffectSet, laminae: int) -> int:
    """Find the steps per sample of a full run that names none: the tier's, or more where friction is steep.

    Friction whose slope depends on the speed (load sharing without a film) is taken at an entrainment of
    5 m/s; `choose_steps` uses the slowest speed.
    """
    slope = fixed_slope(effects)
    if isinstance(effects.traction, LoadSharingTraction) and effects.film is None:
        slope = shared_slope(effects.traction, _USUAL_ENTRAINMENT)
    return max(TIERS["full"].steps_per_sample, min(friction_steps(slope, laminae), LARGEST_STEPS))


def fixed_slope(effects: EffectSet) -> float:
    """Find the rise of friction with the slip speed where the speed does not matter, [s/m]."""
    traction = effects.traction
    if isinstance(traction, CoulombTraction):
        return traction.friction / traction.regularisation_speed
    if isinstance(traction, MixedTraction | ShearedFilmTraction):
        return traction.boundary_friction / traction.regularisation_speed
    return 0.0


def shared_slope(traction: LoadSharingTraction, entrainment: float) -> float:
    """Find that rise for load sharing without a film, [s/m]."""
    return 2.0 / math.pi * traction.boundary_friction * traction.boundary_slope / max(entrainment, _CREEP)


def friction_steps(slope: float, laminae: int) -> int:
    """Find the steps per sample that keep friction of a slope [s/m] from flipping from step to step."""
    coarse = max(1.0, math.sqrt(_USUAL_LAMINAE / laminae))
    ratio = _CHATTER_INDEX * slope * coarse / (_CHATTER_SLOPE * LARGEST_EXPECTED_INDEX)
    return max(1, math.ceil(2.0 * ratio ** (1.0 / _CHATTER_POWER)))
