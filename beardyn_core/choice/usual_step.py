"""Time step of a scene that states none."""

from __future__ import annotations

import math

from beardyn_core.physics.tiers.friction_steps import StepChoice, usual_steps
from beardyn_core.scene.scene import SNAPSHOT_RATES, Scene
from beardyn_core.scene.sensor import FINE_STEPS, steps_do_not_fit
from beardyn_core.scene.tier import TIERS
from beardyn_core.structure.mounted_box import modes_of_effects

# Free motion of a mode is exact with four; where contacts shift it by 5 %, five leave 0.8 % of its frequency
STEPS_PER_TURN = 5


def usual_step(scene: Scene, outside_load: bool = False) -> StepChoice:
    """Find the steps per sample that the tier of a scene takes for it, no fewer than its sensors need.

    Of its own numerics only the laminae matter. ``outside_load``: the load comes from elsewhere than the
    scene's operation, so that nothing is known of it.
    """
    tier = TIERS[scene.tier]
    found = StepChoice(tier.steps_per_sample, f"the usual step of the tier {scene.tier}")
    if scene.tier == "full":
        steps = usual_steps(scene.effects, scene.numerics.laminae)
        if steps > tier.steps_per_sample:
            found = StepChoice(steps, "friction as steep as this flips with longer steps")
    else:
        from beardyn_core.choice.fast_step import fast_steps  # brings the model along

        found = fast_steps(scene, long=not outside_load)
    return refine_for_outputs(with_modes(found, scene), scene)


def with_modes(choice: StepChoice, scene: Scene, band: float | None = None) -> StepChoice:
    """Refine a choice of the step where modes of the box to ``band`` [Hz], or all audible ones, need it."""
    modes = None if "structure" in scene.missing_effects else modes_of_effects(scene.effects)
    if modes is None:
        return choice
    from beardyn_core.physics.bodies.rates import WAVEFORM_RATE
    from beardyn_core.physics.tiers.step_choice import AUDIBLE_BAND  # brings the model along

    band = AUDIBLE_BAND if band is None else band
    highest = max((float(each) for each in modes.frequency[: modes.free_count] if each <= band), default=0.0)
    if highest == 0.0:
        return choice
    steps = max(choice.steps_per_sample, math.ceil(STEPS_PER_TURN * highest / WAVEFORM_RATE))
    turns = steps * WAVEFORM_RATE / highest
    turn = f"modes of the box up to {1e-3 * highest:.3g} kHz have {turns:.1f} steps a turn"
    return StepChoice(steps, turn if steps > choice.steps_per_sample else f"{choice.reason}; {turn}")


def refine_for_outputs(choice: StepChoice, scene: Scene) -> StepChoice:
    """Refine a choice of the step where the sensors need it, or the rate of bodies and contacts."""
    steps = choice.steps_per_sample
    least = scene.snapshot_rate / SNAPSHOT_RATES[-1]
    if steps < least:
        choice = StepChoice(least, f"bodies and contacts are kept at {scene.snapshot_rate:g} Hz")
        steps = least
    problem = steps_do_not_fit(scene.sensors, steps)
    return choice if problem is None else StepChoice(max(FINE_STEPS, steps + steps % 2), problem)
