"""Axleboxes that bend: from a box in figures to its modes, and the table that keeps them.

=========== ====================================================================
module      responsibility
=========== ====================================================================
box         an axlebox in figures: housing, what is cast to it, cup, seats
cup         the cup that modes are made with: only a bearing with the same one goes into the box
damping     damping of modes over their frequency
fitting     a box in proportion to the bearing that it carries
mesh        tetrahedra of a box (gmsh)
elastic     stiffness, mass and rigid motion of a mesh; static and free answers (scikit-fem)
reduction   free modes and residual modes: the fewest numbers that answer right
modes       the modes of a box as the bearing and the sensors see them
table       the text file of the modes
shapes      modes at nodes, of another program
universal   ... from a Universal file (pyuff)
nastran     ... from a punch file of Nastran with its bulk data
imported    ... as the bearing, the sensors and the springs see them
build       from a box to its modes, with what shows that they are right
mounted_box the box of a scene: its modes, the seats of its sensors, the mounting with it
=========== ====================================================================

Meshing and finite elements need the extra ``structure`` (``pip install beardyn[structure]``); reading a table
needs nothing.
"""
