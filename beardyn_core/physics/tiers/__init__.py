"""What a tier computes with: parameters from the scene, the state, and the steps in time.

================= =====================================================================
module            responsibility
================= =====================================================================
imex              linearly implicit steps of the full tier
quasistatic       explicit steps of the quasistatic tier
lumped            explicit steps of the lumped tier, and its rollers at some instants
kinematic_step    what the fast tiers share of a step
state             what a run changes and what its steps write
start             the state a run starts from
status            status bits and the sentence of each
step_choice       the coarsest step that is converged
friction_steps    the step that friction asks for, without an equilibrium
tiers             what each tier computes with
planar_roller     a roller between cup, cone and rib, implicit (quasistatic tier)
planar_contacts   its contacts with raceways and rib as springs
planar_flanges    ends of cylinders on the ribs of both rings (quasistatic tier)
planar_barrel     a barrel between sphere and groove, implicit (quasistatic tier)
massless_roller   a roller as one spring (lumped tier)
massless_barrel   a barrel over patches as one spring (lumped tier)
massless_flanges  axial springs of cylinders between ribs of both rings (lumped tier)
kinematic_rings   rings of the fast tiers on the springs of all rollers
sliding           rollers that slide along the cup, by the traction law (fast tiers)
kinematic_rollers rollers that orbit kinematically, and their torque on the shaft
kinematic_bending bending of the axlebox in the fast tiers
joint_bending     few modes and rigid rings together on the springs of rollers
roller            one step of a block of rollers
build             a scene to parameters; how much of a spring a step takes in
parameters        named tuples of kernel parameters; an absent effect is None
tier_parameters   parameters of the tiers without roller dynamics
tier_bending      bending of the axlebox in these tiers
kinematics        world poses, twists and contact forces from the kernel's state
================= =====================================================================
"""
