"""What every idea shares: layout of the state, rollers in lanes, rigid bodies, what contacts write.

================= =========================================================
module            responsibility
================= =========================================================
rigid_bodies      cup, cone and cages as scalar rigid bodies
contact_output    what a contact hands to rings, audit and outputs
friction_substeps friction of a contact, worked out in every few steps
orbit             motion of rollers in frames that turn with their orbit
stage_timer       where the time of a step goes
step_stages       stages of a time step, and the counters of what they take
layout            where each number of the state and the tables stands
losses            sources of loss by name
arrangement       which roller sits in which lane; arrays on cache lines
rates             how often things are computed
power             a loss of power as a torque on the shaft
================= =========================================================
"""
