"""The bearing: what it is made of, and what follows from that by formulas alone.

================== =================================================================
module             responsibility
================== =================================================================
profile            drop of the roller generator along its length
material           elastic constants and density
geometry           `Bearing`: numbers of its file, apex closure, rib, roller inertia
consistency        `check`: refuses numbers that contradict each other
kinematics         speeds of cage and roller, fault frequencies
hertz              Hertz point contact, and the contact ellipse of the rib
contact_law        line contact (Palmgren), point contact (Hertz), rib of a bearing
lamina_coupling    laminae coupled through the half-space: influence matrix and law
joint_lamina       a lamina partly over a patch, as one spring
ring_bending       stiffness and mass of the bending modes of a thin ring
force_triangle     one roller between cup, cone and rib
lubricant          viscosity and pressure-viscosity with temperature
film_thickness     films of line contacts, inlet heating
rib_film           film of the rib contact
rolling_resistance rolling couple of one lubricated contact
thermal_closure    what temperature does to the end play
thermal_network    temperatures of the parts as a network of lumped nodes
edge_concentration stress at the roller ends, as rating life counts it
life               load ratings and rating life, ISO 281
reference_life     rating life from the load of every lamina, ISO 16281
================== =================================================================
"""
