"""The bearing at rest: equilibrium, stiffness, torque and life, in NumPy.

=================== =========================================================
module              responsibility
=================== =========================================================
static              the double row in balance
possible_loads      loads that a bearing cannot carry, refused before the search
equilibria          equilibria that are solved once
roller_contacts     contacts of resting cones and cylinders, with tangents
barrel_contacts     contacts of resting barrels
roller_equilibrium  every roller in balance, one by its forces, and one as a spring
torque              running torque under static loads
initial_equilibrium bearing, box and springs at rest under a load
rating_life         life under a load history
=================== =========================================================
"""
