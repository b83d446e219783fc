"""Cages under light loads: every shipped set of effects, from 0.2 to 150 kN and 20 to 2500 rpm.

======== ==========================================
module   responsibility
======== ==========================================
grid     the grid, and the mean speed of the cages
page     docs/evidence/light.md and its picture
======== ==========================================
"""
