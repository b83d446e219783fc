"""Time step of a scene that states none."""

from __future__ import annotations

from beardyn_core.integrate.friction_steps import StepChoice, usual_steps
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.sensor import FINE_STEPS, Accelerometer, steps_do_not_fit
from beardyn_core.scene.tier import TIERS


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
    return served(found, scene.sensors)


def served(choice: StepChoice, sensors: tuple[Accelerometer, ...]) -> StepChoice:
    """Refine a choice of the step where the sensors need it."""
    steps = choice.steps_per_sample
    problem = steps_do_not_fit(sensors, steps)
    return choice if problem is None else StepChoice(max(FINE_STEPS, steps + steps % 2), problem)
