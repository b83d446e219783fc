"""The choice room: the cheapest tier, effects, laminae and step for an accuracy, from rules with reasons.

===================== ===================================================================================
module                responsibility
===================== ===================================================================================
load_cases            load cases of the operation
statics               equilibria of the load cases
losses                torque by source, slip of the raceways
steady_heat           steady temperatures, where losses and heat carried off agree
heat_interval         the same over the ranges of grease, seals and air
costs                 measured cost of tiers, effects, laminae (`costs.json`)
reference_solution    all of these for one scene, each worked out once
rule                  alternatives with influence and cost, decisions, the choice with reasons and errors
friction              rules: traction and film, rolling resistance, drag, seal, thermal
guidance              rules: rib, small rib, cage
gravity_damping_rules rules: gravity, contact damping, lamina coupling, audit
ringing               third octaves of the sensors with modes of the box, linear
bending               rule: structure; where sensors and modes do not reach equally far
fast_step             the step of the fast tiers
usual_step            the step of a scene that names none
sampling              the rate that holds the third octaves that are asked for
discretisation_error  what a tier or a lamina count leaves out; the step
choose                scene in, the cheapest alternatives within the limits out
choice_cache          choices made before, next to the compiled kernels
source_hash           hash of the sources that a choice may come from
load                  scenes ready to run: read by `config`, what they leave open closed
trial                 the scenes of a trial
===================== ===================================================================================

Importing `choose` brings the compiler along; the room itself, and a scene without `auto`, do not.
"""

from beardyn_core.choice.load import (
    Explanation,
    explain_scene,
    load_scene,
    scene_from_mapping,
    scene_from_text,
)
from beardyn_core.choice.trial import load_trial, trial_scene, with_choices

__all__ = [
    "Explanation",
    "explain_scene",
    "load_scene",
    "load_trial",
    "scene_from_mapping",
    "scene_from_text",
    "trial_scene",
    "with_choices",
]
