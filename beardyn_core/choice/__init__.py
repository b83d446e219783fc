"""The choice room: the cheapest tier, effects, laminae and step for an accuracy, from rules with reasons.

============= =================================================================
module        responsibility, in the order of the data
============= =================================================================
free          what of a scene may be chosen
circumstances load cases of the operation
statics       equilibria of the load cases
losses        torque by source, slip of the raceways
costs         measured cost of tiers, effects, laminae (`costs.json`)
evidence      all of these for one scene, each worked out once
rule          alternatives with influence and cost; decisions
stiffness     rules: ring flexibility, lamina coupling
friction      rules: traction and film, rolling resistance, drag, seal, thermal
guidance      rules: rib, small rib, cage
motion        rules: gravity, contact damping, audit
tier          what a tier leaves out
usual_step    the step of a scene that names none
fast_step     the step of the fast tiers
numerics      what a lamina count leaves out; the step
search        the cheapest alternatives within the limits
outcome       the choice with reasons, cost and expected errors
choose        scene in, choice out
============= =================================================================

Importing `choose` brings the compiler along; the room itself does not.
"""
