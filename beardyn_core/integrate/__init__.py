"""Equilibrium and time steps.

================== ==========================================
module             responsibility, in the order of the data
================== ==========================================
roller_contacts    contacts of resting rollers, with tangents
roller_equilibrium every roller in balance
static             the double row in balance
torque             running torque under static loads
state              what changes during a run, and its start
imex               linearly implicit steps of the full tier
status             status bits and the sentence of each
================== ==========================================
"""
