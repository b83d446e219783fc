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
``force_triangle``      one roller between cup, cone and rib
``load_zone``           load-zone integrals of one row
``life``                basic load rating (ISO 281)
``lubricant``           viscosity and pressure-viscosity with temperature
``rolling_resistance``  rolling couple of one lubricated contact
``film_thickness``      films of line and point contacts, starvation, inlet heating
======================  ==================================================================
"""
