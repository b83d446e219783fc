"""Torque and steady temperatures of axlebox bearings, beside published ones.

========= ====================================================================
module    responsibility
========= ====================================================================
skf       frictional moment as SKF's catalogue has it
published torques and temperatures of axlebox bearings as others printed them
cases     scenes of the tables: speeds, states of the bearing, assumed inputs
tables    the tables as text
page      docs/heat.md
========= ====================================================================
"""
