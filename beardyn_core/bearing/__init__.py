"""The bearing: what it is made of, and what follows from that by formulas alone.

================== =================================================================
module             responsibility
================== =================================================================
profile            drop of the roller generator along its length
roller_bearing     `RollerBearing`: what bearings of every kind of roller have in common
geometry           `Bearing`, tapered: numbers of its file, material, apex closure, rib, roller inertia
rib_face           faces of rings that guide roller ends
radial_bearing     `RadialBearing`: rollers with two like ends, radial clearance
cylindrical        `CylindricalBearing`: pair of single rows with ribs, such as WJ and WJP
spherical          `SphericalBearing`: two rows of barrels on a spherical raceway
any_bearing        bearings of any kind as one type; what only tapered ones have, refused for others
consistency        `check`: refuses numbers that contradict each other
kinematics         speeds of cage and roller, fault frequencies
name_plate         `NamePlate`: what the fault frequencies of any rolling bearing need
factors            maker's factors: what follows from those that are given, what contradicts
catalogue_entry    `CatalogueEntry`: a bearing with its dimensions, maker and sources
contact_law        line contact (Palmgren), point contact (Hertz), rib of a bearing with its ellipse
lamina_coupling    laminae coupled through the half-space, also those partly over a patch
holed_line         load that a line contact loses over holes, from a half-space
ring_bending       stiffness and mass of the bending modes of a thin ring
lubricant          viscosity and pressure-viscosity with temperature
film_thickness     films of line contacts, inlet heating; film of the rib contact
rolling_resistance rolling couple of one lubricated contact
oil_layer          oil on the raceways, and what it leaves of film and rolling couple
starvation         rolling couple of a starved inlet by Reynolds' equation
starved_rolling    how much oil a rolling contact finds
thermal            what temperature does to the end play; parts as a network of lumped nodes
life               load ratings and rating life, ISO 281, and from the load of every lamina, ISO 16281
================== =================================================================
"""
