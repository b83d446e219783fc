"""Time step of a scene that names none."""

from __future__ import annotations

from beardyn_core.choice.fast_step import fast_steps
from beardyn_core.choice.numerics import served
from beardyn_core.integrate.step_choice import StepChoice, usual_steps
from beardyn_core.scene.scene import Scene
from beardyn_core.scene.tier import TIERS


def usual_step(scene: Scene, outside_load: bool = False) -> StepChoice:
    """Steps per sample that the tier of a scene takes for it, and no fewer than its sensors need.

    Parameters
    ----------
    scene : Scene
        Its own numerics do not matter, but for the laminae.
    outside_load : bool
        Whether the load comes from elsewhere than the scene's operation, so that nothing is known of it.
    """
    noun = TIERS[scene.tier]
    found = StepChoice(noun.steps_per_sample, f"the usual step of the tier {scene.tier}")
    if scene.tier == "full":
        steps = usual_steps(scene.effects, scene.numerics.laminae)
        if steps > noun.steps_per_sample:
            found = StepChoice(steps, "friction as steep as this flips with longer steps")
    else:
        found = fast_steps(scene, long=not outside_load)
    return served(found, scene.sensors)
