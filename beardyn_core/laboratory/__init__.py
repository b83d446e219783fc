"""The contact laboratory: the general contact search of Santos (2017) against the closed forms of the twin.

================ ======================================================================
module           responsibility
================ ======================================================================
shapes           surfaces of revolution and lines with frames and derivatives
search           conditions of least distance; root finder, Newton
compiled         the same search compiled, many pairs in one call
nine_contacts    the nine contacts of a tapered roller as pairs of shapes
closed_forms     closed forms of them and of simple shapes, plain, and from the kernels
placements       random shapes, random rollers, a loaded row
timing           time, iterations, failures and errors of every method
sphere_radius    roller ends too large for their rib
rolling          a coin and a roller in a trough
barrel           a spherical roller bearing at rest
findings         runs all of it
contacts_picture pictures of the contact laboratory
contacts_report  results of the contact laboratory as tables and as JSON
rerun_rolling    coin and roller of the contact laboratory as an animation
================ ======================================================================
"""
