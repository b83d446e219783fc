"""Equilibrium and time steps.

================== ==========================================
module             responsibility, in the order of the data
================== ==========================================
roller_contacts    contacts of resting rollers, with tangents
roller_equilibrium every roller in balance, and one as a spring
static             the double row in balance
equilibria         equilibria that are solved once
rest               bearing, box and springs at rest under a load
torque             running torque under static loads
step_choice        the coarsest step that is converged
friction_steps     the step that friction asks for, without an equilibrium
rating_life        life under a load history
state              what a run changes and what its steps write
start              the state a run starts from
imex               linearly implicit steps of the full tier
kinematic_step     what the fast tiers share of a step
quasistatic        explicit steps of the quasistatic tier
lumped             explicit steps of the lumped tier, and its rollers at some instants
tiers              what each tier computes with
warming            slow warming beside the fast motion
cage_watch         speeds of the cages over those of pure rolling
status             status bits and the sentence of each
snapshot           what a run is frozen in and goes on from
================== ==========================================
"""
