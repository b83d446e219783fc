"""The bearing as a noun: what it is made of and what follows from that by geometry alone.

======================  ==================================================================
module                  responsibility
======================  ==================================================================
``profile``             drop of the roller generator along its length
``material``            elastic constants and density
``geometry``            `Bearing`: given numbers, apex closure, rib, roller inertia
``consistency``         `check`: refuses numbers that contradict each other
``kinematics``          speeds of cage and roller, fault frequencies
``contact_law``         line contact (Palmgren), point contact (Hertz), rib of a bearing
``hertz``               point contact with complete elliptic integrals
``lamina_coupling``     laminae coupled through the half-space
``joint_lamina``        one depth for a lamina that lies partly over a patch
``ring_bending``        stiffness and mass of the modes of a thin ring
``force_triangle``      one roller between cup, cone and rib
``load_zone``           load-zone integrals of one row
``life``                basic load rating (ISO 281)
``edge_concentration``  stress at the roller ends, as rating life counts it
``reference_life``      rating life from the load of every lamina (ISO 16281)
``lubricant``           viscosity and pressure-viscosity with temperature
``rolling_resistance``  rolling couple of one lubricated contact
``film_thickness``      films of line and point contacts, starvation, inlet heating
``rib_film``            film of the rib contact
``thermal_closure``     what temperature does to the end play
``thermal_network``     temperatures of the parts as a network of nodes
======================  ==================================================================
"""
