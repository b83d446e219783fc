"""Equilibrium and time steps.

================== ===========================================
module             responsibility, in the order of the data
================== ===========================================
roller_contacts    contacts of resting rollers, with tangents
roller_equilibrium every roller in balance
line_load          load and pressure along one roller
static             the double row in balance
rating_life        life under a load history
torque             running torque under static loads
state              what changes during a run, and its start
imex               linearly implicit steps of the full tier
roller_spring      a roller as one spring, for the lumped tier
kinematic_step     what the fast tiers share of a time step
lumped             explicit steps of the lumped tier
quasistatic        explicit steps of the quasistatic tier
spring_trend       rollers of the lumped tier at some instants
warming            slow warming, once a block
tiers              what each tier computes with
friction_steps     the step that friction asks for, without an equilibrium
status             status bits and the sentence of each
step_choice        the coarsest step that is converged
restraint          what holds the bearing against tilt
snapshot           what a run is frozen in and goes on from
================== ===========================================
"""
