"""Torque and steady temperatures of axlebox bearings, beside published ones.

========= ====================================================================
module    responsibility
========= ====================================================================
skf       frictional moment as SKF's catalogue has it
published torques and temperatures of axlebox bearings as others printed them
cases     scenes of the tables: speeds, states of the bearing, assumed inputs
intervals measured temperatures next to intervals over grease, seals and air
tables    the tables as text
page      docs/evidence/heat.md
========= ====================================================================
"""
